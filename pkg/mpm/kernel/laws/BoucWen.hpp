// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "../Reals.hpp"
#include "Hardening.hpp"
#include "J2.hpp"
#include "StressState.hpp"
#include <algorithm>
#include <limits>

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
  reloading                 below f_rev, where it had unloaded from, H1 shrinks by ((f - f_0)/(f_rev - f_0))^r */
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

	/* Internal variables. Tensors: eta; for the paper's rule the strain (tensor shear). Scalars: p; e and the growth of the
	compliance; f_rev and f_0. */
	int tensors() const { return 1 + paper(); }
	int scalars() const { return 1 + 2 * degrades() + 2 * remembers(); }
};

namespace detail {
	inline bool isHalfOrWhole(double n) { return 2 * n <= 2048 && 2 * n == int(2 * n); }

	/* z^n; n is a whole or half number in most scenes, which spares the call of pow. Up to `small`, pow may give 0. */
	template <int W> void power(const Reals<W>& base, double n, double small, Reals<W>& result)
	{
		if (!isHalfOrWhole(n)) {
			for (int l = 0; l < W; ++l)
				result[l] = base[l] > small ? std::pow(base[l], n) : 0;
			return;
		}
		const int  twice = int(2 * n);
		const bool half  = twice & 1;
		Reals<W>   z     = base;
		forLanes<W>([&](int l) { result[l] = half ? std::sqrt(z[l]) : 1; });
		for (int bits = twice >> 1; bits; bits >>= 1) {
			if (bits & 1) forLanes<W>([&](int l) { result[l] *= z[l]; });
			forLanes<W>([&](int l) { z[l] *= z[l]; });
		}
	}

	/* What the law integrates, one flat vector y: sigma, eta, p, dissipation; with options also e, compliance growth, strain. */
	template <class S, bool options> struct BoucWenVector {
		static constexpr int eta = S::N, p = 2 * S::N, dissipation = p + 1, e = p + 2, compliance = p + 3, strain = p + 4;
		static constexpr int size = options ? strain + S::N : e;
	};

	template <class S, int W> void backStressFree(const Reals<W>* y, int l, double* xi)
	{
		for (int k = 0; k < S::N; ++k)
			xi[k] = y[k][l] - y[S::N + k][l];
	}

