// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "Hardening.hpp"
#include "Internals.hpp"
#include "Tangent.hpp"

namespace yade::mpm {

/* Classical von Mises plasticity with linear kinematic (Prager) and isotropic hardening: the limit n -> infinity of the
hysteretic law.

  xi = sigma - eta,  f = sqrt(xi^T M xi) <= R(p),  eps_p' = p' a,  a = M xi / f,  eta' = p' H b(xi) / f

with b = StressState::backStressDirection. Internal variables: eta; p. */
struct J2 : LawDefaults {
	double             yieldStress = 0; // [Pa]
	double             hardening   = 0; // H [Pa]
	IsotropicHardening isotropic;

	static constexpr Internals maxInternals { 1, 1 };
	bool      operator==(const J2& o) const { return yieldStress == o.yieldStress && hardening == o.hardening && isotropic == o.isotropic; }
	Internals internals() const { return maxInternals; }
	void      check(const Hooke& C, Check& c) const
	{
		c.yieldStress(yieldStress, C.young);
		isotropic.check(c);
		c.hardeningModulus(hardening);
	}
	template <class S> double hardeningEnergy(const double* internal) const { return hardening > 0 ? S::mises2(internal) / (2 * hardening) : 0; }

	template <class S, int W, class T>
	void                    update(const Hooke& C, const Pack<W, T>* strain, Pack<W, T>* sigma, Pack<W, T>* internal, Responses<W, T>& response) const;
	template <class S> void tangent(const Hooke& C, const double* strain, const double* sigma, const double* internal, double* D) const
	{
		differentiateUpdate<S>(*this, C, strain, sigma, internal, D);
	}
};

namespace detail {
	/* xi splits into two parts, each scaled by a factor of its own in the return mapping, f^2 = A + B: where normal stresses are
	imposed (Simo & Taylor 1986), the mean in-plane normal stress and the rest; the deviator (B) alone elsewhere. */
	template <class S, class T> void splitMises(const T* xi, T& A, T& B)
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

	template <class S, class T> void scaleParts(const T& a, const T& b, T* xi)
	{
		if constexpr (normals<S>() == 1)
			xi[0] *= a;
		else if constexpr (normals<S>() == 2) {
			const T mean = .5 * a * (xi[0] + xi[1]), half = .5 * b * (xi[0] - xi[1]);
			xi[0] = mean + half, xi[1] = mean - half;
		} else if constexpr (normals<S>() == 3) {
			const T mean = (xi[0] + xi[1] + xi[2]) / 3;
			for (int k = 0; k < 3; ++k)
				xi[k] = mean + b * (xi[k] - mean);
		}
		for (int k = normals<S>(); k < S::N; ++k)
			xi[k] *= b;
	}
} // namespace detail

/* Backward Euler over a strain increment (engineering shear) in every lane: radial return, and in the subspace of imposed zero
normal stresses Simo & Taylor, IJNME 22 (1986) 649. sigma, eta and p are updated, dissipation is added to.

With g = dp/f at the end of the step, xi = (I + g (D M + H))^-1 xi_trial, and g is the root of 1/f(g) = 1/R(p + g f(g)). The
difference rises and is concave: Newton's method from g = 0 rises to the root, in one step where xi does not split and R is constant. */
template <class S, int W, class T>
void J2::update(const Hooke& C, const Pack<W, T>* strain, Pack<W, T>* sigma, Pack<W, T>* internal, Responses<W, T>& response) const
{
	using std::sqrt;
	Pack<W, T>*   eta = internal, &p = internal[S::N], &dissipation = response.dissipation;
	constexpr int N  = S::N;
	const double  kA = detail::splitModulus<S>(C) + hardening, kB = 3 * C.shear + hardening;
	Pack<W, T>    A, B, start, R, slope, f, g;
	auto          radius = [&](auto&& plastic) {
                if (isotropic.active())
                        for (int l = 0; l < W; ++l)
                                R[l] = isotropic.radius(yieldStress, plastic(l)), slope[l] = isotropic.slope(plastic(l));
                else
                        forLanes<W>([&](int l) { R[l] = yieldStress, slope[l] = 0; });
	};
	forLanes<W>([&](int l) {
		T e[N], De[N], xi[N];
		for (int k = 0; k < N; ++k)
			e[k] = strain[k][l];
		S::elastic(C, e, De);
		for (int k = 0; k < N; ++k)
			sigma[k][l] += De[k], xi[k] = sigma[k][l] - eta[k][l];
		detail::splitMises<S>(xi, A[l], B[l]);
		g[l] = 0;
	});
	radius([&](int l) { return p[l]; });
	start      = R;
	auto flows = [&](int l) { return A[l] + B[l] > start[l] * start[l]; };
	if (!anyLane<W>(flows)) return;

	int polish = std::is_same_v<T, double> ? 0 : 1; // the derivative of g takes one step of Newton beyond its value
	for (int iteration = 0; iteration < 100; ++iteration) {
		forLanes<W>([&](int l) {
			const T a = 1 / (1 + g[l] * kA), b = 1 / (1 + g[l] * kB);
			f[l] = sqrt(A[l] * a * a + B[l] * b * b);
		});
		radius([&](int l) { return p[l] + g[l] * f[l]; });
		auto       open      = [&](int l) { return flows(l) & (f[l] - R[l] > 1e-14 * R[l]); };
		const bool converged = !anyLane<W>(open);
		if (converged && polish-- == 0) break;
		forLanes<W>([&](int l) {
			const T    a = 1 / (1 + g[l] * kA), b = 1 / (1 + g[l] * kB), f2 = f[l] * f[l];
			const T    fall = A[l] * a * a * a * kA + B[l] * b * b * b * kB; // -f f'(g)
			const T    rise = fall * R[l] * R[l] + slope[l] * (f2 - g[l] * fall) * f2;
			const bool go   = open(l) | (converged & flows(l));
			const T    gain = f2 * R[l] * (f[l] - R[l]) / (go ? rise : 1);
			g[l] += go ? gain : T(0);
		});
	}
	forLanes<W>([&](int l) {
		T          xi[N], direction[N];
		const bool flow = flows(l);
		for (int k = 0; k < N; ++k)
			xi[k] = sigma[k][l] - eta[k][l];
		detail::scaleParts<S, T>(1 / (1 + g[l] * kA), 1 / (1 + g[l] * kB), xi);
		S::backStressDirection(xi, direction);
		for (int k = 0; k < N; ++k) {
			eta[k][l] += g[l] * hardening * direction[k];
			sigma[k][l] = flow ? xi[k] + eta[k][l] : sigma[k][l];
		}
		p[l] += g[l] * f[l];
		dissipation[l] += .5 * (start[l] + R[l]) * g[l] * f[l];
	});
}

} // namespace yade::mpm
