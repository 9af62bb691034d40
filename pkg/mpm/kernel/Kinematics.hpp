// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "Pack.hpp"
#include "laws/StressState.hpp"
#include <Eigen/Dense>
#include <algorithm>

namespace yade::mpm {

/* Kinematics of one step at a point, from G = dt grad v, the gradient of the displacement increment with respect
to the configuration at the start of the step (row-major, dim x dim; then dt v_r/r in axisymmetry), dF = I + G.

Large strain (doc/method.md derives it): the elastic strain h = D^-1 sigma is Hencky's, h = ln(b)/2, and moves with the material,
  h' = ln(dF exp(2 h) dF^T) / 2.
Stress and internal tensors turn by R, then the law takes the strain increment h' - R h R^T. An elastic point thus has sigma = D h'
exactly, whatever R is. R turns with the material: with the polar rotation of F (Green & Naghdi 1965) where a law has tensors of its own,
else with that of dF, which needs no F.
Small strain: sym G and no rotation.
Strains carry engineering shear, in the components of the stress state. */
template <class S> void smallStrain(const double* G, double* strain)
{
	if constexpr (S::dim == 1)
		strain[0] = G[0];
	else if constexpr (S::dim == 3) {
		strain[0] = G[0], strain[1] = G[4], strain[2] = G[8];
		strain[3] = G[5] + G[7], strain[4] = G[2] + G[6], strain[5] = G[1] + G[3];
	} else {
		strain[0] = G[0], strain[1] = G[3], strain[S::N - 1] = G[1] + G[2];
		if constexpr (S::N == 4) strain[2] = hasHoop<S> ? G[gradients<S> - 1] : 0;
	}
}

namespace detail {
	/* Power series that reach rounding up to `near`, with more terms up to `far`, both bounds of the argument squared. */

	/* ln(1 + x)/2. */
	template <int W> void halfLog(const Pack<W>& x, Pack<W>& result)
	{
		constexpr double far = .05;
		forLanes<W>([&](int l) {
			const double z = x[l] / (2 + x[l]), z2 = z * z;
			result[l] = z * (1 + z2 * (1. / 3 + z2 * (1. / 5 + z2 * (1. / 7 + z2 * (1. / 9)))));
		});
		if (!anyLane<W>([&](int l) { return !(std::abs(x[l]) <= far); })) return;
		for (int l = 0; l < W; ++l)
			if (!(std::abs(x[l]) <= far)) result[l] = .5 * std::log1p(x[l]);
	}
	/* sinh(sqrt x)/sqrt x. */
	template <int W> void sinhRatio(const Pack<W>& x, Pack<W>& result)
	{
		constexpr double near = 1. / 64, far = 4;
		forLanes<W>([&](int l) { result[l] = 1 + x[l] / 6 * (1 + x[l] / 20 * (1 + x[l] / 42 * (1 + x[l] / 72 * (1 + x[l] / 110)))); });
		if (!anyLane<W>([&](int l) { return !(x[l] <= near); })) return;
		Pack<W> sum, term;
		forLanes<W>([&](int l) { sum[l] = term[l] = 1; });
		for (int k = 1; k < 14; ++k)
			forLanes<W>([&](int l) { term[l] *= x[l] / (2 * k * (2 * k + 1)), sum[l] += term[l]; });
		forLanes<W>([&](int l) { result[l] = x[l] <= near ? result[l] : sum[l]; });
		for (int l = 0; l < W; ++l)
			if (!(x[l] <= far)) result[l] = std::sinh(std::sqrt(x[l])) / std::sqrt(x[l]);
	}
	/* asinh(sqrt x)/sqrt x. */
	template <int W> void asinhRatio(const Pack<W>& x, Pack<W>& result)
	{
		constexpr double near = 1. / 64, far = 13; // sinh(2)^2
		auto             series = [](double y) {
                        // (2k)! / ((2k + 1) (2^k k!)^2)
                        return 1
                               - y * (1. / 6 - y * (3. / 40 - y * (5. / 112 - y * (35. / 1152 - y * (63. / 2816 - y * (231. / 13312 - y * (143. / 10240)))))));
		};
		forLanes<W>([&](int l) { result[l] = series(x[l]); });
		if (!anyLane<W>([&](int l) { return !(x[l] <= near); })) return;
		Pack<W> y = x, over, sum;
		forLanes<W>([&](int l) { over[l] = 1; });
		for (int k = 0; k < 4; ++k) // asinh s = 2 asinh(s / sqrt(2 (1 + sqrt(1 + s^2))))
			forLanes<W>([&](int l) {
				const double divisor = 2 * (1 + std::sqrt(1 + y[l]));
				over[l] *= 2 / std::sqrt(divisor), y[l] /= divisor;
			});
		forLanes<W>([&](int l) {
			sum[l]    = over[l] * series(y[l]);
			result[l] = x[l] <= near ? result[l] : sum[l];
		});
		for (int l = 0; l < W; ++l)
			if (!(x[l] <= far)) result[l] = std::asinh(std::sqrt(x[l])) / std::sqrt(x[l]);
	}

