// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "RoundTrip.hpp"

namespace yade::mpm {

/* Null-space modes of the point velocities, (1 - S S+)^2 v_p (XPIC(2): Hammerquist & Nairn, CMAME 318 (2017) 724): the part
control.filter of them is removed, with the affine transfer of v_p and W_p together. At a wall they carry momentum, which goes into its reaction. */
template <class D> void filterVelocities(D& d, const StepControl& control)
{
	constexpr int   dim    = D::dim;
	Points&         P      = d.transfer.points;
	const double    before = control.trackEnergy ? kineticEnergy(d) : 0, rate = control.filter / control.dt, tau = .5 * control.dt;
	const bool      affine = rotates(d);
	NodeVector<dim> seen, trip;
	spreadVelocities(d.transfer, noField<dim>, seen, affine, tau);
	double work = projectWithReactions(d, seen, Motion::velocity, rate, control.dt);
	spreadVelocities(d.transfer, &seen, trip, affine, tau);
	work += projectWithReactions(d, trip, Motion::velocity, -rate, control.dt);
	subtractRoundTrip(d.transfer, seen, trip);
	d.transfer.forEachTile([&](std::size_t t) {
		const auto&        tile = d.transfer.grid.tiles()[t];
		typename D::Values v[dim];
		for (int a = 0; a < dim; ++a)
			D::Patch::read(tile, seen[a], v[a]);
		for (std::size_t p = tile.begin; p < tile.end; ++p) {
			const auto w = d.transfer.weights(tile, p);
			for (std::size_t a = 0; a < std::size_t(dim); ++a)
				if (P.prescribedDofs.empty() || !(P.prescribedDofs[p] >> a & 1))
					P.velocity[a][p] += control.filter * (w.gather(v[a]) - P.velocity[a][p]);
			if constexpr (dim > 1)
				if (affine && (P.prescribedDofs.empty() || !P.prescribedDofs[p])) {
					double u[dim], W[turns<dim>];
					gatherMotion(w, Arms<dim, typename D::Shape>(w, d.transfer.geometry.cell), v, u, W);
					for (std::size_t k = 0; k < std::size_t(turns<dim>); ++k)
						P.angularVelocity[k][p] += control.filter * (W[k] - P.angularVelocity[k][p]);
				}
		}
	});
	if (!control.trackEnergy) return;
	const double lost = before - kineticEnergy(d) - work;
	for (Energies* energies : { &P.energies, &P.upcoming })
		energies->damping += .5 * lost, energies->walls += .5 * work;
}

} // namespace yade::mpm
