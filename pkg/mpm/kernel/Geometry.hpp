// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "boundary/Wall.hpp"
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

namespace yade::mpm {

/* Where the grid lies: node i of an axis is at origin + i cell. Mirror walls lie on nodes; xiMin and xiMax are theirs, or infinite. */
template <int dim> struct Geometry {
	std::array<double, dim> origin {}, cell {}, xiMin {}, xiMax {};

	bool   operator==(const Geometry& o) const { return origin == o.origin && cell == o.cell && xiMin == o.xiMin && xiMax == o.xiMax; }
	bool   operator!=(const Geometry& o) const { return !(*this == o); }
	double xi(int axis, double x) const { return (x - origin[axis]) / cell[axis]; }
};

/* Lays the grid through the walls that mirror it. Between two walls of one axis the cells are stretched to fit a whole number: cellSize
is then nominal, the true size within 1/(2n) of it for n cells. */
template <int dim> Geometry<dim> makeGeometry(double cellSize, const std::vector<Wall>& walls)
{
	constexpr double infinity = std::numeric_limits<double>::infinity();
	Geometry<dim>    g;
	for (int d = 0; d < dim; ++d) {
		const Wall *lower = nullptr, *upper = nullptr;
		for (const Wall& wall : walls)
			if (wall.mirrors() && wall.axis == d) (wall.side > 0 ? lower : upper) = &wall;
		g.cell[d]   = cellSize;
		g.origin[d] = lower ? lower->position : upper ? upper->position : 0;
		g.xiMin[d]  = lower ? 0 : -infinity;
		g.xiMax[d]  = upper ? 0 : infinity;
		if (lower && upper) {
			const double distance = upper->position - lower->position, cells = std::max(1., std::round(distance / cellSize));
			g.cell[d]  = distance / cells;
			g.xiMax[d] = cells;
		}
	}
	return g;
}

} // namespace yade::mpm
