// SPDX-License-Identifier: GPL-2.0-or-later
/* The affine transfer (Rotation.hpp): a free body that spins keeps its angular momentum, that of the points' own rotation counted, and
its stress has the size of rho w^2 R^2; FLIP loses both. A square with R half its side: the mean of von Mises' stress over half a
turn is greatest in its middle, 0.55 rho w^2 R^2 in converged runs of APIC (a disk: (3 + nu)/8 = 0.41). The body starts
without stress, so that the mean has some of the oscillation that follows. */
#include "Scene.hpp"
#include <gtest/gtest.h>

using namespace yade::mpm;

namespace {

using Vector = Eigen::Vector3d;

constexpr double side = .4, density = 1200;

struct Spinning {
	Analysis  analysis = Analysis::planeStress;
	ShapeKind shape    = ShapeKind::cubic;
	int       across   = 10;
	double    young    = 1e6;
	Vector    axis     = { 0, 0, 5 };
	double    part     = .5; // of the stable step
	bool      affine   = true;
	bool      energies = false;
	bool      fullMass = false;
	Scheme    scheme   = Scheme::musl;
	int       threads  = 1;
	Scene     scene {};
	double    cell() const { return 2 * side / across; }

	void start()
	{
		const std::array<double, 3> corner { .137, .271, .091 };
		const int                   dim = dimension(analysis);
		Scene&                      s   = scene;
		s.laws                          = { Scene::elastic(young, .3, density) };
		s.addBox(dim, corner, { corner[0] + side, corner[1] + side, corner[2] + side }, side / across);
		s.setVelocity([&](auto x) {
			const Vector y(x[0] - corner[0] - side / 2, x[1] - corner[1] - side / 2, dim == 3 ? x[2] - corner[2] - side / 2 : 0), v = axis.cross(y);
			return std::array<double, 3> { v[0] + .07, v[1] - .02, dim == 3 ? v[2] + .01 : 0 };
		});
		s.control.affine = affine, s.control.trackEnergy = energies, s.control.fullMass = fullMass, s.control.scheme = scheme;
		s.control.threads = threads;
		s.start(analysis, shape, cell());
		s.control.dt = part * s.solver->criticalTimeStep(scheme, fullMass, affine);
		s.run(1);
	}
	int    stepsOf(double turns) const { return int(2 * std::acos(-1.) * turns / axis.norm() / scene.control.dt); }
	Vector angularMomentum() const
	{
		const Points& P = scene.points;
		Vector        x = Vector::Zero(), v = Vector::Zero(), L = Vector::Zero();
		auto          of = [](const Columns& c, std::size_t p) { return Vector(c[0][p], c[1][p], c[2][p]); };
		for (std::size_t p = 0; p < P.count(); ++p)
			x += P.mass[p] / scene.mass() * of(P.position, p), v += P.mass[p] / scene.mass() * of(P.velocity, p);
		for (std::size_t p = 0; p < P.count(); ++p) {
			const auto carried = scene.solver->rotation(p).momentum;
			L += P.mass[p] * (of(P.position, p) - x).cross(of(P.velocity, p) - v) + Vector(carried[0], carried[1], carried[2]);
		}
		return L;
	}
	/* Runs; returns the change of angular momentum over its first value. */
	double lost(double turns)
	{
		start();
		const Vector before = angularMomentum();
		scene.run(stepsOf(turns));
		return (angularMomentum() - before).norm() / before.norm();
	}
	/* The next half turn: greatest mean of von Mises' stress over rho w^2 R^2. */
	double stress()
	{
		std::vector<double> sum(scene.points.count());
		const int           times = 20, steps = std::max(1, stepsOf(.5) / times);
		for (int k = 0; k < times; ++k) {
			scene.run(steps);
			const auto     at = scene.byId();
			const Columns& s  = scene.points.stress;
			for (std::size_t i = 0; i < at.size(); ++i) {
				const std::size_t p  = at[i];
				double            xx = s[0][p], yy = s[1][p], zz = 0, shear = 0;
				if (s.size() == 3) shear = s[2][p] * s[2][p];
				if (s.size() == 6) zz = s[2][p], shear = s[3][p] * s[3][p] + s[4][p] * s[4][p] + s[5][p] * s[5][p];
				sum[i] += std::sqrt(.5 * ((xx - yy) * (xx - yy) + (yy - zz) * (yy - zz) + (zz - xx) * (zz - xx)) + 3 * shear) / times;
			}
		}
		return *std::max_element(sum.begin(), sum.end()) / (density * axis.squaredNorm() * side * side / 4);
	}
};

TEST(SpinTest, SquareKeepsItsSpinForATurn)
{
	for (ShapeKind shape : { ShapeKind::quadratic, ShapeKind::cubic }) {
		SCOPED_TRACE(name(shape));
		Spinning affine, flip;
		affine.shape = flip.shape = shape, flip.affine = false;
		EXPECT_LT(affine.lost(1), 5e-4);
		EXPECT_LT(affine.stress(), .9);
		EXPECT_GT(flip.lost(1), .2) << "the fault that the affine transfer is there for";
		EXPECT_GT(flip.stress(), 5);
	}
}
/* Points cross cells, which shakes linear functions; the spin stays. */
TEST(SpinTest, LinearAndGimpFunctionsKeepItToo)
{
	for (ShapeKind shape : { ShapeKind::linear, ShapeKind::gimp }) {
		SCOPED_TRACE(name(shape));
		Spinning s;
		s.shape = shape, s.part = .3;
		EXPECT_LT(s.lost(1), 2e-3);
	}
}
TEST(LongSpinTest, StiffSquare)
{
	Spinning s;
	s.young = 1e8, s.across = 20, s.part = .3;
	EXPECT_LT(s.lost(1), 1e-4);
	EXPECT_LT(s.stress(), .7);
}
TEST(LongSpinTest, TwentyTurns)
{
	Spinning s;
	s.across = 12;
	EXPECT_LT(s.lost(20), 5e-3);
	EXPECT_LT(s.stress(), .8);
}
TEST(LongSpinTest, CubeAboutASkewAxis)
{
	Spinning s;
	s.analysis = Analysis::solid, s.across = 8, s.axis = { 3, -2, 3.46 };
	EXPECT_LT(s.lost(1), 1e-3);
	EXPECT_LT(s.stress(), 1);
	Spinning flip;
	flip.analysis = Analysis::solid, flip.across = 8, flip.axis = s.axis, flip.affine = false;
	EXPECT_GT(flip.lost(1), .2);
}
TEST(SpinTest, WithTheMassCorrectionAndWithUSL)
{
	Spinning corrected;
	corrected.fullMass = true;
	EXPECT_LT(corrected.lost(1), 1e-3);
	Spinning usl;
	usl.scheme = Scheme::usl;
	EXPECT_LT(usl.lost(1), 1e-3);
}

/* The energies close, the part of the rotation among them; what the relaxation takes is damping. */
TEST(SpinTest, EnergiesClose)
{
	Spinning s;
	s.energies = true, s.part = .3;
	s.start();
	const Energies before = s.scene.points.energies;
	s.scene.run(s.stepsOf(1));
	const Energies after = s.scene.points.energies;
	EXPECT_NEAR(after.total() / before.total(), 1, 5e-4);
	EXPECT_LT(std::abs(after.damping), 2e-3 * after.kinetic);
	double carried = 0;
	for (std::size_t p = 0; p < s.scene.points.count(); ++p)
		carried += s.scene.solver->rotation(p).energy;
	// J w^2/2 of every point, J = 2/3 m h^2
	EXPECT_NEAR(carried, s.scene.mass() * s.cell() * s.cell() / 3 * 25, 1e-2 * carried);
	EXPECT_NEAR(after.kinetic, s.scene.kineticEnergy() + carried, 1e-3 * after.kinetic);
}

/* The relaxation is for bodies that turn: a cantilever in its first mode keeps its energy for ten periods. With a rate that follows the
spin itself, in place of its mean, it loses 0.7 %. */
TEST(SpinTest, BendingKeepsItsEnergy)
{
	const double length = 1, depth = .2, k = 1.8751, young = 1e6;
	for (ShapeKind shape : { ShapeKind::quadratic, ShapeKind::cubic }) {
		SCOPED_TRACE(name(shape));
		Scene s;
		s.laws = { Scene::elastic(young, .3, density) };
		s.addBox(2, { 0, .1, 0 }, { length, .1 + depth, 0 }, depth / 8);
		s.walls = { Scene::wall(0, 1, 0, Wall::Kind::fixed) };
		s.setVelocity([&](auto x) {
			const double y = k * x[0] / length;
			return std::array<double, 3> { 0, .02 * (std::cosh(y) - std::cos(y) - .7341 * (std::sinh(y) - std::sin(y))), 0 };
		});
		s.control.affine = true, s.control.trackEnergy = true;
		s.start(Analysis::planeStress, shape, depth / 4);
		s.control.dt = .5 * s.solver->criticalTimeStep(Scheme::musl, false, true);
		s.run(1);
		const double before = s.points.energies.total();
		const double period = 2 * std::acos(-1.) / (k * k) * length * length / std::sqrt(young * depth * depth / 12 / density);
		s.run(int(10 * period / s.control.dt));
		EXPECT_LT(std::abs(s.points.energies.damping), 5e-4 * before);
		EXPECT_NEAR(s.points.energies.total(), before, 3e-3 * before);
	}
}

/* A translation has no rotation, and passes as with FLIP. */
TEST(SpinTest, TranslationCarriesNone)
{
	Spinning s;
	s.axis.setZero();
	s.start();
	for (double W : s.scene.points.angularVelocity.front())
		EXPECT_NEAR(W, 0, 1e-12);
}

/* Threads, and a scene that is saved half-way, change no bit. */
TEST(SpinTest, ThreadsAndCopies)
{
	Spinning one, two;
	one.across = two.across = 50, two.threads = 2;
	one.start(), two.start();
	one.scene.run(20), two.scene.run(8);
	Scene loaded = two.scene.copy(two.analysis, two.shape, two.cell());
	loaded.run(12);
	const auto a = one.scene.byId(), b = loaded.byId();
	for (std::size_t i = 0; i < a.size(); ++i) {
		EXPECT_EQ(one.scene.points.angularVelocity[0][a[i]], loaded.points.angularVelocity[0][b[i]]);
		EXPECT_EQ(one.scene.points.position[0][a[i]], loaded.points.position[0][b[i]]);
		EXPECT_EQ(one.scene.points.stress[2][a[i]], loaded.points.stress[2][b[i]]);
	}
}
/* A velocity that is written from outside has its rotation found. */
TEST(SpinTest, VelocitiesFromOutside)
{
	Spinning s; // without stress yet, which would make it vibrate
	s.start();
	s.scene.setVelocity([](auto x) { return std::array<double, 3> { 3 * x[1], -3 * x[0], 0 }; });
	s.scene.points.spinUnknown.assign(s.scene.points.count(), 1);
	s.scene.run(10); // the rotation is found in some steps
	for (double W : s.scene.points.angularVelocity[0])
		EXPECT_NEAR(W, -3, .05);
}

} // namespace
