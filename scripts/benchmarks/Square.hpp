// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "../../tests/kernel/Scene.hpp"

namespace yade::mpm {

/* What the points of a square do. Yielding: the hysteretic law with n = 10, a third of the points flows. Spinning: elastic
points that change their tiles. */
enum class Motion { elastic, yielding, spinning };

/* across x across points of steel on a square of 1 m in plane stress, 4 points a cell. */
inline Scene square(int across, ShapeKind shape, Motion motion, int threads)
{
	Scene s;
	if (motion == Motion::yielding)
		s.laws = { Scene::boucWen(210e9, .3, 7850, 240e6, 10, .05) };
	else
		s.laws = { Scene::elastic(210e9, .3, 7850) };
	if (motion != Motion::spinning) s.walls = { Scene::wall(0, 1, 0, Wall::Kind::fixed) };
	const double spacing = 1. / across;
	s.addBox(2, { 0, 0, 0 }, { 1, 1, 0 }, spacing);
	s.start(Analysis::planeStress, shape, 2 * spacing);
	s.control.dt      = .2 * 2 * spacing / 5422;
	s.control.threads = threads;
	s.setVelocity([&](const std::array<double, 3>& x) -> std::array<double, 3> {
		if (motion == Motion::spinning) return { -300 * x[1], 300 * x[0], 0 };
		return { (motion == Motion::yielding && x[1] < 1. / 3 ? .2 * across : 1) * x[0], 0, 0 };
	});
	s.run(motion == Motion::yielding ? 100 : 3); // 1.5e-5 a step
	return s;
}

} // namespace yade::mpm
