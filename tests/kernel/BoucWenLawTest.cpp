// SPDX-License-Identifier: GPL-2.0-or-later
// The hysteretic law at one point, against exact solutions and for its invariants (doc/law.md). Stresses over sigma_y,
// strains in yield strains.
#include "LawPoint.hpp"
#include "kernel/PointDriver.hpp"
#include <gtest/gtest.h>
#include <limits>

using namespace yade::mpm;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/* Greatest difference from the exact solution over a reversed path, each branch in `steps` steps. */
double uniaxialError(double n, double alpha, double tolerance, int steps)
{
	ExactUniaxial      exact { n, alpha };
	LawPoint<Uniaxial> point(boucWenLaw(n, alpha, tolerance));
	double             worst = 0;
	for (const double to : { .5, 1., .2, 1.2, 3., -3., 3., -3., 0., 10., -10. }) {
		point.strain({ (to - exact.x) * yieldStrain }, steps);
		worst = std::max(worst, std::abs(point.sigma[0] / yieldStress - exact.go(to)));
	}
	return worst;
}

TEST(BoucWenLaw, ExactSolutionHasItsClosedFormsAndPublishedValues)
{
	for (const double x : { .1, .7, 2., 5. }) {
		EXPECT_NEAR((ExactUniaxial { 1, 0 }.go(x)), 1 - std::exp(-x), 1e-14);
		EXPECT_NEAR((ExactUniaxial { 2, 0 }.go(x)), std::tanh(x), 1e-14);
		const double z = ExactUniaxial { 4, 0 }.go(x);
		EXPECT_NEAR((std::atan(z) + std::atanh(z)) / 2, x, 1e-15 / (1 - z));
	}
	// knee: n (1 - z(1)) rises to ln 2
	const double knee[][2] = { { 2, .4768 }, { 5, .5849 }, { 10, .6340 }, { 20, .6622 }, { 50, .6804 } };
	for (const auto& [n, value] : knee)
		EXPECT_NEAR(n * (1 - ExactUniaxial { n, 0 }.go(1)), value, 5e-5);
}

TEST(BoucWenLaw, UniaxialErrorStaysBelowToleranceAndTightensWithIt)
{
	for (const double n : { 1., 2., 4., 10., 25. }) {
		std::printf("n = %g: greatest error/tolerance", n);
		for (const double tolerance : { 1e-2, 1e-4, 1e-6, 1e-8 }) {
			double worst = 0;
			for (const double alpha : { 0., .05 })
				for (const int steps : { 1, 3, 1000 })
					worst = std::max(worst, uniaxialError(n, alpha, tolerance, steps) / tolerance);
			EXPECT_LT(worst, 1) << n << " " << tolerance;
			EXPECT_GT(worst, .01) << n << " " << tolerance; // the tolerance is what decides
			std::printf("  %.2f at %g", worst, tolerance);
		}
		std::printf("\n");
	}
}

TEST(BoucWenLaw, ReversalStressesAndLoopEnergyOfN2)
{
	// 0 -> 3 -> -3 -> 3 -> -3, alpha = 0.05; W = 2 (1-alpha) [-Z^2/2 - ln(1-Z^2)/2] with 2 X = Z + atanh Z
	LawPoint<Uniaxial> point(boucWenLaw(2, .05, 1e-10));
	const double       expected[] = { 1.095302016002394, -1.099914592920165, 1.0999137595565647, -1.0999137597078623 };
	double             x          = 0;
	for (const double stress : expected) {
		const double to = stress > 0 ? 3 : -3;
		point.strain({ (to - x) * yieldStrain }), x = to;
		EXPECT_NEAR(point.sigma[0] / yieldStress, stress, 1e-9);
		std::printf("%.12f\n", point.sigma[0] / yieldStress);
	}
	const double before = point.response.dissipation;
	point.strain({ 6 * yieldStrain }), point.strain({ -6 * yieldStrain });
	const double W = (point.response.dissipation - before) / (yieldStress * yieldStrain);
	std::printf("W = %.10f\n", W);
	EXPECT_NEAR(W, 7.2334515525, 1e-9);
}

