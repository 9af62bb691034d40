// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "Check.hpp"
#include <cmath>

namespace yade::mpm {

/* Plastic modulus H [Pa] of a uniaxial tangent ratio alpha = E_t/E: H = alpha E/(1 - alpha). */
inline double hardeningModulus(double young, double tangentRatio) { return tangentRatio * young / (1 - tangentRatio); }

/* Isotropic hardening, linear and saturating (Voce, J. Inst. Metals 74 (1948) 537), over the accumulated plastic strain p:
  radius(p) = sigma_y + K p + Q (1 - exp(-b p)),   slope(p) = K + Q b exp(-b p) */
struct IsotropicHardening {
	double modulus    = 0; // K [Pa]
	double saturation = 0; // Q [Pa]
	double rate       = 0; // b

	bool                 active() const { return modulus != 0 || saturation != 0; }
	bool                 operator==(const IsotropicHardening& o) const { return modulus == o.modulus && saturation == o.saturation && rate == o.rate; }
	template <class T> T radius(double yieldStress, const T& p) const
	{
		using std::expm1;
		return yieldStress + modulus * p + (saturation != 0 ? -saturation * expm1(-rate * p) : 0);
	}
	template <class T> T slope(const T& p) const
	{
		using std::exp;
		return modulus + (saturation != 0 ? saturation * rate * exp(-rate * p) : 0);
	}
	void check(Check& c) const
	{
		c.finiteNotNegative("isotropicModulus", modulus);
		c.finiteNotNegative("saturationStress", saturation);
		c.finiteNotNegative("saturationRate", rate);
	}
};

} // namespace yade::mpm
