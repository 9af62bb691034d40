// SPDX-License-Identifier: GPL-2.0-or-later
// A material point in free fall, by the installed kernel: a velocity of -g t after ten steps. The first line is the kernel's version.
#include <cmath>
#include <cstdio>
#include <mpm/Version.hpp>
#include <mpm/solver/Solver.hpp>

int main()
{
	using namespace yade::mpm;
	std::vector<Law> laws(1);
	laws[0].elastic = { 1e6, .3 }, laws[0].density = 1000;
	std::vector<Wall> walls;
	Points            points;
	const double      position[3] { .3, .4, 0 }, velocity[3] { 0, 0, 0 };
	points.append(0, 0, position, velocity, 10, .01, .1, 1);
	points.prepare(2, stressComponents(Analysis::planeStrain), 0, false, false, false, false);
	const auto solver = makeSolver(Analysis::planeStrain, ShapeKind::cubic, .2, points, laws, walls);

	StepControl control;
	control.dt = 1e-3, control.gravity = { 0, -9.81, 0 };
	for (int k = 0; k < 10; ++k)
		solver->step(control), control.time += control.dt;
	solver->finish();
	std::printf("%s\n%.9f\n", version(), points.velocity[1][0]);
	return std::abs(points.velocity[1][0] + 9.81 * .01) < 1e-12 ? 0 : 1;
}
