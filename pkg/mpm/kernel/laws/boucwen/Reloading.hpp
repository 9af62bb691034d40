// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "Parameters.hpp"

namespace yade::mpm::detail {

/* The layout of the integrated variables, one flat vector y: sigma, eta, p, dissipation; with options also e, compliance growth, strain. */
template <class S, bool options> struct BoucWenVector {
	static constexpr int eta = S::N, p = 2 * S::N, dissipation = p + 1, e = p + 2, compliance = p + 3, strain = p + 4;
	static constexpr int size = options ? strain + S::N : e;
};

template <class S, int W, class T> void backStressFree(const Pack<W, T>* y, int l, T* xi)
{
	for (int k = 0; k < S::N; ++k)
		xi[k] = y[k][l] - y[S::N + k][l];
}

/* The memory of compatible reloading: it goes from f = origin up to f = limit. Unloading moves both
continuously and loading at the limit makes them f, so that the response depends continuously on the path (doc/law.md). */
template <class S, int W, class T> struct Reloading {
	static constexpr double depth = 4; // limit <= depth f

	Pack<W, T> limit {}, origin {}, xi[S::N] {}; // xi at the start of the sub-step
	// the sub-step under way: whether it unloads, has no flow while loading, loads at the limit, is cut short
	Pack<W> unloads {}, elastic {}, atLimit {}, stops {};

	/* Before a sub-step, which ends at the latest where f turns or where elastic reloading meets the limit. */
	void begin(const BoucWen& law, const Pack<W, T>* y, const Pack<W, T>* De, Pack<W, T>& step)
	{
		using std::sqrt;
		const bool sharp = std::isinf(law.reloading);
		forLanes<W>([&](int l) {
			T       x[S::N], m[S::N], de[S::N];
			const T softening = 1 / (1 + y[BoucWenVector<S, true>::compliance][l]);
			backStressFree<S>(y, l, x);
			for (int k = 0; k < S::N; ++k)
				xi[k][l] = x[k], de[k] = softening * De[k][l];
			S::normal(x, 1, m);
			// of an elastic path f^2 = f2 + 2 t B + t^2 A
			const T f2 = S::mises2(x), B = dot<S>(m, de), A = S::mises2(de), C = f2 - limit[l] * limit[l];
			const T turn = -B / (A > 0 ? A : T(1)), meet = -C / (B + sqrt(std::max<T>(0., B * B - A * C)));
			// a distance below rounding counts as reached
			const bool back = turn > 1e-9, below = C < -2e-9 * f2, up = !back & below & sharp & (meet > 1e-9);
			const T    most = back ? turn : up ? meet : step[l];
			unloads[l] = back, elastic[l] = back | up, atLimit[l] = !back & !up & (sharp | !below), stops[l] = most < step[l];
			step[l] = most < step[l] ? most : step[l];
		});
	}
	/* After it, in lanes that have accepted it. */
	void end(const Pack<W, T>* y, const Pack<W, T>& done, const Pack<W>& accepted)
	{
		using std::sqrt;
		forLanes<W>([&](int l) {
			T x[S::N], from[S::N], way[S::N], turned[S::N], m[S::N];
			backStressFree<S>(y, l, x);
			for (int k = 0; k < S::N; ++k)
				from[k] = xi[k][l], way[k] = x[k] - from[k];
			S::normal(from, 1, m);
			const T A = S::mises2(way), turn = -dot<S>(m, way) / (A > 0 ? A : T(1)), t = turn < 0 ? T(0) : turn < 1 ? turn : T(1);
			for (int k = 0; k < S::N; ++k)
				turned[k] = from[k] + t * way[k];
			const T before = sqrt(S::mises2(from)), least = sqrt(S::mises2(turned)), after = sqrt(S::mises2(x));
			// (1 - origin/limit) (1 - f/limit)^3 stays
			const T inverse = limit[l] > 0 ? 1 / limit[l] : T(0), ratio = std::max<T>(least * inverse, 1 / depth),
				lower     = std::min<T>(limit[l], depth * least);
			const T    closer = (1 - before * inverse) / (ratio < 1 ? 1 - ratio : T(1));
			const T    start  = std::min<T>(least, lower * (1 - (1 - origin[l] * inverse) * closer * closer * closer));
			const bool taken = (accepted[l] != 0) & (done[l] < 1), back = taken & (unloads[l] != 0);
			const bool meets = taken & (unloads[l] == 0) & ((atLimit[l] != 0) | (after >= (1 - 1e-9) * limit[l]));
			limit[l]         = back ? lower : meets ? after : limit[l];
			origin[l]        = back ? start : meets ? after : origin[l];
		});
	}
	/* The factor on H1 of a lane that loads is this to the power r. */
	T loadedFraction(const Pack<W, T>& f, int l) const
	{
		const bool below = (atLimit[l] == 0) & (f[l] < limit[l]);
		return below ? std::max<T>(0., f[l] - origin[l]) / std::max<T>(limit[l] - origin[l], 1e-9 * limit[l]) : T(1);
	}
};

} // namespace yade::mpm::detail
