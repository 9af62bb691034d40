// SPDX-License-Identifier: GPL-2.0-or-later
/* What every step must keep, whatever the shape function, the scheme and the analysis.

Momentum: nodal internal forces sum to zero because sum grad N_ip = 0, and points take up exactly what nodes do, so a free
body keeps its momentum, to the rounding of the sums; tolerance 1e-12 of the momentum that the forces hand about.
(Nodes with less than 1e-14 of a point's mass give nothing back; the random points here stay clear of that.)

Angular momentum: nodal internal forces have no moment, sum x_i x f_i = 0, but a point takes its impulse at x_p and a node
gives it at x_i: with a lumped mass the moments differ by sum (x_i - centre of the node's mass) x f_i dt, which is zero to
rounding for nodes that are symmetrically surrounded and not at the edge of a body. So it is kept approximately, and
better on a finer grid; that is what is asserted.

Free fall: symplectic Euler gives v_n = v_0 + n g dt and x_n = x_0 + n v_0 dt + g dt^2 n (n + 1)/2 exactly. */
#include "Scene.hpp"
#include <gtest/gtest.h>
#include <random>

using namespace yade::mpm;

namespace {

template <class Visit> void forEveryMethod(Visit&& visit)
{
	for (Analysis analysis : allAnalyses)
		for (ShapeKind shape : allShapes)
			for (const auto& methods : { allMethods, affineMethods })
				for (Method method : methods) {
					SCOPED_TRACE(std::string(name(analysis)) + ' ' + name(shape) + ' ' + name(method));
					visit(analysis, shape, method);
				}
}

/* A free body of scattered points, under stress and in motion; two materials, one of them hysteretic. */
Scene agitated(Analysis analysis, ShapeKind shape, Method method, int cells = 4)
{
	const int    dim = dimension(analysis);
	const double h = .25, size = cells * h;
	Scene        s;
	s.laws = { Scene::elastic(1e5, .3, 1000), Scene::boucWen(2e5, .2, 1500, 3e3, 2, .05) };
	s.addBox(dim, { -.31, .13, 5.07 }, { -.31 + size, .13 + size, 5.07 + size }, h / 2);
	std::mt19937                           random(7);
	std::uniform_real_distribution<double> uniform(-1, 1);
	for (std::size_t p = 0; p < s.points.count(); ++p) {
		for (int d = 0; d < dim; ++d)
			s.points.position[std::size_t(d)][p] += .02 * h * uniform(random), s.points.velocity[std::size_t(d)][p] = .3 + .3 * uniform(random);
		if (p % 3 == 0) s.points.material[p] = 1, s.points.mass[p] *= 1.5;
	}
	s.control.dt = .1 * h / 20, method.set(s.control);
	s.start(analysis, shape, h, true);
	for (std::size_t k = 0; k < s.points.stress.size(); ++k)
		for (double& sigma : s.points.stress[k])
			sigma = 1e3 * uniform(random);
	return s;
}

void expectSame(Points& a, Points& b)
{
	std::vector<Column> columns;
	a.forEachColumn([&](Column& c) { columns.push_back(c); });
	std::size_t k = 0;
	b.forEachColumn([&](Column& c) {
		EXPECT_TRUE(columns[k] == c) << "column " << k << " differs";
		++k;
	});
	EXPECT_EQ(a.id, b.id);
	EXPECT_EQ(a.material, b.material);
}

/* The scene must not move between construction and use: the solver holds on to its members. */
struct Held {
	Scene scene;
	Held(Scene&& s, Analysis analysis, ShapeKind shape, double h)
	    : scene(s.copy(analysis, shape, h))
	{
		scene.solver = makeSolver(analysis, shape, h, scene.points, scene.laws, scene.walls);
	}
};

TEST(SolverInvariantsTest, MomentumOfAFreeBody)
{
	forEveryMethod([](Analysis analysis, ShapeKind shape, Method method) {
		Held         held(agitated(analysis, shape, method), analysis, shape, .25);
		Scene&       s      = held.scene;
		const auto   before = s.momentum();
		const double energy = s.kineticEnergy();
		const Column v0     = s.points.velocity[0];
		const int    steps  = analysis == Analysis::solid ? 10 : 30;
		s.run(steps);
		const auto   after = s.momentum();
		const double scale = s.mass() * std::sqrt(2 * energy / s.mass());
		for (std::size_t d = 0; d < 3; ++d)
			EXPECT_NEAR(after[d], before[d], 1e-12 * scale);
		// the stresses have been at work
		double change = 0;
		for (std::size_t p = 0; p < v0.size(); ++p)
			change = std::max(change, std::abs(s.points.velocity[0][p] - v0[std::size_t(s.points.id[p])]));
		EXPECT_GT(change, .01);
	});
}

TEST(SolverInvariantsTest, ImpulseOfExternalForces)
{
	forEveryMethod([](Analysis analysis, ShapeKind shape, Method method) {
		Held   held(agitated(analysis, shape, method), analysis, shape, .25);
		Scene& s          = held.scene;
		s.control.gravity = { 1, -2, 3 };
		std::array<double, 3> force {};
		const int             dim = dimension(analysis);
		for (int d = 0; d < dim; ++d) {
			s.points.force[std::size_t(d)][3] = 5. * (d + 1);
			force[std::size_t(d)]             = 5. * (d + 1) + s.mass() * s.control.gravity[std::size_t(d)];
		}
		const auto before = s.momentum();
		s.run(5);
		const auto after = s.momentum();
		for (int d = 0; d < dim; ++d)
			EXPECT_NEAR(after[std::size_t(d)] - before[std::size_t(d)], 5 * s.control.dt * force[std::size_t(d)], 1e-12 * s.mass());
	});
}

TEST(LongSolverInvariantsTest, AngularMomentumIsKeptBetterByFinerGrids)
{
	// a spinning, ringing disk of radius 0.5: greatest change of its angular momentum in a third of a turn
	auto drift = [](ShapeKind shape, Method method, double h) {
		Scene s;
		s.laws = { Scene::elastic(1e6, .3, 1000) };
		s.addBox(2, { -.5, -.5, 0 }, { .5, .5, 0 }, h / 2);
		std::vector<std::size_t> inside;
		for (std::size_t p = 0; p < s.points.count(); ++p)
			if (std::hypot(s.points.position[0][p], s.points.position[1][p]) < .5) inside.push_back(p);
		s.points.select(inside);
		for (int& id : s.points.id)
			id = int(&id - s.points.id.data());
		for (double& x : s.points.position[0])
			x += .37 * h;
		auto angular = [&] {
			double L = 0;
			for (std::size_t p = 0; p < s.points.count(); ++p)
				L += s.points.mass[p] * (s.points.position[0][p] * s.points.velocity[1][p] - s.points.position[1][p] * s.points.velocity[0][p]);
			return L;
		};
		const double omega = 2;
		s.setVelocity([&](auto x) { return std::array<double, 3> { -omega * x[1] + x[0], omega * (x[0] - .37 * h), 0 }; });
		s.control.dt = .2 * h / 36, method.set(s.control);
		s.start(Analysis::planeStrain, shape, h);
		const double start = angular();
		double       worst = 0;
		const int    steps = int(1. / s.control.dt);
		for (int k = 0; k < steps; ++k) {
			s.step();
			if (k % 10 == 0) s.solver->finish(), worst = std::max(worst, std::abs(angular() / start - 1));
		}
		EXPECT_GT(std::abs(start), 100) << "it does not spin";
		return worst;
	};
	for (ShapeKind shape : { ShapeKind::quadratic, ShapeKind::cubic })
		for (Method method : allMethods) {
			SCOPED_TRACE(std::string(name(shape)) + ' ' + name(method));
			// 10 and 20 cells across: 4 to 6 % and 0.7 to 1 % (40 cells: 0.13 to 0.19 %), of order 2.4 to 2.9
			const double coarse = drift(shape, method, .1), fine = drift(shape, method, .05);
			EXPECT_LT(coarse, .07);
			EXPECT_LT(fine, .012);
			EXPECT_GT(coarse / fine, 4);
		}
}

TEST(SolverInvariantsTest, FreeFallIsTheParabolaOfSymplecticEuler)
{
	forEveryMethod([](Analysis analysis, ShapeKind shape, Method method) {
		const int    dim = dimension(analysis);
		const double h = .25, v0[3] = { .7, -2, 1.3 };
		Scene        s;
		s.laws            = { Scene::elastic(1e5, .3, 1000) };
		s.control.gravity = { 1, -9.81, 3 };
		s.control.dt      = .002, method.set(s.control);
		s.addBox(dim, { .1, .2, .3 }, { .6, .7, .8 }, h / 2);
		s.setVelocity([&](auto) { return std::array<double, 3> { v0[0], dim > 1 ? v0[1] : 0, dim > 2 ? v0[2] : 0 }; });
		s.start(analysis, shape, h);
		const Columns X = s.points.position;
		const int     n = 200; // falls through cells
		s.run(n);
		for (int d = 0; d < dim; ++d)
			for (std::size_t p = 0; p < s.points.count(); ++p) {
				const double g = s.control.gravity[std::size_t(d)], dt = s.control.dt;
				ASSERT_NEAR(s.points.velocity[std::size_t(d)][p], v0[d] + n * g * dt, 1e-12);
				ASSERT_NEAR(s.points.position[std::size_t(d)][p],
					X[std::size_t(d)][std::size_t(s.points.id[p])] + n * v0[d] * dt + .5 * g * dt * dt * n * (n + 1), 1e-12);
			}
		for (const Column& stress : s.points.stress)
			for (double sigma : stress)
				ASSERT_NEAR(sigma, 0, 1e-7) << "rigid translation has strained the body"; // 1e5 Pa times 200 steps of rounded strain
	});
}

TEST(SolverInvariantsTest, OnlyPrescribedComponentsStayAsToldAndDragTheRest)
{
	for (Method method : allMethods) {
		SCOPED_TRACE(name(method));
		Scene s;
		s.laws = { Scene::elastic(1e5, .3, 1000) };
		s.addBox(2, { 0, 0, 0 }, { 1, 1, 0 }, .125);
		s.control.dt = .002, method.set(s.control), s.control.gravity = { 0, -10, 0 };
		s.points.prescribedDofs.assign(s.points.count(), 0);
		for (std::size_t p = 0; p < s.points.count(); ++p)
			if (s.points.position[0][p] < .25) s.points.prescribedDofs[p] = 1, s.points.velocity[0][p] = -.5; // x alone
		s.start(Analysis::planeStress, ShapeKind::cubic, .25);
		const Columns X = s.points.position;
		s.run(100);
		int    prescribed = 0;
		double dragged    = 0;
		for (std::size_t p = 0; p < s.points.count(); ++p) {
			const std::size_t id = std::size_t(s.points.id[p]);
			ASSERT_EQ(s.points.prescribedDofs[p], X[0][id] < .25) << "flags have not followed the sorting";
			if (s.points.prescribedDofs[p]) {
				++prescribed;
				EXPECT_EQ(s.points.velocity[0][p], -.5);
				EXPECT_NEAR(s.points.position[0][p], X[0][id] - .5 * .2, 1e-13);
			} else
				dragged += s.points.velocity[0][p];
			EXPECT_LT(s.points.velocity[1][p], -1.5);
		}
		EXPECT_EQ(prescribed, 16);
		EXPECT_LT(dragged / 48, -.1) << "the rest has not been dragged";
	}
}

/* Cells are worked on in colours, so no sum depends on who computes it. */
TEST(SolverInvariantsTest, ThreadsChangeNothing)
{
	for (Analysis analysis : { Analysis::planeStress, Analysis::solid })
		for (Method method : { Method(Scheme::usf), Method(Scheme::musl), Method(Scheme::musl, true) }) {
			SCOPED_TRACE(std::string(name(analysis)) + ' ' + name(method));
			const int cells = analysis == Analysis::solid ? 7 : 24; // several tiles of each colour
			Held      one(agitated(analysis, ShapeKind::cubic, method, cells), analysis, ShapeKind::cubic, .25);
			Held      two(agitated(analysis, ShapeKind::cubic, method, cells), analysis, ShapeKind::cubic, .25);
			one.scene.control.filter = two.scene.control.filter = .1;
			two.scene.control.threads                           = 2;
			one.scene.run(5), two.scene.run(5);
			expectSame(one.scene.points, two.scene.points);
			EXPECT_GT(one.scene.kineticEnergy(), 0);
		}
}

/* Looking at the points, saving and loading, sorting anew: none of them may change a bit. */
TEST(SolverInvariantsTest, FinishingSavingAndSortingBetweenStepsChangeNothing)
{
	forEveryMethod([](Analysis analysis, ShapeKind shape, Method method) {
		const int steps = analysis == Analysis::solid ? 12 : 40;
		Held      a(agitated(analysis, shape, method), analysis, shape, .25), b(agitated(analysis, shape, method), analysis, shape, .25);
		for (Held* held : { &a, &b }) {
			held->scene.control.gravity = { 3, -10, 2 };
			held->scene.walls           = { Scene::wall(0, 1, -.6, Wall::Kind::friction) };
		}
		for (int k = 0; k < steps; ++k) {
			a.scene.step(), b.scene.step();
			if (k % 3 == 0) b.scene.solver->finish();
			if (k % 4 == 1) b.scene.solver->finish(), b.scene.solver->pointsChanged();
			if (k % 5 == 2)
				b.scene.solver->finish(), b.scene.solver = makeSolver(analysis, shape, .25, b.scene.points, b.scene.laws, b.scene.walls);
			if (k % 7 == 3) b.scene.solver->criticalTimeStep(method.scheme, method.fullMass);
		}
		a.scene.solver->finish(), b.scene.solver->finish();
		expectSame(a.scene.points, b.scene.points);
		EXPECT_EQ(a.scene.walls[0].force, b.scene.walls[0].force);
	});
}

TEST(SolverInvariantsTest, OrderOfInputMattersToRoundingOnly)
{
	forEveryMethod([](Analysis analysis, ShapeKind shape, Method method) {
		Held                     a(agitated(analysis, shape, method), analysis, shape, .25), b(agitated(analysis, shape, method), analysis, shape, .25);
		std::vector<std::size_t> order(b.scene.points.count());
		std::iota(order.begin(), order.end(), std::size_t(0));
		std::shuffle(order.begin(), order.end(), std::mt19937(3));
		b.scene.points.select(order);
		ASSERT_NE(a.scene.points.id, b.scene.points.id);
		a.scene.run(10), b.scene.run(10);
		const auto ia = a.scene.byId(), ib = b.scene.byId();
		for (std::size_t id = 0; id < ia.size(); ++id) {
			for (std::size_t d = 0; d < 3; ++d) {
				ASSERT_NEAR(a.scene.points.velocity[d][ia[id]], b.scene.points.velocity[d][ib[id]], 1e-11);
				ASSERT_NEAR(a.scene.points.position[d][ia[id]], b.scene.points.position[d][ib[id]], 1e-12);
			}
			for (std::size_t k = 0; k < a.scene.points.stress.size(); ++k)
				ASSERT_NEAR(a.scene.points.stress[k][ia[id]], b.scene.points.stress[k][ib[id]], 1e-6); // of some 1e4 Pa
		}
	});
}

TEST(SolverInvariantsTest, EmptySpaceCostsNothingAndBodiesFarApartDoNotFeelEachOther)
{
	for (Analysis analysis : allAnalyses) {
		SCOPED_TRACE(name(analysis));
		const int   dim = dimension(analysis);
		std::size_t bytes[2];
		double      energy[2];
		for (int far = 0; far < 2; ++far) {
			Scene s;
			s.laws                = { Scene::elastic(1e5, .3, 1000) };
			const double distance = far ? 4096. * 1024 : 4096; // whole tiles
			s.addBox(dim, { 0, 0, 0 }, { .5, .5, .5 }, .125);
			const std::size_t half = s.points.count();
			s.addBox(dim, { distance, dim > 1 ? -distance : 0, dim > 2 ? distance : 0 },
				{ distance + .5, dim > 1 ? .5 - distance : 0, dim > 2 ? distance + .5 : 0 }, .125);
			ASSERT_EQ(s.points.count(), 2 * half);
			for (std::size_t p = 0; p < half; ++p)
				s.points.velocity[0][p] = 1 + s.points.position[0][p];
			s.control.dt = .001;
			s.start(analysis, ShapeKind::cubic, .25);
			s.run(20);
			bytes[far] = s.solver->gridBytes(), energy[far] = s.kineticEnergy();
			for (std::size_t p = 0; p < s.points.count(); ++p)
				if (s.points.position[0][p] > 1000) {
					EXPECT_EQ(s.points.velocity[0][p], 0);
				}
		}
		EXPECT_EQ(bytes[0], bytes[1]);
		EXPECT_LT(bytes[1], 1u << 20);
		EXPECT_NEAR(energy[0], energy[1], 1e-12 * energy[0]);
		EXPECT_GT(energy[0], 0);
	}
}

TEST(SolverInvariantsTest, NoPointsNoWork)
{
	Scene s;
	s.laws = { Scene::elastic(1e5, .3, 1000) };
	s.start(Analysis::solid, ShapeKind::cubic, .25);
	s.control.dt = .1;
	s.run(3);
	EXPECT_EQ(s.solver->gridBytes(), 0u);
	EXPECT_TRUE(std::isinf(s.solver->criticalTimeStep(Scheme::musl)));
}

/* Pure PIC smooths velocities and keeps momentum; Cundall's damping takes energy and leaves a body at rest alone. */
TEST(SolverInvariantsTest, PicAndDampingOnlyTakeEnergy)
{
	for (Analysis analysis : allAnalyses) {
		SCOPED_TRACE(name(analysis));
		Held held(agitated(analysis, ShapeKind::cubic, { Scheme::musl }), analysis, ShapeKind::cubic, .25);
		for (Column& c : held.scene.points.stress)
			std::fill(c.begin(), c.end(), 0.);
		held.scene.control.flip = 0;
		const auto   before     = held.scene.momentum();
		const double energy     = held.scene.kineticEnergy();
		held.scene.run(1);
		const auto after = held.scene.momentum();
		for (std::size_t d = 0; d < 3; ++d)
			EXPECT_NEAR(after[d], before[d], 1e-12 * held.scene.mass());
		EXPECT_LT(held.scene.kineticEnergy(), .98 * energy);

		Held free(agitated(analysis, ShapeKind::cubic, { Scheme::musl }), analysis, ShapeKind::cubic, .25);
		Held damped(agitated(analysis, ShapeKind::cubic, { Scheme::musl }), analysis, ShapeKind::cubic, .25);
		damped.scene.control.damping = .5;
		free.scene.run(20), damped.scene.run(20);
		EXPECT_LT(damped.scene.kineticEnergy(), free.scene.kineticEnergy());
	}
}

/* A scene that is moved while it runs goes on with its own points and walls. */
TEST(SceneTest, MovesWithItsSolver)
{
	const auto make = [] {
		Scene s;
		s.laws  = { Scene::elastic(1e6, .3, 1000) };
		s.walls = { Scene::wall(1, 1, 0, Wall::Kind::fixed) };
		s.addBox(2, { 0, 0, 0 }, { 1, 1, 0 }, .125);
		s.control.dt = 1e-3, s.control.gravity = { 0, -10, 0 };
		s.start(Analysis::planeStrain, ShapeKind::cubic, .25);
		s.run(3);
		return s;
	};
	Scene stays = make();
	stays.run(5);
	auto  place = std::make_unique<Scene>(make());
	Scene moved = std::move(*place);
	place.reset();
	moved.run(5);
	EXPECT_TRUE(moved.points.position == stays.points.position);
	EXPECT_TRUE(moved.points.velocity == stays.points.velocity);
	EXPECT_NE(moved.walls[0].force[1], 0);
	EXPECT_EQ(moved.walls[0].force, stays.walls[0].force);
}

} // namespace
