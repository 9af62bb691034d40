// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "boucwen/Integrate.hpp"

namespace yade::mpm {

/* A modified Euler pair (Sloan, IJNME 24 (1987) 893; Sloan, Abbo & Sheng, Eng. Comput. 18 (2001) 121) covers a short increment at once;
Cash & Karp's pair does the rest in sub-steps. boucwen/Integrate.hpp has the error bounds. */
template <class S, int W, class T>
void BoucWen::update(const Hooke& C, const Pack<W, T>* strain, Pack<W, T>* sigma, Pack<W, T>* internal, Responses<W, T>& response, int* subSteps) const
{
	constexpr int              N   = S::N;
	const BoucWen&             law = *this;
	detail::Reloading<S, W, T> reloading;
	Pack<W, T>*                scalars = internal + law.tensors() * N;
	Pack<W, T>                 shorter[N], fraction;
	const bool                 far = detail::isFar<S>(law, C, strain);
	if (far) detail::truncateIncrement<S>(law, C, strain, shorter, fraction);
	auto run = [&](auto options) {
		using Y = detail::BoucWenVector<S, options.value>;
		Pack<W, T> y[Y::size] {};
		std::copy(sigma, sigma + N, y), std::copy(internal, internal + N, y + Y::eta);
		y[Y::p] = scalars[0], y[Y::dissipation] = response.dissipation;
		if constexpr (options.value) {
			if (law.degrades()) y[Y::e] = scalars[1], y[Y::compliance] = scalars[2];
			if (law.remembers()) {
				const Pack<W, T>* memory = scalars + law.scalars() - 2;
				reloading.limit = memory[0], reloading.origin = memory[1];
			}
			if (law.paper()) std::copy(internal + N, internal + 2 * N, y + Y::strain);
		}
		detail::boucWenIntegrate<S, options.value>(law, C, far ? shorter : strain, reloading, y, subSteps);
		std::copy(y, y + N, sigma), std::copy(y + Y::eta, y + Y::eta + N, internal);
		scalars[0] = y[Y::p], response.dissipation = y[Y::dissipation];
		if constexpr (options.value) {
			if (law.degrades()) scalars[1] = y[Y::e], scalars[2] = y[Y::compliance];
			if (law.remembers()) {
				Pack<W, T>* memory = scalars + law.scalars() - 2;
				memory[0] = reloading.limit, memory[1] = reloading.origin;
			}
			if (law.paper()) std::copy(y + Y::strain, y + Y::strain + N, internal + N);
		}
	};
	if (law.plain())
		run(std::false_type {});
	else
		run(std::true_type {});
	if (far) detail::flowSteadily<S>(law, C, strain, fraction, sigma, internal, scalars[0], response.dissipation);
}

template <class S> void BoucWen::continuumTangent(const Hooke& C, const double* strain, const double* sigma, const double* internal, double* D) const
{
	// the rates are homogeneous of degree one in the strain rate: their derivative at `strain` is the tangent
	constexpr int N = S::N;
	using T         = Dual<N>;
	using Y         = detail::BoucWenVector<S, true>;
	Pack<1, T>                 e[N], De[N], y[Y::size] {}, dy[Y::size], mDe, step { { 1e-12 } };
	detail::Reloading<S, 1, T> memory;
	const double*              scalar = internal + tensors() * N;
	T                          rate[N], stress[N];
	for (int k = 0; k < N; ++k) {
		rate[k] = strain[k], rate[k].slope[k] = 1;
		e[k][0] = rate[k], y[k][0] = sigma[k], y[Y::eta + k][0] = internal[k];
		if (paper()) y[Y::strain + k][0] = internal[N + k];
	}
	S::elastic(C, rate, stress);
	for (int k = 0; k < N; ++k)
		De[k][0] = stress[k];
	y[Y::p][0] = scalar[0];
	if (degrades()) y[Y::e][0] = scalar[1], y[Y::compliance][0] = scalar[2];
	if (remembers()) {
		memory.limit[0] = scalar[scalars() - 2], memory.origin[0] = scalar[scalars() - 1];
		memory.begin(*this, y, De, step);
	}
	detail::boucWenRate<S, true>(*this, C, 0, memory, y, e, De, dy, mDe);
	for (int i = 0; i < N; ++i)
		for (int j = 0; j < N; ++j)
			D[i * N + j] = dy[i].value[0].slope[j];
}

} // namespace yade::mpm
