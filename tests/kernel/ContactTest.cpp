// SPDX-License-Identifier: GPL-2.0-or-later
/* Points that touch other bodies: torques on them, and the motion that they show to a contact.

The couple f_i = T x grad N_ip / 2 has no resultant since sum grad N_ip = 0, and the moment T since sum x_i (x) grad N_ip = 1;
both hold for every shape function, to rounding. Its power is T . curl v / 2, the power of T on what turns with the spin. */
#include "Scene.hpp"
#include <gtest/gtest.h>

using namespace yade::mpm;

namespace {

/* A free cube (square) at rest or in motion, of which the point nearest to its middle is touched. */
struct Touched {
	Scene       scene;
	std::size_t point = 0;
	const int   dim;

	Touched(
		Analysis analysis, ShapeKind shape, Method method, int cells = 4,
		const std::function<std::array<double, 3>(const std::array<double, 3>&)>& velocity =
			[](auto) {
				return std::array<double, 3> { 0, 0, 0 };
			})
	    : dim(dimension(analysis))
	{
		scene.laws = { Scene::elastic(1e5, .3, 1000) };
		const std::array<double, 3> lower { .03, .11, -.07 };
		const double                half = .125 * cells;
		scene.addBox(dim, lower, { lower[0] + 2 * half, lower[1] + 2 * half, lower[2] + 2 * half }, .125);
		scene.setVelocity(velocity);
		scene.control.dt = 1e-4, method.set(scene.control), scene.control.trackEnergy = true;
		scene.start(analysis, shape, .25, true);
		scene.points.prepareContacts();
		double nearest = 1e9;
		for (std::size_t p = 0; p < scene.points.count(); ++p) {
			double distance = 0;
			for (int d = 0; d < dim; ++d)
				distance += std::abs(scene.points.position[std::size_t(d)][p] - lower[std::size_t(d)] - half);
			if (distance < nearest) nearest = distance, point = p;
		}
		scene.points.inContact[point] = 1;
	}
	std::size_t now() const // sorting moves points
	{
		const auto& touched = scene.points.inContact;
		return std::size_t(std::find(touched.begin(), touched.end(), 1) - touched.begin());
	}
};

template <class Visit> void forEveryMethod(Visit&& visit)
{
	for (Analysis analysis : { Analysis::planeStrain, Analysis::solid })
		for (ShapeKind shape : allShapes)
			for (Method method : allMethods) {
				SCOPED_TRACE(std::string(name(analysis)) + ' ' + name(shape) + ' ' + name(method));
				visit(analysis, shape, method);
			}
}

TEST(ContactTest, ACoupleHasItsMomentAndNoResultant)
{
	const double torque[3] = { 3, -5, 7 };
	for (Analysis analysis : { Analysis::planeStrain, Analysis::solid })
		for (ShapeKind shape : allShapes) {
			SCOPED_TRACE(std::string(name(analysis)) + ' ' + name(shape));
			Touched t(analysis, shape, Scheme::usl);
			for (std::size_t k = 0; k < t.scene.points.torque.size(); ++k)
				t.scene.points.torque[k][t.point] = torque[t.dim == 3 ? k : 2];
			t.scene.step(); // USL: the nodes' velocities are those of the forces of this step
			const GridNodes       nodes = t.scene.solver->nodes();
			std::array<double, 3> impulse {}, moment {};
			for (std::size_t i = 0; i < nodes.mass.size(); ++i)
				for (std::size_t d = 0; d < 3; ++d) {
					const std::size_t a = (d + 1) % 3, b = (d + 2) % 3;
					impulse[d] += nodes.mass[i] * nodes.velocity[d][i];
					moment[d] +=
						nodes.mass[i] * (nodes.position[a][i] * nodes.velocity[b][i] - nodes.position[b][i] * nodes.velocity[a][i]);
				}
			for (std::size_t d = 0; d < 3; ++d) {
				EXPECT_NEAR(impulse[d], 0, 1e-12 * t.scene.control.dt * 10);
				EXPECT_NEAR(moment[d], (t.dim == 3 || d == 2 ? torque[d] : 0) * t.scene.control.dt, 1e-12 * t.scene.control.dt * 10);
			}
		}
}

TEST(ContactTest, WorkOfACoupleIsInTheBalance)
{
	forEveryMethod([](Analysis analysis, ShapeKind shape, Method method) {
		Touched t(analysis, shape, method);
		for (int step = 0; step < 100; ++step) {
			t.scene.points.torque.back()[t.now()] = 50;
			t.scene.step();
		}
		const Energies& e = t.scene.points.energies;
		EXPECT_GT(e.kinetic + e.elastic, 1e-5) << "nothing has turned";
		EXPECT_NEAR(e.total() / e.external, 0, 2e-3);
	});
}

TEST(ContactTest, ATouchedPointShowsTheMotionOfTheMaterial)
{
	const double omega[3] = { .3, -.2, .5 }; // a rigid motion, which the grid takes up exactly four cells away from the faces, eight with the full mass
	forEveryMethod([&](Analysis analysis, ShapeKind shape, Method method) {
		const bool solid = analysis == Analysis::solid;
		Touched    t(analysis, shape, method, method.fullMass ? 17 : 9, [&](auto x) {
                        const double w[3] = { solid ? omega[0] : 0, solid ? omega[1] : 0, omega[2] };
                        return std::array<double, 3> { w[1] * x[2] - w[2] * x[1] + .7, w[2] * x[0] - w[0] * x[2], w[0] * x[1] - w[1] * x[0] };
                });
		t.scene.control.dt   = 1e-9; // USF strains the faces before this
		const Columns before = t.scene.points.velocity;
		t.scene.step();
		const std::size_t p = t.now();
		for (int d = 0; d < t.dim; ++d)
			EXPECT_NEAR(t.scene.points.contactVelocity[std::size_t(d)][p], before[std::size_t(d)][t.point], 1e-12);
		for (std::size_t k = 0; k < t.scene.points.spin.size(); ++k)
			EXPECT_NEAR(t.scene.points.spin[k][p], omega[solid ? k : 2], 1e-11);
	});
}

} // namespace
