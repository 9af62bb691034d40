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

/* (m v)_i = sum N_ip m_p v_p, of the points' velocities or, with v, of those that the nodal field v has there. */
template <class S, class Shape> void MpmSolver<S, Shape>::spreadVelocities(const NodeVector<dim>* v, NodeVector<dim>& momentum)
{
	for (Column& c : momentum)
		c.resize(m_mass.size());
	clear(momentum);
	forEachTile([&](std::size_t t) { run(m_instructions, [&, this] { spreadTileVelocities(m_grid.tiles()[t], v, momentum); }); });
}
template <class S, class Shape> void MpmSolver<S, Shape>::spreadTileVelocities(const Tile& tile, const NodeVector<dim>* v, NodeVector<dim>& momentum) const
{
	Patch field[dim], mv[dim] {};
	for (int d = 0; v && d < dim; ++d)
		read(tile, (*v)[d], field[d]);
	forEachBlock(tile.begin, tile.end, [&](Block block) {
		Lanes       x[dim], mp, mvp[dim];
		WeightLanes w;
		loadMotion(block, x, mp, mvp);
		weights(tile, block, x, w);
		for (int d = 0; v && d < dim; ++d)
			for (int l = 0; l < block.count; ++l)
				mvp[d][l] = mp[l] * gather(w[l], field[d]);
		spreadMomentum(w, block, mvp, mv);
	});
	for (int d = 0; d < dim; ++d)
		add(tile, mv[d], momentum[d]);
}

template <class S, class Shape> void MpmSolver<S, Shape>::subtractRoundTrip(NodeVector<dim>& v, const NodeVector<dim>& trip) const
{
	forEachNodeRange([&](std::size_t begin, std::size_t end) {
		for (int d = 0; d < dim; ++d) {
			double*       to   = v[d].data();
			const double* from = trip[d].data();
#pragma omp simd
			for (std::size_t i = begin; i < end; ++i)
				to[i] = 2 * to[i] - from[i];
		}
	});
}
/* v <- (2 - Q) v; trip is overwritten. */
template <class S, class Shape> void MpmSolver<S, Shape>::correct(NodeVector<dim>& v, NodeVector<dim>& trip, bool moving)
{
	spreadVelocities(&v, trip);
	fromMomentum(trip, moving);
	subtractRoundTrip(v, trip);
}

/* Adds to the walls' reactions `rate` times what they take of the momentum that the points have brought to the nodes, kept before folding, where
it makes velocities v. Returns the work on the walls in the step. */
template <class S, class Shape> double MpmSolver<S, Shape>::addTaken(const NodeVector<dim>& v, double rate)
{
	const std::vector<Wall> before = m_walls;
	m_band.addTaken(m_walls, v, rate);
	double work = 0;
	for (std::size_t k = 0; k < before.size(); ++k)
		for (std::size_t d = 0; d < 3; ++d)
			work += (m_walls[k].force[d] - before[k].force[d]) * m_walls[k].velocity[d] * m_control.dt;
	return work;
}
/* From such momentum to velocities, with its part in the reactions. */
template <class S, class Shape> double MpmSolver<S, Shape>::reflect(NodeVector<dim>& v, bool moving, double rate)
{
	m_band.keepMomentum(v);
	fromMomentum(v, moving);
	return addTaken(v, rate);
}

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

/* Velocities that the grid does not see, (1 - S S+)^2 v_p (XPIC(2): Hammerquist & Nairn, CMAME 318 (2017) 724), less a part of them. At a wall
that takes momentum, which is in its reaction. */
template <class S, class Shape> void MpmSolver<S, Shape>::filterVelocities()
{
	const double    before = m_control.trackEnergy ? kineticEnergy() : 0, rate = m_control.filter / m_control.dt;
	NodeVector<dim> seen, trip;
	spreadVelocities(nullptr, seen);
	double work = reflect(seen, true, rate);
	spreadVelocities(&seen, trip);
	work += reflect(trip, true, -rate);
	subtractRoundTrip(seen, trip);
	forEachTile([&](std::size_t t) {
		const Tile& tile = m_grid.tiles()[t];
		Patch       v[dim];
		for (int d = 0; d < dim; ++d)
			read(tile, seen[d], v[d]);
		for (std::size_t p = tile.begin; p < tile.end; ++p) {
			const Weights w = weights(tile, p);
			for (int d = 0; d < dim; ++d)
				if (m_points.fixed.empty() || !(m_points.fixed[p] >> d & 1))
					m_points.velocity[d][p] += m_control.filter * (gather(w, v[d]) - m_points.velocity[d][p]);
		}
	});
	if (!m_control.trackEnergy) return;
	const double lost = before - kineticEnergy() - work;
	for (Energies* energies : { &m_points.energies, &m_points.upcoming })
		energies->damping += .5 * lost, energies->walls += .5 * work;
}

} // namespace yade::mpm