/* Uniaxial stress in a state S that has transverse strains: with A = a^T D a / E, stresses over sigma_y and strains in yield
strains, loading from z = 0 gives eps_p = (g(z) - z)/(A + H/E), sigma = z + H/E eps_p, eps = sigma + eps_p. A is 1 in Uniaxial,
(5/4 - nu)/(1 - nu^2) in PlaneStress, 3 G/E where all strains are free: the knee depends a little on the stress state.
The transverse strain -nu sigma - eps_p/2 is imposed: the transverse stress must vanish. */
template <class S> double transverseError(double n, double alpha)
{
	constexpr int steps = 1000;
	double        axis[S::N] { 1 }, a[S::N], Da[S::N];
	S::normal(axis, 1, a);
	LawPoint<S>         point(boucWenLaw(n, alpha, 1e-8));
	const ExactUniaxial exact { n, 0 };
	S::elastic(point.law.elastic, a, Da);
	const double A = dot<S>(a, Da) / youngModulus, H = as<BoucWen>(point.law).hardening / youngModulus;
	double       plastic = 0, longitudinal = 0, transverse = 0, worst = 0;
	for (const double sign : { 1., -1., 1. }) {
		const double reversed = plastic;
		for (int i = 1; i <= 2 * steps; ++i) {
			const double z = sign * (i <= steps ? .99 * i / steps : .99 * (2 * steps - i) / steps);
			if (i <= steps) plastic = reversed + sign * (exact.g(1 - std::abs(z)) - std::abs(z)) / (A + H);
			const double             sigma = z + H * plastic, x = sigma + plastic, lateral = -poissonRatio * sigma - .5 * plastic;
			std::array<double, S::N> increment {};
			for (int k = 0; k < normals<S>(); ++k)
				increment[std::size_t(k)] = (k == 0 ? x - longitudinal : lateral - transverse) * yieldStrain;
			point.strain(increment), longitudinal = x, transverse = lateral;
			for (int k = 0; k < S::N; ++k)
				worst = std::max(worst, std::abs(point.sigma[k] / yieldStress - (k == 0 ? sigma : 0)));
		}
	}
	EXPECT_GT(point.plasticStrain(), .05 * yieldStrain);
	return worst;
}

TEST(BoucWenLaw, UniaxialStressInEveryStressState)
{
	for (const double n : { 1., 2., 4., 10., 25. })
		for (const double alpha : { 0., .05 }) {
			// what the straight steps of 0.001 in z leave
			EXPECT_LT(transverseError<Uniaxial>(n, alpha), 1e-5) << n;
			EXPECT_LT(transverseError<PlaneStress>(n, alpha), 1e-5) << n;
			EXPECT_LT(transverseError<PlaneStrain>(n, alpha), 1e-5) << n;
			EXPECT_LT(transverseError<Solid>(n, alpha), 1e-5) << n;
		}
}

/* Invariants over random paths in one stress state, and the tolerance. A path that returns goes back along its last increment,
exactly or nearly, with cycles within cycles. */
template <class S> void randomPaths(int paths, unsigned seed, const std::function<void(BoucWen&, std::mt19937&)>& options = {}, bool returns = false)
{
	std::mt19937                           random(seed);
	std::uniform_real_distribution<double> unit(0, 1);
	std::normal_distribution<double>       normal;
	double                                 greatest = 0, worstAudit = 0, worstDifference = 0;
	for (int path = 0; path < paths; ++path) {
		const double n = .5 * std::pow(400, unit(random)), alpha = path % 2 ? .3 * unit(random) : 0;
		Law          law       = boucWenLaw(n, alpha, 1e-4);
		as<BoucWen>(law).gamma = .5 + .5 * (path % 3) * unit(random), as<BoucWen>(law).beta = 1 - as<BoucWen>(law).gamma;
		if (options) options(as<BoucWen>(law), random);
		ASSERT_EQ(validate(law), "");
		Law reference                    = law;
		as<BoucWen>(reference).tolerance = 1e-6;
		LawPoint<S> coarse(law), fine(reference);
		double      way = 0, size = 0;

		std::array<double, S::N> increment {};
		for (int i = 0; i < (returns ? 12 : 6); ++i) {
			const bool               back  = returns && i > 0 && unit(random) < .7;
			const double             share = back ? 1.3 * unit(random) : 0;
			const double             aside = back ? .2 * share * (random() % 2) * size : std::pow(10, -4 + 5 * unit(random));
			std::array<double, S::N> direction;
			double                   norm = 0, length = 0;
			for (double& e : direction)
				e = normal(random), norm += e * e;
			for (std::size_t k = 0; k < S::N; ++k)
				increment[k] = -share * increment[k] + aside * yieldStrain * direction[k] / std::sqrt(norm),
				length += increment[k] * increment[k];
			size                 = std::sqrt(length) / yieldStrain;
			const double plastic = coarse.plasticStrain(), dissipation = coarse.response.dissipation;
			coarse.strain(increment), way += size;
			const double radius = as<BoucWen>(law).isotropic.radius(yieldStress, coarse.plasticStrain()) / yieldStress;
			ASSERT_LE(coarse.f(), radius * (1 + 1e-9)) << "n = " << n;
			ASSERT_GE(coarse.plasticStrain(), plastic) << "n = " << n;
			ASSERT_GE(coarse.response.dissipation, dissipation) << "n = " << n;
			greatest = std::max(greatest, coarse.f());

			fine.strain(increment, 1 + int(100 * size));
			// trapezoids of 0.01 yield strains
			const double audit = (fine.work - fine.energy() - fine.response.dissipation) / (yieldStress * yieldStrain);
			worstAudit         = std::max(worstAudit, std::abs(audit) / (1 + way));
			ASSERT_LE(std::abs(audit), 3e-5 * (1 + way)) << "n = " << n << ", increment " << i << ", way " << way;
			double difference = 0;
			for (int k = 0; k < S::N; ++k)
				difference = std::max(difference, std::abs(coarse.sigma[k] - fine.sigma[k]) / yieldStress);
			worstDifference = std::max(worstDifference, difference);
			ASSERT_LE(difference, as<BoucWen>(law).tolerance) << "n = " << n << ", increment " << i << ", size " << size;
		}
	}
	EXPECT_GT(greatest, .999);
	std::printf("%d paths of %d components: audit %.1e, one step against many %.1e\n", paths, S::N, worstAudit, worstDifference);
}

