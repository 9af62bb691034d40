// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "kernel/Solver.hpp"
#include <functional>

namespace yade::mpm {

/* A scene of the kernel alone: what the engine does in YADE, for tests. */
struct Scene {
	Points                  points;
	std::vector<Law>        laws;
	std::vector<Wall>       walls;
	StepControl             control;
	std::unique_ptr<Solver> solver;

	static Law elastic(double young, double poisson, double density)
	{
		Law law;
		law.elastic = { young, poisson }, law.density = density;
		return law;
	}
	static Law boucWen(double young, double poisson, double density, double yieldStress, double n, double tangentRatio)
	{
		Law law                 = elastic(young, poisson, density);
		law.kind                = Law::Kind::boucWen;
		law.boucWen.elastic     = law.elastic;
		law.boucWen.yieldStress = yieldStress, law.boucWen.n = n;
		law.boucWen.hardening = BoucWenParameters::hardeningModulus(young, tangentRatio);
		return law;
	}
	static Wall wall(int axis, int side, double position, Wall::Kind kind)
	{
		Wall w;
		w.axis = axis, w.side = side, w.position = position, w.kind = kind;
		return w;
	}

	/* Points at lower + (i + 1/2) spacing inside the box, with the first law; unit section across the axes that a problem lacks. */
	void addBox(int dim, const std::array<double, 3>& lower, const std::array<double, 3>& upper, double spacing)
	{
		std::array<int, 3> n { 1, 1, 1 };
		double             volume = 1;
		for (int d = 0; d < dim; ++d)
			n[d] = int(std::lround((upper[d] - lower[d]) / spacing)), volume *= spacing;
		const double still[3] = { 0, 0, 0 };
		for (int k = 0; k < n[2]; ++k)
			for (int j = 0; j < n[1]; ++j)
				for (int i = 0; i < n[0]; ++i) {
					const int index[3] = { i, j, k };
					double    x[3]     = { 0, 0, 0 };
					for (int d = 0; d < dim; ++d)
						x[d] = lower[d] + (index[d] + .5) * spacing;
					points.append(int(points.count()), 0, x, still, laws[0].density * volume, volume, spacing, 1);
				}
	}
	void setVelocity(const std::function<std::array<double, 3>(const std::array<double, 3>&)>& velocity)
	{
		for (std::size_t p = 0; p < points.count(); ++p) {
			const auto v = velocity({ points.position[0][p], points.position[1][p], points.position[2][p] });
			for (int d = 0; d < 3; ++d)
				points.velocity[d][p] = v[d];
		}
	}
	void start(Analysis analysis, ShapeKind shape, double cellSize, bool forces = false)
	{
		int internals = 0;
		for (const Law& law : laws)
			internals = std::max(internals, Internals::of(law.kind).columns(stressComponents(analysis)));
		points.prepare(dimension(analysis), stressComponents(analysis), internals, control.thinning, forces);
		solver = makeSolver(analysis, shape, cellSize, points, laws, walls);
	}
	/* Current volume of a point. */
	double volume(std::size_t p) const
	{
		const std::size_t dim = points.deformation.size() == 1 ? 1 : points.deformation.size() == 4 ? 2 : 3;
		const auto&       F   = points.deformation;
		double            J   = F[0][p];
		if (dim == 2) J = F[0][p] * F[3][p] - F[1][p] * F[2][p];
		if (!points.thicknessStretch.empty()) J *= points.thicknessStretch[p];
		return points.volume0[p] * J;
	}
	void step()
	{
		solver->step(control);
		control.time += control.dt;
	}
	void run(int steps)
	{
		for (int k = 0; k < steps; ++k)
			step();
		solver->finish();
	}
};

} // namespace yade::mpm
