// SPDX-License-Identifier: GPL-2.0-or-later
/* Numerical fracture: found where bodies tear, and nowhere else. Gaps in cells; measured in whole bodies: 0.01 between disks that collide, 0.06 in a
bar drawn to four times its length, 0.15 in the soft cantilever, 0.27 in Taylor's bar. A tear leaves two cells behind at once. */
#include "kernel/Continuity.hpp"
#include "Manufactured.hpp"
#include <gtest/gtest.h>

using namespace yade::mpm;

namespace {

struct Watched {
	Scene      scene;
	double     h = 0;
	Continuity continuity;

	double gap() { return continuity.widest(scene.points, scene.laws, scene.walls).opening / h; }
	/* The widest gap in this many steps, looked at every few of them, or the one beyond the limit. */
	double run(int steps, int every, double limit = HUGE_VAL, const std::function<void()>& between = {})
	{
		double worst = gap();
		for (int k = 1; k <= steps && worst <= limit; ++k) {
			if (between) between();
			scene.step();
			if (k % every == 0) worst = std::max(worst, gap());
		}
		return worst;
	}
	void check() { continuity.check(scene.points, scene.laws, scene.walls, h, 2 * h, scene.control.time); }
};

/* V7, the vertical bar of Sadeghirad, Brannon & Burghardt, Int. J. Numer. Meth. Engng 86 (2011) 1435: a cube of 1 m, E = 1 MPa, hung up and
drawn out by 1000 m/s2. */
Watched verticalBar(ShapeKind shape)
{
	Watched w;
	Scene&  s = w.scene;
	w.h       = .5;
	s.laws    = { Scene::elastic(1e6, .3, 1050) };
	s.walls   = { Scene::wall(1, -1, 1, Wall::Kind::fixed) };
	s.addBox(2, { 0, 0, 0 }, { 1, 1, 0 }, w.h / 2);
	s.start(Analysis::planeStrain, shape, w.h);
	s.control.dt = .005, s.control.gravity = { 0, -1000, 0 };
	return w;
}
/* V6, the soft cantilever of the same paper, with nine points a cell. */
Watched cantilever(double h)
{
	Watched w;
	Scene&  s = w.scene;
	w.h       = h;
	s.laws    = { Scene::elastic(1e6, .3, 1050) };
	s.walls   = { Scene::wall(0, 1, 0, Wall::Kind::fixed) };
	s.addBox(2, { 0, 0, 0 }, { 4, 1, 0 }, h / 3);
	s.start(Analysis::planeStrain, ShapeKind::cubic, h);
	s.control.dt = .02 * h, s.control.gravity = { 0, -10, 0 };
	return w;
}

TEST(ContinuityTest, VerticalBarIsDrawnOut)
{
	for (ShapeKind shape : allShapes) {
		SCOPED_TRACE(name(shape));
		Watched w = verticalBar(shape);
		EXPECT_GT(w.run(50, 1, 2), 2);
		double lowest = 0;
		for (double y : w.scene.points.position[1])
			lowest = std::min(lowest, y);
		EXPECT_GT(lowest, -3) << "found before it falls: the torn bar has come down to -20 m in the end";
	}
}

TEST(ContinuityTest, SaysWhichPointsWhereAndWhatToDo)
{
	Watched w = verticalBar(ShapeKind::quadratic);
	w.run(50, 1, 2);
	const Columns x = w.scene.points.position;
	try {
		w.check();
		ADD_FAILURE() << "nothing is said";
	} catch (const StepFailure& e) {
		const std::string text = e.what();
		EXPECT_GE(e.id, 0);
		for (const char* part : { "material point ", "its neighbour ", "come apart", "time 0.", "position (", "cells", "larger cells", "largestGap" })
			EXPECT_NE(text.find(part), std::string::npos) << part << ": " << text;
	}
	EXPECT_TRUE(w.scene.points.position == x);
	w.scene.run(3); // whoever wants to may go on
}

TEST(ContinuityTest, CantileverTearsOffItsClamp)
{
	Watched torn = cantilever(.125);
	EXPECT_GT(torn.run(1200, 10, 2), 2);
	EXPECT_NEAR(torn.scene.control.time, 1, .2) << "while the beam still looks well";
	EXPECT_EQ(torn.continuity.widest(torn.scene.points, torn.scene.laws, torn.scene.walls).q, std::size_t(-1)) << "from the wall";
	try {
		torn.check();
		ADD_FAILURE() << "nothing is said";
	} catch (const StepFailure& e) {
		EXPECT_NE(std::string(e.what()).find("the fixed wall beside it"), std::string::npos) << e.what();
	}
	EXPECT_LT(cantilever(.5).run(300, 10), .25);
}

/* A plastic bar drawn to four times its length: with eight points a cell no neighbour has lost the other, with four, a cell apart in the
end, it tears. */
TEST(ContinuityTest, StretchIsNoFracture)
{
	for (ShapeKind shape : { ShapeKind::quadratic, ShapeKind::cubic })
		for (int points : { 8, 4 }) {
			SCOPED_TRACE(std::string(name(shape)) + ' ' + std::to_string(points));
			Watched w;
			Scene&  s               = w.scene;
			Law     law             = Scene::elastic(1e6, 0, 1000);
			law.model               = J2();
			as<J2>(law).yieldStress = 1e4, as<J2>(law).isotropic.modulus = 3e4;
			w.h                 = 1. / 16;
			s.laws              = { law };
			s.walls             = { Scene::wall(0, 1, 0, Wall::Kind::fixed), Scene::wall(0, -1, 1, Wall::Kind::fixed) };
			s.walls[1].velocity = { 3, 0, 0 };
			s.addBox(1, { 0, 0, 0 }, { 1, 0, 0 }, w.h / points);
			s.setVelocity([](auto x) { return std::array<double, 3> { 3 * x[0], 0, 0 }; });
			s.start(Analysis::uniaxial, shape, w.h);
			s.control.dt       = 2.5e-4;
			const double worst = w.run(4000, 50, HUGE_VAL, [&] { s.walls[1].position += s.walls[1].velocity[0] * s.control.dt; });
			if (points == 4) {
				EXPECT_GT(worst, 2);
				continue;
			}
			EXPECT_LT(worst, .1);
			EXPECT_NEAR(s.points.deformation[0][s.byId()[64]], 4, .05);
		}
}

Scene disks(double h)
{
	Scene s;
	s.laws = { Scene::elastic(1000, .3, 1000) };
	s.addBox(2, { 0, 0, 0 }, { 1, 1, 0 }, h / 2);
	std::vector<std::size_t> kept;
	for (std::size_t p = 0; p < s.points.count(); ++p)
		for (const double centre : { .2, .8 }) {
			if (std::hypot(s.points.position[0][p] - centre, s.points.position[1][p] - centre) >= .2) continue;
			kept.push_back(p);
			s.points.velocity[0][p] = s.points.velocity[1][p] = centre < .5 ? .1 : -.1;
		}
	s.points.select(kept);
	s.control.dt = 1e-3;
	return s;
}

/* V5: disks that touch and part again were never neighbours. */
TEST(ContinuityTest, BodiesPartAgain)
{
	Watched w { disks(.05), .05, {} };
	w.scene.start(Analysis::planeStrain, ShapeKind::cubic, w.h);
	EXPECT_LT(w.run(3500, 50), .05);
}

TEST(LongContinuityTest, TaylorsBar)
{
	Watched      w;
	Scene&       s          = w.scene;
	const double R          = 3.2e-3;
	Law          law        = Scene::elastic(117e9, .35, 8930);
	w.h                     = R / 6;
	law.model               = J2();
	as<J2>(law).yieldStress = 400e6, as<J2>(law).isotropic.modulus = 100e6;
	s.laws  = { law };
	s.walls = { Scene::wall(1, 1, 0, Wall::Kind::slip), Scene::wall(0, 1, 0, Wall::Kind::slip) };
	s.addBox(2, { 0, 0, 0 }, { R, 32.4e-3, 0 }, w.h / 2, true);
	s.setVelocity([](auto) { return std::array<double, 3> { 0, -227, 0 }; });
	s.start(Analysis::axisymmetric, ShapeKind::cubic, w.h);
	s.control.dt = 3.2e-8;
	EXPECT_LT(w.run(2500, 50), .4);
	double stretch = 0;
	for (double F : s.points.deformation[0])
		stretch = std::max(stretch, F);
	EXPECT_GT(stretch, 4);
}

/* Points are known by their ids: sorted anew, erased, joined by others; a body that is met stretched counts as whole. */
TEST(ContinuityTest, FollowsPointsThroughTheArrays)
{
	Watched w;
	Scene&  s = w.scene;
	w.h       = .25;
	s.laws    = { Scene::elastic(1e6, .3, 1000) };
	s.addBox(3, { 0, 0, 0 }, { 1, 1, 1 }, .125);
	s.start(Analysis::solid, ShapeKind::cubic, w.h);
	for (std::size_t p = 0; p < s.points.count(); ++p) {
		s.points.id[p]             = p % 2 ? int(3 * p) : -int(p) - 1;
		s.points.deformation[0][p] = 1.4, s.points.position[0][p] *= 1.4;
	}
	EXPECT_LT(w.gap(), 1e-7);
	std::vector<std::size_t> order;
	for (std::size_t p = 0; p < s.points.count(); ++p)
		if (p % 5) order.push_back(s.points.count() - 1 - p);
	s.points.select(order);
	EXPECT_LT(w.gap(), 1e-7);
	const std::size_t at = 100;
	s.points.position[1][at] += .3;
	EXPECT_NEAR(w.gap(), .3 / w.h, .2 / w.h);
	w.continuity.forget();
	EXPECT_LT(w.gap(), 1e-7) << "put there by hand";
	const double x[3] { 9, 9, 9 }, v[3] {};
	s.points.append(7000, 0, x, v, 1, 1, .125, 0);
	s.points.prepare(3, 6, 0, false, false, false, false);
	EXPECT_LT(w.gap(), 1e-7);
	s.laws[0].model = DruckerPrager();
	w.continuity.forget();
	w.gap(); // leaves out the law with a tension cut-off
	s.points.position[1][at] += 1;
	EXPECT_EQ(w.gap(), 0) << "soil may separate";
}

} // namespace
