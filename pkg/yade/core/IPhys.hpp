// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <core/Declared.hpp>

namespace yade {

class IPhys : public Serializable, public Indexable {
	YADE_DECLARED_CLASS(IPhys)
	YADE_DECLARED_INDEX()
	YADE_DECLARED_INDEX_COUNTER()
protected:
	IPhys();
};
YADE_LAYOUT_SIZE(IPhys, 32)

} // namespace yade