	/* Plane tensors as complex numbers: the symmetric tensor of mean m and z = (xx - yy)/2 + i xy becomes m and z e^2it when it turns by t. */
	struct Complex {
		double         re, im;
		friend Complex operator*(Complex a, Complex b) { return { a.re * b.re - a.im * b.im, a.re * b.im + a.im * b.re }; }
		Complex        conjugate() const { return { re, -im }; }
		double         norm2() const { return re * re + im * im; }
	};

	/* The plane part: dF z = alpha z + beta conj(z), and F likewise. With d the deviator of h, s = sinh|2 d| d/|d| and c = cosh|2 d|,
	det(dF) s' = 2 alpha beta c + alpha^2 s + beta^2 conj(s). */
	template <class S, int W>
	void planeStep(const Pack<W>* G, const Pack<W>* F, const Pack<W>& compliance, int tensors, Pack<W>* sigma, Pack<W>* internal, Pack<W>* strain)
	{
		constexpr int xy = S::N - 1;
		Pack<W>       growth, mean, size, ratio, re, im, turnRe, turnIm, oldRe, oldIm;
		forLanes<W>([&](int l) {
			oldRe[l] = .5 * compliance[l] * (sigma[0][l] - sigma[1][l]), oldIm[l] = compliance[l] * sigma[xy][l];
			size[l]             = 4 * (oldRe[l] * oldRe[l] + oldIm[l] * oldIm[l]);
			const double volume = G[0][l] + G[3][l] + (G[0][l] * G[3][l] - G[1][l] * G[2][l]);
			growth[l]           = volume > -1 ? volume : 0; // else the step fails, and the strain means nothing
		});
		halfLog(growth, mean), sinhRatio(size, ratio);
		forLanes<W>([&](int l) {
			const Complex alpha { 1 + .5 * (G[0][l] + G[3][l]), .5 * (G[2][l] - G[1][l]) },
				beta { .5 * (G[0][l] - G[3][l]), .5 * (G[2][l] + G[1][l]) };
			const Complex s { 2 * ratio[l] * oldRe[l], 2 * ratio[l] * oldIm[l] };
			const double  c = 2 * std::sqrt(1 + s.norm2()), over = 1 / (1 + growth[l]);
			const Complex a = alpha * alpha * s, b = beta * beta * s.conjugate(), ab = alpha * beta;
			re[l] = (c * ab.re + a.re + b.re) * over, im[l] = (c * ab.im + a.im + b.im) * over;
			size[l]   = re[l] * re[l] + im[l] * im[l];
			turnRe[l] = alpha.re, turnIm[l] = alpha.im;
			if (tensors > 0) {
				const Complex phi { F[0][l] + F[3][l], F[2][l] - F[1][l] }, psi { F[0][l] - F[3][l], F[2][l] + F[1][l] };
				const Complex p = alpha * phi, q = beta * psi.conjugate(), turn = Complex { p.re + q.re, p.im + q.im } * phi.conjugate();
				turnRe[l] = turn.re, turnIm[l] = turn.im;
			}
		});
		asinhRatio(size, ratio);
		forLanes<W>([&](int l) {
			const Complex turn { turnRe[l], turnIm[l] }, square = turn * turn;
			const double  over = 1 / turn.norm2();
			turnRe[l] = square.re * over, turnIm[l] = square.im * over;
			const Complex old    = Complex { turnRe[l], turnIm[l] } * Complex { oldRe[l], oldIm[l] };
			const double  change = .5 * ratio[l] * re[l] - old.re;
			strain[0][l] = mean[l] + change, strain[1][l] = mean[l] - change, strain[xy][l] = ratio[l] * im[l] - 2 * old.im;
		});
		auto rotate = [&](Pack<W>* s) {
			forLanes<W>([&](int l) {
				const double  m = .5 * (s[0][l] + s[1][l]);
				const Complex d = Complex { turnRe[l], turnIm[l] } * Complex { .5 * (s[0][l] - s[1][l]), s[xy][l] };
				s[0][l] = m + d.re, s[1][l] = m - d.re, s[xy][l] = d.im;
			});
		};
		rotate(sigma);
		for (int t = 0; t < tensors; ++t)
			rotate(internal + t * S::N);
	}