TEST(LongBoucWenLaw, InvariantsAuditAndStepSizeOnTenThousandRandomPaths)
{
	randomPaths<Uniaxial>(2000, 1);
	randomPaths<PlaneStress>(3000, 2);
	randomPaths<PlaneStrain>(2500, 3);
	randomPaths<Solid>(2500, 4);
}

TEST(LongBoucWenLaw, InvariantsWithOptions)
{
	auto isotropic = [](BoucWen& law, std::mt19937&) { law.isotropic = { .02 * youngModulus, .5 * yieldStress, 20 / yieldStrain * 1e-2 }; };
	auto degrading = [](BoucWen& law, std::mt19937& random) {
		std::uniform_real_distribution<double> unit(0, 1);
		law.strengthDegradation = unit(random), law.stiffnessDegradation = 2 * unit(random);
		law.pinching = .9 * unit(random), law.pinchingLevel = .5 * unit(random);
	};
	auto reloading = [](BoucWen& law, std::mt19937& random) { law.reloading = random() % 2 ? infinity : 2; };
	randomPaths<PlaneStress>(400, 5, isotropic), randomPaths<Solid>(400, 6, isotropic);
	randomPaths<Uniaxial>(400, 7, degrading), randomPaths<PlaneStress>(400, 8, degrading), randomPaths<Solid>(400, 9, degrading);
	randomPaths<Uniaxial>(400, 12, reloading, true), randomPaths<PlaneStress>(400, 10, reloading, true);
	randomPaths<PlaneStrain>(400, 11, reloading, true), randomPaths<Solid>(400, 13, reloading, true);
	randomPaths<PlaneStress>(400, 14, reloading);
}

TEST(BoucWenLaw, OneStepOfTenYieldStrainsIsTenThousandSmallOnes)
{
	for (const double n : { .5, 2., 10., 2.5, 200. }) {
		LawPoint<PlaneStress> one(boucWenLaw(n, .05, 1e-4)), many = one;
		one.strain({ 6 * yieldStrain, -2 * yieldStrain, 7 * yieldStrain });
		many.strain({ 6 * yieldStrain, -2 * yieldStrain, 7 * yieldStrain }, 10000);
		for (int k = 0; k < 3; ++k)
			EXPECT_NEAR(one.sigma[k] / yieldStress, many.sigma[k] / yieldStress, 1e-4) << n;
	}
}

/* From a prestressed state, a step of hundreds of yield strains against the same in steps short enough for sub-steps all the way. */
template <class S> void farStep(double n, double tangentRatio, double poisson, double length)
{
	SCOPED_TRACE(
		std::to_string(S::N) + " components, n " + std::to_string(n) + ", alpha " + std::to_string(tangentRatio) + ", nu " + std::to_string(poisson));
	Law law     = boucWenLaw(n, tangentRatio, 1e-4);
	law.elastic = { youngModulus, poisson };
	LawPoint<S>              one(law);
	std::array<double, S::N> first {}, then {};
	const double             start[6] = { -1, .6, 2, 1, -2, 1.5 }, way[6] = { 1, -.3, .2, -.4, .3, .7 };
	for (int k = 0; k < S::N; ++k)
		first[std::size_t(k)] = start[k] * yieldStrain, then[std::size_t(k)] = length * way[k] * yieldStrain;
	one.strain(first, 10);
	LawPoint<S> many = one;
	one.strain(then), many.strain(then, int(length / 20));
	for (int k = 0; k < S::N; ++k) {
		EXPECT_NEAR(one.sigma[k] / yieldStress, many.sigma[k] / yieldStress, 1e-4);
		EXPECT_NEAR(one.internal[std::size_t(k)] / yieldStress, many.internal[std::size_t(k)] / yieldStress, 1e-4);
	}
	EXPECT_NEAR(one.plasticStrain() / many.plasticStrain(), 1, 1e-5);
	EXPECT_NEAR(one.response.dissipation / many.response.dissipation, 1, 1e-4);
}
TEST(BoucWenLaw, OneStepOfHundredsOfYieldStrains)
{
	for (const double n : { .5, 2., 20. })
		for (const double alpha : { 0., .05 })
			for (const double poisson : { -.5, .3, .49 }) {
				farStep<Uniaxial>(n, alpha, poisson, 500), farStep<PlaneStress>(n, alpha, poisson, 500);
				farStep<PlaneStrain>(n, alpha, poisson, 500), farStep<Solid>(n, alpha, poisson, 500);
				farStep<FreeNormals<2>>(n, alpha, poisson, 500), farStep<FreeNormals<1>>(n, alpha, poisson, 500);
			}
}

