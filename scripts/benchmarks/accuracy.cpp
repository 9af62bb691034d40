// SPDX-License-Identifier: GPL-2.0-or-later
// Error and cost of the cases of doc/accuracy, as CSV: scripts/benchmarks/accuracy runs it and draws.
//   mpm_accuracy [errors [first letters of a problem's name] | steps | columns | drift]
#include "../../tests/kernel/StepLimit.hpp"
#include "../../tests/kernel/VibratingBar.hpp"
#include "../../tests/kernel/WeightColumn.hpp"
#include "kernel/TileGrid.hpp"
#include "kernel/transfer/ShapeFunction.hpp"
#include <cstdio>
#include <fstream>

using namespace yade::mpm;

namespace {

struct Choice {
	ShapeKind   shape         = ShapeKind::cubic;
	Scheme      scheme        = Scheme::musl;
	int         pointsPerCell = 2; // along an axis
	const char* variant       = "";
	bool        fullMass      = false;

	Method method() const { return { scheme, fullMass }; }
};

std::string only; // problems whose names begin with it

/* errors(cells, cost) on one grid after another, one of each problem; a run that breaks down has none. */
template <std::size_t N, class Errors>
void refine(const std::array<const char*, N>& problems, const Choice& k, int dim, std::initializer_list<int> cells, Errors&& errors)
{
	if (std::string(problems[0]).rfind(only, 0) != 0) return;
	for (int n : cells) {
		Cost                  cost;
		std::array<double, N> e;
		e.fill(HUGE_VAL);
		try {
			e = errors(n, cost);
		} catch (const StepFailure&) {
		}
		for (std::size_t i = 0; i < N; ++i)
			std::printf("%s,%s,%s,%d,%s,%d,%.6g,%.0f,%.4g\n", problems[i], name(k.shape), name(k.scheme), ipow(k.pointsPerCell, dim), k.variant, n,
				e[i], cost.pointSteps, cost.seconds);
		std::fflush(stdout);
	}
}
template <class Error> void refine(const char* problem, const Choice& k, int dim, std::initializer_list<int> cells, Error&& error)
{
	refine(std::array { problem }, k, dim, cells, [&](int n, Cost& cost) { return std::array { error(n, cost) }; });
}

/* A shape function, a scheme, a density of points changed at a time from cubic MUSL with 2 points a cell and axis. */
std::vector<Choice> choices(int most)
{
	std::vector<Choice> list;
	for (ShapeKind shape : allShapes) {
		for (Scheme scheme : allSchemes)
			list.push_back({ shape, scheme, 2, "" });
		list.push_back({ shape, Scheme::musl, 2, "full mass", true });
		for (int n = 1; n <= most; ++n)
			if (n != 2) list.push_back({ shape, Scheme::musl, n, "" });
	}
	return list;
}

void manufactured(const char* problem, Analysis analysis, double amplitude, double poisson, const Choice& k, double courant, bool largeStrain,
	std::initializer_list<int> cells)
{
	Manufactured m { analysis, k.shape, amplitude, poisson };
	m.pointsPerCell = k.pointsPerCell, m.scheme = k.scheme, m.fullMass = k.fullMass, m.courant = courant, m.largeStrain = largeStrain;
	m.every = courant > .5 ? 1 : 5;
	refine(problem, k, dimension(analysis), cells, [&](int n, Cost& cost) { return m.error(n, cost); });
}

void hystereticBar(const Choice& k, double tolerance, double yieldStrain = .05)
{
	HystereticBar bar { k.shape, k.method(), k.pointsPerCell, tolerance };
	bar.yieldStress = bar.young * yieldStrain, bar.every = 5;
	refine(yieldStrain < .05 ? "hysteretic far" : "hysteretic", k, 1, { 8, 16, 32, 64, 128 }, [&](int n, Cost& cost) { return bar.error(n, cost); });
}

/* V4: greatest internal force on a node, over all places of an even lattice under unit stress; spacing in cells. */
template <class Shape> double quadrature(double spacing, double r)
{
	double worst = 0;
	for (int place = 0; place < 400; ++place) {
		double f = 0;
		for (int k = -30; k <= 30; ++k) {
			const double x = (k + place / 400.) * spacing, base = std::floor(x - Shape::shift(r));
			double       N[4], dN[4];
			Shape::evaluate(x, base, r, N, dN);
			for (int i = 0; i < Shape::support; ++i)
				if (int(base) + i == 0) f += spacing * dN[i];
		}
		worst = std::max(worst, std::abs(f));
	}
	return worst;
}

/* V6: a gravity [m/s2], and the displacement (x, y) of the material point (3.9, 0.5) under it, every 0.01 s, computed with finite elements
(tests/data). */
struct SoftCantilever {
	const char*                        problem;
	double                             gravity;
	std::vector<std::array<double, 2>> reference;

