// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "Check.hpp"
#include "FreeNormal.hpp"
#include "Internals.hpp"
#include "PrincipalStress.hpp"
#include <algorithm>
#include <limits>
#include <sstream>

namespace yade::mpm {

/* Mohr-Coulomb's pyramid with a tension cut-off, perfectly plastic, tension positive, principal stresses s1 >= s2 >= s3:

  F = (1 + sin phi) s1 - (1 - sin phi) s3 - 2 c cos phi <= 0,   eps_p' = gamma' ((1 + sin psi), 0, -(1 - sin psi))
  s1 <= T,                                                      eps_p' = tau' (1, 0, 0)

and the same for every order of the axes: six faces, six edges, the apex c cot(phi); three planes of tension, with their edges
and the lines and corners in which they meet the faces. On edges and corners flow is the sum of the adjacent flows (Koiter). */
struct MohrCoulomb : LawDefaults {
	double cohesion         = 0;                                       // c [Pa]
	double internalFriction = 0;                                       // phi [rad]
	double dilatancy        = 0;                                       // psi [rad]
	double tensionCutoff    = std::numeric_limits<double>::infinity(); // T [Pa]; infinite: none, and tension ends at the apex

	bool operator==(const MohrCoulomb& o) const
	{
		return cohesion == o.cohesion && internalFriction == o.internalFriction && dilatancy == o.dilatancy && tensionCutoff == o.tensionCutoff;
	}

	static constexpr Internals maxInternals { 0, 1 }; // p, the accumulated equivalent deviatoric plastic strain
	static constexpr bool      findsFreeStrain = true;
	Internals                  internals() const { return maxInternals; }
	bool                       keepsVolume() const { return false; }
	bool                       hasTensionCutoff() const { return true; }
	bool                       sharesFreeStrain() const { return false; }

	/* Three equal principal stresses at the strength; infinite without friction. */
	double apex() const { return internalFriction > 0 ? cohesion / std::tan(internalFriction) : std::numeric_limits<double>::infinity(); }

	void check(const Hooke&, Check& c) const
	{
		c.finiteNotNegative("cohesion", cohesion);
		c.require(internalFriction >= 0 && internalFriction < 1.57, "internalFriction", internalFriction, "give an angle from 0 to below 1.57 [rad]");
		c.require(internalFriction > 0 || cohesion > 0, "cohesion", cohesion,
			"give a positive cohesion [Pa] or internalFriction: without both there is no strength");
		c.require(dilatancy >= 0 && dilatancy <= internalFriction, "dilatancy", dilatancy,
			"give 0 to internalFriction [rad]: a material that dilates more creates energy");
		c.require(tensionCutoff >= 0, "tensionCutoff", tensionCutoff, "give a stress of 0 or more [Pa], or inf for no cut-off");
		std::ostringstream remedy;
		remedy << "give at most cohesion/tan(internalFriction) = " << apex() << " [Pa], the apex, or inf for no cut-off";
		c.require(std::isinf(tensionCutoff) || tensionCutoff <= apex() * (1 + 1e-12), "tensionCutoff", tensionCutoff, remedy.str().c_str());
	}

	/* The tangent is an oblique projection of D where dilatancy < friction, and can be stiffer than D: x.D_ep x <= w x.D x with w = (1 +
	1/cos theta)/2, theta the angle in D between the normals of the active planes and the directions of flow. On an edge the angle is that between
	their parts orthogonal to the direction that both share; where tension is active as well it vanishes. */
	double stiffnessBound(const Hooke& C) const
	{
		const double f = std::sin(internalFriction), g = std::sin(dilatancy), l = C.lame / (2 * C.shear);
		double       bound = 1;
		for (const auto& [upper, lower] : { std::array<double, 2> { 1, 1 }, { 1, .5 }, { .5, 1 } }) { // face, and the two kinds of edges
			const auto product = [&, up = upper, low = lower](
						     double a, double b) { return up * (1 + a) * (1 + b) + low * (1 - a) * (1 - b) + 4 * l * a * b; };
			bound = std::max(bound, .5 + .5 * std::sqrt(product(f, f) * product(g, g)) / product(f, g));
		}
		return bound;
	}

