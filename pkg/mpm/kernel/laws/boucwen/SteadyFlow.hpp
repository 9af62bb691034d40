// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "../J2.hpp"
#include "Parameters.hpp"

namespace yade::mpm::detail {

/* A yield strain takes about n/2 sub-steps. A step that needs more than these fails: the stress of the point becomes NaN. */
constexpr double maxSubSteps = 1e5;
/* Increments of more yield strains than this are rare; isFar() finds them. */
constexpr double farStrain = 64;

template <class S, int W, class T> bool isFar(const BoucWen& law, const Hooke& C, const Pack<W, T>* strain)
{
	const double limit = law.yieldStress * std::min(farStrain, maxSubSteps / law.n);
	return anyLane<W>([&](int l) {
		T e[S::N], De[S::N];
		for (int k = 0; k < S::N; ++k)
			e[k] = strain[k][l];
		S::elastic(C, e, De);
		return !(S::mises2(De) <= limit * limit);
	});
}
/* The fraction of an increment that is integrated by sub-steps; 0 where they would be too many.

Without options a far increment ends in steady flow, which is independent of its beginning: a difference from it decays with rate n (f),
and at least with the ratio of the moduli of the two parts of xi, or 1 (its direction), a yield strain. When it is e^-4 of the tolerance,
flowSteadily() takes the rest. */
template <class S, class T> T integratedFraction(const BoucWen& law, const Hooke& C, const T* strain)
{
	using std::sqrt;
	T De[S::N];
	S::elastic(C, strain, De);
	const double A = splitModulus<S>(C), B = 3 * C.shear, slowest = std::min({ 1., law.n, A / B, B / A });
	const T      length = sqrt(S::mises2(De)) / law.yieldStress;
	const double memory = (4 - std::log(law.tolerance)) / slowest;
	const bool   steady = law.plain() && length > std::max(memory, farStrain);
	return std::max(1., law.n) * (steady ? T(memory) : length) <= maxSubSteps ? steady ? memory / length : T(1) : T(0);
}
template <class S, int W, class T>
[[gnu::noinline]] void truncateIncrement(const BoucWen& law, const Hooke& C, const Pack<W, T>* strain, Pack<W, T>* shorter, Pack<W, T>& fraction)
{
	for (int l = 0; l < W; ++l) {
		T e[S::N];
		for (int k = 0; k < S::N; ++k)
			e[k] = strain[k][l];
		fraction[l] = integratedFraction<S>(law, C, e);
		for (int k = 0; k < S::N; ++k)
			shorter[k][l] = fraction[l] > 0 ? fraction[l] * e[k] : T(0);
	}
}
/* The rest of the increments. In steady flow, f = sigma_y, the backward Euler step of classical plasticity is exact, however long. */
template <class S, int W, class T>
[[gnu::noinline]] void flowSteadily(const BoucWen& law, const Hooke& C, const Pack<W, T>* strain, const Pack<W, T>& fraction, Pack<W, T>* sigma,
	Pack<W, T>* eta, Pack<W, T>& p, Pack<W, T>& dissipation)
{
	J2 classical;
	classical.yieldStress = law.yieldStress, classical.hardening = law.hardening;
	for (int l = 0; l < W; ++l) {
		if (fraction[l] == 1) continue;
		Pack<1, T>      e[S::N], s[S::N], state[S::N + 1];
		Responses<1, T> response;
		for (int k = 0; k < S::N; ++k)
			e[k][0] = (1 - fraction[l]) * strain[k][l], s[k][0] = sigma[k][l], state[k][0] = eta[k][l];
		state[S::N][0] = p[l], response.dissipation[0] = dissipation[l];
		if (fraction[l] > 0)
			classical.update<S>(C, e, s, state, response);
		else
			s[0][0] = std::numeric_limits<double>::quiet_NaN();
		for (int k = 0; k < S::N; ++k)
			sigma[k][l] = s[k][0], eta[k][l] = state[k][0];
		p[l] = state[S::N][0], dissipation[l] = response.dissipation[0];
	}
}

} // namespace yade::mpm::detail
