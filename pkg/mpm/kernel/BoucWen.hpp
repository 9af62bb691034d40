// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "Hardening.hpp"
#include "Response.hpp"
#include "StressState.hpp"
#include <algorithm>

namespace yade::mpm {

/* The hysteretic (Bouc-Wen-type) law of Sofianos & Koumousis, COMPDYN 2017, corrected (doc/law.md says what and why).

  xi = sigma - eta,  f = sqrt(xi^T M xi),  a = M xi / f,  H1 = (f/sigma_y)^n             (eqs. 24, 26)
  H2 = beta + gamma sign(a^T D eps')
  lambda' = H1 H2 (a^T D eps') / (a^T D a + H),  H = alpha E / (1 - alpha)               (eqs. 23, 25)
  sigma' = D (eps' - lambda' a),  eta' = lambda' H back(xi) / f                          (eqs. 21, 27)

lambda' is also the rate of the accumulated equivalent plastic strain p, because f is of degree one in xi. The tangent
is elastic while f is small and plastic as f approaches sigma_y; there is no yield test.

Options, each of which is off by default and then costs nothing (doc/law.md has their equations):
  isotropic hardening       sigma_y becomes radius(p)
  strength degradation      H1 is multiplied by nu = 1 + d_nu e, with e the integral of f lambda' over sigma_y^2 / E
  stiffness degradation     D is divided by 1 + d_eta e, as far as the second law allows
  pinching                  slip on loading, about f = level sigma_y, that grows with e
  reloading                 below the last reversal, H1 shrinks by ((f - f_min)/(f_rev - f_min))^r */
struct BoucWenParameters {
	/* What H2 takes the sign of: a^T D eps', or eps^T sigma' as eq. 26 has it in print, with sigma' = D eps' because the
	tangent is what is being sought. The latter breaks f <= sigma_y and lambda' >= 0; it is there to compare with. */
	enum class LoadingRule { normal, paper };

	Hooke              elastic;
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

	/* H of a uniaxial tangent ratio alpha = E_t/E. */
	static double hardeningModulus(double young, double tangentRatio) { return tangentRatio * young / (1 - tangentRatio); }
	/* Factor on D that bounds the tangent: unloading is stiffer than elastic where gamma > beta. */
	double stiffnessBound() const { return 1 + std::max(0., gamma - beta); }

	bool degrades() const { return strengthDegradation != 0 || stiffnessDegradation != 0 || pinching != 0; }
	bool remembers() const { return reloading != 0; }
	bool paper() const { return loadingRule == LoadingRule::paper; }
	bool plain() const { return !isotropic.active() && !degrades() && !remembers() && !paper(); }

	/* Internal variables. Tensors: eta; the xi of the last reversal, or for the paper's rule the strain (tensor shear).
	Scalars: p; e and the growth of the compliance; f at the last reversal and the least f since. */
	int tensors() const { return 1 + (remembers() || paper()); }
	int scalars() const { return 1 + 2 * degrades() + 2 * remembers(); }
};

namespace detail {
	/* z^n; n is a whole or half number in most scenes, which spares the call of pow. */
	inline double power(double z, double n)
	{
		const double twice = 2 * n;
		if (!(twice <= 2048) || twice != int(twice)) return std::pow(z, n);
		double result = int(twice) & 1 ? std::sqrt(z) : 1;
		for (int bits = int(twice) >> 1; bits; bits >>= 1, z *= z)
			if (bits & 1) result *= z;
		return result;
	}

	/* What the law integrates, one flat vector y: sigma, eta, p, dissipation; with options also e, compliance growth, strain. */
	template <class S, bool options> struct BoucWenVector {
		static constexpr int eta = S::N, p = 2 * S::N, dissipation = p + 1, e = p + 2, compliance = p + 3, strain = p + 4;
		static constexpr int size = options ? strain + S::N : e;
	};

