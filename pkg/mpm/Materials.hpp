// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "AsWritten.hpp"
#include "kernel/laws/Law.hpp"
#include <pkg/common/ElastMat.hpp>

namespace yade {

class BoucWenMat : public FrictMat {
public:
	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS_CTOR_PY(BoucWenMat, FrictMat, "Hysteretic elastoplastic material of Bouc-Wen type with von Mises' criterion and Prager's kinematic hardening (Sofianos & Koumousis, COMPDYN 2017, eqs. 21-27, corrected in doc/law.md). A smoothed Heaviside function (f/yieldStress)^n turns the tangent from elastic to plastic without a yield test. Used by MpmEngine and mpm.drive; in contacts it is a FrictMat. The attributes after tolerance are options, off by default and then without cost.",
		((Real, yieldStress, NaN, , "Yield stress sigma_y in uniaxial tension, > 0 [Pa]. Mandatory."))
		((Real, n, 10, , "Sharpness of the knee, finite and > 0 [-]: exponent of H1 = (f/sigma_y)^n, with f von Mises' equivalent of stress - back stress. For n -> infinity the law tends to J2Mat, as ln 2/n. Whole and half numbers are faster."))
		((Real, beta, .5, , "Weight of the constant part of H2 = beta + gamma sign(a.D.strain rate) [-], with a the gradient of f and D the elasticity; beta + gamma = 1 and gamma >= abs(beta)."))
		((Real, gamma, .5, , "Weight of the sign in H2 [-]. With beta = gamma = 1/2 unloading is elastic. A larger gamma makes it stiffer than elastic, up to 1 + gamma - beta times, and shortens the stable time step."))
		((Real, tangentRatio, 0, , "Ratio alpha = E_t/E of the uniaxial hardening tangent to Young's modulus, in [0, 1) [-]: 5 % hardening is 0.05. The plastic modulus is alpha E/(1 - alpha)."))
		((Real, tolerance, 1e-4, , "Bound of the stress error that the integration leaves after any path, over yieldStress, in [1e-13, 0.1] [-]."))
		((Real, isotropicModulus, 0, , "Linear isotropic hardening K >= 0 [Pa]: the yield stress is sigma_y + K p + Q (1 - exp(-b p)), with p the accumulated plastic strain."))
		((Real, saturationStress, 0, , "Saturating isotropic hardening Q >= 0 [Pa] (Voce 1948)."))
		((Real, saturationRate, 0, , "Rate b >= 0 of the saturating isotropic hardening [-]."))
		((Real, strengthDegradation, 0, , "Baber & Wen's d_nu >= 0 [-]: H1 is multiplied by 1 + d_nu e, with e the measure of degradation (degradationMeasure). f then ends below the yield stress."))
		((Real, stiffnessDegradation, 0, , "Baber & Wen's d_eta, 0 to 2 [-]: the stiffness is divided by 1 + d_eta e; with degradationMeasure='plastic' by less where dissipation would be negative."))
		((std::string, degradationMeasure, "plastic", , "Measure e of degradation and pinching, over sigma_y^2/E. 'plastic': the plastic work per volume less the energy that kinematic hardening stores; e never falls. 'hysteretic': the work of stress - back stress on the whole strain, in uniaxial stress Baber & Noori's e = integral of z du (1986), for published parameters; elastic unloading takes a part of e back, and the dissipation may fall for a while."))
		((Real, pinching, 0, , "Largest part of the loading stiffness lost to slip, in [0, 1) [-] (after Baber & Noori 1986): on loading 1 - H1 is multiplied by 1 - pinching (1 - exp(-pinchingRate e)) exp(-((f/sigma_y - pinchingLevel)/pinchingWidth)^2)."))
		((Real, pinchingRate, 1, , "Growth rate of pinching with e, > 0 [-]."))
		((Real, pinchingLevel, 0, , "Value of f/sigma_y at which pinching is largest, in [0, 1) [-]."))
		((Real, pinchingWidth, .2, , "Width of the pinching range, over sigma_y, > 0 [-]."))
		((Real, reloading, 0, , "Plasticity-compatible reloading (Charalampakis & Koumousis, J. Sound Vib. 322 (2009) 954) [-]. 0 switches it off. An exponent r >= 1 scales H1 by ((f - f_0)/(f_rev - f_0))^r while f grows again after a fall from f_rev to f_0; a finite r leaves part of the drift. float('inf') reloads elastically up to f_rev and closes exactly the cycles that unload to no less than a quarter of it."))
		((std::string, loadingRule, "normal", , "Argument of the sign in H2: 'normal' is a.D.strain rate. 'paper' is strain . stress rate as printed in eq. 26, with the elastic stress rate; it breaks f <= sigma_y, serves only for comparison, and cannot be combined with the options above."))
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
	YADE_CLASS_BASE_DOC_ATTRS_CTOR_PY(J2Mat, FrictMat, "Classical von Mises plasticity with linear kinematic, and linear and saturating isotropic hardening, by return mapping (plane stress after Simo & Taylor, IJNME 22 (1986) 649). It is the limit n -> infinity of BoucWenMat. Used by MpmEngine and mpm.drive; in contacts it is a FrictMat.",
		((Real, yieldStress, NaN, , "Yield stress sigma_y in uniaxial tension, > 0 [Pa]. Mandatory."))
		((Real, tangentRatio, 0, , "Ratio alpha = E_t/E of the uniaxial tangent of kinematic hardening to Young's modulus, in [0, 1) [-]. The plastic modulus is alpha E/(1 - alpha)."))
		((Real, isotropicModulus, 0, , "Linear isotropic hardening K >= 0 [Pa]: the yield stress is sigma_y + K p + Q (1 - exp(-b p)), with p the accumulated plastic strain."))
		((Real, saturationStress, 0, , "Saturating isotropic hardening Q >= 0 [Pa] (Voce 1948)."))
		((Real, saturationRate, 0, , "Rate b >= 0 of the saturating isotropic hardening [-]."))
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
	YADE_CLASS_BASE_DOC_ATTRS_CTOR_PY(DruckerPragerMat, FrictMat, "Perfectly plastic Drucker-Prager material. Its cone has Mohr-Coulomb's strength only in the kind of state that match names; in plane strain choose match='planeStrain', because the default cone mobilises 43.9 degrees there if internalFriction is 30 degrees. With dilatancy and return to the apex. Used by MpmEngine and mpm.drive; in contacts it is a FrictMat, whose frictionAngle is that of contacts and independent of internalFriction.",
		((Real, cohesion, 0, , "Cohesion c >= 0 [Pa]. Cohesion and internalFriction must not both be 0, their defaults."))
		((Real, internalFriction, 0, , "Angle of internal friction phi, from 0 to below 1.57 [rad]."))
		((Real, dilatancy, 0, , "Angle of dilatancy psi, from 0 to internalFriction [rad]."))
		((std::string, match, "compression", , "State in which the cone has Mohr-Coulomb's strength: 'compression' or 'extension', the triaxial corners; 'planeStrain', the limit state of plane strain for the given dilatancy; 'inscribed', the cone inside the pyramid. Equations in kernel/laws/DruckerPrager.hpp."))
		,
		createIndex();
		,
		.def(AsWritten())
	);
	// clang-format on
	REGISTER_CLASS_INDEX(DruckerPragerMat, FrictMat);
};
REGISTER_SERIALIZABLE(DruckerPragerMat);

class MohrCoulombMat : public FrictMat {
public:
	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS_CTOR_PY(MohrCoulombMat, FrictMat, "Perfectly plastic Mohr-Coulomb material with dilatancy and tension cut-off. The yield surface (1 + sin phi) s1 - (1 - sin phi) s3 = 2 c cos phi of the principal stresses s1 >= s2 >= s3, tension positive, is exact in every analysis, on its edges and at its apex. Stress returns along the flow of the active planes, in closed form (doc/law.md). Used by MpmEngine and mpm.drive; in contacts it is a FrictMat, whose frictionAngle is that of contacts and independent of internalFriction. Source: de Souza Neto, Peric and Owen, Computational Methods for Plasticity (2008), chapter 8.",
		((Real, cohesion, 0, , "Cohesion c >= 0 [Pa]. Cohesion and internalFriction must not both be 0, their defaults."))
		((Real, internalFriction, 0, , "Angle of internal friction phi, from 0 to below 1.57 [rad]. 0 is Tresca's material."))
		((Real, dilatancy, 0, , "Angle of dilatancy psi, from 0 to internalFriction [rad]. The flow of a face is (1 + sin psi, 0, sin psi - 1) in principal strains."))
		((Real, tensionCutoff, std::numeric_limits<Real>::infinity(), , "Greatest principal stress, from 0 to the apex cohesion/tan(internalFriction) [Pa]. float('inf'), the default, is no cut-off: tension ends at the apex."))
		,
		createIndex();
		,
		.def(AsWritten())
	);
	// clang-format on
	REGISTER_CLASS_INDEX(MohrCoulombMat, FrictMat);
};
REGISTER_SERIALIZABLE(MohrCoulombMat);

/* The kernel's form of a material of the scene. Throws, naming material, attribute, value and remedy, where the material
has no law or its parameters are not admissible. */
mpm::Law lawOf(const Material& material);

} // namespace yade