	SoftCantilever(const char* name, double g, const char* data, std::size_t rows)
	    : problem(name)
	    , gravity(g)
	{
		std::ifstream file(std::string(MPM_TEST_DATA "/") + data);
		std::string   line;
		std::getline(file, line);
		double t, x, y;
		char   comma;
		while (file >> t >> comma >> x >> comma >> y)
			reference.push_back({ x, y });
		if (reference.size() != rows)
			throw std::runtime_error(
				std::string(data) + ": " + std::to_string(rows) + " rows wanted, " + std::to_string(reference.size()) + " found");
	}
	/* Greatest distance from it [m]; cells across the height of 1 m. A beam that comes apart has none. */
	double error(const Choice& k, int cells, Cost& cost) const
	{
		const double h = 1. / cells, spacing = h / k.pointsPerCell;
		const int    nx = int(std::lround(4 / spacing));
		Scene        s;
		s.laws  = { Scene::elastic(1e6, .3, 1050) };
		s.walls = { Scene::wall(0, 1, 0, Wall::Kind::fixed) };
		s.addBox(2, { 0, 0, 0 }, { 4, 1, 0 }, spacing);
		s.start(Analysis::planeStrain, k.shape, h);
		s.control.dt = .005 / cells, s.control.gravity = { 0, -gravity, 0 };
		k.method().set(s.control);
		const double at[2] { 3.9 / spacing - .5, .5 / spacing - .5 };
		double       worst = 0;
		Continuity   continuity;
		for (std::size_t row = 1; row < reference.size(); ++row) {
			for (int step = 0; step < 2 * cells; ++step)
				cost.step(s, step == 2 * cells - 1);
			continuity.check(s.points, s.laws, s.walls, h, 2 * h, s.control.time);
			const auto byId = s.byId();
			double     off[2] { -reference[row][0] - 3.9, -reference[row][1] - .5 };
			for (int corner = 0; corner < 4; ++corner) {
				const int    i = int(at[0]) + corner % 2, j = int(at[1]) + corner / 2;
				const double weight = (1 - std::abs(at[0] - i)) * (1 - std::abs(at[1] - j));
				for (std::size_t d = 0; d < 2; ++d)
					off[d] += weight * s.points.position[d][byId[std::size_t(j * nx + i)]];
			}
			worst = std::max(worst, std::hypot(off[0], off[1]));
		}
		return worst;
	}
};

/* Displacement of the end [m] at a load [N], on the way up (branch 1) or down (2), computed with finite elements (tests/data). */
double finiteElements(int branch, double load)
{
	std::ifstream file(MPM_TEST_DATA "/cantilever/static_perfectly_plastic.csv");
	std::string   line;
	while (std::getline(file, line)) {
		int    b;
		double force, displacement;
		if (std::sscanf(line.c_str(), "%d,%lf,%lf", &b, &force, &displacement) == 3 && b == branch && force == load) return displacement;
	}
	throw std::runtime_error("static_perfectly_plastic.csv has no load of " + std::to_string(load) + " N");
}
/* Example 4.1 (doc/verification/cantilever-static.md), cells across the depth of 0.1 m. The load is that of the end face: 1.5 of it on the last
column of points, -0.5 on the one before, and so is the displacement. Its errors: elastic, of the deflection under 10 kN; else, perfectly plastic,
of that under 28 kN, and of what is left of it when they are taken off. */
std::array<double, 2> staticCantilever(const Choice& k, int cells, bool plastic, Cost& cost)
{
	const double depth = .1, thickness = .05, spacing = depth / cells / k.pointsPerCell, greatest = plastic ? 28e3 : 10e3;
	const double up = plastic ? .2 : .08, down = plastic ? .1 : 0, rest = plastic ? .03 : .04; // [s]; a period takes 0.012 s
	const int    rows = cells * k.pointsPerCell, columns = int(std::lround(1 / spacing));
	Scene        s;
	s.laws = { Scene::elastic(210e9, .3, 7850) };
	if (plastic) s.laws = { Scene::boucWen(210e9, .3, 7850, 240e6, 100, 0) };
	as<BoucWen>(s.laws[0]).reloading = 2;
	s.walls                          = { Scene::wall(0, 1, 0, Wall::Kind::fixed) };
	s.addBox(2, { 0, -depth / 2, 0 }, { 1, depth / 2, 0 }, spacing);
	const Column start = s.points.position[1];
	Column       weight(s.points.count(), 0);
	for (int row = 1; row <= rows; ++row)
		weight[std::size_t(row * columns - 1)] = 1.5 / rows, weight[std::size_t(row * columns - 2)] = -.5 / rows;
	s.start(Analysis::planeStress, k.shape, depth / cells, true);
	s.control.scheme = k.scheme, s.control.damping = .005;
	s.control.dt = .7 * s.solver->criticalTimeStep(k.scheme);
	auto ramp    = [](double x) { return x * x * x * (10 + x * (-15 + 6 * x)); };
	auto advance = [&](double until, auto&& load) {
		double sum = 0;
		int    n   = 0;
		for (; s.control.time < until; ++n) {
			const double now = load(s.control.time) / thickness;
			double       tip = 0;
			for (std::size_t p = 0; p < s.points.count(); ++p) {
				const auto id        = std::size_t(s.points.id[p]);
				s.points.force[1][p] = -now * weight[id];
				tip -= weight[id] * (s.points.position[1][p] - start[id]);
			}
			cost.step(s, false);
			sum += tip;
		}
		return sum / n; // the mean deflection
	};
	advance(up, [&](double t) { return greatest * ramp(t / up); });
	const double bent = advance(up + rest, [&](double) { return greatest; }) / finiteElements(1, greatest) - 1;
	if (!plastic) return { std::abs(bent), 0 };
	advance(up + rest + down, [&](double t) { return greatest * ramp(1 - (t - up - rest) / down); });
	const double left = advance(up + rest + down + rest, [](double) { return 0; }) / finiteElements(2, 0) - 1;
	return { std::abs(bent), std::abs(left) };
}

/* Ten million steps of a body that breathes in free space: its energy (mean over 500 steps, that of half steps otherwise) over that at the
start, and where its centre of mass has come to, in cells. part of c: its greatest speed. filterTime: in times 2 L/c, about a period. */
void drift(const char* what, Analysis analysis, Method method, int cells, double part = .01, double courant = .2, double filterTime = 0, long last = 10000000)
{
	const double young = 1e7, density = 1000, poisson = analysis == Analysis::uniaxial ? 0 : .3, c = 100, h = 1. / cells, speed = part * c;
	Scene        s;
	s.laws = { Scene::elastic(young, poisson, density) };
	s.addBox(dimension(analysis), { .1 * h, .3 * h, 0 }, { 1 + .1 * h, 1 + .3 * h, 0 }, h / 2);
	const double middle[] { .5 + .1 * h, .5 + .3 * h };
	s.setVelocity([&](auto x) {
		std::array<double, 3> v {};
		for (int d = 0; d < dimension(analysis); ++d)
			v[d] = speed * std::sin(pi * (x[d] - middle[d]));
		return v;
	});
	s.start(analysis, ShapeKind::cubic, h);
	s.control.dt     = courant * h / c;
	const long every = filterTime > 0 ? std::max(1l, std::lround(.02 * filterTime * 2 / c / s.control.dt)) : 0; // as the engine does
	method.set(s.control);
	Continuity continuity;
	auto       step = [&, k = 0l]() mutable {
                s.control.filter = every && ++k % every == 0 ? -std::expm1(-double(every) * s.control.dt / (filterTime * 2 / c)) : 0;
                s.step();
	};
	auto energy = [&] {
		double sum = s.kineticEnergy();
		for (std::size_t p = 0; p < s.points.count(); ++p)
			sum += s.points.volume0[p] * storedEnergy(analysis, s.laws[0], s.points, p).elastic;
		return sum;
	};
	auto centre = [&](std::size_t d) {
		double sum = 0;
		for (std::size_t p = 0; p < s.points.count(); ++p)
			sum += s.points.mass[p] * s.points.position[d][p];
		return sum / s.mass();
	};
	const double x0 = centre(0), y0 = centre(1);
	double       start = 0;
	long         done  = 0;
	for (long to : { 500l, 10000l, 100000l, 1000000l, 10000000l }) {
		if (to > last) break;
		double mean = 0;
		try {
			for (; done < to; ++done) {
				step();
				if (done % 1000 == 0) continuity.check(s.points, s.laws, s.walls, h, 2 * h, s.control.time);
				if (done >= to - 500) s.solver->finish(), mean += energy() / 500;
			}
		} catch (const StepFailure&) {
			std::printf("%s,%s,%zu,%ld,comes apart,\n", what, name(method.scheme), s.points.count(), done);
			return;
		}
		if (to == 500) start = mean;
		std::printf("%s,%s,%zu,%ld,%.6f,%.3g\n", what, name(method.scheme), s.points.count(), to, mean / start,
			std::hypot(centre(0) - x0, centre(1) - y0) / h);
		std::fflush(stdout);
	}
}

/* The stable step as computed and as found in runs, in cells over the wave speed: in the bulk, and with a free end at every place in a cell. */
void stepLimits(const char* body, Analysis analysis)
{
	for (ShapeKind shape : allShapes)
		for (Method method : allMethods) {
			const StepLimit limit { analysis, shape, method };
			auto            row = [&](const char* where, double place) {
                                const Scene s = limit.body(where == std::string("edge"), place);
                                std::printf("%s,%s,\"%s\",%s,%.4f,%.4g,%.4g\n", body, name(shape), name(method).c_str(), where, place, limit.computed(s),
						   limit.actual(s));
			};
			row("bulk", 0);
			for (double place : StepLimit::places())
				row("edge", place);
		}
}

} // namespace

