// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "../Hardening.hpp"
#include "../Internals.hpp"
#include "../Tangent.hpp"
#include <algorithm>
#include <limits>

namespace yade::mpm {

/* The hysteretic (Bouc-Wen-type) law of Sofianos & Koumousis, COMPDYN 2017, corrected (doc/law.md derives the corrections).

  xi = sigma - eta,  f = sqrt(xi^T M xi),  a = M xi / f,  H1 = (f/sigma_y)^n             (eqs. 24, 26)
  H2 = beta + gamma sign(a^T D eps')
  lambda' = H1 H2 (a^T D eps') / (a^T D a + H),  H = alpha E / (1 - alpha)               (eqs. 23, 25)
  sigma' = D (eps' - lambda' a),  eta' = lambda' H b(xi) / f                             (eqs. 21, 27)

with b = StressState::backStressDirection. lambda' is also the rate of the accumulated equivalent plastic strain p, because f is of degree one in xi. The
tangent is elastic while f is small and plastic as f approaches sigma_y; there is no yield test.

Options, each of which is off by default and then costs nothing (doc/law.md has their equations):
  isotropic hardening       sigma_y becomes radius(p)
  strength degradation      H1 is multiplied by nu = 1 + d_nu e, with e the integral of f lambda', or of xi : eps', over sigma_y^2 / E
  stiffness degradation     D is divided by 1 + d_eta e, as far as the second law allows
  pinching                  slip on loading, about f = level sigma_y, that grows with e
  reloading                 below f_rev, from which the point had unloaded, H1 shrinks by ((f - f_0)/(f_rev - f_0))^r */
struct BoucWen : LawDefaults {
	/* The argument of the sign in H2: a^T D eps', or eps^T sigma' as eq. 26 has it in print, with sigma' = D eps' because the
	tangent is not known yet. The latter breaks f <= sigma_y and lambda' >= 0; it serves for comparison only. */
	enum class LoadingRule { normal, paper };
	/* The measure e of degradation: plastic work, or the work of xi on the whole strain, of which elastic unloading takes back a part. The
	latter is Baber and Noori's e = int z du; it heals on unloading, and its dissipation may be negative for a while. */
	enum class DegradationMeasure { plastic, hysteretic };

	double             yieldStress = 0;       // sigma_y [Pa]
	double             n           = 10;      // sharpness of the knee, > 0
	double             beta = .5, gamma = .5; // beta + gamma = 1, gamma >= |beta|
	double             hardening   = 0;       // H [Pa]
	double             tolerance   = 1e-4;    // bounds the error of the stress, over sigma_y
	LoadingRule        loadingRule = LoadingRule::normal;
	IsotropicHardening isotropic;
	double             strengthDegradation  = 0;  // d_nu >= 0
	double             stiffnessDegradation = 0;  // d_eta, 0 to 2
	double             pinching             = 0;  // greatest part of the loading stiffness lost, 0 to below 1
	double             pinchingRate         = 1;  // of its growth with e, > 0
	double             pinchingLevel        = 0;  // f/sigma_y about which it acts, 0 to below 1
	double             pinchingWidth        = .2; // width of that, over sigma_y, > 0
	double             reloading            = 0;  // r: 0 off; 1 and more smooth, infinity elastic reloading
	DegradationMeasure degradationMeasure   = DegradationMeasure::plastic;

	bool operator==(const BoucWen& o) const
	{
		return yieldStress == o.yieldStress && n == o.n && beta == o.beta && gamma == o.gamma && hardening == o.hardening && tolerance == o.tolerance
		       && loadingRule == o.loadingRule && isotropic == o.isotropic && strengthDegradation == o.strengthDegradation
		       && stiffnessDegradation == o.stiffnessDegradation && pinching == o.pinching && pinchingRate == o.pinchingRate
		       && pinchingLevel == o.pinchingLevel && pinchingWidth == o.pinchingWidth && reloading == o.reloading
		       && degradationMeasure == o.degradationMeasure;
	}

	/* Factor on D that bounds the tangent: unloading is stiffer than elastic where gamma > beta. */
	double stiffnessBound(const Hooke&) const { return 1 + std::max(0., gamma - beta); }

