// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "NodeFields.hpp"
#include "Solver.hpp"
#include "TileReport.hpp"

namespace yade::mpm {

/* Eq. 15:  v_p += sum N_ip dt a_i (FLIP; the part 1 - flip of it is PIC, v_p = sum N_ip v_i),
displacement increment dt sum N_ip v_i.

MUSL's second mapping goes with it: (m v)_i = sum N_ip m_p v_p with the new velocities. */

namespace detail {
	/* New velocities, momenta and displacement increments along an axis; whether a point leaves the tile. */
	template <class D>
	bool movePoints(D& d, const typename D::Tile& tile, Block block, int axis, double dt, double flip, const Lanes& x, const Lanes& mp, const Lanes& vp,
		const Lanes& dvp, Lanes& mvp)
	{
		constexpr double infinity = std::numeric_limits<double>::infinity();
		using Shape               = typename D::Shape;
		using Grid                = typename D::T::Grid;
		Points&           P       = d.transfer.points;
		const auto&       g       = d.transfer.geometry;
		const std::size_t k       = std::size_t(axis);
		const double      origin = g.origin[k], cell = g.cell[k], lower = g.xiMin[k], upper = g.xiMax[k], corner = tile.index[k] * Grid::width;
		Lanes             velocity, increment, r {};
		load(P.velocity[k], block, velocity);
		const Lanes old = velocity;
		if (Shape::usesSize) load(P.size, block, r);
		forLanes([&](int l) { increment[l] = dt * vp[l]; });
		if (flip == 1)
			forLanes([&](int l) { velocity[l] += dvp[l]; });
		else
			forLanes([&](int l) { velocity[l] = flip * (velocity[l] + dvp[l]) + (1 - flip) * vp[l]; });
		for (int l = 0; !P.prescribedDofs.empty() && l < block.count; ++l)
			if (P.prescribedDofs[block.first + std::size_t(l)] >> axis & 1) velocity[l] = old[l], increment[l] = dt * old[l];
		int inside = 1;
#pragma omp simd reduction(& : inside)
		for (int l = 0; l < lanes; ++l) {
			const double xi = (x[l] + increment[l] - origin) / cell, inTile = xi - Shape::shift(.5 * r[l] / cell) - corner;
			mvp[l] = mp[l] * velocity[l];
			inside &= (inTile >= 0) & (inTile < Grid::width) & (xi >= lower) & (xi <= upper) & (std::abs(velocity[l]) < infinity);
		}
		store(velocity, block, P.velocity[k]);
		store(increment, block, P.displacementIncrement[k]);
		return !inside;
	}

	template <bool remap, class D> bool moveTile(D& d, const typename D::Tile& tile, double dt, double flip)
	{
		constexpr int      dim = D::dim;
		const Points&      P   = d.transfer.points;
		typename D::Values v[dim], dv[dim], mv[dim] {};
		for (int a = 0; a < dim; ++a)
			D::Patch::read(tile, d.fields.velocity[a], v[a]), D::Patch::read(tile, d.fields.velocityIncrement[a], dv[a]);
		bool left = false;
		forEachBlock(tile.begin, tile.end, [&](Block block) {
			Lanes                               x[dim], mp, mvp[dim], vp[dim], dvp[dim];
			WeightLanes<dim, typename D::Shape> w;
			for (int a = 0; a < dim; ++a)
				load(P.position[std::size_t(a)], block, x[a]);
			d.transfer.weights(tile, block, x, w);
			for (int l = 0; l < lanes; ++l) {
				const int from = std::min(l, block.count - 1);
				for (int a = 0; a < dim; ++a)
					vp[a][l] = w[from].gather(v[a]), dvp[a][l] = w[from].gather(dv[a]);
			}
			load(P.mass, block, mp);
			for (int a = 0; a < dim; ++a)
				left |= movePoints(d, tile, block, a, dt, flip, x[a], mp, vp[a], dvp[a], mvp[a]);
			if (remap) spreadMomentum<dim, typename D::Shape>(w, block, mvp, mv);
		});
		if (remap)
			for (int a = 0; a < dim; ++a)
				D::Patch::add(tile, mv[a], d.fields.momentum[a]);
		return left;
	}
} // namespace detail

/* Moves a tile's points, as far as their velocities and displacement increments; remap adds their momenta to the fields. */
template <bool remap, class D> void gridToPoints(D& d, double dt, double flip, std::size_t t, TileReport& report)
{
	run(d.transfer.instructions, [&, t] { report.left = detail::moveTile<remap>(d, d.transfer.grid.tiles()[t], dt, flip); });
}

} // namespace yade::mpm
