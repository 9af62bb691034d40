// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "../Kinematics.hpp"
#include "../Lanes.hpp"
#include "Solver.hpp"

namespace yade::mpm {

/* Quantities of the points that several passes need, each written once. */

/* V0 det F, times the stretch normal to the plane where points have one. */
template <int dim> double currentVolume(double volume0, const double* F, double stretch = 1) { return volume0 * determinant<dim>(F) * stretch; }

/* Current volume of a point whose deformation gradient is F; its initial one in small strain. */
template <int dim> double currentVolume(const Points& points, std::size_t p, const double* F, bool largeStrain)
{
	if (!largeStrain) return points.volume0[p];
	return currentVolume<dim>(points.volume0[p], F, points.thicknessStretch.empty() ? 1 : points.thicknessStretch[p]);
}
template <int dim> double currentVolume(const Points& points, std::size_t p, bool largeStrain)
{
	double F[dim * dim];
	for (std::size_t k = 0; k < dim * dim; ++k)
		F[k] = points.deformation[k][p];
	return currentVolume<dim>(points, p, F, largeStrain);
}
template <int dim> void currentVolume(const Points& points, Block block, bool largeStrain, Lanes& V)
{
	load(points.volume0, block, V);
	if (!largeStrain) return;
	Lanes F[dim * dim], stretch;
	for (std::size_t k = 0; k < dim * dim; ++k)
		load(points.deformation[k], block, F[k]);
	auto lane = [&](int l, double normal) {
		double f[dim * dim];
		for (int k = 0; k < dim * dim; ++k)
			f[k] = F[k][l];
		V[l] = currentVolume<dim>(V[l], f, normal);
	};
	if (points.thicknessStretch.empty()) return forLanes([&](int l) { lane(l, 1); });
	load(points.thicknessStretch, block, stretch);
	forLanes([&](int l) { lane(l, stretch[l]); });
}

/* Forces on the points but for stress: f_p + m_p g [N]. */
template <int dim> void externalForces(const Points& points, Block block, const StepControl& control, const Lanes& mp, Lanes (&fp)[dim])
{
	for (int d = 0; d < dim; ++d) {
		const double g = control.gravity[std::size_t(d)];
		if (points.force.empty())
			forLanes([&](int l) { fp[d][l] = mp[l] * g; });
		else {
			load(points.force[std::size_t(d)], block, fp[d]);
			forLanes([&](int l) { fp[d][l] += mp[l] * g; });
		}
	}
}

/* dt grad v of a point with these weights in the velocities of its patch; in axisymmetry dt v_r / r comes last. */
template <class S, class Weights, class Values>
void displacementGradient(const Weights& w, const Values* v, double r, double dt, int l, Lanes (&G)[gradients<S>])
{
	constexpr int dim = S::dim;
	for (int d = 0; d < dim; ++d) {
		double gradient[dim];
		w.gatherGradient(v[d], gradient);
		for (int e = 0; e < dim; ++e)
			G[d * dim + e][l] = dt * gradient[e];
	}
	if constexpr (hasHoop<S>) G[dim * dim][l] = dt * w.gather(v[0]) / r;
}

/* sum m_p v_p^2 / 2 [J]. */
template <int dim> double kineticEnergy(const Points& points)
{
	double kinetic = 0;
	for (std::size_t d = 0; d < dim; ++d)
		for (std::size_t p = 0; p < points.count(); ++p)
			kinetic += .5 * points.mass[p] * points.velocity[d][p] * points.velocity[d][p];
	return kinetic;
}

} // namespace yade::mpm
