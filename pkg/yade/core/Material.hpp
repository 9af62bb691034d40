// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <core/Declared.hpp>
#include <core/State.hpp>

namespace yade {

class Scene;

class Material : public Serializable, public Indexable {
	YADE_DECLARED_CLASS(Material)
public:
	YADE_DECLARED_SERIALIZE(Serializable, (id)(label)(density))

	Material() { createIndex(); }
	virtual shared_ptr<State> newAssocState() const;
	virtual bool              stateTypeOk(State* state) const;
	YADE_DECLARED_INDEX()
	YADE_DECLARED_INDEX_COUNTER()

public:
	static const shared_ptr<Material> byId(int id, Scene* scene = nullptr);
	static const shared_ptr<Material> byLabel(const std::string& label, Scene* scene = nullptr);

	int         id = -1;
	std::string label;
	Real        density = 1000;
};
YADE_LAYOUT_SIZE(Material, 80)
YADE_LAYOUT_OFFSET(Material, id, 32)
YADE_LAYOUT_OFFSET(Material, label, 40)
YADE_LAYOUT_OFFSET(Material, density, 72)

} // namespace yade
