// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "Check.hpp"
#include "FreeNormal.hpp"
#include "Internals.hpp"

namespace yade::mpm {

/* Drucker & Prager's cone, perfectly plastic, tension positive, q = von Mises' stress, s its deviator, P = tr sigma / 3:

  F = q + eta P - k <= 0,   eps_p' = p' (3/2 s/q + etaPsi/3 I)

The cone meets Mohr-Coulomb's pyramid (c, phi; dilatancy psi <= phi) in one kind of state, which `match` chooses:

  compression  eta = 6 sin(phi)/(3 - sin(phi)),  k = 6 c cos(phi)/(3 - sin(phi)):  corners of triaxial compression
  extension    the same with 3 + sin(phi):  corners of triaxial extension
  inscribed    eta = 3 sqrt(3) tan(phi)/sqrt(9 + 12 tan^2(phi)),  k = eta c/tan(phi):  touches the faces from inside
  planeStrain  the limit state of plane strain, in which the plastic strain across the plane vanishes, for any psi:
	       etaPsi = 3 a sqrt(3), a = sin(psi)/sqrt(9 + 3 sin^2(psi)),
	       eta = sqrt(3) sin(phi)/r, k = sqrt(3) c cos(phi)/r, r = sqrt(1 - 3 a^2) + a sin(phi)

etaPsi is eta with psi in place of phi, for all but planeStrain. */
struct DruckerPrager : LawDefaults {
	double cohesion         = 0; // c [Pa]
	double internalFriction = 0; // phi [rad]
	double dilatancy        = 0; // psi [rad]
	enum class Match { compression, extension, planeStrain, inscribed };
	Match match = Match::compression;

	/* eta of compression. */
	static double slope(double angle) { return 6 * std::sin(angle) / (3 - std::sin(angle)); }
	/* eta over sin(phi), and k over c cos(phi). */
	double scale() const
	{
		const double sine = std::sin(internalFriction);
		switch (match) {
			case Match::extension: return 6 / (3 + sine);
			case Match::inscribed: return 3 * std::sqrt(3.) / std::sqrt(9 + 3 * sine * sine);
			case Match::planeStrain: {
				const double a = innerSlope();
				return std::sqrt(3.) / (std::sqrt(1 - 3 * a * a) + a * sine);
			}
			default: return 6 / (3 - sine);
		}
	}
	double frictionSlope() const { return match == Match::compression ? slope(internalFriction) : scale() * std::sin(internalFriction); }
	double dilatancySlope() const
	{
		switch (match) {
			case Match::extension: return 6 * std::sin(dilatancy) / (3 + std::sin(dilatancy));
			case Match::compression: return slope(dilatancy);
			default: return 3 * std::sqrt(3.) * innerSlope();
		}
	}
	double strength() const
	{
		if (match == Match::compression) return 6 * cohesion * std::cos(internalFriction) / (3 - std::sin(internalFriction));
		return scale() * cohesion * std::cos(internalFriction);
	}

	bool operator==(const DruckerPrager& o) const
	{
		return cohesion == o.cohesion && internalFriction == o.internalFriction && dilatancy == o.dilatancy && match == o.match;
	}

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

	/* a of psi. */
	double innerSlope() const { return std::sin(dilatancy) / std::sqrt(9 + 3 * std::sin(dilatancy) * std::sin(dilatancy)); }

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

		const double eta = frictionSlope(), etaPsi = dilatancySlope(), k = strength(), bulk = C.lame + 2 * C.shear / 3;
		const T      q = sqrt(S::mises2(sigma)), P = (sigma[0] + sigma[1] + sigma[2]) / 3;
		const T      F = q + eta * P - k, along = F / (3 * C.shear + bulk * eta * etaPsi);

		// no branches, so that lanes can take both ways
		const bool flows = F > 0, apex = flows & !(q > 3 * C.shear * along);
		const T    dp     = flows ? apex ? q / (3 * C.shear) : along : T(0);
		const T    dP     = apex ? P - k / eta : bulk * etaPsi * dp;
		const T    shrink = apex ? T(0) : 1 - 3 * C.shear * dp / (flows ? q : T(1));
		for (int c = 0; c < S::N; ++c)
			sigma[c] = flows ? shrink * (sigma[c] - (c < 3 ? P : T(0))) + (c < 3 ? P - dP : T(0)) : sigma[c];
		p += dp;
		dissipation += shrink * q * dp + (P - dP) * dP / bulk;
	}
	template <class S, int W, class T>
	void update(const Hooke& C, const Pack<W, T>* strain, Pack<W, T>* sigma, Pack<W, T>* internal, Responses<W, T>& response) const
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