	/* What compatible reloading remembers: the f up to which it goes, limit, and that from which, origin. Unloading moves both
	continuously and loading at the limit makes them f, so that what follows depends continuously on the path (doc/law.md). */
	template <class S, int W> struct Reloading {
		static constexpr double depth = 4; // limit <= depth f

		Reals<W> limit {}, origin {};
		// the sub-step under way: whether it unloads, has no flow where it loads, loads at the limit, is cut short; where it begins
		Reals<W> unloads {}, elastic {}, atLimit {}, stops {}, xi[S::N] {};

		/* Before a sub-step, which ends at the latest where f turns or where elastic reloading meets the limit. */
		void begin(const BoucWenParameters& law, const Reals<W>* y, const Reals<W>* De, Reals<W>& step)
		{
			const bool sharp = std::isinf(law.reloading);
			forLanes<W>([&](int l) {
				double       x[S::N], m[S::N], de[S::N];
				const double softening = 1 / (1 + y[BoucWenVector<S, true>::compliance][l]);
				backStressFree<S>(y, l, x);
				for (int k = 0; k < S::N; ++k)
					xi[k][l] = x[k], de[k] = softening * De[k][l];
				S::normal(x, 1, m);
				// of an elastic path f^2 = f2 + 2 t B + t^2 A
				const double f2 = S::mises2(x), B = dot<S>(m, de), A = S::mises2(de), C = f2 - limit[l] * limit[l];
				const double turn = -B / (A > 0 ? A : 1), meet = -C / (B + std::sqrt(std::max(0., B * B - A * C)));
				// what is nearer than rounding has been reached
				const bool   back = turn > 1e-9, below = C < -2e-9 * f2, up = !back & below & sharp & (meet > 1e-9);
				const double most = back ? turn : up ? meet : step[l];
				unloads[l] = back, elastic[l] = back | up, atLimit[l] = !back & !up & (sharp | !below), stops[l] = most < step[l];
				step[l] = most < step[l] ? most : step[l];
			});
		}
		/* After it, where it is accepted. */
		void end(const Reals<W>* y, const Reals<W>& done, const Reals<W>& accepted)
		{
			forLanes<W>([&](int l) {
				double x[S::N], from[S::N], way[S::N], turned[S::N], m[S::N];
				backStressFree<S>(y, l, x);
				for (int k = 0; k < S::N; ++k)
					from[k] = xi[k][l], way[k] = x[k] - from[k];
				S::normal(from, 1, m);
				const double A = S::mises2(way), turn = -dot<S>(m, way) / (A > 0 ? A : 1), t = turn < 0 ? 0 : turn < 1 ? turn : 1;
				for (int k = 0; k < S::N; ++k)
					turned[k] = from[k] + t * way[k];
				const double before = std::sqrt(S::mises2(from)), least = std::sqrt(S::mises2(turned)), after = std::sqrt(S::mises2(x));
				// (1 - origin/limit) (1 - f/limit)^3 stays
				const double over = limit[l] > 0 ? 1 / limit[l] : 0, ratio = std::max(least * over, 1 / depth),
					     lower  = std::min(limit[l], depth * least);
				const double closer = (1 - before * over) / (ratio < 1 ? 1 - ratio : 1);
				const double start  = std::min(least, lower * (1 - (1 - origin[l] * over) * closer * closer * closer));
				const bool   taken = (accepted[l] != 0) & (done[l] < 1), back = taken & (unloads[l] != 0);
				const bool   meets = taken & (unloads[l] == 0) & ((atLimit[l] != 0) | (after >= (1 - 1e-9) * limit[l]));
				limit[l]           = back ? lower : meets ? after : limit[l];
				origin[l]          = back ? start : meets ? after : origin[l];
			});
		}
		/* The factor on H1 of a lane that loads is this to the power r. */
		double part(const Reals<W>& f, int l) const
		{
			const bool below = (atLimit[l] == 0) & (f[l] < limit[l]);
			return below ? std::max(0., f[l] - origin[l]) / std::max(limit[l] - origin[l], 1e-9 * limit[l]) : 1;
		}
	};

	/* The part of the loading that flows, with the options: H1 H2, where H1 comes in and goes out. */
	template <class S, int W>
	void flowRatio(const BoucWenParameters& law, const Reals<W>* y, const Reals<W>* De, const Reloading<S, W>& reloading, const Reals<W>& f,
		const Reals<W>& radius, const Reals<W>& mDe, Reals<W>& H1)
	{
		using Y               = BoucWenVector<S, true>;
		constexpr int N       = S::N;
		const double  loading = law.beta + law.gamma, unloading = law.beta - law.gamma;
		if (law.paper()) {
			forLanes<W>([&](int l) {
				double product = 0;
				for (int k = 0; k < N; ++k)
					product += (S::solid[k] < 3 ? 1 : 2) * y[Y::strain + k][l] * De[k][l];
				H1[l] *= product > 0 ? loading : unloading;
			});
			return;
		}
		forLanes<W>([&](int l) { H1[l] *= 1 + law.strengthDegradation * y[Y::e][l]; });
		Reals<W> loads = H1;
		if (law.remembers()) {
			Reals<W> part, factor;
			forLanes<W>([&](int l) { part[l] = reloading.part(f, l); });
			if (std::isinf(law.reloading))
				forLanes<W>([&](int l) { factor[l] = part[l] < 1 ? 0 : 1; });
			else
				power(part, law.reloading, 0, factor);
			forLanes<W>([&](int l) { loads[l] *= factor[l]; });
		}
		if (law.pinching != 0) // Baber & Noori's factor on the loading stiffness 1 - H1, with the slip along a
			for (int l = 0; l < W; ++l) {
				const double off = (f[l] / radius[l] - law.pinchingLevel) / law.pinchingWidth;
				const double h   = 1 + law.pinching * std::expm1(-law.pinchingRate * y[Y::e][l]) * std::exp(-off * off);
				loads[l]         = 1 - h * (1 - loads[l]);
			}
		forLanes<W>([&](int l) { H1[l] = mDe[l] > 0 ? (reloading.elastic[l] != 0 ? 0 : loads[l]) : H1[l] * unloading; });
	}

