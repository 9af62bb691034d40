// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <core/Declared.hpp>

namespace yade {

class Bound : public Serializable, public Indexable {
	YADE_DECLARED_CLASS(Bound)
	YADE_DECLARED_INDEX()
	YADE_DECLARED_INDEX_COUNTER()
public:
	int      lastUpdateIter;
	Vector3r refPos;
	Real     sweepLength;
	Vector3r color;
	Vector3r min;
	Vector3r max;

protected:
	Bound();
};
YADE_LAYOUT_SIZE(Bound, 144)

} // namespace yade
