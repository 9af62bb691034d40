// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "Scene.hpp"
#include "kernel/Continuity.hpp"

namespace yade::mpm {

/* A column of unit length that stands on a fixed wall (load < 0) or hangs from it (> 0), load = rho g L/E, weight grown over five periods, at rest after
eight. The stress is load E (1 - X) whatever the law, and with sigma = E ln F the strain at the wall exp(load) - 1. Means over the ninth and tenth
period, 32 cells with 2 points each. A gap of two cells ends it (StepFailure). */
struct WeightColumn {
	double firstPoint = 0, wallForce = 0; // stress of the point next to the wall, force on the wall: less the exact ones, over these
	double spread = 0;                    // root mean square of what the points' stress is off, over the greatest stress

	WeightColumn(ShapeKind shape, double load)
	{
		const double young = 1e7, density = 1000, c = 100, period = 4 / c, h = 1. / 32;
		Scene        s;
		s.laws  = { Scene::elastic(young, 0, density) };
		s.walls = { Scene::wall(0, 1, 0, Wall::Kind::fixed) };
		s.addBox(1, { 0, 0, 0 }, { 1, 0, 0 }, h / 2);
		s.start(Analysis::uniaxial, shape, h);
		s.control.dt = .3 * h / c, s.control.damping = .02;
		std::vector<double> mean(s.points.count());
		Continuity          continuity;
		int                 looks = 0;
		for (int step = 0; s.control.time < 10 * period; ++step) {
			const double x       = std::min(1., s.control.time / (5 * period));
			s.control.gravity[0] = load * young / density * x * x * x * (10 + x * (-15 + 6 * x));
			s.step();
			if (step % 50 == 0) s.solver->finish(), continuity.check(s.points, s.laws, s.walls, h, 2 * h, s.control.time);
			if (s.control.time < 8 * period) continue;
			s.solver->finish(), ++looks;
			for (std::size_t p = 0; p < mean.size(); ++p)
				mean[std::size_t(s.points.id[p])] += s.points.stress[0][p];
			wallForce += s.walls[0].force[0];
		}
		for (std::size_t i = 0; i < mean.size(); ++i) {
			const double exact = load * young * (1 - (double(i) + .5) * h / 2), off = mean[i] / looks - exact;
			spread += off * off / double(mean.size());
			if (i == 0) firstPoint = off / exact;
		}
		spread    = std::sqrt(spread) / (std::abs(load) * young);
		wallForce = wallForce / looks / (load * young) - 1;
	}
};

} // namespace yade::mpm