	/* dy over a strain increment and the elastic stress De that belongs to it, and the sign of loading. With m = M xi = f a:
	   lambda' a = H1 H2 (m^T D eps') m / (m^T D m + H f^2),  lambda' = f times that ratio.
	Up to z = f/sigma_y = small, the flow is known to be none. */
	template <class S, bool options, int W>
	void boucWenRate(const BoucWenParameters& law, double small, const Reloading<S, W>& reloading, const Reals<W>* y, const Reals<W>* strain,
		const Reals<W>* De, Reals<W>* dy, Reals<W>& mDe)
	{
		using Y          = BoucWenVector<S, options>;
		constexpr int N  = S::N;
		const double  sy = law.yieldStress, overYield = 1 / sy, least = 1e-3 * law.tolerance, loading = law.beta + law.gamma,
			     unloading = law.beta - law.gamma;
		const Hooke& C         = law.elastic;
		Reals<W>     radius, slope, f, z, H;
		if constexpr (options) {
			for (int l = 0; l < W; ++l)
				radius[l] = law.isotropic.radius(sy, y[Y::p][l]), slope[l] = law.isotropic.slope(y[Y::p][l]);
			forLanes<W>([&](int l) {
				for (int k = 0; k < N; ++k)
					dy[Y::strain + k][l] = (S::solid[k] < 3 ? 1 : .5) * strain[k][l];
				dy[Y::e][l] = dy[Y::compliance][l] = 0;
			});
		}
		auto softeningOf = [&](int l) {
			if constexpr (options) return 1 / (1 + y[Y::compliance][l]);
			return 1.;
		};
		forLanes<W>([&](int l) {
			double       xi[N], m[N], de[N];
			const double softening = softeningOf(l);
			backStressFree<S>(y, l, xi);
			for (int k = 0; k < N; ++k)
				de[k] = softening * De[k][l], dy[k][l] = de[k], dy[Y::eta + k][l] = 0;
			dy[Y::p][l] = dy[Y::dissipation][l] = 0;
			S::normal(xi, 1, m);
			mDe[l] = dot<S>(m, de);
			f[l]   = std::sqrt(S::mises2(xi));
			z[l]   = options ? f[l] / radius[l] : f[l] * overYield;
		});
		power(z, law.n, small, H);
		if constexpr (options)
			flowRatio(law, y, De, reloading, f, radius, mDe, H);
		else
			forLanes<W>([&](int l) { H[l] *= mDe[l] > 0 ? loading : unloading; });
		// no direction at f = 0; elastic within the tolerance
		auto flows = [&](int l) { return (z[l] > 1e-12) & (std::abs(H[l]) > least); };
		if (!anyLane<W>(flows)) return;

		const double unit     = C.young / (sy * sy);
		const bool   degrades = law.degrades();
		forLanes<W>([&](int l) {
			double       xi[N], m[N], Dm[N], b[N];
			const bool   flow      = flows(l);
			const double softening = softeningOf(l), hardening = options ? law.hardening + slope[l] : law.hardening, f2 = f[l] * f[l];
			backStressFree<S>(y, l, xi);
			S::normal(xi, 1, m), S::elastic(C, m, Dm), S::back(xi, b);
			const double q = flow ? H[l] * mDe[l] / (flow ? softening * dot<S>(m, Dm) + hardening * f2 : 1) : 0;
			for (int k = 0; k < N; ++k)
				dy[k][l] -= q * softening * Dm[k], dy[Y::eta + k][l] = q * law.hardening * b[k];
			dy[Y::p][l] = q * f[l], dy[Y::dissipation][l] = q * f2;
			if constexpr (options) {
				// the compliance may grow by no more than the plastic work pays for
				double sigma[N];
				for (int k = 0; k < N; ++k)
					sigma[k] = y[k][l];
				const double heat = degrades ? q * f2 : 0, stored = complianceProduct<S>(C, sigma);
				const double most  = stored > 0 ? 2 / (stored > 0 ? stored : 1) : 0;
				const double grows = std::min(law.stiffnessDegradation * unit, most) * heat;
				dy[Y::e][l] = unit * heat, dy[Y::compliance][l] = grows;
				dy[Y::dissipation][l] = std::max(0., q * f2 - .5 * grows * stored);
			}
		});
	}

