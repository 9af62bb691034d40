// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "../Reals.hpp"

namespace yade::mpm {

/* What an update tells of a step beside the new stress, for those who ask. */
struct Response {
	double dissipation = 0; // energy turned into heat a volume [J/m3], >= 0; what isotropic hardening would store counts as heat
	double freeStrain  = 0; // strain increment of each stress-free normal component that the stress state leaves out
};
template <int W> struct Responses {
	Reals<W> dissipation {}, freeStrain {};
};

} // namespace yade::mpm
