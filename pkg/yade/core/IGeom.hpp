// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <core/Declared.hpp>

namespace yade {

class IGeom : public Serializable, public Indexable {
	YADE_DECLARED_CLASS(IGeom)
	YADE_DECLARED_INDEX()
	YADE_DECLARED_INDEX_COUNTER()
protected:
	IGeom();
};
YADE_LAYOUT_SIZE(IGeom, 32)

} // namespace yade
