// SPDX-License-Identifier: GPL-2.0-or-later
#include "Law.hpp"
#include "UpdateStress.hpp"
#include <sstream>

namespace yade::mpm {

namespace {
	/* Collects the first fault; every comparison is written so that NaN fails it. */
	struct Check {
		std::string message;

		template <class Value> void require(bool good, const char* attribute, Value value, const char* remedy)
		{
			if (good || !message.empty()) return;
			std::ostringstream text;
			text << attribute << " = " << value << ": " << remedy;
			message = text.str();
		}
		void finiteNotNegative(const char* attribute, double value)
		{
			require(value >= 0 && std::isfinite(value), attribute, value, "give a finite number, 0 or more");
		}
		void elastic(const Hooke& C)
		{
			require(C.young > 0 && std::isfinite(C.young), "young", C.young, "give a positive modulus [Pa]");
			require(C.poisson > -1 && C.poisson < .5, "poisson", C.poisson, "give a ratio above -1 and below 0.5");
		}
		void yield(double stress, double young)
		{
			require(stress > 0 && std::isfinite(stress), "yieldStress", stress, "give a positive stress [Pa]");
			require(stress >= 1e-12 * young, "yieldStress", stress, "give a stress [Pa] of at least 1e-12 young: less is lost in rounding");
		}
		void isotropic(const IsotropicHardening& law)
		{
			finiteNotNegative("isotropicModulus", law.modulus);
			finiteNotNegative("saturationStress", law.saturation);
			finiteNotNegative("saturationRate", law.rate);
		}
	};

	void check(const BoucWenParameters& law, Check& c)
	{
		c.yield(law.yieldStress, law.elastic.young);
		c.require(law.n > 0 && std::isfinite(law.n), "n", law.n, "give a positive exponent, 1 to 50 for metals");
		c.require(std::abs(law.beta + law.gamma - 1) <= 1e-12, "beta + gamma", law.beta + law.gamma,
			"the two must add to 1, or yieldStress is not the stress that is reached; 0.5 and 0.5 unload elastically");
		c.require(law.gamma >= std::abs(law.beta), "gamma", law.gamma, "give at least abs(beta), or a cycle can create energy");
		c.require(law.hardening >= 0 && std::isfinite(law.hardening), "hardening modulus", law.hardening, "give a tangentRatio from 0 to below 1");
		c.require(law.tolerance >= 1e-13 && law.tolerance <= .1, "tolerance", law.tolerance, "give 1e-13 to 0.1; 1e-4 suits most scenes");
		c.isotropic(law.isotropic);
		c.finiteNotNegative("strengthDegradation", law.strengthDegradation);
		c.require(law.stiffnessDegradation >= 0 && law.stiffnessDegradation <= 2, "stiffnessDegradation", law.stiffnessDegradation,
			"give 0 to 2: beyond, a bar at yield would release more energy than the flow dissipates");
		c.require(law.pinching >= 0 && law.pinching < 1, "pinching", law.pinching, "give 0 to below 1: at 1 loading finds no stiffness");
		c.require(law.pinchingRate > 0 && std::isfinite(law.pinchingRate), "pinchingRate", law.pinchingRate, "give a positive number");
		c.require(law.pinchingLevel >= 0 && law.pinchingLevel < 1, "pinchingLevel", law.pinchingLevel, "give 0 to below 1, a part of the yield stress");
		c.require(law.pinchingWidth > 0 && std::isfinite(law.pinchingWidth), "pinchingWidth", law.pinchingWidth,
			"give a positive part of the yield stress");
		c.require(law.reloading == 0 || law.reloading >= 1, "reloading", law.reloading,
			"give 0 (off), an exponent of 1 or more, or infinity for elastic reloading");
		c.require(!law.paper() || (!law.degrades() && !law.remembers() && !law.isotropic.active()), "loadingRule", "'paper'",
			"choose 'normal': 'paper' is there to compare with and does not go with hardening of the yield stress, degradation, pinching or "
			"reloading");
	}
	void check(const DruckerPragerParameters& law, Check& c)
	{
		c.finiteNotNegative("cohesion", law.cohesion);
		c.require(law.internalFriction >= 0 && law.internalFriction < 1.57, "internalFriction", law.internalFriction,
			"give an angle from 0 to below 1.57 [rad]");
		c.require(law.internalFriction > 0 || law.cohesion > 0, "cohesion", law.cohesion,
			"give a positive cohesion [Pa] or internalFriction: without both there is no strength");
		c.require(law.dilatancy >= 0 && law.dilatancy <= law.internalFriction, "dilatancy", law.dilatancy,
			"give 0 to internalFriction [rad]: a material that dilates more creates energy");
	}
} // namespace

std::string validate(const Law& law)
{
	Check c;
	switch (law.kind) {
		case Law::Kind::elastic: c.elastic(law.elastic); break;
		case Law::Kind::boucWen: c.elastic(law.boucWen.elastic), check(law.boucWen, c); break;
		case Law::Kind::j2:
			c.elastic(law.j2.elastic), c.yield(law.j2.yieldStress, law.j2.elastic.young), c.isotropic(law.j2.isotropic);
			c.require(law.j2.hardening >= 0 && std::isfinite(law.j2.hardening), "hardening modulus", law.j2.hardening,
				"give a tangentRatio from 0 to below 1");
			break;
		case Law::Kind::druckerPrager: c.elastic(law.druckerPrager.elastic), check(law.druckerPrager, c); break;
	}
	return c.message;
}

template <class S> void updateStress(const Law& law, const double* strain, double* sigma, double* internal, Response* response)
{
	constexpr int N       = S::N;
	const int     columns = Internals::of(law).columns(N);
	Reals<1>      e[N], s[N], state[Internals::most(N)];
	Responses<1>  told;
	for (int k = 0; k < N; ++k)
		e[k][0] = strain[k], s[k][0] = sigma[k];
	for (int k = 0; k < columns; ++k)
		state[k][0] = internal[k];
	updateStressLanes<S>(law, e, s, state, told, response != nullptr);
	for (int k = 0; k < N; ++k)
		sigma[k] = s[k][0];
	for (int k = 0; k < columns; ++k)
		internal[k] = state[k][0];
	if (response) response->dissipation += told.dissipation[0], response->freeStrain += told.freeStrain[0];
}

template void updateStress<Uniaxial>(const Law&, const double*, double*, double*, Response*);
template void updateStress<PlaneStress>(const Law&, const double*, double*, double*, Response*);
template void updateStress<PlaneStrain>(const Law&, const double*, double*, double*, Response*);
template void updateStress<Solid>(const Law&, const double*, double*, double*, Response*);
template void updateStress<FreeNormals<0>>(const Law&, const double*, double*, double*, Response*);
template void updateStress<FreeNormals<1>>(const Law&, const double*, double*, double*, Response*);
template void updateStress<FreeNormals<2>>(const Law&, const double*, double*, double*, Response*);

} // namespace yade::mpm
