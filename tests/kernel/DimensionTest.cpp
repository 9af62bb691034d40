// SPDX-License-Identifier: GPL-2.0-or-later
/* One problem in every analysis that can hold it: what is uniform along an axis does not depend on whether that axis is
there. A wave along one axis, large enough to be far from linear; along the others a channel of one cell between slip walls.
The transfers are products over the axes, and along the others those sums are exact, so the results agree to rounding:
1e-10 after some 100 steps of numbers of order one. */
#include "Scene.hpp"
#include <gtest/gtest.h>

using namespace yade::mpm;

namespace {

const double pi = std::acos(-1.), young = 1e5, density = 1000, h = .125;

/* A bar along `axis`, fixed at one end and free at the other, in a channel across the other axes; one in-plane axis may
carry a wave of its own. Sorted by id on return. */
Scene wave(Analysis analysis, double poisson, const std::array<int, 3>& axes, int waves, ShapeKind shape, Scheme scheme)
{
	const int             dim = dimension(analysis);
	std::array<double, 3> size { h, h, h };
	Scene                 s;
	s.laws = { Scene::elastic(young, poisson, density) };
	for (int k = 0; k < dim; ++k) {
		const int axis = axes[std::size_t(k)];
		if (k < waves) size[std::size_t(axis)] = 1;
		s.walls.push_back(Scene::wall(axis, 1, 0, Wall::Kind::slip));
		if (k > 0) s.walls.push_back(Scene::wall(axis, -1, size[std::size_t(axis)], Wall::Kind::slip));
	}
	s.addBox(dim, { 0, 0, 0 }, size, h / 2);
	for (double& m : s.points.mass) // of a unit section
		for (int k = waves; k < dim; ++k)
			m /= h;
	for (double& v : s.points.volume0)
		for (int k = waves; k < dim; ++k)
			v /= h;
	s.setVelocity([&](auto x) {
		std::array<double, 3> v {};
		for (int k = 0; k < waves; ++k) {
			const auto axis = std::size_t(axes[std::size_t(k)]);
			v[axis]         = k ? -1.1 * std::sin(pi * x[axis]) : 1.3 * std::sin(pi / 2 * x[axis]);
		}
		return v;
	});
	s.control.dt = .2 * h / 12, s.control.scheme = scheme;
	s.start(analysis, shape, h);
	s.run(120);
	return s;
}

/* What happens along the bar must be the same for all points of a section: compare by the place along the axes. */
void expectSameMotion(const Scene& reference, const std::array<int, 3>& referenceAxes, const Scene& other, const std::array<int, 3>& axes, int waves)
{
	double moved = 0;
	for (std::size_t p = 0; p < other.points.count(); ++p) {
		std::size_t nearest  = 0;
		double      distance = HUGE_VAL;
		for (std::size_t q = 0; q < reference.points.count(); ++q) {
			double d = 0;
			for (std::size_t k = 0; k < std::size_t(waves); ++k)
				d += std::abs(other.points.position[std::size_t(axes[k])][p] - reference.points.position[std::size_t(referenceAxes[k])][q]);
			if (d < distance) distance = d, nearest = q;
		}
		EXPECT_LT(distance, 1e-11);
		for (std::size_t k = 0; k < std::size_t(waves); ++k) {
			const std::size_t a = std::size_t(axes[k]), b = std::size_t(referenceAxes[k]);
			EXPECT_NEAR(other.points.velocity[a][p], reference.points.velocity[b][nearest], 1e-10);
			EXPECT_NEAR(other.points.stress[a][p], reference.points.stress[b][nearest], 1e-10 * young);
			moved = std::max(moved, std::abs(other.points.stress[a][p]));
		}
	}
	EXPECT_GT(moved, .02 * young);
}

TEST(DimensionTest, BarAlongEveryAxis)
{
	for (ShapeKind shape : allShapes)
		for (Scheme scheme : allSchemes) {
			const Scene bar = wave(Analysis::uniaxial, 0, { 0, 1, 2 }, 1, shape, scheme);
			for (Analysis analysis : { Analysis::planeStress, Analysis::planeStrain, Analysis::solid })
				for (int axis = 0; axis < dimension(analysis); ++axis) {
					SCOPED_TRACE(std::string(name(analysis)) + ' ' + name(shape) + ' ' + name(scheme) + " axis " + std::to_string(axis));
					const int                dim = dimension(analysis);
					const std::array<int, 3> axes { axis, (axis + 1) % dim, dim == 3 ? (axis + 2) % 3 : 2 };
					expectSameMotion(bar, { 0, 1, 2 }, wave(analysis, 0, axes, 1, shape, scheme), axes, 1);
				}
		}
}

/* Poisson's ratio 0.3: a wave in the plane, out of plane nothing moves and sigma_zz follows. */
TEST(DimensionTest, PlaneStrainIsASolidBetweenSlipWalls)
{
	for (ShapeKind shape : { ShapeKind::quadratic, ShapeKind::cubic }) {
		const Scene plane = wave(Analysis::planeStrain, .3, { 0, 1, 2 }, 2, shape, Scheme::musl);
		for (const std::array<int, 3>& axes : { std::array<int, 3> { 0, 1, 2 }, std::array<int, 3> { 2, 0, 1 }, std::array<int, 3> { 1, 2, 0 } }) {
			SCOPED_TRACE(std::string(name(shape)) + " across axis " + std::to_string(axes[2]));
			const Scene solid = wave(Analysis::solid, .3, axes, 2, shape, Scheme::musl);
			expectSameMotion(plane, { 0, 1, 2 }, solid, axes, 2);
			double across = 0;
			for (std::size_t p = 0; p < solid.points.count(); ++p) {
				const auto& sigma = solid.points.stress;
				// in plane strain: sigma_zz = nu (sigma_xx + sigma_yy), here to the rotation's share in the hypoelastic sum
				EXPECT_NEAR(
					sigma[std::size_t(axes[2])][p], .3 * (sigma[std::size_t(axes[0])][p] + sigma[std::size_t(axes[1])][p]), 1e-9 * young);
				across = std::max(across, std::abs(sigma[std::size_t(axes[2])][p]));
				EXPECT_NEAR(solid.points.velocity[std::size_t(axes[2])][p], 0, 1e-11);
			}
			EXPECT_GT(across, .01 * young);
		}
	}
}

} // namespace
