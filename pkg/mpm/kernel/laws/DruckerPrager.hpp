// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "Check.hpp"
#include "FreeNormal.hpp"
#include "Internals.hpp"

namespace yade::mpm {

/* Drucker & Prager's cone through the triaxial compression corners of Mohr-Coulomb's pyramid, perfectly plastic, tension
positive, q = von Mises' stress, s its deviator, P = tr sigma / 3:

  F = q + eta P - k <= 0,  eta = 6 sin(phi) / (3 - sin(phi)),  k = 6 c cos(phi) / (3 - sin(phi))
  eps_p' = p' (3/2 s/q + etaPsi/3 I),  etaPsi as eta, with the angle of dilatancy psi <= phi */
struct DruckerPrager : LawDefaults {
	double cohesion         = 0; // c [Pa]
	double internalFriction = 0; // phi [rad]
	double dilatancy        = 0; // psi [rad]

	static double slope(double angle) { return 6 * std::sin(angle) / (3 - std::sin(angle)); }
	double        strength() const { return 6 * cohesion * std::cos(internalFriction) / (3 - std::sin(internalFriction)); }

	static constexpr Internals maxInternals { 0, 1 }; // p, the accumulated equivalent deviatoric plastic strain
	static constexpr bool      findsFreeStrain = true;
	Internals                  internals() const { return maxInternals; }
	bool                       keepsVolume() const { return false; }
	bool                       hasTensionCutoff() const { return true; }
	void                       check(const Hooke&, Check& c) const
	{
		c.finiteNotNegative("cohesion", cohesion);
		c.require(internalFriction >= 0 && internalFriction < 1.57, "internalFriction", internalFriction, "give an angle from 0 to below 1.57 [rad]");
		c.require(internalFriction > 0 || cohesion > 0, "cohesion", cohesion,
			"give a positive cohesion [Pa] or internalFriction: without both there is no strength");
		c.require(dilatancy >= 0 && dilatancy <= internalFriction, "dilatancy", dilatancy,
			"give 0 to internalFriction [rad]: a material that dilates more creates energy");
	}

	/* Backward Euler at one point, in closed form: along the flow to the cone, or to its apex where that would pass it. All
	three normal stresses are components of S. */
	template <class S, class T> void returnToCone(const Hooke& C, const T* strain, T* sigma, T& p, T& dissipation) const
	{
		static_assert(normals<S>() == 3);
		using std::sqrt;
		T De[S::N];
		S::elastic(C, strain, De);
		for (int c = 0; c < S::N; ++c)
			sigma[c] += De[c];

		const double eta = slope(internalFriction), etaPsi = slope(dilatancy), k = strength(), bulk = C.lame + 2 * C.shear / 3;
		const T      q = sqrt(S::mises2(sigma)), P = (sigma[0] + sigma[1] + sigma[2]) / 3;
		const T      F = q + eta * P - k, along = F / (3 * C.shear + bulk * eta * etaPsi);

		// no branches, so that lanes can take both ways
		const bool flows = F > 0, apex = flows & !(q > 3 * C.shear * along);
		const T    dp    = flows ? apex ? q / (3 * C.shear) : along : T(0);
		const T    dP    = apex ? P - k / eta : bulk * etaPsi * dp;
		const T    scale = apex ? T(0) : 1 - 3 * C.shear * dp / (flows ? q : T(1));
		for (int c = 0; c < S::N; ++c)
			sigma[c] = flows ? scale * (sigma[c] - (c < 3 ? P : T(0))) + (c < 3 ? P - dP : T(0)) : sigma[c];
		p += dp;
		dissipation += scale * q * dp + (P - dP) * dP / bulk;
	}
	template <class S, int W, class T>
	void update(const Hooke& C, const Reals<W, T>* strain, Reals<W, T>* sigma, Reals<W, T>* internal, Responses<W, T>& response) const
	{
		updateInSolid<S>(
			C, [&](auto state, auto&&... point) { returnToCone<decltype(state)>(C, point...); }, strain, sigma, internal[0], response);
	}
	template <class S> void tangent(const Hooke& C, const double* strain, const double* sigma, const double* internal, double* D) const
	{
		differentiateInSolid<S>(*this, C, strain, sigma, internal, D);
	}
};

} // namespace yade::mpm
