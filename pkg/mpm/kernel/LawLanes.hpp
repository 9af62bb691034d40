// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "Kinematics.hpp"
#include "Lanes.hpp"
#include "Law.hpp"

namespace yade::mpm {

/* The stress update of a block of points that share a law: what updateStress() and Increment do, lane by lane. */

/* Strain increments from G = dt grad v; F advances, and sigma and eta turn with the material. */
template <class S, bool largeStrain, bool back>
void incrementLanes(const Lanes (&G)[gradients<S>], Lanes (&strain)[S::N], Lanes (&F)[S::dim * S::dim], Lanes (&sigma)[S::N], Lanes (&eta)[S::N])
{
	forLanes([&](int l) {
		constexpr int dim2 = S::dim * S::dim;
		double        g[gradients<S>], f[dim2], s[S::N];
		for (int k = 0; k < gradients<S>; ++k)
			g[k] = G[k][l];
		for (int k = 0; k < dim2; ++k)
			f[k] = F[k][l];
		Increment<S> increment;
		if (largeStrain) {
			increment.large(g);
			for (int k = 0; k < S::N; ++k)
				s[k] = sigma[k][l];
			increment.rotate(s);
			for (int k = 0; k < S::N; ++k)
				sigma[k][l] = s[k];
			if (back) {
				for (int k = 0; k < S::N; ++k)
					s[k] = eta[k][l];
				increment.rotate(s);
				for (int k = 0; k < S::N; ++k)
					eta[k][l] = s[k];
			}
		} else
			increment.small(g);
		for (int k = 0; k < S::N; ++k)
			strain[k][l] = increment.strain[k];
		advanceDeformation<S::dim>(g, largeStrain, f);
		for (int k = 0; k < dim2; ++k)
			F[k][l] = f[k];
	});
}

template <class S> void elasticLanes(const Hooke& C, const Lanes (&strain)[S::N], Lanes (&sigma)[S::N])
{
	forLanes([&](int l) {
		double e[S::N], De[S::N];
		for (int k = 0; k < S::N; ++k)
			e[k] = strain[k][l];
		S::elastic(C, e, De);
		for (int k = 0; k < S::N; ++k)
			sigma[k][l] += De[k];
	});
}

namespace detail {
	/* z^n of every lane, as power(). */
	inline void powerLanes(const Lanes& base, double n, Lanes& result)
	{
		Lanes        z     = base;
		const double twice = 2 * n;
		if (!(twice <= 2048) || twice != int(twice)) {
			for (int l = 0; l < lanes; ++l)
				result[l] = std::pow(z[l], n);
			return;
		}
		const bool half = int(twice) & 1;
		forLanes([&](int l) { result[l] = half ? std::sqrt(z[l]) : 1; });
		for (int bits = int(twice) >> 1; bits; bits >>= 1) {
			if (bits & 1) forLanes([&](int l) { result[l] *= z[l]; });
			forLanes([&](int l) { z[l] *= z[l]; });
		}
	}
	template <class S> [[gnu::noinline]] void boucWenPoint(const BoucWenParameters& law, const double* strain, double* sigma, double* internal)
	{
		boucWenUpdate<S>(law, strain, sigma, internal);
	}

