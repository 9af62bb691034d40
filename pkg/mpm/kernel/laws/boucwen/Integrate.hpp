// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "Rate.hpp"
#include "SteadyFlow.hpp"

namespace yade::mpm::detail {

/* Modified Euler pairs with error control, after Sloan, every lane in sub-steps of its own until the last has finished. The stress of a
lane that fails becomes NaN. */
template <class S, bool options, int W, class T>
void boucWenIntegrate(const BoucWen& law, const Hooke& C, const Reals<W, T>* strain, Reloading<S, W, T>& reloading, Reals<W, T>* y, int* subSteps)
{
	using std::sqrt;
	using Y         = BoucWenVector<S, options>;
	constexpr int N = S::N, size = Y::size;
	const double  nan       = std::numeric_limits<double>::quiet_NaN();
	const bool    remembers = options && law.remembers();
	const double  admitted  = .25 * law.tolerance * law.tolerance * law.yieldStress * law.yieldStress; // of |dy2 - dy1|^2
	// up to this f/sigma_y, H1 H2 is below the threshold of flow
	const double small = options || W == 1 || isHalfOrWhole(law.n) ? 0 : std::pow(1e-3 * law.tolerance / std::max(1., law.gamma - law.beta), 1 / law.n);
	Reals<W, T>  De[N], stepStress[N], stepStrain[N], dy1[size], dy2[size], euler[size], mDe1, mDe2, radius, done {}, step;
	Reals<W>     error2, accepted, failed {}, lost {};
	const int    maxRounds = int(maxSubSteps + 20 / sqrt(law.tolerance));
	forLanes<W>([&](int l) {
		T e[N], d[N];
		for (int k = 0; k < N; ++k)
			e[k] = strain[k][l];
		S::elastic(C, e, d);
		for (int k = 0; k < N; ++k)
			De[k][l] = d[k];
		step[l] = 1;
	});
	for (int round = 0; round < maxRounds; ++round) {
		forLanes<W>([&](int l) { step[l] = std::min<T>(step[l], 1 - done[l]); });
		if (remembers) reloading.begin(law, y, De, step);
		forLanes<W>([&](int l) {
			for (int k = 0; k < N; ++k)
				stepStress[k][l] = step[l] * De[k][l], stepStrain[k][l] = step[l] * strain[k][l];
		});
		boucWenRate<S, options>(law, C, small, reloading, y, stepStrain, stepStress, dy1, mDe1);
		forLanes<W>([&](int l) {
			for (int k = 0; k < size; ++k)
				euler[k][l] = y[k][l] + dy1[k][l];
		});
		boucWenRate<S, options>(law, C, small, reloading, euler, stepStrain, stepStress, dy2, mDe2);

		forLanes<W>([&](int l) {
			const double elastic     = options ? 2 / (1 + valueOf(y[options ? Y::compliance : 0][l])) : 2;
			double       difference2 = 0, sum2 = 0;
			for (int k = 0; k < 2 * N; ++k) {
				const double first = valueOf(dy1[k][l]), second = valueOf(dy2[k][l]), difference = second - first,
					     sum = second + first - (k < N ? elastic * valueOf(stepStress[k < N ? k : 0][l]) : 0);
				difference2 += difference * difference, sum2 += sum * sum;
			}
			// the difference alone misses a flow that vanishes inside the sub-step, between loading and unloading
			const bool turns = (mDe1[l] < 0) != (mDe2[l] < 0);
			error2[l]        = turns & (sum2 > difference2) ? sum2 : difference2;
			const bool good  = (error2[l] <= admitted) | (step[l] <= 1e-9);
			accepted[l]      = good ? 1 : 0;
			for (int k = 0; k < size; ++k) {
				const T next = y[k][l] + .5 * (dy1[k][l] + dy2[k][l]);
				y[k][l]      = good ? next : y[k][l];
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
				T xi[N], b[N];
				backStressFree<S>(y, l, xi), S::backStressDirection(xi, b);
				const T    f2     = S::mises2(xi);
				const bool above  = f2 > radius[l] * radius[l] * (1 + 2e-10);
				const T    excess = above ? 1 - radius[l] / sqrt(above ? f2 : T(1)) : T(0);
				for (int k = 0; k < N; ++k)
					y[k][l] -= excess * b[k];
			});
		else
			forLanes<W>([&](int l) {
				// beyond sigma_y f falls at the rate f^n, which may be too fast for the least sub-step
				const bool tooFast = (accepted[l] != 0) & (error2[l] > law.yieldStress * law.yieldStress);
				for (int k = 0; k < size; ++k)
					y[k][l] = tooFast ? T(0) : y[k][l];
				lost[l] = tooFast ? 1 : lost[l], done[l] = tooFast ? T(1) : done[l], step[l] = tooFast ? T(0) : step[l];
			});
		if (remembers) reloading.end(y, done, accepted);

		if (!anyLane<W>([&](int l) { return (accepted[l] == 0) | (step[l] < 1 - done[l]); })) {
			if (options && law.paper()) forLanes<W>([&](int l) { y[0][l] = lost[l] != 0 ? T(nan) : y[0][l]; });
			return;
		}
		forLanes<W>([&](int l) {
			const bool   good   = accepted[l] != 0;
			const double factor = .9 * std::sqrt(std::sqrt(admitted / error2[l]));
			const T      shrink = step[l] * (factor > .1 ? factor : .1), grow = step[l] * (factor < 2 ? factor : 2); // .1 and 2 for NaN
			const T      next = done[l] + step[l], longer = failed[l] != 0 ? step[l] : grow, after = reloading.stops[l] != 0 ? T(1) : longer;
			const T      arrived = step[l] < 1 - done[l] ? next : T(1);
			done[l]              = good ? arrived : done[l];
			step[l]              = good ? after : shrink;
			failed[l]            = good ? 0 : 1;
		});
	}
	forLanes<W>([&](int l) { y[0][l] = ((done[l] < 1) | (lost[l] != 0)) ? T(nan) : y[0][l]; });
}

} // namespace yade::mpm::detail