	/* Matrices of lanes, row-major, and symmetric ones as xx, yy, zz, yz, zx, xy. */
	template <int W> struct Matrices {
		Pack<W> m[9];

		Pack<W>&       operator()(int i, int j) { return m[3 * i + j]; }
		const Pack<W>& operator()(int i, int j) const { return m[3 * i + j]; }
		/* Lane l of the product with b. */
		double product(const Matrices& b, int i, int j, int l) const
		{
			return m[3 * i][l] * b.m[j][l] + m[3 * i + 1][l] * b.m[3 + j][l] + m[3 * i + 2][l] * b.m[6 + j][l];
		}
		/* The cofactors, and the determinant. */
		void cofactors(Matrices& c, Pack<W>& det) const
		{
			for (int i = 0; i < 3; ++i)
				for (int j = 0; j < 3; ++j) {
					const int i1 = (i + 1) % 3, i2 = (i + 2) % 3, j1 = (j + 1) % 3, j2 = (j + 2) % 3;
					forLanes<W>(
						[&](int l) { c(i, j)[l] = (*this)(i1, j1)[l] * (*this)(i2, j2)[l] - (*this)(i1, j2)[l] * (*this)(i2, j1)[l]; });
				}
			forLanes<W>([&](int l) { det[l] = m[0][l] * c.m[0][l] + m[1][l] * c.m[1][l] + m[2][l] * c.m[2][l]; });
		}
	};
	constexpr int solidAt[3][3] = { { 0, 5, 4 }, { 5, 1, 3 }, { 4, 3, 2 } };

	/* The coefficients of the odd series tanh x = sum T_k x^(2k+1), from tanh' = 1 - tanh^2. */
	struct TanhSeries {
		static constexpr int terms = 20;
		double               T[terms] {};

		constexpr TanhSeries()
		{
			T[0] = 1;
			for (int k = 1; k < terms; ++k) {
				for (int i = 0; i < k; ++i)
					T[k] -= T[i] * T[k - 1 - i];
				T[k] /= 2 * k + 1;
			}
		}
	};
	/* Frobenius norms squared up to which few terms of the matrix series below reach rounding, and up to which many do. */
	constexpr double nearStrain2 = 1. / 256, farStrain2 = .16;

