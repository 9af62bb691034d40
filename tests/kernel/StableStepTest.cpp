// SPDX-License-Identifier: GPL-2.0-or-later
/* criticalTimeStep(): against closed forms, and against runs on both sides of it.

Linear functions, 2 points a cell, nu = 0, a long bar: with s = sin^2(theta/2) the lumped stiffness has the eigenvalue
4 (c/h)^2 s, and the passage to the points and back the factor q = 1 - 3/4 s (the points are at 1/4 and 3/4: consistent
mass 5/8 + 3/8 cos theta). MUSL and USF are stable below 2/omega with omega^2 the greatest 4 (c/h)^2 s q = 4/3 (c/h)^2:
dt = sqrt(3) h/c. USL below dt^2 lambda (2 - q) < 4, whose greatest is 7 (c/h)^2, dt = 0.756 h/c, for which the kernel takes the
safe sqrt(2/lambda) = 0.7071 h/c. The step that no point crosses a cell in is joined as 1/(1/dt + v/h).

Runs: random velocities of 1e-7 c; at 0.9 of the step the energy stays within five times what there was at the start
(1/(1 - 0.9^2) = 5.3 is what it may reach, see HardCasesTest), at 1.2 of it it grows without bound. Measured: MUSL and USF turn unstable within 1 to 1.05 of the
step, USL within 1.05 to 1.2. No linear lattice here has points on nodes: those see another operator once they move at all. */
#include "StepLimit.hpp"
#include <gtest/gtest.h>

using namespace yade::mpm;

