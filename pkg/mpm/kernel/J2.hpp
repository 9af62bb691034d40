// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "Hardening.hpp"
#include "Response.hpp"
#include "StressState.hpp"

namespace yade::mpm {

/* Classical von Mises plasticity with linear kinematic (Prager) and isotropic hardening: the limit n -> infinity of the
hysteretic law.

  xi = sigma - eta,  f = sqrt(xi^T M xi) <= R(p),  eps_p' = p' a,  a = M xi / f,  eta' = p' H back(xi) / f */
struct J2Parameters {
	Hooke              elastic;
	double             yieldStress = 0; // [Pa]
	double             hardening   = 0; // H [Pa]
	IsotropicHardening isotropic;
};

namespace detail {
	/* xi splits into two parts that the return mapping scales each on its own, f^2 = A + B: where normal stresses are
	imposed (Simo & Taylor 1986), the mean in-plane normal stress and the rest; the deviator (B) alone elsewhere. */
	template <class S> void splitMises(const double* xi, double& A, double& B)
	{
		if constexpr (normals<S>() == 1)
			A = xi[0] * xi[0];
		else if constexpr (normals<S>() == 2)
			A = .25 * (xi[0] + xi[1]) * (xi[0] + xi[1]);
		else
			A = 0;
		B = S::mises2(xi) - A;
	}
	/* Eigenvalue of D M on part A; on part B it is 3 G. */
	template <class S> double splitModulus(const Hooke& C) { return normals<S>() == 1 ? C.young : .5 * C.young / (1 - C.poisson); }

	template <class S> void scaleParts(double a, double b, double* xi)
	{
		if constexpr (normals<S>() == 1)
			xi[0] *= a;
		else if constexpr (normals<S>() == 2) {
			const double mean = .5 * a * (xi[0] + xi[1]), half = .5 * b * (xi[0] - xi[1]);
			xi[0] = mean + half, xi[1] = mean - half;
		} else if constexpr (normals<S>() == 3) {
			const double mean = (xi[0] + xi[1] + xi[2]) / 3;
			for (int k = 0; k < 3; ++k)
				xi[k] = mean + b * (xi[k] - mean);
		}
		for (int k = normals<S>(); k < S::N; ++k)
			xi[k] *= b;
	}
} // namespace detail

/* Backward Euler over a strain increment (engineering shear): radial return, and in the subspace of imposed zero normal
stresses Simo & Taylor, IJNME 22 (1986) 649. sigma, eta and p are updated.

With g = dp/f at the end of the step, xi = (I + g (D M + H))^-1 xi_trial, and g is the root of f(g) = R(p + g f(g)), whose
difference falls and is convex: Newton's method from g = 0 rises to it. */
template <class S> void j2Update(const J2Parameters& law, const double* strain, double* sigma, double* eta, double& p, Response* response)
{
	constexpr int N = S::N;
	double        De[N], xi[N], A, B;
	S::elastic(law.elastic, strain, De);
	for (int k = 0; k < N; ++k)
		sigma[k] += De[k], xi[k] = sigma[k] - eta[k];
	detail::splitMises<S>(xi, A, B);
	const double start = law.isotropic.radius(law.yieldStress, p);
	if (A + B <= start * start) return;

	const double kA = detail::splitModulus<S>(law.elastic) + law.hardening, kB = 3 * law.elastic.shear + law.hardening;
	double       g = 0, f = 0, R = 0;
	for (int iteration = 0; iteration < 100; ++iteration) {
		const double a = 1 / (1 + g * kA), b = 1 / (1 + g * kB);
		f = std::sqrt(A * a * a + B * b * b), R = law.isotropic.radius(law.yieldStress, p + g * f);
		if (f - R <= 1e-14 * R) break;
		const double df = -(A * a * a * a * kA + B * b * b * b * kB) / f;
		g -= (f - R) / (df - law.isotropic.slope(p + g * f) * (f + g * df));
	}
	detail::scaleParts<S>(1 / (1 + g * kA), 1 / (1 + g * kB), xi);
	double back[N];
	S::back(xi, back);
	for (int k = 0; k < N; ++k)
		eta[k] += g * law.hardening * back[k], sigma[k] = xi[k] + eta[k];
	p += g * f;
	if (response) response->dissipation += .5 * (start + R) * g * f;
}

} // namespace yade::mpm