	/* sum a(k) x^(2k+1) of symmetric matrices x, in place, by the theorem of Cayley and Hamilton: every power is a combination of 1, x
	and x^2. Up to `near` terms where |x|^2 <= nearStrain2, up to `many` elsewhere. */
	template <int W, class Coefficient> void oddSeries(Pack<W>* x, int near, int many, Coefficient&& a)
	{
		Pack<W> square[6], I1, I2, I3, wide, p0, p1, p2, c0, c1, c2;
		forLanes<W>([&](int l) {
			const double xx = x[0][l], yy = x[1][l], zz = x[2][l], yz = x[3][l], zx = x[4][l], xy = x[5][l];
			square[0][l] = xx * xx + xy * xy + zx * zx, square[1][l] = xy * xy + yy * yy + yz * yz, square[2][l] = zx * zx + yz * yz + zz * zz;
			square[3][l] = zx * xy + yz * (yy + zz), square[4][l] = xy * yz + zx * (xx + zz), square[5][l] = zx * yz + xy * (xx + yy);
			I1[l] = xx + yy + zz, I2[l] = yy * zz - yz * yz + zz * xx - zx * zx + xx * yy - xy * xy;
			I3[l]   = xx * (yy * zz - yz * yz) - xy * (xy * zz - yz * zx) + zx * (xy * yz - yy * zx);
			wide[l] = square[0][l] + square[1][l] + square[2][l] <= nearStrain2 ? 0 : 1;
			p0[l] = p2[l] = c0[l] = c2[l] = 0, p1[l] = c1[l] = 1;
		});
		auto add = [&](int k, auto&& with) {
			const double factor = a(k);
			forLanes<W>([&](int l) {
				// twice: x^3 = I1 x^2 - I2 x + I3
				const double q0 = I3[l] * p2[l], q1 = p0[l] - I2[l] * p2[l], q2 = p1[l] + I1[l] * p2[l];
				p0[l] = I3[l] * q2, p1[l] = q0 - I2[l] * q2, p2[l] = q1 + I1[l] * q2;
				const double f = with(l) ? factor : 0;
				c0[l] += f * p0[l], c1[l] += f * p1[l], c2[l] += f * p2[l];
			});
		};
		for (int k = 1; k < near; ++k)
			add(k, [](int) { return true; });
		if (anyLane<W>([&](int l) { return wide[l] != 0; }))
			for (int k = near; k < many; ++k)
				add(k, [&](int l) { return wide[l] != 0; });
		for (int k = 0; k < 6; ++k)
			forLanes<W>([&](int l) { x[k][l] = (k < 3 ? c0[l] : 0) + c1[l] * x[k][l] + c2[l] * square[k][l]; });
	}

	/* ln(dF exp(2 h) dF^T)/2 where h is too large for the series. */
	[[gnu::noinline]] inline void hencky(const double* G, double* h)
	{
		using Matrix = Eigen::Matrix3d;
		Matrix dF, d;
		for (int i = 0; i < 3; ++i)
			for (int j = 0; j < 3; ++j)
				dF(i, j) = (i == j) + G[3 * i + j], d(i, j) = h[solidAt[i][j]];
		const Eigen::SelfAdjointEigenSolver<Matrix> old(d);
		/* The columns become orthogonal: m = U diag(exp h'). One-sided rotations keep the digits of small stretches, which the eigenvalues
		of m m^T would lose. */
		Matrix m      = dF * old.eigenvectors() * old.eigenvalues().array().exp().matrix().asDiagonal();
		bool   turned = true;
		for (int sweep = 0; sweep < 30 && turned; ++sweep) {
			turned = false;
			for (int p = 0; p < 3; ++p) {
				const int    q  = (p + 1) % 3;
				const double pp = m.col(p).squaredNorm(), qq = m.col(q).squaredNorm(), pq = m.col(p).dot(m.col(q));
				if (!(std::abs(pq) > 1e-16 * std::sqrt(pp * qq))) continue;
				turned         = true;
				const double z = (qq - pp) / (2 * pq), t = std::copysign(1 / (std::abs(z) + std::hypot(1, z)), z), c = 1 / std::hypot(1, t);
				const Eigen::Vector3d column = m.col(p);
				m.col(p) = c * (column - t * m.col(q)), m.col(q) = c * (t * column + m.col(q));
			}
		}
		d.setZero();
		for (int k = 0; k < 3; ++k)
			d += std::log(m.col(k).norm()) / m.col(k).squaredNorm() * m.col(k) * m.col(k).transpose();
		for (int i = 0; i < 3; ++i)
			for (int j = 0; j <= i; ++j)
				h[solidAt[i][j]] = d(i, j);
	}

