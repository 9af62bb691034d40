// SPDX-License-Identifier: GPL-2.0-or-later
/* Elastic constants, walls, free faces and the lumped mass in shear, in every analysis.

A load of the form of a mode, put on at once and kept, makes a body vibrate about its rest: the mean displacement over a period tells the
stiffness, the period the inertia.

box    a unit box (a unit cylinder in axisymmetry) between slip walls vibrates exactly in
	 u_a = A_a sin(pi X_a) prod_(b != a) cos(pi X_b),    u_r = A_r J1(kappa r) cos(pi z), u_z = A_z J0(kappa r) sin(pi z),
       J1(kappa) = 0, with speed c_p for A along the wave vector and c_s for A across it. On the grid, with the shape function's symbol
       q(theta) = (2 + cos theta)/3 (cubic) or (3 + cos theta)/4 (quadratic), theta = k_a h, an inertia is larger by prod_a q^-4: q^2
       from each of lumping and mapping (doc/method.md), with the full mass by q^-4 (2 - q^2)^-2 of the products. In time symplectic Euler makes omega larger by
(omega dt)^2/24. bar    of unit square section, faces free, half a wave between slip walls, so that there is no clamp whose warping would have to be guessed:
	 longitudinal  omega = k sqrt(E/rho) / sqrt(1 + nu^2 k^2/6)  (Love)
	 bending       Timoshenko, coefficient 10 (1 + nu)/(12 + 11 nu) (Cowper)
	 torsion       omega = k sqrt(G J/(rho I_p)), J = 0.140577, I_p = 1/6; warping adds less than 1e-3
plate  with free faces in 3D, against plane stress whose thickness follows the strain; large strain, elastic and yielding */
#include "Manufactured.hpp"
#include <gtest/gtest.h>

using namespace yade::mpm;

