// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "../Lanes.hpp"
#include "Patch.hpp"
#include "ShapeFunction.hpp"
#include <array>

namespace yade::mpm {

/* Weights of one point at the nodes of its support: N_ip = product of N[d] over the axes, grad N_ip likewise with dN. */
template <int dim, class Shape> struct Weights {
	static constexpr int support = Shape::support, row = Shape::row, extent = Patch<dim, Shape>::extent;

	alignas(8 * row) double N[dim][row], dN[dim][row]; // dN in 1/m; zero beyond the support
	int first;                                         // node of the patch

	/* visit(offset from the first node, c) for every row of nodes along x: N_ip = c[0] N[0][i], and
	grad N_ip = (c[0] dN[0][i], c[1] N[0][i], c[2] N[0][i]). */
	template <class Visit> void forEachRow(Visit&& visit) const
	{
		if constexpr (dim == 1) {
			visit(0, std::array<double, 1> { 1. });
		} else if constexpr (dim == 2) {
			for (int j = 0; j < support; ++j)
				visit(j * extent, std::array<double, 2> { N[1][j], dN[1][j] });
		} else {
			for (int k = 0; k < support; ++k)
				for (int j = 0; j < support; ++j)
					visit((k * extent + j) * extent, std::array<double, 3> { N[1][j] * N[2][k], dN[1][j] * N[2][k], N[1][j] * dN[2][k] });
		}
	}
	/* visit(node of the patch, N_ip, grad N_ip) for every node. */
	template <class Visit> void forEachNode(Visit&& visit) const
	{
		if constexpr (dim == 1) {
			for (int i = 0; i < support; ++i)
				visit(first + i, N[0][i], std::array<double, 1> { dN[0][i] });
		} else if constexpr (dim == 2) {
			for (int j = 0; j < support; ++j)
				for (int i = 0; i < support; ++i)
					visit(first + j * extent + i, N[0][i] * N[1][j], std::array<double, 2> { dN[0][i] * N[1][j], N[0][i] * dN[1][j] });
		} else {
			for (int k = 0; k < support; ++k)
				for (int j = 0; j < support; ++j) {
					const double yz = N[1][j] * N[2][k], dyz = dN[1][j] * N[2][k], ydz = N[1][j] * dN[2][k];
					for (int i = 0; i < support; ++i)
						visit(first + (k * extent + j) * extent + i, N[0][i] * yz,
							std::array<double, 3> { dN[0][i] * yz, N[0][i] * dyz, N[0][i] * ydz });
				}
		}
	}

	/* sum N_ip field_i. */
	double gather(const double* field) const
	{
		const double*           nodes = field + first;
		alignas(8 * row) double part[row];
#pragma omp simd
		for (int i = 0; i < row; ++i)
			part[i] = N[0][i] * acrossRows<-1>(nodes + i);
		return sumOfRow(part);
	}
	/* sum grad N_ip field_i. */
	void gatherGradient(const double* field, double (&gradient)[dim]) const { gatherWithGradient<false>(field, gradient); }
	/* The same; returns sum N_ip field_i where value. */
	template <bool value = true> double gatherWithGradient(const double* field, double (&gradient)[dim]) const
	{
		const double*           nodes = field + first;
		alignas(8 * row) double part[dim][row], values[row];
#pragma omp simd
		for (int i = 0; i < row; ++i) {
			const double across = acrossRows<-1>(nodes + i);
			part[0][i]          = dN[0][i] * across;
			if (value) values[i] = N[0][i] * across;
			if constexpr (dim > 1) part[1][i] = N[0][i] * acrossRows<1>(nodes + i);
			if constexpr (dim > 2) part[2][i] = N[0][i] * acrossRows<2>(nodes + i);
		}
		for (int e = 0; e < dim; ++e)
			gradient[e] = sumOfRow(part[e]);
		return value ? sumOfRow(values) : 0;
	}

private:
	/* Sum over the rows of the support at one place along them, with N across, or with dN along axis e. */
	template <int e> double acrossRows(const double* nodes) const
	{
		if constexpr (dim == 1)
			return *nodes;
		else if constexpr (dim == 2)
			return acrossPlane(e == 1 ? dN[1] : N[1], nodes);
		else {
			double sum = 0;
			for (int k = 0; k < support; ++k)
				sum += (e == 2 ? dN[2] : N[2])[k] * acrossPlane(e == 1 ? dN[1] : N[1], nodes + k * extent * extent);
			return sum;
		}
	}
	static double acrossPlane(const double* weights, const double* nodes)
	{
		double sum = 0;
		for (int j = 0; j < support; ++j)
			sum += weights[j] * nodes[j * extent];
		return sum;
	}
	static double sumOfRow(const double (&x)[row])
	{
		if constexpr (row == 2)
			return x[0] + x[1];
		else
			return (x[0] + x[2]) + (x[1] + x[3]);
	}
};

/* Weights of a block of points. */
template <int dim, class Shape> using WeightLanes = Weights<dim, Shape>[lanes];

/* (m v)_i += N_ip m_p v_p for a block of points. */
template <int dim, class Shape>
void spreadMomentum(const WeightLanes<dim, Shape>& w, Block block, const Lanes (&mvp)[dim], typename Patch<dim, Shape>::Values (&mv)[dim])
{
	constexpr int row = Shape::row;
	for (int l = 0; l < block.count; ++l) {
		alignas(8 * row) double rmv[dim][row];
#pragma omp simd
		for (int i = 0; i < row; ++i)
			for (int d = 0; d < dim; ++d)
				rmv[d][i] = mvp[d][l] * w[l].N[0][i];
		w[l].forEachRow([&](int offset, const std::array<double, dim>& c) {
			const int at = w[l].first + offset;
#pragma omp simd
			for (int i = 0; i < row; ++i)
				for (int d = 0; d < dim; ++d)
					mv[d][at + i] += c[0] * rmv[d][i];
		});
	}
}

} // namespace yade::mpm
