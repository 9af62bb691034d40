// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <cmath>

namespace yade::mpm {

/* Isotropic hardening, linear and saturating (Voce, J. Inst. Metals 74 (1948) 537), over the accumulated plastic strain p:
  radius(p) = sigma_y + K p + Q (1 - exp(-b p)),   slope(p) = K + Q b exp(-b p) */
struct IsotropicHardening {
	double modulus    = 0; // K [Pa]
	double saturation = 0; // Q [Pa]
	double rate       = 0; // b

	bool   active() const { return modulus != 0 || saturation != 0; }
	double radius(double yieldStress, double p) const { return yieldStress + modulus * p + (saturation != 0 ? -saturation * std::expm1(-rate * p) : 0); }
	double slope(double p) const { return modulus + (saturation != 0 ? saturation * rate * std::exp(-rate * p) : 0); }
};

} // namespace yade::mpm