/* A yield stress in the wrong unit: what a step costs has a bound, and what cannot be done within it is no number. */
TEST(BoucWenLaw, NoStepTakesForEver)
{
	const std::array<double, 3> strain { 1e-3, -4e-4, 3e-4 };
	for (const double n : { .5, 2., 200. })
		for (const double yield : { 1e-6, 1e-9, 1e-12 })
			for (const double alpha : { 0., .05 }) {
				Law one                      = boucWenLaw(n, alpha, 1e-4);
				as<BoucWen>(one).yieldStress = yield * youngModulus;
				const BoucWen& law           = as<BoucWen>(one);
				Pack<1>        e[3], sigma[3] {}, internal[8] {};
				Responses<1>   response;
				for (const double sign : { 1., -1. }) {
					int subSteps = 0;
					for (int k = 0; k < 3; ++k)
						e[k][0] = sign * strain[std::size_t(k)];
					law.update<PlaneStress>(one.elastic, e, sigma, internal, response, &subSteps);
					double xi[3];
					for (int k = 0; k < 3; ++k)
						xi[k] = sigma[k][0] - internal[k][0];
					EXPECT_LT(subSteps, 1000 + 40 * n);
					EXPECT_NEAR(std::sqrt(PlaneStress::mises2(xi)) / law.yieldStress, 1, 1e-4 + (alpha > 0 ? 1e-16 / yield : 0));
				}
			}
	for (const auto& choose :
		std::initializer_list<std::function<void(BoucWen&)>> { [](auto& p) { p.strengthDegradation = .1; }, [](auto& p) { p.isotropic.modulus = 1e9; },
			[](auto& p) { p.reloading = 2; }, [](auto& p) { p.n = 1e12; }, [](auto& p) { p.loadingRule = BoucWen::LoadingRule::paper; } }) {
		Law law                      = boucWenLaw(10, 0, 1e-4);
		as<BoucWen>(law).yieldStress = 1e-9 * youngModulus;
		choose(as<BoucWen>(law));
		LawPoint<PlaneStress> point(law);
		point.strain(strain);
		EXPECT_FALSE(std::isfinite(point.sigma[0]));
	}
	// under a pressure whose rounding is more than the tolerance: no number, or the surface to that rounding
	Law law                      = boucWenLaw(200, 0, 1e-8);
	law.elastic                  = { youngModulus, .4999 };
	as<BoucWen>(law).yieldStress = 1e-12 * youngModulus;
	LawPoint<PlaneStrain> point(law);
	point.strain({ .1, .1, .1, 0 });
	for (int k = 0; k < 5 && std::isfinite(point.sigma[0]); ++k)
		point.strain({ 3e-11, -2e-11, -1e-11, 2e-11 });
	if (std::isfinite(point.sigma[0])) {
		EXPECT_LE(std::sqrt(PlaneStrain::mises2(point.sigma)), as<BoucWen>(law).yieldStress + 4e-16 * std::abs(point.sigma[0]));
	}
}

/* With the sign as printed f comes to 4 sigma_y, and falls back when the total strain has changed its sign: at the rate 4^n, which for a large n no
sub-step can follow. */
TEST(BoucWenLaw, SignOfThePaperFallsTooFastToFollow)
{
	Law law                      = boucWenLaw(25, 0, 1e-4);
	as<BoucWen>(law).loadingRule = BoucWen::LoadingRule::paper;
	LawPoint<Uniaxial> bar(law);
	LawPoint<Solid>    solid(law);
	bar.strain({ 5 * yieldStrain }), solid.strain({ 5 * yieldStrain, 0, 0, 0, 0, yieldStrain });
	bar.strain({ -10 * yieldStrain }), solid.strain({ -10 * yieldStrain, 0, 0, 0, 0, -2 * yieldStrain });
	EXPECT_FALSE(std::isfinite(bar.sigma[0]));
	EXPECT_FALSE(std::isfinite(solid.sigma[0]));
}

TEST(BoucWenLaw, SignOfThePaperLetsTheStressPassYield)
{
	// n = 2: 0 -> 5 -> -5 with alpha = 0 reaches 4 sigma_y, 0 -> 8 -> -8 with alpha = 0.2 reaches 7
	const double paths[][3] = { { 5, 0, 4 }, { 8, .2, 7 } };
	for (const auto& [reach, alpha, greatest] : paths)
		for (const bool paper : { false, true }) {
			Law law = boucWenLaw(2, alpha, 1e-4);
			if (paper) as<BoucWen>(law).loadingRule = BoucWen::LoadingRule::paper;
			LawPoint<Uniaxial> point(law);
			double             worst = 0;
			for (int i = 1; i <= 300; ++i) {
				point.strain({ (i <= 100 ? reach : -reach) / 100 * yieldStrain });
				worst = std::max(worst, point.f());
			}
			EXPECT_NEAR(worst, paper ? greatest : 1, paper ? 2e-3 : 1e-3) << alpha;
		}
}

