// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "../transfer/Rotation.hpp"
#include "MeanDilatation.hpp"
#include "NodeFields.hpp"
#include "PointState.hpp"

namespace yade::mpm {

/* Eqs. 12 and 13:  m_i = sum N_ip m_p,  (m v)_i = sum N_ip m_p v_p,
f_i = sum N_ip (f_p + m_p g) - V_p sigma_p grad N_ip.

With the affine transfer the points bring their rotation along (Rotation.hpp).

Passes are functions of one tile, compiled by run() once for each instruction set, so that a pass gives the same bits
wherever it is called from. */

enum class Sums { motion, forces, all };

namespace detail {
	/* Position, mass and momentum. */
	template <int dim> void loadMotion(const Points& points, Block block, Lanes (&x)[dim], Lanes& mp, Lanes (&mvp)[dim])
	{
		load(points.mass, block, mp);
		for (int d = 0; d < dim; ++d) {
			load(points.position[std::size_t(d)], block, x[d]);
			load(points.velocity[std::size_t(d)], block, mvp[d]);
			forLanes([&](int l) { mvp[d][l] *= mp[l]; });
		}
	}

	/* f_p + m_p g, in axisymmetry with the hoop stress -V_p sigma_hoop / r_p, and V_p sigma_p. */
	template <class S>
	void pointForces(const Points& points, Block block, const StepControl& control, const Lanes& mp, const Lanes& r, Lanes (&fp)[S::dim],
		Lanes (&Vs)[S::dim][S::dim])
	{
		Lanes V;
		currentVolume<S::dim>(points, block, control.largeStrain, V);
		externalForces(points, block, control, mp, fp);
		for (int d = 0; d < S::dim; ++d)
			for (int e = 0; e < S::dim; ++e) {
				load(points.stress[std::size_t(componentOf<S>(d, e))], block, Vs[d][e]);
				forLanes([&](int l) { Vs[d][e][l] *= V[l]; });
			}
		if constexpr (hasHoop<S>) {
			Lanes sigma;
			load(points.stress[2], block, sigma);
			forLanes([&](int l) { fp[0][l] -= V[l] * sigma[l] / r[l]; });
		}
	}

	/* In axisymmetry the lumped mass of a node for radial motion is sum N_ip m_p r_p / r_i, with r_i negative behind the axis:
	then a uniform expansion v_r = a r passes from the points to the grid and back unchanged, momentum and energy included.
	With sum N_ip m_p it would be wrong by a third in the cell at the axis. */
	template <class S, class Shape>
	void addRadialMass(const Transfer<S::dim, Shape>& transfer, const typename Transfer<S::dim, Shape>::Tile& tile, Field& radialMass)
	{
		using T                   = Transfer<S::dim, Shape>;
		const Points&      points = transfer.points;
		typename T::Values mr {};
		for (std::size_t p = tile.begin; p < tile.end; ++p)
			transfer.weights(tile, p).forEachNode([&, mass = points.mass[p] * points.position[0][p]](
								      int i, double Nip, const std::array<double, S::dim>&) { mr[i] += Nip * mass; });
		for (int i = 0; i < T::Patch::nodes; ++i) {
			const double h = transfer.geometry.cell[0];
			const double r = transfer.geometry.origin[0] + (tile.index[0] * T::Grid::width + i % T::Patch::extent) * h;
			mr[i]          = std::abs(r) > 1e-9 * h ? mr[i] / r : 0; // on the axis nothing moves
		}
		T::Patch::add(tile, mr, radialMass);
	}

	template <Sums sums, bool affine, class S, class Shape>
	void spreadTile(const Transfer<S::dim, Shape>& transfer, NodeFields<S>& fields, const StepControl& control, std::size_t t)
	{
		constexpr int  dim = S::dim, row = Shape::row;
		constexpr bool motion = sums != Sums::forces, forces = sums != Sums::motion, rotates = affine && motion;
		using Patch          = mpm::Patch<dim, Shape>;
		using Values         = typename Patch::Values;
		const auto&   tile   = transfer.grid.tiles()[t];
		const Points& points = transfer.points;
		Values        m {}, mv[dim] {}, f[dim] {}, pressure;
		const bool    averaged = forces && averagesDilatation<S>(control);
		if (averaged) elementPressures<S>(transfer, tile, control, pressure);
		forEachBlock(tile.begin, tile.end, [&](Block block) {
			Lanes                   x[dim], mp, mvp[dim], fp[dim], Vs[dim][dim];
			WeightLanes<dim, Shape> w;
			loadMotion(points, block, x, mp, mvp);
			transfer.weights(tile, block, x, w);
			if (forces) pointForces<S>(points, block, control, mp, x[0], fp, Vs);
			if (averaged) takeMeanPressure<S, Shape>(points, block, control, w, pressure, x[0], fp, Vs);
			for (int l = 0; l < block.count; ++l) {
				// along x, all that a row's weights across will multiply
				alignas(8 * row) double     rm[row], rmv[dim][row], rf[dim][dim][row];
				const double *              N = w[l].N[0], *dN = w[l].dN[0];
				RowsOf<rotates, dim, Shape> rotation;
				if constexpr (rotates) rotation.set(points, block, l, w[l], transfer.geometry.cell, mp[l], -.5 * control.dt);
#pragma omp simd
				for (int i = 0; i < row; ++i) {
					if (motion) rm[i] = mp[l] * N[i];
					for (int d = 0; d < dim; ++d) {
						if (motion) rmv[d][i] = mvp[d][l] * N[i];
						if constexpr (rotates) rmv[d][i] += rotation.alongX[d][i];
						if (!forces) continue;
						rf[d][0][i] = fp[d][l] * N[i] - Vs[d][0][l] * dN[i];
						for (int e = 1; e < dim; ++e)
							rf[d][e][i] = -Vs[d][e][l] * N[i];
					}
				}
				int n = 0;
				w[l].forEachRow([&](int offset, const std::array<double, dim>& c) {
					const int at = w[l].first + offset;
#pragma omp simd
					for (int i = 0; i < row; ++i) {
						if (motion) m[at + i] += c[0] * rm[i];
						for (int d = 0; d < dim; ++d) {
							if constexpr (rotates)
								mv[d][at + i] += c[0] * (rmv[d][i] + rotation.acrossRows[d][n] * N[i]);
							else if (motion)
								mv[d][at + i] += c[0] * rmv[d][i];
							if (!forces) continue;
							double sum = f[d][at + i];
							for (int e = 0; e < dim; ++e)
								sum += c[e] * rf[d][e][i];
							f[d][at + i] = sum;
						}
					}
					++n;
				});
			}
		});
		if (motion) Patch::add(tile, m, fields.mass);
		for (int d = 0; d < dim; ++d) {
			if (motion) Patch::add(tile, mv[d], fields.momentum[d]);
			if (forces) Patch::add(tile, f[d], fields.force[d]);
		}
		if constexpr (hasHoop<S> && motion) addRadialMass<S>(transfer, tile, fields.radialMass);
	}
} // namespace detail

/* Adds the sums of a tile's points to the fields. */
template <Sums sums, class S, class Shape>
void pointsToGrid(const Transfer<S::dim, Shape>& transfer, NodeFields<S>& fields, const StepControl& control, std::size_t t)
{
	if constexpr (S::dim > 1 && sums != Sums::forces)
		if (!transfer.points.angularVelocity.empty())
			return run(transfer.instructions, [&, t] { detail::spreadTile<sums, true>(transfer, fields, control, t); });
	run(transfer.instructions, [&, t] { detail::spreadTile<sums, false>(transfer, fields, control, t); });
}

} // namespace yade::mpm
