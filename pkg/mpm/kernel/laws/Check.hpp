// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <string>

namespace yade::mpm {

/* Collects the first fault among a law's parameters, as "attribute = value: remedy". Write every condition so that NaN fails it. */
struct Check {
	std::string message;

	void require(bool good, const char* attribute, double value, const char* remedy);
	void require(bool good, const char* attribute, const char* value, const char* remedy);
	/* A finite number, 0 or more. */
	void finiteNotNegative(const char* attribute, double value);
	/* A yield stress that the rounding of stresses does not hide. */
	void yieldStress(double stress, double young);
	/* A plastic modulus [Pa]. */
	void hardeningModulus(double modulus);
};

} // namespace yade::mpm
