// SPDX-License-Identifier: GPL-2.0-or-later
/* Objectivity: rotations make no strain and turn stress and back stress with the material.

For G = R - I with a rotation R by less than pi, the strain increment is zero and the rotation is R itself, both exactly, whatever the
size of the step. So after any number of steps of a full turn a stress comes back, to the rounding of that number of steps. */
#include "LawPoint.hpp"
#include "Scene.hpp"
#include <gtest/gtest.h>

using namespace yade::mpm;

namespace {

const double pi = std::acos(-1.);
using Matrix    = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;

Matrix rotation(const Eigen::Vector3d& axis, double angle) { return Eigen::AngleAxisd(angle, axis.normalized()).toRotationMatrix(); }

/* G = R - I in the analysis' own dimension. */
template <class S> std::array<double, S::dim * S::dim> gradient(const Matrix& R)
{
	std::array<double, S::dim * S::dim> G;
	for (int i = 0; i < S::dim; ++i)
		for (int j = 0; j < S::dim; ++j)
			G[std::size_t(i * S::dim + j)] = R(i, j) - (i == j);
	return G;
}
template <class S> Matrix tensor(const double* s);
template <> Matrix        tensor<PlaneStress>(const double* s) { return (Matrix() << s[0], s[2], 0, s[2], s[1], 0, 0, 0, 0).finished(); }
template <> Matrix        tensor<PlaneStrain>(const double* s) { return (Matrix() << s[0], s[3], 0, s[3], s[1], 0, 0, 0, s[2]).finished(); }
template <> Matrix        tensor<Solid>(const double* s) { return (Matrix() << s[0], s[5], s[4], s[5], s[1], s[3], s[4], s[3], s[2]).finished(); }

template <class S> class RotationTest : public ::testing::Test {
};
using States = ::testing::Types<PlaneStress, PlaneStrain, Solid>;
TYPED_TEST_SUITE(RotationTest, States);

TYPED_TEST(RotationTest, OfAnySizeMakesNoStrainAndTurnsTheStress)
{
	const double sigma[6] = { 3, -1, .5, .7, -.4, 1.1 };
	for (bool tensors : { false, true })
		for (double angle : { 1e-9, 1e-3, .1, -.5, 1., 2., 3. }) {
			const Eigen::Vector3d axis = TypeParam::dim == 2 ? Eigen::Vector3d(0, 0, 1) : Eigen::Vector3d(1, -2, .5);
			const Matrix          R    = rotation(axis, angle);
			LawPoint<TypeParam>   point(tensors ? j2Law(0) : Scene::elastic(youngModulus, poissonRatio, 7850));
			std::copy(sigma, sigma + TypeParam::N, point.sigma);
			double strain[TypeParam::N];
			strainIncrement<TypeParam>(point.law, true, gradient<TypeParam>(R).data(), point.F.data(), point.sigma, point.internal.data(), strain);
			for (int k = 0; k < TypeParam::N; ++k)
				EXPECT_NEAR(strain[k], 0, 1e-14) << "angle " << angle;
			const Matrix expected = R * tensor<TypeParam>(sigma) * R.transpose();
			EXPECT_LT((tensor<TypeParam>(point.sigma) - expected).norm(), 1e-12) << "angle " << angle;
			if (angle > .05) {
				EXPECT_GT((expected - tensor<TypeParam>(sigma)).norm(), .1) << "the rotation changes nothing";
			}
			// the small-strain increment takes the same motion for a strain
			strainIncrement<TypeParam>(point.law, false, gradient<TypeParam>(R).data(), point.F.data(), point.sigma, point.internal.data(), strain);
			EXPECT_NEAR(strain[0] + strain[1], R(0, 0) + R(1, 1) - 2, 1e-14);
		}
}

TYPED_TEST(RotationTest, FullTurnBringsStressAndBackStressBack)
{
	for (int steps : { 7, 100, 10000 }) {
		const Eigen::Vector3d axis      = TypeParam::dim == 2 ? Eigen::Vector3d(0, 0, 1) : Eigen::Vector3d(1, -2, .5);
		const double          sigma0[6] = { 300, -100, 50, 70, -40, 110 }, eta0[6] = { 20, -10, -10, 3, 4, -7 };
		LawPoint<TypeParam>   point(Scene::boucWen(1e5, .3, 1000, 500, 2, .05));
		std::copy(sigma0, sigma0 + TypeParam::N, point.sigma), std::copy(eta0, eta0 + TypeParam::N, point.internal.begin());
		double furthest = 0;
		for (int k = 0; k < steps; ++k) {
			point.deform(true, gradient<TypeParam>(rotation(axis, 2 * pi / steps)).data());
			furthest = std::max(furthest, std::abs(point.sigma[0] - sigma0[0]));
		}
		EXPECT_GT(furthest, 50) << "the stress has not turned";
		const double tolerance = 1e-10 * 300 + 2e-16 * 1e5 * steps; // the second: Young's modulus times the rounding of R - I
		for (int k = 0; k < TypeParam::N; ++k) {
			EXPECT_NEAR(point.sigma[k], sigma0[k], tolerance) << steps << " steps";
			EXPECT_NEAR(point.internal[std::size_t(k)], eta0[k], tolerance) << steps << " steps";
		}
		EXPECT_NEAR(point.plasticStrain(), 0, 1e-12) << "rotation has made plastic strain";
		for (int k = 0; k < TypeParam::dim * TypeParam::dim; ++k)
			EXPECT_NEAR(point.F[std::size_t(k)], k % (TypeParam::dim + 1) == 0, 1e-10) << steps << " steps";
	}
}

/* The same through the transfers: a lattice along the grid, velocities prescribed so that a step is R x. Nodal velocities
are linear in x where a node has its full surroundings; the points there must turn their stress and F = R, and gain none. */
template <class S> void turnedOnTheGrid(Analysis analysis, const Eigen::Vector3d& axis)
{
	for (ShapeKind shape : allShapes)
		for (Scheme scheme : allSchemes) {
			if (S::dim == 3 && scheme == Scheme::usl) continue; // time
			SCOPED_TRACE(std::string(name(shape)) + ' ' + name(scheme));
			const double angle = .3, dt = 1e-3, h = .25;
			const Matrix R = rotation(axis, angle);
			Scene        s;
			s.laws           = { Scene::boucWen(1e5, .3, 1000, 500, 2, .05) };
			s.control.dt     = dt;
			s.control.scheme = scheme;
			s.addBox(S::dim, { -1, -1, -1 }, { 1, 1, 1 }, h / 2);
			s.setVelocity([&](auto x) {
				const Eigen::Vector3d v = (R - Matrix::Identity()) * Eigen::Vector3d(x[0], x[1], x[2]) / dt;
				return std::array<double, 3> { v[0], v[1], v[2] };
			});
			s.points.prescribedDofs.assign(s.points.count(), 7);
			s.start(analysis, shape, h);
			const double sigma0[6] = { 300, -100, 50, 70, -40, 110 }, eta0[6] = { 20, -10, -10, 3, 4, -7 };
			for (std::size_t k = 0; k < std::size_t(S::N); ++k)
				s.points.stress[k].assign(s.points.count(), sigma0[k]), s.points.internal[k].assign(s.points.count(), eta0[k]);
			const Columns X = s.points.position;
			s.run(1);
			const Matrix turned = R * tensor<S>(sigma0) * R.transpose(), turnedBack = R * tensor<S>(eta0) * R.transpose();
			int          inner = 0;
			for (std::size_t p = 0; p < s.points.count(); ++p) {
				const std::size_t     id = std::size_t(s.points.id[p]);
				const Eigen::Vector3d x(X[0][id], X[1][id], S::dim == 3 ? X[2][id] : 0);
				for (int d = 0; d < S::dim; ++d) // all points go where they have been told
					EXPECT_NEAR(s.points.position[std::size_t(d)][p], (R * x)[d], 1e-13);
				if (x.cwiseAbs().maxCoeff() > 1 - 3 * h) continue;
				++inner;
				double sigma[6] {}, eta[6] {};
				for (std::size_t k = 0; k < std::size_t(S::N); ++k)
					sigma[k] = s.points.stress[k][p], eta[k] = s.points.internal[k][p];
				EXPECT_LT((tensor<S>(sigma) - turned).norm(), 1e-10 * 1e5 * angle);
				EXPECT_LT((tensor<S>(eta) - turnedBack).norm(), 1e-10 * 300);
				for (int i = 0; i < S::dim; ++i)
					for (int j = 0; j < S::dim; ++j)
						EXPECT_NEAR(s.points.deformation[std::size_t(i * S::dim + j)][p], R(i, j), 1e-12);
			}
			EXPECT_GE(inner, 4);
		}
}
TEST(RotationOnTheGridTest, PlaneStress) { turnedOnTheGrid<PlaneStress>(Analysis::planeStress, { 0, 0, 1 }); }
TEST(RotationOnTheGridTest, PlaneStrain) { turnedOnTheGrid<PlaneStrain>(Analysis::planeStrain, { 0, 0, -1 }); }
TEST(RotationOnTheGridTest, Solid) { turnedOnTheGrid<Solid>(Analysis::solid, { 1, -2, .5 }); }

} // namespace
