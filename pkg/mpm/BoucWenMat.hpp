// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "kernel/Law.hpp"
#include <pkg/common/ElastMat.hpp>

namespace yade {

class BoucWenMat : public FrictMat {
public:
	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS_CTOR(BoucWenMat, FrictMat, "Hysteretic (Bouc-Wen-type) elastoplastic material with von Mises' criterion and Prager's kinematic hardening, after Sofianos & Koumousis, COMPDYN 2017, eqs. 21-27 as corrected in doc/law.md. A smoothed Heaviside function (f/yieldStress)^n turns the tangent from elastic to plastic without a yield test. For MpmEngine; among grains it is a FrictMat.",
		((Real, yieldStress, NaN, , "Yield stress sigma_y in uniaxial tension, > 0 [Pa]. Mandatory."))
		((Real, n, 10, , "Sharpness of the knee, > 0 [-]: exponent of H1 = (f/sigma_y)^n, f von Mises' equivalent of stress - back stress. n -> infinity is classical plasticity. Whole numbers are faster."))
		((Real, beta, .5, , "Weight of the constant part of H2 = beta + gamma sign(a.D.strain rate) [-]; beta + gamma = 1 and gamma >= abs(beta)."))
		((Real, gamma, .5, , "Weight of the sign in H2 [-]. With beta = gamma = 1/2 unloading is elastic; a greater gamma makes it stiffer than elastic and shortens the stable time step."))
		((Real, tangentRatio, 0, , "Ratio alpha = E_t/E of the uniaxial hardening tangent to Young's modulus, in [0, 1) [-]: 5 % hardening is 0.05. The plastic modulus is alpha E/(1 - alpha)."))
		((Real, tolerance, 1e-4, , "Admitted error of a sub-step of the stress integration, over yieldStress, > 0 [-]."))
		,
		createIndex();
	);
	// clang-format on
	REGISTER_CLASS_INDEX(BoucWenMat, FrictMat);
};
REGISTER_SERIALIZABLE(BoucWenMat);

/* The kernel's form of a material of the scene. Throws, naming material, attribute, value and remedy, where the material
has no law or its parameters are not admissible. */
mpm::Law lawOf(const Material& material);

} // namespace yade
