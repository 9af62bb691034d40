// SPDX-License-Identifier: GPL-2.0-or-later
/* The cases of transfers.py, described there, in the kernel, with the transfers that it has: what those of transfers.py must agree with. CSV;
scripts/benchmarks/accuracy runs both. */
#include "../../tests/kernel/VibratingBar.hpp"
#include <cstdio>

using namespace yade::mpm;

namespace {

const double young = 1e7, density = 1000, c = 100;

struct Transfer {
	const char* name;
	bool        fullMass, filtered;

	void set(StepControl& control, double tau) const { control.fullMass = fullMass, control.filter = filtered ? control.dt / tau : 0; }
};

void print(const Transfer& transfer, const char* what, const std::string& quantity, double value)
{
	std::printf("\"%s\",\"%s\",\"%s\",%.6g\n", what, quantity.c_str(), transfer.name, value);
	std::fflush(stdout);
}

std::string cellsOf(const char* quantity, int cells) { return quantity + (", " + std::to_string(cells)) + " cells"; }

Scene held(int cells, const Law& law, Wall::Kind kind)
{
	Scene s;
	s.laws = { law }, s.walls = { Scene::wall(0, 1, 0, kind) };
	s.addBox(1, { 0, 0, 0 }, { 1, 0, 0 }, .5 / cells);
	s.start(Analysis::uniaxial, ShapeKind::cubic, 1. / cells);
	s.control.dt = .2 / cells / c;
	return s;
}

void bar(const Transfer& transfer)
{
	for (double amplitude : { 1e-4, .05 }) {
		const char*  name = amplitude < .01 ? "bar, strain 3e-4" : "bar, strain 0.16";
		Manufactured m { Analysis::uniaxial, ShapeKind::cubic, amplitude, 0 };
		m.fullMass        = transfer.fullMass;
		const auto errors = m.errors({ 16, 32, 64 });
		print(transfer, name, "error, 16 cells", errors[0]);
		print(transfer, name, "error, 32 cells", errors[1]);
		print(transfer, name, "order, 32 to 64 cells", std::log2(errors[1] / errors[2]));
	}
	Manufactured coarse { Analysis::uniaxial, ShapeKind::cubic, 1e-4, 0 };
	coarse.fullMass   = transfer.fullMass;
	Manufactured fine = coarse;
	coarse.courant = .1, fine.courant = .05;
	print(transfer, "bar, strain 3e-4", "order with dt in proportion to h^2, 16 to 32 cells", std::log2(coarse.error(16) / fine.error(32)));
}

void vibratingBar(const Transfer& transfer)
{
	for (double v0 : { .1, .75 })
		for (int cells : { 16, 32 }) {
			const char* name   = v0 < .5 ? "vibrating bar" : "vibrating bar, large";
			const Bar   result = vibrate(ShapeKind::cubic, cells, { Scheme::musl, transfer.fullMass }, v0);
			print(transfer, name, cellsOf("velocity error", cells), result.velocityError);
			print(transfer, name, cellsOf("energy kept", cells), result.energyRatio);
		}
}

void nullSpace(const Transfer& transfer)
{
	const double ringing = 1e-3;
	Scene        s       = held(32, Scene::elastic(young, 0, density), Wall::Kind::slip);
	s.setVelocity([&](auto x) { return std::array<double, 3> { .01 * std::sin(.5 * pi * x[0]) + (int(64 * x[0]) % 2 ? -ringing : ringing), 0, 0 }; });
	transfer.set(s.control, .2);
	s.run(int(std::lround(.4 / s.control.dt)));
	const auto  at  = s.byId();
	const auto& v   = s.points.velocity[0];
	double      sum = 0;
	for (std::size_t i = 4; i + 5 < at.size(); ++i)
		sum += (i % 2 ? -.5 : .5) * (v[at[i]] - .5 * (v[at[i - 1]] + v[at[i + 1]]));
	print(transfer, "null space", "alternating velocities left", sum / double(at.size() - 9) / ringing);
}

void impact(const Transfer& transfer)
{
	const double ratio = .5;
	double       shock = 1;
	for (int k = 0; k < 200; ++k)
		shock = .5 * (shock - std::log(1 - ratio / shock) / ratio);
	Scene s = held(64, Scene::elastic(young, 0, density), Wall::Kind::slip);
	s.setVelocity([&](auto) { return std::array<double, 3> { -ratio * c, 0, 0 }; });
	s.control.dt     = .34 / 64 / c;
	const double end = .8 / (shock * c);
	transfer.set(s.control, .2);
	double impulse = 0, time = 0;
	while (s.control.time < end) {
		s.step();
		if (s.control.time > .1 * end) impulse += s.walls[0].force[0] * s.control.dt, time += s.control.dt;
	}
	print(transfer, "impact at half the wave speed", "wall force", -impulse / time / (young * shock * ratio));
}

void ratcheting(const Transfer& transfer)
{
	for (double reloading : { 0., HUGE_VAL }) {
		Law law                    = Scene::boucWen(young, 0, density, 1e-3 * young, 2, .05);
		as<BoucWen>(law).reloading = reloading;
		Scene        s             = held(16, law, Wall::Kind::slip);
		const double weight        = .9 * as<BoucWen>(law).yieldStress / density;
		s.control.damping          = .05;
		transfer.set(s.control, .2);
		for (int k = 0; k < 8000; ++k)
			s.control.gravity[0] = weight * std::min(1., (k + 1) / 4000.), s.step();
		s.solver->finish();
		s.control.damping = 0;
		for (std::size_t p = 0; p < s.points.count(); ++p)
			s.points.velocity[0][p] += .05 * std::sin(.5 * pi * s.points.position[0][p]);
		s.solver->pointsChanged();
		double mean[6] {};
		for (double& window : mean)
			for (int step = 0; step < 3200; ++step)
				s.step(), window += (s.points.position[0][s.byId().back()] - 1) / 3200;
		print(transfer, "ratcheting by noise", reloading > 0 ? "creep, elastic reloading" : "creep", (mean[5] - mean[1]) / mean[1]);
	}
}

void spin(const Transfer& transfer)
{
	const double rate = 100;
	for (int across : { 16, 32 }) {
		const double h = .8 / across;
		Scene        s;
		s.laws = { Scene::elastic(young, .3, density) };
		s.addBox(2, { -.2, -.2, 0 }, { .2, .2, 0 }, h / 2);
		const Columns X = s.points.position;
		s.setVelocity([&](auto x) { return std::array<double, 3> { -rate * x[1], rate * x[0], 0 }; });
		s.start(Analysis::planeStrain, ShapeKind::cubic, h);
		s.control.dt = 1.5e-4 * 16 / across;
		transfer.set(s.control, .035);
		auto angularMomentum = [&] {
			double      sum = 0;
			const auto &x = s.points.position, &v = s.points.velocity;
			for (std::size_t p = 0; p < s.points.count(); ++p)
				sum += s.points.mass[p] * (x[0][p] * v[1][p] - x[1][p] * v[0][p]);
			return sum;
		};
		const double start = angularMomentum();
		s.run(int(3 * 2 * pi / rate / s.control.dt));
		const auto at  = s.byId();
		double     gap = 0;
		for (int p = 0; p < across * across; ++p)
			for (int q : { p % across + 1 < across ? p + 1 : -1, p + across < across * across ? p + across : -1 }) {
				if (q < 0) continue;
				double x[2], meant[2] {};
				for (std::size_t d = 0; d < 2; ++d) {
					x[d] = s.points.position[d][at[q]] - s.points.position[d][at[p]];
					for (std::size_t e = 0; e < 2; ++e) {
						const Column& F = s.points.deformation[2 * d + e];
						meant[d] += .5 * (F[at[p]] + F[at[q]]) * (X[e][q] - X[e][p]);
					}
				}
				gap = std::max(gap, (std::hypot(x[0], x[1]) - std::hypot(meant[0], meant[1])) / h);
			}
		print(transfer, "spinning square", cellsOf("angular momentum kept", across / 2), angularMomentum() / start);
		print(transfer, "spinning square", cellsOf("widest gap [cells]", across / 2), gap);
	}
}

void disks(const Transfer& transfer)
{
	const double h = .05;
	Scene        s;
	s.laws = { Scene::elastic(1000, .3, 1000) };
	for (int j = 0; j < 40; ++j)
		for (int i = 0; i < 40; ++i) {
			const double x[3] { (i + .5) * h / 2, (j + .5) * h / 2, 0 };
			const bool   left = std::hypot(x[0] - .2, x[1] - .2) < .2, right = std::hypot(x[0] - .8, x[1] - .8) < .2;
			const double speed = left ? .1 : -.1, v[3] { speed, speed, 0 };
			if (left || right) s.points.append(int(s.points.count()), 0, x, v, 1000 * h * h / 4, h * h / 4, h / 2, 1);
		}
	s.start(Analysis::planeStrain, ShapeKind::cubic, h);
	s.control.dt = 1e-3;
	transfer.set(s.control, 2.5);
	const double start = s.kineticEnergy(), one = .1 * s.mass() / 2;
	double       worst = 0;
	for (int k = 0; k < 3500; ++k) {
		s.step();
		const auto P = s.momentum();
		worst        = std::max({ worst, std::abs(P[0]) / one, std::abs(P[1]) / one });
	}
	s.solver->finish();
	double stored = 0;
	for (std::size_t p = 0; p < s.points.count(); ++p)
		stored += s.volume(p) * storedEnergy(Analysis::planeStrain, s.laws[0], s.points, p).elastic;
	print(transfer, "two disks", "kinetic energy recovered", s.kineticEnergy() / start);
	print(transfer, "two disks", "energy kept", (s.kineticEnergy() + stored) / start);
	print(transfer, "two disks", "momentum over that of a disk", worst);
}

void stableStep(const Transfer& transfer)
{
	const double h    = .25;
	double       line = HUGE_VAL;
	for (double shift : { 0., .1, .25 }) {
		Scene s;
		s.laws = { Scene::elastic(young, 0, density) };
		s.addBox(1, { shift * h, 0, 0 }, { 2 + shift * h, 0, 0 }, h / 2);
		s.start(Analysis::uniaxial, ShapeKind::cubic, h);
		line = std::min(line, s.solver->criticalTimeStep(Scheme::musl, transfer.fullMass));
	}
	print(transfer, "stable step", "bar [h/c]", line * c / h);
	Scene s;
	s.laws = { Scene::elastic(young, .3, density) };
	s.addBox(2, { .1 * h, .3 * h, 0 }, { 1 + .1 * h, 1 + .3 * h, 0 }, h / 2);
	s.start(Analysis::planeStrain, ShapeKind::cubic, h);
	print(transfer, "stable step", "square [h/c]", s.solver->criticalTimeStep(Scheme::musl, transfer.fullMass) * c / h);
}

} // namespace

int main()
{
	std::printf("case,quantity,transfer,value\n");
	for (const Transfer& transfer :
		{ Transfer { "FLIP, kernel", false, false }, { "XPIC(2), tau, kernel", false, true }, { "full mass, kernel", true, false } }) {
		if (!transfer.filtered) bar(transfer), vibratingBar(transfer), stableStep(transfer);
		nullSpace(transfer), impact(transfer), ratcheting(transfer), spin(transfer), disks(transfer);
	}
}
