// SPDX-License-Identifier: GPL-2.0-or-later
/* Axisymmetry: x = r, y = z, hoop components third.

  laws       any path of (rr, zz, hoop, rz) gives what Solid gives on (xx, yy, zz, xy)
  patch      v_r = a r, v_z = b z between moving walls: with c = v_r/r every strain increment is that of a cube stretched by
	     c, b, c. Strains are reproduced to rounding, axis included. The stress rests to rounding with linear functions.
	     With splines the sum over the points of (r N_i)', which should vanish, has at the axis the error of the midpoint
	     rule at the end of an interval, 1/24 of the points' spacing squared times 2 N_i': a quarter of it with twice the points
  pulsation  a manufactured solution, below
  cylinder   Lame's, against the closed form
  balance    energies of a freely vibrating ring: their sum stays, the forces doing what the stress takes */
#include "LawPoint.hpp"
#include "Scene.hpp"
#include <gtest/gtest.h>

using namespace yade::mpm;

namespace {

const double pi = std::acos(-1.);

Law druckerPragerLaw()
{
	Law law;
	law.model = DruckerPrager(), law.elastic = { youngModulus, poissonRatio };
	as<DruckerPrager>(law).cohesion = .5 * yieldStress, as<DruckerPrager>(law).internalFriction = .5, as<DruckerPrager>(law).dilatancy = .1;
	return law;
}

TEST(AxisymmetricLawTest, AgreesWithSolid)
{
	std::mt19937                           random(3);
	std::uniform_real_distribution<double> uniform(-1, 1);
	for (const Law& law : { j2Law(.05), boucWenLaw(5, .05, 1e-6), druckerPragerLaw() }) {
		LawPoint<Axisymmetric> ring(law);
		LawPoint<Solid>        solid(law);
		for (int step = 0; step < 40; ++step) {
			const double rr = yieldStrain * uniform(random), zz = yieldStrain * uniform(random), tt = yieldStrain * uniform(random),
				     rz = yieldStrain * uniform(random);
			ring.strain({ rr, zz, tt, rz });
			solid.strain({ rr, zz, tt, 0, 0, rz });
			for (int k = 0; k < 4; ++k)
				ASSERT_NEAR(ring.sigma[k], solid.sigma[k == 3 ? 5 : k], 1e-9 * yieldStress) << "component " << k << " at step " << step;
			ASSERT_NEAR(ring.plasticStrain(), solid.plasticStrain(), 1e-9 * yieldStrain);
			ASSERT_NEAR(ring.response.dissipation, solid.response.dissipation, 1e-9 * solid.response.dissipation);
		}
		EXPECT_GT(solid.plasticStrain(), yieldStrain) << "nothing has yielded";
	}
}

struct Expansion {
	Scene        scene;
	const double R = 1, L = .77, radial = .8, axial = -.6; // outer radius, length, speeds of the walls

	Expansion(ShapeKind shape, Method method, bool largeStrain, double inner, const Law& law, int pointsPerCell = 2)
	{
		scene.laws = { law }, scene.control.dt = .001, method.set(scene.control), scene.control.largeStrain = largeStrain;
		Wall outer = Scene::wall(0, -1, R, Wall::Kind::slip), top = Scene::wall(1, -1, L, Wall::Kind::slip);
		outer.velocity[0] = radial, top.velocity[1] = axial;
		scene.walls                = { Scene::wall(0, 1, inner, Wall::Kind::slip), outer, Scene::wall(1, 1, 0, Wall::Kind::slip), top };
		scene.walls[0].velocity[0] = radial * inner / R;
		const int    nr = pointsPerCell * int(std::lround((R - inner) / .25)), nz = 3 * pointsPerCell;
		const double dr = (R - inner) / nr, dz = L / nz;
		for (int j = 0; j < nz; ++j)
			for (int i = 0; i < nr; ++i) {
				const double x[3] = { inner + (i + .5) * dr, (j + .5) * dz, 0 }, v[3] = { radial / R * x[0], axial / L * x[1], 0 };
				const double V = 2 * pi * x[0] * dr * dz;
				scene.points.append(int(scene.points.count()), 0, x, v, law.density * V, V, dr, 1);
			}
		scene.start(Analysis::axisymmetric, shape, .25);
	}
};

/* The cube's stresses and stretches after some steps. */
struct Cube : LawPoint<Solid> {
	double stretch[3] { 1, 1, 1 };

