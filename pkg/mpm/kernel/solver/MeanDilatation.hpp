// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "../transfer/Transfer.hpp"
#include "PointState.hpp"

namespace yade::mpm {

/* Against volumetric locking: the points of an element, between the same knots of the grid's splines, change their volume as
one (Nagtegaal, Parks & Rice, CMAME 4 (1974) 153; Hughes, IJNME 15 (1980) 1413). With <.> the mean over an element, weighted by
the volumes at the start of the step,

  strain   dF_p <- exp[(<theta> - theta_p)/n] dF_p,   theta_p = ln det dF_p   (small strain: G_p <- G_p + (<theta> - theta_p)/n I)
  forces   sigma_p <- sigma_p + (<q> - q_p) I,        q_p the mean of the n normal stresses that do work

n = 2 in plane strain, else 3. The mean is its own adjoint, sum V_p <q> theta_p = sum V_p q_p <theta>: the forces do the work that
the stress takes, whatever the law. A point keeps its own stress; only its forces see the mean.

Points of an element share all their nodes, hence a tile; the means are stored at the first of these nodes. */

/* Normal strains that change a volume. */
template <class S> constexpr int dilating = normals<S>() < 3 ? 0 : hasHoop<S> ? 3 : S::dim;

template <class S> bool averagesDilatation(const StepControl& control) { return dilating<S> > 0 && control.meanDilatation; }

namespace detail {
	template <class S> double dilatation(const Lanes (&G)[gradients<S>], int l, bool largeStrain)
	{
		constexpr int dim = S::dim;
		double        dF[dim * dim], trace = hasHoop<S> ? G[gradients<S> - 1][l] : 0;
		for (int k = 0; k < dim * dim; ++k) {
			const bool diagonal = k % (dim + 1) == 0;
			dF[k]               = G[k][l] + diagonal;
			trace += diagonal ? G[k][l] : 0;
		}
		return largeStrain ? std::log(determinant<dim>(dF) * (hasHoop<S> ? 1 + G[gradients<S> - 1][l] : 1)) : trace;
	}
	template <class S> double pressure(const Points& points, std::size_t p)
	{
		double q = 0;
		for (std::size_t k = 0; k < std::size_t(dilating<S>); ++k)
			q += points.stress[k][p] / dilating<S>;
		return q;
	}

	/* Means over the elements of value(w, r, p, l), at the first node of each. */
	template <class S, class Shape, class Value>
	void elementMeans(const Transfer<S::dim, Shape>& transfer, const typename Transfer<S::dim, Shape>::Tile& tile, const StepControl& control,
		typename Transfer<S::dim, Shape>::Values& mean, Value&& value)
	{
		using T = Transfer<S::dim, Shape>;
		typename T::Values volume {}, sum {};
		forEachBlock(tile.begin, tile.end, [&](Block block) {
			Lanes                      x[S::dim];
			WeightLanes<S::dim, Shape> w;
			for (int d = 0; d < S::dim; ++d)
				load(transfer.points.position[std::size_t(d)], block, x[d]);
			transfer.weights(tile, block, x, w);
			for (int l = 0; l < block.count; ++l) {
				const std::size_t p = block.first + std::size_t(l);
				const double      V = currentVolume<S::dim>(transfer.points, p, control.largeStrain);
				volume[w[l].first] += V, sum[w[l].first] += V * value(w[l], x[0][l], p, l);
			}
		});
		for (int i = 0; i < T::Patch::nodes; ++i)
			mean[i] = volume[i] > 0 ? sum[i] / volume[i] : 0;
	}
} // namespace detail

/* <q>. */
template <class S, class Shape>
[[gnu::noinline]] void elementPressures(const Transfer<S::dim, Shape>& transfer, const typename Transfer<S::dim, Shape>::Tile& tile, const StepControl& control,
	typename Transfer<S::dim, Shape>::Values& mean)
{
	detail::elementMeans<S, Shape>(
		transfer, tile, control, mean, [&](const auto&, double, std::size_t p, int) { return detail::pressure<S>(transfer.points, p); });
}
/* <theta> of the nodal velocities v. */
template <class S, class Shape>
[[gnu::noinline]] void elementDilatations(const Transfer<S::dim, Shape>& transfer, const typename Transfer<S::dim, Shape>::Tile& tile,
	const StepControl& control, const typename Transfer<S::dim, Shape>::Values* v, typename Transfer<S::dim, Shape>::Values& mean)
{
	Lanes G[gradients<S>];
	detail::elementMeans<S, Shape>(transfer, tile, control, mean, [&](const auto& w, double r, std::size_t, int l) {
		displacementGradient<S>(w, v, r, control.dt, l, G);
		return detail::dilatation<S>(G, l, control.largeStrain);
	});
}

template <class S, class Shape>
[[gnu::noinline]] void takeMeanDilatation(Block block, const StepControl& control, const WeightLanes<S::dim, Shape>& w,
	const typename Patch<S::dim, Shape>::Values& mean, Lanes (&G)[gradients<S>])
{
	constexpr int dim = S::dim;
	for (int l = 0; l < lanes; ++l) {
		const double change = (mean[w[std::min(l, block.count - 1)].first] - detail::dilatation<S>(G, l, control.largeStrain)) / dilating<S>;
		const double more   = control.largeStrain ? std::expm1(change) : change;
		for (int k = 0; k < gradients<S>; ++k) {
			if (control.largeStrain) G[k][l] += more * G[k][l];
			if (k == dim * dim || k % (dim + 1) == 0) G[k][l] += more;
		}
	}
}

template <class S, class Shape>
[[gnu::noinline]] void takeMeanPressure(const Points& points, Block block, const StepControl& control, const WeightLanes<S::dim, Shape>& w,
	const typename Patch<S::dim, Shape>::Values& mean, const Lanes& r, Lanes (&fp)[S::dim], Lanes (&Vs)[S::dim][S::dim])
{
	for (int l = 0; l < block.count; ++l) {
		const std::size_t p      = block.first + std::size_t(l);
		const double      change = currentVolume<S::dim>(points, p, control.largeStrain) * (mean[w[l].first] - detail::pressure<S>(points, p));
		for (int d = 0; d < S::dim; ++d)
			Vs[d][d][l] += change;
		if constexpr (hasHoop<S>) fp[0][l] -= change / r[l];
	}
}

} // namespace yade::mpm
