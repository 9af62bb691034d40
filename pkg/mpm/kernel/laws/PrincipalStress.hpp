// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "../Pack.hpp"
#include "Dual.hpp"
#include "StressState.hpp"

namespace yade::mpm {

/* Principal stresses in descending order. In Solid by Jacobi's rotations, which lose no digits where two are nearly equal, as closed forms do.
The rotations count as constants in derivatives: at their end, the derivative of an eigenvalue is that of its diagonal entry. Exactly equal ones
share the sum of their derivatives in some way; a symmetric function of the tensor depends on the sum alone. */
template <class S, int W, class T> void principalStresses(const Pack<W, T>* s, Pack<W, T>* x)
{
	static_assert(normals<S>() == 3);
	using std::sqrt;
	if constexpr (S::N == 4)
		forLanes<W>([&](int l) {
			const T m = .5 * (s[0][l] + s[1][l]), d = .5 * (s[0][l] - s[1][l]), r = sqrt(d * d + s[3][l] * s[3][l]);
			x[0][l] = m + r, x[1][l] = m - r, x[2][l] = s[2][l];
		});
	else {
		Pack<W, T> a[6] { s[0], s[1], s[2], s[3], s[4], s[5] };
		auto       rotate = [&](int p, int q) { // annihilates a_pq
                        const int r = 3 - p - q;  // a_ij with i != j is component 6 - i - j
                        forLanes<W>([&](int l) {
                                const T      pp = a[p][l], qq = a[q][l], pq = a[3 + r][l], rp = a[3 + q][l], rq = a[3 + p][l];
                                const double twice = 2 * valueOf(pq), d = valueOf(qq) - valueOf(pp), length = std::abs(d) + std::sqrt(d * d + twice * twice);
                                const double t = (d < 0 ? -twice : twice) / (length > 0 ? length : 1), c = 1 / std::sqrt(1 + t * t), n = t * c;
                                const T      move = n * (2 * c * pq + n * (pp - qq));
                                a[p][l] = pp - move, a[q][l] = qq + move;
                                a[3 + r][l] = (c * c - n * n) * pq + c * n * (pp - qq);
                                a[3 + q][l] = c * rp - n * rq, a[3 + p][l] = n * rp + c * rq;
                        });
		};
		// what is left of a_ij moves the eigenvalues by less than its size
		auto turned = [&](int l) {
			const double off  = std::abs(valueOf(a[3][l])) + std::abs(valueOf(a[4][l])) + std::abs(valueOf(a[5][l]));
			const double size = std::abs(valueOf(a[0][l])) + std::abs(valueOf(a[1][l])) + std::abs(valueOf(a[2][l]));
			return off > 1e-15 * size;
		};
		for (int sweep = 0; sweep < 10 && anyLane<W>(turned); ++sweep)
			rotate(0, 1), rotate(0, 2), rotate(1, 2);
		for (int k = 0; k < 3; ++k)
			x[k] = a[k];
	}
	forLanes<W>([&](int l) {
		const T    a = x[0][l], b = x[1][l], c = x[2][l];
		const bool ab   = a < b;
		const T    high = ab ? b : a, low = ab ? a : b;
		const bool top = high < c, bottom = c < low;
		x[0][l] = top ? c : high;
		x[1][l] = top ? high : bottom ? low : c;
		x[2][l] = bottom ? c : low;
	});
}

/* a b of two symmetric tensors with the same axes. */
template <class S, class T> void productOfCommuting(const T* a, const T* b, T* ab)
{
	static_assert(normals<S>() == 3);
	if constexpr (S::N == 4) {
		ab[0] = a[0] * b[0] + a[3] * b[3], ab[1] = a[1] * b[1] + a[3] * b[3], ab[2] = a[2] * b[2];
		ab[3] = a[0] * b[3] + a[3] * b[1];
	} else {
		ab[0] = a[0] * b[0] + a[5] * b[5] + a[4] * b[4], ab[1] = a[5] * b[5] + a[1] * b[1] + a[3] * b[3];
		ab[2] = a[4] * b[4] + a[3] * b[3] + a[2] * b[2];
		ab[3] = a[5] * b[4] + a[1] * b[3] + a[3] * b[2];
		ab[4] = a[0] * b[4] + a[5] * b[3] + a[4] * b[2];
		ab[5] = a[0] * b[5] + a[5] * b[1] + a[4] * b[3];
	}
}

} // namespace yade::mpm