	/* The last turn from loading to unloading, until it is reached again or the stress has gone to the other side. */
	template <class S> struct Reversal {
		double xi[S::N] {}, f = 0, least = 0; // f = 0: none
		bool   elastic = false;               // the sub-step under way stays below f

		/* Positive while xi is on its side. */
		double along(const double* Mxi) const { return dot<S>(Mxi, xi); }
	};

	/* H1 H2 with the options: the part of the loading that flows. */
	template <class S>
	double flowRatio(const BoucWenParameters& law, const double* y, const Reversal<S>& reversal, const double* De, const double* Mxi, double f,
		double radius, double MxiDe)
	{
		using Y   = BoucWenVector<S, true>;
		double H1 = power(f / radius, law.n);
		if (law.paper()) {
			double product = 0;
			for (int k = 0; k < S::N; ++k)
				product += (S::solid[k] < 3 ? 1 : 2) * y[Y::strain + k] * De[k];
			return H1 * (product > 0 ? law.beta + law.gamma : law.beta - law.gamma);
		}
		H1 *= 1 + law.strengthDegradation * y[Y::e];
		if (!(MxiDe > 0)) return H1 * (law.beta - law.gamma);
		if (reversal.elastic) return 0;
		if (reversal.f > 0 && f < reversal.f && reversal.along(Mxi) > 0)
			H1 *= f > reversal.least ? power((f - reversal.least) / (reversal.f - reversal.least), law.reloading) : 0;
		if (law.pinching == 0) return H1;
		// Baber & Noori's factor on the loading stiffness 1 - H1, with the slip along a
		const double off = (f / radius - law.pinchingLevel) / law.pinchingWidth;
		const double h   = 1 + law.pinching * std::expm1(-law.pinchingRate * y[Y::e]) * std::exp(-off * off);
		return 1 - h * (1 - H1);
	}

	/* dy over a strain increment and the elastic stress De that belongs to it. With m = M xi = f a:
	   lambda' a = H1 H2 (m^T D eps') m / (m^T D m + H f^2),  lambda' = f times that ratio. */
	template <class S, bool options>
	void boucWenRate(const BoucWenParameters& law, const Reversal<S>& reversal, const double* y, const double* strain, const double* De, double* dy)
	{
		using Y         = BoucWenVector<S, options>;
		constexpr int N = S::N;
		double        xi[N], m[N], Dm[N], b[N], softening = 1, radius = law.yieldStress, hardening = law.hardening;
		if (options) {
			softening = 1 / (1 + y[Y::compliance]);
			radius    = law.isotropic.radius(radius, y[Y::p]);
			hardening += law.isotropic.slope(y[Y::p]);
			for (int k = 0; k < N; ++k)
				dy[Y::strain + k] = (S::solid[k] < 3 ? 1 : .5) * strain[k];
			dy[Y::e] = dy[Y::compliance] = 0;
		}
		for (int k = 0; k < N; ++k)
			xi[k] = y[k] - y[Y::eta + k], dy[k] = softening * De[k], dy[Y::eta + k] = 0;
		dy[Y::p] = dy[Y::dissipation] = 0;

		const double f2 = S::mises2(xi);
		S::normal(xi, 1, m);
		const double mDe = dot<S>(m, dy);
		if (!(f2 > 1e-24 * radius * radius)) return; // no direction
		const double f = std::sqrt(f2);
		double       H;
		if constexpr (options)
			H = flowRatio(law, y, reversal, De, m, f, radius, mDe);
		else {
			const double H2 = mDe > 0 ? law.beta + law.gamma : law.beta - law.gamma;
			H               = H2 != 0 ? power(f * (1 / law.yieldStress), law.n) * H2 : 0;
		}
		if (!(std::abs(H) > 1e-3 * law.tolerance)) return; // elastic within the tolerance

		S::elastic(law.elastic, m, Dm), S::back(xi, b);
		const double q = H * mDe / (softening * dot<S>(m, Dm) + hardening * f2);
		for (int k = 0; k < N; ++k)
			dy[k] -= q * softening * Dm[k], dy[Y::eta + k] = q * law.hardening * b[k];
		dy[Y::p] = q * f, dy[Y::dissipation] = q * f2;
		if constexpr (options) {
			if (!law.degrades()) return;
			// the compliance may grow by no more than the plastic work pays for
			const double unit = law.elastic.young / (law.yieldStress * law.yieldStress), stored = complianceProduct<S>(law.elastic, y);
			dy[Y::e]           = unit * q * f2;
			dy[Y::compliance]  = std::min(law.stiffnessDegradation * unit, stored > 0 ? 2 / stored : 0) * q * f2;
			dy[Y::dissipation] = std::max(0., q * f2 - .5 * dy[Y::compliance] * stored);
		}
	}

