// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <core/Engine.hpp>

namespace yade {

class GlobalEngine : public Engine {
	YADE_DECLARED_CLASS(GlobalEngine)
	YADE_DECLARED_SERIALIZE(Engine, )

	GlobalEngine() {}
};
YADE_LAYOUT_SIZE(GlobalEngine, 104)

} // namespace yade