/* From z1 unload by d: stress after reloading by the same strain, and the strain at which z1 is back, less where it was. */
struct Cycle {
	double relaxation, drift;
};
template <class S> Cycle shortCycle(double reloading, double z1, double d, double tolerance = 1e-9)
{
	Law law                    = boucWenLaw(2, 0, tolerance);
	as<BoucWen>(law).reloading = reloading;
	LawPoint<S>              point(law);
	double                   De[S::N];
	std::array<double, S::N> way {}; // of a uniaxial stress in Uniaxial, of pure shear elsewhere
	way[S::N - 1] = S::N == 1 ? yieldStrain : yieldStress / std::sqrt(3.) / law.elastic.shear;
	S::elastic(law.elastic, way.data(), De);
	auto go = [&](double x, int steps) {
		std::array<double, S::N> increment = way;
		for (double& e : increment)
			e *= x;
		point.strain(increment, steps);
	};
	go(std::atanh(z1), 1);
	EXPECT_NEAR(point.f(), z1, 1e-8);
	go(-d, 3), go(d, 7);
	Cycle cycle { z1 - point.f(), 0 };
	for (double step = d; step > 1e-10; step *= .5) // bisection for the strain
		for (;;) {
			const LawPoint<S> before = point;
			go(step, 1), cycle.drift += step;
			if (point.f() < z1 - 1e-9) continue;
			point = before, cycle.drift -= step;
			break;
		}
	return cycle;
}

TEST(BoucWenLaw, ShortReloadingDriftsUnlessCompatible)
{
	const double cases[][4] = { { .8, .2, .0871, .2055 }, { .95, .1, .0745, .476 } };
	for (const auto& [z1, d, relaxation, drift] : cases) {
		const Cycle plain = shortCycle<Uniaxial>(0, z1, d), shear = shortCycle<PlaneStress>(0, z1, d);
		EXPECT_NEAR(plain.relaxation, relaxation, 1e-4);
		EXPECT_NEAR(plain.drift, drift, 5e-4);
		EXPECT_NEAR(shear.drift, drift, 5e-4);
		for (const Cycle& closed :
			{ shortCycle<Uniaxial>(infinity, z1, d), shortCycle<PlaneStress>(infinity, z1, d), shortCycle<Solid>(infinity, z1, d) }) {
			EXPECT_NEAR(closed.relaxation, 0, 1e-8);
			EXPECT_NEAR(closed.drift, 0, 1e-6);
		}
		// a finite exponent rounds the corner and leaves part of the drift
		const double quadratic = shortCycle<Uniaxial>(2, z1, d).drift, sharp = shortCycle<Uniaxial>(20, z1, d).drift;
		std::printf("z1 = %g, d = %g: relaxation %.4f, drift %.4f; with r = 2 %.4f, with r = 20 %.4f\n", z1, d, plain.relaxation, plain.drift,
			quadratic, sharp);
		EXPECT_LT(quadratic, .6 * drift);
		EXPECT_LT(sharp, .3 * quadratic);
		EXPECT_GT(sharp, 0);
	}
}

TEST(BoucWenLaw, CompatibleReloadingKeepsTheVirginCurve)
{
	for (const double r : { 1., 3., infinity }) {
		Law law                    = boucWenLaw(2, .05, 1e-8);
		as<BoucWen>(law).reloading = r;
		LawPoint<PlaneStress> plain(boucWenLaw(2, .05, 1e-8)), virgin(law), cycled(law);
		const double          e = yieldStrain;
		for (auto* point : { &plain, &virgin, &cycled })
			point->strain({ .7 * e, .2 * e, .3 * e }, 50);
		for (int k = 0; k < 3; ++k)
			ASSERT_NEAR(virgin.sigma[k], plain.sigma[k], 1e-12 * yieldStress);
		if (r != infinity) continue;
		// many short cycles on the way leave no trace
		for (int i = 0; i < 100; ++i)
			cycled.strain({ -.14 * e, -.04 * e, -.06 * e }, 2), cycled.strain({ .14 * e, .04 * e, .06 * e }, 3);
		for (auto* point : { &plain, &virgin, &cycled })
			point->strain({ .7 * e, .2 * e, .3 * e }, 50);
		for (int k = 0; k < 3; ++k) {
			EXPECT_NEAR(virgin.sigma[k], plain.sigma[k], 1e-12 * yieldStress);
			EXPECT_NEAR(cycled.sigma[k], plain.sigma[k], 1e-7 * yieldStress);
		}
	}
}

