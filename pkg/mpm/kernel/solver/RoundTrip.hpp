// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "NodeFields.hpp"
#include "PointsToGrid.hpp"

namespace yade::mpm {

/* Q of doc/method.md, the way of a nodal velocity to the points and back: shared by the mass correction and the null-space filter. With the
affine transfer the points carry rotation along; tau is that of Rotation.hpp. */

/* sum (m_p v_p^2 + J_p W_p^2)/2 [J]. */
template <class D> double kineticEnergy(const D& d) { return kineticEnergy<D::dim>(d.transfer.points) + spinEnergy(d.transfer); }

namespace detail {
	/* (m v)_i = sum N_ip m_p v_p: of the points' velocities, or of those that the nodal field v has at the points. */
	template <bool affine, int dim, class Shape>
	void spreadTileVelocities(const Transfer<dim, Shape>& transfer, std::size_t t, const NodeVector<dim>* v, NodeVector<dim>& momentum, double tau)
	{
		using T                 = Transfer<dim, Shape>;
		const auto&        tile = transfer.grid.tiles()[t];
		typename T::Values field[dim], mv[dim] {};
		for (int d = 0; v && d < dim; ++d)
			T::Patch::read(tile, (*v)[d], field[d]);
		forEachBlock(tile.begin, tile.end, [&](Block block) {
			Lanes                   x[dim], mp, mvp[dim];
			WeightLanes<dim, Shape> w;
			loadMotion(transfer.points, block, x, mp, mvp);
			transfer.weights(tile, block, x, w);
			if constexpr (affine) {
				for (int l = 0; l < block.count; ++l) {
					const Arms<dim, Shape>   arms(w[l], transfer.geometry.cell);
					RotationRows<dim, Shape> rotation;
					double                   u[dim], W[turns<dim>];
					if (v) gatherMotion(w[l], arms, field, u, W);
					for (int d = 0; d < dim; ++d)
						u[d] = v ? mp[l] * u[d] : mvp[d][l];
					if (v)
						rotation.set(arms, mp[l], W, tau);
					else
						rotation.set(transfer.points, block, l, w[l], transfer.geometry.cell, mp[l], tau);
					spreadAffineMomentum(w[l], u, rotation, mv);
				}
			} else {
				for (int d = 0; v && d < dim; ++d)
					for (int l = 0; l < block.count; ++l)
						mvp[d][l] = mp[l] * w[l].gather(field[d]);
				spreadMomentum<dim, Shape>(w, block, mvp, mv);
			}
		});
		for (int d = 0; d < dim; ++d)
			T::Patch::add(tile, mv[d], momentum[d]);
	}
} // namespace detail

template <int dim> constexpr const NodeVector<dim>* noField = nullptr;

/* Momenta at the nodes of the points' velocities or, with v, of those that the nodal field v has at the points. */
template <int dim, class Shape>
void spreadVelocities(const Transfer<dim, Shape>& transfer, const NodeVector<dim>* v, NodeVector<dim>& momentum, bool affine, double tau = 0)
{
	for (Field& component : momentum)
		component.resize(transfer.grid.nodeCount());
	auto work = [&](std::size_t t) {
		if constexpr (dim > 1)
			if (affine) return run(transfer.instructions, [&, t] { detail::spreadTileVelocities<true>(transfer, t, v, momentum, tau); });
		run(transfer.instructions, [&, t] { detail::spreadTileVelocities<false>(transfer, t, v, momentum, tau); });
	};
	sumOverTiles(transfer, work, momentum);
}

/* v <- 2 v - Qv. */
template <int dim, class Shape> void subtractRoundTrip(const Transfer<dim, Shape>& transfer, NodeVector<dim>& v, const NodeVector<dim>& Qv)
{
	transfer.forEachNodeRange([&](std::size_t begin, std::size_t end) {
		for (int d = 0; d < dim; ++d) {
			double*       to   = v[d].data();
			const double* from = Qv[d].data();
#pragma omp simd
			for (std::size_t i = begin; i < end; ++i)
				to[i] = 2 * to[i] - from[i];
		}
	});
}

/* From a momentum at the nodes to velocities, in place; `rate` times what the walls take of it is added to their reactions.
Returns the work of that on moving walls in a step dt [J]. */
template <class D> double projectWithReactions(D& d, NodeVector<D::dim>& v, Motion motion, double rate, double dt)
{
	d.constraints.keepMomentum(v);
	velocityFromMomentum(d, v, v, motion);
	return d.constraints.addMomentumLoss(v, rate, dt);
}

} // namespace yade::mpm
