// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "Scene.hpp"
#include <ctime>

namespace yade::mpm {

inline const double pi = std::acos(-1.);

/* What the steps of a scene take: CPU time of the process [s], and points times steps. */
struct Cost {
	double seconds = 0, pointSteps = 0;

	void step(Scene& s, bool finish)
	{
		const double start = now();
		s.step();
		if (finish) s.solver->finish();
		seconds += now() - start, pointSteps += double(s.points.count());
	}
	static double now()
	{
		timespec t;
		clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
		return double(t.tv_sec) + 1e-9 * double(t.tv_nsec);
	}
};

/* Manufactured solutions in large deformation (V1 and V2).

Unit line, square or cube between slip walls, E = 1e7, rho = 1000, c = 100; along every axis a
  u_a = G sin(pi X_a) sin(pi c t + phase_a),  F_a = 1 + du_a/dX_a,
phases 0, pi, 0. With the hypoelastic law sigma_a = M ln F_a + lambda sum ln F_b and P_a = sigma_a prod_(b != a) F_b the body
force that makes it so is
  b_a = pi^2 u_a [M prod_(b != a) F_b / (rho F_a) - c^2],
M the modulus of a strain along one axis: E in one dimension, E/(1 - nu^2) in plane stress of constant thickness,
lambda + 2 mu in plane strain and 3D. Plane stress that thins has F_3 = (F_x F_y)^(-nu/(1-nu)) and
  b_x = pi^2 u_x {F_y F_3/(rho F_x) [E/(1 - nu^2) - nu/(1 - nu) sigma_x] - c^2}.

One-dimensional problem after Wallstedt & Guilkey, J. Comput. Phys. 227 (2008) 9628; shipped with Nguyen, de Vaucorbeil &
Bordas, The Material Point Method, Springer 2023 ("published" below). nu = 0 in V1, 0.3 in V2. 2 points a cell and axis,
dt = 0.2 h/c, one period, pure FLIP. error = greatest over time of sqrt(sum V_p |x_p - x_exact|^2), V_p current. */
struct Manufactured {
	Analysis  analysis;
	ShapeKind shape;
	double    amplitude;
	double    poisson       = .3;
	int       pointsPerCell = 2; // along an axis
	bool      thinning      = false;
	Scheme    scheme        = Scheme::musl;
	double    periods       = 1;
	double    courant       = .2;
	double    flip          = 1;
	bool      largeStrain = true, meanDilatation = false, fullMass = false;
	int       every = 1; // steps between two looks at the error

	double error(int cells) const
	{
		Cost cost;
		return error(cells, cost);
	}
	double error(int cells, Cost& cost) const
	{
		const double young = 1e7, density = 1000, c = 100, h = 1. / cells;
		const int    dim = dimension(analysis);
		Scene        s;
		s.laws = { Scene::elastic(young, poisson, density) };
		for (int d = 0; d < dim; ++d)
			s.walls.push_back(Scene::wall(d, 1, 0, Wall::Kind::slip)), s.walls.push_back(Scene::wall(d, -1, 1, Wall::Kind::slip));
		s.addBox(dim, { 0, 0, 0 }, { 1, 1, 1 }, h / pointsPerCell);
		const Columns X = s.points.position; // by id
		const double  G = amplitude, sign[3] = { 1, -1, 1 };
		s.setVelocity([&](auto x) {
			std::array<double, 3> v {};
			for (int d = 0; d < dim; ++d)
				v[d] = sign[d] * pi * c * G * std::sin(pi * x[d]);
			return v;
		});
		const Hooke  hooke = s.laws[0].elastic;
		const double M     = analysis == Analysis::uniaxial ? young : analysis == Analysis::planeStress ? hooke.plane : hooke.lame + 2 * hooke.shear;
		s.control.dt = courant * h / c, s.control.thinning = thinning, s.control.scheme = scheme, s.control.flip = flip,
		s.control.largeStrain = largeStrain, s.control.meanDilatation = meanDilatation, s.control.fullMass = fullMass;
		s.start(analysis, shape, h, true);

		double    greatest = 0;
		const int steps    = int(std::lround(periods * .02 / s.control.dt));
		for (int k = 0; k < steps; ++k) {
			const double wave = std::sin(pi * c * s.control.time);
			for (std::size_t p = 0; p < s.points.count(); ++p) {
				double u[3] {}, F[3] { 1, 1, 1 };
				for (int d = 0; d < dim; ++d) {
					const double x = X[d][std::size_t(s.points.id[p])], a = sign[d] * G * wave;
					u[d] = a * std::sin(pi * x), F[d] = 1 + pi * a * std::cos(pi * x);
				}
				const double J = F[0] * F[1] * F[2];
				for (int d = 0; d < dim; ++d) {
					double stiffness = M * J / (density * F[d] * F[d]);
					if (thinning) {
						const double nu = poisson, sigma = M * (std::log(F[d]) + nu * std::log(F[1 - d]));
						stiffness = F[1 - d] * std::pow(J, -nu / (1 - nu)) / (density * F[d]) * (M - nu / (1 - nu) * sigma);
					}
					s.points.force[d][p] = s.points.mass[p] * pi * pi * u[d] * (stiffness - c * c);
				}
			}
			const bool look = (k + 1) % every == 0;
			cost.step(s, look);
			if (!look) continue;
			const double now = std::sin(pi * c * s.control.time);
			double       sum = 0;
			for (std::size_t p = 0; p < s.points.count(); ++p)
				for (int d = 0; d < dim; ++d) {
					const double x     = X[d][std::size_t(s.points.id[p])];
					const double error = s.points.position[d][p] - x - sign[d] * G * now * std::sin(pi * x);
					sum += s.volume(p) * error * error;
				}
			greatest = std::max(greatest, std::sqrt(sum));
		}
		return greatest;
	}
	std::vector<double> errors(const std::vector<int>& cells) const
	{
		std::vector<double> result;
		for (int n : cells)
			result.push_back(error(n));
		return result;
	}
};

/* A bar of the hysteretic law, n = 2, loaded beyond the knee and unloaded. Unit length between slip walls, E = 1e7, rho = 1000, c = 100,
sigma_y = E/20, alpha = 0.05; u = G s(t) sin(pi X), s = (1 - cos(pi t/T))/2, up to 1.35 T: the strain ln F grows until T, where at the ends it is
1.3 yield strains (tanh 1.3 = 0.86), and then shrinks by a quarter, without passing f = 0. With x = E ln F/sigma_y and X_m, F_m of the time T the law is,
exactly, loading    sigma = alpha E ln F + (1 - alpha) sigma_y tanh x unloading  sigma = alpha E ln F + (1 - alpha) [sigma_y tanh x_m + E (ln F - ln F_m)] (beta
= gamma = 1/2), and the body force that makes it so b = u'' - (1/rho) d sigma/dX,  d ln F/dX = -pi^2 u/F, with d sigma/dX = [alpha E + (1 - alpha) E sech^2 x] d
ln F/dX while loading, and alpha E d ln F/dX + (1 - alpha) E [sech^2 x_m d ln F_m/dX
+ d ln F/dX - d ln F_m/dX] after it. scripts/verification/hysteretic_solution.py checks both by computer algebra. */
struct HystereticBar {
	ShapeKind shape;
	Method    method        = Scheme::musl;
	int       pointsPerCell = 2;
	double    tolerance     = 1e-4;
	double    courant       = .2;
	double    amplitude     = .02;
	int       every         = 1;
	double    stressError   = 0; // out: at the end, root mean square over sigma_y

