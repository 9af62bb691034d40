// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "Law.hpp"

namespace yade::mpm {

/* updateStress() in every lane: dispatches the stress update by law. respond: whether to add to the response. */
template <class S, int W> void updateStressLanes(const Law& law, const Pack<W>* strain, Pack<W>* sigma, Pack<W>* internal, Responses<W>& response, bool respond)
{
	law.visit([&](const auto& model) {
		constexpr int  kept        = normals<S>();
		constexpr bool possible    = kept < 3 && !std::decay_t<decltype(model)>::findsFreeStrain;
		const bool     freeNormals = possible && respond;
		Pack<W>        traceBefore {};
		// tr eps = (1 - 2 nu)/E tr sigma, times the growth of the compliance
		auto trace = [&](int l) {
			double sum = 0;
			for (int k = 0; k < kept; ++k)
				sum += sigma[k][l];
			return sum;
		};
		auto    growth = [&](int l) { return model.template complianceGrowth<S>([&](int k) { return internal[k][l]; }); };
		Pack<W> growthBefore;
		if (freeNormals) forLanes<W>([&](int l) { traceBefore[l] = trace(l), growthBefore[l] = growth(l); });
		model.template update<S>(law.elastic, strain, sigma, internal, response);
		if (freeNormals)
			forLanes<W>([&](int l) {
				// flow keeps the volume, and the free normals share the rest of its change
				double keptStrain = 0;
				for (int k = 0; k < kept; ++k)
					keptStrain += strain[k][l];
				const double compliance = .5 * (growthBefore[l] + growth(l)) * (1 - 2 * law.elastic.poisson) / law.elastic.young;
				response.freeStrain[l] += (compliance * (trace(l) - traceBefore[l]) - keptStrain) / (kept < 3 ? 3 - kept : 1);
			});
	});
}

} // namespace yade::mpm
