// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

namespace yade::mpm {

/* Instruction sets that the solver's passes over the points are compiled for. The best that the processor has is used;
the environment variable MPM_INSTRUCTIONS (sse2, avx2 or avx512) or useInstructionSet() choose another one for the solvers
made afterwards. Results differ between instruction sets by rounding, since AVX2 and AVX-512 contract a*b + c to one
operation and sum in another order; they never differ between numbers of threads. MPM_BASELINE, defined when compiling,
leaves out all but the first: instrumented builds compile several times as fast. */
enum class InstructionSet { sse2, avx2, avx512 };

InstructionSet instructionSet();
bool           isSupported(InstructionSet set);
/* Throws std::invalid_argument where the processor lacks it. */
void        useInstructionSet(InstructionSet set);
const char* name(InstructionSet set);

#if defined(__x86_64__) && defined(__GNUC__) && !defined(MPM_BASELINE)
#	define MPM_HAS_INSTRUCTION_SETS
#	define MPM_TARGET(features) __attribute__((noinline, flatten, target(features)))
#else
#	define MPM_TARGET(features)
#endif

namespace detail {
	/* All that work() calls is inlined here, for this instruction set, but for functions marked noinline. What is left
	outside, inline functions of any library included, is for the least one: the linker has one kind of each to choose from. */
	template <class Work> MPM_TARGET("sse2") void runSse2(const Work& work) { work(); }
	template <class Work> MPM_TARGET("avx2,fma") void runAvx2(const Work& work) { work(); }
	template <class Work> MPM_TARGET("avx2,fma,avx512f,avx512dq,avx512vl,avx512bw") void runAvx512(const Work& work) { work(); }
} // namespace detail

/* work(), compiled once for each instruction set. */
template <class Work> void run(InstructionSet set, const Work& work)
{
	switch (set) {
		case InstructionSet::sse2: return detail::runSse2(work);
		case InstructionSet::avx2: return detail::runAvx2(work);
		case InstructionSet::avx512: return detail::runAvx512(work);
	}
}

} // namespace yade::mpm