namespace {

using Vector = std::array<double, 3>;
using Mode   = std::function<Vector(const Vector&)>;

const double young = 1e7, density = 1000, poisson = .3, soundSpeed = 100; // sqrt(E/rho)
const double kappa = 3.8317059702075123;                                  // of J1

/* What a body does under a small load that is put on at once and kept. */
struct Response {
	double frequency = 0; // circular
	double rest      = 0; // displacement in the mode about which it vibrates, over that of the mode: mean over a period
};

/* The load is a force a mass in the form of the mode, on which displacement and velocity are projected. */
Response respond(Scene& s, Analysis analysis, ShapeKind shape, double h, const Mode& mode)
{
	const Columns X = s.points.position; // by id
	const auto    n = s.points.count();
	s.control.dt    = .3 * h / soundSpeed;
	s.start(analysis, shape, h, true);
	std::vector<Vector> phi;
	double              norm = 0;
	for (std::size_t i = 0; i < n; ++i) {
		const Vector x { X[0][i], X[1][i], X[2][i] };
		phi.push_back(mode(x));
		for (double c : phi.back())
			norm += s.points.mass[i] * c * c;
	}
	double              sum = 0, before[2] {};
	std::vector<double> zeros; // of the velocity: half a period, a period
	for (int k = 0; k < 100000; ++k) {
		for (std::size_t p = 0; p < n; ++p)
			for (std::size_t d = 0; d < s.points.force.size(); ++d)
				s.points.force[d][p] = 1e-3 * s.points.mass[p] * phi[std::size_t(s.points.id[p])][d];
		s.step(), s.solver->finish();
		double u = 0, v = 0;
		for (std::size_t p = 0; p < n; ++p)
			for (std::size_t d = 0, i = std::size_t(s.points.id[p]); d < 3; ++d) {
				u += s.points.mass[p] * (s.points.position[d][p] - X[d][i]) * phi[i][d] / norm;
				v += s.points.mass[p] * s.points.velocity[d][p] * phi[i][d] / norm;
			}
		if (k > 0 && v * before[1] < 0) {
			const double part = before[1] / (before[1] - v);
			zeros.push_back(s.control.time - s.control.dt * (1 - part));
			if (zeros.size() == 2) {
				sum += .5 * part * (before[0] + u);
				return { pi / (zeros[1] - zeros[0]), 1e3 * sum * s.control.dt / zeros[1] };
			}
		}
		sum += .5 * (before[0] + u);
		before[0] = u, before[1] = v;
	}
	ADD_FAILURE() << "it does not vibrate";
	return {};
}

/* The mode of the box: displacement of unit size. */
Mode boxMode(Analysis analysis, bool shear)
{
	if (analysis == Analysis::axisymmetric)
		return [=](const Vector& x) {
			const double r = shear ? pi : kappa, z = shear ? -kappa : pi;
			return Vector { r * std::cyl_bessel_j(1, kappa * x[0]) * std::cos(pi * x[1]),
				z * std::cyl_bessel_j(0, kappa * x[0]) * std::sin(pi * x[1]), 0 };
		};
	const int    dim = dimension(analysis);
	const Vector A   = !shear ? Vector { 1, 1, 1 } : dim == 2 ? Vector { 1, -1, 0 } : Vector { 1, 1, -2 };
	return [=](const Vector& x) {
		Vector u {};
		for (std::size_t a = 0; a < std::size_t(dim); ++a) {
			u[a] = A[a];
			for (std::size_t b = 0; b < std::size_t(dim); ++b)
				u[a] *= a == b ? std::sin(pi * x[b]) : std::cos(pi * x[b]);
		}
		return u;
	};
}

Response boxResponse(Analysis analysis, ShapeKind shape, int cells, bool shear, bool fullMass = false)
{
	const int dim = dimension(analysis);
	Scene     s;
	s.laws             = { Scene::elastic(young, poisson, density) };
	s.control.fullMass = fullMass;
	for (int d = 0; d < dim; ++d)
		s.walls.push_back(Scene::wall(d, 1, 0, Wall::Kind::slip)), s.walls.push_back(Scene::wall(d, -1, 1, Wall::Kind::slip));
	s.addBox(dim, { 0, 0, 0 }, { 1, 1, 1 }, .5 / cells, analysis == Analysis::axisymmetric);
	return respond(s, analysis, shape, 1. / cells, boxMode(analysis, shear));
}

void expectBox(Analysis analysis, ShapeKind shape, bool shear, int coarse)
{
	SCOPED_TRACE(std::string(name(analysis)) + ' ' + name(shape) + (shear ? " shear" : " pressure"));
	const bool   cubic = shape == ShapeKind::cubic, ring = analysis == Analysis::axisymmetric;
	const Hooke  C       = Scene::elastic(young, poisson, density).elastic;
	const double modulus = shear ? C.shear : analysis == Analysis::uniaxial ? young : analysis == Analysis::planeStress ? C.plane : C.lame + 2 * C.shear;
	const double k = ring ? std::hypot(pi, kappa) : pi * std::sqrt(double(dimension(analysis))), omega = k * std::sqrt(modulus / density);
	double       slower[2], softer[2];
	for (int fine = 0; fine < 2; ++fine) {
		const int      cells = coarse << fine;
		const Response r     = boxResponse(analysis, shape, cells, shear);
		slower[fine] = 1 - r.frequency / omega, softer[fine] = std::abs(r.rest * omega * omega - 1);
		if (ring) continue;
		const double theta = pi / cells, q = cubic ? (2 + std::cos(theta)) / 3 : (3 + std::cos(theta)) / 4;
		const double grid = std::pow(q, 2 * dimension(analysis)) / std::sqrt(r.rest * omega * omega),
			     time = std::pow(omega * .3 / soundSpeed / cells, 2) / 24;
		EXPECT_NEAR(r.frequency / omega, grid * (1 + time), .02 * (1 - grid)) << "with " << cells << " cells";
	}
	EXPECT_GT(std::log2(slower[0] / slower[1]), 1.8);
	EXPECT_LT(softer[1], cubic ? 1e-4 : 3e-3) << "what a load does in the end";
	if (!cubic) { // the quadrature of the load by two points a cell, of which cubic functions have none to this order
		EXPECT_GT(std::log2(softer[0] / softer[1]), 1.9);
	}
}

TEST(WaveTest, BoxInOneAndTwoDimensions)
{
	for (ShapeKind shape : { ShapeKind::quadratic, ShapeKind::cubic }) {
		expectBox(Analysis::uniaxial, shape, false, 8);
		for (Analysis analysis : { Analysis::planeStress, Analysis::planeStrain, Analysis::axisymmetric })
			for (bool shear : { false, true })
				expectBox(analysis, shape, shear, 8);
	}
}
TEST(WaveTest, FullMassIsOfOrderFour)
{
	for (Analysis analysis : { Analysis::uniaxial, Analysis::planeStress, Analysis::axisymmetric })
		for (bool shear : { false, true }) {
			if (analysis == Analysis::uniaxial && shear) continue;
			SCOPED_TRACE(std::string(name(analysis)) + (shear ? " shear" : " pressure"));
			const bool   ring    = analysis == Analysis::axisymmetric;
			const Hooke  C       = Scene::elastic(young, poisson, density).elastic;
			const double modulus = shear ? C.shear : ring ? C.lame + 2 * C.shear : analysis == Analysis::uniaxial ? young : C.plane;
			const double k = ring ? std::hypot(pi, kappa) : pi * std::sqrt(double(dimension(analysis))), omega = k * std::sqrt(modulus / density);
			double       off[2];
			for (int fine = 0; fine < 2; ++fine) {
				const int      cells = 4 << fine;
				const Response r     = boxResponse(analysis, ShapeKind::cubic, cells, shear, true);
				const double   Q     = std::pow((2 + std::cos(pi / cells)) / 3, 2 * dimension(analysis)),
					     grid = Q * (2 - Q) / std::sqrt(r.rest * omega * omega), time = std::pow(omega * .3 / soundSpeed / cells, 2) / 24;
				off[fine] = 1 - r.frequency / omega / (1 + time);
				if (!ring) {
					EXPECT_NEAR(off[fine], 1 - grid, .025 * (1 - grid)) << "with " << cells << " cells";
				}
			}
			EXPECT_GT(std::log2(off[0] / off[1]), 3.4);
			EXPECT_LT(off[1], .015);
		}
}
TEST(LongWaveTest, BoxInThreeDimensions)
{
	for (ShapeKind shape : { ShapeKind::quadratic, ShapeKind::cubic })
		for (bool shear : { false, true })
			expectBox(Analysis::solid, shape, shear, 5);
}

TEST(WaveTest, ShearWaveIsOfSecondOrder)
{
	double slower[2];
	for (int fine = 0; fine < 2; ++fine)
		slower[fine] =
			1 - boxResponse(Analysis::planeStrain, ShapeKind::cubic, 16 << fine, true).frequency / (pi * std::sqrt(2 * young / 2.6 / density));
	EXPECT_GT(std::log2(slower[0] / slower[1]), 1.98);
}

enum class BarMode { longitudinal, bending, torsion };

Response barResponse(BarMode which, int layers, double length, ShapeKind shape, bool fullMass)
{
	const double h = 2. / layers, k = pi / length;
	Scene        s;
	s.laws             = { Scene::elastic(young, poisson, density) };
	s.walls            = { Scene::wall(0, 1, 0, Wall::Kind::slip), Scene::wall(0, -1, length, Wall::Kind::slip) };
	s.control.fullMass = fullMass;
	s.addBox(3, { 0, -.5, -.5 }, { length, .5, .5 }, h / 2);
	return respond(s, Analysis::solid, shape, h, [=](const Vector& x) {
		const double c = std::cos(k * x[0]), n = std::sin(k * x[0]);
		return which == BarMode::longitudinal ? Vector { n, 0, 0 } : which == BarMode::bending ? Vector { 0, c, 0 } : Vector { 0, -x[2] * c, x[1] * c };
	});
}
Response exactBar(BarMode which, double length)
{
	const double k = pi / length, shear = young / (2 * (1 + poisson)), I = 1. / 12, cowper = 10 * (1 + poisson) / (12 + 11 * poisson), J = .140577;
	switch (which) {
		case BarMode::longitudinal: return { k * soundSpeed / std::sqrt(1 + poisson * poisson * k * k * 2 * I), density / (young * k * k) };
		case BarMode::bending: {
			const double a = density * density * I / (cowper * shear), b = density * (1 + I * k * k * (1 + young / (cowper * shear))),
				     c = young * I * std::pow(k, 4);
			return { std::sqrt(2 * c / (b + std::sqrt(b * b - 4 * a * c))), density / c + density / (cowper * shear * k * k) };
		}
		case BarMode::torsion: break;
	}
	return { k * std::sqrt(shear * J / (density * 2 * I)), density * 2 * I / (shear * J * k * k) };
}

void expectBar(BarMode which, int layers, double frequency, double rest, bool fullMass = false)
{
	SCOPED_TRACE("mode " + std::to_string(int(which)) + ", layers " + std::to_string(layers));
	const Response r = barResponse(which, layers, 4, ShapeKind::cubic, fullMass), exact = exactBar(which, 4);
	EXPECT_NEAR(r.frequency / exact.frequency - 1, frequency, std::max(.05 * std::abs(frequency), 5e-4));
	EXPECT_NEAR(r.rest / exact.rest - 1, rest, std::max(.05 * std::abs(rest), 5e-4));
}

/* doc/verification/waves.md has these tables. Torsion moves slowly because mass that is spread to the nodes is spread outwards. */
TEST(LongWaveTest, Bar)
{
	expectBar(BarMode::longitudinal, 4, -.0593, .0025), expectBar(BarMode::longitudinal, 8, -.0163, -.0005);
	expectBar(BarMode::bending, 4, -.0065, .0459), expectBar(BarMode::bending, 8, -.0135, .0226);
	expectBar(BarMode::torsion, 4, -.4374, -.1866), expectBar(BarMode::torsion, 8, -.2399, -.0179);
}
TEST(LongWaveTest, BarWithManyLayers)
{
	expectBar(BarMode::longitudinal, 12, -.0078, -.0003);
	expectBar(BarMode::bending, 12, -.0085, .0093);
	expectBar(BarMode::torsion, 12, -.1184, -.0024);
	expectBar(BarMode::longitudinal, 12, -.0005, -.0002, true);
	expectBar(BarMode::bending, 12, -.0074, .0034, true);
	expectBar(BarMode::torsion, 12, -.0020, .0168, true);
}

TEST(LongWaveTest, BarWithTheFullMass)
{
	expectBar(BarMode::longitudinal, 4, -.0068, .0005, true), expectBar(BarMode::longitudinal, 8, -.0014, -.0004, true);
	expectBar(BarMode::bending, 4, -.0162, .1284, true), expectBar(BarMode::bending, 8, -.0255, .0153, true);
	expectBar(BarMode::torsion, 4, -.1087, -.1558, true), expectBar(BarMode::torsion, 8, -.0214, .0140, true);
}

/* Motion of a unit plate between slip walls, from velocities that shear and stretch it. */
Scene plate(Analysis analysis, const Law& law, int cells, double time)
{
	const double h = 1. / cells;
	Scene        s;
	s.laws = { law };
	for (int d = 0; d < 2; ++d)
		s.walls.push_back(Scene::wall(d, 1, 0, Wall::Kind::slip)), s.walls.push_back(Scene::wall(d, -1, 1, Wall::Kind::slip));
	if (analysis == Analysis::solid) s.walls.push_back(Scene::wall(2, 1, 0, Wall::Kind::slip)); // the middle plane
	s.addBox(dimension(analysis), { 0, 0, 0 }, { 1, 1, h }, h / 2);
	s.setVelocity([](auto x) {
		const double a = .02 * pi * soundSpeed;
		return Vector { a * std::sin(pi * x[0]) * (1 + std::cos(pi * x[1])), -a * std::sin(pi * x[1]), 0 };
	});
	s.control.dt = .2 * h / soundSpeed, s.control.thinning = analysis == Analysis::planeStress;
	s.start(analysis, ShapeKind::cubic, h);
	s.run(int(std::lround(time / s.control.dt)));
	return s;
}
/* Root mean square of the in-plane difference over that of the displacement. The plate is two cells thick. */
double plateDifference(const Law& law, int cells, double time)
{
	const Scene       solid = plate(Analysis::solid, law, cells, time), plane = plate(Analysis::planeStress, law, cells, time);
	const auto        a = solid.byId(), b = plane.byId();
	const std::size_t side       = std::size_t(2 * cells);
	double            difference = 0, norm = 0;
	for (std::size_t i = 0; i < a.size(); ++i)
		for (std::size_t d = 0; d < 2; ++d) {
			const std::size_t j = i % b.size(); // layer after layer
			const double      X = (double(d ? j / side : j % side) + .5) / double(side), x = plane.points.position[d][b[j]];
			difference += std::pow(solid.points.position[d][a[i]] - x, 2), norm += std::pow(x - X, 2);
		}
	return std::sqrt(difference / norm);
}

TEST(LongWaveTest, ThinPlateIsPlaneStress)
{
	Law j2   = Scene::elastic(young, poisson, density);
	j2.model = J2(), as<J2>(j2).yieldStress = young / 50, as<J2>(j2).hardening = young / 20;
	for (double time : { .005, .015 }) { // a quarter and three quarters of a period: far from rest
		const double elastic = plateDifference(Scene::elastic(young, poisson, density), 20, time), yielding = plateDifference(j2, 20, time);
		EXPECT_LT(elastic, .02);
		EXPECT_LT(yielding, .03);
		EXPECT_GT(plateDifference(Scene::elastic(young, poisson, density), 10, time), 2 * elastic);
		EXPECT_GT(plateDifference(j2, 10, time), 2 * yielding);
	}
}

} // namespace
