// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "Rate.hpp"
#include "SteadyFlow.hpp"

namespace yade::mpm::detail {

/* The coefficients of Cash & Karp, ACM Trans. Math. Softw. 16 (1990) 201: fifth order, and the difference from the fourth. */
struct CashKarp {
	static constexpr int    stages                = 6;
	static constexpr double a[stages][stages - 1] = { {}, { 1. / 5 }, { 3. / 40, 9. / 40 }, { 3. / 10, -9. / 10, 6. / 5 },
		{ -11. / 54, 5. / 2, -70. / 27, 35. / 27 }, { 1631. / 55296, 175. / 512, 575. / 13824, 44275. / 110592, 253. / 4096 } };
	static constexpr double b[stages]             = { 37. / 378, 0, 250. / 621, 125. / 594, 0, 512. / 1771 };
	static constexpr double d[stages]             = { 37. / 378 - 2825. / 27648, 0, 250. / 621 - 18575. / 48384, 125. / 594 - 13525. / 55296, -277. / 14336,
			    512. / 1771 - .25 };
};

/* How great the error of a sub-step may be. Flow contracts errors, at a rate of about 1 a yield strain of flow, and nothing else does:
so the error of a sub-step is bounded by a part of the tolerance times its own flow (in yield strains), and where there is almost no flow by
a small part times its length. The sum over any path then stays below the tolerance (doc/law.md, Integration). */
struct ErrorBound {
	static constexpr double floor = 3e-4; // error over tolerance, a yield strain of length
	static constexpr double kink  = .01;  // flow over tolerance of a sub-step with a kink of lambda', which its stages may miss
	static constexpr double cap   = .25;  // greatest error over tolerance
	static constexpr double rough = .05;  // part of it where f changes fourfold and f^n is not smooth at 0