TEST(BoucWenLaw, CompatibleReloadingDependsContinuouslyOnThePath)
{
	constexpr double e = yieldStrain, small = 1e-5;
	for (const double r : { 1., 3., infinity }) {
		Law law                    = boucWenLaw(2, .05, 1e-8);
		as<BoucWen>(law).reloading = r;
		auto difference            = [](const auto& pair) {
                        double greatest = 0;
                        for (std::size_t k = 0; k < std::size(pair[0].sigma); ++k)
                                greatest = std::max(greatest, std::abs(pair[0].sigma[k] - pair[1].sigma[k]) / yieldStress);
                        return greatest;
		};
		// unloaded almost and more than completely
		std::array<LawPoint<Uniaxial>, 2> bars { LawPoint<Uniaxial>(law), LawPoint<Uniaxial>(law) };
		for (double sign : { 1., -1. }) {
			auto& point = bars[sign < 0];
			point.strain({ 1.2 * e }), point.strain({ -point.f() * e - sign * small * e }), point.strain({ e });
		}
		EXPECT_LT(difference(bars), 10 * small) << r;
		// beside the surface of constant f, outside and inside of it, and back
		std::array<LawPoint<PlaneStress>, 2> plates { LawPoint<PlaneStress>(law), LawPoint<PlaneStress>(law) };
		for (double sign : { 1., -1. }) {
			auto& point = plates[sign < 0];
			point.strain({ 1.2 * e }), point.strain({ sign * small * e, 0, small * e });
			point.strain({ -.3 * e, 0, -.8 * e }), point.strain({ .1 * e, 0, 1.2 * e }), point.strain({ -e, 0, -.5 * e });
		}
		EXPECT_LT(difference(plates), 10 * small) << r;
		// unloaded again a little below and above the stress of the first unloading
		for (double sign : { 1., -1. }) {
			auto& point = bars[sign < 0];
			point       = LawPoint<Uniaxial>(law);
			point.strain({ 1.2 * e });
			const double f = point.f();
			point.strain({ -.3 * e });
			for (double step = .4; step > 1e-9; step *= .5) {
				LawPoint<Uniaxial> further = point;
				further.strain({ step * e });
				if (further.f() < f - sign * small) point = further;
			}
			point.strain({ -.1 * e }), point.strain({ .1 * e });
		}
		EXPECT_LT(difference(bars), 30 * small) << r;
	}
}

TEST(BoucWenLaw, FlowLeavesThePressureAlone)
{
	// also where a sub-step has passed the yield stress and is put back
	const double e = yieldStrain, pressure = 90 * e * youngModulus / (1 - 2 * poissonRatio);
	Law          law           = boucWenLaw(10, .05, 1e-2);
	as<BoucWen>(law).reloading = 2;
	for (double shear = 2; shear < 4; shear *= 1.1)
		for (const double back : { .01, .03, .1 }) {
			LawPoint<PlaneStrain> point(law);
			point.strain({ 30 * e, 30 * e, 30 * e, 0 });
			for (const double turn : { shear, -back, shear, -shear, shear })
				point.strain({ .1 * e, -.1 * e, 0, turn * e });
			EXPECT_GT(point.plasticStrain(), e);
			EXPECT_NEAR((point.sigma[0] + point.sigma[1] + point.sigma[2]) / pressure, 1, 1e-12);
		}
}

/* The law with its options in one dimension by Runge-Kutta, stresses over sigma_y, p in yield strains: an independent statement of doc/law.md. */
struct ScalarLaw {
	BoucWen               law;
	std::array<double, 5> y {};                  // sigma, eta, p, e, growth of the compliance
	double                limit = 0, origin = 0; // of reloading

	std::array<double, 5> rate(const std::array<double, 5>& at, double sign) const
	{
		const auto [sigma, eta, p, e, growth] = at;
		const double xi = sigma - eta, f = std::abs(xi), side = xi < 0 ? -1 : 1, D = 1 / (1 + growth), kinematic = law.hardening / youngModulus;
		const double K = law.isotropic.modulus / youngModulus, Q = law.isotropic.saturation / yieldStress, b = law.isotropic.rate * yieldStrain;
		const double R = 1 + K * p + Q * (1 - std::exp(-b * p)), slope = K + Q * b * std::exp(-b * p);
		double       flow = (1 + law.strengthDegradation * e) * std::pow(f / R, law.n);
		if (side * sign > 0) {
			if (law.reloading != 0 && f < limit) flow *= std::pow(std::max(0., f - origin) / (limit - origin), law.reloading);
			const double off = (f / R - law.pinchingLevel) / law.pinchingWidth;
			flow             = 1 - (1 - law.pinching * (1 - std::exp(-law.pinchingRate * e)) * std::exp(-off * off)) * (1 - flow);
		} else
			flow *= law.beta - law.gamma;
		const double dp = flow * side * sign * D / (D + kinematic + slope), heat = f * dp, work = xi * sign;
		if (law.hysteretic()) return { D * (sign - dp * side), kinematic * dp * side, dp, work, law.stiffnessDegradation * work };
		return { D * (sign - dp * side), kinematic * dp * side, dp, heat,
			std::min(law.stiffnessDegradation, 2 / std::max(1e-30, sigma * sigma)) * heat };
	}
	void go(double dx, int steps)
	{
		const double h = std::abs(dx) / steps, sign = dx > 0 ? 1 : -1;
		for (int i = 0; i < steps; ++i) {
			const double          xi = y[0] - y[1], f = std::abs(xi);
			std::array<double, 5> sum {}, k {};
			const double          node[] = { 0, .5, .5, 1 }, weight[] = { 1, 2, 2, 1 };
			for (int stage = 0; stage < 4; ++stage) {
				std::array<double, 5> at = y;
				for (std::size_t c = 0; c < y.size(); ++c)
					at[c] += node[stage] * h * k[c];
				k = rate(at, sign);
				for (std::size_t c = 0; c < y.size(); ++c)
					sum[c] += weight[stage] * h / 6 * k[c];
			}
			for (std::size_t c = 0; c < y.size(); ++c)
				y[c] += sum[c];
			const double g = std::abs(y[0] - y[1]);
			if (xi * sign > 0) {
				if (g >= limit) limit = origin = g;
			} else if (limit > 0) {
				const double product = (1 - origin / limit) * std::pow(1 - f / limit, 3), ratio = std::max(g / limit, .25);
				limit  = std::min(limit, 4 * g);
				origin = std::min(g, limit * (1 - product / std::pow(1 - ratio, 3)));
			}
		}
	}
};