	/* Sub-steps are n/2 or so a yield strain. More than these are as good as a run that hangs: the point is given up, its stress no number. */
	constexpr double mostSubSteps = 1e5;
	/* Increments of more yield strains than this are rare, and have their own way. */
	constexpr double farStrain = 64;

	template <class S, int W> bool isFar(const BoucWenParameters& law, const Reals<W>* strain)
	{
		const double limit = law.yieldStress * std::min(farStrain, mostSubSteps / law.n);
		return anyLane<W>([&](int l) {
			double e[S::N], De[S::N];
			for (int k = 0; k < S::N; ++k)
				e[k] = strain[k][l];
			S::elastic(law.elastic, e, De);
			return !(S::mises2(De) <= limit * limit);
		});
	}
	/* The part of an increment that sub-steps are for; 0 where they would be too many.

	Without options the end of a far one is steady flow, which remembers nothing of its beginning: a difference from it decays with rate n (f),
	and at least with the ratio of the moduli of the two parts of xi, or 1 (its direction), a yield strain. When it is e^-4 of the tolerance,
	flowSteadily() takes the rest. */
	template <class S> double reach(const BoucWenParameters& law, const double* strain)
	{
		double De[S::N];
		S::elastic(law.elastic, strain, De);
		const double A = splitModulus<S>(law.elastic), B = 3 * law.elastic.shear, slowest = std::min({ 1., law.n, A / B, B / A });
		const double length = std::sqrt(S::mises2(De)) / law.yieldStress, memory = (4 - std::log(law.tolerance)) / slowest;
		const bool   steady = law.plain() && length > std::max(memory, farStrain);
		return std::max(1., law.n) * (steady ? memory : length) <= mostSubSteps ? steady ? memory / length : 1 : 0;
	}
	template <class S, int W> [[gnu::noinline]] void shorten(const BoucWenParameters& law, const Reals<W>* strain, Reals<W>* shorter, Reals<W>& part)
	{
		for (int l = 0; l < W; ++l) {
			double e[S::N];
			for (int k = 0; k < S::N; ++k)
				e[k] = strain[k][l];
			part[l] = reach<S>(law, e);
			for (int k = 0; k < S::N; ++k)
				shorter[k][l] = part[l] > 0 ? part[l] * e[k] : 0;
		}
	}
	/* The rest of the increments. In steady flow, f = sigma_y, the backward Euler step of classical plasticity is exact, however long. */
	template <class S, int W>
	[[gnu::noinline]] void flowSteadily(
		const BoucWenParameters& law, const Reals<W>* strain, const Reals<W>& part, Reals<W>* sigma, Reals<W>* eta, Reals<W>& p, Reals<W>& dissipation)
	{
		J2Parameters classical;
		classical.elastic = law.elastic, classical.yieldStress = law.yieldStress, classical.hardening = law.hardening;
		for (int l = 0; l < W; ++l) {
			if (part[l] == 1) continue;
			Reals<1> e[S::N], s[S::N], h[S::N], flow { { p[l] } }, heat { { dissipation[l] } };
			for (int k = 0; k < S::N; ++k)
				e[k][0] = (1 - part[l]) * strain[k][l], s[k][0] = sigma[k][l], h[k][0] = eta[k][l];
			if (part[l] > 0)
				j2Update<S>(classical, e, s, h, flow, heat);
			else
				s[0][0] = std::numeric_limits<double>::quiet_NaN();
			for (int k = 0; k < S::N; ++k)
				sigma[k][l] = s[k][0], eta[k][l] = h[k][0];
			p[l] = flow[0], dissipation[l] = heat[0];
		}
	}

