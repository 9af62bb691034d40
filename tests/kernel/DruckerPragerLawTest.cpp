// SPDX-License-Identifier: GPL-2.0-or-later
// Drucker & Prager's law at one point: closed forms of soil mechanics, cone, apex, energy.
#include "LawPoint.hpp"
#include "kernel/PointDriver.hpp"
#include <algorithm>
#include <gtest/gtest.h>

using namespace yade::mpm;

namespace {

constexpr double cohesion = 20e3, friction = .5, dilatancy = .2, soilModulus = 50e6, soilPoisson = .25;

Law soil(double c = cohesion, double phi = friction, double psi = dilatancy)
{
	Law law;
	law.model = DruckerPrager(), law.elastic = { soilModulus, soilPoisson };
	as<DruckerPrager>(law).cohesion = c, as<DruckerPrager>(law).internalFriction = phi, as<DruckerPrager>(law).dilatancy = psi;
	return law;
}
template <class S> double coneValue(const Law& law, const double* s)
{
	double trace = 0;
	for (int k = 0; k < normals<S>(); ++k)
		trace += s[k];
	return std::sqrt(S::mises2(s)) + as<DruckerPrager>(law).slope(as<DruckerPrager>(law).internalFriction) * trace / 3 - as<DruckerPrager>(law).strength();
}

TEST(DruckerPragerLaw, UnconfinedAndTriaxialCompressionAreMohrCoulombs)
{
	// sigma_1 = sigma_3 N + 2 c sqrt N, N = (1 + sin phi)/(1 - sin phi), compression positive
	const double        N = (1 + std::sin(friction)) / (1 - std::sin(friction)), unconfined = 2 * cohesion * std::sqrt(N);
	std::vector<double> path;
	for (int i = 0; i <= 50; ++i)
		path.insert(path.end(), { 0, 0, 0, 0, 0, 0, 0, 0, -.0004 * i });
	const PointHistory point = drivePoint(soil(), path, { true, true, false });
	EXPECT_NEAR(point.stress[9 * 50 + 8], -unconfined, 1e-9 * unconfined);
	EXPECT_NEAR(point.stress[9 * 50], 0, 1e-9 * unconfined);
	// dilatancy: d(eps_v)/d(p) = etaPsi, p the deviatoric plastic strain
	auto         volume = [&](std::size_t i) { return point.strain[9 * i] + point.strain[9 * i + 4] + point.strain[9 * i + 8]; };
	const double rate   = (volume(50) - volume(40)) / (point.plasticStrain[50] - point.plasticStrain[40]);
	EXPECT_NEAR(rate, DruckerPrager::slope(dilatancy), 1e-8);

	// under a cell pressure: hydrostatic, then axial strain with the lateral stress held by hand
	const double    cell = 100e3;
	LawPoint<Solid> triaxial(soil());
	const double    squeeze = -cell * (1 - 2 * soilPoisson) / soilModulus;
	triaxial.strain({ squeeze, squeeze, squeeze, 0, 0, 0 });
	for (int i = 0; i < 200; ++i) {
		LawPoint<Solid> low = triaxial, high = triaxial;
		double          a = -1e-3, b = 1e-3;
		for (int k = 0; k < 60; ++k) {
			const double lateral = .5 * (a + b);
			low                  = triaxial;
			low.strain({ lateral, lateral, -1e-4, 0, 0, 0 });
			(low.sigma[0] > -cell ? b : a) = lateral;
		}
		triaxial = low;
	}
	EXPECT_NEAR(triaxial.sigma[2], -(cell * N + unconfined), 1e-6 * cell);
}

TEST(DruckerPragerLaw, TensionEndsAtTheApex)
{
	const Law       law = soil();
	LawPoint<Solid> point(law);
	point.strain({ 1e-2, 1e-2, 1.1e-2, 2e-4, 0, 0 });
	const double apex = as<DruckerPrager>(law).strength() / DruckerPrager::slope(friction);
	EXPECT_NEAR(apex, cohesion / std::tan(friction), 1e-9 * apex);
	for (int k = 0; k < 6; ++k)
		EXPECT_NEAR(point.sigma[k], k < 3 ? apex : 0, 1e-9 * apex);
}

TEST(DruckerPragerLaw, WithoutFrictionItIsJ2)
{
	Law perfect                 = j2Law(0);
	perfect.elastic             = { soilModulus, soilPoisson };
	as<J2>(perfect).yieldStress = 2 * cohesion;
	LawPoint<PlaneStrain> a(soil(cohesion, 0, 0)), b(perfect);
	LawPoint<PlaneStress> c(soil(cohesion, 0, 0)), d(perfect);
	for (const double sign : { 1., -1.5, 2. }) {
		a.strain({ sign * 1e-3, -4e-4, 0, sign * 2e-3 }), b.strain({ sign * 1e-3, -4e-4, 0, sign * 2e-3 });
		c.strain({ sign * 1e-3, -4e-4, sign * 2e-3 }), d.strain({ sign * 1e-3, -4e-4, sign * 2e-3 });
		for (int k = 0; k < 4; ++k)
			EXPECT_NEAR(a.sigma[k], b.sigma[k], 1e-9 * cohesion);
		for (int k = 0; k < 3; ++k)
			EXPECT_NEAR(c.sigma[k], d.sigma[k], 1e-6 * cohesion);
	}
	EXPECT_GT(a.plasticStrain(), 1e-3);
}

template <class S> void randomPaths(unsigned seed)
{
	std::mt19937                           random(seed);
	std::normal_distribution<double>       normal;
	std::uniform_real_distribution<double> unit(0, 1);
	int                                    flowing = 0;
	for (int path = 0; path < 300; ++path) {
		const double phi = path % 5 ? 1.2 * unit(random) : 0;
		const Law    law = soil(path % 3 ? cohesion : 1e3, phi, phi * unit(random));
		ASSERT_EQ(validate(law), "");
		LawPoint<S> point(law);
		for (int i = 0; i < 5; ++i) {
			std::array<double, S::N> increment;
			const double             size = std::pow(10, -6 + 4 * unit(random));
			for (double& e : increment)
				e = size * normal(random);
			const double plastic = point.plasticStrain(), dissipation = point.response.dissipation;
			point.strain(increment);
			const double scale = as<DruckerPrager>(law).strength() + std::sqrt(S::mises2(point.sigma));
			ASSERT_LE(coneValue<S>(law, point.sigma), 1e-9 * scale + 1e-12 * soilModulus * size);
			ASSERT_GE(point.plasticStrain(), plastic);
			ASSERT_GE(point.response.dissipation, dissipation - 1e-12 * scale * size);
			flowing += point.plasticStrain() > plastic;
		}
	}
	EXPECT_GT(flowing, 300);
}
TEST(DruckerPragerLaw, ConeAndDissipationOnRandomPaths)
{
	randomPaths<Uniaxial>(1);
	randomPaths<PlaneStress>(2);
	randomPaths<PlaneStrain>(3);
	randomPaths<Solid>(4);
	randomPaths<FreeNormals<0>>(5);
	randomPaths<FreeNormals<1>>(6);
	randomPaths<FreeNormals<2>>(7);
}

TEST(DruckerPragerLaw, FreeStrainLeavesNoStress)
{
	// what plane stress found for zz, imposed on the solid
	std::vector<double> path;
	for (int i = 0; i <= 300; ++i) {
		const double t = i / 100.;
		path.insert(path.end(), { -.01 * t, .002 * t * t, 0, .002 * t * t, .004 * std::sin(t), .001 * t, 0, .001 * t, 0 });
	}
	const PointHistory plane = drivePoint(soil(), path, { false, false, true }), solid = drivePoint(soil(), plane.strain);
	double             worst = 0, greatest = 0;
	for (std::size_t k = 0; k < plane.stress.size(); ++k)
		worst = std::max(worst, std::abs(plane.stress[k] - solid.stress[k])), greatest = std::max(greatest, std::abs(plane.stress[k]));
	EXPECT_LT(worst, 1e-6 * greatest);
	EXPECT_GT(plane.plasticStrain.back(), .01);
}

TEST(DruckerPragerLaw, RefusesInadmissibleParameters)
{
	EXPECT_EQ(validate(soil(-1)).rfind("cohesion", 0), 0u);
	EXPECT_EQ(validate(soil(1, 2)).rfind("internalFriction", 0), 0u);
	EXPECT_EQ(validate(soil(1, .3, .4)).rfind("dilatancy", 0), 0u);
	EXPECT_EQ(validate(soil(0, 0, 0)).rfind("cohesion", 0), 0u);
}

/* The angle and cohesion mobilised in the state that the cone is matched to are those given, and the inscribed cone exceeds them nowhere. Limit states after
 * large strain, with and without dilatancy. In plane strain the limit state of constant stress needs the volume to grow at the rate of the flow,
 * eps_1 + eps_2 = sin(psi) (eps_1 - eps_2): under another path stresses grow for ever, and with them the elastic strain across the plane. */
TEST(DruckerPragerLaw, MatchesTheStateThatItNames)
{
	using Match       = DruckerPrager::Match;
	const auto excess = [](Match match, double phi, double psi, std::array<double, 3> direction) {
		Law law                      = soil(cohesion, phi, psi);
		as<DruckerPrager>(law).match = match;
		LawPoint<PlaneStrain> point(law);
		point.strain({ -2e-3, -2e-3, -2e-3, 0 });
		for (int i = 0; i < 400; ++i)
			point.strain({ 1e-3 * direction[0], 1e-3 * direction[1], 1e-3 * direction[2], 0 });
		double s[3] = { -point.sigma[0], -point.sigma[1], -point.sigma[2] };
		std::sort(s, s + 3);
		// shear stress over Mohr-Coulomb's strength
		return (s[2] - s[0]) / (2 * cohesion * std::cos(phi) + (s[2] + s[0]) * std::sin(phi));
	};
	for (const double phi : { .3, .5236, .7 })
		for (const double psi : { 0., .1, .3 }) {
			const std::array<double, 3> plane { 1, -1, 0 }, compression { .5, -1, .5 }, extension { 1, -.5, -.5 };
			const std::array<double, 3> dilating { 1 + std::sin(psi), std::sin(psi) - 1, 0 };
			EXPECT_NEAR(excess(Match::planeStrain, phi, psi, dilating), 1, 1e-6) << phi << ", " << psi;
			EXPECT_NEAR(excess(Match::compression, phi, psi, compression), 1, 1e-6) << phi << ", " << psi;
			EXPECT_NEAR(excess(Match::extension, phi, psi, extension), 1, 1e-6) << phi << ", " << psi;
			EXPECT_GT(excess(Match::compression, phi, psi, plane), 1.05);
			for (const auto& way : { plane, dilating, compression, extension })
				EXPECT_LE(excess(Match::inscribed, phi, psi, way), 1 + 1e-6) << phi << ", " << psi;
		}
	EXPECT_NEAR(excess(Match::inscribed, .5, .5, { 1 + std::sin(.5), std::sin(.5) - 1, 0 }), 1, 1e-6); // associated flow: the plane strain cone
}

} // namespace
