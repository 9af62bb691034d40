// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <array>
#include <cmath>
#include <type_traits>

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

/* A stress state defines the components that stress and strain have in an analysis, with the operators of isotropic
elasticity and of von Mises' criterion on them. Strains carry engineering shear (gamma = 2 eps_xy).

  N                 components                     dim       dimension of the problem
  elastic(C,e,s)    s = D e
  mises2(s)         f^2 = s^T M s, f von Mises' equivalent stress
  normal(s,f,a)     a = M s / f, the gradient of f (strain-like: engineering shear)
  backStressDirection(s,b)  the direction in which Prager's back stress moves: b = s where the out-of-plane stress is
		    imposed (Simo & Taylor, IJNME 22 (1986) 649), the deviator of s elsewhere
  voigtIndex[k]          which of the components xx, yy, zz, yz, zx, xy of Solid the k-th is

The normal components that a state lacks are stress-free where out-of-plane stress is imposed, and their strain follows.

All work on plain arrays of N numbers T: double, or Dual where derivatives are computed. */

struct Uniaxial { // sigma_xx alone
	static constexpr int           N = 1, dim = 1, voigtIndex[] = { 0 };
	template <class T> static void elastic(const Hooke& C, const T* e, T* s) { s[0] = C.young * e[0]; }
	template <class T> static T    mises2(const T* s) { return s[0] * s[0]; }
	template <class T> static void normal(const T* s, const std::common_type_t<T>& f, T* a) { a[0] = s[0] / f; }
	template <class T> static void backStressDirection(const T* s, T* b) { b[0] = s[0]; }
};

struct PlaneStress { // xx, yy, xy
	static constexpr int           N = 3, dim = 2, voigtIndex[] = { 0, 1, 5 };
	template <class T> static void elastic(const Hooke& C, const T* e, T* s)
	{
		const T xx = C.plane * e[0] + C.planeNu * e[1], yy = C.planeNu * e[0] + C.plane * e[1];
		s[0] = xx, s[1] = yy, s[2] = C.shear * e[2];
	}
	template <class T> static T    mises2(const T* s) { return s[0] * s[0] - s[0] * s[1] + s[1] * s[1] + 3 * s[2] * s[2]; }
	template <class T> static void normal(const T* s, const std::common_type_t<T>& f, T* a)
	{
		const T xx = (s[0] - .5 * s[1]) / f, yy = (s[1] - .5 * s[0]) / f;
		a[0] = xx, a[1] = yy, a[2] = 3 * s[2] / f;
	}
	template <class T> static void backStressDirection(const T* s, T* b) { b[0] = s[0], b[1] = s[1], b[2] = s[2]; }
};

struct PlaneStrain { // xx, yy, zz, xy
	static constexpr int           N = 4, dim = 2, voigtIndex[] = { 0, 1, 2, 5 };
	template <class T> static void elastic(const Hooke& C, const T* e, T* s)
	{
		const T p = C.lame * (e[0] + e[1] + e[2]);
		for (int k = 0; k < 3; ++k)
			s[k] = p + 2 * C.shear * e[k];
		s[3] = C.shear * e[3];
	}
	template <class T> static T mises2(const T* s)
	{
		const T xy = s[0] - s[1], yz = s[1] - s[2], zx = s[2] - s[0];
		return .5 * (xy * xy + yz * yz + zx * zx) + 3 * s[3] * s[3];
	}
	template <class T> static void normal(const T* s, const std::common_type_t<T>& f, T* a)
	{
		const T m = (s[0] + s[1] + s[2]) / 3;
		for (int k = 0; k < 3; ++k)
			a[k] = 1.5 * (s[k] - m) / f;
		a[3] = 3 * s[3] / f;
	}
	template <class T> static void backStressDirection(const T* s, T* b)
	{
		const T m = (s[0] + s[1] + s[2]) / 3;
		b[0] = s[0] - m, b[1] = s[1] - m, b[2] = s[2] - m, b[3] = s[3];
	}
};

/* rr, zz and hoop, rz: the plane is half a section through the axis, x the radius and y along the axis. */
struct Axisymmetric : PlaneStrain {};

