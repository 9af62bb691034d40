// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "../Kinematics.hpp"
#include "Law.hpp"

namespace yade::mpm {

/* The strain increments that the law takes in a step, of each lane, from G = dt grad v and F at the start of the step. In large strain
sigma and the internal tensors turn with the material. */
template <class S, int W>
void strainIncrement(const Law& law, bool large, const Pack<W>* G, const Pack<W>* F, Pack<W>* sigma, Pack<W>* internal, Pack<W>* strain)
{
	if (!large) {
		forLanes<W>([&](int l) {
			double g[gradients<S>], e[S::N];
			for (int k = 0; k < gradients<S>; ++k)
				g[k] = G[k][l];
			smallStrain<S>(g, e);
			for (int k = 0; k < S::N; ++k)
				strain[k][l] = e[k];
		});
		return;
	}
	Pack<W> compliance; // 1/(2 G)
	law.visit([&](const auto& model) {
		const double initial = .5 / law.elastic.shear;
		forLanes<W>([&](int l) { compliance[l] = initial * model.template complianceGrowth<S>([&](int k) { return internal[k][l]; }); });
	});
	largeStrain<S>(G, F, compliance, Internals::of(law).tensors, sigma, internal, strain);
}

/* The same at one point. */
template <class S> void strainIncrement(const Law& law, bool large, const double* G, const double* F, double* sigma, double* internal, double* strain)
{
	constexpr int dim2 = S::dim * S::dim, N = S::N;
	const int     columns = Internals::of(law).columns(N);
	Pack<1>       g[gradients<S>], f[dim2], s[N], state[maxInternals(N)], e[N];
	for (int k = 0; k < gradients<S>; ++k)
		g[k][0] = G[k];
	for (int k = 0; k < dim2; ++k)
		f[k][0] = F[k];
	for (int k = 0; k < N; ++k)
		s[k][0] = sigma[k];
	for (int k = 0; k < columns; ++k)
		state[k][0] = internal[k];
	strainIncrement<S, 1>(law, large, g, f, s, state, e);
	for (int k = 0; k < N; ++k)
		sigma[k] = s[k][0], strain[k] = e[k][0];
	for (int k = 0; k < columns; ++k)
		internal[k] = state[k][0];
}

} // namespace yade::mpm
