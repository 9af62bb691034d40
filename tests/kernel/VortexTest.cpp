// SPDX-License-Identifier: GPL-2.0-or-later
/* A manufactured solution with large shear and rotation, which those stretched along the axes do not have; after the generalised vortex
of Kamojjala, Brannon, Sadeghirad & Guilkey, Verification tests in solid mechanics, Engineering with Computers 31 (2015).

A point at radius R turns about the middle of a square by alpha = A s(t) g(R), g = (1 - R^2/R0^2)^4 within R0, at rest beyond it, where the walls are;
s = (1 - cos omega t)^2/4. In axes that turn with the point this is simple shear by gamma = R d alpha/dR, of constant volume, in plane stress, plane strain and
between slip walls in 3D alike. With Hencky's strain the stress is there, with r = sqrt(1 + gamma^2/4) and e = asinh(gamma/2),
  sigma_(theta r) = 2 mu e/r =: tau,  sigma_(theta theta) = -sigma_rr = gamma/2 tau,
and balance of momentum the body force a mass
  b_r = -R alpha'^2 + 1/rho [d(gamma tau/2)/dR + gamma tau/R],  b_theta = R alpha'' - 1/rho [d tau/dR + 2 tau/R]. */
#include "Manufactured.hpp"
#include <gtest/gtest.h>

using namespace yade::mpm;

namespace {

double shearStress(double gamma) { return 2 * std::asinh(.5 * gamma) / std::sqrt(1 + .25 * gamma * gamma); } // of mu

struct Vortex {
	double position = 0, stress = 0; // errors at the end, root mean squares [m], of mu

	Vortex(Analysis analysis, int cells)
	{
		const double h = 2. / cells, density = 1000, A = .8, R0 = .95, c = 100, omega = pi * c;
		const int    dim = dimension(analysis);
		Scene        s;
		s.laws = { Scene::elastic(1e7, .3, density) };
		for (int d = 0; d < dim; ++d)
			for (int side : { 1, -1 })
				s.walls.push_back(
					d < 2 ? Scene::wall(d, side, -side, Wall::Kind::fixed) : Scene::wall(d, side, side > 0 ? 0 : h, Wall::Kind::slip));
		s.addBox(dim, { -1, -1, 0 }, { 1, 1, h }, h / 2);
		const Columns X  = s.points.position; // by id
		const double  mu = s.laws[0].elastic.shear;
		s.control.dt     = .2 * h / c;
		s.start(analysis, ShapeKind::cubic, h, true);
		const int steps = int(std::lround(.01 / s.control.dt)); // to the greatest angle
		for (int k = 0; k < steps; ++k) {
			const double co = std::cos(omega * s.control.time), si = std::sin(omega * s.control.time);
			const double s0 = .25 * (1 - co) * (1 - co), s1 = .5 * omega * si * (1 - co), s2 = .5 * omega * omega * (co * (1 - co) + si * si);
			for (std::size_t p = 0; p < s.points.count(); ++p) {
				const auto   i = std::size_t(s.points.id[p]);
				const double R = std::hypot(X[0][i], X[1][i]), q = R < R0 ? 1 - R * R / (R0 * R0) : 0, g = A * q * q * q * q;
				const double gamma = -8 * A * s0 * q * q * q * R * R / (R0 * R0),
					     slope = -16 * A * s0 * q * q * R / (R0 * R0) * (q - 3 * R * R / (R0 * R0));
				const double tau = shearStress(gamma), rise = (1 - .25 * gamma * tau) / (1 + .25 * gamma * gamma); // of mu; d tau/d gamma
				const double br      = -R * std::pow(s1 * g, 2) + mu / density * (.5 * (tau + gamma * rise) * slope + gamma * tau / R);
				const double bt      = R * s2 * g - mu / density * (rise * slope + 2 * tau / R);
				const double angle   = std::atan2(X[1][i], X[0][i]) + s0 * g;
				s.points.force[0][p] = s.points.mass[p] * (br * std::cos(angle) - bt * std::sin(angle));
				s.points.force[1][p] = s.points.mass[p] * (br * std::sin(angle) + bt * std::cos(angle));
			}
			s.step();
		}
		s.solver->finish();
		double volume = 0, greatest = 0;
		for (std::size_t p = 0; p < s.points.count(); ++p) {
			const auto   i = std::size_t(s.points.id[p]);
			const double R = std::hypot(X[0][i], X[1][i]), q = R < R0 ? 1 - R * R / (R0 * R0) : 0;
			const double gamma = -8 * A * q * q * q * R * R / (R0 * R0), angle = std::atan2(X[1][i], X[0][i]) + A * q * q * q * q;
			const double off[2] = { s.points.position[0][p] - R * std::cos(angle), s.points.position[1][p] - R * std::sin(angle) };
			const double shear = mu * shearStress(gamma), hoop = .5 * gamma * shear, co = std::cos(2 * angle), si = std::sin(2 * angle);
			// to the axes: twice the angle, the mean stress is zero
			const double      xx = -hoop * co - shear * si, xy = -hoop * si + shear * co;
			const auto&       sigma = s.points.stress;
			const std::size_t n     = sigma.size();
			position += (off[0] * off[0] + off[1] * off[1]) * s.volume(p);
			stress += (std::pow(sigma[0][p] - xx, 2) + std::pow(sigma[1][p] + xx, 2) + 2 * std::pow(sigma[n - 1][p] - xy, 2)) * s.volume(p)
				  / (mu * mu);
			volume += s.volume(p), greatest = std::max(greatest, std::abs(gamma));
		}
		EXPECT_NEAR(greatest, .675, .001) << "the largest shear";
		position = std::sqrt(position / volume), stress = std::sqrt(stress / volume);
	}
};

void expectSecondOrder(Analysis analysis, int cells, double position, double stress)
{
	SCOPED_TRACE(name(analysis));
	const Vortex coarse(analysis, cells / 2), fine(analysis, cells);
	EXPECT_NEAR(fine.position, position, .02 * position); // own
	EXPECT_NEAR(fine.stress, stress, .02 * stress);
	EXPECT_GT(std::log2(coarse.position / fine.position), 1.95);
	EXPECT_GT(std::log2(coarse.stress / fine.stress), 1.8);
}

TEST(LongVortexTest, PlaneStressAndPlaneStrain)
{
	expectSecondOrder(Analysis::planeStress, 64, 3.520e-4, 4.479e-3);
	expectSecondOrder(Analysis::planeStrain, 64, 3.468e-4, 4.725e-3);
}
TEST(LongVortexTest, ThreeDimensions) { expectSecondOrder(Analysis::solid, 32, 1.436e-3, 1.728e-2); }

} // namespace