	/* F = V R to 1e-10, by Newton's iteration X <- (s X + X^-T/s)/2 for R with Higham's factor s (SIAM J. Sci. Stat. Comput. 7 (1986)
	1160): V, symmetric. A lane stops when it has converged. */
	template <int W> void leftStretch(const Matrices<W>& F, Pack<W>* V)
	{
		Matrices<W> X = F, c;
		Pack<W>     det, open;
		forLanes<W>([&](int l) { open[l] = 1; });
		for (int iteration = 0; iteration < 40 && anyLane<W>([&](int l) { return open[l] != 0; }); ++iteration) {
			X.cofactors(c, det);
			forLanes<W>([&](int l) {
				double size = 0, inverse = 0;
				for (int k = 0; k < 9; ++k)
					size += X.m[k][l] * X.m[k][l], inverse += c.m[k][l] * c.m[k][l];
				const double over = 1 / det[l], ratio = std::sqrt(inverse * over * over / size); // s^2
				const double s = ratio > 1.1 || ratio < .9 ? std::sqrt(ratio) : 1, a = .5 * s, b = .5 * over / s;
				double       change = 0;
				for (int k = 0; k < 9; ++k) {
					const double next = open[l] != 0 ? a * X.m[k][l] + b * c.m[k][l] : X.m[k][l], step = next - X.m[k][l];
					change += step * step, X.m[k][l]                                                   = next;
				}
				open[l] = change > 1e-10 ? 1 : 0; // of second order: the next change would be its square
			});
		}
		for (int i = 0; i < 3; ++i)
			for (int j = 0; j <= i; ++j)
				forLanes<W>([&](int l) {
					double sum = 0;
					for (int k = 0; k < 3; ++k)
						sum += F(i, k)[l] * X(j, k)[l];
					V[solidAt[i][j]][l] = sum;
				});
	}

