// SPDX-License-Identifier: GPL-2.0-or-later
// Classical plasticity by return mapping, alone, against finite elements, and as the limit of the hysteretic law.
#include "LawPoint.hpp"
#include "kernel/PointDriver.hpp"
#include <fstream>
#include <gtest/gtest.h>
#include <sstream>

using namespace yade::mpm;

namespace {

TEST(J2Law, UniaxialCycleIsBilinear)
{
	// sigma = sigma_y + E_t (eps - eps_y), then 2 sigma_y of elastic unloading: 0 -> 4 -> -4, alpha = 0.05
	for (const int steps : { 1, 7 }) {
		LawPoint<Uniaxial> point(j2Law(.05));
		point.strain({ 4 * yieldStrain }, steps);
		EXPECT_NEAR(point.sigma[0] / yieldStress, 1 + .05 * 3, 1e-13);
		EXPECT_NEAR(point.plasticStrain() / yieldStrain, 4 - 1.15, 1e-12);
		point.strain({ -8 * yieldStrain }, steps);
		EXPECT_NEAR(point.sigma[0] / yieldStress, 1.15 - 2 - .05 * 6, 1e-13);
		EXPECT_NEAR(point.f(), 1, 1e-13);
	}
}

TEST(J2Law, IsotropicHardeningReachesItsRadius)
{
	Law law               = j2Law(.05);
	as<J2>(law).isotropic = { .02 * youngModulus, .5 * yieldStress, .7 / yieldStrain };
	LawPoint<PlaneStress> plane(law);
	LawPoint<Solid>       solid(law);
	plane.strain({ 9 * yieldStrain, -2 * yieldStrain, 5 * yieldStrain });
	solid.strain({ 9 * yieldStrain, -2 * yieldStrain, 0, 3 * yieldStrain, 0, 5 * yieldStrain });
	EXPECT_NEAR(plane.f(), as<J2>(law).isotropic.radius(yieldStress, plane.plasticStrain()) / yieldStress, 1e-12);
	EXPECT_NEAR(solid.f(), as<J2>(law).isotropic.radius(yieldStress, solid.plasticStrain()) / yieldStress, 1e-12);
	EXPECT_GT(plane.f(), 1.5);
}

template <class S> void auditRandomPaths(unsigned seed)
{
	std::mt19937                           random(seed);
	std::normal_distribution<double>       normal;
	std::uniform_real_distribution<double> unit(0, 1);
	for (int path = 0; path < 200; ++path) {
		LawPoint<S> point(j2Law(path % 2 ? .1 : 0));
		for (int i = 0; i < 4; ++i) {
			std::array<double, S::N> increment;
			const double             size = std::pow(10, -4 + 5 * unit(random));
			for (double& e : increment)
				e = size * yieldStrain * normal(random);
			const double dissipation = point.response.dissipation, plastic = point.plasticStrain();
			point.strain(increment, 1 + int(1000 * size));
			ASSERT_LE(point.f(), 1 + 1e-12);
			ASSERT_GE(point.response.dissipation, dissipation);
			ASSERT_GE(point.plasticStrain(), plastic);
			// backward Euler in steps of 0.001 yield strains is of first order
			ASSERT_NEAR((point.work - point.energy() - point.response.dissipation) / (yieldStress * yieldStrain), 0, 1e-2);
		}
	}
}
TEST(J2Law, YieldDissipationAndWorkOnRandomPaths)
{
	auditRandomPaths<Uniaxial>(1);
	auditRandomPaths<PlaneStress>(2);
	auditRandomPaths<PlaneStrain>(3);
	auditRandomPaths<Solid>(4);
}

TEST(J2Law, PlaneStressIsTheSolidWithItsFreeStrain)
{
	std::vector<double> path;
	for (int i = 0; i <= 4000; ++i) {
		const double t = i / 1000., x = (t < 1 ? 3 * t : 3 - 2 * (t - 1)) * yieldStrain, y = .8 * std::sin(t) * yieldStrain;
		path.insert(path.end(), { x, y, 0, y, -.4 * x, 0, 0, 0, 0 });
	}
	const Law          law   = j2Law(.05);
	const PointHistory plane = drivePoint(law, path, { false, false, true }), solid = drivePoint(law, plane.strain);
	double             worst = 0;
	for (std::size_t k = 0; k < plane.stress.size(); ++k)
		worst = std::max(worst, std::abs(plane.stress[k] - solid.stress[k]) / yieldStress);
	EXPECT_LT(worst, 2e-3);
	EXPECT_NEAR(plane.plasticStrain.back() / solid.plasticStrain.back(), 1, 2e-3);
	EXPECT_GT(plane.plasticStrain.back(), yieldStrain);
}

/* Rows of a file of tests/data, without its header. */
std::vector<std::vector<double>> readData(const std::string& name)
{
	std::ifstream                    file(MPM_TEST_DATA "/" + name);
	std::string                      line, cell;
	std::vector<std::vector<double>> rows;
	std::getline(file, line);
	while (std::getline(file, line)) {
		std::istringstream cells(line);
		for (rows.emplace_back(); std::getline(cells, cell, ',');)
			rows.back().push_back(std::stod(cell));
	}
	return rows;
}

struct Difference {
	double stress = 0, transverseStrain = 0, plasticStrain = 0; // greatest, over sigma_y and yield strains
};
Difference fromFiniteElements(const std::string& file, const Law& law)
{
	// columns: t_branch, eps_xx, eps_yy, gamma_xy, sig_xx, sig_xy, peeq; 160 straight steps between rows, as the elements took on the square
	constexpr int       steps = 160;
	const auto          rows  = readData(file);
	std::vector<double> path;
	for (std::size_t i = 0; i + 1 < rows.size(); ++i)
		for (int k = 0; k < (i + 2 == rows.size() ? steps + 1 : steps); ++k) {
			const double xx = rows[i][1] + double(k) / steps * (rows[i + 1][1] - rows[i][1]),
				     xy = .5 * (rows[i][3] + double(k) / steps * (rows[i + 1][3] - rows[i][3]));
			path.insert(path.end(), { xx, xy, 0, xy, 0, 0, 0, 0, 0 });
		}
	const PointHistory point = drivePoint(law, path, { false, true, true });
	Difference         worst;
	for (std::size_t i = 0; i < rows.size(); ++i) {
		const std::size_t at   = steps * i;
		worst.stress           = std::max({ worst.stress, std::abs(point.stress[9 * at] - rows[i][4]) / yieldStress,
				  std::abs(point.stress[9 * at + 1] - rows[i][5]) / yieldStress });
		worst.transverseStrain = std::max(worst.transverseStrain, std::abs(point.strain[9 * at + 4] - rows[i][2]) / yieldStrain);
		worst.plasticStrain    = std::max(worst.plasticStrain, std::abs(point.plasticStrain[at] - rows[i][6]) / yieldStrain);
	}
	std::printf("%s: %.2e sigma_y, transverse strain %.2e, plastic strain %.2e yield strains\n", file.c_str(), worst.stress, worst.transverseStrain,
		worst.plasticStrain);
	EXPECT_GT(point.plasticStrain.back(), 10 * yieldStrain);
	return worst;
}

TEST(J2Law, UniaxialCycleOfAFiniteElement)
{
	const Difference d = fromFiniteElements("mp_uniaxial_cyclic_kin.csv", j2Law(.05));
	EXPECT_LT(d.stress, 1e-4);
	EXPECT_LT(d.transverseStrain, 1e-4);
	EXPECT_LT(d.plasticStrain, 1e-4);
}
TEST(J2Law, NonProportionalSquareOfAFiniteElement)
{
	const Difference d = fromFiniteElements("mp_square_syy0_kin.csv", j2Law(.05));
	EXPECT_LT(d.stress, 1e-4);
	EXPECT_LT(d.transverseStrain, 1e-4);
	EXPECT_LT(d.plasticStrain, 1e-4);
}
TEST(J2Law, SharpHystereticLawFollowsTheFiniteElement) { EXPECT_LT(fromFiniteElements("mp_square_syy0_kin.csv", boucWenLaw(200, .05, 1e-5)).stress, .01); }

TEST(LongJ2Law, HystereticLawTendsToItLikeLn2OverN)
{
	// a non-proportional path in plane stress: square in (eps_xx, gamma_xy/sqrt 3) of 3 yield strains
	constexpr int steps = 20000;
	double        last  = 0;
	for (const double n : { 5., 10., 20., 40., 80. }) {
		LawPoint<PlaneStress> sharp(j2Law(.05)), smooth(boucWenLaw(n, .05, 1e-7));
		double                worst = 0;
		const double          e = 3 * yieldStrain / steps, g = std::sqrt(3.) * e;
		for (const auto& [x, y] : { std::pair { e, 0. }, { 0., g }, { -e, 0. }, { 0., -g } })
			for (int i = 0; i < steps; ++i) {
				sharp.strain({ x, 0, y }), smooth.strain({ x, 0, y });
				double d[3];
				for (int k = 0; k < 3; ++k)
					d[k] = (sharp.sigma[k] - smooth.sigma[k]) / yieldStress;
				worst = std::max(worst, std::sqrt(PlaneStress::mises2(d)));
			}
		std::printf("n = %g: n error = %.4f\n", n, n * worst);
		EXPECT_GT(n * worst, last);
		EXPECT_LT(n * worst, std::log(2.));
		last = n * worst;
	}
	EXPECT_GT(last, .6);
}

} // namespace
