// SPDX-License-Identifier: GPL-2.0-or-later
/* Contact in place: walls of kind friction, bodies of points against each other, points whose motion is prescribed.

References: the face of a lattice is half a spacing from its outer points. A bar of wave speed c that meets a rigid wall or its
equal with v carries rho c v and is thrown back with v; a block slides with g (sin theta - mu cos theta), sticks where
tan theta < mu; a bar pulled to a stretch lambda bears E ln(lambda); impulses conserve momentum to rounding. */
#include "Scene.hpp"
#include "kernel/boundary/NearestOfHull.hpp"
#include "kernel/boundary/Surface.hpp"
#include <gtest/gtest.h>
#include <random>

using namespace yade::mpm;

namespace {

constexpr double pi = 3.141592653589793;

Wall contact(std::array<double, 3> normal, std::array<double, 3> origin, double friction)
{
	Wall wall;
	wall.kind = Wall::Kind::friction, wall.oblique = true, wall.friction = friction;
	wall.normal = normal, wall.origin = origin;
	return wall;
}
double waveSpeed(const Law& law)
{
	const double E = law.elastic.young, nu = law.elastic.poisson;
	return std::sqrt(E * (1 - nu) / (1 + nu) / (1 - 2 * nu) / law.density);
}
/* Least distance of the points' surfaces from a plane. */
template <int dim> double gapOf(const Scene& s, std::array<double, dim> n, double height)
{
	double least = std::numeric_limits<double>::infinity();
	for (std::size_t p = 0; p < s.points.count(); ++p) {
		const auto lever = leverToSurface<dim>(s.points, p, n);
		double     gap   = -height;
		for (std::size_t d = 0; d < dim; ++d)
			gap += n[d] * (s.points.position[d][p] + s.points.displacementIncrement[d][p] + lever[d]);
		least = std::min(least, gap);
	}
	return least;
}
std::array<double, 3> meanVelocity(const Scene& s, int group = -1)
{
	std::array<double, 3> sum {};
	double                mass = 0;
	for (std::size_t p = 0; p < s.points.count(); ++p) {
		if (group >= 0 && s.points.group[p] != group) continue;
		mass += s.points.mass[p];
		for (std::size_t d = 0; d < 3; ++d)
			sum[d] += s.points.mass[p] * s.points.velocity[d][p];
	}
	for (double& x : sum)
		x /= mass;
	return sum;
}
/* Turns a plane body, with its velocities and lattice, about the origin. */
void turn(Scene& s, double angle)
{
	const double c = std::cos(angle), sn = std::sin(angle);
	for (std::size_t p = 0; p < s.points.count(); ++p)
		for (Columns* field : { &s.points.position, &s.points.velocity }) {
			const double x = (*field)[0][p], y = (*field)[1][p];
			(*field)[0][p] = c * x - sn * y, (*field)[1][p] = sn * x + c * y;
		}
}
void turnLattice(Scene& s, double angle)
{
	for (std::size_t p = 0; p < s.points.count(); ++p) {
		s.points.deformation[0][p] = s.points.deformation[3][p] = std::cos(angle);
		s.points.deformation[1][p] = -std::sin(angle), s.points.deformation[2][p] = std::sin(angle);
	}
}

TEST(ContactInPlaceTest, FallingBlockIsTouchedAtItsFace)
{
	for (ShapeKind shape : allShapes)
		for (int side : { 1, -1 }) {
			SCOPED_TRACE(std::string(name(shape)) + " side " + std::to_string(side));
			const double h = .1;
			Scene        s;
			s.laws           = { Scene::elastic(1e7, 0, 1000) };
			s.walls          = { Scene::wall(1, side, 0, Wall::Kind::friction) };
			const double low = side > 0 ? .13 : -.53;
			s.addBox(2, { .03, low, 0 }, { .43, low + .4, 0 }, h / 2);
			s.setVelocity([&](auto) { return std::array<double, 3> { 0, -1. * side, 0 }; });
			s.control.dt = .2 * h / waveSpeed(s.laws[0]);
			s.start(Analysis::planeStrain, shape, h);
			double first = 9, closest = 9, pulls = 0;
			while (s.control.time < .3) {
				s.step();
				const double gap = gapOf<2>(s, { 0, double(side) }, 0), push = -side * s.walls[0].force[1];
				closest = std::min(closest, gap), pulls = std::min(pulls, push);
				if (push > 1e-9 && first == 9) first = gap;
			}
			EXPECT_LT(std::abs(first), .05 * h);
			EXPECT_LT(std::abs(closest), .05 * h);
			EXPECT_GE(pulls, 0) << "no adhesion";
			EXPECT_GT(side * meanVelocity(s)[1], .7) << "thrown back";
			EXPECT_EQ(s.walls[0].force[1], 0) << "and released";
		}
}

TEST(ContactInPlaceTest, BlockComesToRestOnTheWallWithItsWeight)
{
	for (double damping : { .3, .7 }) {
		SCOPED_TRACE(damping);
		const double h = .1;
		Scene        s;
		s.laws              = { Scene::elastic(1e6, .3, 1000) };
		s.walls             = { Scene::wall(1, 1, 0, Wall::Kind::friction) };
		s.walls[0].friction = .5;
		s.addBox(2, { .03, .04, 0 }, { .43, .44, 0 }, h / 2);
		s.control.dt = .4 * h / waveSpeed(s.laws[0]), s.control.damping = damping, s.control.gravity[1] = -9.81;
		s.start(Analysis::planeStrain, ShapeKind::cubic, h);
		while (s.control.time < 2.5)
			s.step();
		const double weight = 9.81 * s.mass();
		double       sum = 0, most = 0;
		for (int k = 0; k < 200; ++k) {
			s.step();
			sum += -s.walls[0].force[1] / 200;
			most = std::max(most, std::abs(-s.walls[0].force[1] / weight - 1));
		}
		EXPECT_NEAR(sum, weight, 1e-3 * weight);
		EXPECT_LT(most, .05) << "smooth";
		EXPECT_LT(std::abs(gapOf<2>(s, { 0, 1 }, 0)), .05 * h);
		// the torque about the origin is that of the weight at the centre
		EXPECT_NEAR(s.walls[0].torque[2], -.23 * weight, 2e-3 * .23 * weight);
	}
}

/* Level and oblique wall; sticking to the last digit that rounding leaves, and sliding. Settled, then the tangential part of gravity
is switched on; what it sets swinging has died out where the block sticks and averages out where it slides. */
TEST(LongContactInPlaceTest, BlockSticksBelowTheAngleOfFrictionAndSlidesAbove)
{
	for (double slope : { 0., .4, -1.1 }) {
		for (double mu : { .2, .36 }) {
			SCOPED_TRACE("slope " + std::to_string(slope) + " mu " + std::to_string(mu));
			const double theta = std::atan(.35), g = 10, h = .125;
			Scene        s;
			s.laws  = { Scene::elastic(1e6, .3, 1000) };
			s.walls = { contact({ -std::sin(slope), std::cos(slope), 0 }, { 0, 0, 0 }, mu) };
			s.addBox(2, { 0, 0, 0 }, { 1, .5, 0 }, h / 2);
			turn(s, slope);
			auto gravity = [&](double along, double down) {
				s.control.gravity = { along * std::cos(slope) + down * std::sin(slope), along * std::sin(slope) - down * std::cos(slope), 0 };
			};
			s.control.dt = .3 * h / waveSpeed(s.laws[0]), s.control.damping = .5;
			gravity(0, g * std::cos(theta));
			s.start(Analysis::planeStrain, ShapeKind::cubic, h);
			turnLattice(s, slope);
			s.run(500);
			gravity(g * std::sin(theta), g * std::cos(theta));
			if (mu > std::tan(theta)) {
				s.run(1500);
				s.control.damping   = 0;
				const auto   before = s.points.position;
				const auto   ids    = s.points.id;
				const double time   = s.control.time;
				s.run(500);
				double moved = 0;
				for (std::size_t p = 0; p < s.points.count() && ids == s.points.id; ++p)
					moved = std::max(moved, std::abs(s.points.position[0][p] - before[0][p]));
				EXPECT_LT(moved, 1e-4 * .5 * g * std::sin(theta) * std::pow(s.control.time - time, 2));
			} else {
				s.control.damping = 0;
				auto along        = [&] {
                                        const auto v = meanVelocity(s);
                                        return v[0] * std::cos(slope) + v[1] * std::sin(slope);
				};
				s.run(300);
				const double v0 = along(), t0 = s.control.time;
				s.run(900);
				EXPECT_NEAR((along() - v0) / (s.control.time - t0), g * (std::sin(theta) - mu * std::cos(theta)), .02 * g * std::sin(theta));
			}
		}
	}
}

/* Walls that meet: at rest they take energy and give none, whatever the friction, in any order; very great friction is stable. */
TEST(LongContactInPlaceTest, CornersOfFrictionWallsGiveNoEnergy)
{
	for (int dim : { 2, 3 })
		for (double mu : { .3, 10., 1e6 }) {
			SCOPED_TRACE(std::to_string(dim) + "D mu " + std::to_string(mu));
			const double       h = .25;
			std::vector<Scene> scenes(2);
			for (int order : { 0, 1 }) {
				Scene& s = scenes[std::size_t(order)];
				s.laws   = { Scene::elastic(1e7, .3, 1000) };
				for (int d = 0; d < dim; ++d) {
					s.walls.push_back(Scene::wall(order ? dim - 1 - d : d, 1, 0, Wall::Kind::friction));
					s.walls.back().friction           = mu;
					s.control.gravity[std::size_t(d)] = -10;
				}
				s.addBox(dim, { 0, 0, 0 }, { 1, 1, 1 }, h / 2);
				s.control.dt = .4 * h / waveSpeed(s.laws[0]), s.control.damping = .3, s.control.trackEnergy = true;
				s.start(dim == 3 ? Analysis::solid : Analysis::planeStrain, ShapeKind::cubic, h);
				double least = 0, fastest = 0;
				for (int k = 0; k < (dim == 3 ? 400 : 1500); ++k) {
					s.step();
					least = std::min(least, s.points.energies.walls);
					for (const double v : s.points.velocity[0])
						fastest = std::max(fastest, std::abs(v));
				}
				EXPECT_GE(least, -1e-6 * s.points.energies.elastic);
				EXPECT_LT(fastest, .2);
			}
			EXPECT_TRUE(scenes[0].points.position == scenes[1].points.position) << "any order, the same bits";
			if (dim == 3) continue;
			std::array<double, 3> sum {};
			for (const Wall& wall : scenes[0].walls)
				for (std::size_t d = 0; d < 3; ++d)
					sum[d] += wall.force[d];
			for (std::size_t d = 0; d < 2; ++d)
				EXPECT_NEAR(sum[d], -10 * scenes[0].mass(), 5e-3 * 10 * scenes[0].mass());
		}
}

/* A segment: a block that stands half on it is carried, beside it falls free; and the edge itself is touched from beside. */
TEST(ContactInPlaceTest, ExtentEndsTheWall)
{
	const double h = .1;
	for (double x : { -.2, .31 }) {
		SCOPED_TRACE(x);
		Scene s;
		s.laws            = { Scene::elastic(1e6, .3, 1000) };
		s.walls           = { contact({ 0, 1, 0 }, { 0, 0, 0 }, .5) };
		s.walls[0].extent = { .3 };
		s.addBox(2, { x, 0, 0 }, { x + .4, .4, 0 }, h / 2);
		s.control.dt = .4 * h / waveSpeed(s.laws[0]), s.control.gravity[1] = -9.81;
		s.start(Analysis::planeStrain, ShapeKind::cubic, h);
		while (s.control.time < .1)
			s.step();
		if (x < 0)
			EXPECT_GT(meanVelocity(s)[1], -.1);
		else
			EXPECT_NEAR(meanVelocity(s)[1], -9.81 * s.control.time, 1e-9);
	}
	Scene s; // flies against the edge of a plate that stands on end
	s.laws            = { Scene::elastic(1e6, 0, 1000) };
	s.walls           = { contact({ 0, 1, 0 }, { 1, .2, 0 }, 0) };
	s.walls[0].extent = { .3 };
	s.addBox(2, { .2, 0, 0 }, { .6, .4, 0 }, h / 2);
	s.setVelocity([](auto) { return std::array<double, 3> { 1, 0, 0 }; });
	s.control.dt = .3 * h / waveSpeed(s.laws[0]);
	s.start(Analysis::planeStrain, ShapeKind::cubic, h);
	while (s.control.time < .09)
		s.step();
	EXPECT_EQ(s.walls[0].force[0], 0) << "the face is .01 m before the edge";
	while (s.control.time < .12)
		s.step();
	EXPECT_GT(s.walls[0].force[0], 0);
}

/* A wall that turns about the origin takes a block along: the velocity of a rigid body there. */
TEST(ContactInPlaceTest, TurningWallCarriesABlock)
{
	const double h = .1, w = .2;
	Scene        s;
	s.laws                     = { Scene::elastic(1e6, .3, 1000) };
	s.walls                    = { contact({ 0, 1, 0 }, { 0, 0, 0 }, 1) };
	s.walls[0].angularVelocity = { 0, 0, w };
	s.addBox(2, { 1, 0, 0 }, { 1.4, .4, 0 }, h / 2);
	s.setVelocity([&](auto x) { return std::array<double, 3> { -w * x[1], w * x[0], 0 }; });
	s.control.dt = .4 * h / waveSpeed(s.laws[0]), s.control.gravity[1] = -9.81;
	s.start(Analysis::planeStrain, ShapeKind::cubic, h);
	double angle = 0;
	while (s.control.time < .5) {
		s.step();
		angle += w * s.control.dt;
		s.walls[0].normal = { -std::sin(angle), std::cos(angle), 0 };
	}
	s.solver->finish();
	const double rise = s.points.position[1][s.byId()[0]] - .025; // of the point that began at (1.025, 0.025) m
	EXPECT_LT(std::abs(gapOf<2>(s, { -std::sin(angle), std::cos(angle) }, 0)), .05 * h);
	EXPECT_NEAR(rise, 1.025 * std::sin(angle), .02 * std::sin(angle));
}

/* A wall beside a mirror: the mirror takes what the contact's impulses leave there. */
TEST(ContactInPlaceTest, MomentumIsThatOfWallsAndGravity)
{
	for (Analysis analysis : { Analysis::planeStrain, Analysis::solid })
		for (Wall::Kind kind : { Wall::Kind::fixed, Wall::Kind::slip }) {
			Scene s;
			s.laws                 = { Scene::elastic(1e5, .3, 1000) };
			s.walls                = { contact({ .6, .8, 0 }, { 0, 0, 0 }, .4), Scene::wall(1, -1, 1, kind) };
			s.walls[1].velocity[0] = .3;
			s.addBox(dimension(analysis), { 0, .0625, 0 }, { 1, 1, .5 }, .125);
			std::mt19937                           random(5);
			std::uniform_real_distribution<double> uniform(-1, 1);
			s.setVelocity([&](auto) { return std::array<double, 3> { -1 + uniform(random), -1 + uniform(random), 0 }; });
			s.control.dt = .1 * .25 / 12, s.control.gravity = { 0, -10, 0 };
			s.start(analysis, ShapeKind::cubic, .25);
			double acting = 0;
			for (int k = 0; k < 40; ++k) {
				const auto before = s.momentum();
				s.step();
				const auto after = s.momentum();
				for (std::size_t d = 0; d < 3; ++d) {
					const double walls = s.walls[0].force[d] + s.walls[1].force[d];
					acting             = std::max(acting, std::abs(s.walls[0].force[d]));
					ASSERT_NEAR((after[d] - before[d]) / s.control.dt, s.mass() * s.control.gravity[d] - walls, 1e-9 * 1e5)
						<< k << ' ' << d;
				}
			}
			EXPECT_GT(acting, 100);
		}
}

TEST(ContactInPlaceTest, ThreadsGiveTheSameBits)
{
	std::vector<Scene> scenes(2);
	for (int k : { 0, 1 }) {
		Scene& s                = scenes[std::size_t(k)];
		s.laws                  = { Scene::elastic(1e6, .3, 1000) };
		s.laws[0].frictionAngle = .3;
		s.walls                 = { contact({ 0, 1, 0 }, { 0, 0, 0 }, .4), contact({ .8, .6, 0 }, { -.1, 0, 0 }, .2) };
		s.addBox(2, { 0, 0, 0 }, { 1.5, .5, 0 }, .0125);
		const std::size_t half = s.points.count();
		s.addBox(2, { .2, .5, 0 }, { .9, .8, 0 }, .0125);
		s.points.group.assign(s.points.count(), 1);
		std::fill(s.points.group.begin() + std::ptrdiff_t(half), s.points.group.end(), 2);
		s.setVelocity([](auto x) { return std::array<double, 3> { -1, x[1] > .5 ? -2. : -.5, 0 }; });
		s.control.dt = .3 * .025 / waveSpeed(s.laws[0]), s.control.gravity = { 0, -10, 0 }, s.control.threads = k ? 3 : 1;
		s.start(Analysis::planeStrain, ShapeKind::cubic, .025);
		s.run(60);
	}
	EXPECT_GT(scenes[0].points.contactForces.size(), 50u);
	EXPECT_TRUE(scenes[0].points.velocity == scenes[1].points.velocity);
	EXPECT_TRUE(scenes[0].points.stress == scenes[1].points.stress);
}

/* The reach of points takes the place of their size: a disk touches in all directions at its radius. */
TEST(ContactInPlaceTest, ReachIsTheSurfaceOfACurvedBody)
{
	const double h = .1, R = .5;
	for (double direction : { 0., .3, .7, 1.2 }) {
		Scene s;
		s.laws = { Scene::elastic(1e6, .3, 1000) };
		s.addBox(2, { -R, -R, 0 }, { R, R, 0 }, h / 2);
		std::vector<std::size_t> inside;
		for (std::size_t p = 0; p < s.points.count(); ++p)
			if (std::hypot(s.points.position[0][p], s.points.position[1][p]) < R) inside.push_back(p);
		s.points.select(inside);
		s.start(Analysis::planeStrain, ShapeKind::cubic, h);
		s.points.reach.assign(s.points.count(), 0);
		for (std::size_t p = 0; p < s.points.count(); ++p) {
			const double depth = R - std::hypot(s.points.position[0][p], s.points.position[1][p]);
			if (depth < .6 * h) s.points.reach[p] = std::max(depth, 1e-3);
		}
		EXPECT_NEAR(gapOf<2>(s, { std::cos(direction), std::sin(direction) }, -R), 0, .01 * h);
	}
}

TEST(NearestOfHullTest, FacesEdgesAndCorners)
{
	using Hull = NearestOfHull<3>;
	using V    = Hull::Vector;
	std::mt19937                           random(7);
	std::uniform_real_distribution<double> uniform(-1, 1);
	for (int trial = 0; trial < 300; ++trial) {
		std::vector<V> places;
		for (int k = 0; k < 12; ++k)
			places.push_back(V(uniform(random), uniform(random), 1.5 + uniform(random)));
		if (trial % 3 == 0)
			for (V& y : places)
				y[2] = std::round(y[2] * 2) / 2 + .5; // flat layers
		const Hull hull(places);
		V          sum = V::Zero();
		double     one = 0;
		for (std::size_t k = 0; k < hull.corners.size(); ++k) {
			sum += hull.weights[k] * places[hull.corners[k]], one += hull.weights[k];
			EXPECT_GE(hull.weights[k], 0);
		}
		EXPECT_NEAR(one, 1, 1e-12);
		EXPECT_NEAR((sum - hull.nearest).norm(), 0, 1e-12);
		for (const V& y : places) // no place of the hull lies before the plane through the nearest one
			EXPECT_GE(y.dot(hull.nearest), hull.nearest.squaredNorm() - 1e-9);
	}
}

/* Two bars, a lattice that does and one that does not match, equal and unequal. */
TEST(LongContactInPlaceTest, BarsExchangeTheirVelocitiesAndPart)
{
	for (double shift : { 0., .3 }) {
		SCOPED_TRACE(shift);
		const double spacing = .025, h = 2 * spacing, length = 1;
		Scene        s;
		s.laws = { Scene::elastic(1e6, 0, 1000) };
		s.addBox(2, { 0, 0, 0 }, { length, 4 * spacing, 0 }, spacing);
		const std::size_t half = s.points.count();
		s.addBox(2, { length + .01, shift * spacing, 0 }, { 2 * length + .01, (4 + shift) * spacing, 0 }, spacing);
		s.points.group.assign(s.points.count(), 1);
		std::fill(s.points.group.begin() + std::ptrdiff_t(half), s.points.group.end(), 2);
		s.setVelocity([&](auto x) { return std::array<double, 3> { x[0] < length ? 1. : 0., 0, 0 }; });
		const auto before = s.momentum();
		s.control.dt      = .3 * h / waveSpeed(s.laws[0]);
		s.start(Analysis::planeStrain, ShapeKind::cubic, h);
		while (s.control.time < .02 + 3 * length / waveSpeed(s.laws[0]))
			s.step();
		const auto after = s.momentum();
		EXPECT_NEAR(meanVelocity(s, 1)[0], 0, .05);
		EXPECT_NEAR(meanVelocity(s, 2)[0], 1, .05);
		EXPECT_TRUE(s.points.contactForces.empty()) << "they have parted";
		for (std::size_t d = 0; d < 2; ++d)
			EXPECT_NEAR(after[d] - before[d], 0, 1e-12 * s.mass());
	}
}

TEST(ContactInPlaceTest, GroupsThatOverlapAreNamedWithTheirDepth)
{
	for (double depth : { .02, .05 }) {
		Scene s;
		s.laws = { Scene::elastic(1e6, 0, 1000) };
		s.addBox(2, { 0, 0, 0 }, { 1, .2, 0 }, .05);
		const std::size_t half = s.points.count();
		s.addBox(2, { 1 - depth, 0, 0 }, { 2 - depth, .2, 0 }, .05);
		s.points.group.assign(s.points.count(), 1);
		std::fill(s.points.group.begin() + std::ptrdiff_t(half), s.points.group.end(), 2);
		s.control.dt = 1e-4;
		s.start(Analysis::planeStrain, ShapeKind::cubic, .1);
		try {
			s.step();
			ADD_FAILURE() << "not refused";
		} catch (const StepFailure& failure) {
			const std::string text = failure.what();
			EXPECT_NE(text.find("overlap by " + std::to_string(depth)), std::string::npos) << text;
			EXPECT_NE(text.find("group 1"), std::string::npos) << text;
			EXPECT_NE(text.find("group 2"), std::string::npos) << text;
		}
	}
}

/* A bar between a fixed wall and columns of points that are pulled: its force, the same at both ends, and the balance of energies. */
TEST(LongContactInPlaceTest, PrescribedPointsPullTheMaterial)
{
	for (ShapeKind shape : allShapes)
		for (int columns : { 1, 2 }) {
			SCOPED_TRACE(std::string(name(shape)) + ' ' + std::to_string(columns));
			const double spacing = .025, young = 1e5;
			Scene        s;
			s.laws  = { Scene::elastic(young, 0, 1000) };
			s.walls = { Scene::wall(0, 1, 0, Wall::Kind::fixed) };
			s.addBox(2, { 0, 0, 0 }, { .5, .1, 0 }, spacing);
			s.points.prescribedDofs.assign(s.points.count(), 0);
			for (std::size_t p = 0; p < s.points.count(); ++p)
				if (s.points.position[0][p] > .5 - columns * spacing) s.points.prescribedDofs[p] = 3, s.points.velocity[0][p] = .01;
			s.control.damping = .2, s.control.trackEnergy = true, s.control.dt = .3 * 2 * spacing / waveSpeed(s.laws[0]);
			s.start(Analysis::planeStrain, shape, 2 * spacing);
			double damping = 0;
			while (s.control.time < .5)
				s.step(), damping = std::min(damping, s.points.energies.damping);
			s.solver->finish();
			const double pulled = .01 * s.control.time;
			for (std::size_t p = 0; p < s.points.count(); ++p)
				if (s.points.prescribedDofs[p]) s.points.velocity[0][p] = 0;
			s.run(2000);
			const double exact    = young * .1 * std::log(1 + pulled / (.5 - (columns - .5) * spacing));
			double       reaction = 0;
			for (const SurfaceForce& f : s.points.reactions)
				reaction -= f.force[0];
			EXPECT_NEAR(s.walls[0].force[0], exact, (shape == ShapeKind::linear ? .05 : .025) * exact); // a half, a quarter of a cell in length
			EXPECT_NEAR(s.walls[0].force[0] + reaction, 0, 1e-3 * exact);
			EXPECT_GE(damping, 0);
			if (shape == ShapeKind::cubic || shape == ShapeKind::quadratic) {
				EXPECT_NEAR(s.points.energies.total(), 0, 2e-3 * s.points.energies.elastic);
			}
		}
}

} // namespace
