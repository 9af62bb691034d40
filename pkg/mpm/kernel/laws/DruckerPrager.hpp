// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "FreeNormal.hpp"

namespace yade::mpm {

/* Drucker & Prager's cone through the triaxial compression corners of Mohr-Coulomb's pyramid, perfectly plastic, tension
positive, q = von Mises' stress, s its deviator, P = tr sigma / 3:

  F = q + eta P - k <= 0,  eta = 6 sin(phi) / (3 - sin(phi)),  k = 6 c cos(phi) / (3 - sin(phi))
  eps_p' = p' (3/2 s/q + etaPsi/3 I),  etaPsi as eta, with the angle of dilatancy psi <= phi */
struct DruckerPragerParameters {
	Hooke  elastic;
	double cohesion         = 0; // c [Pa]
	double internalFriction = 0; // phi [rad]
	double dilatancy        = 0; // psi [rad]

	static double slope(double angle) { return 6 * std::sin(angle) / (3 - std::sin(angle)); }
	double        strength() const { return 6 * cohesion * std::cos(internalFriction) / (3 - std::sin(internalFriction)); }
};

/* Backward Euler, in closed form: along the flow to the cone, or to its apex where that would pass it. All three normal
stresses are components of S. p accumulates the equivalent deviatoric plastic strain. */
template <class S> void druckerPragerReturn(const DruckerPragerParameters& law, const double* strain, double* sigma, double& p, double& dissipation)
{
	static_assert(normals<S>() == 3);
	const Hooke& C = law.elastic;
	double       De[S::N];
	S::elastic(C, strain, De);
	for (int c = 0; c < S::N; ++c)
		sigma[c] += De[c];

	const double eta = law.slope(law.internalFriction), etaPsi = law.slope(law.dilatancy), k = law.strength();
	const double bulk = C.lame + 2 * C.shear / 3, q = std::sqrt(S::mises2(sigma)), P = (sigma[0] + sigma[1] + sigma[2]) / 3;
	const double F = q + eta * P - k, along = F / (3 * C.shear + bulk * eta * etaPsi);

	// no branches: lanes take both ways
	const bool   flows = F > 0, apex = flows & !(q > 3 * C.shear * along);
	const double dp    = flows ? apex ? q / (3 * C.shear) : along : 0;
	const double dP    = apex ? P - k / eta : bulk * etaPsi * dp;
	const double scale = apex ? 0 : 1 - 3 * C.shear * dp / (flows ? q : 1);
	for (int c = 0; c < S::N; ++c)
		sigma[c] = flows ? scale * (sigma[c] - (c < 3 ? P : 0)) + (c < 3 ? P - dP : 0) : sigma[c];
	p += dp;
	dissipation += scale * q * dp + (P - dP) * dP / bulk;
}

template <class S, int W>
void druckerPragerUpdate(const DruckerPragerParameters& law, const Reals<W>* strain, Reals<W>* sigma, Reals<W>& p, Responses<W>& response)
{
	if constexpr (normals<S>() == 3)
		updatePoints<S>([&](auto&&... point) { druckerPragerReturn<S>(law, point...); }, strain, sigma, p, response.dissipation);
	else
		updateWithFreeNormals<S>(
			law.elastic, [&](auto&&... point) { druckerPragerReturn<Solid>(law, point...); }, strain, sigma, p, response);
}

} // namespace yade::mpm
