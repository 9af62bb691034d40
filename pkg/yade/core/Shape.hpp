// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <core/Declared.hpp>

namespace yade {

class BoundFunctor;
class InternalForceFunctor;

class Shape : public Serializable, public Indexable {
	YADE_DECLARED_CLASS(Shape)
#if YADE_DECLARED_VERSION >= 202601
	virtual Real getVolume();
#endif
	YADE_DECLARED_INDEX()
	YADE_DECLARED_INDEX_COUNTER()
public:
	YADE_DECLARED_SERIALIZE(Serializable, (color)(wire)(highlight))

	shared_ptr<BoundFunctor>         boundFunctor;
	shared_ptr<InternalForceFunctor> internalforcefunctor;
	Vector3r                         color;
	bool                             wire;
	bool                             highlight;

protected:
	/* The library makes shapes: through ClassFactory, or one of the derived classes' constructors. */
	Shape();
};
YADE_LAYOUT_SIZE(Shape, 96)

} // namespace yade