	static constexpr double young = 1e7, density = 1000, c = 100, ratio = .05, period = .02;
	double                  yieldStress = young / 20;
	static double           loading(double t) { return .5 * (1 - std::cos(pi * t / period)); }
	double                  stress(double X, double t) const
	{
		const double log = strain(X, loading(t));
		if (t <= period) return ratio * young * log + (1 - ratio) * yieldStress * std::tanh(young * log / yieldStress);
		const double peak = strain(X, 1);
		return ratio * young * log + (1 - ratio) * (yieldStress * std::tanh(young * peak / yieldStress) + young * (log - peak));
	}
	double bodyForce(double X, double t) const
	{
		const double u2    = amplitude * .5 * pi * pi / (period * period) * std::cos(pi * t / period) * std::sin(pi * X);
		auto         slope = [&](double s) { return -pi * pi * amplitude * s * std::sin(pi * X) / (1 + pi * amplitude * s * std::cos(pi * X)); };
		auto         knee  = [&](double s) { return 1 / std::pow(std::cosh(young * strain(X, s) / yieldStress), 2); };
		const double now = slope(loading(t)), peak = slope(1);
		double       gradient = ratio * young * now;
		if (t <= period)
			gradient += (1 - ratio) * young * knee(loading(t)) * now;
		else
			gradient += (1 - ratio) * young * (knee(1) * peak + now - peak);
		return u2 - gradient / density;
	}
	/* Greatest over time of sqrt(sum V_p |x_p - x_exact|^2). */
	double error(int cells)
	{
		Cost cost;
		return error(cells, cost);
	}
	double error(int cells, Cost& cost)
	{
		const double h = 1. / cells;
		Scene        s;
		Law          law           = Scene::boucWen(young, 0, density, yieldStress, 2, ratio);
		as<BoucWen>(law).tolerance = tolerance;
		s.laws                     = { law };
		s.walls                    = { Scene::wall(0, 1, 0, Wall::Kind::slip), Scene::wall(0, -1, 1, Wall::Kind::slip) };
		s.addBox(1, { 0, 0, 0 }, { 1, 0, 0 }, h / pointsPerCell);
		const Column X = s.points.position[0]; // by id
		s.setVelocity([&](auto x) {            // half a step before the start, as leapfrog has it
			return std::array<double, 3> { -.5 * courant * h / c * amplitude * .5 * pi * pi / (period * period) * std::sin(pi * x[0]), 0, 0 };
		});
		s.control.dt = courant * h / c;
		method.set(s.control);
		s.start(Analysis::uniaxial, shape, h, true);
		double    greatest = 0;
		const int steps    = int(std::lround(1.35 * period / s.control.dt));
		for (int k = 0; k < steps; ++k) {
			for (std::size_t p = 0; p < s.points.count(); ++p)
				s.points.force[0][p] = s.points.mass[p] * bodyForce(X[std::size_t(s.points.id[p])], s.control.time);
			const bool look = (k + 1) % every == 0 || k + 1 == steps;
			cost.step(s, look);
			if (!look) continue;
			double sum = 0, stresses = 0;
			for (std::size_t p = 0; p < s.points.count(); ++p) {
				const double x     = X[std::size_t(s.points.id[p])];
				const double error = s.points.position[0][p] - x - amplitude * loading(s.control.time) * std::sin(pi * x);
				const double off   = (s.points.stress[0][p] - stress(x, s.control.time)) / yieldStress;
				sum += s.volume(p) * error * error, stresses += s.volume(p) * off * off;
			}
			greatest = std::max(greatest, std::sqrt(sum)), stressError = std::sqrt(stresses);
		}
		return greatest;
	}

private:
	double strain(double X, double s) const { return std::log(1 + pi * amplitude * s * std::cos(pi * X)); }
};

} // namespace yade::mpm
