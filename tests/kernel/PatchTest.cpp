// SPDX-License-Identifier: GPL-2.0-or-later
/* Patch test: a linear displacement field is reproduced to rounding, next to walls too.

A box of points at h/2 fills the space between slip walls that move apart or together, the points have the velocity that
is linear between the walls'. The grid stretches with the walls, so the points keep their places in the cells, where
sums over the lattice are exact: nodal velocities are linear, stress is uniform, nodes feel no force, velocities never
change. Then, with L the distance of the walls of an axis and V its rate,
  G = dt V/L in every step,  F = L(t)/L(0),  sigma: the law's answer to the strains of these G (Kinematics.hpp),
  force on the wall: that of uniform stress on the current area.
Everything to 1e-11: some 1e2 steps of rounding of numbers of order one. (GIMP is left out: its points keep their size
while the lattice stretches, so that its sums are exact at the first step only, which SingleStep looks at.) */
#include "LawPoint.hpp"
#include "Scene.hpp"
#include <gtest/gtest.h>

using namespace yade::mpm;

namespace {

const double origin[3] = { -.37, 0, 2.1 }, length[3] = { 1, .77, 1.04 }, lowerSpeed[3] = { .2, -.1, 0 }, upperSpeed[3] = { 1.0, -.8, .3 };

struct Stretch {
	Scene scene;
	int   dim;

