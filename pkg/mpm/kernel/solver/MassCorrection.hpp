// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "GridToPoints.hpp"
#include "RoundTrip.hpp"

namespace yade::mpm {

/* Second-order mass correction: the idea of FMPM(2) (Nairn & Hammerquist, CMAME 377 (2021) 113667), here for FLIP.

With S = N^T from the nodes to the points, S+ = M^-1 N m from the points to the nodes and Q = S+ S, the lumped mass M makes
S+ a smoothing: points that move with S u bring Q u to the nodes. With the full mass N m S = M Q they would bring Q^-1 Q u = u. To second order
in 1 - Q, Q^-1 = 2 - Q:

  v_p += S (2 - Q) dt a,    v = (2 - Q) S+ v_p,    x_p += dt S v, and stress with v,

one round trip more for each 2 - Q. Frequencies, Q of the true ones with the lumped mass, become Q (2 - Q) = 1 - (1 - Q)^2 of
them: off by order four in the cell size, not two. Q is self-adjoint, so that the step stays a leapfrog without
dissipation. With flip < 1 PIC's part is S (2 - Q) (S+ v_p + dt a), FMPM(2). */

inline bool correctsMass(const StepControl& control) { return control.fullMass && control.scheme == Scheme::musl; }

/* v <- (2 - Q) v. Qv is scratch, tau that of Rotation.hpp. */
template <class D> void correctMass(D& d, NodeVector<D::dim>& v, NodeVector<D::dim>& Qv, Motion motion, double tau = 0)
{
	spreadVelocities(d.transfer, &v, Qv, rotates(d), tau);
	velocityFromMomentum(d, Qv, Qv, motion);
	subtractRoundTrip(d.transfer, v, Qv);
}

/* Work on moving walls [J] of what the correction and PIC add to their reactions in a step. */
struct AddedWallWork {
	double correction = 0, pic = 0;
};

/* Of the increments of eq. 14, between the update of the nodes and eq. 15. The walls' reactions were those of a. */
template <class D> AddedWallWork correctIncrements(D& d, const StepControl& control, NodeVector<D::dim>& Qv)
{
	const double  flip = control.flip, over = 1 / control.dt;
	AddedWallWork work;
	spreadVelocities(d.transfer, &d.fields.velocityIncrement, Qv, rotates(d));
	work.correction = projectWithReactions(d, Qv, Motion::increment, -flip * over, control.dt);
	subtractRoundTrip(d.transfer, d.fields.velocityIncrement, Qv);
	if (flip == 1) return work;
	spreadVelocities(d.transfer, &d.fields.velocity, Qv, rotates(d), .5 * control.dt);
	work.pic = projectWithReactions(d, Qv, Motion::velocity, -(1 - flip) * over, control.dt);
	subtractRoundTrip(d.transfer, d.fields.velocity, Qv);
	return work;
}
/* Of MUSL's second mapping; the points' displacement increments are made anew. */
template <class D> void correctVelocities(D& d, const StepControl& control, NodeVector<D::dim>& Qv, std::vector<TileReport>& reports)
{
	correctMass(d, d.fields.velocity, Qv, Motion::velocity, .5 * control.dt);
	if (rotates(d)) return; // they come with the strain
	clear(d.transfer, d.fields.velocityIncrement);
	d.transfer.forEachTile([&](std::size_t t) { gridToPoints<false>(d, control, 1, t, reports[t]); });
}

} // namespace yade::mpm
