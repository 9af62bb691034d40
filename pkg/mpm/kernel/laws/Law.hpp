// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "BoucWen.hpp"
#include "DruckerPrager.hpp"
#include "J2.hpp"
#include <string>

namespace yade::mpm {

/* A material as the kernel sees it: which law, and the parameters of that law. */
struct Law {
	enum class Kind { elastic, boucWen, j2, druckerPrager };
	Kind                    kind    = Kind::elastic;
	double                  density = 0;
	double                  frictionAngle = 0; // of contacts between bodies of points [rad]
	Hooke                   elastic;
	BoucWenParameters       boucWen;
	J2Parameters            j2;
	DruckerPragerParameters druckerPrager;

	/* Factor on D that bounds the law's tangent; the stable time step shrinks with its root. */
	double stiffnessBound() const { return kind == Kind::boucWen ? boucWen.stiffnessBound() : 1; }
};

/* Whether tr eps = (1 - 2 nu)/E tr sigma always: flow keeps the volume, and the compliance stays. */
inline bool keepsVolume(const Law& law)
{
	return law.kind != Law::Kind::druckerPrager && !(law.kind == Law::Kind::boucWen && law.boucWen.stiffnessDegradation != 0);
}

/* Empty, or what is wrong with a law's parameters: attribute, value and remedy. */
std::string validate(const Law& law);

/* Internal variables of a point, columns of Points::internal: first tensors in the components of the stress state,
which turn with the material, then scalars. Dissipative laws keep the back stress as first tensor, where they have any,
and the accumulated plastic strain as first scalar. */
struct Internals {
	int tensors = 0, scalars = 0;

	static Internals of(const Law& law)
	{
		switch (law.kind) {
			case Law::Kind::elastic: break;
			case Law::Kind::boucWen: return { law.boucWen.tensors(), law.boucWen.scalars() };
			case Law::Kind::j2: return { 1, 1 };
			case Law::Kind::druckerPrager: return { 0, 1 };
		}
		return {};
	}
	int columns(int components) const { return tensors * components + scalars; }
	/* Of the laws that have most: two tensors and p; a tensor, p, energy and compliance, two stresses that are remembered. */
	static constexpr int most(int components) { return components + (components > 4 ? components + 1 : 5); }
};

/* sigma and the internal variables at the end of a step; sigma and all tensors have been turned with the material. Adds
to response, where given. Compiled for the stress states that Law.cpp lists. */
template <class S> void updateStress(const Law& law, const double* strain, double* sigma, double* internal, Response* response = nullptr);

namespace detail {
	/* Factor by which the elastic compliance has grown; internal(k) is the k-th internal variable. */
	template <class S, class Get> double complianceGrowth(const Law& law, Get&& internal)
	{
		if (law.kind != Law::Kind::boucWen || !law.boucWen.degrades()) return 1;
		return 1 + internal(law.boucWen.tensors() * S::N + 2);
	}
} // namespace detail

/* Energies a volume [J/m3] that a point holds and can give back. */
template <class S> double elasticEnergy(const Law& law, const double* sigma, const double* internal)
{
	return .5 * detail::complianceGrowth<S>(law, [&](int k) { return internal[k]; }) * complianceProduct<S>(law.elastic, sigma);
}
template <class S> double hardeningEnergy(const Law& law, const double* internal)
{
	const double H = law.kind == Law::Kind::boucWen ? law.boucWen.hardening : law.kind == Law::Kind::j2 ? law.j2.hardening : 0;
	return H > 0 ? S::mises2(internal) / (2 * H) : 0;
}

} // namespace yade::mpm
