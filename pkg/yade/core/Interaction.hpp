// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <core/Declared.hpp>

namespace yade {

class IGeom;
class IPhys;

class Interaction : public Serializable {
	YADE_DECLARED_CLASS(Interaction)

	::boost::python::dict pyDictCustom() const override;
	bool                  isReal() const { return bool(geom) && bool(phys); }
	const int&            getId1() const { return id1; }
	const int&            getId2() const { return id2; }

	bool isActive;

private:
	char functorCache[56] __attribute__((aligned(8)));

public:
	int               id1;
	int               id2;
	long              iterMadeReal;
	long              iterLastSeen;
	shared_ptr<IGeom> geom;
	shared_ptr<IPhys> phys;
	Vector3i          cellDist;
	int               linIx;
	long              iterBorn;

protected:
	Interaction();
};
YADE_LAYOUT_SIZE(Interaction, 168)
YADE_LAYOUT_OFFSET(Interaction, geom, 112)
YADE_LAYOUT_OFFSET(Interaction, phys, 128)
YADE_LAYOUT_OFFSET(Interaction, iterBorn, 160)

} // namespace yade
