// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "MpmSolver.hpp"

namespace yade::mpm {

/* The full mass matrix, approximated: the idea of FMPM(2) (Nairn & Hammerquist, CMAME 377 (2021) 113667), here for FLIP.

With S = N^T the way from the nodes to the points, S+ = M^-1 N m that from the points to the nodes and Q = S+ S, the lumped mass M makes
S+ a smoothing: points that move with S u bring Q u to the nodes. With the full mass N m S = M Q they would bring Q^-1 Q u = u. To second order
in 1 - Q, Q^-1 = 2 - Q:

  v_p += S (2 - Q) dt a,    v = (2 - Q) S+ v_p,    x_p += dt S v, and stress with v,

one way to the points and back more for each 2 - Q. Frequencies, Q of the true ones with the lumped mass, become Q (2 - Q) = 1 - (1 - Q)^2 of
them: off by order four in the cell size, not two. Q is self-adjoint, so that the step stays a leapfrog without
dissipation. With flip < 1 PIC's part is S (2 - Q) (S+ v_p + dt a), FMPM(2). */

/* Between the update of the nodes and step 3. The walls' reactions were those of a. */
template <class S, class Shape> void MpmSolver<S, Shape>::correctAccelerations()
{
	NodeVector<dim>& trip = m_velocity;
	spreadVelocities(&m_force, trip);
	const double flip = m_control.flip, over = 1 / m_control.dt;
	m_correctionWork = reflect(trip, false, -flip * over);
	subtractRoundTrip(m_force, trip);
	if (flip == 1) return;
	spreadVelocities(&m_momentum, trip);
	m_picWork += reflect(trip, true, -(1 - flip) * over);
	subtractRoundTrip(m_momentum, trip);
}
/* After step 4; the points' displacements are made anew. */
template <class S, class Shape> void MpmSolver<S, Shape>::correctVelocities()
{
	correct(m_velocity, m_momentum, true);
	m_momentum = m_velocity;
	clear(m_force);
	forEachTile([this](std::size_t t) { gridToPoints<false>(t, 1); });
}

} // namespace yade::mpm
