// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "../InstructionSet.hpp"
#include "../Lanes.hpp"
#include "Law.hpp"

namespace yade::mpm {

/* The stress update of a block of points that share a law. F advances by G = dt grad v, and where strains are large sigma and the
internal tensors turn with the material, before the law. */
template <class S> struct LawBlock {
	Lanes            G[gradients<S>], F[S::dim * S::dim], sigma[S::N], internal[maxInternals(S::N)];
	bool             turnToEnd = false; // strain increments to the axes of the end of the step, Kinematics.hpp
	bool             respond   = false; // whether to compute
	Responses<lanes> response;
};
/* Compiled once for each instruction set, for the stress states that LawLanes.cpp lists. */
template <class S> void updateBlock(InstructionSet set, const Law& law, bool largeStrain, LawBlock<S>& block);

} // namespace yade::mpm