	/* Where along De the elastic stress reaches the reversal's f or leaves its side, if within step; else step. */
	template <class S> double reachOfReversal(const Reversal<S>& reversal, const double* m, double f2, const double* De, double step)
	{
		double MDe[S::N];
		S::normal(De, 1, MDe);
		const double mDe = dot<S>(m, De), side = reversal.along(m), A = S::mises2(De), C = f2 - reversal.f * reversal.f, turn = reversal.along(MDe);
		const double t = -C / (mDe + std::sqrt(std::max(0., mDe * mDe - A * C)));
		return std::max(0., std::min({ step, t, turn < 0 ? -side / turn : step }));
	}

	/* Modified Euler pairs with error control, after Sloan. */
	template <class S, bool options>
	void boucWenIntegrate(const BoucWenParameters& law, const double* strain, Reversal<S>& reversal, double* y, int* subSteps)
	{
		using Y         = BoucWenVector<S, options>;
		constexpr int N = S::N, size = Y::size;
		double        De[N], part[N], partStrain[N], dy1[size], dy2[size], euler[size], xi[N];
		S::elastic(law.elastic, strain, De);

		const double admitted = .25 * law.tolerance * law.tolerance * law.yieldStress * law.yieldStress; // of |dy2 - dy1|^2
		double       done = 0, step = 1;
		bool         failed = false;
		while (done < 1) {
			step           = std::min(step, 1 - done);
			bool unloading = false, reached = false;
			if (options && law.remembers()) {
				double m[N];
				for (int k = 0; k < N; ++k)
					xi[k] = y[k] - y[Y::eta + k];
				S::normal(xi, 1, m);
				const double f2 = S::mises2(xi);
				unloading       = dot<S>(m, De) < 0;
				if (unloading && reversal.f == 0 && f2 > 0) reversal.f = reversal.least = std::sqrt(f2), std::copy(xi, xi + N, reversal.xi);
				reversal.elastic = !unloading && reversal.f > 0 && std::isinf(law.reloading);
				if (reversal.elastic) {
					double scaled[N];
					for (int k = 0; k < N; ++k)
						scaled[k] = De[k] / (1 + y[Y::compliance]);
					const double limit = reachOfReversal(reversal, m, f2, scaled, step);
					reached            = limit < step;
					step               = limit;
				}
			}
			for (int k = 0; k < N; ++k)
				part[k] = step * De[k], partStrain[k] = step * strain[k];
			boucWenRate<S, options>(law, reversal, y, partStrain, part, dy1);
			for (int k = 0; k < size; ++k)
				euler[k] = y[k] + dy1[k];
			boucWenRate<S, options>(law, reversal, euler, partStrain, part, dy2);

			double error2 = 0;
			for (int k = 0; k < 2 * N; ++k)
				error2 += (dy2[k] - dy1[k]) * (dy2[k] - dy1[k]);
			const bool good = error2 <= admitted;
			if (!good && step > 1e-9) {
				step *= std::isfinite(error2) ? std::max(.1, .9 * std::sqrt(std::sqrt(admitted / error2))) : .1;
				failed = true;
				continue;
			}
			for (int k = 0; k < size; ++k)
				y[k] += .5 * (dy1[k] + dy2[k]);
			if (subSteps) ++*subSteps;

			for (int k = 0; k < N; ++k)
				xi[k] = y[k] - y[Y::eta + k];
			const double f2 = S::mises2(xi), radius = options ? law.isotropic.radius(law.yieldStress, y[Y::p]) : law.yieldStress;
			if (f2 > radius * radius * (1 + 2e-10) && !(options && law.paper())) {
				// f = sigma_y is a fixed point that the rounding of a sub-step may overshoot
				const double excess = 1 - radius / std::sqrt(f2);
				for (int k = 0; k < N; ++k)
					y[k] -= excess * xi[k];
			}
			if (options && law.remembers() && reversal.f > 0) {
				double m[N];
				S::normal(xi, 1, m);
				if (unloading) reversal.least = std::sqrt(f2);
				if (reached || (!unloading && f2 >= reversal.f * reversal.f) || !(reversal.along(m) > 0)) reversal.f = 0;
			}
			done = step < 1 - done ? done + step : 1;
			if (reached)
				step = 1;
			else if (done < 1 && !failed)
				step *= error2 > 0 ? std::min(2., .9 * std::sqrt(std::sqrt(admitted / error2))) : 2;
			failed = false;
		}
	}
} // namespace detail

/* Integrates the law over a strain increment (engineering shear); sigma and the internal variables are updated. subSteps,
where given, counts the sub-steps.

Sub-steps are modified Euler pairs: Sloan, IJNME 24 (1987) 893; Sloan, Abbo & Sheng, Eng. Comput. 18 (2001) 121. Half
the difference of the two slopes' stresses, over sigma_y, estimates the error of the first-order member and is kept below
a quarter of the tolerance; the second-order member is carried on. The next sub-step is scaled by 0.9 sqrt(admitted/error), within
[0.1, 2], and does not grow right after a failure. Loading forgets errors, so that those of a path do not add up. */
template <class S>
void boucWenUpdate(const BoucWenParameters& law, const double* strain, double* sigma, double* internal, Response* response = nullptr, int* subSteps = nullptr)
{
	constexpr int       N = S::N;
	detail::Reversal<S> reversal;
	double*             scalars = internal + law.tensors() * N;
	auto                run     = [&](auto options) {
                using Y = detail::BoucWenVector<S, options.value>;
                double y[Y::size] {};
                std::copy(sigma, sigma + N, y), std::copy(internal, internal + N, y + Y::eta);
                y[Y::p] = scalars[0];
                if constexpr (options.value) {
                        if (law.degrades()) y[Y::e] = scalars[1], y[Y::compliance] = scalars[2];
                        if (law.remembers()) {
                                const double* kept = scalars + law.scalars() - 2;
                                reversal.f = kept[0], reversal.least = kept[1], std::copy(internal + N, internal + 2 * N, reversal.xi);
                        }
                        if (law.paper()) std::copy(internal + N, internal + 2 * N, y + Y::strain);
                }
                detail::boucWenIntegrate<S, options.value>(law, strain, reversal, y, subSteps);
                std::copy(y, y + N, sigma), std::copy(y + Y::eta, y + Y::eta + N, internal);
                scalars[0] = y[Y::p];
                if (response) response->dissipation += y[Y::dissipation];
                if constexpr (options.value) {
                        if (law.degrades()) scalars[1] = y[Y::e], scalars[2] = y[Y::compliance];
                        if (law.remembers()) {
                                double* kept = scalars + law.scalars() - 2;
                                kept[0] = reversal.f, kept[1] = reversal.least, std::copy(reversal.xi, reversal.xi + N, internal + N);
                        }
                        if (law.paper()) std::copy(y + Y::strain, y + Y::strain + N, internal + N);
                }
	};
	if (law.plain())
		run(std::false_type {});
	else
		run(std::true_type {});
}

} // namespace yade::mpm