int main(int count, char** arguments)
{
	const std::string part = count > 1 ? arguments[1] : "errors";
	if (part == "drift") {
		std::printf("body,scheme,points,steps,energy,centre_cells\n");
		for (Scheme scheme : allSchemes)
			drift("bar", Analysis::uniaxial, scheme, 8);
		const Method lumped = Scheme::musl, full { Scheme::musl, true };
		drift("square", Analysis::planeStrain, lumped, 4);
		drift("square (a quarter of the step)", Analysis::planeStrain, lumped, 4, .01, .05);
		drift("square (a tenth of the motion)", Analysis::planeStrain, lumped, 4, .001);
		drift("square (filterTime 10 periods)", Analysis::planeStrain, lumped, 4, .01, .2, 10);
		drift("square (full mass)", Analysis::planeStrain, full, 4);
		drift("square (full mass and filterTime 10 periods)", Analysis::planeStrain, full, 4, .01, .2, 10);
		for (double filterTime : { 0., 100. })
			drift(filterTime ? "square of 16 x 16 cells (full mass and filterTime 100 periods)" : "square of 16 x 16 cells (full mass)",
				Analysis::planeStrain, full, 16, .01, .2, filterTime, 100000);
		return 0;
	}
	if (part == "steps") {
		std::printf("body,shape,scheme,where,place,computed,actual\n");
		stepLimits("bar", Analysis::uniaxial), stepLimits("plate", Analysis::planeStrain);
		return 0;
	}
	if (part == "columns") {
		std::printf("load,shape,spread,first_point,wall_force\n");
		for (double load : { -.3, -.1, -.01, .01, .02, .05, .07, .1, .15, .2, .3 })
			for (ShapeKind shape : allShapes)
				try {
					const WeightColumn column(shape, load);
					std::printf("%g,%s,%.4f,%.4f,%.5f\n", load, name(shape), column.spread, column.firstPoint, column.wallForce);
				} catch (const StepFailure&) {
					std::printf("%g,%s,,,\n", load, name(shape));
				}
		return 0;
	}
	if (count > 2) only = arguments[2];
	std::printf("problem,shape,scheme,points_a_cell,variant,cells,error,point_steps,cpu_seconds\n");
	for (double spacing : { .25, .3, 1. / 3, .45, .5, .55, .6, .7, .8, 1., 1.2, 1.5, 2. }) {
		const double values[] { quadrature<LinearShape>(spacing, 0), quadrature<GimpShape>(spacing, .25), quadrature<QuadraticShape>(spacing, 0),
			quadrature<CubicShape>(spacing, 0) };
		for (ShapeKind shape : allShapes)
			std::printf("V4,%s,,,%.3f,,%.3g,,\n", name(shape), spacing, values[std::size_t(shape)]);
	}
	for (double amplitude : { 1e-4, .05 }) {
		const bool small = amplitude < .01;
		for (Choice k : choices(4)) {
			manufactured(small ? "V1 small" : "V1 large", Analysis::uniaxial, amplitude, 0, k, .2, true, { 8, 16, 32, 64, 128 });
			if (k.pointsPerCell < 4)
				manufactured(small ? "V2 small" : "V2 large", Analysis::planeStress, amplitude, .3, k, .2, true, { 4, 8, 16, 32 });
		}
		for (ShapeKind shape : allShapes) {
			manufactured(small ? "V2 small" : "V2 large", Analysis::planeStress, amplitude, .3, { shape, Scheme::musl, 2, "dt x 3" }, .6, true,
				{ 4, 8, 16, 32 });
			manufactured(small ? "V2 small" : "V2 large", Analysis::planeStress, amplitude, .3, { shape, Scheme::musl, 2, "small strain" }, .2,
				false, { 4, 8, 16, 32 });
			manufactured(small ? "V2 small" : "V2 large", Analysis::planeStress, amplitude, .3,
				{ shape, Scheme::musl, 2, "full mass dt x 3", true }, .6, true, { 4, 8, 16, 32 });
		}
	}
	const SoftCantilever toItsLowest("V6", 10, "soft_cantilever_fe.csv", 111), published("V6 published", 10, "soft_cantilever_fe_3s.csv", 301),
		gentle("V6 three seconds", 6, "soft_cantilever_fe_6.csv", 301);
	std::vector<Choice> beams = choices(4);
	for (int n : { 3, 4 })
		beams.push_back({ ShapeKind::cubic, Scheme::musl, n, "full mass", true });
	for (const Choice& k : beams) {
		if (k.pointsPerCell == 1) continue;
		for (const SoftCantilever* beam : { &toItsLowest, &published })
			refine(beam->problem, k, 2, { 2, 4, 8 }, [&](int n, Cost& cost) { return beam->error(k, n, cost); });
		refine(gentle.problem, k, 2, { 2, 4, 8, 12 }, [&](int n, Cost& cost) { return gentle.error(k, n, cost); });
	}
	for (const Choice& k : choices(3))
		hystereticBar(k, 1e-4), hystereticBar(k, 1e-4, .02);
	hystereticBar({ ShapeKind::cubic, Scheme::musl, 2, "tolerance 1e-2" }, 1e-2);
	hystereticBar({ ShapeKind::cubic, Scheme::musl, 2, "tolerance 1e-6" }, 1e-6);
	hystereticBar({ ShapeKind::cubic, Scheme::musl, 2, "tolerance 1e-8" }, 1e-8);
	for (double v0 : { .1, .75 })
		for (ShapeKind shape : allShapes)
			for (Method method : allMethods) {
				const Choice k { shape, method.scheme, 2, method.fullMass ? "full mass" : "", method.fullMass };
				refine(std::array { v0 < .5 ? "V3 velocity" : "V3 large velocity", v0 < .5 ? "V3 energy" : "V3 large energy" }, k, 1,
					{ 16, 32, 64 }, [&](int n, Cost& cost) {
						const Bar bar = vibrate(shape, n, method, v0, 1, &cost);
						return std::array { bar.velocityError, std::abs(bar.energyRatio - 1) };
					});
			}
	for (const Choice& k : choices(3)) {
		if (k.fullMass) continue; // what is at rest does not know of it
		refine("static elastic", k, 2, { 2, 4, 6 }, [&](int n, Cost& cost) { return staticCantilever(k, n, false, cost)[0]; });
		if (k.scheme == Scheme::musl && k.pointsPerCell > 1)
			refine(std::array { "static plastic", "static residual" }, k, 2, { 2, 4, 6 },
				[&](int n, Cost& cost) { return staticCantilever(k, n, true, cost); });
	}
}
