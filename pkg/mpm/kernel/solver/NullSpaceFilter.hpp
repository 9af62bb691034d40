// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "MpmSolver.hpp"

namespace yade::mpm {

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