	Cube(const Expansion& e, const Law& law_, bool large, int steps)
	    : LawPoint<Solid>(law_)
	{
		for (int k = 0; k < steps; ++k) {
			const double t = .001 * k, c = .001 * e.radial / (e.R + t * e.radial), b = .001 * e.axial / (e.L + t * e.axial), g[3] { c, b, c };
			double       increment[3];
			for (int d = 0; d < 3; ++d)
				increment[d] = large ? std::log1p(g[d]) : g[d], stretch[d] += large ? g[d] * stretch[d] : g[d];
			strain({ increment[0], increment[1], increment[2], 0, 0, 0 });
		}
	}
};
void expectUniform(const Expansion& e, const Cube& cube, double tolerance)
{
	const Points& P = e.scene.points;
	for (std::size_t p = 0; p < P.count(); ++p) {
		for (std::size_t k = 0; k < 4; ++k)
			ASSERT_NEAR(P.stress[k][p], k < 3 ? cube.sigma[k] : 0, tolerance * 1e5) << k << " at r = " << P.position[0][p];
		ASSERT_NEAR(P.thicknessStretch[p], cube.stretch[2], tolerance);
		ASSERT_NEAR(P.deformation[0][p], cube.stretch[0], tolerance);
		ASSERT_NEAR(P.deformation[3][p], cube.stretch[1], tolerance);
	}
}

TEST(AxisymmetricPatchTest, UniformExpansion)
{
	const Law law = Scene::boucWen(1e5, .3, 1000, 500, 3, .1);
	for (ShapeKind shape : { ShapeKind::linear, ShapeKind::quadratic, ShapeKind::cubic })
		for (Method method : allMethods)
			for (bool large : { true, false }) {
				SCOPED_TRACE(std::string(name(shape)) + ' ' + name(method) + (large ? " large" : " small"));
				Expansion e(shape, method, large, 0, law);
				e.scene.runWithWalls(1);
				expectUniform(e, Cube(e, law, large, 1), 1e-12);
				if (shape != ShapeKind::linear) continue;
				e.scene.runWithWalls(59);
				const Cube cube(e, law, large, 60);
				EXPECT_GT(cube.plasticStrain(), .01);
				expectUniform(e, cube, 1e-10);
			}
}

TEST(AxisymmetricPatchTest, QuadratureAtTheAxis)
{
	const Law law = Scene::elastic(1e5, .3, 1000);
	for (ShapeKind shape : { ShapeKind::quadratic, ShapeKind::cubic }) {
		SCOPED_TRACE(name(shape));
		double worst[2] {};
		for (int fine = 0; fine < 2; ++fine) {
			Expansion e(shape, Scheme::musl, true, 0, law, 2 << fine);
			e.scene.runWithWalls(60);
			const Cube cube(e, law, true, 60);
			for (double hoop : e.scene.points.stress[2])
				worst[fine] = std::max(worst[fine], std::abs(hoop / cube.sigma[2] - 1));
		}
		EXPECT_LT(worst[0], .03);
		EXPECT_LT(worst[1], .35 * worst[0]);
	}
}

/* Uniform stress s I does not accelerate a body between walls, and presses s times the current areas on them. */
TEST(AxisymmetricPatchTest, UniformStressRests)
{
	for (ShapeKind shape : { ShapeKind::linear, ShapeKind::quadratic, ShapeKind::cubic }) {
		SCOPED_TRACE(name(shape));
		const bool   exact  = shape == ShapeKind::linear;
		const double atAxis = exact ? 1e-12 : 1. / 48,
			     atWall = exact ? 1e-12 : 1.5 * .25 / 48; // h/(48 R) of the force, and half of it more at a quadratic knot
		Expansion e(shape, Scheme::musl, true, 0, Scene::elastic(1e5, .3, 1000));
		for (auto& velocity : e.scene.points.velocity)
			std::fill(velocity.begin(), velocity.end(), 0.);
		for (std::size_t k = 0; k < 3; ++k)
			std::fill(e.scene.points.stress[k].begin(), e.scene.points.stress[k].end(), 100.);
		for (Wall& wall : e.scene.walls)
			wall.velocity = { 0, 0, 0 };
		e.scene.run(3);
		for (const auto& velocity : e.scene.points.velocity)
			for (double v : velocity)
				ASSERT_NEAR(v, 0, atAxis * 3 * .001 * 100 / (1000 * .25)); // of dt s/(rho h)
		const double area[4] = { 0, 2 * pi * e.R * e.L, pi, pi };
		for (std::size_t w = 1; w < 4; ++w)
			EXPECT_NEAR(e.scene.walls[w].force[w / 2], e.scene.walls[w].side * 100 * area[w], atWall * 100 * area[w]);
	}
}

/* Manufactured solution: u_r = G R (1 - R^2) s(t), u_z = G sin(pi Z) s(t), s = sin(pi c t), in the unit cylinder between slip
walls. With the stretches F_r = 1 + G s (1 - 3 R^2), F_h = 1 + G s (1 - R^2), F_z = 1 + pi G s cos(pi Z), hypoelastic stress
sigma_a = 2 mu ln F_a + lambda ln J and P_a = sigma_a J/F_a, the body force a mass is
  rho b_r = rho u_r'' - dP_r/dR - (P_r - P_h)/R,   rho b_z = rho u_z'' - dP_z/dZ. */
double pulsationError(int cells, ShapeKind shape, double periods, bool fullMass = false)
{
	const double G = .05, c = 100, h = 1. / cells, density = 1000;
	Scene        s;
	s.laws  = { Scene::elastic(1e7, .3, density) };
	s.walls = { Scene::wall(0, 1, 0, Wall::Kind::slip), Scene::wall(0, -1, 1, Wall::Kind::slip), Scene::wall(1, 1, 0, Wall::Kind::slip),
		Scene::wall(1, -1, 1, Wall::Kind::slip) };
	s.addBox(2, { 0, 0, 0 }, { 1, 1, 0 }, h / 2, true);
	const Columns X = s.points.position;
	s.setVelocity([&](auto x) { return std::array<double, 3> { G * pi * c * x[0] * (1 - x[0] * x[0]), G * pi * c * std::sin(pi * x[1]), 0 }; });
	s.control.dt = .2 * h / c, s.control.fullMass = fullMass;
	s.start(Analysis::axisymmetric, shape, h, true);
	const double lame = s.laws[0].elastic.lame, mu = s.laws[0].elastic.shear;
	double       greatest = 0;
	const int    steps    = int(std::lround(periods * .02 / s.control.dt));
	for (int k = 0; k < steps; ++k) {
		const double wave = G * std::sin(pi * c * s.control.time);
		for (std::size_t p = 0; p < s.points.count(); ++p) {
			const auto   i = std::size_t(s.points.id[p]);
			const double R = X[0][i], Z = X[1][i], Fr = 1 + wave * (1 - 3 * R * R), Fh = 1 + wave * (1 - R * R),
				     Fz  = 1 + wave * pi * std::cos(pi * Z);
			const double dFr = -6 * wave * R, dFh = -2 * wave * R, dFz = -wave * pi * pi * std::sin(pi * Z);
			const double lnJ = std::log(Fr * Fh * Fz), sr = 2 * mu * std::log(Fr) + lame * lnJ, sh = 2 * mu * std::log(Fh) + lame * lnJ;
			const double dsr = (2 * mu + lame) * dFr / Fr + lame * dFh / Fh, dsz = (2 * mu + lame) * dFz / Fz;
			const double dPr = dsr * Fh * Fz + sr * dFh * Fz, dPz = dsz * Fr * Fh;
			const double inertia = -pi * pi * c * c * density;
			const double br      = inertia * wave * R * (1 - R * R) - dPr - (sr * Fh * Fz - sh * Fr * Fz) / R;
			const double bz      = inertia * wave * std::sin(pi * Z) - dPz;
			s.points.force[0][p] = s.points.mass[p] / density * br, s.points.force[1][p] = s.points.mass[p] / density * bz;
		}
		s.step(), s.solver->finish();
		const double now = G * std::sin(pi * c * s.control.time);
		double       sum = 0;
		for (std::size_t p = 0; p < s.points.count(); ++p) {
			const auto   i = std::size_t(s.points.id[p]);
			const double R = X[0][i], Z = X[1][i];
			const double er = s.points.position[0][p] - R - now * R * (1 - R * R), ez = s.points.position[1][p] - Z - now * std::sin(pi * Z);
			sum += s.volume(p) * (er * er + ez * ez);
		}
		greatest = std::max(greatest, std::sqrt(sum));
	}
	EXPECT_GT(greatest, 0);
	return greatest;
}

TEST(AxisymmetricPulsationTest, IsOfSecondOrder)
{
	std::vector<double> errors;
	for (int cells : { 4, 8, 16, 32 })
		errors.push_back(pulsationError(cells, ShapeKind::cubic, .25));
	for (std::size_t k = 1; k < errors.size(); ++k)
		EXPECT_GT(std::log2(errors[k - 1] / errors[k]), k < 3 ? 1.8 : 1.95) << errors[k - 1] << " to " << errors[k];
	EXPECT_LT(errors.back(), 2e-4);
}
/* Not of fourth order: folding and the points' quadrature stay of second order at the axis and at the outer wall. */
TEST(AxisymmetricPulsationTest, FullMassGains)
{
	const double coarse = pulsationError(8, ShapeKind::cubic, .25, true), fine = pulsationError(16, ShapeKind::cubic, .25, true);
	EXPECT_LT(coarse, 4.5e-4) << "2.03e-3 with the lumped mass";
	EXPECT_LT(fine, 7.2e-5) << "4.98e-4 with the lumped mass";
}

TEST(AxisymmetricEnergyTest, SumStaysAsARingVibrates)
{
	double drift[2];
	for (int level = 0; level < 2; ++level) {
		Scene s;
		s.laws  = { Scene::elastic(1e7, .3, 1000) };
		s.walls = { Scene::wall(0, 1, 0, Wall::Kind::slip) };
		s.addBox(2, { .5, 0, 0 }, { 1, .5, 0 }, .0625, true);
		s.setVelocity([](auto x) { return std::array<double, 3> { 3 * x[0], x[1], 0 }; });
		s.control.dt = 2e-4 / (1 << level), s.control.trackEnergy = true;
		s.start(Analysis::axisymmetric, ShapeKind::cubic, .125);
		s.step();
		const double start = s.points.energies.total(), kinetic = s.points.energies.kinetic;
		double       least = kinetic, worst = 0;
		for (int k = 0; k < 300 << level; ++k) {
			s.step();
			least = std::min(least, s.points.energies.kinetic);
			worst = std::max(worst, std::abs(s.points.energies.total() - start));
		}
		EXPECT_LT(least, .2 * kinetic) << "the motion has not turned to stress";
		drift[level] = worst / start;
	}
	EXPECT_LT(drift[0], 2e-2);
	EXPECT_LT(drift[1], .6 * drift[0]);
}

/* A thin ring that breathes: omega = sqrt(E/rho)/r. */
TEST(AxisymmetricRingTest, BreathingFrequency)
{
	const double E = 1e7, density = 1000, width = .05, omega = std::sqrt(E / density);
	Scene        s;
	s.laws  = { Scene::elastic(E, 0, density) };
	s.walls = { Scene::wall(0, 1, 0, Wall::Kind::slip) };
	s.addBox(2, { 1 - width / 2, 0, 0 }, { 1 + width / 2, width, 0 }, width / 4, true);
	s.setVelocity([](auto) { return std::array<double, 3> { .01, 0, 0 }; });
	s.control.dt = 5e-5;
	s.start(Analysis::axisymmetric, ShapeKind::cubic, width / 2);
	double before = 1;
	while (before > 0 && s.control.time < .1) {
		s.step();
		const double now = s.momentum()[0];
		if (now <= 0) break;
		before = now;
	}
	EXPECT_NEAR(s.control.time * omega, pi / 2, .01 * pi / 2); // velocity vanishes after a quarter of a period
}

TEST(AxisymmetricStableStepTest, StableBelowUnstableAbove)
{
	for (double inner : { 0., 1. })
		for (Scheme scheme : allSchemes)
			for (double factor : { .9, 1.5 }) {
				SCOPED_TRACE(std::string(name(scheme)) + ' ' + std::to_string(inner) + " times " + std::to_string(factor));
				Scene s;
				s.laws  = { Scene::elastic(1e5, .3, 1000) };
				s.walls = { Scene::wall(0, 1, 0, Wall::Kind::slip) };
				s.addBox(2, { inner, 0, 0 }, { inner + 1, 1, 0 }, .125, true);
				std::mt19937                           random(11);
				std::uniform_real_distribution<double> uniform(-1e-6, 1e-6);
				s.setVelocity([&](auto) { return std::array<double, 3> { uniform(random), uniform(random), 0 }; });
				s.start(Analysis::axisymmetric, ShapeKind::cubic, .25);
				s.control.scheme   = scheme;
				s.control.dt       = factor * s.solver->criticalTimeStep(scheme);
				const double start = s.kineticEnergy();
				double       worst = 0;
				for (int k = 0; k < 1000 && worst < 1e6; ++k)
					s.step(), worst = std::max(worst, s.kineticEnergy() / start);
				if (factor < 1)
					EXPECT_LT(worst, 5);
				else
					EXPECT_GT(worst, 1e3);
			}
}

/* Lame's thick cylinder, plane strain: u = A r + B/r, sigma_rr = 2 (lambda + mu) A - 2 mu B/r^2, sigma_hoop with +, sigma_rr(b) = 0.
A wall at r = a moves by u_a, slowly and with damping; the pressure is its reaction over 2 pi a L. */
TEST(AxisymmetricLameTest, ThickCylinder)
{
	const double a = 1, b = 2, L = .125, h = .0625, pushed = 1e-4;
	Scene        s;
	s.laws  = { Scene::elastic(1e7, .3, 1000) };
	s.walls = { Scene::wall(0, 1, a, Wall::Kind::slip), Scene::wall(1, 1, 0, Wall::Kind::slip), Scene::wall(1, -1, L, Wall::Kind::slip) };
	s.addBox(2, { a, 0, 0 }, { b, L, 0 }, h / 2, true);
	s.start(Analysis::axisymmetric, ShapeKind::cubic, h);
	s.control.dt      = .4 * s.solver->criticalTimeStep(Scheme::musl);
	s.control.damping = .3;
	const int steps   = 1500;
	for (int k = 0; k < steps; ++k) {
		s.walls[0].velocity[0] = k < steps / 3 ? pushed / (s.control.dt * (steps / 3)) : 0;
		s.step();
		s.walls[0].position += s.control.dt * s.walls[0].velocity[0];
	}
	s.solver->finish();
	const Hooke& C = s.laws[0].elastic;
	const double B = pushed / (C.shear * a / ((C.lame + C.shear) * b * b) + 1 / a), A = C.shear * B / ((C.lame + C.shear) * b * b);
	auto         radial = [&](double r) { return 2 * (C.lame + C.shear) * A - 2 * C.shear * B / (r * r); };
	auto         hoop   = [&](double r) { return 2 * (C.lame + C.shear) * A + 2 * C.shear * B / (r * r); };
	const double p      = -radial(a);
	EXPECT_NEAR(-s.walls[0].force[0] / (2 * pi * a * L), p, .01 * p);
	for (std::size_t i = 0; i < s.points.count(); ++i) {
		const double r = s.points.position[0][i];
		if (r < a + 1.5 * h || r > b - 2 * h) continue; // the wall makes the field odd about itself; the last cells are partly empty
		EXPECT_NEAR(s.points.stress[0][i], radial(r), .02 * p) << r;
		EXPECT_NEAR(s.points.stress[2][i], hoop(r), .02 * p) << r;
		EXPECT_NEAR(s.points.stress[1][i], C.poisson * (radial(r) + hoop(r)), .02 * p) << r;
	}
}

} // namespace
