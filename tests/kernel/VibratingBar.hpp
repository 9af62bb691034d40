// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "Manufactured.hpp"

namespace yade::mpm {

/* V3, the vibrating bar of Buzzi, Pedroso & Giacomini, CMES 31 (2008) 85: energy of the three schemes in small and large motion.

E = 100, L = 25, rho = 1, nu = 0, one end fixed, the other free, v = v0 sin(pi x / 2L). 2 points a cell, dt = 0.1 h/c, T = 100, ten
periods. For small v0 the centre of mass moves with v0 (2/pi) cos(omega t), omega = pi c / 2L = 0.6283185. */
struct Bar {
	double velocityError = 0, energyRatio = 0;
};

inline Bar vibrate(ShapeKind shape, int cells, Method method, double v0, double flip = 1, Cost* cost = nullptr)
{
	const double L = 25, young = 100, c = 10, omega = pi * c / (2 * L), h = L / cells;
	Scene        s;
	s.laws  = { Scene::elastic(young, 0, 1) };
	s.walls = { Scene::wall(0, 1, 0, Wall::Kind::fixed) };
	s.addBox(1, { 0, 0, 0 }, { L, 0, 0 }, h / 2);
	s.setVelocity([&](auto x) { return std::array<double, 3> { v0 * std::sin(pi * x[0] / (2 * L)), 0, 0 }; });
	s.control.dt = .1 * h / c, s.control.flip = flip;
	method.set(s.control);
	s.start(Analysis::uniaxial, shape, h);

	auto energy = [&] {
		double sum = 0;
		for (std::size_t p = 0; p < s.points.count(); ++p) {
			const double F = s.points.deformation[0][p], v = s.points.velocity[0][p];
			sum += .5 * s.points.mass[p] * v * v + s.points.volume0[p] * young * (F * std::log(F) - F + 1);
		}
		return sum;
	};
	const double start = energy();
	Bar          bar;
	const int    steps = int(std::lround(100 / s.control.dt));
	for (int k = 0; k < steps; ++k) {
		Cost unasked;
		(cost ? *cost : unasked).step(s, false);
		double momentum = 0, mass = 0;
		for (std::size_t p = 0; p < s.points.count(); ++p)
			momentum += s.points.mass[p] * s.points.velocity[0][p], mass += s.points.mass[p];
		const double amplitude = v0 * 2 / pi;
		bar.velocityError      = std::max(bar.velocityError, std::abs(momentum / mass - amplitude * std::cos(omega * s.control.time)) / amplitude);
	}
	s.solver->finish();
	bar.energyRatio = energy() / start;
	return bar;
}

} // namespace yade::mpm