struct Solid { // xx, yy, zz, yz, zx, xy
	static constexpr int           N = 6, dim = 3, voigtIndex[] = { 0, 1, 2, 3, 4, 5 };
	template <class T> static void elastic(const Hooke& C, const T* e, T* s)
	{
		const T p = C.lame * (e[0] + e[1] + e[2]);
		for (int k = 0; k < 3; ++k)
			s[k] = p + 2 * C.shear * e[k], s[k + 3] = C.shear * e[k + 3];
	}
	template <class T> static T mises2(const T* s)
	{
		const T xy = s[0] - s[1], yz = s[1] - s[2], zx = s[2] - s[0];
		return .5 * (xy * xy + yz * yz + zx * zx) + 3 * (s[3] * s[3] + s[4] * s[4] + s[5] * s[5]);
	}
	template <class T> static void normal(const T* s, const std::common_type_t<T>& f, T* a)
	{
		const T m = (s[0] + s[1] + s[2]) / 3;
		for (int k = 0; k < 3; ++k)
			a[k] = 1.5 * (s[k] - m) / f, a[k + 3] = 3 * s[k + 3] / f;
	}
	template <class T> static void backStressDirection(const T* s, T* b)
	{
		const T m = (s[0] + s[1] + s[2]) / 3;
		for (int k = 0; k < 3; ++k)
			b[k] = s[k] - m, b[k + 3] = s[k + 3];
	}
};

/* The first `kept` normal components and all shears; the other normals are stress-free. Uniaxial and PlaneStress are
kept = 1 and 2 without the shears that are zero there; a material point driven alone may have them. */
template <int kept> struct FreeNormals {
	static_assert(kept >= 0 && kept < 3);
	static constexpr int                       N = kept + 3, dim = 3;
	static constexpr std::array<int, kept + 3> voigtIndex = [] {
		std::array<int, kept + 3> index {};
		for (int k = 0; k < N; ++k)
			index[std::size_t(k)] = k < kept ? k : k - kept + 3;
		return index;
	}();
	template <class T> static void elastic(const Hooke& C, const T* e, T* s)
	{
		if constexpr (kept == 1) s[0] = C.young * e[0];
		if constexpr (kept == 2) {
			const T xx = C.plane * e[0] + C.planeNu * e[1], yy = C.planeNu * e[0] + C.plane * e[1];
			s[0] = xx, s[1] = yy;
		}
		for (int k = kept; k < N; ++k)
			s[k] = C.shear * e[k];
	}
	template <class T> static T mises2(const T* s)
	{
		T f2 = 3 * (s[kept] * s[kept] + s[kept + 1] * s[kept + 1] + s[kept + 2] * s[kept + 2]);
		if constexpr (kept == 1) f2 += s[0] * s[0];
		if constexpr (kept == 2) f2 += s[0] * s[0] - s[0] * s[1] + s[1] * s[1];
		return f2;
	}
	template <class T> static void normal(const T* s, const std::common_type_t<T>& f, T* a)
	{
		if constexpr (kept == 1) a[0] = s[0] / f;
		if constexpr (kept == 2) {
			const T xx = (s[0] - .5 * s[1]) / f, yy = (s[1] - .5 * s[0]) / f;
			a[0] = xx, a[1] = yy;
		}
		for (int k = kept; k < N; ++k)
			a[k] = 3 * s[k] / f;
	}
	template <class T> static void backStressDirection(const T* s, T* b)
	{
		for (int k = 0; k < N; ++k)
			b[k] = s[k];
	}
};

/* How many normal components a stress state has; they come first. */
template <class S> constexpr int normals()
{
	int count = 0;
	for (int k = 0; k < S::N; ++k)
		count += S::voigtIndex[k] < 3;
	return count;
}

/* Where sigma_de stands among the components of a stress state. */
template <class S> constexpr int componentOf(int d, int e)
{
	const int solid = d == e ? d : 6 - d - e; // xx, yy, zz, yz, zx, xy
	for (int k = 0; k < S::N; ++k)
		if (S::voigtIndex[std::size_t(k)] == solid) return k;
	return -1;
}

/* Numbers in G = dt grad v, dim x dim row-major; where there is a hoop strain its rate times dt comes last. */
template <class S> constexpr bool hasHoop  = std::is_same_v<S, Axisymmetric>;
template <class S> constexpr int gradients = S::dim* S::dim + hasHoop<S>;

/* The stress state as laws see it: to them axisymmetry is plane strain with a strain across the plane. */
template <class S> using LawState = std::conditional_t<hasHoop<S>, PlaneStrain, S>;

/* s^T D^-1 s of the whole tensor, twice the elastic energy a volume [J/m3]. */
template <class S, class T> T complianceProduct(const Hooke& C, const T* s)
{
	T trace = 0;
	for (int k = 0; k < normals<S>(); ++k)
		trace += s[k];
	return S::mises2(s) / (3 * C.shear) + (1 - 2 * C.poisson) * trace * trace / (3 * C.young);
}

template <class S, class T> T dot(const T* a, const T* b)
{
	T sum = 0;
	for (int k = 0; k < S::N; ++k)
		sum += a[k] * b[k];
	return sum;
}

} // namespace yade::mpm
