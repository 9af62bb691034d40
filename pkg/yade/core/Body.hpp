// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <core/Bound.hpp>
#include <core/Interaction.hpp>
#include <core/Material.hpp>
#include <core/Shape.hpp>
#include <core/State.hpp>
#include <map>

namespace yade {

class Scene;

class Body : public Serializable {
	YADE_DECLARED_CLASS(Body)

	using id_t                    = int;
	using mask_t                  = int;
	using MapId2IntrT             = std::map<id_t, shared_ptr<Interaction>>;
	static constexpr id_t ID_NONE = -1;

	enum {
		FLAG_BOUNDED    = 1,
		FLAG_ASPHERICAL = 2,
	};

	Body();
	virtual void userForcedDisplacementRedrawHook();

	static const shared_ptr<Body>& byId(id_t id, Scene* scene = nullptr);

	id_t getId() const { return id; }
	bool isClump() const;
	bool isClumpMember() const;
	bool isStandalone() const;
	bool isDynamic() const;
	bool isBounded() const;
	bool isAspherical() const;
	void setDynamic(bool dynamic);
	void setBounded(bool bounded);
	void setAspherical(bool aspherical);
	bool maskOk(int mask) const;
	bool maskCompatible(int mask) const;

	id_t                 id;
	mask_t               groupMask;
	int                  flags;
	int                  subdomain;
	shared_ptr<Material> material;
	shared_ptr<State>    state;
	shared_ptr<Shape>    shape;
	shared_ptr<Bound>    bound;
	MapId2IntrT          intrs;
	id_t                 clumpId;
	long                 iterBorn;
	Real                 timeBorn;
};
YADE_LAYOUT_SIZE(Body, 176)
YADE_LAYOUT_OFFSET(Body, id, 24)
YADE_LAYOUT_OFFSET(Body, subdomain, 36)
YADE_LAYOUT_OFFSET(Body, material, 40)
YADE_LAYOUT_OFFSET(Body, bound, 88)
YADE_LAYOUT_OFFSET(Body, clumpId, 152)
YADE_LAYOUT_OFFSET(Body, timeBorn, 168)

} // namespace yade
