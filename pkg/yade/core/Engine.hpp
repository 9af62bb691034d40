// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <core/Declared.hpp>
#include <core/Timing.hpp>

namespace yade {

class Scene;

class Engine : public Serializable {
	YADE_DECLARED_CLASS(Engine)
	YADE_DECLARED_SERIALIZE(Serializable, (dead)(ompThreads)(label))

	Engine();
	virtual bool isActivated();
	virtual void action();

	/* Set by the simulation loop before every step. */
	Scene*                   scene;
	TimingInfo               timingInfo;
	shared_ptr<TimingDeltas> timingDeltas;
	bool                     dead;
	int                      ompThreads;
	std::string              label;
};
YADE_LAYOUT_SIZE(Engine, 104)
YADE_LAYOUT_OFFSET(Engine, scene, 24)
YADE_LAYOUT_OFFSET(Engine, dead, 64)
YADE_LAYOUT_OFFSET(Engine, ompThreads, 68)
YADE_LAYOUT_OFFSET(Engine, label, 72)

} // namespace yade
