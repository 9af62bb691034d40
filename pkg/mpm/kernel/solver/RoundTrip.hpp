// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "MpmSolver.hpp"

namespace yade::mpm {

/* From the nodes to the points and back, Q of doc/method.md, and what walls take of it. */

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

} // namespace yade::mpm
