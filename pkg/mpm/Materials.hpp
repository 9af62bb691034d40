// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "kernel/Law.hpp"
#include <pkg/common/ElastMat.hpp>

namespace yade {

class BoucWenMat : public FrictMat {
public:
	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS_CTOR(BoucWenMat, FrictMat, "Hysteretic (Bouc-Wen-type) elastoplastic material with von Mises' criterion and Prager's kinematic hardening, after Sofianos & Koumousis, COMPDYN 2017, eqs. 21-27 as corrected in doc/law.md. A smoothed Heaviside function (f/yieldStress)^n turns the tangent from elastic to plastic without a yield test. For MpmEngine; among grains it is a FrictMat. The attributes after tolerance are options, off by default and then free of cost.",
		((Real, yieldStress, NaN, , "Yield stress sigma_y in uniaxial tension, > 0 [Pa]. Mandatory."))
		((Real, n, 10, , "Sharpness of the knee, > 0 [-]: exponent of H1 = (f/sigma_y)^n, f von Mises' equivalent of stress - back stress. n -> infinity is classical plasticity. Whole and half numbers are faster."))
		((Real, beta, .5, , "Weight of the constant part of H2 = beta + gamma sign(a.D.strain rate) [-]; beta + gamma = 1 and gamma >= abs(beta)."))
		((Real, gamma, .5, , "Weight of the sign in H2 [-]. With beta = gamma = 1/2 unloading is elastic; a greater gamma makes it stiffer than elastic and shortens the stable time step."))
		((Real, tangentRatio, 0, , "Ratio alpha = E_t/E of the uniaxial hardening tangent to Young's modulus, in [0, 1) [-]: 5 % hardening is 0.05. The plastic modulus is alpha E/(1 - alpha)."))
		((Real, tolerance, 1e-4, , "Bound of the stress error of the integration over a path, over yieldStress, in [1e-13, 0.1] [-]."))
		((Real, isotropicModulus, 0, , "Linear isotropic hardening K >= 0 [Pa]: the yield stress is sigma_y + K p + Q (1 - exp(-b p)), p the accumulated plastic strain."))
		((Real, saturationStress, 0, , "Saturating isotropic hardening Q >= 0 [Pa] (Voce 1948)."))
		((Real, saturationRate, 0, , "Its rate b >= 0 [-]."))
		((Real, strengthDegradation, 0, , "Baber & Wen's d_nu >= 0 [-]: H1 grows by 1 + d_nu e, e the dissipated energy a volume over sigma_y^2/E."))
		((Real, stiffnessDegradation, 0, , "Baber & Wen's d_eta, 0 to 2 [-]: the stiffness shrinks by 1 + d_eta e, as far as dissipation stays positive."))
		((Real, pinching, 0, , "Greatest part of the loading stiffness lost to slip, in [0, 1) [-] (after Baber & Noori 1986)."))
		((Real, pinchingRate, 1, , "Rate of growth of pinching with e, > 0 [-]."))
		((Real, pinchingLevel, 0, , "f/sigma_y about which pinching acts, in [0, 1) [-]."))
		((Real, pinchingWidth, .2, , "Width of that over sigma_y, > 0 [-]."))
		((Real, reloading, 0, , "Plasticity-compatible reloading (Charalampakis & Koumousis, J. Sound Vib. 322 (2009) 954) [-]: 0 is off; an exponent r >= 1 scales H1 by ((f - f_min)/(f_rev - f_min))^r while reloading below the last reversal f_rev; float('inf') reloads elastically up to it and closes small cycles exactly."))
		((std::string, loadingRule, "normal", , "What H2 takes the sign of: 'normal', a.D.strain rate; 'paper', strain . stress rate as eq. 26 prints it, which breaks f <= sigma_y and is there for comparison only."))
		,
		createIndex();
	);
	// clang-format on
	REGISTER_CLASS_INDEX(BoucWenMat, FrictMat);
};
REGISTER_SERIALIZABLE(BoucWenMat);

class J2Mat : public FrictMat {
public:
	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS_CTOR(J2Mat, FrictMat, "Classical von Mises plasticity with linear kinematic and isotropic hardening by return mapping (plane stress after Simo & Taylor, IJNME 22 (1986) 649): the limit n -> infinity of BoucWenMat. For MpmEngine; among grains it is a FrictMat.",
		((Real, yieldStress, NaN, , "Yield stress sigma_y in uniaxial tension, > 0 [Pa]. Mandatory."))
		((Real, tangentRatio, 0, , "Ratio E_t/E of the uniaxial tangent of kinematic hardening to Young's modulus, in [0, 1) [-]."))
		((Real, isotropicModulus, 0, , "Linear isotropic hardening K >= 0 [Pa]: the yield stress is sigma_y + K p + Q (1 - exp(-b p)), p the accumulated plastic strain."))
		((Real, saturationStress, 0, , "Saturating isotropic hardening Q >= 0 [Pa] (Voce 1948)."))
		((Real, saturationRate, 0, , "Its rate b >= 0 [-]."))
		,
		createIndex();
	);
	// clang-format on
	REGISTER_CLASS_INDEX(J2Mat, FrictMat);
};
REGISTER_SERIALIZABLE(J2Mat);

class DruckerPragerMat : public FrictMat {
public:
	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS_CTOR(DruckerPragerMat, FrictMat, "Perfectly plastic Drucker-Prager material through the compression corners of Mohr-Coulomb's pyramid, with dilatancy and an apex return. For MpmEngine; among grains it is a FrictMat, whose frictionAngle is that of contacts and has nothing to do with internalFriction.",
		((Real, cohesion, 0, , "Cohesion c >= 0 [Pa]."))
		((Real, internalFriction, 0, , "Angle of internal friction phi, from 0 to below pi/2 [rad]. Cohesion and internal friction must not both be 0."))
		((Real, dilatancy, 0, , "Angle of dilatancy psi, from 0 to internalFriction [rad]."))
		,
		createIndex();
	);
	// clang-format on
	REGISTER_CLASS_INDEX(DruckerPragerMat, FrictMat);
};
REGISTER_SERIALIZABLE(DruckerPragerMat);

/* The kernel's form of a material of the scene. Throws, naming material, attribute, value and remedy, where the material
has no law or its parameters are not admissible. */
mpm::Law lawOf(const Material& material);

} // namespace yade
