// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "../transfer/Turns.hpp"
#include "NodeFields.hpp"
#include "Solver.hpp"
#include "TileReport.hpp"

namespace yade::mpm {

/* Points in contact with other bodies of YADE: they exchange torques as well as forces, and move with the velocities that
strain the material. */

/* Torques: f_i += T_p x grad N_ip / 2, which has no resultant, the moment T_p and the power T_p . spin. */
template <int dim, class Shape> void spreadTorques(const Transfer<dim, Shape>& transfer, std::size_t t, NodeVector<dim>& force)
{
	using T                  = Transfer<dim, Shape>;
	const auto&        tile  = transfer.grid.tiles()[t];
	const Points&      P     = transfer.points;
	bool               found = false;
	typename T::Values f[dim];
	for (std::size_t p = tile.begin; p < tile.end; ++p) {
		if (!P.inContact[p]) continue;
		for (int d = 0; d < dim && !found; ++d)
			std::fill(std::begin(f[d]), std::end(f[d]), 0.);
		found = true;
		transfer.weights(tile, p).forEachNode([&](int i, double, const std::array<double, dim>& grad) {
			for (int k = 0; k < turns<dim>; ++k) {
				const double half = .5 * P.torque[std::size_t(k)][p];
				f[turnsTo<dim>(k)][i] += half * grad[turnsFrom<dim>(k)];
				f[turnsFrom<dim>(k)][i] -= half * grad[turnsTo<dim>(k)];
			}
		});
	}
	for (int d = 0; d < dim && found; ++d)
		T::Patch::add(tile, f[d], force[d]);
}

/* Points in contact move with the nodal velocities that the stress sees, and turn with the material: spin = curl v / 2. A
contact's force follows the points' motion; any other velocity would lose energy (doc/method.md). */
template <class D> void moveContactPoints(D& d, double dt, std::size_t t, TileReport& report)
{
	constexpr int dim         = D::dim;
	using Shape               = typename D::Shape;
	const auto&        tile   = d.transfer.grid.tiles()[t];
	const auto&        g      = d.transfer.geometry;
	Points&            P      = d.transfer.points;
	bool               loaded = false;
	typename D::Values v[dim];
	for (std::size_t p = tile.begin; p < tile.end; ++p) {
		if (!P.inContact[p]) continue;
		for (int a = 0; a < dim && !loaded; ++a)
			D::Patch::read(tile, d.fields.velocity[a], v[a]);
		loaded       = true;
		const auto w = d.transfer.weights(tile, p);
		double     grad[dim][dim];
		for (int a = 0; a < dim; ++a)
			w.gatherGradient(v[a], grad[a]);
		for (int k = 0; k < turns<dim>; ++k) {
			const int from = turnsFrom<dim>(k), to = turnsTo<dim>(k);
			P.spin[std::size_t(k)][p] = .5 * (grad[to][from] - grad[from][to]);
		}
		for (std::size_t a = 0; a < std::size_t(dim); ++a) {
			const bool fixed        = !P.prescribedDofs.empty() && P.prescribedDofs[p] >> a & 1;
			P.contactVelocity[a][p] = fixed ? P.velocity[a][p] : w.gather(v[a]);
			if (fixed) continue;
			P.displacementIncrement[a][p] = dt * P.contactVelocity[a][p];
			const double xi               = g.xi(int(a), P.position[a][p] + P.displacementIncrement[a][p]);
			const double inTile           = xi - Shape::shift(d.transfer.halfSize(int(a), p)) - tile.index[a] * D::T::Grid::width;
			report.left |= !(inTile >= 0 && inTile < D::T::Grid::width && xi >= g.xiMin[a] && xi <= g.xiMax[a]);
		}
	}
}

} // namespace yade::mpm