	bool degrades() const { return strengthDegradation != 0 || stiffnessDegradation != 0 || pinching != 0; }
	bool hysteretic() const { return degradationMeasure == DegradationMeasure::hysteretic; }
	bool remembers() const { return reloading != 0; }
	bool paper() const { return loadingRule == LoadingRule::paper; }
	bool plain() const { return !isotropic.active() && !degrades() && !remembers() && !paper(); }

	/* Internal variables. Tensors: eta; for the paper's rule the strain (tensor shear). Scalars: p; e and the growth of the
	compliance; f_rev and f_0. */
	int                        tensors() const { return 1 + paper(); }
	int                        scalars() const { return 1 + 2 * degrades() + 2 * remembers(); }
	Internals                  internals() const { return { tensors(), scalars() }; }
	static constexpr Internals maxInternals { 2, 5 };

	bool                                 keepsVolume() const { return stiffnessDegradation == 0; }
	template <class S, class Get> double complianceGrowth(Get&& internal) const { return degrades() ? 1 + internal(tensors() * S::N + 2) : 1; }
	template <class S> double            hardeningEnergy(const double* internal) const { return hardening > 0 ? S::mises2(internal) / (2 * hardening) : 0; }
	void                                 check(const Hooke& C, Check& c) const;

	/* Integrates the law over a strain increment (engineering shear) in every lane; sigma and the internal variables (tensors, then
	scalars) are updated, dissipation is added to. subSteps, where given, counts the sub-steps of all lanes. */
	template <class S, int W, class T>
	void update(
		const Hooke& C, const Pack<W, T>* strain, Pack<W, T>* sigma, Pack<W, T>* internal, Responses<W, T>& response, int* subSteps = nullptr) const;
	/* The tangent consistent with the sub-steps of update(). */
	template <class S> void tangent(const Hooke& C, const double* strain, const double* sigma, const double* internal, double* D) const
	{
		differentiateUpdate<S>(*this, C, strain, sigma, internal, D);
	}
	/* The continuum tangent of eq. 27, D (I - H1 H2 R), for a strain rate along `strain`. */
	template <class S> void continuumTangent(const Hooke& C, const double* strain, const double* sigma, const double* internal, double* D) const;
};

inline void BoucWen::check(const Hooke& C, Check& c) const
{
	c.yieldStress(yieldStress, C.young);
	c.require(n > 0 && std::isfinite(n), "n", n, "give a positive exponent, 1 to 50 for metals");
	c.require(std::abs(beta + gamma - 1) <= 1e-12, "beta + gamma", beta + gamma,
		"the two must add to 1, or yieldStress is not the stress that is reached; 0.5 and 0.5 unload elastically");
	c.require(gamma >= std::abs(beta), "gamma", gamma, "give at least abs(beta), or a cycle can create energy");
	c.hardeningModulus(hardening);
	c.require(tolerance >= 1e-13 && tolerance <= .1, "tolerance", tolerance, "give 1e-13 to 0.1; 1e-4 suits most scenes");
	isotropic.check(c);
	c.finiteNotNegative("strengthDegradation", strengthDegradation);
	c.require(stiffnessDegradation >= 0 && stiffnessDegradation <= 2, "stiffnessDegradation", stiffnessDegradation,
		"give 0 to 2: beyond, a bar at yield would release more energy than the flow dissipates");
	c.require(!hysteretic() || degrades(), "degradationMeasure", "'hysteretic'",
		"give strengthDegradation, stiffnessDegradation or pinching that it measures, or keep 'plastic'");
	c.require(pinching >= 0 && pinching < 1, "pinching", pinching, "give 0 to below 1: at 1 loading finds no stiffness");
	c.require(pinchingRate > 0 && std::isfinite(pinchingRate), "pinchingRate", pinchingRate, "give a positive number");
	c.require(pinchingLevel >= 0 && pinchingLevel < 1, "pinchingLevel", pinchingLevel, "give 0 to below 1, a part of the yield stress");
	c.require(pinchingWidth > 0 && std::isfinite(pinchingWidth), "pinchingWidth", pinchingWidth, "give a positive part of the yield stress");
	c.require(reloading == 0 || reloading >= 1, "reloading", reloading, "give 0 (off), an exponent of 1 or more, or infinity for elastic reloading");
	c.require(!paper() || (!degrades() && !remembers() && !isotropic.active()), "loadingRule", "'paper'",
		"choose 'normal': 'paper' is there to compare with and does not go with hardening of the yield stress, degradation, pinching or reloading");
}

} // namespace yade::mpm
