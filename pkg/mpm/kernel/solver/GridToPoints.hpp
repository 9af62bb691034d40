// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "../transfer/Rotation.hpp"
#include "NodeFields.hpp"
#include "Solver.hpp"
#include "TileReport.hpp"

namespace yade::mpm {

/* Eq. 15:  v_p += sum N_ip dt a_i (FLIP; the part 1 - flip of it is PIC, v_p = sum N_ip v_i),
displacement increment dt sum N_ip v_i.

MUSL's second mapping goes with it: (m v)_i = sum N_ip m_p v_p with the new velocities.

With the affine transfer (Rotation.hpp) W_p takes its part of the increments likewise. A point with a prescribed component takes no increment,
and turns with the velocities that the nodes had before. Where the stress update follows the step, the points move with the velocities that
strain them (StressUpdate.hpp); else with v_i. */

/* Whether the points move in the pass that updates their stress: that of a later step of USF does not. */
inline bool movesWithStrain(const Points& points, Scheme scheme) { return !points.angularVelocity.empty() && scheme != Scheme::usf; }

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

	/* Velocities and angular velocities that the nodal increments dv, and where `both` the velocities v, give to a lane's point. */
	template <class D>
	void gatherLane(const D& d, const typename D::Weights& w, int l, bool both, const typename D::Values (&v)[D::dim],
		const typename D::Values (&dv)[D::dim], Lanes (&vp)[D::dim], Lanes (&dvp)[D::dim], Lanes (&Wp)[turns<D::dim>], Lanes (&dWp)[turns<D::dim>])
	{
		constexpr int                      dim = D::dim;
		const Arms<dim, typename D::Shape> arms(w, d.transfer.geometry.cell);
		double                             u[dim], W[turns<dim>];
		gatherMotion(w, arms, dv, u, W);
		for (int a = 0; a < dim; ++a)
			dvp[a][l] = u[a];
		for (int k = 0; k < turns<dim>; ++k)
			dWp[k][l] = W[k];
		if (!both) return;
		gatherMotion(w, arms, v, u, W);
		for (int a = 0; a < dim; ++a)
			vp[a][l] = u[a];
		for (int k = 0; k < turns<dim>; ++k)
			Wp[k][l] = W[k];
	}
	/* New angular velocities of a block. */
	template <class D> void turnPoints(D& d, Block block, double flip, const Lanes (&Wp)[turns<D::dim>], const Lanes (&dWp)[turns<D::dim>])
	{
		Points& P = d.transfer.points;
		for (int k = 0; k < turns<D::dim>; ++k) {
			Lanes  W;
			Field& column = P.angularVelocity[std::size_t(k)];
			load(column, block, W);
			if (flip == 1)
				forLanes([&](int l) { W[l] += dWp[k][l]; });
			else
				forLanes([&](int l) { W[l] = flip * (W[l] + dWp[k][l]) + (1 - flip) * Wp[k][l]; });
			for (int l = 0; !P.prescribedDofs.empty() && l < block.count; ++l)
				if (P.prescribedDofs[block.first + std::size_t(l)]) W[l] = Wp[k][l] - dWp[k][l];
			store(W, block, column);
		}
	}

	template <bool remap, bool affine, class D> bool moveTile(D& d, const typename D::Tile& tile, double dt, double flip, bool moves)
	{
		constexpr int      dim = D::dim;
		const Points&      P   = d.transfer.points;
		typename D::Values v[dim], dv[dim], mv[dim] {};
		for (int a = 0; a < dim; ++a)
			D::Patch::read(tile, d.fields.velocity[a], v[a]), D::Patch::read(tile, d.fields.velocityIncrement[a], dv[a]);
		bool                  left = false;
		[[maybe_unused]] bool both = affine && (moves || flip < 1 || !P.prescribedDofs.empty()); // v is needed beside dv
		forEachBlock(tile.begin, tile.end, [&](Block block) {
			Lanes                               x[dim], mp, mvp[dim], vp[dim] {}, dvp[dim];
			[[maybe_unused]] Lanes              Wp[affine ? turns<dim> : 1] {}, dWp[affine ? turns<dim> : 1];
			WeightLanes<dim, typename D::Shape> w;
			for (int a = 0; a < dim; ++a)
				load(P.position[std::size_t(a)], block, x[a]);
			d.transfer.weights(tile, block, x, w);
			for (int l = 0; l < lanes; ++l) {
				const int from = std::min(l, block.count - 1);
				if constexpr (affine)
					gatherLane(d, w[from], l, both, v, dv, vp, dvp, Wp, dWp);
				else
					for (int a = 0; a < dim; ++a)
						vp[a][l] = w[from].gather(v[a]), dvp[a][l] = w[from].gather(dv[a]);
			}
			load(P.mass, block, mp);
			if constexpr (affine) turnPoints(d, block, flip, Wp, dWp);
			for (int a = 0; a < dim; ++a)
				left |= movePoints(d, tile, block, a, moves ? dt : 0, flip, x[a], mp, vp[a], dvp[a], mvp[a]);
			if constexpr (remap && affine)
				for (int l = 0; l < block.count; ++l) {
					RotationRows<dim, typename D::Shape> rotation;
					double                               momentum[dim];
					rotation.set(P, block, l, w[l], d.transfer.geometry.cell, mp[l], .5 * dt);
					for (int a = 0; a < dim; ++a)
						momentum[a] = mvp[a][l];
					spreadAffineMomentum(w[l], momentum, rotation, mv);
				}
			else if (remap)
				spreadMomentum<dim, typename D::Shape>(w, block, mvp, mv);
		});
		if (remap)
			for (int a = 0; a < dim; ++a)
				D::Patch::add(tile, mv[a], d.fields.momentum[a]);
		return left;
	}
} // namespace detail

/* Moves a tile's points, as far as their velocities and displacement increments; remap adds their momenta to the fields. */
template <bool remap, class D> void gridToPoints(D& d, const StepControl& control, double flip, std::size_t t, TileReport& report)
{
	const double dt = control.dt;
	if constexpr (D::dim > 1)
		if (!d.transfer.points.angularVelocity.empty()) {
			const bool moves = !movesWithStrain(d.transfer.points, control.scheme);
			return run(d.transfer.instructions,
				[&, t] { report.left = detail::moveTile<remap, true>(d, d.transfer.grid.tiles()[t], dt, flip, moves); });
		}
	run(d.transfer.instructions, [&, t] { report.left = detail::moveTile<remap, false>(d, d.transfer.grid.tiles()[t], dt, flip, true); });
}

} // namespace yade::mpm
