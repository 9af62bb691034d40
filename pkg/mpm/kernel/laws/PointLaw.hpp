// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "Response.hpp"

namespace yade::mpm {

/* Applies a law with one internal variable, written for one point as update(strain, sigma, p, dissipation), in every lane.
Without branches and calls in the update, the lanes become vectors. */
template <class S, class Update, int W, class T>
void updatePoints(Update&& update, const Pack<W, T>* strain, Pack<W, T>* sigma, Pack<W, T>& p, Pack<W, T>& dissipation)
{
	forLanes<W>([&](int l) {
		T e[S::N], s[S::N];
		for (int k = 0; k < S::N; ++k)
			e[k] = strain[k][l], s[k] = sigma[k][l];
		T plastic = p[l], heat = dissipation[l];
		update(e, s, plastic, heat);
		for (int k = 0; k < S::N; ++k)
			sigma[k][l] = s[k];
		p[l] = plastic, dissipation[l] = heat;
	});
}

} // namespace yade::mpm
