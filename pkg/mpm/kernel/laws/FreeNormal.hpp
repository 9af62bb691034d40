// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "PointLaw.hpp"
#include "Tangent.hpp"
#include <algorithm>

namespace yade::mpm {

/* Carries an isotropic law, known in the components of Solid, over to a stress state whose missing normal stresses are
zero. They all get the same strain increment e, the root of the stress that it causes there, found between brackets by
the rule of false position with Illinois' correction, in every lane until the last has converged.

update(strain, sigma, p, dissipation) is the law of one point in Solid; p its one internal variable. */
template <class S, class Update, int W>
void updateWithFreeNormals(const Hooke& C, Update&& update, const Pack<W>* strain, Pack<W>* sigma, Pack<W>& p, Responses<W>& response)
{
	static_assert(normals<S>() < 3);
	constexpr int N = S::N;
	Pack<W>       full[6] {}, s[6] {}, p3, heat, goal, size, a, b, e, fa, fb, fe, width;
	auto          freeStress = [&](const Pack<W>& trial, Pack<W>& f) {
                for (Pack<W>& component : s)
                        component = {};
                for (int k = 0; k < 3; ++k)
                        full[k] = trial;
                for (int k = 0; k < N; ++k)
                        full[S::voigtIndex[k]] = strain[k], s[S::voigtIndex[k]] = sigma[k];
                p3 = p, heat = {};
                updatePoints<Solid>(update, full, s, p3, heat);
                f = s[2];
	};
	const double modulus = C.lame + 2 * C.shear, ratio = normals<S>() == 1 ? C.poisson : C.poisson / (1 - C.poisson);
	forLanes<W>([&](int l) {
		double largest = 0, stress = 0, elastic = 0;
		for (int k = 0; k < N; ++k)
			largest = std::max(largest, std::abs(strain[k][l])), stress = std::max(stress, std::abs(sigma[k][l]));
		for (int k = 0; k < normals<S>(); ++k)
			elastic -= ratio * strain[k][l];
		size[l] = largest, goal[l] = 1e-14 * modulus * largest + 1e-15 * stress, b[l] = elastic;
	});

	// from the elastic root outwards until the stress changes sign, then inwards
	freeStress(b, fb);
	a = b, fa = fb;
	forLanes<W>([&](int l) { width[l] = std::abs(fb[l]) / modulus; });
	auto outwards = [&](int l) { return (std::abs(fb[l]) > goal[l]) & (fb[l] * fa[l] > 0) & (width[l] < 1e300); };
	while (anyLane<W>(outwards)) {
		forLanes<W>([&](int l) {
			const bool go = outwards(l);
			a[l] = go ? b[l] : a[l], fa[l] = go ? fb[l] : fa[l];
			b[l] -= go ? std::copysign(width[l], fa[l]) : 0;
			width[l] *= go ? 2 : 1;
		});
		freeStress(b, fb);
	}
	auto inwards = [&](int l) { return (std::abs(fb[l]) > goal[l]) & (std::abs(b[l] - a[l]) > 1e-16 * size[l]); };
	for (int iteration = 0; iteration < 200 && anyLane<W>(inwards); ++iteration) {
		forLanes<W>([&](int l) { e[l] = inwards(l) ? b[l] - fb[l] * (b[l] - a[l]) / (fb[l] - fa[l]) : b[l]; });
		freeStress(e, fe);
		forLanes<W>([&](int l) {
			const bool go = inwards(l), across = fe[l] * fb[l] < 0;
			a[l]  = (go & across) ? b[l] : a[l];
			fa[l] = go ? (across ? fb[l] : .5 * fa[l]) : fa[l];
			b[l] = e[l], fb[l] = fe[l];
		});
	}
	for (int k = 0; k < N; ++k)
		sigma[k] = s[S::voigtIndex[k]];
	p = p3;
	forLanes<W>([&](int l) { response.freeStrain[l] += b[l], response.dissipation[l] += heat[l]; });
}

/* Applies the update of one point, update(S(), strain, sigma, p, dissipation), in every stress state: directly where all
three normal stresses are components of S, else by updateWithFreeNormals(). */
template <class S, class Update, int W, class T>
void updateInSolid(const Hooke& C, Update&& update, const Pack<W, T>* strain, Pack<W, T>* sigma, Pack<W, T>& p, Responses<W, T>& response)
{
	if constexpr (normals<S>() == 3)
		updatePoints<S>([&](auto&&... point) { update(S(), point...); }, strain, sigma, p, response.dissipation);
	else
		updateWithFreeNormals<S>(
			C, [&](auto&&... point) { update(Solid(), point...); }, strain, sigma, p, response);
}

/* The tangent of a law that is updated by updateInSolid(): that of Solid at the strain found, condensed. */
template <class S, class Model>
void differentiateInSolid(const Model& law, const Hooke& C, const double* strain, const double* sigma, const double* internal, double* tangent)
{
	if constexpr (normals<S>() == 3)
		differentiateUpdate<S>(law, C, strain, sigma, internal, tangent);
	else {
		Pack<1>      e[S::N], s[S::N], state[Model::maxInternals.columns(S::N) + 1] {};
		Responses<1> response;
		double       fullStrain[6] {}, fullStress[6] {}, solid[36];
		for (int k = 0; k < S::N; ++k) {
			const int c = S::voigtIndex[std::size_t(k)];
			e[k][0] = fullStrain[c] = strain[k], s[k][0] = fullStress[c] = sigma[k];
		}
		for (int k = 0; k < law.internals().columns(S::N); ++k)
			state[k][0] = internal[k];
		law.template update<S>(C, e, s, state, response);
		for (int k = normals<S>(); k < 3; ++k)
			fullStrain[k] = response.freeStrain[0];
		differentiateUpdate<Solid>(law, C, fullStrain, fullStress, internal, solid);
		condenseTangent<S>(solid, tangent);
	}
}

} // namespace yade::mpm
