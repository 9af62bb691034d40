// SPDX-License-Identifier: GPL-2.0-or-later
/* The approximate full mass matrix and the filter of what the grid does not see: the formulas of FullMass.hpp and Filter.hpp against dense matrices, fourth
order in the manufactured solutions, and the balance of energies. Momentum, patches, threads and walls are in the tests of every method (SolverInvariantsTest,
PatchTest, WallTest), frequencies in WaveTest, the stable step in StableStepTest. */
#include "VibratingBar.hpp"
#include "kernel/transfer/ShapeFunction.hpp"
#include <Eigen/Dense>
#include <gtest/gtest.h>
#include <random>

using namespace yade::mpm;

namespace {

/* Scattered points of unequal mass on a line, and the matrices of their cubic functions. */
struct Line {
	static constexpr double h = .25;
	Scene                   scene;
	Eigen::MatrixXd         S, Splus;

	Line()
	{
		std::mt19937                           random(3);
		std::uniform_real_distribution<double> uniform(-1, 1);
		scene.laws = { Scene::elastic(1e5, 0, 1000) };
		scene.addBox(1, { .3, 0, 0 }, { 2.3, 0, 0 }, h / 2);
		for (std::size_t p = 0; p < scene.points.count(); ++p) {
			scene.points.position[0][p] += .02 * uniform(random), scene.points.velocity[0][p] = uniform(random);
			scene.points.mass[p] *= 1 + .3 * uniform(random);
		}
		scene.start(Analysis::uniaxial, ShapeKind::cubic, h, true);
		for (double& f : scene.points.force[0])
			f = 1e3 * uniform(random);
		scene.control.dt = 1e-3;
		const auto& P    = scene.points;
		S                = Eigen::MatrixXd::Zero(Eigen::Index(P.count()), 16);
		for (std::size_t p = 0; p < P.count(); ++p) {
			const double xi = P.position[0][p] / h, base = std::floor(xi - CubicShape::shift(0));
			double       N[4], dN[4];
			CubicShape::evaluate(xi, base, 0, N, dN);
			for (int i = 0; i < 4; ++i)
				S(Eigen::Index(p), Eigen::Index(base) + i + 2) = N[i];
		}
		const Eigen::VectorXd mass = column(P.mass);
		Eigen::VectorXd       over = S.transpose() * mass;
		for (double& m : over)
			m = m > 0 ? 1 / m : 0;
		Splus = over.asDiagonal() * S.transpose() * mass.asDiagonal();
	}
	static Eigen::VectorXd column(const Column& c) { return Eigen::Map<const Eigen::VectorXd>(c.data(), Eigen::Index(c.size())); }
	Eigen::VectorXd        velocity() const { return column(scene.points.velocity[0]); }
};
void expectEqual(const Eigen::VectorXd& a, const Eigen::VectorXd& b, double tolerance) { EXPECT_LT((a - b).lpNorm<Eigen::Infinity>(), tolerance); }

TEST(FullMassTest, StepIsThatOfTheMatrices)
{
	for (double flip : { 1., 0., .7 }) {
		SCOPED_TRACE(flip);
		Line line;
		line.scene.control.fullMass = true, line.scene.control.flip = flip;
		const double          dt = line.scene.control.dt;
		const Eigen::MatrixXd Q = line.Splus * line.S, identity = Eigen::MatrixXd::Identity(Q.rows(), Q.cols());
		const Eigen::VectorXd v0 = line.velocity(), x0 = Line::column(line.scene.points.position[0]),
				      a       = line.Splus * Line::column(line.scene.points.force[0]).cwiseQuotient(Line::column(line.scene.points.mass)),
				      star    = line.Splus * v0 + dt * a;
		const Eigen::MatrixXd inverse = 2 * identity - Q; // of Q
		const Eigen::VectorXd points  = flip * (v0 + dt * line.S * inverse * a) + (1 - flip) * line.S * inverse * star;
		line.scene.run(1);
		expectEqual(line.velocity(), points, 1e-12);
		expectEqual(Line::column(line.scene.points.position[0]), x0 + dt * line.S * inverse * line.Splus * points, 1e-14);
	}
}

TEST(FullMassTest, FilterIsThatOfTheMatrices)
{
	for (bool full : { false, true }) {
		Line plain, filtered;
		plain.scene.control.fullMass = filtered.scene.control.fullMass = full;
		filtered.scene.control.filter                                  = .3;
		plain.scene.run(1), filtered.scene.run(1);
		const Eigen::VectorXd v      = plain.velocity();
		const Eigen::VectorXd unseen = v - 2 * plain.S * (plain.Splus * v) + plain.S * (plain.Splus * (plain.S * (plain.Splus * v)));
		EXPECT_GT(unseen.norm(), .1);
		expectEqual(filtered.velocity(), v - .3 * unseen, 1e-12);
		EXPECT_NEAR(filtered.scene.momentum()[0], plain.scene.momentum()[0], 1e-10);
	}
}

// ---- order four -----------------------------------------------------------------------------------------------------------

Manufactured solution(Analysis analysis, double amplitude)
{
	Manufactured m { analysis, ShapeKind::cubic, amplitude, analysis == Analysis::uniaxial ? 0 : .3 };
	m.fullMass = true;
	return m;
}
double order(const std::vector<double>& errors, std::size_t k) { return std::log2(errors[k - 1] / errors[k]); }

/* With dt = 0.2 h/c the error of time, of order two, takes over from 32 cells on. */
TEST(FullMassTest, BarOfOrderFour)
{
	const auto small = solution(Analysis::uniaxial, 1e-4).errors({ 4, 8, 16, 32 }), large = solution(Analysis::uniaxial, .05).errors({ 4, 8, 16 });
	for (const auto& errors : { small, large })
		for (std::size_t k = 1; k < errors.size(); ++k)
			EXPECT_GT(order(errors, k), 3.5) << "level " << k << ": " << errors[k];
	EXPECT_LT(small[2], 4.6e-8) << "5.64e-6 with the lumped mass";
	EXPECT_LT(large[2], 3.8e-5) << "2.89e-3 with the lumped mass";
}
TEST(LongFullMassTest, PlaneAndSpaceOfOrderFour)
{
	for (Analysis analysis : { Analysis::planeStress, Analysis::planeStrain, Analysis::solid })
		for (double amplitude : { 1e-4, .05 }) {
			SCOPED_TRACE(std::string(name(analysis)) + " amplitude " + std::to_string(amplitude));
			const auto errors =
				solution(analysis, amplitude).errors(analysis == Analysis::solid ? std::vector<int> { 4, 8 } : std::vector<int> { 4, 8, 16 });
			for (std::size_t k = 1; k < errors.size(); ++k)
				EXPECT_GT(order(errors, k), 3.5) << "level " << k << ": " << errors[k];
		}
}

/* Where quadrature, or the strain of a cell, is of second order, it is what remains. */
TEST(FullMassTest, OtherShapesGain)
{
	const struct {
		ShapeKind shape;
		double    part; // of the error that the lumped mass has
	} rows[] { { ShapeKind::linear, .41 }, { ShapeKind::gimp, .41 }, { ShapeKind::quadratic, .05 }, { ShapeKind::cubic, .01 } };
	for (const auto& row : rows) {
		Manufactured full   = solution(Analysis::uniaxial, 1e-4);
		full.shape          = row.shape;
		Manufactured lumped = full;
		lumped.fullMass     = false;
		EXPECT_LT(full.error(16), row.part * lumped.error(16)) << name(row.shape);
	}
}

/* With the hysteretic law, until noise of the lattice on the soft tangent takes over: 2.34e-4 and 1.82e-4 with the lumped mass. */
TEST(FullMassTest, HystereticBar)
{
	HystereticBar bar { ShapeKind::cubic, { Scheme::musl, true } };
	const double  coarse = bar.error(8), fine = bar.error(16);
	EXPECT_GT(std::log2(coarse / fine), 3.5);
	EXPECT_LT(fine, 3.8e-6);
	bar.yieldStress = bar.young / 50;
	EXPECT_LT(bar.error(16), 7e-6);
}

/* The sum of energies under all that takes part: gravity, a moving wall, prescribed points, damping and PIC. */
TEST(FullMassTest, EnergyBalanceIsOfTheOrderOfTheStep)
{
	for (double flip : { 1., .995 }) {
		double drift[2];
		for (int level = 0; level < 2; ++level) {
			Scene s;
			s.laws              = { Scene::elastic(1e7, .3, 1000) };
			s.walls             = { Scene::wall(0, 1, 0, Wall::Kind::fixed), Scene::wall(1, 1, 0, Wall::Kind::slip) };
			s.walls[0].velocity = { .5, .2, 0 };
			s.addBox(2, { 0, 0, 0 }, { 1, .5, 0 }, .0625);
			s.points.prescribedDofs.assign(s.points.count(), 0);
			for (std::size_t p = 0; p < s.points.count(); ++p)
				if (s.points.position[0][p] > .9 && s.points.position[1][p] > .4) s.points.prescribedDofs[p] = 1;
			s.setVelocity([](auto x) { return std::array<double, 3> { .5 + 3 * x[0], 3 * x[1] - 2 * x[0], 0 }; });
			s.control.fullMass = s.control.trackEnergy = true;
			s.control.dt = 2e-4 / (1 << level), s.control.flip = 1 - (1 - flip) / (1 << level);
			s.control.damping = .01, s.control.gravity = { 0, -100, 0 };
			s.start(Analysis::planeStrain, ShapeKind::cubic, .125);
			s.step();
			const double start = s.points.energies.total();
			double       worst = 0;
			for (int k = 0; k < 300 << level; ++k) {
				s.runWithWalls(1);
				worst = std::max(worst, std::abs(s.points.energies.total() - start));
			}
			const Energies& e = s.points.energies;
			for (double term : { e.kinetic, e.elastic, e.external, e.damping, e.walls })
				EXPECT_GT(std::abs(term), .01 * std::abs(e.kinetic)) << "has not taken part";
			drift[level] = worst / e.elastic;
		}
		EXPECT_LT(drift[0], 1.5e-3);
		EXPECT_LT(drift[1], .6 * drift[0]);
	}
}
TEST(FullMassTest, WhatTheFilterTakesIsDamping)
{
	Line line;
	line.scene.control.trackEnergy = true;
	line.scene.points.dissipation.assign(line.scene.points.count(), 0);
	line.scene.run(1);
	const double before       = line.scene.points.energies.total();
	line.scene.control.filter = .3;
	line.scene.run(1);
	line.scene.control.filter = 0;
	line.scene.run(2);
	const Energies& e = line.scene.points.energies;
	EXPECT_GT(e.damping, .05 * e.kinetic);
	EXPECT_NEAR(e.total(), before, 1e-3 * e.damping);
}
/* What the full mass and the filter take from a wall's momentum or give to it is in its reaction and in its work. */
TEST(FullMassTest, WorkOfAWallIsThatOfItsForce)
{
	for (bool full : { false, true })
		for (auto [filter, flip] : { std::pair { 0., 1. }, std::pair { .1, 1. }, std::pair { 0., .98 } }) {
			Scene s;
			s.laws              = { Scene::elastic(1e6, .3, 1000) };
			s.walls             = { Scene::wall(1, 1, 0, Wall::Kind::slip) };
			s.walls[0].velocity = { 0, .5, 0 };
			s.addBox(2, { 0, 0, 0 }, { .5, .5, 0 }, .0625);
			s.control.fullMass = full, s.control.filter = filter, s.control.flip = flip, s.control.dt = 5e-4, s.control.trackEnergy = true;
			s.start(Analysis::planeStrain, ShapeKind::cubic, .125);
			double work = 0, last = 0;
			for (int k = 0; k < 100; ++k) {
				s.runWithWalls(1);
				last = s.walls[0].force[1] * .5 * s.control.dt, work += last;
			}
			const Energies& e = s.points.energies;
			EXPECT_GT(e.kinetic, 1);
			EXPECT_NEAR(e.walls, work - .5 * last, 1e-10 * e.kinetic);
			EXPECT_NEAR(e.total(), 0, .02 * e.kinetic);
		}
}

} // namespace
