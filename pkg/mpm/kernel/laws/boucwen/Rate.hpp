// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "Reloading.hpp"

namespace yade::mpm::detail {

/* H1 H2 below this times the tolerance counts as no flow. */
constexpr double leastFlow = 3e-4;

inline bool isHalfOrWhole(double n) { return 2 * n <= 2048 && 2 * n == int(2 * n); }

/* z^n; n is a whole or half number in most scenes, which avoids the call of pow. Up to `small`, pow may give 0. */
template <int W, class T> void power(const Pack<W, T>& base, double n, double small, Pack<W, T>& result)
{
	using std::pow, std::sqrt;
	if (!isHalfOrWhole(n)) {
		for (int l = 0; l < W; ++l)
			result[l] = base[l] > small ? pow(base[l], n) : T(0);
		return;
	}
	const int  twice = int(2 * n);
	const bool half  = twice & 1;
	Pack<W, T> z     = base;
	forLanes<W>([&](int l) { result[l] = half ? sqrt(z[l]) : T(1); });
	for (int bits = twice >> 1; bits; bits >>= 1) {
		if (bits & 1) forLanes<W>([&](int l) { result[l] *= z[l]; });
		forLanes<W>([&](int l) { z[l] *= z[l]; });
	}
}

/* The fraction of the loading that flows, with the options: H1 H2 from H1, in place. */
template <class S, int W, class T>
void flowRatio(const BoucWen& law, const Pack<W, T>* y, const Pack<W, T>* De, const Reloading<S, W, T>& reloading, const Pack<W, T>& f,
	const Pack<W, T>& radius, const Pack<W, T>& mDe, Pack<W, T>& H1)
{
	using std::exp, std::expm1;
	using Y               = BoucWenVector<S, true>;
	constexpr int N       = S::N;
	const double  loading = law.beta + law.gamma, unloading = law.beta - law.gamma;
	if (law.paper()) {
		forLanes<W>([&](int l) {
			T product = 0;
			for (int k = 0; k < N; ++k)
				product += (S::voigtIndex[k] < 3 ? 1 : 2) * y[Y::strain + k][l] * De[k][l];
			H1[l] *= product > 0 ? loading : unloading;
		});
		return;
	}
	forLanes<W>([&](int l) { H1[l] *= 1 + law.strengthDegradation * y[Y::e][l]; });
	Pack<W, T> loads = H1;
	if (law.remembers()) {
		Pack<W, T> fraction, factor;
		forLanes<W>([&](int l) { fraction[l] = reloading.loadedFraction(f, l); });
		if (std::isinf(law.reloading))
			forLanes<W>([&](int l) { factor[l] = fraction[l] < 1 ? 0 : 1; });
		else
			power(fraction, law.reloading, 0, factor);
		forLanes<W>([&](int l) { loads[l] *= factor[l]; });
	}
	if (law.pinching != 0) // Baber & Noori's factor on the loading stiffness 1 - H1, with the slip along a
		for (int l = 0; l < W; ++l) {
			const T off = (f[l] / radius[l] - law.pinchingLevel) / law.pinchingWidth;
			const T h   = 1 + law.pinching * expm1(-law.pinchingRate * y[Y::e][l]) * exp(-off * off);
			loads[l]    = 1 - h * (1 - loads[l]);
		}
	forLanes<W>([&](int l) { H1[l] = mDe[l] > 0 ? (reloading.elastic[l] != 0 ? T(0) : loads[l]) : H1[l] * unloading; });
}

/* dy over a strain increment and the elastic stress De that belongs to it, and the sign of loading. With m = M xi = f a:
   lambda' a = H1 H2 (m^T D eps') m / (m^T D m + H f^2),  lambda' = f times that ratio.
Up to z = f/sigma_y = small, the flow is known to be none. In a state that no exact solution comes near, dy is no number. */
template <class S, bool options, int W, class T>
void boucWenRate(const BoucWen& law, const Hooke& C, double small, const Reloading<S, W, T>& reloading, const Pack<W, T>* y, const Pack<W, T>* strain,
	const Pack<W, T>* De, Pack<W, T>* dy, Pack<W, T>& mDe)
{
	using std::sqrt, std::abs;
	using Y          = BoucWenVector<S, options>;
	constexpr int N  = S::N;
	const double  sy = law.yieldStress, inverseYield = 1 / sy, least = leastFlow * law.tolerance, loading = law.beta + law.gamma,
		     unloading = law.beta - law.gamma;
	Pack<W, T> radius, slope, f, z, H;
	if constexpr (options) {
		for (int l = 0; l < W; ++l)
			radius[l] = law.isotropic.radius(sy, y[Y::p][l]), slope[l] = law.isotropic.slope(y[Y::p][l]);
		forLanes<W>([&](int l) {
			for (int k = 0; k < N; ++k)
				dy[Y::strain + k][l] = (S::voigtIndex[k] < 3 ? 1 : .5) * strain[k][l];
			dy[Y::e][l] = dy[Y::compliance][l] = 0;
		});
	}
	auto softeningOf = [&](int l) -> T {
		if constexpr (options) return 1 / (1 + y[Y::compliance][l]);
		return 1.;
	};
	forLanes<W>([&](int l) {
		T       xi[N], m[N], de[N];
		const T softening = softeningOf(l);
		backStressFree<S>(y, l, xi);
		for (int k = 0; k < N; ++k)
			de[k] = softening * De[k][l], dy[k][l] = de[k], dy[Y::eta + k][l] = 0;
		dy[Y::p][l] = dy[Y::dissipation][l] = 0;
		S::normal(xi, 1, m);
		mDe[l] = dot<S>(m, de);
		f[l]   = sqrt(S::mises2(xi));
		z[l]   = options ? f[l] / radius[l] : f[l] * inverseYield;
	});
	power(z, law.n, small, H);
	/* f never exceeds the radius. A stage far outside is of a sub-step that is too long; its flow may overflow, or, with a radius below zero,
	vanish, and hide from the error estimate. */
	if (!(options && law.paper()))
		forLanes<W>([&](int l) { dy[0][l] = ((z[l] >= 0) & (H[l] <= 10)) ? dy[0][l] : T(std::numeric_limits<double>::quiet_NaN()); });
	if constexpr (options)
		flowRatio(law, y, De, reloading, f, radius, mDe, H);
	else
		forLanes<W>([&](int l) { H[l] *= mDe[l] > 0 ? loading : unloading; });
	const double unit     = C.young / (sy * sy);
	const bool   degrades = law.degrades(), hysteretic = options && law.hysteretic();
	auto         stored = [&](int l) { // twice the elastic energy, of the initial compliance
                T sigma[N];
                for (int k = 0; k < N; ++k)
                        sigma[k] = y[k][l];
                return complianceProduct<S>(C, sigma);
	};
	if (hysteretic)
		forLanes<W>([&](int l) {
			T xi[N], e[N];
			backStressFree<S>(y, l, xi);
			for (int k = 0; k < N; ++k)
				e[k] = strain[k][l];
			const T work = unit * dot<S>(xi, e), grows = law.stiffnessDegradation * work;
			dy[options ? Y::e : 0][l] = work, dy[options ? Y::compliance : 0][l] = grows;
			dy[Y::dissipation][l] = -.5 * grows * stored(l);
		});
	// no direction at f = 0; elastic within the tolerance
	auto flows = [&](int l) { return (z[l] > 1e-12) & (abs(H[l]) > least); };
	if (!anyLane<W>(flows)) return;

	forLanes<W>([&](int l) {
		T          xi[N], m[N], Dm[N], b[N];
		const bool flow      = flows(l);
		const T    softening = softeningOf(l), hardening = options ? law.hardening + slope[l] : T(law.hardening), f2 = f[l] * f[l];
		backStressFree<S>(y, l, xi);
		S::normal(xi, 1, m), S::elastic(C, m, Dm), S::backStressDirection(xi, b);
		const T q = flow ? H[l] * mDe[l] / (flow ? softening * dot<S>(m, Dm) + hardening * f2 : T(1)) : T(0);
		for (int k = 0; k < N; ++k)
			dy[k][l] -= q * softening * Dm[k], dy[Y::eta + k][l] = q * law.hardening * b[k];
		dy[Y::p][l] = q * f[l], dy[Y::dissipation][l] += q * f2;
		if (options && !hysteretic) {
			// the compliance may grow by no more than the plastic work pays for
			const T heat = degrades ? q * f2 : T(0), twice = stored(l);
			const T most              = twice > 0 ? 2 / (twice > 0 ? twice : T(1)) : T(0);
			const T grows             = std::min<T>(law.stiffnessDegradation * unit, most) * heat;
			dy[options ? Y::e : 0][l] = unit * heat, dy[options ? Y::compliance : 0][l] = grows;
			dy[Y::dissipation][l] = std::max<T>(0., q * f2 - .5 * grows * twice);
		}
	});
}

} // namespace yade::mpm::detail
