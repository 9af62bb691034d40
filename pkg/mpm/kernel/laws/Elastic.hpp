// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "Check.hpp"
#include "Internals.hpp"
#include "Tangent.hpp"

namespace yade::mpm {

/* Hooke's law: sigma' = D eps'. */
struct Elastic : LawDefaults {
	static constexpr Internals maxInternals {};

	bool      operator==(const Elastic&) const { return true; }
	Internals internals() const { return {}; }
	void      check(const Hooke&, Check&) const {}

	template <class S, int W, class T> void update(const Hooke& C, const Pack<W, T>* strain, Pack<W, T>* sigma, Pack<W, T>*, Responses<W, T>&) const
	{
		constexpr int N = S::N;
		forLanes<W>([&](int l) {
			T e[N], De[N];
			for (int k = 0; k < N; ++k)
				e[k] = strain[k][l];
			S::elastic(C, e, De);
			for (int k = 0; k < N; ++k)
				sigma[k][l] += De[k];
		});
	}
	template <class S> void tangent(const Hooke& C, const double* strain, const double* sigma, const double* internal, double* D) const
	{
		differentiateUpdate<S>(*this, C, strain, sigma, internal, D);
	}
};

} // namespace yade::mpm
