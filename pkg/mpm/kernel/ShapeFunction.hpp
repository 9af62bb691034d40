// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <cmath>

namespace yade::mpm {

/* One-dimensional shape functions on a grid of unit cells; in D dimensions N(x) is the product over the axes.

Each struct has
  support          number of consecutive nodes that a point touches
  usesSize         whether the point's own size enters
  shift(r)         the first of those nodes is base = floor(xi - shift), for a point at xi (in cells, from node 0)
  evaluate(...)    values N[k] and derivatives dN[k] = dN/dxi at nodes base+k

where r is half the point's size in cells (only GIMP looks at it). Steffen, Kirby & Berzins, Int. J. Numer. Meth.
Engng 76 (2008) 922; the quadratic spline is centred at a node, its knots at mid-cells. */

struct LinearShape {
	static constexpr int  support  = 2;
	static constexpr bool usesSize = false;
	static double         shift(double) { return 0; }
	static void           evaluate(double xi, double base, double, double* N, double* dN)
	{
		const double s = xi - base;
		N[0] = 1 - s, N[1] = s;
		dN[0] = -1, dN[1] = 1;
	}
};

struct QuadraticShape {
	static constexpr int  support  = 3;
	static constexpr bool usesSize = false;
	static double         shift(double) { return .5; }
	static void           evaluate(double xi, double base, double, double* N, double* dN)
	{
		const double s = xi - base - 1; // from the middle node, in [-1/2, 1/2)
		N[0] = .5 * (.5 - s) * (.5 - s), N[1] = .75 - s * s, N[2] = .5 * (.5 + s) * (.5 + s);
		dN[0] = s - .5, dN[1] = -2 * s, dN[2] = s + .5;
	}
};

struct CubicShape {
	static constexpr int  support  = 4;
	static constexpr bool usesSize = false;
	static double         shift(double) { return 1; }
	static void           evaluate(double xi, double base, double, double* N, double* dN)
	{
		const double s = xi - base - 1, t = 1 - s; // from the two middle nodes, in [0, 1]
		N[0] = t * t * t / 6, N[3] = s * s * s / 6;
		N[1] = 2. / 3 - s * s * (1 - .5 * s), N[2] = 2. / 3 - t * t * (1 - .5 * t);
		dN[0] = -.5 * t * t, dN[3] = .5 * s * s;
		dN[1] = s * (1.5 * s - 2), dN[2] = -t * (1.5 * t - 2);
	}
};

/* Uniform GIMP: the hat averaged over the point's initial domain [xi - r, xi + r], 0 < r <= 1/2.
Bardenhagen & Kober, CMES 5 (2004) 477. */
struct GimpShape {
	static constexpr int  support  = 3;
	static constexpr bool usesSize = true;
	static double         shift(double r) { return r; }
	static void           evaluate(double xi, double base, double r, double* N, double* dN)
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
