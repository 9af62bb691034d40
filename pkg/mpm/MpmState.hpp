// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "MpmPoints.hpp"
#include <core/State.hpp>

namespace yade {

/* State of a body that stands for a material point. Position and velocity are the body's own, written by MpmEngine after
each step and read by it before; the rest is fetched from the points' arrays when asked for. */
class MpmState : public State {
public:
	/* NewtonIntegrator leaves bodies outside of the scene's own subdomain (0) alone, and the collider makes no contact between two of them,
	while their contacts with other bodies and the forces on them work as usual. No process of yade.mpy has a negative number. */
	static constexpr int subdomainOfPoints = -1;

	Matrix3r stress() const { return read(&MpmPoints::stress); }
	Matrix3r strain() const { return read(&MpmPoints::strain); }
	Matrix3r backStress() const { return read(&MpmPoints::backStress); }
	Matrix3r deformation() const { return read(&MpmPoints::deformation); }
	Real     plasticStrain() const { return read(&MpmPoints::plasticStrain); }
	Real     volume() const { return read(&MpmPoints::volume); }

	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS_CTOR_PY(MpmState, State, "State of a material point of :yref:`MpmEngine`. Made by :yref:`mpm.fill`. Position, velocity and blockedDOFs may be written between steps, as with any body; a blocked translation prescribes the point's velocity. While the point touches a grain, vel is the velocity with which it moves and angVel the spin of the material around it, as the contact must see them; its own velocity, from which momentum is summed, is mpm.array('velocity').",
		((shared_ptr<MpmPoints>, points, , Attr::hidden, "Where the point's state is"))
		((int, pointId, -1, (Attr::readonly | Attr::hidden), "Id of the point"))
		,
		createIndex();
		,
		.add_property("stress", &MpmState::stress, "Cauchy stress [Pa], 3x3, tension positive. In axisymmetry x is radial, y axial and z circumferential.")
		.add_property("strain", &MpmState::strain, "Strain [-], 3x3 with tensorial shear: logarithmic, ln(F F^T)/2, in large strain, the sum of the increments sym(grad v) dt in small strain. In plane stress zz is the accumulated strain of the free normal.")
		.add_property("backStress", &MpmState::backStress, "Back stress [Pa] of the material's law, 3x3 (zero for an elastic material). In plane stress it stands in the subspace with zero zz: the relative stress is stress - backStress.")
		.add_property("F", &MpmState::deformation, "Deformation gradient [-], 3x3. In plane stress its zz is the stretch of the thickness, 1 unless MpmEngine.thinning; in axisymmetry zz is the hoop stretch.")
		.add_property("plasticStrain", &MpmState::plasticStrain, "Accumulated equivalent plastic strain [-], the integral of sqrt(2/3 e_p:e_p).")
		.add_property("volume", &MpmState::volume, "Current volume [m3].")
	);
	// clang-format on
	REGISTER_CLASS_INDEX(MpmState, State);

private:
	template <class T> T read(T (MpmPoints::*quantity)(std::size_t) const) const
	{
		if (!points) throw std::runtime_error("MpmState: this state belongs to no material point; material points are made by mpm.fill()");
		const std::lock_guard<std::mutex> lock(points->mutex);
		points->finish();
		return ((*points).*quantity)(points->indexOf(pointId));
	}
};
REGISTER_SERIALIZABLE(MpmState);

} // namespace yade
