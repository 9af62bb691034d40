// SPDX-License-Identifier: GPL-2.0-or-later
/* A step that cannot go on says which point, where, when and what to do; the points are whole, and a scene that has been
put right goes on. */
#include "Scene.hpp"
#include <gtest/gtest.h>

using namespace yade::mpm;

namespace {

Scene block(Analysis analysis = Analysis::planeStrain)
{
	Scene s;
	s.laws  = { Scene::elastic(1e5, .3, 1000) };
	s.walls = { Scene::wall(0, 1, 0, Wall::Kind::slip) };
	s.addBox(dimension(analysis), { 0, 0, 0 }, { 1, 1, 1 }, .125);
	s.control.dt = .001;
	return s;
}
void makeSound(Scene& s)
{
	for (int d = 0; d < 3; ++d)
		for (double& v : s.points.velocity[std::size_t(d)])
			if (!std::isfinite(v) || std::abs(v) > 100) v = 0;
}
bool sound(Scene& s)
{
	bool good = true;
	s.points.forEachColumn([&](Column& c) {
		for (double x : c)
			good = good && std::isfinite(x);
	});
	return good;
}
/* The failure of a step, or of what follows it. */
std::string failure(Scene& s, int steps, int& id)
{
	try {
		s.run(steps);
	} catch (const StepFailure& e) {
		id = e.id;
		return e.what();
	}
	return "";
}
void expectSays(const std::string& text, std::initializer_list<const char*> words)
{
	for (const char* word : words)
		EXPECT_NE(text.find(word), std::string::npos) << "'" << word << "' is missing in: " << text;
}

/* As in a scene that was saved before a step that cannot be made: its first step looks for the stable step and finds the fault there. */
TEST(FailureTest, TheSearchForTheStableStepKnowsTheTime)
{
	Scene s = block();
	s.start(Analysis::planeStrain, ShapeKind::cubic, .25);
	s.points.position[0][5] = -1; // behind the wall
	s.solver->pointsChanged();
	s.control.time = 2.5;
	try {
		s.solver->criticalTimeStep(s.control);
		FAIL() << "a point behind a wall was accepted";
	} catch (const StepFailure& fault) {
		expectSays(fault.what(), { "has left the walls", "at time 2.5 s" });
	}
}

TEST(FailureTest, NonFiniteVelocityFromOutside)
{
	for (Scheme scheme : allSchemes)
		for (double value : { std::nan(""), HUGE_VAL }) {
			Scene s          = block();
			s.control.scheme = scheme;
			s.start(Analysis::planeStrain, ShapeKind::cubic, .25);
			s.run(3);
			const std::size_t at     = 37;
			const double      kept   = s.points.velocity[1][at];
			const Columns     x      = s.points.position;
			s.points.velocity[1][at] = value;
			s.solver->pointsChanged();
			int               id   = -1;
			const std::string text = failure(s, 1, id);
			EXPECT_EQ(id, s.points.id[at]);
			expectSays(
				text, { ("material point " + std::to_string(id) + " ").c_str(), "non-finite", "time 0.003", "position (", "cell (", "O.dt" });
			EXPECT_TRUE(s.points.position == x) << "nothing has moved";
			s.points.velocity[1][at] = kept;
			EXPECT_TRUE(sound(s));
			s.run(20);
			EXPECT_TRUE(sound(s));
			EXPECT_NE(s.control.time, .003);
		}
}

TEST(FailureTest, ForceThatIsNotANumber)
{
	for (Scheme scheme : allSchemes) {
		Scene s          = block();
		s.control.scheme = scheme;
		s.start(Analysis::planeStrain, ShapeKind::cubic, .25, true);
		s.run(2);
		s.points.force[0][11]  = std::nan("");
		int               id   = -1;
		const std::string text = failure(s, 1, id);
		expectSays(text, { "material point", "non-finite", "time 0.002" });
		EXPECT_GE(id, 0);
	}
}

TEST(FailureTest, PointLeavesTheWalls)
{
	for (Scheme scheme : allSchemes) {
		SCOPED_TRACE(name(scheme));
		Scene s          = block();
		s.control.scheme = scheme;
		s.start(Analysis::planeStrain, ShapeKind::cubic, .25);
		s.run(3);
		std::size_t at = 0;
		for (std::size_t p = 0; p < s.points.count(); ++p)
			if (s.points.position[0][p] < s.points.position[0][at]) at = p;
		s.points.prescribedDofs.assign(s.points.count(), 0);
		s.points.prescribedDofs[at] = 1, s.points.velocity[0][at] = -80; // told to go through
		int               id   = -1;
		const std::string text = failure(s, 1, id);
		EXPECT_EQ(id, s.points.id[at]);
		expectSays(text, { ("material point " + std::to_string(id) + " ").c_str(), "left the walls", "time 0.003", "cell (-1, " });
		EXPECT_TRUE(sound(s)) << "whole, and can be saved";
		// put right: the step is completed, the point goes back
		s.solver->finish();
		EXPECT_LT(s.points.position[0][at], 0);
		s.points.position[0][at] = .01, s.points.velocity[0][at] = 0, s.points.prescribedDofs.clear();
		makeSound(s);
		s.solver->pointsChanged();
		s.run(20);
		EXPECT_TRUE(sound(s));
	}
}

TEST(FailureTest, PointOutsideTheWallsAtTheStart)
{
	Scene s                 = block();
	s.points.position[0][9] = -.3;
	s.start(Analysis::planeStrain, ShapeKind::cubic, .25);
	int id = -1;
	expectSays(failure(s, 1, id), { "material point 9 ", "left the walls", "time 0 s" });
	EXPECT_EQ(id, 9);
	s.points.position[0][9] = .3;
	s.run(3);
	EXPECT_THROW((s.points.position[0][9] = -.3, s.solver->pointsChanged(), s.solver->criticalTimeStep(Scheme::musl)), StepFailure);
}

TEST(FailureTest, TooFarForTheGrid)
{
	Scene s                 = block();
	s.points.position[1][9] = 1e12;
	s.start(Analysis::planeStrain, ShapeKind::cubic, .25);
	int id = -1;
	expectSays(failure(s, 1, id), { "material point 9 ", "too far" });
}

TEST(FailureTest, VolumeThatIsNotPositive)
{
	for (Analysis analysis : allAnalyses)
		for (Scheme scheme : allSchemes)
			for (bool atFinish : { false, true }) {
				SCOPED_TRACE(std::string(name(analysis)) + ' ' + name(scheme));
				Scene s          = block(analysis);
				s.control.scheme = scheme;
				s.walls.clear();
				s.start(analysis, ShapeKind::cubic, .25);
				s.run(2);
				const auto sane = s.points.velocity;
				s.setVelocity([](auto x) { return std::array<double, 3> { -4000 * (x[0] - .5), 0, 0 }; }); // folds over: F = -3
				int         id = -1;
				std::string text;
				if (atFinish)
					text = failure(s, 1, id);
				else {
					try {
						s.step();
						s.control.dt = 1e-9;
						s.step();
					} catch (const StepFailure& e) {
						text = e.what(), id = e.id;
					}
				}
				expectSays(text,
					{ ("material point " + std::to_string(id) + " ").c_str(), "volume that is not positive", "time 0.00", "reduce O.dt" });
				EXPECT_TRUE(sound(s));
				// undo what has been done
				for (std::size_t k = 0; k < s.points.deformation.size(); ++k)
					s.points.deformation[k].assign(s.points.count(), k % std::size_t(dimension(analysis) + 1) == 0);
				for (Column& c : s.points.stress)
					c.assign(s.points.count(), 0);
				s.points.velocity = sane;
				s.control.dt      = .001;
				for (std::size_t p = 0; p < s.points.count(); ++p)
					s.points.position[0][p] = .0625 + .125 * double(s.points.id[p] % 8);
				s.solver->pointsChanged();
				s.run(20);
				EXPECT_TRUE(sound(s));
				EXPECT_LT(s.kineticEnergy(), 1e-6);
			}
}

/* Sheared by its own size and more in a step. A law with sub-steps would follow for long, and nobody could use what comes out. */
TEST(FailureTest, DeformedBeyondMeasureInAStep)
{
	for (Scheme scheme : allSchemes)
		for (bool mixed : { false, true }) { // blocks of one material, and of two
			SCOPED_TRACE(std::string(name(scheme)) + (mixed ? " mixed" : ""));
			Scene s          = block(Analysis::planeStrain);
			s.laws           = { Scene::boucWen(1e6, .3, 1000, 1e4, 25, 0), Scene::elastic(1e6, .3, 1000) };
			s.control.scheme = scheme;
			s.walls.clear();
			for (std::size_t p = 0; p < s.points.count() && mixed; p += 2)
				s.points.material[p] = 1;
			s.start(Analysis::planeStrain, ShapeKind::cubic, .25);
			s.run(2);
			s.setVelocity([&](auto x) { return std::array<double, 3> { 2 * (x[1] - .5) / s.control.dt, 0, 0 }; });
			int               id   = -1;
			const std::string text = failure(s, 1, id);
			expectSays(text, { ("material point " + std::to_string(id) + " ").c_str(), "more than its own size in a step", "reduce O.dt" });
			EXPECT_TRUE(sound(s));
		}
}

/* A yield stress in MPa where Pa are meant. Plain, the law flows; with an option it would need too many sub-steps. */
TEST(FailureTest, StrainedByMoreThanTheLawCanFollow)
{
	for (Scheme scheme : allSchemes)
		for (bool mixed : { false, true })
			for (bool energy : { false, true }) {
				SCOPED_TRACE(std::string(name(scheme)) + (mixed ? " mixed" : "") + (energy ? " energy" : ""));
				Scene s          = block(Analysis::planeStress);
				s.laws           = { Scene::boucWen(1e8, .3, 1000, .1, 10, 0), Scene::elastic(1e8, .3, 1000) };
				s.control.scheme = scheme, s.control.trackEnergy = energy;
				s.control.dt = 1e-4;
				for (std::size_t p = 0; p < s.points.count() && mixed; p += 2)
					s.points.material[p] = 1;
				s.start(Analysis::planeStress, ShapeKind::cubic, .25);
				auto strike = [&] { s.setVelocity([](auto x) { return std::array<double, 3> { 10 * x[1], 0, 0 }; }); };
				strike();
				int id = -1;
				EXPECT_EQ(failure(s, 10, id), "");
				EXPECT_TRUE(sound(s));
				as<BoucWen>(s.laws[0]).strengthDegradation = .1;
				s.points.prepare(2, 3, Internals::of(s.laws[0]).columns(3), false, false, energy, false);
				strike();
				const std::string text = failure(s, 3, id);
				expectSays(text,
					{ ("material point " + std::to_string(id) + " ").c_str(), "its law can follow", "reduce O.dt", "yieldStress in Pa" });
				EXPECT_TRUE(sound(s)) << "whole, and can be saved";
			}
}

} // namespace
