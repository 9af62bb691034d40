// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <core/GlobalEngine.hpp>

namespace yade {

class TimeStepper : public GlobalEngine {
	YADE_DECLARED_CLASS(TimeStepper)
	YADE_DECLARED_SERIALIZE(GlobalEngine, (active)(timeStepUpdateInterval))

	TimeStepper() {}
	bool         isActivated() override;
	void         action() override;
	virtual void computeTimeStep(Scene* scene);

	bool         active                 = true;
	unsigned int timeStepUpdateInterval = 1;
};
YADE_LAYOUT_SIZE(TimeStepper, 112)
YADE_LAYOUT_OFFSET(TimeStepper, active, 104)
YADE_LAYOUT_OFFSET(TimeStepper, timeStepUpdateInterval, 108)

} // namespace yade
