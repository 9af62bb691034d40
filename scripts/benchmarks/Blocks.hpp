// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "../../tests/kernel/Scene.hpp"

namespace yade::mpm {

/* What the points do. Elastic, yielding: they are stretched along x by 1.5e-6 a step; yielding: by the hysteretic
law with n = 10, and the lowest third of the points flows, as it yields at a hundredth of the others' stress. Spinning:
elastic points that change their tiles. */
enum class Motion { elastic, yielding, spinning };

/* across^dim points of steel on a square of 1 m in plane stress, 4 points a cell, or on a cube, 8 points a cell. scene.py has the
same in YADE. */
inline Scene block(int dim, int across, ShapeKind shape, Motion motion, int threads)
{
	Scene s;
	if (motion == Motion::yielding)
		s.laws = { Scene::boucWen(210e9, .3, 7850, 24e6, 10, .05), Scene::boucWen(210e9, .3, 7850, 2400e6, 10, .05) };
	else
		s.laws = { Scene::elastic(210e9, .3, 7850) };
	if (motion != Motion::spinning) s.walls = { Scene::wall(0, 1, 0, Wall::Kind::fixed) };
	const double spacing = 1. / across;
	s.addBox(dim, { 0, 0, 0 }, { 1, 1, 1 }, spacing);
	if (motion == Motion::yielding)
		for (std::size_t p = 0; p < s.points.count(); ++p)
			s.points.material[p] = s.points.position[1][p] > 1. / 3;
	s.start(dim == 3 ? Analysis::solid : Analysis::planeStress, shape, 2 * spacing);
	s.control.dt      = .2 * 2 * spacing / 5422;
	s.control.threads = threads;
	s.setVelocity([&](const std::array<double, 3>& x) -> std::array<double, 3> {
		if (motion == Motion::spinning) return { -300 * x[1], 300 * x[0], 0 };
		return { 1.5e-6 / s.control.dt * x[0], 0, 0 };
	});
	s.run(motion == Motion::spinning ? 3 : motion == Motion::yielding ? 150 : 10);
	return s;
}

} // namespace yade::mpm
