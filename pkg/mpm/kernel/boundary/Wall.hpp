// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <array>

namespace yade::mpm {

/* A half-space boundary normal to a coordinate axis. */
struct Wall {
	enum class Kind { fixed, slip, friction };
	int                   axis     = 0;
	int                   side     = 1; // +1: the material is on the side of growing coordinates
	double                position = 0; // of the plane, on its axis [m]
	Kind                  kind     = Kind::fixed;
	double                friction = 0;         // Coulomb coefficient
	std::array<double, 3> velocity { 0, 0, 0 }; // [m/s]
	std::array<double, 3> force { 0, 0, 0 };    // that the material exerts on the wall, in the last step [N]
};

} // namespace yade::mpm
