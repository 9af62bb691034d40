// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "AsWritten.hpp"
#include "kernel/Traction.hpp"
#include "kernel/solver/Solver.hpp"
#include <lib/serialization/Serializable.hpp>

namespace boost::serialization {
template <class Archive> void serialize(Archive& archive, yade::mpm::Traction& face, const unsigned int)
{
	const char* const axes[4][3] = { { "x", "y", "z" }, { "X", "Y", "Z" }, { "ax", "ay", "az" }, { "tx", "ty", "tz" } };
	for (std::size_t d = 0; d < 3; ++d) {
		archive& make_nvp(axes[0][d], face.position[d]) & make_nvp(axes[1][d], face.reference[d]);
		archive& make_nvp(axes[2][d], face.area[d]) & make_nvp(axes[3][d], face.field[d]);
	}
	archive& make_nvp("weight", face.weight) & make_nvp("pressureField", face.pressureField);
	for (std::size_t d = 0; d < 3; ++d)
		archive& make_nvp("resultant", face.resultant[d]);
}
} // namespace boost::serialization

namespace yade {

class MpmTraction : public Serializable {
public:
	/* Sets the face's load at a time; throws on attributes that an analysis cannot have. number tells the traction in complaints. */
	void load(std::size_t number, mpm::Analysis analysis, Real time);

	void postLoad(MpmTraction&);

	Vector3r              force() const;
	Vector3r              displacement() const;
	Real                  area() const;
	std::vector<Vector3r> position() const;
	std::vector<Real>     weights() const { return face.weight; }

	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS_CTOR_PY(MpmTraction, Serializable, "Load on a face of the material points, integrated on the face itself by massless points that move with the body: made by :yref:`mpm.traction` and kept with the scene. Attributes may be changed between steps.",
		((Vector3r, traction, Vector3r::Zero(), , "Force an undeformed area [Pa]; it keeps its direction. Added to what mpm.traction was given as a function of position."))
		((Real, pressure, 0, , "Force a current area, against the outward normal of the deformed face [Pa]. Added to what mpm.traction was given as a function of position."))
		((std::vector<Real>, times, , , "Times [s] at which the load is given by factors, increasing; empty: constant."))
		((std::vector<Real>, factors, , , "Factor on the load [-] at each of times: linear between them, constant before the first and after the last."))
		((bool, dead, false, , "True: the face is not loaded; its points go on moving with the body."))
		((mpm::Traction, face, , Attr::hidden, "Quadrature points of the face"))
		((int, kind, 0, Attr::hidden, "0: of a solid, 1: of a plane problem, 2: of rings"))
		,/*ctor*/,
		.def(AsWritten())
		.add_property("force", &MpmTraction::force, "Resultant of the load in the last step [N].")
		.add_property("displacement", &MpmTraction::displacement, "Displacement of the face since it was made, averaged over its undeformed area [m]: the work of a uniform dead load is its resultant times this.")
		.add_property("area", &MpmTraction::area, "Undeformed area [m2].")
		.add_property("position", &MpmTraction::position, "Positions of the face's quadrature points [m].")
		.add_property("weights", &MpmTraction::weights, "Undeformed areas of the face's quadrature points [m2].")
	);
	// clang-format on
};
REGISTER_SERIALIZABLE(MpmTraction);

} // namespace yade
