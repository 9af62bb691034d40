// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "Law.hpp"

namespace yade::mpm {

/* What updateStress() does, in every lane: the one place that leads from a law to its update. */
template <class S, int W>
void updateStressLanes(const Law& law, const Reals<W>* strain, Reals<W>* sigma, Reals<W>* internal, Responses<W>& response, bool respond)
{
	constexpr int N = S::N, kept = normals<S>();
	const bool    follows = respond && kept < 3 && law.kind != Law::Kind::druckerPrager;
	Reals<W>      before {};
	// tr eps = (1 - 2 nu)/E tr sigma, as far as the compliance has grown
	auto trace = [&](int l) {
		double sum = 0;
		for (int k = 0; k < kept; ++k)
			sum += sigma[k][l];
		return sum;
	};
	auto     growth = [&](int l) { return detail::complianceGrowth<S>(law, [&](int k) { return internal[k][l]; }); };
	Reals<W> growthBefore;
	if (follows) forLanes<W>([&](int l) { before[l] = trace(l), growthBefore[l] = growth(l); });
	switch (law.kind) {
		case Law::Kind::elastic:
			forLanes<W>([&](int l) {
				double e[N], De[N];
				for (int k = 0; k < N; ++k)
					e[k] = strain[k][l];
				S::elastic(law.elastic, e, De);
				for (int k = 0; k < N; ++k)
					sigma[k][l] += De[k];
			});
			break;
		case Law::Kind::boucWen: boucWenUpdate<S>(law.boucWen, strain, sigma, internal, response.dissipation); break;
		case Law::Kind::j2: j2Update<S>(law.j2, strain, sigma, internal, internal[N], response.dissipation); break;
		case Law::Kind::druckerPrager: druckerPragerUpdate<S>(law.druckerPrager, strain, sigma, internal[0], response); break;
	}
	if (follows)
		forLanes<W>([&](int l) {
			// flow keeps the volume, and the free normals share what is left of it
			double keptStrain = 0;
			for (int k = 0; k < kept; ++k)
				keptStrain += strain[k][l];
			const double compliance = .5 * (growthBefore[l] + growth(l)) * (1 - 2 * law.elastic.poisson) / law.elastic.young;
			response.freeStrain[l] += (compliance * (trace(l) - before[l]) - keptStrain) / (kept < 3 ? 3 - kept : 1);
		});
}

} // namespace yade::mpm
