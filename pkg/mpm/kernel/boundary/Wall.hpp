// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <array>
#include <cmath>
#include <vector>

namespace yade::mpm {

/* A boundary of the material. Kinds fixed and slip are mirrors of the shape functions: half-spaces normal to a coordinate axis,
tied to the bodies at them. Kind friction is a contact of the points' surfaces with a plane of any direction, or with a part of one. */
struct Wall {
	using V = std::array<double, 3>;
	enum class Kind { fixed, slip, friction };
	int    axis     = 0;
	int    side     = 1; // +1: the material is on the side of growing coordinates
	double position = 0; // of the plane, on its axis [m]
	Kind   kind     = Kind::fixed;
	double friction = 0;         // Coulomb coefficient
	V      velocity { 0, 0, 0 }; // of the origin [m/s]
	V      force { 0, 0, 0 };    // that the material exerts on the wall, in the last step [N]

	// of a contact
	bool                oblique = false;             // the plane is given by normal and origin, not by axis, side and position
	V                   normal { 0, 0, 0 };          // unit vector into the material
	V                   origin { 0, 0, 0 };          // a point of the plane, about which it turns [m]
	V                   angularVelocity { 0, 0, 0 }; // [rad/s]
	V                   torque { 0, 0, 0 };          // about the origin, of what force is the resultant [Nm]
	std::vector<double> extent;                      // half sizes along the sides: none, all of the plane; one, a segment or a disk; two, a rectangle [m]
	V                   along { 0, 0, 0 };           // direction of the first side of a rectangle

	bool mirrors() const { return kind != Kind::friction; }

	/* The plane as normal and origin. */
	void setPlane()
	{
		if (oblique) return;
		normal = origin           = { 0, 0, 0 };
		normal[std::size_t(axis)] = side, origin[std::size_t(axis)] = position;
	}
};

} // namespace yade::mpm
