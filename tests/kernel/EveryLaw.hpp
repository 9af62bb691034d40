// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "LawPoint.hpp"
#include <limits>

namespace yade::mpm {

/* Every law and option, for tests that all of them must pass. */
struct NamedLaw {
	const char* name;
	Law         law;
};

/* The hysteretic law with options. */
inline Law boucWenWith(double n, const std::function<void(BoucWen&)>& options)
{
	Law law = boucWenLaw(n, .05, 1e-4);
	options(as<BoucWen>(law));
	return law;
}
inline std::vector<NamedLaw> everyLaw()
{
	const IsotropicHardening linear { .02 * youngModulus, 0, 0 }, voce { .01 * youngModulus, .5 * yieldStress, .3 / yieldStrain };
	constexpr double         infinity = std::numeric_limits<double>::infinity();

	Law elastic   = j2Law(0);
	elastic.model = Elastic();
	Law hardens = j2Law(.05), saturates = j2Law(.05);
	as<J2>(hardens).isotropic = linear, as<J2>(saturates).isotropic = voce;
	Law soil                                 = elastic;
	soil.model                               = DruckerPrager();
	as<DruckerPrager>(soil).cohesion         = .3 * yieldStress;
	as<DruckerPrager>(soil).internalFriction = .5, as<DruckerPrager>(soil).dilatancy = .2;
	Law smooth                                 = soil; // no apex, no dilatancy
	as<DruckerPrager>(smooth).internalFriction = as<DruckerPrager>(smooth).dilatancy = 0;

	Law corners                               = elastic; // with every plane, edge and corner
	corners.model                             = MohrCoulomb();
	as<MohrCoulomb>(corners).cohesion         = .3 * yieldStress;
	as<MohrCoulomb>(corners).internalFriction = .5, as<MohrCoulomb>(corners).dilatancy = .2;
	Law opening = corners, tresca = corners, brittle = corners;
	as<MohrCoulomb>(opening).tensionCutoff   = .2 * yieldStress;
	as<MohrCoulomb>(brittle).tensionCutoff   = 0;
	as<MohrCoulomb>(tresca).internalFriction = as<MohrCoulomb>(tresca).dilatancy = 0;

	return {
		{ "elastic", elastic },
		{ "J2", j2Law(0) },
		{ "J2, kinematic hardening", j2Law(.05) },
		{ "J2, isotropic hardening", hardens },
		{ "J2, saturation", saturates },
		{ "Drucker-Prager", soil },
		{ "Drucker-Prager without friction", smooth },
		{ "Mohr-Coulomb", corners },
		{ "Mohr-Coulomb with tension cut-off", opening },
		{ "Mohr-Coulomb without tension", brittle },
		{ "Mohr-Coulomb without friction", tresca },
		{ "n = 0.6", boucWenLaw(.6, .05, 1e-4) },
		{ "n = 2", boucWenLaw(2, 0, 1e-4) },
		{ "n = 2.5", boucWenLaw(2.5, .05, 1e-4) },
		{ "n = 2.3, by pow", boucWenLaw(2.3, .05, 1e-4) },
		{ "n = 200", boucWenLaw(200, .05, 1e-4) },
		{ "gamma > beta", boucWenWith(2, [](auto& p) { p.beta = .1, p.gamma = .9; }) },
		{ "isotropic hardening", boucWenWith(4, [=](auto& p) { p.isotropic             = linear; }) },
		{ "saturation", boucWenWith(4, [=](auto& p) { p.isotropic                      = voce; }) },
		{ "strength degradation", boucWenWith(2, [](auto& p) { p.strengthDegradation   = .1; }) },
		{ "stiffness degradation", boucWenWith(2, [](auto& p) { p.stiffnessDegradation = .3; }) },
		{ "pinching", boucWenWith(2, [](auto& p) { p.pinching = .7, p.pinchingLevel = .3; }) },
		{ "reloading 2", boucWenWith(2, [](auto& p) { p.reloading         = 2; }) },
		{ "elastic reloading", boucWenWith(10, [=](auto& p) { p.reloading = infinity; }) },
		{ "all options", boucWenWith(3,
					 [=](auto& p) {
						 p.isotropic = voce, p.strengthDegradation = .1, p.stiffnessDegradation = .3, p.pinching = .7,
						 p.reloading = infinity;
					 }) },
		{ "hysteretic measure", boucWenWith(2,
						[](auto& p) {
							p.strengthDegradation = .1, p.stiffnessDegradation = .3,
							p.degradationMeasure = BoucWen::DegradationMeasure::hysteretic;
						}) },
		{ "the paper's rule", boucWenWith(2, [](auto& p) { p.loadingRule = BoucWen::LoadingRule::paper; }) },
	};
}

} // namespace yade::mpm