	/* Modified Euler pairs with error control, after Sloan, every lane in sub-steps of its own until the last has arrived. The stress of a
	lane that is given up is not a number. */
	template <class S, bool options, int W>
	void boucWenIntegrate(const BoucWenParameters& law, const Reals<W>* strain, Reloading<S, W>& reloading, Reals<W>* y, int* subSteps)
	{
		using Y         = BoucWenVector<S, options>;
		constexpr int N = S::N, size = Y::size;
		const double  nan       = std::numeric_limits<double>::quiet_NaN();
		const bool    remembers = options && law.remembers();
		const double  admitted  = .25 * law.tolerance * law.tolerance * law.yieldStress * law.yieldStress; // of |dy2 - dy1|^2
		// where H1 H2 is left out anyhow
		const double small =
			options || W == 1 || isHalfOrWhole(law.n) ? 0 : std::pow(1e-3 * law.tolerance / std::max(1., law.gamma - law.beta), 1 / law.n);
		Reals<W> De[N], part[N], partStrain[N], dy1[size], dy2[size], euler[size], mDe1, mDe2, error2, accepted, radius, done {}, step, failed {},
			lost {};
		const int most = int(mostSubSteps + 20 / std::sqrt(law.tolerance));
		forLanes<W>([&](int l) {
			double e[N], d[N];
			for (int k = 0; k < N; ++k)
				e[k] = strain[k][l];
			S::elastic(law.elastic, e, d);
			for (int k = 0; k < N; ++k)
				De[k][l] = d[k];
			step[l] = 1;
		});
		for (int round = 0; round < most; ++round) {
			forLanes<W>([&](int l) { step[l] = std::min(step[l], 1 - done[l]); });
			if (remembers) reloading.begin(law, y, De, step);
			forLanes<W>([&](int l) {
				for (int k = 0; k < N; ++k)
					part[k][l] = step[l] * De[k][l], partStrain[k][l] = step[l] * strain[k][l];
			});
			boucWenRate<S, options>(law, small, reloading, y, partStrain, part, dy1, mDe1);
			forLanes<W>([&](int l) {
				for (int k = 0; k < size; ++k)
					euler[k][l] = y[k][l] + dy1[k][l];
			});
			boucWenRate<S, options>(law, small, reloading, euler, partStrain, part, dy2, mDe2);

			forLanes<W>([&](int l) {
				const double elastic     = options ? 2 / (1 + y[options ? Y::compliance : 0][l]) : 2;
				double       difference2 = 0, sum2 = 0;
				for (int k = 0; k < 2 * N; ++k) {
					const double difference = dy2[k][l] - dy1[k][l],
						     sum        = dy2[k][l] + dy1[k][l] - (k < N ? elastic * part[k < N ? k : 0][l] : 0);
					difference2 += difference * difference, sum2 += sum * sum;
				}
				// flow that vanishes in between, where loading and unloading meet, is not to be seen in the difference alone
				const bool turns = (mDe1[l] < 0) != (mDe2[l] < 0);
				error2[l]        = (turns & (sum2 > difference2)) ? sum2 : difference2;
				const bool good  = (error2[l] <= admitted) | (step[l] <= 1e-9);
				accepted[l]      = good ? 1 : 0;
				for (int k = 0; k < size; ++k) {
					const double next = y[k][l] + .5 * (dy1[k][l] + dy2[k][l]);
					y[k][l]           = good ? next : y[k][l];
				}
			});
			if (options && law.isotropic.active())
				for (int l = 0; l < W; ++l)
					radius[l] = law.isotropic.radius(law.yieldStress, y[Y::p][l]);
			else
				forLanes<W>([&](int l) { radius[l] = law.yieldStress; });
			if (subSteps)
				for (int l = 0; l < W; ++l)
					*subSteps += done[l] < 1 && accepted[l] != 0;
			if (!(options && law.paper()))
				forLanes<W>([&](int l) {
					// f = sigma_y is a fixed point that the rounding of a sub-step may overshoot
					double xi[N], b[N];
					backStressFree<S>(y, l, xi), S::back(xi, b);
					const double f2     = S::mises2(xi);
					const bool   over   = f2 > radius[l] * radius[l] * (1 + 2e-10);
					const double excess = over ? 1 - radius[l] / std::sqrt(over ? f2 : 1) : 0;
					for (int k = 0; k < N; ++k)
						y[k][l] -= excess * b[k];
				});
			else
				forLanes<W>([&](int l) {
					// beyond sigma_y f falls at the rate f^n, which may be too fast for the least sub-step
					const bool over = (accepted[l] != 0) & (error2[l] > law.yieldStress * law.yieldStress);
					for (int k = 0; k < size; ++k)
						y[k][l] = over ? 0 : y[k][l];
					lost[l] = over ? 1 : lost[l], done[l] = over ? 1 : done[l], step[l] = over ? 0 : step[l];
				});
			if (remembers) reloading.end(y, done, accepted);

			if (!anyLane<W>([&](int l) { return (accepted[l] == 0) | (step[l] < 1 - done[l]); })) {
				if (options && law.paper()) forLanes<W>([&](int l) { y[0][l] = lost[l] != 0 ? nan : y[0][l]; });
				return;
			}
			forLanes<W>([&](int l) {
				const bool   good   = accepted[l] != 0;
				const double factor = .9 * std::sqrt(std::sqrt(admitted / error2[l]));
				const double shrink = step[l] * (factor > .1 ? factor : .1), grow = step[l] * (factor < 2 ? factor : 2); // .1 and 2 for NaN
				const double next = done[l] + step[l], longer = failed[l] != 0 ? step[l] : grow, after = reloading.stops[l] != 0 ? 1 : longer;
				const double arrived = step[l] < 1 - done[l] ? next : 1;
				done[l]              = good ? arrived : done[l];
				step[l]              = good ? after : shrink;
				failed[l]            = good ? 0 : 1;
			});
		}
		forLanes<W>([&](int l) { y[0][l] = ((done[l] < 1) | (lost[l] != 0)) ? nan : y[0][l]; });
	}
} // namespace detail