TEST(BoucWenLaw, OptionsFollowTheirScalarEquations)
{
	const struct {
		const char*                   name;
		std::function<void(BoucWen&)> set;
	} cases[] = {
		{ "strength", [](auto& p) { p.strengthDegradation   = .1; } },
		{ "stiffness", [](auto& p) { p.stiffnessDegradation= .2; } },
		{ "pinching", [](auto& p) { p.pinching= .7, p.pinchingLevel = .3; } },
		{ "degradation", [](auto& p) { p.strengthDegradation= .05, p.stiffnessDegradation = .1, p.pinching = .8, p.pinchingLevel = .2; } },
		{ "degradation, hysteretic measure",
			[](auto& p) {
				p.strengthDegradation= .05, p.stiffnessDegradation = .1, p.pinching = .8, p.pinchingLevel = .2;
				p.degradationMeasure= BoucWen::DegradationMeasure::hysteretic;
			} },
		{ "beta, gamma", [](auto& p) { p.beta= .1, p.gamma = .9; } },
		{ "isotropic", [](auto& p) { p.isotropic.modulus= .05 * youngModulus; } },
		{ "saturation",
			[](auto& p) {
				p.isotropic= { 0, .5 * yieldStress, .3 / yieldStrain };
			} },
		{ "reloading", [](auto& p) { p.reloading= 2; } },
		{ "n below 1", [](auto& p) { p.n= .7, p.beta = .2, p.gamma = .8; } },
		{ "all",
			[](auto& p) {
				p.beta= .3, p.gamma = .7, p.isotropic = { .02 * youngModulus, .3 * yieldStress, .3 / yieldStrain },
				p.strengthDegradation= .05;
				p.stiffnessDegradation= .1, p.pinching = .5, p.pinchingLevel = .2, p.reloading = 3;
			} },
	};
	for (const auto& c : cases)
		for (const double alpha : { 0., .05 }) {
			Law law = boucWenLaw(2, alpha, 1e-7);
			c.set(as<BoucWen>(law));
			ASSERT_EQ(validate(law), "") << c.name;
			LawPoint<Uniaxial> point(law), plain(boucWenLaw(2, alpha, 1e-7));
			ScalarLaw          reference;
			reference.law = as<BoucWen>(law);
			double x = 0, effect = 0, worst = 0;
			for (const double to : { 3., 2.6, 2.95, 1.5, -.5, -3., -2.7, -2.9, .5, 3. }) {
				point.strain({ (to - x) * yieldStrain }), plain.strain({ (to - x) * yieldStrain });
				reference.go(to - x, 20000), x = to;
				worst  = std::max({ worst, std::abs(point.sigma[0] / yieldStress - reference.y[0]),
					 std::abs(point.internal[0] / yieldStress - reference.y[1]),
					 std::abs(point.plasticStrain() / yieldStrain - reference.y[2]) });
				effect = std::max(effect, std::abs(point.sigma[0] - plain.sigma[0]) / yieldStress);
			}
			EXPECT_LT(worst, 1e-5) << c.name << ", alpha = " << alpha;
			EXPECT_GT(effect, .02) << c.name;
			std::printf("%s, alpha = %g: %.1e, effect %.2f\n", c.name, alpha, worst, effect);
		}
}

/* Baber and Noori's z of dz/du = (1 - nu abs(z)^n (beta sign(z u') + gamma))/eta, nu = 1 + 0.1 e, eta = 1 + 0.05 e, n = 1, e the integral of
z du, at u = 3, -3, 3, -3; numbers of an integration in steps of 1.5e-4 by Runge and Kutta. */
TEST(BoucWenLaw, HystereticMeasureIsBaberAndNooris)
{
	const double expected[] = { .84757777, -.70171898, .59383077, -.52283669 }, measure[] = { 1.95094323, 4.83553139, 7.29936928, 9.51215398 };
	for (const double alpha : { 0., .05 })
		for (const int steps : { 1, 1000 }) {
			Law law                              = boucWenLaw(1, alpha, 1e-8);
			as<BoucWen>(law).strengthDegradation = .1, as<BoucWen>(law).stiffnessDegradation = .05;
			as<BoucWen>(law).degradationMeasure = BoucWen::DegradationMeasure::hysteretic;
			ASSERT_EQ(validate(law), "");
			LawPoint<Uniaxial>       point(law);
			LawPoint<FreeNormals<1>> free(law);
			double                   u = 0;
			for (int k = 0; k < 4; ++k) {
				const double to = k % 2 ? -3 : 3;
				point.strain({ (to - u) * yieldStrain }, steps), free.strain({ (to - u) * yieldStrain, 0, 0, 0 }, steps), u = to;
				if (alpha > 0) continue; // eta divides the whole stiffness here
				EXPECT_NEAR((point.sigma[0] - point.internal[0]) / yieldStress, expected[k], 1e-6);
				EXPECT_NEAR((free.sigma[0] - free.internal[0]) / yieldStress, expected[k], 1e-6);
				EXPECT_NEAR(point.internal[2], measure[k], 1e-5);
			}
			if (steps == 1) continue;
			const double unit = yieldStress * yieldStrain;
			EXPECT_NEAR((point.work - point.energy() - point.response.dissipation) / unit, 0, 1e-4);
			EXPECT_GT(point.response.dissipation, 3 * unit);
		}
	// back from an elastic excursion nothing has been measured
	Law law                               = boucWenLaw(50, 0, 1e-6);
	as<BoucWen>(law).stiffnessDegradation = .5, as<BoucWen>(law).degradationMeasure = BoucWen::DegradationMeasure::hysteretic;
	LawPoint<Uniaxial> point(law);
	point.strain({ .5 * yieldStrain });
	EXPECT_NEAR(point.internal[2], .125, .01);
	point.strain({ -.5 * yieldStrain });
	EXPECT_NEAR(point.internal[2], 0, 1e-6);
	EXPECT_NEAR(point.sigma[0] / yieldStress, 0, 1e-6);
}

