// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "PointLaw.hpp"
#include "Tangent.hpp"
#include <algorithm>
#include <limits>

namespace yade::mpm {

/* Carries an isotropic law, known in the components of PlaneStrain and Solid, over to a stress state whose missing normal stresses
are zero. They all get the same strain increment e, the root of the stress that it causes there, found between brackets by
the rule of false position with Illinois' correction, in every lane until the last has converged.

update(Full(), strain, sigma, p, dissipation) is the law of all lanes in a stress state Full with three normal stresses; p its one
internal variable. flat: the law carries no tension, so that the stress is zero for any larger e as well; the least one is then
found by bisection. */
template <class S, class Update, int W>
void updateWithFreeNormals(const Hooke& C, Update&& update, const Pack<W>* strain, Pack<W>* sigma, Pack<W>& p, Responses<W>& response, bool flat)
{
	static_assert(normals<S>() < 3);
	using Full           = std::conditional_t<S::dim == 3, Solid, PlaneStrain>;
	constexpr int  N     = S::N;
	constexpr auto place = [](int k) {
		return S::voigtIndex[std::size_t(k)] < 3 ? S::voigtIndex[std::size_t(k)] : Full::N - 6 + S::voigtIndex[std::size_t(k)];
	};
	Pack<W>      full[Full::N] {}, s[Full::N] {}, p3, heat, goal, size, a, b, e, fa, fb, fe, width;
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
	auto outwards                 = [&](int l) { return (std::abs(fb[l]) > goal[l]) & (fb[l] * fa[l] > 0) & (width[l] < 1e300); };
	auto inwards                  = [&](int l) { return (std::abs(fb[l]) > goal[l]) & (std::abs(b[l] - a[l]) > 1e-16 * size[l]); };
	enum { first, out, in } phase = first;
	int left                      = 200; // iterations inwards
	e                             = b;
	while (true) { // with one call of the law, which is inlined
		for (Pack<W>& component : s)
			component = {};
		for (int k = 0; k < 3; ++k)
			full[k] = e;
		for (int k = 0; k < N; ++k)
			full[place(k)] = strain[k], s[place(k)] = sigma[k];
		p3 = p, heat = {};
		update(Full(), full, s, p3, heat);
		fe = s[2];

		if (phase == first) {
			a = b, fa = fb = fe, phase = out;
			forLanes<W>([&](int l) { width[l] = std::abs(fb[l]) / modulus; });
		} else {
			forLanes<W>([&](int l) {
				const bool go = phase == out ? outwards(l) : inwards(l), inner = go & (phase == in);
				// where the law carries no tension, zero stress counts as positive
				const double f      = (flat & (fe[l] >= -goal[l])) ? 2 * goal[l] + std::numeric_limits<double>::min() : fe[l];
				const bool   across = f * fb[l] < 0;
				a[l]                = (inner & across) ? b[l] : a[l];
				fa[l]               = inner ? (across ? fb[l] : .5 * fa[l]) : fa[l];
				b[l] = go ? e[l] : b[l], fb[l] = go ? f : fb[l];
			});
		}

		if (phase == out) {
			if (anyLane<W>(outwards)) {
				forLanes<W>([&](int l) {
					const bool go = outwards(l);
					a[l] = go ? b[l] : a[l], fa[l] = go ? fb[l] : fa[l];
					e[l] = go ? b[l] - std::copysign(width[l], fa[l]) : b[l];
					width[l] *= go ? 2 : 1;
				});
				continue;
			}
			phase = in;
		}
		if (left-- == 0 || !anyLane<W>(inwards)) break;
		forLanes<W>([&](int l) {
			const double secant = fb[l] * (b[l] - a[l]) / (fb[l] - fa[l]);
			e[l]                = b[l] - (inwards(l) ? flat ? .5 * (b[l] - a[l]) : secant : 0);
		});
	}
	for (int k = 0; k < N; ++k)
		sigma[k] = s[place(k)];
	p = p3;
	forLanes<W>([&](int l) { response.freeStrain[l] += b[l], response.dissipation[l] += heat[l]; });
}

/* Applies the update of all lanes, update(S(), strain, sigma, p, dissipation), in every stress state: directly where all
three normal stresses are components of S, else by updateWithFreeNormals(). */
template <class S, class Update, int W, class T>
void updateLanesInSolid(
	const Hooke& C, Update&& update, const Pack<W, T>* strain, Pack<W, T>* sigma, Pack<W, T>& p, Responses<W, T>& response, bool flat = false)
{
	if constexpr (normals<S>() == 3)
		update(S(), strain, sigma, p, response.dissipation);
	else
		updateWithFreeNormals<S>(C, update, strain, sigma, p, response, flat);
}
/* The same of an update of one point, without branches and calls. */
template <class S, class Update, int W, class T>
void updateInSolid(const Hooke& C, Update&& update, const Pack<W, T>* strain, Pack<W, T>* sigma, Pack<W, T>& p, Responses<W, T>& response)
{
	updateLanesInSolid<S>(
		C, [&](auto state, auto&&... points) { updatePoints<decltype(state)>([&](auto&&... point) { update(state, point...); }, points...); }, strain,
		sigma, p, response);
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
