// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <core/Shape.hpp>

namespace yade {

class Sphere : public Shape {
	YADE_DECLARED_CLASS(Sphere)
	YADE_DECLARED_INDEX()
	YADE_DECLARED_SERIALIZE(Shape, (radius))

	Sphere();

	Real radius;
};
YADE_LAYOUT_SIZE(Sphere, 104)
YADE_LAYOUT_OFFSET(Sphere, color, 64)
YADE_LAYOUT_OFFSET(Sphere, wire, 88)
YADE_LAYOUT_OFFSET(Sphere, highlight, 89)
YADE_LAYOUT_OFFSET(Sphere, radius, 96)

} // namespace yade
