// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "../Pack.hpp"

namespace yade::mpm {

/* Secondary outputs of a stress update, beside the new stress. */
struct Response {
	double dissipation = 0; // energy turned into heat a volume [J/m3], >= 0; energy that isotropic hardening would store counts as heat
	double freeStrain  = 0; // strain increment of each stress-free normal component that the stress state leaves out
};
template <int W, class T = double> struct Responses {
	Pack<W, T> dissipation {}, freeStrain {};
};

} // namespace yade::mpm
