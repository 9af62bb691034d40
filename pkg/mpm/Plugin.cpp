// SPDX-License-Identifier: GPL-2.0-or-later
#include "Materials.hpp"
#include "MpmEngine.hpp"
#include "MpmPoints.hpp"
#include "MpmState.hpp"
#include "MpmTraction.hpp"
#include "MpmVtkRecorder.hpp"
#include "MpmWall.hpp"
#ifdef YADE_PLUGIN_BUILT_FOR // not where YADE's own build compiles this folder
#	include <PluginLoad.hpp>
#endif

namespace yade {
YADE_PLUGIN((MpmPoints)(MpmState)(BoucWenMat)(J2Mat)(DruckerPragerMat)(MohrCoulombMat)(MpmWall)(MpmTraction)(MpmEngine)(MpmVtkRecorder));
} // namespace yade
