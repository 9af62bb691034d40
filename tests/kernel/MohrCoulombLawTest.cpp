// SPDX-License-Identifier: GPL-2.0-or-later
// Mohr-Coulomb's law at one point: the complementarity problem of its planes, corners, apex, tension, free normals, energy.
#include "LawPoint.hpp"
#include "kernel/PointDriver.hpp"
#include <Eigen/Dense>
#include <algorithm>
#include <gtest/gtest.h>
#include <limits>

using namespace yade::mpm;

namespace {

constexpr double cohesion = 20e3, friction = .5, dilatancy = .2, soilModulus = 50e6, soilPoisson = .25;
constexpr double none = std::numeric_limits<double>::infinity();

Law soil(double c = cohesion, double phi = friction, double psi = dilatancy, double cutoff = none, double poisson = soilPoisson)
{
	MohrCoulomb model;
	model.cohesion = c, model.internalFriction = phi, model.dilatancy = psi, model.tensionCutoff = cutoff;
	Law law;
	law.model = model, law.elastic = { soilModulus, poisson };
	return law;
}
Eigen::Matrix3d principalStiffness(const Hooke& C) { return 2 * C.shear * Eigen::Matrix3d::Identity() + C.lame * Eigen::Matrix3d::Ones(); }

/* Planes in principal space, in any order of the axes: normal . s <= strength, with the direction of flow. */
struct Plane {
	Eigen::Vector3d normal, flow;
	double          strength;
};
std::vector<Plane> planes(const MohrCoulomb& p)
{
	const double       f = std::sin(p.internalFriction), g = std::sin(p.dilatancy);
	std::vector<Plane> all;
	for (int i = 0; i < 3; ++i)
		for (int j = 0; j < 3; ++j) {
			if (i == j) continue;
			Plane face { Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(), 2 * p.cohesion * std::cos(p.internalFriction) };
			face.normal[i] = 1 + f, face.normal[j] = f - 1, face.flow[i] = 1 + g, face.flow[j] = g - 1;
			all.push_back(face);
		}
	for (int i = 0; i < 3 && std::isfinite(p.tensionCutoff); ++i)
		all.push_back({ Eigen::Vector3d::Unit(i), Eigen::Vector3d::Unit(i), p.tensionCutoff });
	return all;
}
/* The end of the step from a trial stress, by trying every set of up to three active planes: s = trial - D sum m_k flow_k, m >= 0, no
plane violated (Kuhn and Tucker). Without dilatancy no sum reaches the apex, which then is the answer where no set is. */
Eigen::Vector3d reference(const Law& law, const Eigen::Vector3d& trial)
{
	const auto            all = planes(as<MohrCoulomb>(law));
	const Eigen::Matrix3d D   = principalStiffness(law.elastic);
	const int             n   = int(all.size());
	Eigen::Vector3d       best;
	double                least   = HUGE_VAL;
	const auto            attempt = [&](const std::vector<int>& active) {
                const int       m = int(active.size());
                Eigen::MatrixXd N(3, m), R(3, m);
                Eigen::VectorXd F(m);
                for (int k = 0; k < m; ++k) {
                        const Plane& plane = all[std::size_t(active[std::size_t(k)])];
                        N.col(k) = plane.normal, R.col(k) = plane.flow, F[k] = plane.normal.dot(trial) - plane.strength;
                }
                Eigen::Vector3d s     = trial;
                double          fault = 0; // the greatest violation, as a stress
                if (m > 0) {
                        const Eigen::FullPivLU<Eigen::MatrixXd> A(N.transpose() * D * R);
                        if (A.rank() < m) return;
                        const Eigen::VectorXd multiplier = A.solve(F);
                        s -= D * R * multiplier;
                        fault = std::max(0., -multiplier.minCoeff() * D(0, 0));
                }
                for (const Plane& plane : all)
                        fault = std::max(fault, plane.normal.dot(s) - plane.strength);
                if (fault < least) least = fault, best = s;
	};
	attempt({});
	for (int i = 0; i < n; ++i) {
		attempt({ i });
		for (int j = 0; j < i; ++j) {
			attempt({ i, j });
			for (int k = 0; k < j; ++k)
				attempt({ i, j, k });
		}
	}
	const double size = trial.norm() + as<MohrCoulomb>(law).cohesion;
	if (least > 1e-10 * size) return Eigen::Vector3d::Constant(as<MohrCoulomb>(law).apex());
	return best;
}

/* Strain of a trial stress with these principal values, in axes turned by Q. */
template <class S> std::array<double, S::N> strainOf(const Law& law, const Eigen::Vector3d& trial, const Eigen::Matrix3d& Q)
{
	const Eigen::Vector3d    e      = principalStiffness(law.elastic).inverse() * trial;
	const Eigen::Matrix3d    strain = Q * e.asDiagonal() * Q.transpose();
	std::array<double, S::N> components;
	const int                row[] = { 0, 1, 2, 1, 0, 0 }, column[] = { 0, 1, 2, 2, 2, 1 };
	for (int k = 0; k < S::N; ++k) {
		const int c                = S::voigtIndex[k];
		components[std::size_t(k)] = (c < 3 ? 1 : 2) * strain(row[c], column[c]);
	}
	return components;
}
template <class S> Eigen::Matrix3d tensor(const double* s)
{
	Eigen::Matrix3d full  = Eigen::Matrix3d::Zero();
	const int       row[] = { 0, 1, 2, 1, 0, 0 }, column[] = { 0, 1, 2, 2, 2, 1 };
	for (int k = 0; k < S::N; ++k)
		full(row[S::voigtIndex[k]], column[S::voigtIndex[k]]) = full(column[S::voigtIndex[k]], row[S::voigtIndex[k]]) = s[k];
	return full;
}
template <class S> Eigen::Matrix3d randomAxes(std::mt19937& random)
{
	std::normal_distribution<double> normal;
	if (S::N == 6) return Eigen::Quaterniond(normal(random), normal(random), normal(random), normal(random)).normalized().toRotationMatrix();
	return Eigen::AngleAxisd(normal(random), Eigen::Vector3d::UnitZ()).toRotationMatrix();
}

template <class S> void returns(unsigned seed)
{
	std::mt19937                           random(seed);
	std::normal_distribution<double>       normal;
	std::uniform_real_distribution<double> unit(0, 1);
	double                                 worst   = 0;
	int                                    flowing = 0, apexes = 0, corners = 0, opening = 0;
	for (int trial = 0; trial < 3000; ++trial) {
		const double phi = trial % 7 ? 1.2 * unit(random) : 0, psi = trial % 3 ? phi * unit(random) : trial % 2 ? phi : 0;
		const double apex   = phi > 0 ? cohesion / std::tan(phi) : none;
		const double cutoff = trial % 2 ? none : trial % 5 ? std::min(apex, 3 * cohesion) * unit(random) : 0;
		const Law    law    = soil(cohesion, phi, psi, cutoff, trial % 4 ? .45 * unit(random) : -.5);
		ASSERT_EQ(validate(law), "");
		Eigen::Vector3d x;
		const double    size = cohesion * std::pow(10, -1 + 3 * unit(random));
		for (int k = 0; k < 3; ++k)
			x[k] = size * normal(random) + (trial % 11 ? 0 : size);
		if (trial % 8 == 1) x[1] = x[0]; // corners
		if (trial % 8 == 2) x[2] = x[1];
		if (trial % 8 == 3) x[2] = x[0] * (1 + 1e-9 * normal(random)); // nearly
		if (trial % 8 == 4) x[1] = x[0] * (1 + 1e-14 * normal(random));
		if (trial % 64 == 5) x[1] = x[2] = x[0];
		const Eigen::Matrix3d Q = trial % 16 ? randomAxes<S>(random) : Eigen::Matrix3d::Identity();
		LawPoint<S>           point(law);
		point.strain(strainOf<S>(law, x, Q));
		const Eigen::Vector3d s     = reference(law, x);
		const double          error = (tensor<S>(point.sigma) - Q * s.asDiagonal() * Q.transpose()).norm() / (x.norm() + cohesion);
		worst                       = std::max(worst, error);
		ASSERT_LT(error, 2e-12) << "trial " << trial << ": " << x.transpose() << " should return to " << s.transpose();
		// plastic strain, its equivalent, and its work
		const Eigen::Vector3d e = principalStiffness(law.elastic).inverse() * (x - s), deviator = e.array() - e.mean();
		ASSERT_NEAR(point.plasticStrain(), std::sqrt(2. / 3) * deviator.norm(), 1e-11 * (x.norm() + cohesion) / soilModulus);
		ASSERT_NEAR(point.response.dissipation, s.dot(e), 1e-11 * std::pow(x.norm() + cohesion, 2) / soilModulus);
		ASSERT_GE(point.response.dissipation, -1e-12 * std::pow(x.norm() + cohesion, 2) / soilModulus);
		const double same = 1e-9 * size;
		flowing += e.norm() > 1e-9 * x.norm() / soilModulus;
		apexes += std::abs(s[0] - apex) < same && std::abs(s[1] - apex) < same && std::abs(s[2] - apex) < same;
		corners += e.norm() > 1e-9 * x.norm() / soilModulus
			   && (std::abs(s[0] - s[1]) < same || std::abs(s[1] - s[2]) < same || std::abs(s[0] - s[2]) < same);
		opening += s.maxCoeff() > cutoff - same;
	}
	EXPECT_GT(flowing, 1000);
	EXPECT_GT(apexes, 50);
	EXPECT_GT(corners, 500);
	EXPECT_GT(opening, 300);
	std::printf("greatest difference %.1e of the trial stress\n", worst);
}
TEST(MohrCoulombLaw, ReturnSolvesTheComplementarityProblem)
{
	returns<Solid>(1);
	returns<PlaneStrain>(2);
}

/* At the six corners, whatever the axes: the strength of triaxial compression and extension under a cell pressure, with two stresses equal. */
TEST(MohrCoulombLaw, SixCorners)
{
	const double N = (1 + std::sin(friction)) / (1 - std::sin(friction)), unconfined = 2 * cohesion * std::sqrt(N), cell = 100e3;
	for (const double cutoff : { none, .1 * cohesion })
		for (int axis = 0; axis < 3; ++axis)
			for (const double sign : { -1., 1. }) { // compression and extension
				LawPoint<Solid>       point(soil(cohesion, friction, dilatancy, cutoff));
				const double          squeeze = -cell * (1 - 2 * soilPoisson) / soilModulus;
				std::array<double, 6> step { squeeze, squeeze, squeeze, 0, 0, 0 };
				const int             side = (axis + 1) % 3, other = (axis + 2) % 3;
				point.strain(step);
				for (int i = 0; i < 40; ++i) { // the lateral stress is held: the lateral strain by bisection
					LawPoint<Solid> next = point;
					double          a = -1e-2, b = 1e-2;
					for (int k = 0; k < 70; ++k) {
						const double lateral    = .5 * (a + b);
						step[std::size_t(axis)] = sign * 2e-4, step[std::size_t(side)] = step[std::size_t(other)] = lateral;
						next = point;
						next.strain(step);
						(next.sigma[side] > -cell ? b : a) = lateral;
					}
					point = next;
				}
				const double limit = sign < 0 ? -(cell * N + unconfined) : -(cell - unconfined) / N;
				EXPECT_NEAR(point.sigma[axis], limit, 1e-9 * cell) << axis;
				EXPECT_NEAR(point.sigma[side], point.sigma[other], 1e-12 * cell);
				EXPECT_GT(point.plasticStrain(), 1e-3);
			}
}

/* In plane strain, the angle and cohesion mobilised are those given, with any dilatancy and on any path: unlike a cone's. */
TEST(MohrCoulombLaw, PlaneStrainMobilisesTheAngleGiven)
{
	for (const double phi : { .3, .5236, .7 })
		for (const double psi : { 0., .1, .3 })
			for (const double turn : { 0., .3, .7854, 1.2 }) {
				LawPoint<PlaneStrain> point(soil(cohesion, phi, psi));
				point.strain({ -2e-3, -2e-3, -2e-3, 0 });
				const double c = std::cos(2 * turn), s = std::sin(2 * turn), volume = std::sin(psi);
				for (int i = 0; i < 50; ++i)
					point.strain({ 1e-3 * (volume + c), 1e-3 * (volume - c), 0, 2e-3 * s });
				const double m = .5 * (point.sigma[0] + point.sigma[1]), d = .5 * (point.sigma[0] - point.sigma[1]);
				const double r = std::hypot(d, point.sigma[3]);
				EXPECT_NEAR(r / (cohesion * std::cos(phi) - m * std::sin(phi)), 1, 1e-12) << phi << ", " << psi << ", " << turn;
				EXPECT_NEAR(d / r, c, 1e-12);
				EXPECT_NEAR(point.sigma[3] / r, s, 1e-12);
				EXPECT_GT(point.plasticStrain(), .01);
			}
}

TEST(MohrCoulombLaw, BarsCarryTheirStrengthInTensionAndCompression)
{
	const double sine = std::sin(friction), compression = -2 * cohesion * std::cos(friction) / (1 - sine),
		     tension = 2 * cohesion * std::cos(friction) / (1 + sine);
	for (const double cutoff : { none, .4 * cohesion, 0. })
		for (const double psi : { 0., .2, .5 }) {
			const Law law = soil(cohesion, friction, psi, cutoff);
			for (const double sign : { -1., 1. }) {
				std::vector<double> path;
				for (int i = 0; i <= 50; ++i)
					path.insert(path.end(), { sign * 2e-4 * i, 0, 0, 0, 0, 0, 0, 0, 0 });
				const PointHistory bar   = drivePoint(law, path, { false, true, true });
				const double       limit = sign < 0 ? compression : std::min(cutoff, tension);
				EXPECT_NEAR(bar.stress[9 * 50], limit, 1e-9 * cohesion) << cutoff << ", " << psi;
				LawPoint<Uniaxial> uniaxial(law);
				uniaxial.strain({ sign * .01 }, 50);
				EXPECT_NEAR(uniaxial.sigma[0], limit, 1e-9 * cohesion);
				if (sign < 0) { // the volume grows by the flow of an edge: (-(1 - sin psi), (1 + sin psi)/2, (1 + sin psi)/2)
					const double volume = bar.strain[9 * 50] + 2 * bar.strain[9 * 50 + 4] - bar.strain[9 * 40] - 2 * bar.strain[9 * 40 + 4];
					EXPECT_NEAR(volume, 10 * 2e-4 * 2 * std::sin(psi) / (1 - std::sin(psi)), 1e-10);
				}
			}
		}
}

/* Under shear, two free normals differ in strain: refused, by name; one is found. */
TEST(MohrCoulombLaw, FreeNormals)
{
	std::vector<double> path;
	for (int i = 0; i <= 300; ++i) {
		const double t = i / 100.;
		path.insert(path.end(), { -.01 * t, .002 * t * t, 0, .002 * t * t, .004 * std::sin(t), .001 * t, 0, .001 * t, 0 });
	}
	for (const double cutoff : { none, .1 * cohesion }) {
		const Law          law   = soil(cohesion, friction, dilatancy, cutoff);
		const PointHistory plane = drivePoint(law, path, { false, false, true }), solid = drivePoint(law, plane.strain);
		double             worst = 0, greatest = 0;
		for (std::size_t k = 0; k < plane.stress.size(); ++k)
			worst = std::max(worst, std::abs(plane.stress[k] - solid.stress[k])), greatest = std::max(greatest, std::abs(plane.stress[k]));
		EXPECT_LT(worst, 1e-6 * greatest);
		EXPECT_GT(plane.plasticStrain.back(), .01);
	}
	for (const std::array<bool, 3>& free : { std::array<bool, 3> { false, true, true }, { true, true, true } })
		try {
			drivePoint(soil(), path, free);
			FAIL() << "shear with two free normals";
		} catch (const std::invalid_argument& error) {
			EXPECT_NE(std::string(error.what()).find("strain xy of entry 1 is"), std::string::npos) << error.what();
		}
}

/* The tangent's quadratic form is at most stiffnessBound() times that of D, and comes close to it. */
TEST(MohrCoulombLaw, StiffnessIsBounded)
{
	std::mt19937                           random(5);
	std::normal_distribution<double>       normal;
	std::uniform_real_distribution<double> unit(0, 1);
	for (const double poisson : { -.3, 0., .3, .45 })
		for (const auto& [phi, psi] : { std::array<double, 2> { .3, 0 }, { .6, 0 }, { .6, .2 }, { .6, .6 }, { 1.2, .1 } }) {
			const Law       law   = soil(cohesion, phi, psi, poisson > 0 ? .3 * cohesion : none, poisson);
			const double    bound = law.stiffnessBound();
			Eigen::MatrixXd D(6, 6), tangent(6, 6);
			for (int j = 0; j < 6; ++j)
				Solid::elastic(law.elastic, Eigen::VectorXd::Unit(6, j).eval().data(), D.col(j).data());
			double greatest = 0;
			for (int trial = 0; trial < 400; ++trial) {
				double       e[6], sigma[6] {}, p = 0;
				const double size = std::pow(10, -4 + 2 * unit(random));
				for (int k = 0; k < 6; ++k)
					e[k] = size * normal(random) - (k < 3 ? size : 0);
				if (trial % 3 == 0) { // triaxial compression, on an edge
					e[0] = -5 * size, e[1] = e[2] = 2.2 * size;
					e[3] = e[4] = e[5] = 0;
				}
				consistentTangent<Solid>(law, e, sigma, &p, tangent.data());
				const Eigen::MatrixXd symmetric = .5 * (tangent + tangent.transpose());
				greatest = std::max(greatest, Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd>(symmetric, D).eigenvalues().maxCoeff());
			}
			EXPECT_LE(greatest, bound * (1 + 1e-9)) << poisson << ", " << phi << ", " << psi;
			EXPECT_GE(greatest, bound - 1e-6);
			if (phi == psi) {
				EXPECT_NEAR(bound, 1, 1e-12);
			} else {
				EXPECT_GT(bound, 1.001);
			}
		}
}

/* Tangents where principal stresses coincide, against differences: on edges, with tension, at the start of a hydrostatic state. */
template <class S> void coincide(const Law& law, const Eigen::Vector3d& trial)
{
	constexpr int         N = S::N;
	std::mt19937          random(3);
	const Eigen::Matrix3d Q = randomAxes<S>(random);
	for (const Eigen::Matrix3d& axes : { Eigen::Matrix3d(Eigen::Matrix3d::Identity()), Q }) {
		const auto   e = strainOf<S>(law, trial, axes);
		const double none_[N] {}, p = 0;
		double       tangent[N * N];
		consistentTangent<S>(law, e.data(), none_, &p, tangent);
		for (int j = 0; j < N; ++j) {
			double       side[2][N];
			const double h = 1e-5 * trial.norm() / soilModulus;
			for (int k = 0; k < 2; ++k) {
				LawPoint<S> point(law);
				auto        moved = e;
				moved[std::size_t(j)] += k ? h : -h;
				point.strain(moved);
				std::copy(point.sigma, point.sigma + N, side[k]);
			}
			for (int i = 0; i < N; ++i)
				EXPECT_NEAR(tangent[i * N + j], (side[1][i] - side[0][i]) / (2 * h), 3e-5 * soilModulus)
					<< i << ", " << j << " at " << trial.transpose();
		}
	}
}
TEST(MohrCoulombLaw, TangentWherePrincipalStressesCoincide)
{
	const double c = cohesion;
	for (const double psi : { 0., .2 })
		for (const Eigen::Vector3d& trial :
			{ Eigen::Vector3d(-.3 * c, -.3 * c, -.3 * c), Eigen::Vector3d(-c, -c, -9 * c), Eigen::Vector3d(-c, -9 * c, -9 * c),
				Eigen::Vector3d(-9 * c, -9 * c, -c), Eigen::Vector3d(9 * c, 9 * c, 9 * c), Eigen::Vector3d(-c, -c, 2 * c),
				Eigen::Vector3d(2 * c, -.1 * c, -.1 * c), Eigen::Vector3d(2 * c, 2 * c, -c), Eigen::Vector3d(2 * c, -8 * c, -8 * c) })
			for (const double cutoff : { none, .3 * c }) {
				coincide<Solid>(soil(c, friction, psi, cutoff), trial);
				coincide<PlaneStrain>(soil(c, friction, psi, cutoff), trial);
			}
}

TEST(MohrCoulombLaw, RefusesInadmissibleParameters)
{
	const auto begins = [](const Law& law, const char* text) { EXPECT_EQ(validate(law).rfind(text, 0), 0u) << validate(law); };
	begins(soil(-1), "cohesion");
	begins(soil(1, 1.58), "internalFriction"), begins(soil(1, -.1), "internalFriction"), begins(soil(1, NAN), "internalFriction");
	begins(soil(1, .3, .4), "dilatancy"), begins(soil(1, .3, -.1), "dilatancy"), begins(soil(0, 0, 0), "cohesion");
	begins(soil(cohesion, .3, .1, -1), "tensionCutoff"), begins(soil(cohesion, .3, .1, NAN), "tensionCutoff");
	begins(soil(cohesion, .3, .1, 1.001 * cohesion / std::tan(.3)), "tensionCutoff = 64719.2: give at most cohesion/tan(internalFriction) = 64654.6 [Pa]");
	begins(soil(0, .3, .1, 1), "tensionCutoff");
	for (const Law& law : { soil(cohesion, .3, .1, cohesion / std::tan(.3)), soil(0, .3, .1, 0), soil(cohesion, 0, 0, 1e9), soil(cohesion, .3, .3) })
		EXPECT_EQ(validate(law), "");
}

} // namespace
