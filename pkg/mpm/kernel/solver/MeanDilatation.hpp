// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "MpmSolver.hpp"

namespace yade::mpm {

/* Against volumetric locking: the points of an element, between the same knots of the grid's splines, change their volume as
one (Nagtegaal, Parks & Rice, CMAME 4 (1974) 153; Hughes, IJNME 15 (1980) 1413). With <.> the mean over an element, weighted by
the volumes at the start of the step,

  strain   dF_p <- exp[(<theta> - theta_p)/n] dF_p,   theta_p = ln det dF_p   (small strain: G_p <- G_p + (<theta> - theta_p)/n I)
  forces   sigma_p <- sigma_p + (<q> - q_p) I,        q_p the mean of the n normal stresses that do work

n = 2 in plane strain, else 3. The mean is its own adjoint, sum V_p <q> theta_p = sum V_p q_p <theta>: the forces do the work that
the stress takes, whatever the law. A point keeps its own stress; only its forces see the mean.

Points of an element share all their nodes, hence a tile; what is known of an element stands at the first of these nodes. */

template <class S, class Shape> double MpmSolver<S, Shape>::dilatation(const Lanes (&G)[gradients<S>], int l) const
{
	double dF[dim * dim], trace = hoop ? G[gradients<S> - 1][l] : 0;
	for (int k = 0; k < dim * dim; ++k) {
		const bool diagonal = k % (dim + 1) == 0;
		dF[k]               = G[k][l] + diagonal;
		trace += diagonal ? G[k][l] : 0;
	}
	return m_stressControl.largeStrain ? std::log(determinant<dim>(dF) * (hoop ? 1 + G[gradients<S> - 1][l] : 1)) : trace;
}

/* Current volume of a point, and q. */
template <class S, class Shape> std::pair<double, double> MpmSolver<S, Shape>::volumeAndPressure(std::size_t p) const
{
	double F[dim * dim], q = 0;
	for (int k = 0; k < dim * dim; ++k)
		F[k] = m_points.deformation[k][p];
	for (int k = 0; k < dilating; ++k)
		q += m_points.stress[k][p] / dilating;
	return { volume(p, F), q };
}

/* <theta> of the velocities v; <q> where there are none. */
template <class S, class Shape> void MpmSolver<S, Shape>::elementMeans(const Tile& tile, const Patch* v, Patch& mean) const
{
	Patch volume {}, sum {};
	forEachBlock(tile.begin, tile.end, [&](Block block) {
		Lanes       x[dim], G[gradients<S>];
		WeightLanes w;
		for (int d = 0; d < dim; ++d)
			load(m_points.position[d], block, x[d]);
		weights(tile, block, x, w);
		for (int l = 0; l < block.count; ++l) {
			const auto [V, q] = volumeAndPressure(block.first + std::size_t(l));
			if (v) displacementGradient(w[l], v, x[0][l], l, G);
			volume[w[l].first] += V, sum[w[l].first] += V * (v ? dilatation(G, l) : q);
		}
	});
	for (int i = 0; i < local; ++i)
		mean[i] = volume[i] > 0 ? sum[i] / volume[i] : 0;
}

template <class S, class Shape>
void MpmSolver<S, Shape>::takeMeanDilatation(Block block, const WeightLanes& w, const Patch& mean, Lanes (&G)[gradients<S>]) const
{
	for (int l = 0; l < lanes; ++l) {
		const double change = (mean[w[std::min(l, block.count - 1)].first] - dilatation(G, l)) / dilating;
		const double more   = m_stressControl.largeStrain ? std::expm1(change) : change;
		for (int k = 0; k < gradients<S>; ++k) {
			if (m_stressControl.largeStrain) G[k][l] += more * G[k][l];
			if (k == dim * dim || k % (dim + 1) == 0) G[k][l] += more;
		}
	}
}

template <class S, class Shape>
void MpmSolver<S, Shape>::takeMeanPressure(Block block, const WeightLanes& w, const Patch& mean, const Lanes& r, Lanes (&fp)[dim], Lanes (&Vs)[dim][dim]) const
{
	for (int l = 0; l < block.count; ++l) {
		const auto [V, q]   = volumeAndPressure(block.first + std::size_t(l));
		const double change = V * (mean[w[l].first] - q);
		for (int d = 0; d < dim; ++d)
			Vs[d][d][l] += change;
		if constexpr (hoop) fp[0][l] -= change / r[l];
	}
}

} // namespace yade::mpm
