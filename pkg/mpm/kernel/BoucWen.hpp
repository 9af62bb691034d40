// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "StressState.hpp"
#include <algorithm>

namespace yade::mpm {

/* The hysteretic (Bouc-Wen-type) law of Sofianos & Koumousis, COMPDYN 2017, corrected (doc/law.md says what and why).

  xi = sigma - eta,  f = sqrt(xi^T M xi),  a = M xi / f,  H1 = (f/sigma_y)^n             (eqs. 24, 26)
  H2 = beta + gamma sign(a^T D eps')
  lambda' = H1 H2 (a^T D eps') / (a^T D a + H),  H = alpha E / (1 - alpha)               (eqs. 23, 25)
  sigma' = D (eps' - lambda' a),  eta' = lambda' H back(xi) / f                          (eqs. 21, 27)

lambda' is also the rate of the accumulated equivalent plastic strain, because f is of degree one in xi. The tangent
is elastic while f is small and plastic as f approaches sigma_y; there is no yield test. */
struct BoucWenParameters {
	Hooke  elastic;
	double yieldStress = 0;       // sigma_y [Pa]
	double n           = 10;      // sharpness of the knee, > 0
	double beta = .5, gamma = .5; // beta + gamma = 1, gamma >= |beta|
	double hardening = 0;         // H [Pa]
	double tolerance = 1e-4;      // admitted error of a sub-step, over sigma_y

	/* H of a uniaxial tangent ratio alpha = E_t/E. */
	static double hardeningModulus(double young, double tangentRatio) { return tangentRatio * young / (1 - tangentRatio); }
	/* Factor on D that bounds the tangent: unloading is stiffer than elastic where gamma > beta. */
	double stiffnessBound() const { return 1 + std::max(0., gamma - beta); }
};

namespace detail {
	/* z^n; n is a small whole number in most scenes, which spares the call of pow. */
	inline double power(double z, double n)
	{
		const int whole = int(n);
		if (whole != n || whole > 64) return std::pow(z, n);
		double result = 1;
		for (int bits = whole; bits; bits >>= 1, z *= z)
			if (bits & 1) result *= z;
		return result;
	}

	/* Rates over the whole increment: dSigma, dEta (N each) and the plastic multiplier, which it returns. */
	template <class S>
	double boucWenRate(const BoucWenParameters& law, const double* sigma, const double* eta, const double* De, double* dSigma, double* dEta)
	{
		double xi[S::N];
		for (int k = 0; k < S::N; ++k)
			xi[k] = sigma[k] - eta[k], dSigma[k] = De[k], dEta[k] = 0;
		const double f = std::sqrt(S::mises2(xi)), H1 = power(f / law.yieldStress, law.n);
		if (!(H1 > 1e-18)) return 0; // below round-off of the stress: elastic, and a has no direction at f = 0

		double a[S::N], Da[S::N], b[S::N];
		S::normal(xi, f, a), S::elastic(law.elastic, a, Da), S::back(xi, b);
		const double aDe = dot<S>(a, De), H2 = aDe > 0 ? law.beta + law.gamma : law.beta - law.gamma;
		const double lambda = H1 * H2 * aDe / (dot<S>(a, Da) + law.hardening);
		for (int k = 0; k < S::N; ++k)
			dSigma[k] -= lambda * Da[k], dEta[k] = lambda * law.hardening * b[k] / f;
		return lambda;
	}
} // namespace detail

/* Integrates the law over a strain increment (engineering shear). sigma and eta are updated; returns the increment of
the accumulated plastic strain.

Modified Euler pairs with error control: Sloan, IJNME 24 (1987) 893; Sloan, Abbo & Sheng, Eng. Comput. 18 (2001) 121.
Half the difference between the two slopes, over sigma_y, is the error of a sub-step; the next one is scaled by
0.9 sqrt(tolerance/error), within [0.1, 2], and does not grow right after a failure. */
template <class S> double boucWenUpdate(const BoucWenParameters& law, const double* strain, double* sigma, double* eta)
{
	constexpr int N = S::N;
	double        De[N], plastic = 0;
	S::elastic(law.elastic, strain, De);

	double done = 0, step = 1;
	bool   failed = false;
	while (done < 1) {
		step = std::min(step, 1 - done);
		double part[N], s1[N], e1[N], s2[N], e2[N], sEuler[N], eEuler[N];
		for (int k = 0; k < N; ++k)
			part[k] = step * De[k];
		const double p1 = detail::boucWenRate<S>(law, sigma, eta, part, s1, e1);
		for (int k = 0; k < N; ++k)
			sEuler[k] = sigma[k] + s1[k], eEuler[k] = eta[k] + e1[k];
		const double p2 = detail::boucWenRate<S>(law, sEuler, eEuler, part, s2, e2);

		double error2 = 0;
		for (int k = 0; k < N; ++k)
			error2 += (s2[k] - s1[k]) * (s2[k] - s1[k]);
		const double error = .5 * std::sqrt(error2) / law.yieldStress;
		double       scale = 2;
		if (error > 0) scale = std::min(2., std::max(.1, .9 * std::sqrt(law.tolerance / error)));
		if (error > law.tolerance && step > 1e-9 && std::isfinite(error)) {
			step *= scale, failed = true;
			continue;
		}
		for (int k = 0; k < N; ++k)
			sigma[k] += .5 * (s1[k] + s2[k]), eta[k] += .5 * (e1[k] + e2[k]);
		plastic += .5 * (p1 + p2);
		// f = sigma_y is a fixed point that the rounding of a sub-step may overshoot
		double xi[N];
		for (int k = 0; k < N; ++k)
			xi[k] = sigma[k] - eta[k];
		const double f = std::sqrt(S::mises2(xi));
		if (f > law.yieldStress * (1 + 1e-10))
			for (int k = 0; k < N; ++k)
				sigma[k] -= (1 - law.yieldStress / f) * xi[k];
		done = step < 1 - done ? done + step : 1;
		step *= failed ? std::min(scale, 1.) : scale;
		failed = false;
	}
	return plastic;
}

} // namespace yade::mpm
