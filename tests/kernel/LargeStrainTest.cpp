// SPDX-License-Identifier: GPL-2.0-or-later
/* The kinematics of large strain at one point: an elastic point is Hencky's, whatever its path and steps, and the back stress turns with
the polar rotation of F, so that shear stresses do not oscillate. */
#include "LawPoint.hpp"
#include <gtest/gtest.h>

using namespace yade::mpm;

namespace {

using Matrix   = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;
const Matrix I = Matrix::Identity();

Law elasticLaw(double young = 1, double poisson = .3)
{
	Law law;
	law.elastic = { young, poisson };
	return law;
}
Matrix turn(const Eigen::Vector3d& axis, double angle) { return Eigen::AngleAxisd(angle, axis.normalized()).toRotationMatrix(); }
Matrix shear(double gamma) { return (Matrix() << 1, gamma, 0, 0, 1, 0, 0, 0, 1).finished(); }

template <class S> Matrix tensor(const double* s)
{
	Matrix m = Matrix::Zero();
	for (int i = 0; i < 3; ++i)
		for (int j = 0; j < 3; ++j)
			if (const int k = componentOf<S>(i, j); k >= 0) m(i, j) = s[k];
	return m;
}
template <class S> void put(const Matrix& m, double* s)
{
	for (int i = 0; i < 3; ++i)
		for (int j = 0; j < 3; ++j)
			if (const int k = componentOf<S>(i, j); k >= 0) s[k] = m(i, j);
}
template <class S> void step(LawPoint<S>& point, const Matrix& dF)
{
	double G[S::dim * S::dim];
	for (int i = 0; i < S::dim; ++i)
		for (int j = 0; j < S::dim; ++j)
			G[i * S::dim + j] = dF(i, j) - (i == j);
	point.deform(true, G);
}
template <class S> Matrix deformation(const LawPoint<S>& point)
{
	Matrix F = I;
	for (int i = 0; i < S::dim; ++i)
		for (int j = 0; j < S::dim; ++j)
			F(i, j) = point.F[std::size_t(i * S::dim + j)];
	return F;
}
Matrix logarithm(const Matrix& b)
{
	const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(b);
	return eigen.eigenvectors() * eigen.eigenvalues().array().log().matrix().asDiagonal() * eigen.eigenvectors().transpose();
}
/* D h of the whole of a path; the normal of plane stress is left out of both. */
template <class S> Matrix hencky(const Hooke& C, const Matrix& F)
{
	const Matrix h = .5 * logarithm(F * F.transpose());
	double       e[S::N], s[S::N];
	put<S>(h, e);
	for (int k = normals<S>(); k < S::N; ++k)
		e[k] *= 2;
	S::elastic(C, e, s);
	return tensor<S>(s);
}

template <class S> class LargeStrain : public ::testing::Test {
protected:
	/* Shear along x, or in any direction in 3D. */
	const Matrix Q = S::dim == 3 ? turn({ 1, -2, .5 }, .7) : I;
	Matrix       along(const Matrix& m) const { return Q * m * Q.transpose(); }
};
using States = ::testing::Types<PlaneStress, PlaneStrain, Solid>;
TYPED_TEST_SUITE(LargeStrain, States);

/* sigma_xy/G = 2 asinh(g/2)/sqrt(1 + g^2/4), in steps of any size, with and without a law that has tensors; zero after the way back. */
TYPED_TEST(LargeStrain, ElasticShearIsHenckysAndReturnsToZero)
{
	Law yields                 = j2Law(.05);
	as<J2>(yields).yieldStress = 100 * youngModulus;
	for (const Law& law : { elasticLaw(youngModulus, poissonRatio), yields })
		for (double by : { .004, .05, .5 }) {
			LawPoint<TypeParam> point(law);
			double              gamma = 0;
			for (double to : { .5, 1., 2., 4., 5., 0. }) {
				while (std::abs(to - gamma) > 1e-9) {
					const double d = std::clamp(to - gamma, -by, by);
					step(point, this->along(shear(d))), gamma += d;
				}
				const Matrix sigma = this->Q.transpose() * tensor<TypeParam>(point.sigma) * this->Q;
				const double exact = 2 * std::asinh(.5 * to) / std::sqrt(1 + .25 * to * to);
				EXPECT_NEAR(sigma(0, 1) / law.elastic.shear, exact, 1e-11) << "shear " << to << ", steps " << by;
				EXPECT_NEAR(sigma(0, 0) / law.elastic.shear, .5 * to * exact, 1e-11);
				EXPECT_NEAR(sigma(1, 1) / law.elastic.shear, -.5 * to * exact, 1e-11);
			}
			EXPECT_LT(tensor<TypeParam>(point.sigma).norm() / law.elastic.shear, 1e-11);
		}
}

/* Stretches, shears and turns one after the other: the stress is that of F at every corner, and at F = 1 the initial stress has returned. */
TYPED_TEST(LargeStrain, ElasticStressIsAFunctionOfF)
{
	const bool          solid = TypeParam::dim == 3;
	std::vector<Matrix> ways  = { Eigen::Vector3d(1.6, .8, 1).asDiagonal() * I, shear(1.2), turn({ 0, 0, 1 }, 1.1), shear(-.7).transpose() };
	if (solid) ways.push_back(turn({ 1, 1, 0 }, .8) * Eigen::Vector3d(1, .7, 1.5).asDiagonal());
	for (double initial : { 0., .02, .3 }) {
		LawPoint<TypeParam> point(elasticLaw());
		const Matrix        sigma0 = initial * tensor<TypeParam>(std::array<double, 6> { .5, -1, .3, .2, .4, .6 }.data());
		put<TypeParam>(sigma0, point.sigma);
		auto go = [&](const Matrix& to) {
			const Matrix from = deformation(point);
			for (int k = 1; k <= 100; ++k) // along a straight line of F
				step(point, (from + .01 * k * (to - from)) * deformation(point).inverse());
		};
		Matrix F = I;
		for (const Matrix& way : ways) {
			F = way * F, go(F);
			if (initial == 0) {
				EXPECT_LT((tensor<TypeParam>(point.sigma) - hencky<TypeParam>(point.law.elastic, F)).norm(), 1e-12);
			}
		}
		EXPECT_GT((tensor<TypeParam>(point.sigma) - sigma0).norm(), .1);
		for (double part : { .5, 0. })
			go(I + part * (F - I));
		EXPECT_LT((tensor<TypeParam>(point.sigma) - sigma0).norm(), 1e-11) << initial;
	}
}

/* One step from an elastic strain of any size: every range of the series, and where they end, against eigenvalues. */
TYPED_TEST(LargeStrain, EveryRangeOfStrains)
{
	std::mt19937                     random(5);
	std::normal_distribution<double> normal;
	auto                             matrix = [&] {
                Matrix m = Matrix::Zero();
                for (int i = 0; i < TypeParam::dim; ++i)
                        for (int j = 0; j < TypeParam::dim; ++j)
                                m(i, j) = normal(random);
                return Matrix(m / m.norm());
	};
	const Law    law = elasticLaw();
	const double G   = law.elastic.shear;
	for (double size : { 0., 1e-9, 1e-4, .03, .06, .0624, .0626, .07, .2, .39, .41, .9, 1.1, 2., 3. })
		for (double change : { 0., 1e-6, .01, .03, .1, .4 }) {
			const Matrix m = matrix(), d = m + m.transpose(),
				     h0 = size / d.norm()
					  * (d - d.trace() / TypeParam::dim * (TypeParam::dim == 3 ? I : Matrix(Eigen::Vector3d(1, 1, 0).asDiagonal())));
			const Matrix                                         dF = I + change * matrix();
			const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(h0);
			const Matrix half = eigen.eigenvectors() * eigen.eigenvalues().array().exp().matrix().asDiagonal(),
				     b    = dF * half * half.transpose() * dF.transpose();
			for (bool tensors : { false, true }) {
				LawPoint<TypeParam> point(law);
				if (tensors) point.law.model = j2Law(0).model, as<J2>(point.law).yieldStress = 1e3, point.internal.resize(TypeParam::N + 1);
				put<TypeParam>(2 * G * h0, point.sigma);
				step(point, dF);
				double       e[TypeParam::N], s[TypeParam::N];
				const Matrix h = .5 * logarithm(b);
				put<TypeParam>(h, e);
				for (int k = normals<TypeParam>(); k < TypeParam::N; ++k)
					e[k] *= 2;
				TypeParam::elastic(law.elastic, e, s);
				// the digits that the eigenvalues of b have
				EXPECT_LT((tensor<TypeParam>(point.sigma) - tensor<TypeParam>(s)).norm(), 4e-15 * (1 + size) + 1e-16 * std::exp(4 * size))
					<< "strain " << size << ", change " << change << (tensors ? ", polar" : "");
			}
		}
}

/* Far beyond any material; b = F F^T has a condition of 1e12 there. */
TYPED_TEST(LargeStrain, ShearByAThousand)
{
	LawPoint<TypeParam> point(elasticLaw());
	for (int k = 0; k < 10000; ++k)
		step(point, this->along(shear(.1)));
	const Matrix sigma = this->Q.transpose() * tensor<TypeParam>(point.sigma) * this->Q;
	const double exact = 2 * std::asinh(500.) / std::sqrt(1 + 25e4) * point.law.elastic.shear;
	EXPECT_NEAR(sigma(0, 1), exact, TypeParam::dim == 3 ? 1e-4 : 1e-8);
}

TEST(LargeStrainTest, HoopStrainIsLogarithmic)
{
	LawPoint<Axisymmetric> point(elasticLaw(1, 0));
	for (int k = 0; k < 100; ++k) {
		const double r = 1 + .02 * k, G[5] = { 0, 0, 0, 0, .02 / r };
		point.deform(true, G);
	}
	EXPECT_NEAR(point.sigma[2], std::log(3), 1e-13);
	EXPECT_NEAR(point.sigma[0], 0, 1e-15);
}

/* A back stress turns with the polar rotation of F: exactly in the plane, to second order of the step in 3D. */
template <class S> double backStressError(const Matrix& velocity, double time, int steps)
{
	LawPoint<S> point(j2Law(0));
	as<J2>(point.law).yieldStress = 1e3 * youngModulus;
	const Matrix eta0             = tensor<S>(std::array<double, 6> { 3, -1, -2, 4, -5, 6 }.data());
	put<S>(eta0, point.internal.data());
	for (int k = 0; k < steps; ++k) {
		const Matrix A = .5 * time / steps * velocity;
		step(point, (I - A).inverse() * (I + A));
	}
	const Matrix                            F = deformation(point);
	const Eigen::JacobiSVD<Eigen::Matrix3d> svd(F, Eigen::ComputeFullU | Eigen::ComputeFullV);
	const Matrix                            R = svd.matrixU() * svd.matrixV().transpose();
	EXPECT_GT((R - I).norm(), .3);
	return (tensor<S>(point.internal.data()) - R * eta0 * R.transpose()).norm() / eta0.norm();
}
TEST(LargeStrainTest, BackStressTurnsByThePolarRotation)
{
	const Matrix plane = (Matrix() << .3, 1.5, 0, -.2, -.4, 0, 0, 0, 0).finished(), solid = (Matrix() << .3, .2, -.5, .1, -.4, .6, .7, -.3, .2).finished();
	for (int steps : { 10, 1000 })
		EXPECT_LT(backStressError<PlaneStrain>(plane, 2, steps), 1e-12);
	const double coarse = backStressError<Solid>(solid, 1.5, 50), fine = backStressError<Solid>(solid, 1.5, 100);
	EXPECT_LT(coarse, 3e-5);
	EXPECT_NEAR(std::log2(coarse / fine), 2, .1);
}

/* The shear stress of a material with kinematic hardening under simple shear, over sigma_y, at multiples of 0.01. */
template <class S> std::vector<double> shearCurve(const Law& law, const Matrix& Q, double by)
{
	LawPoint<S>         point(law);
	std::vector<double> stress;
	const int           every = int(std::lround(.01 / by));
	for (int k = 1; k <= 500 * every; ++k) {
		step(point, Q * shear(by) * Q.transpose());
		if (k % every == 0) stress.push_back((Q.transpose() * tensor<S>(point.sigma) * Q)(0, 1) / yieldStress);
	}
	return stress;
}
/* It rises all the way, in the plane and in any direction of 3D alike. Jaumann's rate would let it fall beyond pi/2, the logarithmic one
beyond 3. */
TEST(LargeStrainTest, HardeningRisesUpToAShearOfFive)
{
	for (const Law& law : { j2Law(.05), boucWenLaw(2, .05, 1e-4), boucWenLaw(25, .05, 1e-4) }) {
		const std::vector<double> plane = shearCurve<PlaneStrain>(law, I, .002), solid = shearCurve<Solid>(law, turn({ 1, -2, .5 }, .7), .002);
		for (std::size_t k = 1; k < plane.size(); ++k) {
			ASSERT_GT(plane[k], plane[k - 1]) << "shear " << .01 * double(k + 1);
			ASSERT_GT(solid[k], solid[k - 1]) << "shear " << .01 * double(k + 1);
			ASSERT_NEAR(solid[k], plane[k], 1e-5 * plane[k]);
		}
		std::printf("simple shear by 1, 2, 5, alpha = 0.05: shear stress %.2f, %.2f, %.2f sigma_y\n", plane[99], plane[199], plane[499]);
		const double linear = 1 / std::sqrt(3.) + hardeningModulus(youngModulus, .05) / yieldStress / 3;
		EXPECT_LT(plane[99], linear);
		EXPECT_GT(plane[99], .8 * linear);
	}
}
/* Weak hardening, where elastic strains are small: the back stress is (H/3) times the integral of Green and Naghdi's rate in simple
shear (Dienes, Acta Mech. 32 (1979) 217), with tan b = g/2:  2 cos 2b (2 b - 2 tan 2b ln cos b - tan b). */
TEST(LargeStrainTest, WeakHardeningIsDienes)
{
	for (const Law& law : { j2Law(.001), boucWenLaw(25, .001, 1e-4) }) {
		const double              H     = hardeningModulus(youngModulus, .001) / yieldStress;
		const std::vector<double> curve = shearCurve<PlaneStrain>(law, I, .002);
		for (int g = 1; g <= 5; ++g) {
			const double b = std::atan(.5 * g), back = 2 * (std::cos(2 * b) * (2 * b - std::tan(b)) - 2 * std::sin(2 * b) * std::log(std::cos(b)));
			EXPECT_NEAR(curve[std::size_t(100 * g - 1)], 1 / std::sqrt(3.) + H / 3 * back, .01 * H / 3 * back) << "shear " << g;
		}
	}
}

} // namespace
