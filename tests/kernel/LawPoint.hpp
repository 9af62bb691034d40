// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "kernel/laws/StrainIncrement.hpp"
#include <functional>
#include <random>
#include <vector>

namespace yade::mpm {

/* Laws and exact answers for tests of one material point: steel, strains in yield strains sigma_y/E, stresses over sigma_y. */
constexpr double youngModulus = 210e9, poissonRatio = .3, yieldStress = 240e6, yieldStrain = yieldStress / youngModulus;

inline Law boucWenLaw(double n, double tangentRatio, double tolerance)
{
	Law law;
	law.model = BoucWen(), law.elastic = { youngModulus, poissonRatio };
	as<BoucWen>(law).yieldStress = yieldStress, as<BoucWen>(law).n = n, as<BoucWen>(law).tolerance = tolerance;
	as<BoucWen>(law).hardening = hardeningModulus(youngModulus, tangentRatio);
	return law;
}
inline Law j2Law(double tangentRatio)
{
	Law law;
	law.model = J2(), law.elastic = { youngModulus, poissonRatio };
	as<J2>(law).yieldStress = yieldStress;
	as<J2>(law).hardening   = hardeningModulus(youngModulus, tangentRatio);
	return law;
}

/* A point of one law and stress state. */
template <class S> struct LawPoint {
	Law                 law;
	double              sigma[S::N] {};
	std::vector<double> internal;
	Response            response;
	double              work = 0; // trapezoids of sigma . d eps

	std::array<double, std::size_t(S::dim* S::dim)> F {}; // deformation gradient

	explicit LawPoint(const Law& law_)
	    : law(law_)
	    , internal(std::size_t(Internals::of(law).columns(S::N)), 0.)
	{
		for (int d = 0; d < S::dim; ++d)
			F[std::size_t(d * (S::dim + 1))] = 1;
	}
	void strain(const std::array<double, S::N>& increment, int steps = 1)
	{
		double part[S::N];
		for (int k = 0; k < S::N; ++k)
			part[k] = increment[std::size_t(k)] / steps;
		for (int i = 0; i < steps; ++i) {
			work += .5 * dot<S>(sigma, part);
			updateStress<LawState<S>>(law, part, sigma, internal.data(), &response);
			work += .5 * dot<S>(sigma, part);
		}
	}
	double plasticStrain() const { return internal[std::size_t(Internals::of(law).tensors * S::N)]; }
	/* Equivalent stress of sigma - eta, over sigma_y. */
	double f() const
	{
		double xi[S::N];
		for (int k = 0; k < S::N; ++k)
			xi[k] = sigma[k] - (Internals::of(law).tensors > 0 ? internal[std::size_t(k)] : 0);
		return std::sqrt(S::mises2(xi)) / yieldStress;
	}
	/* A step of the kinematics, then the law. */
	void deform(bool large, const double* G)
	{
		double increment[S::N];
		strainIncrement<S>(law, large, G, F.data(), sigma, internal.data(), increment);
		updateStress<LawState<S>>(law, increment, sigma, internal.data(), &response);
		advanceDeformation<S::dim>(G, large, F.data());
	}
	double energy() const { return elasticEnergy<S>(law, sigma, internal.data()) + hardeningEnergy<S>(law, internal.data()); }
};

/* The exact uniaxial solution for beta = gamma = 1/2: sigma = alpha E eps + (1 - alpha) sigma_y z with
  loading    x - x0 = g(z) - g(z0),  g(z) = int_0^z dw/(1 - w^n) = z 2F1(1, 1/n; 1 + 1/n; z^n)
  unloading  dz = dx, down to z = 0 */
struct ExactUniaxial {
	double n, alpha, x = 0, z = 0;

	static double digamma(double v)
	{
		double shift = 0;
		for (; v < 12; v += 1)
			shift -= 1 / v;
		const double w = 1 / (v * v);
		return shift + std::log(v) - .5 / v - w * (1. / 12 - w * (1. / 120 - w * (1. / 252 - w * (1. / 240 - w / 132))));
	}
	/* g at z = 1 - y; Abramowitz & Stegun 15.1.1 and, towards z = 1, 15.3.10. */
	double g(double y) const
	{
		const double z_ = 1 - y, complement = -std::expm1(n * std::log1p(-y)), b = 1 / n; // 1 - z^n
		double       sum = 0, term = 1;
		if (complement > .5) {
			for (int k = 0; k < 200; ++k, term *= 1 - complement)
				sum += term / (n * k + 1);
			return z_ * sum;
		}
		for (int k = 0; k < 200; ++k) {
			sum += term * (digamma(k + 1) - digamma(b + k) - std::log(complement));
			term *= (b + k) / (k + 1) * complement;
		}
		return z_ * b * sum;
	}
	/* Goes to x = to; returns sigma / sigma_y there. */
	double go(double to)
	{
		const double sign = to > x ? 1 : -1;
		double       way = std::abs(to - x), w = sign * z;
		const double unloading = std::min(way, std::max(0., -w));
		w += unloading, way -= unloading;
		if (way > 0) {
			const double goal = way + g(1 - w);
			double       low = -745, high = std::log(1 - w); // bisection on log(1 - z)
			for (int k = 0; k < 200; ++k) {
				const double middle                       = .5 * (low + high);
				(g(std::exp(middle)) > goal ? low : high) = middle;
			}
			w = -std::expm1(.5 * (low + high));
		}
		x = to, z = sign * w;
		return alpha * x + (1 - alpha) * z;
	}
};

} // namespace yade::mpm