	/* Backward Euler, exactly: the end of the step in terms of the principal trial stresses, of which the order stays, is one of a few
	affine functions. Return along the flow of one face moves the outer principal stresses towards the middle one; the first to meet it stays
	with it on an edge, and where all three meet the stress is at the apex. The linear complementarity problem of the planes has one solution
	(its matrix is a P-matrix for psi <= phi), so that it is enough to find one that violates no plane:
	  without tension, where s1 <= T;  else with planes of tension alone, where F <= 0;  else with both.
	All three normal stresses are components of S. */
	template <class S, int W, class T>
	void returnToPyramid(const Hooke& C, const Pack<W, T>* strain, Pack<W, T>* sigma, Pack<W, T>& p, Pack<W, T>& dissipation) const
	{
		static_assert(normals<S>() == 3);
		using std::sqrt;
		const double f = std::sin(internalFriction), g = std::sin(dilatancy), strength = 2 * cohesion * std::cos(internalFriction);
		const double limit = std::min(tensionCutoff, apex());
		const double scale = 3 * std::sqrt(3.) / std::sqrt(9 + 3 * f * f); // of the cone that touches the faces from inside
		forLanes<W>([&](int l) {
			T e[S::N], De[S::N];
			for (int k = 0; k < S::N; ++k)
				e[k] = strain[k][l];
			S::elastic(C, e, De);
			for (int k = 0; k < S::N; ++k)
				sigma[k][l] += De[k];
		});
		// most points are inside of the cone, and need no principal stresses
		if (!anyLane<W>([&](int l) {
			    T s[S::N];
			    for (int k = 0; k < S::N; ++k)
				    s[k] = sigma[k][l];
			    const T q = sqrt(S::mises2(s)), P = (s[0] + s[1] + s[2]) / 3;
			    return (q + scale * f * P > .5 * scale * strength) | (P + 2. / 3 * q > limit);
		    }))
			return;

		Pack<W, T> trial[3];
		principalStresses<S, W>(sigma, trial);
		const bool   hasCutoff = limit < apex(); // else the apex ends tension
		const double G2 = 2 * C.shear, lame = C.lame, up = 1 + g, down = 1 - g, volume = 2 * g;
		const double face      = G2 * ((1 + f) * up + (1 - f) * down) + 2 * lame * f * volume;
		const double rightEdge = face - G2 * (1 - f) * down / 2, leftEdge = face - G2 * (1 + f) * up / 2;
		const double apexStress = f > 0 ? strength / (2 * f) : std::numeric_limits<double>::max();
		const double lowest     = ((1 + f) * limit - strength) / (1 - f); // s3 on the face where s1 = T
		const double oneSided = lame / (lame + G2), twoSided = lame / (2 * lame + G2), threeSided = lame / (3 * lame + G2);

		forLanes<W>([&](int l) {
			const T x1 = trial[0][l], x2 = trial[1][l], x3 = trial[2][l], gap12 = x1 - x2, gap23 = x2 - x3;

			// without tension; right: the lower two are equal, left: the upper two
			const T    F     = (1 + f) * x1 - (1 - f) * x3 - strength;
			const bool flows = F > 0, right = down * gap12 > up * gap23;
			const T    onFace = F / face, meet = right ? gap23 / (G2 * down) : gap12 / (G2 * up);
			const bool edge  = onFace > meet;
			const T    upper = right ? x1 : .5 * (x1 + x2), lower = right ? .5 * (x2 + x3) : x3;
			const T    onEdge  = ((1 + f) * upper - (1 - f) * lower - strength) / (right ? rightEdge : leftEdge);
			const T    gapEdge = upper - lower - onEdge * (G2 * (right ? up + .5 * down : .5 * up + down));
			const bool atApex  = edge & !(gapEdge > 0) & (f > 0);
			T          s1      = edge ? upper - onEdge * (G2 * (right ? up : .5 * up) + lame * volume) : x1 - onFace * (G2 * up + lame * volume);
			T          d12     = edge ? ((right & !atApex) ? gapEdge : T(0)) : gap12 - onFace * (G2 * up);
			T          d23     = edge ? ((!right & !atApex) ? gapEdge : T(0)) : gap23 - onFace * (G2 * down);
			s1 = flows ? atApex ? T(apexStress) : s1 : x1, d12 = flows ? d12 : gap12, d23 = flows ? d23 : gap23;
			bool moves = flows, keepsLowerPair = false;

			if (hasCutoff) {
				const bool opens = s1 > limit;
				// tension alone: one, two or three principal stresses at T
				const T    over1 = x1 - limit, over2 = x2 - limit;
				const bool two   = x2 - oneSided * over1 > limit;
				const T    third = x3 - (two ? twoSided * (over1 + over2) : oneSided * over1);
				const T    t3    = third > limit ? T(limit) : third;
				const bool both  = opens & ((1 + f) * limit - (1 - f) * t3 > strength);
				// with the face: s1 = T and s3 on the face; s2 between them
				const T between = x2 - twoSided * (over1 + (x3 - lowest));
				const T s2      = between > limit ? T(limit) : between < lowest ? T(lowest) : between;
				s1              = opens ? T(limit) : s1;
				d12             = both ? limit - s2 : opens ? (two ? T(0) : limit - x2 + oneSided * over1) : d12;
				d23             = both ? s2 - lowest : opens ? (two ? limit - t3 : gap23) : d23;
				moves           = moves | opens;
				keepsLowerPair  = opens & !both & !two;
			}

			// plastic strain D^-1 (trial - s)
			const T s2 = s1 - d12, s3 = s2 - d23;
			const T change1 = x1 - s1, change2 = x2 - s2, change3 = x3 - s3, sum = change1 + change2 + change3, mean = sum / 3;
			const T v1 = change1 - mean, v2 = change2 - mean, v3 = change3 - mean, shared = threeSided * sum;
			const T work  = s1 * (change1 - shared) + s2 * (change2 - shared) + s3 * (change3 - shared);
			const T slide = sqrt((v1 * v1 + v2 * v2 + v3 * v3) * (2. / 3));
			p[l] += moves ? slide / G2 : T(0);
			dissipation[l] += moves ? work / G2 : T(0);

			// stress = s1 + r12 (X - x1) + r (X - x1) (X - x2), X the trial stress: Newton's interpolation of s1, s2, s3 at x1, x2, x3
			const bool apart12 = gap12 > 0, apart23 = gap23 > 0, apart = x1 > x3;
			const T    r12 = apart12 ? d12 / (apart12 ? gap12 : T(1)) : T(0);
			const T    r23 = apart23 ? d23 / (apart23 ? gap23 : T(1)) : T(keepsLowerPair ? 1. : 0.);
			const T    r   = apart ? (r12 - r23) / (apart ? x1 - x3 : T(1)) : T(0);
			T          s[S::N], a[S::N], b[S::N], ab[S::N];
			for (int k = 0; k < S::N; ++k)
				s[k] = sigma[k][l], a[k] = k < 3 ? s[k] - x1 : s[k], b[k] = k < 3 ? s[k] - x2 : s[k];
			productOfCommuting<S>(a, b, ab);
			for (int k = 0; k < S::N; ++k) {
				const T end = r12 * a[k] + r * ab[k] + (k < 3 ? s1 : T(0));
				sigma[k][l] = moves ? end : s[k];
			}
		});
	}
	template <class S, int W, class T>
	void update(const Hooke& C, const Pack<W, T>* strain, Pack<W, T>* sigma, Pack<W, T>* internal, Responses<W, T>& response) const
	{
		updateLanesInSolid<S>(
			C, [&](auto state, auto&&... points) { returnToPyramid<decltype(state)>(C, points...); }, strain, sigma, internal[0], response,
			tensionCutoff == 0);
	}
	template <class S> void tangent(const Hooke& C, const double* strain, const double* sigma, const double* internal, double* D) const
	{
		differentiateInSolid<S>(*this, C, strain, sigma, internal, D);
	}
};

} // namespace yade::mpm