	/* Error over tolerance and flow. With n below 1, pinching and reloading flow contracts more slowly, and degradation keeps the errors
	of what has been dissipated. */
	static double perFlow(const BoucWen& law) { return std::min(1., law.n) * (law.degrades() ? .03 : law.remembers() ? .3 : 1); }
};

/* Integrates y over the strain increment, every lane in sub-steps of its own until the last has finished. A modified Euler pair covers the
increment at once where its error allows that, as in a step of the material point method; the rest is done in sub-steps by
Cash & Karp's pair. The stress of a lane that fails becomes NaN. */
template <class S, bool options, int W, class T>
void boucWenIntegrate(const BoucWen& law, const Hooke& C, const Pack<W, T>* strain, Reloading<S, W, T>& reloading, Pack<W, T>* y, int* subSteps)
{
	using std::sqrt;
	using Y         = BoucWenVector<S, options>;
	constexpr int N = S::N, size = Y::size;
	const double  nan = std::numeric_limits<double>::quiet_NaN(), tolerance = law.tolerance, sy = law.yieldStress;
	const double  leastError = std::max(ErrorBound::floor * tolerance, 1e-14), least2 = leastError * leastError / (tolerance * tolerance); // above rounding
	const double  perFlow = ErrorBound::perFlow(law), perFlow2 = perFlow * perFlow;
	const bool    rough     = law.n < 5 && law.n != std::floor(law.n);
	const bool    remembers = options && law.remembers(), paper = options && law.paper();
	// the hysteretic measure e grows without flow as well; the stress error that an error of e makes, over that error
	constexpr int eAt       = options ? Y::e : 0;
	const double  eToStress = options && law.hysteretic() ? sy * (law.strengthDegradation + law.stiffnessDegradation + law.pinching * law.pinchingRate) : 0;
	// up to this f/sigma_y, H1 H2 is below the threshold of flow
	const double small = options || W == 1 || isHalfOrWhole(law.n) ? 0 : std::pow(leastFlow * tolerance / std::max(1., law.gamma - law.beta), 1 / law.n);
	Pack<W, T>   De[N], stepStress[N], stepStrain[N], dy1[size], dy2[size], next[size], mDe1, mDe2, radius, done {}, step, uncut;
	Pack<W>      excess, accepted, failed {}, lost {}, kinks {};
	forLanes<W>([&](int l) {
		T e[N], d[N];
		for (int k = 0; k < N; ++k)
			e[k] = strain[k][l];
		S::elastic(C, e, d);
		for (int k = 0; k < N; ++k)
			De[k][l] = d[k];
		step[l] = 1;
	});
	auto elasticFactor = [&](int l) -> T { return options ? 1 / (1 + y[options ? Y::compliance : 0][l]) : T(1); };
	/* A sub-step ends at the latest where f turns on an elastic path, from unloading to loading. */
	auto cutAtTurn = [&] {
		forLanes<W>([&](int l) {
			T xi[N], m[N], de[N];
			backStressFree<S>(y, l, xi);
			for (int k = 0; k < N; ++k)
				de[k] = elasticFactor(l) * De[k][l];
			S::normal(xi, 1, m);
			const T    A = S::mises2(de), turn = -dot<S>(m, de) / (A > 0 ? A : T(1));
			const bool cut     = (turn > 1e-9) & (turn < step[l]);
			step[l]            = cut ? turn : step[l];
			reloading.stops[l] = cut ? 1 : 0;
		});
	};
	auto begin = [&](bool first = false) {
		forLanes<W>([&](int l) { uncut[l] = step[l], step[l] = std::min<T>(step[l], 1 - done[l]); });
		if (remembers)
			reloading.begin(law, y, De, step);
		else if (!paper && !first)
			cutAtTurn();
		forLanes<W>([&](int l) {
			for (int k = 0; k < N; ++k)
				stepStress[k][l] = step[l] * De[k][l], stepStrain[k][l] = step[l] * strain[k][l];
		});
	};
	/* Accepts `next` where the error is small enough, and returns whether all lanes have finished. */
	auto end = [&] {
		forLanes<W>([&](int l) {
			const bool good = (excess[l] <= 1) | (step[l] <= 1e-9);
			accepted[l]     = good ? 1 : 0;
			for (int k = 0; k < size; ++k)
				y[k][l] = good ? next[k][l] : y[k][l];
		});
		if (options && law.isotropic.active())
			for (int l = 0; l < W; ++l)
				radius[l] = law.isotropic.radius(sy, y[Y::p][l]);
		else
			forLanes<W>([&](int l) { radius[l] = sy; });
		if (subSteps)
			for (int l = 0; l < W; ++l)
				*subSteps += done[l] < 1 && accepted[l] != 0;
		if (!paper)
			forLanes<W>([&](int l) {
				// f = sigma_y is a fixed point that the error of a sub-step may overshoot
				T xi[N], b[N];
				backStressFree<S>(y, l, xi), S::backStressDirection(xi, b);
				const T    f2    = S::mises2(xi);
				const bool above = f2 > radius[l] * radius[l] * (1 + 1e-14);
				const T    over  = above ? 1 - radius[l] / sqrt(above ? f2 : T(1)) : T(0);
				for (int k = 0; k < N; ++k)
					y[k][l] -= over * b[k];
			});
		else
			forLanes<W>([&](int l) {
				// beyond sigma_y f falls at the rate f^n, which may be too fast for the least sub-step
				const bool tooFast = (accepted[l] != 0) & (excess[l] > 4 / (tolerance * tolerance));
				for (int k = 0; k < size; ++k)
					y[k][l] = tooFast ? T(0) : y[k][l];
				lost[l] = tooFast ? 1 : lost[l], done[l] = tooFast ? T(1) : done[l], step[l] = tooFast ? T(0) : step[l];
			});
		if (remembers) reloading.end(y, done, accepted);
		return !anyLane<W>([&](int l) { return (accepted[l] == 0) | (step[l] < 1 - done[l]); });
	};
	/* The next sub-step: scaled by `factor`, and no longer than the last right after a failure. */
	auto advance = [&](auto&& factor) {
		forLanes<W>([&](int l) {
			const bool   good   = accepted[l] != 0;
			const double by     = factor(l);
			const T      shrink = step[l] * (by > .1 ? by : .1), grow = step[l] * (by < 4 ? by : 4); // .1 and 4 for NaN
			const T      reached = done[l] + step[l], longer = failed[l] != 0 ? step[l] : grow, after = reloading.stops[l] != 0 ? uncut[l] : longer;
			const T      arrived = step[l] < 1 - done[l] ? reached : T(1);
			done[l]              = good ? arrived : done[l];
			step[l]              = good ? after : shrink;
			failed[l]            = good ? 0 : 1;
		});
	};
	auto fail = [&] { forLanes<W>([&](int l) { y[0][l] = ((done[l] < 1) | (lost[l] != 0)) ? T(nan) : y[0][l]; }); };

	auto giveUpLost = [&] {
		if (paper) forLanes<W>([&](int l) { y[0][l] = lost[l] != 0 ? T(nan) : y[0][l]; });
	};

	/* Modified Euler's pair over a sub-step: the result, and its error over the greatest one admitted. */
	auto heun = [&] {
		boucWenRate<S, options>(law, C, small, reloading, y, stepStrain, stepStress, dy1, mDe1);
		forLanes<W>([&](int l) {
			for (int k = 0; k < size; ++k)
				next[k][l] = y[k][l] + dy1[k][l];
		});
		boucWenRate<S, options>(law, C, small, reloading, next, stepStrain, stepStress, dy2, mDe2);
		forLanes<W>([&](int l) {
			/* Half the difference of the two flows is the error of the first-order member; over the flow it is r. The second-order member is
			carried on; of its flow r^2/3 is wrong where flow grows like an exponential, as it does below the knee. */
			const double elastic = 2 * valueOf(elasticFactor(l)), floor = 2 * leastError;
			double       difference2 = 0, flow2 = 0, length2 = 0;
			for (int k = 0; k < 2 * N; ++k) {
				const double first = valueOf(dy1[k][l]), second = valueOf(dy2[k][l]), difference = second - first,
					     part = k < N ? elastic * valueOf(stepStress[k < N ? k : 0][l]) : 0, sum = second + first - part;
				difference2 += difference * difference, flow2 += sum * sum, length2 += .25 * part * part;
			}
			if constexpr (options) {
				const double e1 = eToStress * valueOf(dy1[eAt][l]), e2 = eToStress * valueOf(dy2[eAt][l]);
				difference2 += (e2 - e1) * (e2 - e1), flow2 += (e1 + e2) * (e1 + e2);
			}
			// the difference alone misses a flow that vanishes inside the sub-step, between loading and unloading
			const bool   kink     = (mDe1[l] < 0) != (mDe2[l] < 0);
			const double error2   = (kink & (flow2 > difference2)) ? flow2 : difference2;
			const double most     = .25 * tolerance * tolerance * sy * sy,
				     relative = (kink ? 0 : perFlow * tolerance * flow2) + floor * floor * length2;
			excess[l]             = error2 / ((paper ? most : std::min(most, relative)) + 1e-300);
			for (int k = 0; k < size; ++k)
				next[k][l] = y[k][l] + .5 * (dy1[k][l] + dy2[k][l]);
		});
	};

	begin(true), heun();
	if (end()) return giveUpLost();
	advance([&](int l) { return (paper ? .9 : 2) / std::sqrt(std::sqrt(excess[l])); });

	const int  maxRounds = int(maxSubSteps + 20 / std::sqrt(tolerance));
	Pack<W, T> slopes[CashKarp::stages][size], mDe;
	for (int round = 0; round < maxRounds; ++round) {
		begin();
		if (paper) { // its rate jumps, where a pair of high order has no advantage
			heun();
			if (end()) return giveUpLost();
			advance([&](int l) { return .9 / std::sqrt(std::sqrt(excess[l])); });
			continue;
		}
		for (int stage = 0; stage < CashKarp::stages; ++stage) {
			forLanes<W>([&](int l) {
				for (int k = 0; k < size; ++k) {
					T sum = y[k][l];
					for (int s = 0; s < stage; ++s)
						sum += CashKarp::a[stage][s] * slopes[s][k][l];
					next[k][l] = sum;
				}
			});
			boucWenRate<S, options>(law, C, small, reloading, next, stepStrain, stepStress, slopes[stage], mDe);
			forLanes<W>([&](int l) {
				if (stage == 0) mDe1[l] = mDe[l], kinks[l] = 0;
				// a sub-step that begins at a turn, to rounding, has no kink
				const double first = valueOf(mDe1[l]), here = valueOf(mDe[l]);
				const bool   kink = ((first < 0) != (here < 0)) & (std::abs(first) > 1e-6 * std::abs(here));
				kinks[l]          = kink ? 1 : kinks[l];
			});
		}
		forLanes<W>([&](int l) {
			const double elastic = valueOf(elasticFactor(l));
			double       error2 = 0, flow2 = 0, length2 = 0;
			for (int k = 0; k < size; ++k) {
				T      sum   = CashKarp::b[0] * slopes[0][k][l];
				double error = CashKarp::d[0] * valueOf(slopes[0][k][l]);
				for (int s = 2; s < CashKarp::stages; ++s)
					sum += CashKarp::b[s] * slopes[s][k][l], error += CashKarp::d[s] * valueOf(slopes[s][k][l]);
				next[k][l] = y[k][l] + sum;
				if (options && k == eAt) {
					error *= eToStress;
					error2 += error * error, flow2 += eToStress * valueOf(sum) * eToStress * valueOf(sum);
				}
				if (k >= 2 * N) continue;
				const double part = k < N ? elastic * valueOf(stepStress[k < N ? k : 0][l]) : 0, flow = valueOf(sum) - part;
				error2 += error * error, flow2 += flow * flow, length2 += part * part;
			}
			double part2 = 1;
			if (rough) {
				T from[N], to[N];
				backStressFree<S>(y, l, from), backStressFree<S>(next, l, to);
				const double f0 = valueOf(S::mises2(from)), f1 = valueOf(S::mises2(to));
				part2 = std::min(f0, f1) < .0625 * std::max(f0, f1) ? ErrorBound::rough * ErrorBound::rough : 1;
			}
			const bool   kink  = kinks[l] != 0;
			const double kink2 = ErrorBound::kink * ErrorBound::kink * sy * sy, cap2 = ErrorBound::cap * ErrorBound::cap * perFlow2 * sy * sy;
			const double most2 = kink ? kink2 : std::min(cap2, part2 * perFlow2 * flow2 + least2 * length2);
			excess[l]          = ((kink & (flow2 > error2)) ? flow2 : error2) / (tolerance * tolerance * most2 + 1e-300);
		});
		if (end()) return giveUpLost();
		advance([&](int l) {
			const double fourth = std::sqrt(std::sqrt(excess[l]));
			return .9 / (kinks[l] != 0 ? fourth : std::sqrt(fourth));
		});
	}
	fail();
}

} // namespace yade::mpm::detail
