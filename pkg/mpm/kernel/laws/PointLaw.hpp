// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "Response.hpp"

namespace yade::mpm {

/* A law with one internal variable, written for one point as update(strain, sigma, p, dissipation), in every lane. Without
branches and calls in it, the lanes become vectors. */
template <class S, class Update, int W> void updatePoints(Update&& update, const Reals<W>* strain, Reals<W>* sigma, Reals<W>& p, Reals<W>& dissipation)
{
	forLanes<W>([&](int l) {
		double e[S::N], s[S::N];
		for (int k = 0; k < S::N; ++k)
			e[k] = strain[k][l], s[k] = sigma[k][l];
		double plastic = p[l], heat = dissipation[l];
		update(e, s, plastic, heat);
		for (int k = 0; k < S::N; ++k)
			sigma[k][l] = s[k];
		p[l] = plastic, dissipation[l] = heat;
	});
}

} // namespace yade::mpm
