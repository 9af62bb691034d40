// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

namespace yade::mpm {

/* Version of the project, "major.minor.patch": project(VERSION) of the CMakeLists.txt at the root. Saved scenes hold it. */
const char* version();

} // namespace yade::mpm
