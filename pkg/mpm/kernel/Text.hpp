// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <cstdio>
#include <string>

namespace yade::mpm {

/* A number for a message, to six significant digits: 2.5e-07, where std::to_string gives 0.000000. */
inline std::string number(double x)
{
	char text[32];
	std::snprintf(text, sizeof text, "%.6g", x);
	return text;
}

} // namespace yade::mpm