namespace {

const double c = 10, young = 1e5, density = 1000;

Scene body(Analysis analysis, double poisson, double h, const std::array<double, 3>& size, double shift = 0)
{
	Scene s;
	s.laws = { Scene::elastic(young, poisson, density) };
	s.addBox(dimension(analysis), { shift, shift, shift }, { shift + size[0], shift + size[1], shift + size[2] }, h / 2);
	return s;
}

TEST(StableStepTest, ClosedFormOfTheBar)
{
	for (int cells : { 60, 200 }) {
		const double h = .125;
		Scene        s = body(Analysis::uniaxial, 0, h, { cells * h, 0, 0 });
		s.walls        = { Scene::wall(0, 1, 0, Wall::Kind::slip), Scene::wall(0, -1, cells * h, Wall::Kind::fixed) };
		s.start(Analysis::uniaxial, ShapeKind::linear, h);
		EXPECT_NEAR(s.solver->criticalTimeStep(Scheme::musl) * c / h, std::sqrt(3.), .01);
		EXPECT_NEAR(s.solver->criticalTimeStep(Scheme::usf) * c / h, std::sqrt(3.), .01);
		EXPECT_NEAR(s.solver->criticalTimeStep(Scheme::usl) * c / h, std::sqrt(.5), .01);
	}
}

TEST(StableStepTest, ScalesWithTheWaveSpeedAndShortensWithVelocity)
{
	for (Analysis analysis : allAnalyses) {
		SCOPED_TRACE(name(analysis));
		const double h = .25;
		Scene        s = body(analysis, .3, h, { 2, 1, 1 });
		s.start(analysis, ShapeKind::cubic, h);
		const double dt = s.solver->criticalTimeStep(Scheme::musl);
		EXPECT_GT(dt, 0);
		auto changed = [&](double stiffness, double mass, double velocity) {
			Scene other = s.copy(analysis, ShapeKind::cubic, h);
			other.laws  = { Scene::elastic(stiffness * young, .3, density) };
			for (double& m : other.points.mass)
				m *= mass;
			other.points.velocity[0][5] = -velocity;
			return other.solver->criticalTimeStep(Scheme::musl);
		};
		EXPECT_NEAR(changed(1, 1, 0), dt, 1e-9 * dt);
		EXPECT_NEAR(changed(4, 1, 0), dt / 2, 1e-3 * dt);
		EXPECT_NEAR(changed(1, 4, 0), dt * 2, 1e-3 * dt);
		EXPECT_NEAR(changed(1, 1, 3), 1 / (1 / dt + 3 / h), 1e-9 * dt);
		// asked for between two steps it changes nothing, and a stiffer law of the same material counts
		Law stiffer               = Scene::boucWen(young, .3, density, 1e3, 2, .05);
		as<BoucWen>(stiffer).beta = .1, as<BoucWen>(stiffer).gamma = .9;
		Scene other = body(analysis, .3, h, { 2, 1, 1 });
		other.laws  = { stiffer };
		other.start(analysis, ShapeKind::cubic, h);
		EXPECT_NEAR(other.solver->criticalTimeStep(Scheme::musl), dt / std::sqrt(1.8), 1e-3 * dt);
	}
}

struct StabilityCase {
	const char*           name;
	Analysis              analysis;
	std::array<double, 3> size;
	double                shift;
	bool                  walls;
	double                stretch; // of the first axis, without stress
};

TEST(LongStableStepTest, RunsOnBothSidesOfIt)
{
	const double h = .25;
	for (const StabilityCase& k : { StabilityCase { "bar", Analysis::uniaxial, { 5, 0, 0 }, 0, false, 1 },
		     StabilityCase { "bar off the grid", Analysis::uniaxial, { 5, 0, 0 }, .03, false, 1 },
		     StabilityCase { "bar between walls", Analysis::uniaxial, { 5, 0, 0 }, 0, true, 1 },
		     StabilityCase { "stretched bar", Analysis::uniaxial, { 5, 0, 0 }, 0, false, 1.5 },
		     StabilityCase { "compressed bar", Analysis::uniaxial, { 5, 0, 0 }, 0, false, .6 },
		     StabilityCase { "plate", Analysis::planeStrain, { 2, 1.5, 0 }, 0, false, 1 },
		     StabilityCase { "plate off the grid", Analysis::planeStress, { 2, 1.5, 0 }, .05, false, 1 },
		     StabilityCase { "plate in a corner", Analysis::planeStrain, { 2, 1.5, 0 }, 0, true, 1 },
		     StabilityCase { "block", Analysis::solid, { 1, 1, .75 }, .05, false, 1 } }) {
		const int dim = dimension(k.analysis);
		for (ShapeKind shape : allShapes)
			for (Method method : allMethods) {
				SCOPED_TRACE(std::string(k.name) + ' ' + name(shape) + ' ' + name(method));
				Scene s = body(k.analysis, .3, h, k.size, k.shift);
				if (k.walls) {
					s.walls.push_back(Scene::wall(0, 1, 0, Wall::Kind::fixed));
					if (dim == 1) s.walls.push_back(Scene::wall(0, -1, 5, Wall::Kind::slip));
					if (dim > 1) s.walls.push_back(Scene::wall(1, 1, 0, Wall::Kind::slip));
				}
				s.start(k.analysis, shape, h);
				for (std::size_t p = 0; p < s.points.count(); ++p)
					s.points.deformation[0][p] = k.stretch, s.points.position[0][p] *= k.stretch;
				const double limit = s.solver->criticalTimeStep(method.scheme, method.fullMass);
				const int    steps = dim == 3 ? 300 : 1500;
				const bool   usl   = method.scheme == Scheme::usl;
				// GIMP points whose domain just ends at a node: moved by nothing, they touch a node of next to no mass
				const double safe = usl && shape == ShapeKind::gimp ? .7 : .9;
				EXPECT_LT(growth(s, k.analysis, shape, h, method, safe * limit, steps, 1e-7 * c), 5);
				// where it becomes unstable
				double unstable = 0;
				for (double factor : { 1., 1.05, 1.1, 1.2 })
					if (growth(s, k.analysis, shape, h, method, factor * limit, steps, 1e-7 * c) > 100) {
						unstable = factor;
						break;
					}
				EXPECT_GT(unstable, 0);
			}
	}
}

/* With the affine transfer likewise. Its Q is nearer to 1 for shear alone, and the limit is that of compression: no more than 4 % below FLIP's. */
TEST(LongStableStepTest, AffineTransfer)
{
	const double h = .25;
	for (const StabilityCase& k : { StabilityCase { "plate off the grid", Analysis::planeStrain, { 2, 1.5, 0 }, .05, false, 1 },
		     StabilityCase { "plate in a corner", Analysis::planeStress, { 2, 1.5, 0 }, 0, true, 1 },
		     StabilityCase { "block", Analysis::solid, { 1, 1, .75 }, .05, false, 1 } })
		for (ShapeKind shape : allShapes)
			for (Method method : { Method(Scheme::usl, false, true), Method(Scheme::musl, false, true), Method(Scheme::musl, true, true) }) {
				SCOPED_TRACE(std::string(k.name) + ' ' + name(shape) + ' ' + name(method));
				Scene s = body(k.analysis, .3, h, k.size, k.shift);
				if (k.walls) s.walls = { Scene::wall(0, 1, 0, Wall::Kind::fixed), Scene::wall(1, 1, 0, Wall::Kind::slip) };
				s.start(k.analysis, shape, h);
				const double limit = s.solver->criticalTimeStep(method.scheme, method.fullMass, true);
				const double flip  = s.solver->criticalTimeStep(method.scheme, method.fullMass);
				const int    steps = k.analysis == Analysis::solid ? 300 : 1000;
				const bool   usl   = method.scheme == Scheme::usl;
				EXPECT_LE(limit, flip * (1 + 1e-3));
				EXPECT_GT(limit, .8 * flip);
				EXPECT_LT(growth(s, k.analysis, shape, h, method, (usl && shape == ShapeKind::gimp ? .7 : .9) * limit, steps, 1e-7 * c), 6);
				EXPECT_GT(growth(s, k.analysis, shape, h, method, 1.2 * limit, steps, 1e-7 * c), 100);
			}
}

/* The limit in a bar, wherever its free end is in a cell: what doc/accuracy says of it. */
TEST(LongStableStepTest, BulkAndEdge)
{
	for (ShapeKind shape : allShapes)
		for (std::size_t m = 0; m < allMethods.size(); ++m) {
			SCOPED_TRACE(std::string(name(shape)) + ' ' + name(allMethods[m]));
			const StepLimit limit { Analysis::uniaxial, shape, allMethods[m] };
			const double    above   = allMethods[m].scheme == Scheme::usl ? 1.11 : 1.005; // where it is unstable, times the computed one
			const Scene     bulk    = limit.body(false, 0);
			const double    inside  = limit.computed(bulk);
			double          atWorst = HUGE_VAL;
			EXPECT_FALSE(limit.grows(bulk, .995 * inside));
			EXPECT_TRUE(limit.grows(bulk, above * inside));
			for (double place : StepLimit::places()) {
				SCOPED_TRACE(place);
				const Scene  s  = limit.body(true, place);
				const double dt = limit.computed(s);
				EXPECT_FALSE(limit.grows(s, .995 * dt));
				EXPECT_TRUE(limit.grows(s, above * dt));
				atWorst = std::min(atWorst, dt);
			}
			// the edge over the bulk: USF, USL, MUSL, with the full mass
			const double expected[4][4] { { .813, .0198, .813, .818 }, { 1, .796, 1, 1 }, { .907, .550, .907, .855 }, { .953, .762, .953, .922 } };
			EXPECT_NEAR(atWorst / inside, expected[std::size_t(shape)][m], .003);
		}
}

} // namespace
