// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "AsWritten.hpp"
#include "kernel/laws/Law.hpp"
#include <pkg/common/ElastMat.hpp>

namespace yade {

class BoucWenMat : public FrictMat {
public:
	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS_CTOR_PY(BoucWenMat, FrictMat, "Hysteretic (Bouc-Wen-type) elastoplastic material with von Mises' criterion and Prager's kinematic hardening, after Sofianos & Koumousis, COMPDYN 2017, eqs. 21-27 as corrected in doc/law.md. A smoothed Heaviside function (f/yieldStress)^n turns the tangent from elastic to plastic without a yield test. For MpmEngine and mpm.drive; among grains it is a FrictMat. The attributes after tolerance are options, off by default and then free of cost.",
		((Real, yieldStress, NaN, , "Yield stress sigma_y in uniaxial tension, > 0 [Pa]. Mandatory."))
		((Real, n, 10, , "Sharpness of the knee, finite and > 0 [-]: exponent of H1 = (f/sigma_y)^n, f von Mises' equivalent of stress - back stress. For n -> infinity the law tends to J2Mat, like ln 2/n. Whole and half numbers are faster."))
		((Real, beta, .5, , "Weight of the constant part of H2 = beta + gamma sign(a.D.strain rate) [-], a the gradient of f and D elasticity; beta + gamma = 1 and gamma >= abs(beta)."))
		((Real, gamma, .5, , "Weight of the sign in H2 [-]. With beta = gamma = 1/2 unloading is elastic; a greater gamma makes it stiffer than elastic, up to 1 + gamma - beta times, and shortens the stable time step."))
		((Real, tangentRatio, 0, , "Ratio alpha = E_t/E of the uniaxial hardening tangent to Young's modulus, in [0, 1) [-]: 5 % hardening is 0.05. The plastic modulus is alpha E/(1 - alpha)."))
		((Real, tolerance, 1e-4, , "Bound of the error of the stress that the integration leaves after any path, over yieldStress, in [1e-13, 0.1] [-]."))
		((Real, isotropicModulus, 0, , "Linear isotropic hardening K >= 0 [Pa]: the yield stress is sigma_y + K p + Q (1 - exp(-b p)), p the accumulated plastic strain."))
		((Real, saturationStress, 0, , "Saturating isotropic hardening Q >= 0 [Pa] (Voce 1948)."))
		((Real, saturationRate, 0, , "Its rate b >= 0 [-]."))
		((Real, strengthDegradation, 0, , "Baber & Wen's d_nu >= 0 [-]: H1 is multiplied by 1 + d_nu e, e the plastic work a volume less what kinematic hardening stores, over sigma_y^2/E; f then ends below the yield stress."))
		((Real, stiffnessDegradation, 0, , "Baber & Wen's d_eta, 0 to 2 [-]: the stiffness is divided by 1 + d_eta e, where need be by less, so that dissipation is never negative."))
		((Real, pinching, 0, , "Greatest part of the loading stiffness lost to slip, in [0, 1) [-] (after Baber & Noori 1986): on loading 1 - H1 is multiplied by 1 - pinching (1 - exp(-pinchingRate e)) exp(-((f/sigma_y - pinchingLevel)/pinchingWidth)^2)."))
		((Real, pinchingRate, 1, , "Rate at which pinching grows with e, > 0 [-]."))
		((Real, pinchingLevel, 0, , "f/sigma_y about which pinching acts, in [0, 1) [-]."))
		((Real, pinchingWidth, .2, , "Width of that, over sigma_y, > 0 [-]."))
		((Real, reloading, 0, , "Plasticity-compatible reloading (Charalampakis & Koumousis, J. Sound Vib. 322 (2009) 954) [-]: 0 is off; an exponent r >= 1 scales H1 by ((f - f_0)/(f_rev - f_0))^r while f, fallen from f_rev to f_0, grows again; float('inf') reloads elastically up to f_rev and closes exactly the cycles that unload to no less than a quarter of it. A finite r leaves part of their drift."))
		((std::string, loadingRule, "normal", , "What H2 takes the sign of: 'normal', a.D.strain rate; 'paper', strain . stress rate as eq. 26 prints it, with the elastic stress rate, which breaks f <= sigma_y, is there for comparison only and goes with none of the options above."))
		,
		createIndex();
		,
		.def(AsWritten())
	);
	// clang-format on
	REGISTER_CLASS_INDEX(BoucWenMat, FrictMat);
};
REGISTER_SERIALIZABLE(BoucWenMat);

class J2Mat : public FrictMat {
public:
	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS_CTOR_PY(J2Mat, FrictMat, "Classical von Mises plasticity with linear kinematic and linear and saturating isotropic hardening, by return mapping (plane stress after Simo & Taylor, IJNME 22 (1986) 649): the limit n -> infinity of BoucWenMat. For MpmEngine and mpm.drive; among grains it is a FrictMat.",
		((Real, yieldStress, NaN, , "Yield stress sigma_y in uniaxial tension, > 0 [Pa]. Mandatory."))
		((Real, tangentRatio, 0, , "Ratio alpha = E_t/E of the uniaxial tangent of kinematic hardening to Young's modulus, in [0, 1) [-]. The plastic modulus is alpha E/(1 - alpha)."))
		((Real, isotropicModulus, 0, , "Linear isotropic hardening K >= 0 [Pa]: the yield stress is sigma_y + K p + Q (1 - exp(-b p)), p the accumulated plastic strain."))
		((Real, saturationStress, 0, , "Saturating isotropic hardening Q >= 0 [Pa] (Voce 1948)."))
		((Real, saturationRate, 0, , "Its rate b >= 0 [-]."))
		,
		createIndex();
		,
		.def(AsWritten())
	);
	// clang-format on
	REGISTER_CLASS_INDEX(J2Mat, FrictMat);
};
REGISTER_SERIALIZABLE(J2Mat);

class DruckerPragerMat : public FrictMat {
public:
	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS_CTOR_PY(DruckerPragerMat, FrictMat, "Perfectly plastic Drucker-Prager material through the compression corners of Mohr-Coulomb's pyramid, with dilatancy and an apex return. For MpmEngine and mpm.drive; among grains it is a FrictMat, whose frictionAngle is that of contacts and has nothing to do with internalFriction.",
		((Real, cohesion, 0, , "Cohesion c >= 0 [Pa]. Cohesion and internal friction must not both be 0, which is what both are unless given."))
		((Real, internalFriction, 0, , "Angle of internal friction phi, from 0 to below 1.57 [rad]."))
		((Real, dilatancy, 0, , "Angle of dilatancy psi, from 0 to internalFriction [rad]."))
		,
		createIndex();
		,
		.def(AsWritten())
	);
	// clang-format on
	REGISTER_CLASS_INDEX(DruckerPragerMat, FrictMat);
};
REGISTER_SERIALIZABLE(DruckerPragerMat);

/* The kernel's form of a material of the scene. Throws, naming material, attribute, value and remedy, where the material
has no law or its parameters are not admissible. */
mpm::Law lawOf(const Material& material);

} // namespace yade