	/* With S = (dF + dF^-T)/2, T = (dF - dF^-T)/2 and X = tanh h:  tanh h' = (T + S X) (S + T X)^-1. S is a rotation to second order, and
	exactly where dF is one. */
	template <int W>
	void solidStep(const Pack<W>* G, const Pack<W>* F, const Pack<W>& compliance, int tensors, Pack<W>* sigma, Pack<W>* internal, Pack<W>* strain)
	{
		static constexpr TanhSeries series;
		Matrices<W>                 dF, B, S, T, c, num, den, R;
		Pack<W>                     det, old[6], X[6], wx, wy, wz, size;
		for (int k = 0; k < 9; ++k)
			forLanes<W>([&](int l) { dF.m[k][l] = (k % 4 == 0) + G[k][l]; });
		dF.cofactors(c, det);
		forLanes<W>([&](int l) { det[l] = 1 / det[l]; });
		for (int i = 0; i < 3; ++i)
			for (int j = 0; j < 3; ++j)
				forLanes<W>([&](int l) {
					double sum = 0;
					for (int k = 0; k < 3; ++k)
						sum += G[3 * i + k][l] * c(j, k)[l];
					B(i, j)[l] = det[l] * sum; // G dF^-1 = 1 - dF^-1
				});
		for (int i = 0; i < 3; ++i)
			for (int j = 0; j < 3; ++j)
				forLanes<W>([&](int l) {
					S(i, j)[l] = (i == j) + .5 * (G[3 * i + j][l] - B(j, i)[l]), T(i, j)[l] = .5 * (G[3 * i + j][l] + B(j, i)[l]);
				});
		forLanes<W>([&](int l) {
			const double m = (sigma[0][l] + sigma[1][l] + sigma[2][l]) / 3;
			for (int k = 0; k < 6; ++k)
				old[k][l] = X[k][l] = compliance[l] * (k < 3 ? sigma[k][l] - m : sigma[k][l]);
			size[l] = X[0][l] * X[0][l] + X[1][l] * X[1][l] + X[2][l] * X[2][l] + 2 * (X[3][l] * X[3][l] + X[4][l] * X[4][l] + X[5][l] * X[5][l]);
			// tangent of half the rotation, about these axes
			const double over = 1 / (1 + S.m[0][l] + S.m[4][l] + S.m[8][l]);
			wx[l] = over * (S.m[7][l] - S.m[5][l]), wy[l] = over * (S.m[2][l] - S.m[6][l]), wz[l] = over * (S.m[3][l] - S.m[1][l]);
		});
		oddSeries(X, 6, TanhSeries::terms, [](int k) { return series.T[k]; });
		for (int i = 0; i < 3; ++i)
			for (int j = 0; j < 3; ++j)
				forLanes<W>([&](int l) {
					double SX = 0, TX = 0;
					for (int k = 0; k < 3; ++k)
						SX += S(i, k)[l] * X[solidAt[k][j]][l], TX += T(i, k)[l] * X[solidAt[k][j]][l];
					num(i, j)[l] = T(i, j)[l] + SX, den(i, j)[l] = S(i, j)[l] + TX;
				});
		den.cofactors(c, det);
		for (int i = 0; i < 3; ++i)
			for (int j = 0; j <= i; ++j)
				forLanes<W>([&](int l) {
					X[solidAt[i][j]][l] = (num(i, 0)[l] * c(j, 0)[l] + num(i, 1)[l] * c(j, 1)[l] + num(i, 2)[l] * c(j, 2)[l]) / det[l];
				});
		forLanes<W>([&](int l) {
			const double after =
				X[0][l] * X[0][l] + X[1][l] * X[1][l] + X[2][l] * X[2][l] + 2 * (X[3][l] * X[3][l] + X[4][l] * X[4][l] + X[5][l] * X[5][l]);
			size[l] = size[l] <= farStrain2 && after <= farStrain2 ? 0 : 1;
		});
		oddSeries(X, 7, 22, [](int k) { return 1. / (2 * k + 1); });
		if (anyLane<W>([&](int l) { return size[l] != 0; }))
			for (int l = 0; l < W; ++l) {
				if (size[l] == 0) continue;
				double g[9], h[6];
				for (int k = 0; k < 9; ++k)
					g[k] = G[k][l];
				for (int k = 0; k < 6; ++k)
					h[k] = old[k][l];
				hencky(g, h);
				for (int k = 0; k < 6; ++k)
					X[k][l] = h[k];
			}

		if (tensors > 0) {
			// polar rotation: omega = w + (tr V - V)^-1 z, with z the axial vector of V D - D V at mid-step
			Matrices<W> middle, sum, cofactor;
			Pack<W>     V[6];
			for (int i = 0; i < 3; ++i)
				for (int j = 0; j < 3; ++j)
					forLanes<W>([&](int l) {
						double more = 0;
						for (int k = 0; k < 3; ++k)
							more += G[3 * i + k][l] * F[3 * k + j][l];
						middle(i, j)[l] = F[3 * i + j][l] + .5 * more;
					});
			leftStretch(middle, V);
			forLanes<W>([&](int l) {
				const double trace = V[0][l] + V[1][l] + V[2][l];
				for (int i = 0; i < 3; ++i)
					for (int j = 0; j < 3; ++j)
						sum(i, j)[l] = (i == j ? trace : 0) - V[solidAt[i][j]][l];
			});
			sum.cofactors(cofactor, det);
			forLanes<W>([&](int l) {
				const double xx = T.m[0][l], yy = T.m[4][l], zz = T.m[8][l], yz = .5 * (T.m[5][l] + T.m[7][l]),
					     zx = .5 * (T.m[2][l] + T.m[6][l]), xy = .5 * (T.m[1][l] + T.m[3][l]);
				const double zX   = V[5][l] * zx + V[1][l] * yz + V[3][l] * zz - (xy * V[4][l] + yy * V[3][l] + yz * V[2][l]),
					     zY   = V[4][l] * xx + V[3][l] * xy + V[2][l] * zx - (zx * V[0][l] + yz * V[5][l] + zz * V[4][l]),
					     zZ   = V[0][l] * xy + V[5][l] * yy + V[4][l] * yz - (xx * V[5][l] + xy * V[1][l] + zx * V[3][l]);
				const double over = .5 / det[l];
				wx[l] += over * (cofactor.m[0][l] * zX + cofactor.m[1][l] * zY + cofactor.m[2][l] * zZ);
				wy[l] += over * (cofactor.m[3][l] * zX + cofactor.m[4][l] * zY + cofactor.m[5][l] * zZ);
				wz[l] += over * (cofactor.m[6][l] * zX + cofactor.m[7][l] * zY + cofactor.m[8][l] * zZ);
			});
		}
		forLanes<W>([&](int l) {
			const double x = wx[l], y = wy[l], z = wz[l], f = 2 / (1 + x * x + y * y + z * z);
			R.m[0][l] = 1 - f * (y * y + z * z), R.m[4][l] = 1 - f * (z * z + x * x), R.m[8][l] = 1 - f * (x * x + y * y);
			R.m[1][l] = f * (x * y - z), R.m[2][l] = f * (x * z + y), R.m[5][l] = f * (y * z - x);
			R.m[3][l] = f * (x * y + z), R.m[6][l] = f * (x * z - y), R.m[7][l] = f * (y * z + x);
		});
		auto rotate = [&](Pack<W>* s) {
			forLanes<W>([&](int l) {
				double product[3][3];
				for (int i = 0; i < 3; ++i)
					for (int j = 0; j < 3; ++j) {
						product[i][j] = 0;
						for (int k = 0; k < 3; ++k)
							product[i][j] += R(i, k)[l] * s[solidAt[k][j]][l];
					}
				for (int i = 0; i < 3; ++i)
					for (int j = 0; j <= i; ++j)
						s[solidAt[i][j]][l] = product[i][0] * R(j, 0)[l] + product[i][1] * R(j, 1)[l] + product[i][2] * R(j, 2)[l];
			});
		};
		rotate(sigma);
		for (int t = 0; t < tensors; ++t)
			rotate(internal + 6 * t);
		forLanes<W>([&](int l) {
			// R h R^T of the deviator
			const double m = (sigma[0][l] + sigma[1][l] + sigma[2][l]) / 3;
			for (int k = 0; k < 6; ++k) {
				const double turned = compliance[l] * (k < 3 ? sigma[k][l] - m : sigma[k][l]);
				strain[k][l]        = (k < 3 ? 1 : 2) * (X[k][l] - turned);
			}
		});
	}
} // namespace detail

/* Large strain in every lane: turns sigma and the first `tensors` of the internal variables, and computes the strain increment.
compliance: 1/(2 G) of the elastic law [1/Pa]; F: deformation gradient at the start of the step. */
template <class S, int W>
void largeStrain(const Pack<W>* G, const Pack<W>* F, const Pack<W>& compliance, int tensors, Pack<W>* sigma, Pack<W>* internal, Pack<W>* strain)
{
	if constexpr (S::dim == 1) {
		detail::halfLog(G[0], strain[0]);
		forLanes<W>([&](int l) { strain[0][l] *= 2; });
	} else if constexpr (S::dim == 3)
		detail::solidStep(G, F, compliance, tensors, sigma, internal, strain);
	else {
		detail::planeStep<S>(G, F, compliance, tensors, sigma, internal, strain);
		if constexpr (hasHoop<S>) {
			detail::halfLog(G[4], strain[2]);
			forLanes<W>([&](int l) { strain[2][l] *= 2; });
		} else if constexpr (S::N == 4)
			forLanes<W>([&](int l) { strain[2][l] = 0; });
	}
}

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
