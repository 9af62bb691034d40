// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "AsWritten.hpp"
#include "kernel/Geometry.hpp"
#include <lib/serialization/Serializable.hpp>

namespace yade {

class MpmWall : public Serializable {
public:
	/* The kernel's form; number tells the wall in complaints. dim: axes of the analysis. */
	mpm::Wall toKernel(std::size_t number, int dim) const;
	/* Refuses a normal that no wall can have as soon as it is given. */
	void postLoad(MpmWall&);
	/* The wall's own motion in a step. */
	void move(Real dt);

	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS_CTOR_PY(MpmWall, Serializable, "Boundary of :yref:`MpmEngine`. Kinds 'fixed' and 'slip' are half-spaces normal to a coordinate axis: a bond and a plane of symmetry, for bodies that touch them from the start. The shape functions are mirrored about the plane, which keeps their order of accuracy there, and the grid is laid so that the plane lies on nodes. Kind 'friction' is a contact with a plane of any direction, or with a part of one: it acts where and while the surface of a body touches it, and slides under Coulomb's law (doc/method.md).",
		((Vector3r, origin, Vector3r::Zero(), , "A point of the plane, of kind 'friction' the centre of its extent [m]. A moving wall carries it along."))
		((Vector3r, normal, Vector3r(NaN, NaN, NaN), Attr::triggerPostLoad, "Normal [-], into the material: (1,0,0) is a wall on the left of it. Along a coordinate axis for kinds 'fixed' and 'slip'; any direction (in a plane analysis in the plane) for kind 'friction'. Mandatory."))
		((std::string, kind, "fixed", , "'fixed': no motion relative to the wall; 'slip': none through it, free along it, and no separation; 'friction': a contact that presses, separates freely and slides under Coulomb's law."))
		((Real, friction, 0, , "Coefficient of friction, >= 0 [-], of kind 'friction'. Errors: with another kind."))
		((std::vector<Real>, extent, , , "Half sizes of the wall, of kind 'friction' [m]: empty, the whole plane; one, a segment (in a plane analysis) or a disk; two, a rectangle whose first side runs along :yref:`MpmWall.along`. A body touches the face from the side of the normal, and the edge from all sides."))
		((Vector3r, along, Vector3r::Zero(), , "Direction of the first side of a rectangular extent, normal to the wall's normal [-]."))
		((Vector3r, velocity, Vector3r::Zero(), , "Velocity [m/s] that the wall imposes, of the origin where it turns; its normal part moves the plane, its tangential part drags material of kinds 'fixed' and 'friction'."))
		((Vector3r, angularVelocity, Vector3r::Zero(), , "Angular velocity with which a wall of kind 'friction' turns about its origin [rad/s]; in a plane analysis about z."))
		((Vector3r, force, Vector3r::Zero(), Attr::readonly, "Force that the material exerted on the wall in the last step [N]."))
		((Vector3r, torque, Vector3r::Zero(), Attr::readonly, "Torque that the material exerted on the wall in the last step about the origin [Nm], of kind 'friction'."))
		,/*ctor*/,
		.def(AsWritten())
	);
	// clang-format on

private:
	void checkNormal(const std::string& name) const;
	void setMirror(mpm::Wall& wall, const std::string& name, const Vector3r& n) const;
	void setContact(mpm::Wall& wall, const std::string& name, const Vector3r& n, int dim) const;
};
REGISTER_SERIALIZABLE(MpmWall);

} // namespace yade
