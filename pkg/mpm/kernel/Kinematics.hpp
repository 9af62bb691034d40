// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "laws/StressState.hpp"
#include <Eigen/Dense>

namespace yade::mpm {

/* Kinematics of one step at a point, from G = dt grad v, the gradient of the displacement increment with respect
to the configuration at the start of the step (row-major, dim x dim; then dt v_r/r in axisymmetry).

Large strain, after Hughes & Winget, IJNME 15 (1980) 1862: with A = G (I + G/2)^-1, the gradient at mid-step,
  strain increment  sym A       (zero for every rigid motion)
  rotation          Q = (I - W/2)^-1 (I + W/2),  W = skew A   (exact for every rigid motion)
Small strain: sym G and no rotation.
The strain increment is that of the middle of the step; turnToEnd() turns it on by half the rotation, to the axes of the rotated stress. Without,
the stress of a vibration lags behind its strain by that angle, which feeds the vibration of a body that spins for many turns.
Strains carry engineering shear, in the components of the stress state. */
template <class S> struct Increment;

template <> struct Increment<Uniaxial> {
	double strain[1];

	void small(const double* G) { strain[0] = G[0]; }
	void turnToEnd() {}
	void large(const double* G) { strain[0] = G[0] / (1 + .5 * G[0]); }
	void rotate(double*) const {}
};

namespace detail {
	/* Q s Q^T for the in-plane components of s; c and s are the cosine and sine of the rotation. */
	inline void rotateInPlane(double cosine, double sine, double& xx, double& yy, double& xy)
	{
		const double cc = cosine * cosine, ss = sine * sine, cs = cosine * sine;
		const double a = cc * xx + ss * yy - 2 * cs * xy, b = ss * xx + cc * yy + 2 * cs * xy;
		xy = cs * (xx - yy) + (cc - ss) * xy;
		xx = a, yy = b;
	}

	struct PlaneIncrement {
		double xx, yy, gamma, cosine = 1, sine = 0;

		void turnToEnd()
		{
			const double cc = .5 * (1 + cosine), ss = .5 * (1 - cosine), cs = .5 * sine; // of half the angle
			const double x = xx, y = yy, xy = .5 * gamma;
			xx = cc * x + ss * y - 2 * cs * xy, yy = ss * x + cc * y + 2 * cs * xy;
			gamma = 2 * (cs * (x - y) + (cc - ss) * xy);
		}

		void small(const double* G) { xx = G[0], yy = G[3], gamma = G[1] + G[2]; }
		void large(const double* G)
		{
			const double a = 1 + .5 * G[0], b = .5 * G[1], c = .5 * G[2], d = 1 + .5 * G[3], det = a * d - b * c;
			const double over = 1 / det;
			const double Axx = (G[0] * d - G[1] * c) * over, Axy = (G[1] * a - G[0] * b) * over;
			const double Ayx = (G[2] * d - G[3] * c) * over, Ayy = (G[3] * a - G[2] * b) * over;
			xx = Axx, yy = Ayy, gamma = Axy + Ayx;
			const double h = .25 * (Ayx - Axy), secant2 = 1 / (1 + h * h); // tangent of half the rotation
			cosine = (1 - h * h) * secant2, sine = 2 * h * secant2;
		}
	};
} // namespace detail

template <> struct Increment<PlaneStress> {
	double                 strain[3];
	detail::PlaneIncrement plane;

	void small(const double* G) { plane.small(G), set(); }
	void large(const double* G) { plane.large(G), set(); }
	void rotate(double* s) const { detail::rotateInPlane(plane.cosine, plane.sine, s[0], s[1], s[2]); }
	void turnToEnd() { plane.turnToEnd(), set(); }

private:
	void set() { strain[0] = plane.xx, strain[1] = plane.yy, strain[2] = plane.gamma; }
};

template <> struct Increment<PlaneStrain> {
	double                 strain[4];
	detail::PlaneIncrement plane;

	void small(const double* G) { plane.small(G), set(); }
	void large(const double* G) { plane.large(G), set(); }
	void rotate(double* s) const { detail::rotateInPlane(plane.cosine, plane.sine, s[0], s[1], s[3]); }
	void turnToEnd()
	{
		plane.turnToEnd();
		strain[0] = plane.xx, strain[1] = plane.yy, strain[3] = plane.gamma;
	}

private:
	void set() { strain[0] = plane.xx, strain[1] = plane.yy, strain[2] = 0, strain[3] = plane.gamma; }
};

template <> struct Increment<Axisymmetric> : Increment<PlaneStrain> {
	void small(const double* G) { Increment<PlaneStrain>::small(G), strain[2] = G[4]; }
	void large(const double* G) { Increment<PlaneStrain>::large(G), strain[2] = G[4] / (1 + .5 * G[4]); }
};

template <> struct Increment<Solid> {
	using Matrix = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;
	double strain[6];
	Matrix Q = Matrix::Identity();

	void small(const double* G) { set(Eigen::Map<const Matrix>(G)); }
	void large(const double* G)
	{
		const Eigen::Map<const Matrix> g(G);
		const Matrix                   I = Matrix::Identity();
		const Matrix                   A = g * (I + .5 * g).inverse();
		const Matrix                   W = .5 * (A - A.transpose());
		Q                                = (I - .5 * W).inverse() * (I + .5 * W);
		set(A);
	}
	void turnToEnd() // the mean of none and all of the rotation: half of it, to second order
	{
		double turned[6];
		for (int k = 0; k < 6; ++k)
			turned[k] = k < 3 ? strain[k] : .5 * strain[k];
		rotate(turned);
		for (int k = 0; k < 6; ++k)
			strain[k] = .5 * (strain[k] + (k < 3 ? turned[k] : 2 * turned[k]));
	}
	void rotate(double* s) const
	{
		Matrix T;
		T << s[0], s[5], s[4], s[5], s[1], s[3], s[4], s[3], s[2];
		T    = Q * T * Q.transpose();
		s[0] = T(0, 0), s[1] = T(1, 1), s[2] = T(2, 2), s[3] = T(1, 2), s[4] = T(0, 2), s[5] = T(0, 1);
	}

private:
	void set(const Matrix& A)
	{
		strain[0] = A(0, 0), strain[1] = A(1, 1), strain[2] = A(2, 2);
		strain[3] = A(1, 2) + A(2, 1), strain[4] = A(0, 2) + A(2, 0), strain[5] = A(0, 1) + A(1, 0);
	}
};

template <int dim> double determinant(const double* F);
template <> inline double determinant<1>(const double* F) { return F[0]; }
template <> inline double determinant<2>(const double* F) { return F[0] * F[3] - F[1] * F[2]; }
template <> inline double determinant<3>(const double* F)
{
	return F[0] * (F[4] * F[8] - F[5] * F[7]) - F[1] * (F[3] * F[8] - F[5] * F[6]) + F[2] * (F[3] * F[7] - F[4] * F[6]);
}

/* F <- (I + G) F, the deformation gradient at the end of the step; small strain: F <- F + G, so that
sym F - I is the sum of the strain increments. */
template <int dim> void advanceDeformation(const double* G, bool largeStrain, double* F)
{
	double old[dim * dim];
	for (int k = 0; k < dim * dim; ++k)
		old[k] = F[k];
	for (int i = 0; i < dim; ++i)
		for (int j = 0; j < dim; ++j) {
			double sum = 0;
			if (largeStrain)
				for (int k = 0; k < dim; ++k)
					sum += G[i * dim + k] * old[k * dim + j];
			else
				sum = G[i * dim + j];
			F[i * dim + j] = old[i * dim + j] + sum;
		}
}

} // namespace yade::mpm
