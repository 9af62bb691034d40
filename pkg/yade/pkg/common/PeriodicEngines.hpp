// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <chrono>
#include <core/GlobalEngine.hpp>

namespace yade {

class PeriodicEngine : public GlobalEngine {
	YADE_DECLARED_CLASS(PeriodicEngine)
	YADE_DECLARED_SERIALIZE(GlobalEngine, (virtPeriod)(realPeriod)(iterPeriod)(nDo)(initRun)(firstIterRun)(virtLast)(realLast)(iterLast)(nDone))

	/* Real time counts from the making of the engine. */
	PeriodicEngine()
	    : realLast(std::chrono::duration<Real>(std::chrono::system_clock::now().time_since_epoch()).count())
	{
	}
	bool isActivated() override;

	Real virtPeriod   = 0;
	Real realPeriod   = 0;
	long iterPeriod   = 0;
	long nDo          = -1;
	bool initRun      = false;
	long firstIterRun = 0;
	Real virtLast     = 0;
	Real realLast;
	long iterLast = 0;
	long nDone    = 0;
};
YADE_LAYOUT_SIZE(PeriodicEngine, 184)
YADE_LAYOUT_OFFSET(PeriodicEngine, virtPeriod, 104)
YADE_LAYOUT_OFFSET(PeriodicEngine, initRun, 136)
YADE_LAYOUT_OFFSET(PeriodicEngine, nDone, 176)

} // namespace yade
