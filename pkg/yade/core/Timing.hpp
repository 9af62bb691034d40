// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <Layout.hpp>
#include <ctime>
#include <string>
#include <vector>

namespace yade {

struct TimingInfo {
	using delta = unsigned long long; // nanoseconds

	long        nExec = 0;
	delta       nsec  = 0;
	static bool enabled; // O.timingEnabled

	static delta now()
	{
		timespec t;
		clock_gettime(CLOCK_MONOTONIC, &t);
		return delta(t.tv_sec) * 1000000000 + delta(t.tv_nsec);
	}
};

/* What the parts of an engine take, as yade.timing shows it: start(), then after each part a checkpoint, always in the same order. The library
exports only checkpoint(), from libraries that a plugin need not have, so it stands here: if timing is enabled it adds the time since the
last one to the next entry, which it makes with this label if there is none. */
class TimingDeltas {
public:
	void start()
	{
		if (TimingInfo::enabled) next = 0, last = TimingInfo::now();
	}
	void checkpoint(const std::string& label)
	{
		if (!TimingInfo::enabled) return;
		if (data.size() <= next) data.resize(next + 1), labels.resize(next + 1), labels[next] = label;
		const TimingInfo::delta now = TimingInfo::now();
		data[next].nExec += 1, data[next].nsec += now - last;
		last = now, ++next;
	}

	TimingInfo::delta        last = 0;
	std::size_t              next = 0;
	std::vector<TimingInfo>  data;
	std::vector<std::string> labels;
};
YADE_LAYOUT_SIZE(TimingInfo, 16)
YADE_LAYOUT_SIZE(TimingDeltas, 64)
YADE_LAYOUT_OFFSET(TimingDeltas, next, 8)
YADE_LAYOUT_OFFSET(TimingDeltas, data, 16)
YADE_LAYOUT_OFFSET(TimingDeltas, labels, 40)

} // namespace yade
