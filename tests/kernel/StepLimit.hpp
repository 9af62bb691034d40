// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "Scene.hpp"
#include <random>

namespace yade::mpm {

/* Growth of the kinetic energy from random velocities, small against the speed of sound c, or infinity. */
inline double growth(
	const Scene& original, Analysis analysis, ShapeKind shape, double h, Method method, double dt, int steps, double velocity, double most = 1e6)
{
	Scene                                  s = original.copy(analysis, shape, h);
	std::mt19937                           random(11);
	std::uniform_real_distribution<double> uniform(-velocity, velocity);
	const int                              dim = dimension(analysis);
	s.setVelocity([&](auto) { return std::array<double, 3> { uniform(random), dim > 1 ? uniform(random) : 0, dim > 2 ? uniform(random) : 0 }; });
	s.control.dt = dt;
	method.set(s.control);
	const double start = s.kineticEnergy();
	double       worst = 0;
	try {
		for (int k = 0; k < steps; ++k) {
			s.step();
			if (k % 20 == 0) worst = std::max(worst, s.kineticEnergy() / start);
			if (!(worst < most)) return HUGE_VAL;
		}
	} catch (const StepFailure&) {
		return HUGE_VAL;
	}
	return worst;
}

/* The step swept to failure, in the bulk and at the edge (Bai & Schroeder, Stability analysis of explicit MPM, Comput. Graph. Forum 41, 2022: the
edge is the less stable). A line or a square of 2 points a cell and axis, unit cells and wave speed, nu = 0 or 0.3 in plane strain; in the bulk all ends are
fixed walls and the points on their lattice, at the edge all are free and the lattice is shifted along all axes by a part of a cell. */
struct StepLimit {
	Analysis  analysis;
	ShapeKind shape;
	Method    method;

	Scene body(bool free, double shift) const
	{
		const int    dim = dimension(analysis), cells = dim == 1 ? 12 : 4;
		const double poisson = dim == 1 ? 0 : .3, young = dim == 1 ? 1 : (1 + poisson) * (1 - 2 * poisson) / (1 - poisson); // confined modulus 1
		const double from = free ? shift : 0, to = from + cells;
		Scene        s;
		s.laws = { Scene::elastic(young, poisson, 1) };
		s.addBox(dim, { from, from, 0 }, { to, to, 0 }, .5);
		for (int d = 0; d < dim && !free; ++d)
			for (int side : { 1, -1 })
				s.walls.push_back(Scene::wall(d, side, side > 0 ? from : to, Wall::Kind::fixed));
		s.start(analysis, shape, 1);
		return s;
	}
	double computed(const Scene& s) const { return s.solver->criticalTimeStep(method.scheme, method.fullMass); }
	bool   grows(const Scene& s, double dt) const { return growth(s, analysis, shape, 1, method, dt, 1500, 1e-10, 1e8) > 1e7; }
	/* Where a run turns unstable, to half a per cent; between `low` and `high` times the computed step. */
	double actual(const Scene& s, double low = .3, double high = 3) const
	{
		const double dt = computed(s);
		while (high > 1.005 * low) {
			const double middle                  = std::sqrt(low * high);
			(grows(s, middle * dt) ? high : low) = middle;
		}
		return std::sqrt(low * high) * dt;
	}
	/* Places of the end in its cell: spread evenly, and just past those where a function first reaches a further node. */
	static std::vector<double> places()
	{
		std::vector<double> list { 0 };
		for (int k = 0; k < 16; ++k)
			list.push_back((k + .37) / 16);
		for (double at : { 0., .25, .5, .75 })
			for (double past : { 1e-4, 1e-3, 1e-2 })
				list.push_back(at + past), list.push_back(at + 1 - past);
		return list;
	}
};

} // namespace yade::mpm