	Stretch(Analysis analysis, ShapeKind shape, const StepControl& control, const std::vector<Law>& laws)
	    : dim(dimension(analysis))
	{
		scene.laws = laws, scene.control = control, scene.control.dt = .001;
		const double cell = .25;
		int          n[3] = { 1, 1, 1 };
		double       spacing[3], volume = 1;
		for (int d = 0; d < dim; ++d) {
			Wall lower = Scene::wall(d, 1, origin[d], Wall::Kind::slip), upper = Scene::wall(d, -1, origin[d] + length[d], Wall::Kind::slip);
			lower.velocity[d] = lowerSpeed[d], upper.velocity[d] = upperSpeed[d];
			scene.walls.push_back(lower), scene.walls.push_back(upper);
			n[d]       = 2 * int(std::round(length[d] / cell)); // walls are no whole number of nominal cells apart
			spacing[d] = length[d] / n[d], volume *= spacing[d];
		}
		for (int k = 0; k < n[2]; ++k)
			for (int j = 0; j < n[1]; ++j)
				for (int i = 0; i < n[0]; ++i) {
					const int index[3] = { i, j, k }, material = j % int(laws.size());
					double    x[3] {}, v[3] {};
					for (int d = 0; d < dim; ++d)
						x[d] = origin[d] + (index[d] + .5) * spacing[d], v[d] = speed(d, x[d]);
					scene.points.append(
						int(scene.points.count()), material, x, v, laws[std::size_t(material)].density * volume, volume, spacing[0], 1);
				}
		scene.start(analysis, shape, cell);
	}
	static double speed(int d, double x) { return lowerSpeed[d] + (upperSpeed[d] - lowerSpeed[d]) * (x - origin[d]) / length[d]; }
	static double distance(int d, double t) { return length[d] + t * (upperSpeed[d] - lowerSpeed[d]); }
};

/* Stress and internal variables of a material that is stretched along the axes, step by step. */
template <class S> std::vector<double> drive(const Law& law, const StepControl& control, int steps)
{
	LawPoint<S> point(law);
	for (int k = 0; k < steps; ++k) {
		double G[S::dim * S::dim] {};
		for (int d = 0; d < S::dim; ++d)
			G[d * (S::dim + 1)] = .001 * (upperSpeed[d] - lowerSpeed[d]) / Stretch::distance(d, .001 * k);
		point.deform(control.largeStrain, G);
	}
	std::vector<double> state(point.sigma, point.sigma + S::N);
	state.insert(state.end(), point.internal.begin(), point.internal.end());
	return state;
}
std::vector<double> drive(Analysis analysis, const Law& law, const StepControl& control, int steps)
{
	switch (analysis) {
		case Analysis::uniaxial: return drive<Uniaxial>(law, control, steps);
		case Analysis::planeStress: return drive<PlaneStress>(law, control, steps);
		case Analysis::planeStrain: return drive<PlaneStrain>(law, control, steps);
		case Analysis::axisymmetric: // of its own
		case Analysis::solid: break;
	}
	return drive<Solid>(law, control, steps);
}

void expectUniform(Stretch& stretch, Analysis analysis, int steps)
{
	const Scene&                     s = stretch.scene;
	const Points&                    P = s.points;
	const double                     t = s.control.time;
	std::vector<std::vector<double>> expected;
	for (const Law& law : s.laws)
		expected.push_back(drive(analysis, law, s.control, steps));
	const double scale = s.laws[0].elastic.young;
	ASSERT_GT(std::abs(expected[0][0]), 1e-4 * scale) << "nothing has been stretched";

	for (std::size_t p = 0; p < P.count(); ++p) {
		for (std::size_t k = 0; k < P.stress.size(); ++k)
			ASSERT_NEAR(P.stress[k][p], expected[std::size_t(P.material[p])][k], 1e-11 * scale) << "component " << k << " of point " << P.id[p];
		const Internals layout  = Internals::of(s.laws[std::size_t(P.material[p])]);
		const int       columns = layout.columns(int(P.stress.size())), tensors = layout.tensors * int(P.stress.size());
		for (int k = 0; k < columns; ++k)
			ASSERT_NEAR(P.internal[std::size_t(k)][p], expected[std::size_t(P.material[p])][P.stress.size() + std::size_t(k)],
				1e-11 * (k < tensors ? scale : 1));
		for (int i = 0; i < stretch.dim; ++i) {
			for (int j = 0; j < stretch.dim; ++j) {
				double sum = 0; // small strain: of the increments
				for (int k = 0; k < steps && i == j; ++k)
					sum += .001 * (upperSpeed[i] - lowerSpeed[i]) / Stretch::distance(i, .001 * k);
				const double F = s.control.largeStrain ? (i == j ? Stretch::distance(i, t) / length[i] : 0) : (i == j) + sum;
				ASSERT_NEAR(P.deformation[std::size_t(i * stretch.dim + j)][p], F, 1e-11);
			}
			const double x = P.position[std::size_t(i)][p], v = P.velocity[std::size_t(i)][p];
			const double xi = (x - origin[i] - lowerSpeed[i] * t) / Stretch::distance(i, t);
			ASSERT_NEAR(v, lowerSpeed[i] + (upperSpeed[i] - lowerSpeed[i]) * xi, 1e-11) << "velocity of point " << P.id[p];
		}
	}
}

TEST(PatchTest, StretchBetweenMovingWalls)
{
	for (Analysis analysis : allAnalyses)
		for (ShapeKind shape : { ShapeKind::linear, ShapeKind::quadratic, ShapeKind::cubic })
			for (Method method : allMethods) {
				SCOPED_TRACE(std::string(name(analysis)) + ' ' + name(shape) + ' ' + name(method));
				StepControl control;
				method.set(control);
				const int steps = analysis == Analysis::solid ? 20 : 100;
				Stretch   stretch(analysis, shape, control, { Scene::elastic(1e5, .3, 1000) });
				stretch.scene.runWithWalls(steps);
				expectUniform(stretch, analysis, steps);
			}
}

TEST(PatchTest, SingleStepOfGimp)
{
	for (Analysis analysis : allAnalyses) {
		SCOPED_TRACE(name(analysis));
		Stretch stretch(analysis, ShapeKind::gimp, {}, { Scene::elastic(1e5, .3, 1000) });
		stretch.scene.runWithWalls(1);
		expectUniform(stretch, analysis, 1);
	}
}

TEST(PatchTest, SmallStrain)
{
	for (Analysis analysis : allAnalyses) {
		SCOPED_TRACE(name(analysis));
		StepControl control;
		control.largeStrain = false;
		Stretch stretch(analysis, ShapeKind::cubic, control, { Scene::elastic(1e5, .3, 1000) });
		stretch.scene.runWithWalls(20);
		expectUniform(stretch, analysis, 20);
	}
}

/* Two materials in alternate rows, one of them with internal variables, both with no contraction across: stress jumps
from row to row, and no force comes of it along the rows. Only the first axis is stretched by much. */
TEST(PatchTest, MaterialsSideBySide)
{
	Law hysteretic = Scene::boucWen(3e4, 0, 400, 600, 2, .1);
	for (Method method : allMethods) {
		StepControl control;
		method.set(control);
		Stretch stretch(Analysis::uniaxial, ShapeKind::cubic, control, { hysteretic });
		stretch.scene.runWithWalls(60);
		expectUniform(stretch, Analysis::uniaxial, 60);
		EXPECT_GT(stretch.scene.points.internal[1][0], 1e-2) << "no plastic strain: the law has not been exercised";
	}
	// in the plane
	Scene s;
	s.laws = { Scene::elastic(1e5, 0, 1000), hysteretic };
	s.addBox(2, { 0, 0, 0 }, { 1, 1, 0 }, .125);
	for (std::size_t p = 0; p < s.points.count(); ++p)
		if (s.points.position[1][p] > .5) s.points.material[p] = 1, s.points.mass[p] *= .4;
	for (int side : { 1, -1 })
		s.walls.push_back(Scene::wall(0, side, side > 0 ? 0 : 1, Wall::Kind::slip)),
			s.walls.push_back(Scene::wall(1, side, side > 0 ? 0 : 1, Wall::Kind::slip));
	s.walls[2].velocity[0] = 1;
	ASSERT_EQ(s.walls[2].axis, 0);
	s.setVelocity([](auto x) { return std::array<double, 3> { x[0], 0, 0 }; });
	s.control.dt = .001;
	s.start(Analysis::planeStrain, ShapeKind::cubic, .25);
	LawPoint<PlaneStrain> elastic(s.laws[0]);
	for (int k = 0; k < 60; ++k) {
		s.step();
		s.walls[2].position += .001;
		const double G[4] = { .001 / (1 + .001 * k), 0, 0, 0 };
		elastic.deform(true, G);
	}
	s.solver->finish();
	// the back stress leaves sigma_yy in the hysteretic rows: they move against the others, and only the elastic rows far from them stay as they were
	for (std::size_t p = 0; p < s.points.count(); ++p)
		if (s.points.material[p] == 0) {
			EXPECT_NEAR(s.points.internal[0][p], 0, 0) << "an elastic point has grown a back stress";
			if (s.points.position[1][p] < .07) {
				EXPECT_NEAR(s.points.stress[0][p], elastic.sigma[0], .02 * elastic.sigma[0]);
			}
		} else
			EXPECT_GT(s.points.internal[4][p], 1e-2);
}

/* The material exerts on each wall the stress times the current area, pulling it inwards in tension. */
TEST(PatchTest, WallsCarryTheStress)
{
	for (Analysis analysis : allAnalyses)
		for (ShapeKind shape : { ShapeKind::linear, ShapeKind::quadratic, ShapeKind::cubic }) {
			SCOPED_TRACE(std::string(name(analysis)) + ' ' + name(shape));
			Stretch stretch(analysis, shape, {}, { Scene::elastic(1e5, .3, 1000) });
			stretch.scene.runWithWalls(20);
			const double t     = stretch.scene.control.time;
			Scene        still = stretch.scene.copy(analysis, shape, .25); // stress of now, walls of now
			still.step();
			for (const Wall& wall : still.walls) {
				double area = 1;
				for (int d = 0; d < stretch.dim; ++d)
					if (d != wall.axis) area *= Stretch::distance(d, t);
				const double force = wall.side * area * stretch.scene.points.stress[std::size_t(wall.axis)][0];
				ASSERT_GT(std::abs(force), 1);
				for (int d = 0; d < stretch.dim; ++d)
					EXPECT_NEAR(wall.force[std::size_t(d)], d == wall.axis ? force : 0, 1e-10 * 1e5 * area);
			}
		}
}

} // namespace
