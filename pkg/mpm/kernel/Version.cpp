// SPDX-License-Identifier: GPL-2.0-or-later
#include "Version.hpp"

namespace yade::mpm {

const char* version() { return MPM_VERSION; }

} // namespace yade::mpm
