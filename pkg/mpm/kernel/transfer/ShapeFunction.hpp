// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <algorithm>
#include <cmath>

namespace yade::mpm {

/* One-dimensional shape functions on a grid of unit cells; in D dimensions N(x) is the product over the axes.

Each struct has
  support          number of consecutive nodes that a point touches
  row              the same, filled up to a whole number of vectors
  usesSize         whether the point's own size enters
  variance         sum N[k] (k - xi)^2 where it is the same at every place, else 0
  rounding         a node with no more than this part of a point's mass is none that it touches
  shift(r)         the first of those nodes is base = floor(xi - shift), for a point at xi (in cells, from node 0)
  evaluate(...)    values N[k] and derivatives dN[k] = dN/dxi at nodes base+k, k < support or < row

where r is half the point's size in cells (only GIMP looks at it). Steffen, Kirby & Berzins, Int. J. Numer. Meth.
Engng 76 (2008) 922; the quadratic spline is centred at a node, its knots at mid-cells. */

struct LinearShape {
	static constexpr int    support = 2, row = 2;
	static constexpr bool   usesSize = false;
	static constexpr double variance = 0;
	static constexpr double rounding = 0; // N is at least `beside` to the power of the dimension
	static double           shift(double) { return 0; }
	static void             evaluate(double xi, double base, double, double* N, double* dN)
	{
		const double s = std::min(std::max(xi - base, beside), 1 - beside);
		N[0] = 1 - s, N[1] = s;
		dN[0] = -1, dN[1] = 1;
	}

private:
	/* A point exactly on a node counts as this far beside it: the next node then has its velocity. Without any mass it would have none, and
	the point would see a gradient, which does not vanish with N, to nothing. */
	static constexpr double beside = 1e-15;
};

struct QuadraticShape {
	static constexpr int    support = 3, row = 4;
	static constexpr bool   usesSize = false;
	static constexpr double variance = 1. / 4;
	static constexpr double rounding = 1e-14;
	static double           shift(double) { return .5; }
	/* N = a + b u^2, u = o + g s, with s from the middle node, in [-1/2, 1/2) */
	template <int count = support> static void evaluate(double xi, double base, double, double* N, double* dN)
	{
		constexpr double a[4] = { 0, .75, 0, 0 }, b[4] = { .5, -1, .5, 0 }, o[4] = { .5, 0, .5, 0 }, g[4] = { -1, 1, 1, 0 };
		const double     s = xi - base - 1;
#pragma omp simd
		for (int k = 0; k < count; ++k) {
			const double u = o[k] + g[k] * s;
			N[k]           = a[k] + b[k] * u * u;
			dN[k]          = 2 * g[k] * b[k] * u;
		}
	}
};

struct CubicShape {
	static constexpr int    support = 4, row = 4;
	static constexpr bool   usesSize = false;
	static constexpr double variance = 1. / 3;
	static constexpr double rounding = 1e-14;
	static double           shift(double) { return 1; }
	/* N = a + u^2 (b + c u), u = o + g s: the distance from one of the two middle nodes, in [0, 1] */
	template <int count = support> static void evaluate(double xi, double base, double, double* N, double* dN)
	{
		constexpr double a[4] = { 0, 2. / 3, 2. / 3, 0 }, b[4] = { 0, -1, -1, 0 }, c[4] = { 1. / 6, .5, .5, 1. / 6 };
		constexpr double o[4] = { 1, 0, 1, 0 }, g[4] = { -1, 1, -1, 1 };
		const double     s = xi - base - 1;
#pragma omp simd
		for (int k = 0; k < count; ++k) {
			const double u = o[k] + g[k] * s;
			N[k]           = a[k] + u * u * (b[k] + c[k] * u);
			dN[k]          = g[k] * u * (2 * b[k] + 3 * c[k] * u);
		}
	}
};

/* Uniform GIMP: the hat averaged over the point's initial domain [xi - r, xi + r], 0 < r <= 1/2.
Bardenhagen & Kober, CMES 5 (2004) 477. */
struct GimpShape {
	static constexpr int    support = 3, row = 4;
	static constexpr bool   usesSize = true;
	static constexpr double variance = 0;
	static constexpr double rounding = 1e-14;
	static double           shift(double r) { return r; }
	static void             evaluate(double xi, double base, double r, double* N, double* dN)
	{
		for (int k = 0; k < support; ++k) {
			const double lo = clamp(xi - r - base - k), hi = clamp(xi + r - base - k);
			N[k]  = (integral(hi) - integral(lo)) / (2 * r);
			dN[k] = (hat(hi) - hat(lo)) / (2 * r);
		}
	}

private:
	static double clamp(double s) { return s < -1 ? -1 : s > 1 ? 1 : s; }
	static double hat(double s) { return 1 - std::abs(s); }
	static double integral(double s) { return s - .5 * s * std::abs(s); } // of the hat, from 0
};

} // namespace yade::mpm
