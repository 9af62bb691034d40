// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "RoundTrip.hpp"

namespace yade::mpm {

/* Angular velocities W_p (Rotation.hpp) of points that have velocities alone: new ones, and those whose velocity has been written from
outside. They are those that the nodes give back, W = W(S+ (v, W)), found by iteration: exact for a rigid rotation, and zero for a
translation after the first turn. A change of their energy is external work. At most `rounds` are made; the points stay marked, and the
next step goes on, if these have not been enough: so a script that writes velocities at every step costs no more than they. */
template <class D> void findRotation(D& d, const StepControl& control, int rounds)
{
	constexpr int    dim  = D::dim;
	constexpr double tiny = 1e-9;
	using S               = typename D::S;
	Points& P             = d.transfer.points;
	if constexpr (dim > 1) {
		NodeFields<S> sums;
		StepControl   still = control;
		still.dt            = 0; // without the terms in tau
		sums.resize(d.transfer.grid.nodeCount());
		sums.leastMass       = d.fields.leastMass;
		const double before  = P.energies.started ? spinEnergy(d.transfer) : 0;
		double       fastest = 0;
		for (std::size_t a = 0; a < std::size_t(dim); ++a)
			for (const double v : P.velocity[a])
				fastest = std::max(fastest, std::abs(v) / d.transfer.geometry.cell[a]);
		std::vector<double> changes(d.transfer.grid.tiles().size());
		bool                found = false;
		for (int round = 0; round < rounds && !found; ++round) {
			auto masses = [&](std::size_t t) { pointsToGrid<Sums::motion>(d.transfer, sums, still, t); };
			sumOverTiles(d.transfer, masses, sums.mass, sums.radialMass, sums.momentum);
			clear(d.transfer, sums.force);
			d.constraints.afterSums(sums.masses(), sums.momentum, sums.force, control.dt);
			divideByMass(d.transfer, sums, sums.momentum, sums.velocity);
			d.constraints.afterUpdate(sums.velocity, Motion::velocity);
			d.transfer.forEachTile([&](std::size_t t) {
				const auto&        tile = d.transfer.grid.tiles()[t];
				typename D::Values v[dim];
				changes[t] = 0;
				for (int a = 0; a < dim; ++a)
					D::Patch::read(tile, sums.velocity[a], v[a]);
				for (std::size_t p = tile.begin; p < tile.end; ++p) {
					if (!P.spinUnknown[p]) continue;
					const auto w = d.transfer.weights(tile, p);
					double     u[dim], W[turns<dim>];
					gatherMotion(w, Arms<dim, typename D::Shape>(w, d.transfer.geometry.cell), v, u, W);
					for (std::size_t k = 0; k < std::size_t(turns<dim>); ++k) {
						changes[t]              = std::max(changes[t], std::abs(W[k] - P.angularVelocity[k][p]));
						P.angularVelocity[k][p] = W[k];
					}
				}
			});
			found = *std::max_element(changes.begin(), changes.end()) <= tiny * fastest;
		}
		if (P.energies.started) P.energies.external += before - spinEnergy(d.transfer);
		if (!found) return;
	}
	P.spinUnknown.clear();
}

} // namespace yade::mpm