TEST(BoucWenLaw, StrengthDegradationLowersThePlateau)
{
	// f follows nu^(-1/n), nu = 1 + d_nu e, while nu grows slowly
	Law law                              = boucWenLaw(10, 0, 1e-6);
	as<BoucWen>(law).strengthDegradation = .2;
	LawPoint<PlaneStrain> point(law);
	point.strain({ 20 * yieldStrain, -20 * yieldStrain, 0, 0 });
	const double e = point.internal[std::size_t(PlaneStrain::N + 1)];
	EXPECT_GT(e, 15);
	EXPECT_NEAR(point.f(), std::pow(1 + .2 * e, -.1), 2e-3);
}

TEST(BoucWenLaw, IsotropicHardeningSaturatesAtItsRadius)
{
	for (const double n : { 2., 25. }) {
		Law law                    = boucWenLaw(n, .05, 1e-6);
		as<BoucWen>(law).isotropic = { .01 * youngModulus, .4 * yieldStress, 2 / yieldStrain };
		LawPoint<Solid> point(law);
		double          p = 0;
		for (int branch = 0; branch < 3; ++branch) {
			point.strain({ 0, 0, 0, 0, 0, (branch % 2 ? -30 : 30) * yieldStrain });
			EXPECT_NEAR(point.f(), as<BoucWen>(law).isotropic.radius(yieldStress, point.plasticStrain()) / yieldStress, 2e-5);
			EXPECT_GT(point.plasticStrain(), p + 10 * yieldStrain);
			p = point.plasticStrain();
		}
		EXPECT_GT(point.f(), 1.8);
	}
}

TEST(BoucWenLaw, RefusesInadmissibleParameters)
{
	struct Case {
		const char*                   attribute;
		std::function<void(BoucWen&)> spoil;
	};
	const double nan = std::nan("");
	for (const Case& c : {
		     Case { "yieldStress", [](auto& p) { p.yieldStress = -1; } },
		     Case { "yieldStress = 0.001", [](auto& p) { p.yieldStress = 1e-3; } },
		     Case { "n = 0", [](auto& p) { p.n = 0; } },
		     Case { "n = nan", [=](auto& p) { p.n = nan; } },
		     Case { "beta + gamma", [](auto& p) { p.beta = .6; } },
		     Case { "gamma", [](auto& p) { p.gamma = .4, p.beta = .6; } },
		     Case { "hardening", [](auto& p) { p.hardening = -1; } },
		     Case { "tolerance", [](auto& p) { p.tolerance = 0; } },
		     Case { "isotropicModulus", [](auto& p) { p.isotropic.modulus = -1; } },
		     Case { "strengthDegradation", [=](auto& p) { p.strengthDegradation = nan; } },
		     Case { "degradationMeasure = 'hysteretic'", [](auto& p) { p.degradationMeasure = BoucWen::DegradationMeasure::hysteretic; } },
		     Case { "stiffnessDegradation = 2.1", [](auto& p) { p.stiffnessDegradation = 2.1; } },
		     Case { "pinching", [](auto& p) { p.pinching = 1; } },
		     Case { "pinchingWidth", [](auto& p) { p.pinchingWidth = 0; } },
		     Case { "reloading = 0.5", [](auto& p) { p.reloading = .5; } },
		     Case { "loadingRule", [](auto& p) { p.loadingRule = BoucWen::LoadingRule::paper, p.reloading = 1; } },
	     }) {
		Law law = boucWenLaw(2, .05, 1e-4);
		ASSERT_EQ(validate(law), "");
		c.spoil(as<BoucWen>(law));
		EXPECT_EQ(validate(law).rfind(c.attribute, 0), 0u) << c.attribute << " / " << validate(law);
	}
	Law incompressible     = boucWenLaw(2, .05, 1e-4);
	incompressible.elastic = Hooke(1, .5);
	EXPECT_EQ(validate(incompressible).rfind("poisson", 0), 0u) << validate(incompressible);
}

} // namespace
