// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "Transfer.hpp"
#include "Turns.hpp"
#include <type_traits>

namespace yade::mpm {

/* The affine transfer. A point carries, beside v_p, the angular velocity W_p of its surroundings, and brings to the nodes

  (m v)_i = sum N_ip m_p [v_p + C_p (x_i - x_p)],   C_p = [W x] + tau [W x]^2,

tau the time from the positions to the velocities: -dt/2 in the first mapping, +dt/2 in MUSL's second one, 0 for increments.
[W x] alone is the rotation of a rigid body about x_p; the square is what the rotation of the velocities themselves in the
time tau adds. So a rigid rotation passes exactly, however the points of a body lie among the nodes.

A point is a rigid body for its nodes: inertia J_p = m_p (D_a + D_b) about the axis normal to a and b, with
D_a = sum N_ip (x_i - x_p)_a^2. What a nodal field v gives to it is the transpose,

  W_p = sum N_ip (x_i - x_p) x v_i m_p / J_p.

So impulses on the nodes change sum m_p x_p x v_p + J_p W_p by their moment, and sum (m_p v_p^2 + J_p W_p^2)/2 by their work. */

/* D_a of a point in cells squared is Shape::variance; a sum over the nodes where it depends on the place. */
template <int dim, class Shape> struct Arms {
	static constexpr int support = Shape::support, row = Shape::row;

	alignas(8 * row) double x[dim][row], Nx[dim][row]; // (x_i - x_p)_d of the nodes along axis d, and N times it
	double spread[dim];                                // D

	Arms(const Weights<dim, Shape>& w, const std::array<double, dim>& cell)
	{
		for (int d = 0; d < dim; ++d) {
			double place = 0; // of the point, in cells from the first node: the functions reproduce it
			for (int k = 1; k < support; ++k)
				place += k * w.N[d][k];
			const double h = cell[std::size_t(d)];
#pragma omp simd
			for (int k = 0; k < row; ++k) {
				x[d][k]  = (k - place) * h;
				Nx[d][k] = w.N[d][k] * x[d][k];
			}
			spread[d] = Shape::variance * h * h;
			if (Shape::variance == 0)
				for (int k = 0; k < support; ++k)
					spread[d] += Nx[d][k] * x[d][k];
		}
	}
	/* J / m about the axis of rotation k. */
	double inertia(int k) const { return spread[turnsFrom<dim>(k)] + spread[turnsTo<dim>(k)]; }
};

/* C of doc above, row-major. */
template <int dim, class Real> void rotationMatrix(const Real (&W)[turns<dim>], double tau, Real (&C)[dim][dim])
{
	if constexpr (dim == 2) {
		C[0][0] = C[1][1] = -tau * W[0] * W[0];
		C[0][1] = -W[0], C[1][0] = W[0];
	} else {
		const Real square = W[0] * W[0] + W[1] * W[1] + W[2] * W[2];
		for (int a = 0; a < dim; ++a)
			for (int b = 0; b < dim; ++b)
				C[a][b] = tau * (W[a] * W[b] - (a == b ? square : 0));
		for (int k = 0; k < dim; ++k)
			C[turnsTo<dim>(k)][turnsFrom<dim>(k)] += W[k], C[turnsFrom<dim>(k)][turnsTo<dim>(k)] -= W[k];
	}
}

/* m_p C_p (x_i - x_p) of one point: at a node it is N_ip times alongX[i] + acrossRows[row] N[0][i], with the N along x in both. */
template <int dim, class Shape> struct RotationRows {
	static constexpr int support = Shape::support, row = Shape::row, rows = ipow(support, dim - 1);

	alignas(8 * row) double alongX[dim][row];
	double acrossRows[dim][rows];

	void set(const Points& points, Block block, int l, const Weights<dim, Shape>& w, const std::array<double, dim>& cell, double mass, double tau)
	{
		double W[turns<dim>];
		for (int k = 0; k < turns<dim>; ++k)
			W[k] = points.angularVelocity[std::size_t(k)][block.first + std::size_t(l)];
		set(Arms<dim, Shape>(w, cell), mass, W, tau);
	}
	void set(const Arms<dim, Shape>& arms, double mass, const double (&W)[turns<dim>], double tau)
	{
		double C[dim][dim];
		rotationMatrix<dim>(W, tau, C);
		for (int d = 0; d < dim; ++d) {
			const double c = mass * C[d][0];
#pragma omp simd
			for (int i = 0; i < row; ++i)
				alongX[d][i] = c * arms.Nx[0][i];
			for (int n = 0; n < rows; ++n) {
				double sum = 0;
				for (int e = 1, rest = n; e < dim; ++e, rest /= support)
					sum += C[d][e] * arms.x[e][rest % support];
				acrossRows[d][n] = mass * sum;
			}
		}
	}
};
struct NoRotation {};
template <bool rotates, int dim, class Shape> using RowsOf = std::conditional_t<rotates, RotationRows<dim, Shape>, NoRotation>;

/* (m v)_i += N_ip m_p [v_p + C_p (x_i - x_p)] of one point. */
template <int dim, class Shape>
void spreadAffineMomentum(
	const Weights<dim, Shape>& w, const double (&mv)[dim], const RotationRows<dim, Shape>& rotation, typename Patch<dim, Shape>::Values (&sum)[dim])
{
	constexpr int           row = Shape::row;
	alignas(8 * row) double along[dim][row];
	for (int d = 0; d < dim; ++d)
#pragma omp simd
		for (int i = 0; i < row; ++i)
			along[d][i] = mv[d] * w.N[0][i] + rotation.alongX[d][i];
	int n = 0;
	w.forEachRow([&](int offset, const std::array<double, dim>& c) {
		const int at = w.first + offset;
#pragma omp simd
		for (int i = 0; i < row; ++i)
			for (int d = 0; d < dim; ++d)
				sum[d][at + i] += c[0] * (along[d][i] + rotation.acrossRows[d][n] * w.N[0][i]);
		++n;
	});
}

namespace detail {
	/* sum N_ip field_i of one component of a field, and sum N_ip field_i (x_i - x_p)_e for the axes e other than its own. */
	template <int axis, int dim, class Shape>
	double gatherMoments(const Weights<dim, Shape>& w, const Arms<dim, Shape>& arms, const double* field, double (&moment)[dim])
	{
		constexpr int           row = Shape::row, support = Shape::support, extent = Weights<dim, Shape>::extent;
		const double*           nodes = field + w.first;
		alignas(8 * row) double value[row] {}, y[row] {}, z[row] {};
		if constexpr (dim == 2) {
			for (int j = 0; j < support; ++j)
#pragma omp simd
				for (int i = 0; i < row; ++i) {
					const double u = nodes[j * extent + i];
					value[i] += w.N[1][j] * u;
					if (axis != 1) y[i] += arms.Nx[1][j] * u;
				}
		} else {
			for (int k = 0; k < support; ++k) {
				alignas(8 * row) double plane[row] {}, planeY[row] {};
				for (int j = 0; j < support; ++j)
#pragma omp simd
					for (int i = 0; i < row; ++i) {
						const double u = nodes[(k * extent + j) * extent + i];
						plane[i] += w.N[1][j] * u;
						if (axis != 1) planeY[i] += arms.Nx[1][j] * u;
					}
#pragma omp simd
				for (int i = 0; i < row; ++i) {
					value[i] += w.N[2][k] * plane[i];
					if (axis != 1) y[i] += w.N[2][k] * planeY[i];
					if (axis != 2) z[i] += arms.Nx[2][k] * plane[i];
				}
			}
		}
		double sum = 0;
		for (int e = 0; e < dim; ++e)
			moment[e] = 0;
		for (int i = 0; i < row; ++i) {
			sum += w.N[0][i] * value[i];
			if (axis != 0) moment[0] += arms.Nx[0][i] * value[i];
			if (axis != 1) moment[1] += w.N[0][i] * y[i];
			if constexpr (dim == 3)
				if (axis != 2) moment[2] += w.N[0][i] * z[i];
		}
		return sum;
	}
} // namespace detail

/* What a nodal field gives to a point: velocity and angular velocity. */
template <int dim, class Shape>
void gatherMotion(
	const Weights<dim, Shape>& w, const Arms<dim, Shape>& arms, const typename Patch<dim, Shape>::Values* field, double (&v)[dim], double (&W)[turns<dim>])
{
	double moment[dim][dim];
	v[0] = detail::gatherMoments<0>(w, arms, field[0], moment[0]);
	v[1] = detail::gatherMoments<1>(w, arms, field[1], moment[1]);
	if constexpr (dim == 3) v[2] = detail::gatherMoments<2>(w, arms, field[2], moment[2]);
	for (int k = 0; k < turns<dim>; ++k) {
		const int from = turnsFrom<dim>(k), to = turnsTo<dim>(k);
		W[k] = (moment[to][from] - moment[from][to]) / arms.inertia(k);
	}
}

/* Energy of the points' rotation, sum J_p W_p^2 / 2 [J]; of points in the tiles of the grid. */
template <int dim, class Shape> double spinEnergy(const Transfer<dim, Shape>& transfer)
{
	const Points& P = transfer.points;
	if (P.angularVelocity.empty()) return 0;
	double energy = 0;
	if constexpr (dim > 1)
		for (const auto& tile : transfer.grid.tiles())
			for (std::size_t p = tile.begin; p < tile.end; ++p) {
				const Arms<dim, Shape> arms(transfer.weights(tile, p), transfer.geometry.cell);
				for (int k = 0; k < turns<dim>; ++k)
					energy +=
						.5 * P.mass[p] * arms.inertia(k) * P.angularVelocity[std::size_t(k)][p] * P.angularVelocity[std::size_t(k)][p];
			}
	return energy;
}

} // namespace yade::mpm
