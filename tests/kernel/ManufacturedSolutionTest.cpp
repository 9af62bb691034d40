// SPDX-License-Identifier: GPL-2.0-or-later
/* Order of accuracy in large deformation, by the manufactured solutions of Manufactured.hpp.

Where a row is asserted to 2 % it is another program's (published, or an independent NumPy implementation's), which
sums strains by forward Euler; the kernel takes them at mid-step, so that they differ by the error of that sum. The rows
to 0.5 % are this kernel's own, and do not change by more when the step is cut further: they guard against change. */
#include "Manufactured.hpp"
#include <gtest/gtest.h>

using namespace yade::mpm;

namespace {

void expectRow(const std::vector<double>& computed, const std::vector<double>& expected, double tolerance)
{
	ASSERT_EQ(computed.size(), expected.size());
	for (std::size_t k = 0; k < computed.size(); ++k)
		EXPECT_NEAR(computed[k], expected[k], tolerance * expected[k]) << "level " << k;
}
double                 lastOrder(const std::vector<double>& errors) { return std::log2(errors[errors.size() - 2] / errors.back()); }
const std::vector<int> bar { 4, 8, 16, 32, 64, 128 };

Manufactured V1(ShapeKind shape, double amplitude, Scheme scheme = Scheme::musl)
{
	Manufactured m { Analysis::uniaxial, shape, amplitude, 0 };
	m.scheme = scheme;
	return m;
}

TEST(ManufacturedBarTest, LinearSmallAmplitude)
{
	// published to 6 digits; at this amplitude neo-Hookean and hypoelastic bars are the same to 1e-4
	expectRow(V1(ShapeKind::linear, 1e-4, Scheme::usl).errors(bar), { 3.11462e-5, 8.91691e-6, 2.27846e-6, 5.72048e-7, 1.43153e-7, 3.58410e-8 }, 2e-3);
	// computed
	const auto errors = V1(ShapeKind::linear, 1e-4).errors(bar);
	expectRow(errors, { 3.31745e-5, 8.99920e-6, 2.28172e-6, 5.72197e-7, 1.43168e-7, 3.58112e-8 }, 1e-3);
	EXPECT_GT(lastOrder(errors), 1.98);
}

TEST(ManufacturedBarTest, LinearLargeAmplitudeDivergesByCellCrossing)
{
	// computed, coarse levels; from where points cross cells the errors grow, for everyone
	const auto errors = V1(ShapeKind::linear, .05).errors(bar);
	EXPECT_NEAR(errors[0], 1.7428e-2, .02 * 1.7428e-2);
	EXPECT_NEAR(errors[1], 8.1730e-3, .02 * 8.1730e-3);
	EXPECT_GT(errors.back(), 3 * errors[2]) << "it is this that splines are for";
}

TEST(ManufacturedBarTest, CubicSmallAmplitude)
{
	const auto errors = V1(ShapeKind::cubic, 1e-4).errors(bar);
	expectRow(errors, { 6.6601e-5, 2.1859e-5, 5.6425e-6, 1.4181e-6, 3.5493e-7, 8.8758e-8 }, 1e-3); // computed
	EXPECT_GT(lastOrder(errors), 1.98);
}

TEST(ManufacturedBarTest, CubicLargeAmplitude)
{
	const auto errors = V1(ShapeKind::cubic, .05).errors(bar);
	expectRow(errors, { 3.4047e-2, 1.1332e-2, 2.8866e-3, 7.2258e-4, 1.8102e-4, 4.5990e-5 }, .005); // own
	for (std::size_t k = 2; k < errors.size(); ++k)
		EXPECT_GT(std::log2(errors[k - 1] / errors[k]), 1.95) << "order at level " << k;
	// of another program with forward Euler's strains, down to where the error of those begins to help it
	const std::vector<double> coarse { errors[0], errors[1], errors[2], errors[3] };
	expectRow(coarse, { 3.397e-2, 1.128e-2, 2.857e-3, 7.080e-4 }, .025);
}

TEST(ManufacturedBarTest, CubicIsConvergedInTime)
{
	Manufactured fine   = V1(ShapeKind::cubic, .05);
	const double coarse = fine.error(32);
	fine.courant        = .02;
	EXPECT_NEAR(coarse, fine.error(32), .004 * coarse);
}

TEST(ManufacturedBarTest, QuadraticAndGimpLargeAmplitude)
{
	// second order down to where the points' own spacing stops it: sums over a stretched lattice (V4)
	const std::vector<int> levels { 4, 8, 16, 32 };
	const auto             quadratic = V1(ShapeKind::quadratic, .05).errors(levels);
	expectRow(quadratic, { 2.9606e-2, 8.5852e-3, 2.2247e-3, 5.6082e-4 }, .005); // computed
	EXPECT_GT(lastOrder(quadratic), 1.95);
	const auto gimp = V1(ShapeKind::gimp, .05).errors(levels);
	expectRow(gimp, { 2.14517e-2, 6.40048e-3, 1.66207e-3, 4.60573e-4 }, .005); // own
	EXPECT_GT(lastOrder(gimp), 1.8);
}

/* USF takes the strain of a step before its force, so that a force given at the start of the step is late: first order. */
TEST(ManufacturedBarTest, SchemesAgreeOnCoarseGrids)
{
	const double musl = V1(ShapeKind::cubic, .05).error(16);
	EXPECT_NEAR(V1(ShapeKind::cubic, .05, Scheme::usl).error(16), musl, .02 * musl);
	EXPECT_NEAR(V1(ShapeKind::cubic, .05, Scheme::usf).error(16), musl, .1 * musl);
}

const std::vector<int> square { 4, 8, 16, 32 };

TEST(ManufacturedPlaneTest, SmallAmplitude)
{
	Manufactured m { Analysis::planeStress, ShapeKind::linear, 1e-4 };
	expectRow(m.errors({ 4, 8, 16 }), { 4.6374e-5, 1.2161e-5, 3.0539e-6 }, 1e-3); // computed
	m.shape = ShapeKind::cubic;
	expectRow(m.errors({ 4, 8, 16 }), { 1.0040e-4, 3.0662e-5, 7.7388e-6 }, 1e-3); // computed
}

TEST(LongManufacturedPlaneTest, SmallAmplitudeFineGrid)
{
	Manufactured m { Analysis::planeStress, ShapeKind::linear, 1e-4 };
	EXPECT_NEAR(m.error(32), 7.6401e-7, 1e-3 * 7.6401e-7); // computed
	m.shape = ShapeKind::cubic;
	EXPECT_NEAR(m.error(32), 1.9331e-6, 1e-3 * 1.9331e-6); // computed
}

TEST(ManufacturedPlaneTest, CubicLargeAmplitudeCoarse)
{
	const auto errors = Manufactured { Analysis::planeStress, ShapeKind::cubic, .05 }.errors({ 4, 8, 16 });
	expectRow(errors, { 5.1567e-2, 1.5780e-2, 3.9236e-3 }, .005); // own
	expectRow(errors, { 5.1450e-2, 1.5697e-2, 3.8817e-3 }, .02);  // computed, forward Euler
	EXPECT_GT(lastOrder(errors), 1.95);
}

TEST(LongManufacturedPlaneTest, CubicLargeAmplitude)
{
	Manufactured m { Analysis::planeStress, ShapeKind::cubic, .05 };
	const auto   four = m.errors({ 16, 32 });
	EXPECT_NEAR(four[1], 9.7744e-4, .005 * 9.7744e-4); // own
	EXPECT_GT(lastOrder(four), 1.95);
	m.pointsPerCell = 3; // more points a cell change nothing: the error is the grid's
	const auto nine = m.errors({ 4, 8, 16 });
	expectRow(nine, { 5.1574e-2, 1.5776e-2, 3.9226e-3 }, .005); // own
	m.pointsPerCell = 2, m.shape = ShapeKind::quadratic;
	expectRow(m.errors({ 4, 8, 16 }), { 4.3651e-2, 1.1768e-2, 3.0127e-3 }, .02); // computed, forward Euler
}

TEST(LongManufacturedPlaneTest, CubicWithThinning)
{
	Manufactured m { Analysis::planeStress, ShapeKind::cubic, .05 };
	m.thinning        = true;
	const auto errors = m.errors(square);
	expectRow(errors, { 5.1534e-2, 1.5650e-2, 3.8659e-3, 9.6255e-4 }, .005); // own
	EXPECT_GT(lastOrder(errors), 1.95);
}

TEST(ManufacturedPlaneTest, PlaneStrainIsOfSecondOrder)
{
	Manufactured m { Analysis::planeStrain, ShapeKind::cubic, .05 };
	m.periods         = .25;
	const auto errors = m.errors(square);
	expectRow(errors, { 5.77247e-3, 1.40546e-3, 3.43890e-4, 8.51519e-5 }, .005); // own
	EXPECT_GT(lastOrder(errors), 1.95);
}

TEST(LongManufacturedSolidTest, IsOfSecondOrder)
{
	Manufactured m { Analysis::solid, ShapeKind::cubic, .05 };
	m.periods         = .25;
	const auto errors = m.errors({ 4, 8, 16 });
	expectRow(errors, { 7.09208e-3, 1.72792e-3, 4.22777e-4 }, .005); // own
	EXPECT_GT(lastOrder(errors), 1.95);
}

/* dt = 0.2 h/c throughout; the corner in time where unloading begins costs the stress part of its order. */
TEST(ManufacturedHystereticBarTest, CubicIsOfSecondOrder)
{
	HystereticBar       bar { ShapeKind::cubic };
	std::vector<double> errors, stresses;
	for (int cells : { 8, 16, 32, 64 })
		errors.push_back(bar.error(cells)), stresses.push_back(bar.stressError);
	expectRow(errors, { 9.70e-4, 2.34e-4, 5.81e-5, 1.46e-5 }, .02); // own
	EXPECT_GT(lastOrder(errors), 1.95);
	EXPECT_LT(stresses.back(), 1e-3);
	EXPECT_GT(std::log2(stresses[0] / stresses[2]), 3.6);
}

/* At three yield strains the tangent is a twentieth of the elastic one, and the noise of points that cross cells weighs twenty times as
much: cubic splines still converge. */
TEST(ManufacturedHystereticBarTest, FarBeyondTheKnee)
{
	HystereticBar bar { ShapeKind::cubic };
	bar.yieldStress = bar.young / 50;
	std::vector<double> errors;
	for (int cells : { 8, 16, 32, 64 })
		errors.push_back(bar.error(cells));
	expectRow(errors, { 7.17e-4, 1.82e-4, 4.68e-5, 1.42e-5 }, .05); // own
}

} // namespace
