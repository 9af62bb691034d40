// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "../TileGrid.hpp"

namespace yade::mpm {

/* The share of one node in the motion of a place: the place moves with sum weight v_i, and an impulse on it changes v_i by
gain = weight / m_i times the impulse. A number a component: a node behind a mirror wall has the sign of its image. */
template <int dim> struct NodalShare {
	std::ptrdiff_t          node;
	std::array<double, dim> weight, gain;
};

/* Places of the material, each with its shares of nodes. Impulses act on velocities and on their increments alike. */
template <int dim> class NodalShares {
public:
	using V = std::array<double, dim>;
	struct Range {
		std::size_t first = 0, last = 0;
		V           still {};    // part of the velocity that no impulse changes: of moving walls behind which nodes lie
		V           response {}; // velocity of the place from a unit impulse on it: sum weight^2 / m_i [1/kg]
	};

	void  clear() { m_shares.clear(); }
	Range begin() const { return { m_shares.size(), m_shares.size(), {}, {} }; }
	/* Adds a node to the last range. */
	void add(Range& range, std::ptrdiff_t node, const V& weight, const V& inverseMass)
	{
		NodalShare<dim> share { node, weight, {} };
		for (int d = 0; d < dim; ++d) {
			share.gain[std::size_t(d)] = weight[std::size_t(d)] * inverseMass[std::size_t(d)];
			range.response[std::size_t(d)] += weight[std::size_t(d)] * share.gain[std::size_t(d)];
		}
		m_shares.push_back(share);
		range.last = m_shares.size();
	}
	V velocity(const Range& range, const NodeVector<dim>& v) const
	{
		V u = range.still;
		for (std::size_t k = range.first; k < range.last; ++k)
			for (std::size_t d = 0; d < dim; ++d)
				u[d] += m_shares[k].weight[d] * v[d][std::size_t(m_shares[k].node)];
		return u;
	}
	void push(const Range& range, const V& impulse, NodeVector<dim>& v) const
	{
		for (std::size_t k = range.first; k < range.last; ++k)
			for (std::size_t d = 0; d < dim; ++d)
				v[d][std::size_t(m_shares[k].node)] += m_shares[k].gain[d] * impulse[d];
	}
	const NodalShare<dim>& operator[](std::size_t k) const { return m_shares[k]; }

private:
	std::vector<NodalShare<dim>> m_shares;
};

} // namespace yade::mpm
