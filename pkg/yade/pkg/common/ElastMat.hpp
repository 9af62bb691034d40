// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <core/Material.hpp>

namespace yade {

class ElastMat : public Material {
	YADE_DECLARED_CLASS(ElastMat)
	YADE_DECLARED_INDEX()
	YADE_DECLARED_SERIALIZE(Material, (young)(poisson))

	ElastMat() { createIndex(); }

	Real young   = 1e9;
	Real poisson = .25;
};
YADE_LAYOUT_SIZE(ElastMat, 96)
YADE_LAYOUT_OFFSET(ElastMat, young, 80)
YADE_LAYOUT_OFFSET(ElastMat, poisson, 88)

class FrictMat : public ElastMat {
	YADE_DECLARED_CLASS(FrictMat)
	YADE_DECLARED_INDEX()
	YADE_DECLARED_SERIALIZE(ElastMat, (frictionAngle))

	FrictMat();

	Real frictionAngle;
};
YADE_LAYOUT_SIZE(FrictMat, 104)
YADE_LAYOUT_OFFSET(FrictMat, frictionAngle, 96)

} // namespace yade
