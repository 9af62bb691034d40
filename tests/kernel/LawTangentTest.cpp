// SPDX-License-Identifier: GPL-2.0-or-later
/* Tangents of the laws against finite differences of their updates, eq. 27 of the paper against its formula, and the number of
internal variables against the space that the kernel reserves. */
#include "EveryLaw.hpp"
#include <gtest/gtest.h>

using namespace yade::mpm;

namespace {

/* Central differences, extrapolated from two widths (fourth order). */
template <class S> void differences(const LawPoint<S>& from, const double* strain, double width, double* tangent)
{
	constexpr int N = S::N;
	for (int j = 0; j < N; ++j) {
		double slope[2][N];
		for (int level = 0; level < 2; ++level) {
			const double h = width / (1 + level);
			double       sigma[2][N];
			for (int side = 0; side < 2; ++side) {
				LawPoint<S> point = from;
				double      e[N];
				for (int k = 0; k < N; ++k)
					e[k] = strain[k] + (k == j ? (side ? h : -h) : 0);
				updateStress<LawState<S>>(point.law, e, point.sigma, point.internal.data());
				std::copy(point.sigma, point.sigma + N, sigma[side]);
			}
			for (int i = 0; i < N; ++i)
				slope[level][i] = (sigma[1][i] - sigma[0][i]) / (2 * h);
		}
		for (int i = 0; i < N; ++i)
			tangent[i * N + j] = (4 * slope[1][i] - slope[0][i]) / 3;
	}
}

template <class S> class LawTangent : public ::testing::Test {
};
using States = ::testing::Types<Uniaxial, PlaneStress, PlaneStrain, Solid, FreeNormals<2>>;
TYPED_TEST_SUITE(LawTangent, States);

/* After prestraining, over increments of 0.03 to 3 yield strains (shorter ones leave no digits for differences). The hysteretic law's sub-steps are part of its
update; the tangent takes their sizes as given, and where their number changes between the two sides of a difference the update jumps by its tolerance, which is
therefore 1e-12 here. Pinching and the paper's rule make the rate jump inside an increment, so that only 1e-2 is asserted for them. Differences that straddle a
corner (yield, reversal, the change of a sub-step) agree at no width; a case counts where the differences themselves have converged, which must be nearly
always. */
TYPED_TEST(LawTangent, IsTheDerivativeOfTheUpdate)
{
	constexpr int N = TypeParam::N;
	for (const NamedLaw& named : everyLaw()) {
		SCOPED_TRACE(named.name);
		Law law = named.law;
		if (is<BoucWen>(law)) as<BoucWen>(law).tolerance = 1e-12;
		if (is<BoucWen>(law) && as<BoucWen>(law).paper()) as<BoucWen>(law).tolerance = 1e-8; // its sub-steps are of second order
		const bool                             jumps = is<BoucWen>(law) && (as<BoucWen>(law).pinching != 0 || as<BoucWen>(law).paper());
		std::mt19937                           random(11);
		std::uniform_real_distribution<double> unit(0, 1);
		std::normal_distribution<double>       normal;
		int                                    counted = 0, flowing = 0;
		double                                 worst = 0;
		for (int trial = 0; trial < (N > 3 ? 2 : 6); ++trial) {
			LawPoint<TypeParam>   point(law);
			std::array<double, N> increment {};
			for (int leg = 0; leg < 3; ++leg) {
				for (double& e : increment)
					e = normal(random) * yieldStrain;
				point.strain(increment);
			}
			const double size = std::pow(10, -1.5 + 2 * unit(random));
			for (double& e : increment)
				e = size * yieldStrain * normal(random);
			double tangent[N * N], coarse[N * N], fine[N * N], largest = 0, doubt = 0, error = 0, plastic = 0;
			consistentTangent<TypeParam>(law, increment.data(), point.sigma, point.internal.data(), tangent);
			differences(point, increment.data(), 4e-3 * size * yieldStrain, coarse);
			differences(point, increment.data(), 2e-3 * size * yieldStrain, fine);
			double elastic[N * N], column[N], e[N];
			for (int j = 0; j < N; ++j) {
				for (int k = 0; k < N; ++k)
					e[k] = k == j;
				TypeParam::elastic(law.elastic, e, column);
				for (int i = 0; i < N; ++i)
					elastic[i * N + j] = column[i];
			}
			for (int k = 0; k < N * N; ++k) {
				largest = std::max(largest, std::abs(elastic[k]));
				doubt   = std::max(doubt, std::abs(coarse[k] - fine[k]));
				error   = std::max(error, std::abs(tangent[k] - fine[k]));
				plastic = std::max(plastic, std::abs(tangent[k] - elastic[k]));
			}
			if (doubt > 2e-7 * largest) continue;
			++counted, flowing += plastic > .01 * largest;
			worst = std::max(worst, error / largest);
			EXPECT_LT(error, (jumps ? 1e-2 : 1e-6) * largest) << "trial " << trial << ", size " << size;
		}
		EXPECT_GE(counted, 1);
		if (!is<Elastic>(law) && N <= 3) {
			EXPECT_GE(flowing, 1);
		}
		std::printf("%s: %d differences converged, greatest error %.1e\n", named.name, counted, worst);
	}
}

/* Eq. 27 for the law without options: D - H1 H2 D a a^T D/(a^T D a + H), a = M xi/f. */
TYPED_TEST(LawTangent, OfTheContinuumIsEquation27)
{
	constexpr int                    N   = TypeParam::N;
	const Law                        law = boucWenLaw(3, .05, 1e-6);
	const BoucWen&                   p   = as<BoucWen>(law);
	std::mt19937                     random(3);
	std::normal_distribution<double> normal;
	for (int trial = 0; trial < 20; ++trial) {
		LawPoint<TypeParam>   point(law);
		std::array<double, N> rate {};
		for (double& e : rate)
			e = normal(random) * yieldStrain;
		point.strain(rate);
		for (double& e : rate)
			e = normal(random);
		double xi[N], a[N], Da[N], tangent[N * N], along = 0, aDa = 0;
		for (int k = 0; k < N; ++k)
			xi[k] = point.sigma[k] - point.internal[std::size_t(k)];
		const double f = std::sqrt(TypeParam::mises2(xi));
		TypeParam::normal(xi, f, a);
		TypeParam::elastic(law.elastic, a, Da);
		for (int k = 0; k < N; ++k)
			along += Da[k] * rate[std::size_t(k)], aDa += a[k] * Da[k];
		const double flow = std::pow(f / yieldStress, p.n) * (along > 0 ? 1 : 0);
		p.continuumTangent<TypeParam>(law.elastic, rate.data(), point.sigma, point.internal.data(), tangent);
		for (int j = 0; j < N; ++j) {
			double e[N], D[N];
			for (int k = 0; k < N; ++k)
				e[k] = k == j;
			TypeParam::elastic(law.elastic, e, D);
			for (int i = 0; i < N; ++i)
				EXPECT_NEAR(tangent[i * N + j], D[i] - flow * Da[i] * Da[j] / (aDa + p.hardening), 1e-10 * youngModulus);
		}
	}
}

/* A tiny increment is one sub-step: the two tangents of the hysteretic law meet, with every option. */
TYPED_TEST(LawTangent, OfATinyIncrementIsThatOfTheContinuum)
{
	constexpr int N = TypeParam::N;
	for (const NamedLaw& named : everyLaw()) {
		if (!is<BoucWen>(named.law)) continue;
		SCOPED_TRACE(named.name);
		const BoucWen&        model = as<BoucWen>(named.law);
		LawPoint<TypeParam>   point(named.law);
		std::array<double, N> increment {};
		increment[N - 1] = 1.5 * yieldStrain;
		point.strain(increment);
		for (const double sign : { 1., -1. }) {
			double e[N] {}, tangent[N * N], continuum[N * N];
			e[N - 1] = sign * 1e-7 * yieldStrain;
			consistentTangent<TypeParam>(point.law, e, point.sigma, point.internal.data(), tangent);
			model.continuumTangent<TypeParam>(point.law.elastic, e, point.sigma, point.internal.data(), continuum);
			for (int k = 0; k < N * N; ++k)
				EXPECT_NEAR(tangent[k], continuum[k], 1e-5 * youngModulus) << sign;
		}
	}
}

TEST(LawInternals, FitInTheSpaceReserved)
{
	BoucWen law;
	int     most = 0;
	for (int options = 0; options < 8; ++options) { // also those that validate() refuses together
		law.loadingRule          = options & 1 ? BoucWen::LoadingRule::paper : BoucWen::LoadingRule::normal;
		law.stiffnessDegradation = options & 2 ? .1 : 0;
		law.reloading            = options & 4 ? 2 : 0;
		Law any;
		any.model = law;
		for (const int components : { 1, 3, 4, 5, 6 }) {
			EXPECT_LE(Internals::of(any).columns(components), maxInternals(components));
			if (components == 6) most = std::max(most, Internals::of(any).columns(6));
		}
	}
	EXPECT_EQ(most, 17); // two tensors and five scalars
	for (const NamedLaw& named : everyLaw())
		EXPECT_LE(Internals::of(named.law).columns(6), maxInternals(6)) << named.name;
}

} // namespace
