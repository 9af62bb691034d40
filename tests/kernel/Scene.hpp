// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "kernel/Kinematics.hpp"
#include "kernel/solver/Solver.hpp"
#include <functional>

namespace yade::mpm {

constexpr std::array<ShapeKind, 4> allShapes { ShapeKind::linear, ShapeKind::gimp, ShapeKind::quadratic, ShapeKind::cubic };
constexpr std::array<Scheme, 3>    allSchemes { Scheme::usf, Scheme::usl, Scheme::musl };
constexpr std::array<Analysis, 4>  allAnalyses { Analysis::uniaxial, Analysis::planeStress, Analysis::planeStrain, Analysis::solid }; // Cartesian ones
struct Method {                                                                                                                       // of making a step
	Scheme scheme;
	bool   fullMass, affine;

	constexpr Method(Scheme s, bool full = false, bool rotates = false)
	    : scheme(s)
	    , fullMass(full)
	    , affine(rotates)
	{
	}
	void set(StepControl& control) const { control.scheme = scheme, control.fullMass = fullMass, control.affine = affine; }
};
constexpr std::array<Method, 4> allMethods { Scheme::usf, Scheme::usl, Scheme::musl, Method { Scheme::musl, true } };
constexpr std::array<Method, 4> affineMethods { Method { Scheme::usf, false, true }, { Scheme::usl, false, true }, { Scheme::musl, false, true },
	{ Scheme::musl, true, true } };
inline const char*              name(ShapeKind s) { return std::array<const char*, 4> { "linear", "gimp", "quadratic", "cubic" }[std::size_t(s)]; }
inline const char*              name(Scheme s) { return std::array<const char*, 3> { "USF", "USL", "MUSL" }[std::size_t(s)]; }
inline const char* name(Analysis a) { return std::array<const char*, 5> { "uniaxial", "plane stress", "plane strain", "axisymmetric", "3D" }[std::size_t(a)]; }

inline std::string name(Method m) { return std::string(name(m.scheme)) + (m.fullMass ? ", full mass" : "") + (m.affine ? ", affine" : ""); }

/* A scene of the kernel alone, for tests; it replaces the engine in YADE. The solver refers to points, laws and walls. They
keep their addresses when the scene is moved, so that a function may return a scene. */
class Scene {
	struct Data {
		Points            points;
		std::vector<Law>  laws;
		std::vector<Wall> walls;
	};
	std::unique_ptr<Data> m_data = std::make_unique<Data>();

public:
	Points&                 points = m_data->points;
	std::vector<Law>&       laws   = m_data->laws;
	std::vector<Wall>&      walls  = m_data->walls;
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
		Law law                      = elastic(young, poisson, density);
		law.model                    = BoucWen();
		as<BoucWen>(law).yieldStress = yieldStress, as<BoucWen>(law).n = n;
		as<BoucWen>(law).hardening = hardeningModulus(young, tangentRatio);
		return law;
	}
	static Wall wall(int axis, int side, double position, Wall::Kind kind)
	{
		Wall w;
		w.axis = axis, w.side = side, w.position = position, w.kind = kind;
		return w;
	}

	/* Points at lower + (i + 1/2) spacing inside the box, with the first law; unit section across the axes that a problem lacks, or full
	rings about x = 0. */
	void addBox(int dim, const std::array<double, 3>& lower, const std::array<double, 3>& upper, double spacing, bool ring = false)
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
					const double depth = ring ? 2 * std::acos(-1.) * x[0] : 1;
					points.append(int(points.count()), 0, x, still, laws[0].density * volume * depth, volume * depth, spacing, depth);
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
			internals = std::max(internals, Internals::of(law).columns(stressComponents(analysis)));
		points.prepare(dimension(analysis), stressComponents(analysis), internals, control.thinning || analysis == Analysis::axisymmetric, forces,
			control.trackEnergy, false);
		solver = makeSolver(analysis, shape, cellSize, points, laws, walls);
	}
	/* The same points, laws and walls under a solver of their own: a saved scene that has been loaded. */
	Scene copy(Analysis analysis, ShapeKind shape, double cellSize) const
	{
		Scene other;
		other.points = points, other.laws = laws, other.walls = walls, other.control = control;
		other.solver = makeSolver(analysis, shape, cellSize, other.points, other.laws, other.walls);
		return other;
	}
	/* Current volume of a point. */
	double volume(std::size_t p) const
	{
		const std::size_t dim = points.deformation.size() == 1 ? 1 : points.deformation.size() == 4 ? 2 : 3;
		const auto&       F   = points.deformation;
		double            J   = F[0][p];
		if (dim == 2) J = F[0][p] * F[3][p] - F[1][p] * F[2][p];
		if (!points.thicknessStretch.empty()) J *= points.thicknessStretch[p];
		if (dim == 3)
			J = determinant<3>(std::array<double, 9> { F[0][p], F[1][p], F[2][p], F[3][p], F[4][p], F[5][p], F[6][p], F[7][p], F[8][p] }.data());
		return points.volume0[p] * J;
	}
	double kineticEnergy() const
	{
		double sum = 0;
		for (std::size_t p = 0; p < points.count(); ++p)
			for (int d = 0; d < 3; ++d)
				sum += .5 * points.mass[p] * points.velocity[d][p] * points.velocity[d][p];
		return sum;
	}
	std::array<double, 3> momentum() const
	{
		std::array<double, 3> sum {};
		for (std::size_t p = 0; p < points.count(); ++p)
			for (int d = 0; d < 3; ++d)
				sum[d] += points.mass[p] * points.velocity[d][p];
		return sum;
	}
	double mass() const
	{
		double sum = 0;
		for (double m : points.mass)
			sum += m;
		return sum;
	}
	/* position[id]: where the point of this id stands in the arrays. */
	std::vector<std::size_t> byId() const
	{
		std::vector<std::size_t> at(points.count());
		for (std::size_t p = 0; p < at.size(); ++p)
			at[std::size_t(points.id[p])] = p;
		return at;
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
	/* The same, walls going along with their velocities as the engine lets them. */
	void runWithWalls(int steps)
	{
		for (int k = 0; k < steps; ++k) {
			step();
			for (Wall& wall : walls)
				wall.position += control.dt * wall.velocity[std::size_t(wall.axis)];
		}
		solver->finish();
	}
};

} // namespace yade::mpm
