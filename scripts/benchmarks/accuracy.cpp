// SPDX-License-Identifier: GPL-2.0-or-later
// Error and cost of the cases of doc/accuracy, as CSV: scripts/benchmarks/accuracy runs it and draws.
#include "../../tests/kernel/VibratingBar.hpp"
#include "kernel/ShapeFunction.hpp"
#include "kernel/TileGrid.hpp"
#include <cstdio>

using namespace yade::mpm;

namespace {

struct Choice {
	ShapeKind   shape         = ShapeKind::cubic;
	Scheme      scheme        = Scheme::musl;
	int         pointsPerCell = 2; // along an axis
	const char* variant       = "";
};

/* error(cells, cost) on one grid after another; a run that breaks down has no error. */
template <class Error> void refine(const char* problem, const Choice& k, int dim, std::initializer_list<int> cells, Error&& error)
{
	for (int n : cells) {
		Cost   cost;
		double e = HUGE_VAL;
		try {
			e = error(n, cost);
		} catch (const StepFailure&) {
		}
		std::printf("%s,%s,%s,%d,%s,%d,%.6g,%.0f,%.4g\n", problem, name(k.shape), name(k.scheme), ipow(k.pointsPerCell, dim), k.variant, n, e,
			cost.pointSteps, cost.seconds);
		std::fflush(stdout);
	}
}

/* A shape function, a scheme, a density of points changed at a time from cubic MUSL with 2 points a cell and axis. */
std::vector<Choice> choices(int most)
{
	std::vector<Choice> list;
	for (ShapeKind shape : allShapes) {
		for (Scheme scheme : allSchemes)
			list.push_back({ shape, scheme, 2, "" });
		for (int n = 1; n <= most; ++n)
			if (n != 2) list.push_back({ shape, Scheme::musl, n, "" });
	}
	return list;
}

void manufactured(const char* problem, Analysis analysis, double amplitude, double poisson, const Choice& k, double courant, bool largeStrain,
	std::initializer_list<int> cells)
{
	Manufactured m { analysis, k.shape, amplitude, poisson };
	m.pointsPerCell = k.pointsPerCell, m.scheme = k.scheme, m.courant = courant, m.largeStrain = largeStrain;
	m.every = courant > .5 ? 1 : 5;
	refine(problem, k, dimension(analysis), cells, [&](int n, Cost& cost) { return m.error(n, cost); });
}

void hystereticBar(const Choice& k, double tolerance, double yieldStrain = .05)
{
	HystereticBar bar { k.shape, k.scheme, k.pointsPerCell, tolerance };
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

} // namespace

int main()
{
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
		}
	}
	for (const Choice& k : choices(3))
		hystereticBar(k, 1e-4), hystereticBar(k, 1e-4, .02);
	hystereticBar({ ShapeKind::cubic, Scheme::musl, 2, "tolerance 1e-2" }, 1e-2);
	hystereticBar({ ShapeKind::cubic, Scheme::musl, 2, "tolerance 1e-6" }, 1e-6);
	hystereticBar({ ShapeKind::cubic, Scheme::musl, 2, "tolerance 1e-8" }, 1e-8);
	for (double v0 : { .1, .75 })
		for (ShapeKind shape : allShapes)
			for (Scheme scheme : allSchemes) {
				const Choice k { shape, scheme, 2, "" };
				refine(v0 < .5 ? "V3 velocity" : "V3 large velocity", k, 1, { 16, 32, 64 },
					[&](int n, Cost& cost) { return vibrate(shape, n, scheme, v0, 1, &cost).velocityError; });
				refine(v0 < .5 ? "V3 energy" : "V3 large energy", k, 1, { 16, 32, 64 },
					[&](int n, Cost& cost) { return std::abs(vibrate(shape, n, scheme, v0, 1, &cost).energyRatio - 1); });
			}
}
