// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace yade::mpm {

/* A load on a face of the body, at massless points that move with it: quadrature points of the face. A dead traction acts on the
undeformed area and keeps its direction; a pressure acts on the current area against its normal. */
struct Traction {
	using Column  = std::vector<double>;
	using Columns = std::array<Column, 3>;
	Columns               position;              // [m]
	Columns               reference;             // position at the start [m]
	Columns               area;                  // area times outward normal, of a ring the full circle's [m2]
	Column                weight;                // undeformed area [m2]
	Columns               field;                 // traction that differs from point to point [Pa], or empty
	Column                pressureField;         // likewise of the pressure
	std::array<double, 3> traction { 0, 0, 0 };  // on the undeformed area, in this step [Pa]
	double                pressure = 0;          // on the current one [Pa]
	double                factor   = 1;          // on field and pressureField
	std::array<double, 3> resultant { 0, 0, 0 }; // of the last step [N]

	std::size_t count() const { return weight.size(); }
	/* Force on a point of the face along an axis [N]. */
	double force(std::size_t k, std::size_t axis) const
	{
		const double t = traction[axis] + (field[axis].empty() ? 0 : factor * field[axis][k]);
		const double p = pressure + (pressureField.empty() ? 0 : factor * pressureField[k]);
		return weight[k] * t - p * area[axis][k];
	}
	/* Displacement of the face, averaged over its undeformed area: what a dead traction does work on [m]. */
	std::array<double, 3> displacement() const
	{
		std::array<double, 3> sum { 0, 0, 0 };
		double                total = 0;
		for (std::size_t k = 0; k < count(); ++k) {
			total += weight[k];
			for (std::size_t d = 0; d < 3; ++d)
				sum[d] += weight[k] * (position[d][k] - reference[d][k]);
		}
		for (double& s : sum)
			s /= total;
		return sum;
	}
};

} // namespace yade::mpm
