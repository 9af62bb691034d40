// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <cmath>

namespace yade::mpm {

/* Isotropic Hooke constants [Pa], in the form that the stress states below need. */
struct Hooke {
	double young = 0, poisson = 0;
	double shear = 0;              // G = E / (2 (1 + nu))
	double lame  = 0;              // lambda = E nu / ((1 + nu) (1 - 2 nu))
	double plane = 0, planeNu = 0; // E / (1 - nu^2) and nu times it

	Hooke() = default;
	Hooke(double E, double nu)
	    : young(E)
	    , poisson(nu)
	    , shear(E / (2 * (1 + nu)))
	    , lame(E * nu / ((1 + nu) * (1 - 2 * nu)))
	    , plane(E / (1 - nu * nu))
	    , planeNu(nu * plane)
	{
	}
};

/* A stress state says which components a stress and a strain have in an analysis, and what the operators of
isotropic elasticity and of von Mises' criterion are on them. Strains carry engineering shear (gamma = 2 eps_xy).

  N                 components                     dim       dimension of the problem
  elastic(C,e,s)    s = D e
  mises2(s)         f^2 = s^T M s, f von Mises' equivalent stress
  normal(s,f,a)     a = M s / f, the gradient of f (strain-like: engineering shear)
  back(s,b)         the direction in which Prager's back stress moves: b = s where the out-of-plane stress is
		    imposed (Simo & Taylor, IJNME 22 (1986) 649), the deviator of s elsewhere
  tensor(s,T)       the symmetric 3x3 tensor
  pWaveModulus(C)   greatest c^2 rho over all directions

All work on plain arrays of N doubles. */

struct Uniaxial { // sigma_xx alone
	static constexpr int N = 1, dim = 1;
	static void          elastic(const Hooke& C, const double* e, double* s) { s[0] = C.young * e[0]; }
	static double        mises2(const double* s) { return s[0] * s[0]; }
	static void          normal(const double* s, double f, double* a) { a[0] = s[0] / f; }
	static void          back(const double* s, double* b) { b[0] = s[0]; }
	static double        pWaveModulus(const Hooke& C) { return C.young; }
};

struct PlaneStress { // xx, yy, xy
	static constexpr int N = 3, dim = 2;
	static void          elastic(const Hooke& C, const double* e, double* s)
	{
		const double xx = C.plane * e[0] + C.planeNu * e[1], yy = C.planeNu * e[0] + C.plane * e[1];
		s[0] = xx, s[1] = yy, s[2] = C.shear * e[2];
	}
	static double mises2(const double* s) { return s[0] * s[0] - s[0] * s[1] + s[1] * s[1] + 3 * s[2] * s[2]; }
	static void   normal(const double* s, double f, double* a)
	{
		const double xx = (s[0] - .5 * s[1]) / f, yy = (s[1] - .5 * s[0]) / f;
		a[0] = xx, a[1] = yy, a[2] = 3 * s[2] / f;
	}
	static void   back(const double* s, double* b) { b[0] = s[0], b[1] = s[1], b[2] = s[2]; }
	static double pWaveModulus(const Hooke& C) { return C.plane; }
};

struct PlaneStrain { // xx, yy, zz, xy
	static constexpr int N = 4, dim = 2;
	static void          elastic(const Hooke& C, const double* e, double* s)
	{
		const double p = C.lame * (e[0] + e[1] + e[2]);
		for (int k = 0; k < 3; ++k)
			s[k] = p + 2 * C.shear * e[k];
		s[3] = C.shear * e[3];
	}
	static double mises2(const double* s)
	{
		const double xy = s[0] - s[1], yz = s[1] - s[2], zx = s[2] - s[0];
		return .5 * (xy * xy + yz * yz + zx * zx) + 3 * s[3] * s[3];
	}
	static void normal(const double* s, double f, double* a)
	{
		const double m = (s[0] + s[1] + s[2]) / 3;
		for (int k = 0; k < 3; ++k)
			a[k] = 1.5 * (s[k] - m) / f;
		a[3] = 3 * s[3] / f;
	}
	static void back(const double* s, double* b)
	{
		const double m = (s[0] + s[1] + s[2]) / 3;
		b[0] = s[0] - m, b[1] = s[1] - m, b[2] = s[2] - m, b[3] = s[3];
	}
	static double pWaveModulus(const Hooke& C) { return C.lame + 2 * C.shear; }
};

struct Solid { // xx, yy, zz, yz, zx, xy
	static constexpr int N = 6, dim = 3;
	static void          elastic(const Hooke& C, const double* e, double* s)
	{
		const double p = C.lame * (e[0] + e[1] + e[2]);
		for (int k = 0; k < 3; ++k)
			s[k] = p + 2 * C.shear * e[k], s[k + 3] = C.shear * e[k + 3];
	}
	static double mises2(const double* s)
	{
		const double xy = s[0] - s[1], yz = s[1] - s[2], zx = s[2] - s[0];
		return .5 * (xy * xy + yz * yz + zx * zx) + 3 * (s[3] * s[3] + s[4] * s[4] + s[5] * s[5]);
	}
	static void normal(const double* s, double f, double* a)
	{
		const double m = (s[0] + s[1] + s[2]) / 3;
		for (int k = 0; k < 3; ++k)
			a[k] = 1.5 * (s[k] - m) / f, a[k + 3] = 3 * s[k + 3] / f;
	}
	static void back(const double* s, double* b)
	{
		const double m = (s[0] + s[1] + s[2]) / 3;
		for (int k = 0; k < 3; ++k)
			b[k] = s[k] - m, b[k + 3] = s[k + 3];
	}
	static double pWaveModulus(const Hooke& C) { return C.lame + 2 * C.shear; }
};

template <class S> double dot(const double* a, const double* b)
{
	double sum = 0;
	for (int k = 0; k < S::N; ++k)
		sum += a[k] * b[k];
	return sum;
}

} // namespace yade::mpm
