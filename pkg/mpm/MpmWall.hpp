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

	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS_CTOR_PY(MpmWall, Serializable, "Half-space boundary of :yref:`MpmEngine`, normal to a coordinate axis. The shape functions are folded about its plane (a node behind the wall is the mirror image of one in front of it), which keeps their order of accuracy at the wall. The grid is laid so that the wall lies on nodes.",
		((Vector3r, origin, Vector3r::Zero(), , "A point of the plane [m]. A moving wall carries it along."))
		((Vector3r, normal, Vector3r(NaN, NaN, NaN), Attr::triggerPostLoad, "Normal [-], into the material, along a coordinate axis: (1,0,0) is a wall on the left of it. Mandatory."))
		((std::string, kind, "fixed", , "'fixed': no motion relative to the wall; 'slip': none through it, free along it, and no separation; 'friction': a contact that presses, separates freely and slides under Coulomb's law."))
		((Real, friction, 0, , "Coefficient of friction, >= 0 [-], of kind 'friction'."))
		((Vector3r, velocity, Vector3r::Zero(), , "Velocity [m/s] that the wall imposes; its normal part moves the plane, its tangential part drags material of kinds 'fixed' and 'friction'."))
		((Vector3r, force, Vector3r::Zero(), Attr::readonly, "Force that the material exerted on the wall in the last step [N]."))
		,/*ctor*/,
		.def(AsWritten())
	);
	// clang-format on

private:
	void checkNormal(const std::string& name) const;
};
REGISTER_SERIALIZABLE(MpmWall);

} // namespace yade
