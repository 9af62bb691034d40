// SPDX-License-Identifier: GPL-2.0-or-later
#include "InstructionSet.hpp"
#include <atomic>
#include <cstdlib>
#include <stdexcept>
#include <string>

namespace yade::mpm {

namespace {
	constexpr InstructionSet allSets[] = { InstructionSet::avx512, InstructionSet::avx2, InstructionSet::sse2 };

	InstructionSet choose()
	{
		if (const char* wanted = std::getenv("MPM_INSTRUCTIONS"); wanted && *wanted) {
			for (InstructionSet set : allSets)
				if (std::string(wanted) == name(set)) {
					if (isSupported(set)) return set;
					throw std::invalid_argument(std::string("MPM_INSTRUCTIONS: this processor has no ") + wanted + "; unset it");
				}
			throw std::invalid_argument(std::string("MPM_INSTRUCTIONS is '") + wanted + "': use sse2, avx2 or avx512, or unset it");
		}
		for (InstructionSet set : allSets)
			if (isSupported(set)) return set;
		return InstructionSet::sse2;
	}
	std::atomic<InstructionSet>& current()
	{
		static std::atomic<InstructionSet> set { choose() };
		return set;
	}
} // namespace

bool isSupported(InstructionSet set)
{
#ifdef MPM_HAS_INSTRUCTION_SETS
	const bool avx2 = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
	switch (set) {
		case InstructionSet::sse2: return true;
		case InstructionSet::avx2: return avx2;
		case InstructionSet::avx512:
			return avx2 && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl")
			       && __builtin_cpu_supports("avx512bw");
	}
#endif
	return set == InstructionSet::sse2;
}

InstructionSet instructionSet() { return current(); }

void useInstructionSet(InstructionSet set)
{
	if (!isSupported(set)) throw std::invalid_argument(std::string("this processor has no ") + name(set));
	current() = set;
}

const char* name(InstructionSet set)
{
	switch (set) {
		case InstructionSet::sse2: return "sse2";
		case InstructionSet::avx2: return "avx2";
		case InstructionSet::avx512: return "avx512";
	}
	return "";
}

} // namespace yade::mpm
