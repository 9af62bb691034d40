// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "../boundary/NodalShares.hpp"
#include "NodeFields.hpp"

namespace yade::mpm {

/* The shares of the nodes in the motion of a place beside a point: weight_i = N_ip + lever . grad N_ip. They sum to one and have
their centre at the place, sum weight_i x_i = x_p + lever, so that an impulse brings its moment to the nodes whole; and they are
those of nodes that carry the point, so that no node without mass moves. Linear functions have weights without the lever: beside a
node of little mass their gradient does not vanish. */
template <class D> struct PointShares {
	using V                  = std::array<double, D::dim>;
	static constexpr int dim = D::dim;

	static double weight(double N, const V& grad, const V& lever)
	{
		double w = N;
		for (std::size_t d = 0; d < dim && D::Shape::support > 2; ++d)
			w += lever[d] * grad[d];
		return w;
	}
	/* Adds a force at the place to the nodal sums, before mirrors act on them. */
	static void addForce(const typename D::Tile& tile, const typename D::Weights& w, const V& lever, const V& force, NodeVector<dim>& field)
	{
		w.forEachNode([&](int i, double N, const V& grad) {
			const double share = weight(N, grad, lever);
			const auto   node  = std::size_t(D::Patch::nodeOf(tile, i));
			for (std::size_t a = 0; a < dim; ++a)
				field[a][node] += share * force[a];
		});
	}
	/* Adds the shares to a range, after mirrors have acted; `sign` is that of the side of a contact. */
	static void add(D& d, const typename D::Tile& tile, const typename D::Weights& w, const V& lever, double sign, NodalShares<dim>& shares,
		typename NodalShares<dim>::Range& range)
	{
		w.forEachNode([&](int i, double N, const V& grad) {
			const double share = sign * weight(N, grad, lever);
			const auto   image = d.constraints.imageOf(D::Patch::nodeOf(tile, i));
			V            weights, inverse {};
			for (std::size_t a = 0; a < dim; ++a) {
				range.still[a] += share * image.still[a];
				weights[a] = share * image.sign[a];
				if (image.node >= 0)
					inverse[a] = NodeFields<typename D::S>::inverse(d.fields.massOf(int(a))[std::size_t(image.node)], d.fields.leastMass);
			}
			if (image.node >= 0) shares.add(range, image.node, weights, inverse);
		});
	}
};

} // namespace yade::mpm
