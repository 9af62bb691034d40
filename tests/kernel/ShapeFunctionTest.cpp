// SPDX-License-Identifier: GPL-2.0-or-later
/* The one-dimensional shape functions, for themselves.

Invariants of every spline, exact in exact arithmetic and here to 1e-13 (a handful of rounded operations on numbers of
order one; a coordinate of 1e6 cells carries 1e-10 itself, which the linear reproduction there is allowed):
  sum N = 1, sum dN = 0;  sum N x_i = x, sum dN x_i = 1;  N >= 0;  N(x) mirrored is N(-x);  dN is the derivative of N.

V4, quadrature of the internal force (theme of Steffen, Kirby & Berzins, IJNME 76 (2008) 922): points s cells apart
under uniform unit stress; the internal force at an inner node, sum over the points of s dN, should be 0. Greatest value
over the offsets of the lattice, from an independent NumPy implementation: three digits and a coarse sweep of the
offsets, hence 1 %. */
#include "kernel/transfer/ShapeFunction.hpp"
#include <algorithm>
#include <array>
#include <gtest/gtest.h>
#include <vector>

using namespace yade::mpm;

namespace {

struct Value {
	double                base;
	std::array<double, 4> N {}, dN {};
	int                   support;
	double                N_at(double node) const { return pick(N, node); }
	double                dN_at(double node) const { return pick(dN, node); }

private:
	double pick(const std::array<double, 4>& values, double node) const
	{
		const double k = node - base;
		return k >= 0 && k < support ? values[std::size_t(k)] : 0;
	}
};

template <class Shape> Value at(double xi, double r)
{
	Value v;
	v.support = Shape::support;
	v.base    = std::floor(xi - Shape::shift(r));
	Shape::evaluate(xi, v.base, r, v.N.data(), v.dN.data());
	return v;
}

/* On nodes and mid-cells, one rounding beside them, negative, far away, and a fine sweep. */
std::vector<double> coordinates()
{
	std::vector<double> xs;
	for (double node : { 0., 1., -1., 3., -7., 1e6, -1e6 })
		for (double inCell : { 0., .25, .5, .75, 1. / 3 })
			for (double off : { 0., 1e-15, -1e-15, 1e-9, -1e-9 })
				xs.push_back(node + inCell + off);
	for (int k = -400; k <= 400; ++k)
		xs.push_back(k / 97.);
	return xs;
}

template <class Shape> class ShapeFunctionTest : public ::testing::Test {
public:
	/* Sizes of the point: what GIMP looks at, the others must not. */
	static std::vector<double> halfSizes() { return { .5, .25, 1. / 6, .1, .01 }; }
};
using Shapes = ::testing::Types<LinearShape, QuadraticShape, CubicShape, GimpShape>;
TYPED_TEST_SUITE(ShapeFunctionTest, Shapes);

TYPED_TEST(ShapeFunctionTest, PartitionOfUnityAndLinearReproduction)
{
	for (double r : this->halfSizes())
		for (double xi : coordinates()) {
			const Value v   = at<TypeParam>(xi, r);
			double      one = 0, zero = 0, x = 0, slope = 0;
			for (int k = 0; k < v.support; ++k) {
				const double node = v.base + k - std::floor(xi); // from the cell, so as not to add the rounding of a far coordinate
				one += v.N[k], zero += v.dN[k], x += v.N[k] * node, slope += v.dN[k] * node;
			}
			const double far = 4e-16 * std::abs(xi) / r; // GIMP divides the coordinate's rounding by the size
			EXPECT_NEAR(one, 1, 1e-13 + far) << "xi " << xi << " r " << r;
			EXPECT_NEAR(zero, 0, 1e-13 + far) << "xi " << xi << " r " << r;
			EXPECT_NEAR(x, xi - std::floor(xi), 1e-13 + far) << "xi " << xi << " r " << r;
			EXPECT_NEAR(slope, 1, 1e-13 / r + far) << "xi " << xi << " r " << r;
		}
}

TYPED_TEST(ShapeFunctionTest, NotNegativeAndNothingOutsideItsNodes)
{
	double greatest = 0;
	for (double r : this->halfSizes())
		for (double xi : coordinates()) {
			const Value v = at<TypeParam>(xi, r);
			for (int k = 0; k < v.support; ++k) {
				EXPECT_GE(v.N[k], -1e-13 - 4e-16 * std::abs(xi) / r) << "xi " << xi;
				greatest = std::max(greatest, v.N[k]);
			}
			EXPECT_LE(v.base + v.support - 1 - xi, 2.0000001) << "xi " << xi;
		}
	EXPECT_GT(greatest, .6);
}

TYPED_TEST(ShapeFunctionTest, Symmetric)
{
	for (double r : this->halfSizes())
		for (double xi : coordinates()) {
			const double offset = xi - std::floor(xi); // about node 0
			if (std::abs(xi) > 10) continue;
			const Value plus = at<TypeParam>(offset, r), minus = at<TypeParam>(-offset, r);
			for (int node = -3; node <= 3; ++node) {
				EXPECT_NEAR(plus.N_at(node), minus.N_at(-node), 1e-13) << "xi " << offset;
				// the hat's own slope jumps at a node
				if (TypeParam::support > 2 || offset > 1e-8) {
					EXPECT_NEAR(plus.dN_at(node), -minus.dN_at(-node), 1e-13 / r) << "xi " << offset;
				}
			}
		}
}

/* Central differences: h^2/6 N''' + 1e-16/h, with N''' <= 3 and h = 1e-5: 1e-10. The knots of the functions with jumps
in the second derivative are kept away from. */
TYPED_TEST(ShapeFunctionTest, DerivativeIsThatOfTheValue)
{
	const double step     = 1e-5;
	double       greatest = 0;
	for (double r : { .5, .25, 1. / 6 })
		for (int k = 0; k < 60; ++k) {
			const double xi = -1 + (k + .4137) / 31;
			const Value  v = at<TypeParam>(xi, r), p = at<TypeParam>(xi + step, r), m = at<TypeParam>(xi - step, r);
			for (double node = v.base - 1; node <= v.base + v.support; ++node) {
				EXPECT_NEAR(v.dN_at(node), (p.N_at(node) - m.N_at(node)) / (2 * step), 1e-9) << "xi " << xi << " r " << r;
				greatest = std::max(greatest, std::abs(v.dN_at(node)));
			}
		}
	EXPECT_GT(greatest, .4);
}

TYPED_TEST(ShapeFunctionTest, SmoothWhereItShouldBe)
{
	if (TypeParam::support == 2) return; // the hat is only continuous
	for (double r : this->halfSizes())
		for (double knot : { 0., .5, 1., r, 1 - r }) {
			const Value a = at<TypeParam>(knot - 1e-12, r), b = at<TypeParam>(knot + 1e-12, r);
			for (int node = -3; node <= 4; ++node) {
				EXPECT_NEAR(a.N_at(node), b.N_at(node), 1e-11);
				EXPECT_NEAR(a.dN_at(node), b.dN_at(node), 1e-11 / r);
			}
		}
}

TEST(ShapeFunctionSizeTest, OnlyGimpLooksAtThePointsSize)
{
	EXPECT_EQ(at<CubicShape>(.3, .5).N, at<CubicShape>(.3, .1).N);
	EXPECT_EQ(at<QuadraticShape>(.3, .5).N, at<QuadraticShape>(.3, .1).N);
	EXPECT_EQ(at<LinearShape>(.3, .5).N, at<LinearShape>(.3, .1).N);
	EXPECT_NE(at<GimpShape>(.1, .5).N, at<GimpShape>(.1, .2).N);
	// a whole cell: the quadratic spline; a small one: the hat
	for (double xi : { -.3, .2, .49 })
		for (int node = -2; node <= 2; ++node) {
			EXPECT_NEAR(at<GimpShape>(xi, .5).N_at(node), at<QuadraticShape>(xi, .5).N_at(node), 1e-13);
			EXPECT_NEAR(at<GimpShape>(xi, 1e-5).N_at(node), at<LinearShape>(xi, 0).N_at(node), 1e-11);
		}
}

template <class Shape> double greatestSpuriousForce(double spacing)
{
	double greatest = 0;
	for (int k = 0; k < 4000; ++k) {
		double force = 0;
		for (int p = -12; p <= 12; ++p) {
			const double xi = (p + k / 4000.) * spacing;
			if (std::abs(xi) < 3) force += spacing * at<Shape>(xi, .5 * spacing).dN_at(0);
		}
		greatest = std::max(greatest, std::abs(force));
	}
	return greatest;
}

struct QuadratureRow {
	double spacing, linear, quadratic, cubic;
};
std::ostream& operator<<(std::ostream& out, const QuadratureRow& row) { return out << "spacing " << row.spacing; }
class QuadratureTest : public ::testing::TestWithParam<QuadratureRow> {};

TEST_P(QuadratureTest, InternalForceOfUniformStress)
{
	const QuadratureRow row = GetParam();
	EXPECT_NEAR(greatestSpuriousForce<LinearShape>(row.spacing), row.linear, .01 * row.linear + 1e-12);
	EXPECT_NEAR(greatestSpuriousForce<QuadraticShape>(row.spacing), row.quadratic, .01 * row.quadratic + 1e-12);
	EXPECT_NEAR(greatestSpuriousForce<CubicShape>(row.spacing), row.cubic, .01 * row.cubic + 1e-12);
}
INSTANTIATE_TEST_SUITE_P(V4, QuadratureTest,
	::testing::Values(QuadratureRow { .55, .550, .0546, .00367 }, QuadratureRow { .6, .600, .120, .0160 }, QuadratureRow { .7, .700, .209, .0394 },
		QuadratureRow { .45, .450, .0448, .0030 }, QuadratureRow { .3, .300, .0299, .0020 }, QuadratureRow { .5, 0, 0, 0 },
		QuadratureRow { 1. / 3, 0, 0, 0 }, QuadratureRow { .25, 0, 0, 0 }));

} // namespace