	/* boucWenRate() without its options, for every lane. y is sigma, eta and p. */
	template <class S>
	void boucWenRateLanes(const BoucWenParameters& law, const Lanes (&y)[2 * S::N + 1], const Lanes (&De)[S::N], Lanes (&dy)[2 * S::N + 1])
	{
		constexpr int N    = S::N;
		const double  tiny = 1e-24 * law.yieldStress * law.yieldStress, overYield = 1 / law.yieldStress, least = 1e-3 * law.tolerance;
		const double  loading = law.beta + law.gamma, unloading = law.beta - law.gamma, hardening = law.hardening;
		const Hooke&  C = law.elastic;
		Lanes         z, H1;
		forLanes([&](int l) {
			double xi[N];
			for (int k = 0; k < N; ++k)
				xi[k] = y[k][l] - y[N + k][l];
			z[l] = std::sqrt(S::mises2(xi)) * overYield;
		});
		powerLanes(z, law.n, H1);
		forLanes([&](int l) {
			double xi[N], m[N], Dm[N], b[N], de[N];
			for (int k = 0; k < N; ++k)
				xi[k] = y[k][l] - y[N + k][l], de[k] = De[k][l];
			const double f2 = S::mises2(xi), f = z[l] * law.yieldStress;
			S::normal(xi, 1, m);
			S::elastic(C, m, Dm), S::back(xi, b);
			const double mDe = dot<S>(m, de), H = H1[l] * (mDe > 0 ? loading : unloading);
			const bool   flows = (f2 > tiny) & (std::abs(H) > least);
			const double q     = flows ? H * mDe / (flows ? dot<S>(m, Dm) + hardening * f2 : 1) : 0;
			for (int k = 0; k < N; ++k)
				dy[k][l] = de[k] - q * Dm[k], dy[N + k][l] = q * hardening * b[k];
			dy[2 * N][l] = q * f;
		});
	}
} // namespace detail

/* The sub-stepping of boucWenUpdate() where one sub-step does; the lanes that need more are updated one by one. */
template <class S> void boucWenLanes(const BoucWenParameters& law, const Lanes (&strain)[S::N], Lanes (&sigma)[S::N], Lanes (&eta)[S::N], Lanes& p)
{
	constexpr int N = S::N, size = 2 * N + 1;
	Lanes         De[N], y[size], euler[size], dy1[size], dy2[size], accepted;
	for (int k = 0; k < N; ++k) {
		De[k] = {};
		y[k] = sigma[k], y[N + k] = eta[k];
	}
	y[2 * N] = p;
	elasticLanes<S>(law.elastic, strain, De);
	detail::boucWenRateLanes<S>(law, y, De, dy1);
	for (int k = 0; k < size; ++k)
		forLanes([&](int l) { euler[k][l] = y[k][l] + dy1[k][l]; });
	detail::boucWenRateLanes<S>(law, euler, De, dy2);

	const double admitted = .25 * law.tolerance * law.tolerance * law.yieldStress * law.yieldStress, yield2 = law.yieldStress * law.yieldStress;
	int          all = 1;
#pragma omp simd reduction(& : all)
	for (int l = 0; l < lanes; ++l) {
		double error2 = 0, xi[N], end[size];
		for (int k = 0; k < 2 * N; ++k)
			error2 += (dy2[k][l] - dy1[k][l]) * (dy2[k][l] - dy1[k][l]);
		for (int k = 0; k < size; ++k)
			end[k] = y[k][l] + .5 * (dy1[k][l] + dy2[k][l]);
		for (int k = 0; k < N; ++k)
			xi[k] = end[k] - end[N + k];
		const double f2     = S::mises2(xi);
		const bool   over   = f2 > yield2 * (1 + 2e-10);
		const double excess = over ? 1 - law.yieldStress / std::sqrt(over ? f2 : 1) : 0;
		for (int k = 0; k < N; ++k)
			end[k] -= excess * xi[k];
		const bool good = error2 <= admitted;
		accepted[l]     = good;
		all &= good;
		for (int k = 0; k < size; ++k)
			y[k][l] = end[k];
	}
	if (!all)
		for (int l = 0; l < lanes; ++l) {
			if (accepted[l] != 0) continue;
			double e[N], s[N], internal[N + 1];
			for (int k = 0; k < N; ++k)
				e[k] = strain[k][l], s[k] = sigma[k][l], internal[k] = eta[k][l];
			internal[N] = p[l];
			detail::boucWenPoint<S>(law, e, s, internal);
			for (int k = 0; k < N; ++k)
				y[k][l] = s[k], y[N + k][l] = internal[k];
			y[2 * N][l] = internal[N];
		}
	for (int k = 0; k < N; ++k)
		sigma[k] = y[k], eta[k] = y[N + k];
	p = y[2 * N];
}

} // namespace yade::mpm
