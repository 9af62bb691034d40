// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "../Points.hpp"
#include <array>
#include <cmath>

namespace yade::mpm {

/* From a point to its surface, on the side that faces -n.

A point of a lattice stands for a box of its size, deformed by F: the place is the box's corner, edge or face that lies farthest
along -n. Between a face and its edges the place moves within `flat` of tilt, lest it jump from edge to edge of a face that lies
flat. A point with a reach stands for a sphere of that radius instead: the distance from the point to the surface of the body
that was filled, which a lattice follows in stairs only. round: a sphere of half the size stands for the box, whose corners would
count twice where two boxes face each other. */
template <int dim> std::array<double, dim> leverToSurface(const Points& points, std::size_t p, const std::array<double, dim>& n, bool round = false)
{
	constexpr double        flat = .05;
	std::array<double, dim> along {}, lever {}; // along: F^T n
	double                  norm2 = 0;
	for (std::size_t k = 0; k < dim; ++k) {
		for (std::size_t d = 0; d < dim; ++d)
			along[k] += points.deformation[d * dim + k][p] * n[d];
		norm2 += along[k] * along[k];
	}
	if (!(norm2 > 0)) return lever;
	const double norm = std::sqrt(norm2), given = points.reach.empty() ? 0 : points.reach[p], reach = round && !(given > 0) ? .5 * points.size[p] : given;
	for (std::size_t k = 0; k < dim; ++k) {
		const double step = reach > 0 ? reach * along[k] / norm : .5 * points.size[p] * std::min(std::max(along[k] / (flat * norm), -1.), 1.);
		for (std::size_t d = 0; d < dim; ++d)
			lever[d] -= points.deformation[d * dim + k][p] * step;
	}
	return lever;
}

} // namespace yade::mpm
