// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "NodeFields.hpp"
#include "PointState.hpp"

namespace yade::mpm {

/* K of the points' elastic stiffness, times the bound of each law's tangent:
(K u)_i = sum_p V_p D_p (sym grad u)_p grad N_ip, with the current volumes. */
template <class S, class Shape> class ElasticOperator {
	static constexpr int dim = S::dim;
	using T                  = Transfer<dim, Shape>;

public:
	ElasticOperator(const T& transfer, const std::vector<Law>& laws, bool largeStrain)
	    : m_transfer(transfer)
	    , m_laws(laws)
	    , m_largeStrain(largeStrain)
	{
	}
	/* f = K u; u has its images behind walls, f is not mirrored. */
	void apply(const NodeVector<dim>& u, NodeVector<dim>& f) const
	{
		sumOverTiles(
			m_transfer, [&](std::size_t t) { run(m_transfer.instructions, [&, t] { applyTile(m_transfer.grid.tiles()[t], u, f); }); }, f);
	}

private:
	const T&                m_transfer;
	const std::vector<Law>& m_laws;
	bool                    m_largeStrain;

	void applyTile(const typename T::Tile& tile, const NodeVector<dim>& u, NodeVector<dim>& f) const
	{
		const Points&      P = m_transfer.points;
		typename T::Values v[dim], fi[dim] {};
		for (int d = 0; d < dim; ++d)
			T::Patch::read(tile, u[d], v[d]);
		forEachBlock(tile.begin, tile.end, [&](Block block) {
			Lanes                   x[dim], V, G[gradients<S>];
			WeightLanes<dim, Shape> w;
			for (int d = 0; d < dim; ++d)
				load(P.position[std::size_t(d)], block, x[d]);
			m_transfer.weights(tile, block, x, w);
			currentVolume<dim>(P, block, m_largeStrain, V);
			for (int l = 0; l < block.count; ++l) {
				displacementGradient<S>(w[l], v, x[0][l], 1, l, G);
				const Law&   law = m_laws[std::size_t(P.material[block.first + std::size_t(l)])];
				const double Vl  = law.stiffnessBound() * V[l];
				double       g[gradients<S>], strain[S::N], s[S::N];
				for (int k = 0; k < gradients<S>; ++k)
					g[k] = G[k][l];
				smallStrain<S>(g, strain);
				S::elastic(law.elastic, strain, s);
				for (double& component : s)
					component *= Vl;
				w[l].forEachNode([&](int i, double Nip, const std::array<double, dim>& grad) {
					for (int d = 0; d < dim; ++d)
						for (int e = 0; e < dim; ++e)
							fi[d][i] += s[componentOf<S>(d, e)] * grad[std::size_t(e)];
					if constexpr (hasHoop<S>) fi[0][i] += s[2] / x[0][l] * Nip;
				});
			}
		});
		for (int d = 0; d < dim; ++d)
			T::Patch::add(tile, fi[d], f[d]);
	}
};

} // namespace yade::mpm