/* Integrates the law over a strain increment (engineering shear) in every lane; sigma and the internal variables (tensors, then
scalars) are updated, dissipation is added to. subSteps, where given, counts the sub-steps of all lanes.

Sub-steps are modified Euler pairs: Sloan, IJNME 24 (1987) 893; Sloan, Abbo & Sheng, Eng. Comput. 18 (2001) 121. Half
the difference of the two slopes' stresses, over sigma_y, estimates the error of the first-order member and is kept below
a quarter of the tolerance; the second-order member is carried on. Between loading and unloading lambda' has a kink: it falls to zero
and rises again, at gamma > beta, and the two slopes may then agree by chance. So there the greater one of difference and
sum of the flows counts. The next sub-step is scaled by 0.9 sqrt(admitted/error), within
[0.1, 2], and does not grow right after a failure. Loading forgets errors, so that those of a path do not add up. */
template <class S, int W>
void boucWenUpdate(const BoucWenParameters& law, const Reals<W>* strain, Reals<W>* sigma, Reals<W>* internal, Reals<W>& dissipation, int* subSteps = nullptr)
{
	constexpr int           N = S::N;
	detail::Reloading<S, W> reloading;
	Reals<W>*               scalars = internal + law.tensors() * N;
	Reals<W>                shorter[N], part;
	const bool              far = detail::isFar<S>(law, strain);
	if (far) detail::shorten<S>(law, strain, shorter, part);
	auto run = [&](auto options) {
		using Y = detail::BoucWenVector<S, options.value>;
		Reals<W> y[Y::size] {};
		std::copy(sigma, sigma + N, y), std::copy(internal, internal + N, y + Y::eta);
		y[Y::p] = scalars[0], y[Y::dissipation] = dissipation;
		if constexpr (options.value) {
			if (law.degrades()) y[Y::e] = scalars[1], y[Y::compliance] = scalars[2];
			if (law.remembers()) {
				const Reals<W>* kept = scalars + law.scalars() - 2;
				reloading.limit = kept[0], reloading.origin = kept[1];
			}
			if (law.paper()) std::copy(internal + N, internal + 2 * N, y + Y::strain);
		}
		detail::boucWenIntegrate<S, options.value>(law, far ? shorter : strain, reloading, y, subSteps);
		std::copy(y, y + N, sigma), std::copy(y + Y::eta, y + Y::eta + N, internal);
		scalars[0] = y[Y::p], dissipation = y[Y::dissipation];
		if constexpr (options.value) {
			if (law.degrades()) scalars[1] = y[Y::e], scalars[2] = y[Y::compliance];
			if (law.remembers()) {
				Reals<W>* kept = scalars + law.scalars() - 2;
				kept[0] = reloading.limit, kept[1] = reloading.origin;
			}
			if (law.paper()) std::copy(y + Y::strain, y + Y::strain + N, internal + N);
		}
	};
	if (law.plain())
		run(std::false_type {});
	else
		run(std::true_type {});
	if (far) detail::flowSteadily<S>(law, strain, part, sigma, internal, scalars[0], dissipation);
}

} // namespace yade::mpm
