// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <core/Engine.hpp>

namespace yade {

class PartialEngine : public Engine {
	YADE_DECLARED_CLASS(PartialEngine)
	YADE_DECLARED_SERIALIZE(Engine, (ids))

	PartialEngine() {}

	std::vector<int> ids;
};
YADE_LAYOUT_SIZE(PartialEngine, 128)
YADE_LAYOUT_OFFSET(PartialEngine, ids, 104)

} // namespace yade
