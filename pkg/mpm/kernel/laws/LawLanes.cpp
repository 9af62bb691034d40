// SPDX-License-Identifier: GPL-2.0-or-later
#include "LawLanes.hpp"
#include "../Kinematics.hpp"
#include "UpdateStress.hpp"

namespace yade::mpm {

namespace {
	/* Strain increments from G; F advances, and in large strain sigma and the tensors among the internal variables turn. */
	template <class S, bool largeStrain, int tensors> void advance(LawBlock<S>& block, Lanes (&strain)[S::N])
	{
		constexpr int dim2 = S::dim * S::dim, N = S::N;
		forLanes([&](int l) {
			double g[gradients<S>], f[dim2], s[N];
			for (int k = 0; k < gradients<S>; ++k)
				g[k] = block.G[k][l];
			for (int k = 0; k < dim2; ++k)
				f[k] = block.F[k][l];
			Increment<S> increment;
			if (largeStrain) {
				increment.large(g);
				for (int t = -1; t < tensors; ++t) {
					Lanes* tensor = t < 0 ? block.sigma : block.internal + t * N;
					for (int k = 0; k < N; ++k)
						s[k] = tensor[k][l];
					increment.rotate(s);
					for (int k = 0; k < N; ++k)
						tensor[k][l] = s[k];
				}
			} else
				increment.small(g);
			for (int k = 0; k < N; ++k)
				strain[k][l] = increment.strain[k];
			advanceDeformation<S::dim>(g, largeStrain, f);
			for (int k = 0; k < dim2; ++k)
				block.F[k][l] = f[k];
		});
	}
	/* Strain increments in the axes of the end of the step. */
	template <class S> void turnToEnd(const LawBlock<S>& block, Lanes (&strain)[S::N])
	{
		forLanes([&](int l) {
			double g[gradients<S>];
			for (int k = 0; k < gradients<S>; ++k)
				g[k] = block.G[k][l];
			Increment<S> increment;
			increment.large(g);
			increment.turnToEnd();
			for (int k = 0; k < S::N; ++k)
				strain[k][l] = increment.strain[k];
		});
	}
} // namespace

template <class S> void updateBlock(InstructionSet set, const Law& law, bool largeStrain, LawBlock<S>& block)
{
	run(set, [&] {
		Lanes strain[S::N];
		switch (largeStrain ? Internals::of(law).tensors : -1) {
			case -1: advance<S, false, 0>(block, strain); break;
			case 0: advance<S, true, 0>(block, strain); break;
			case 1: advance<S, true, 1>(block, strain); break;
			default: advance<S, true, 2>(block, strain);
		}
		if (largeStrain && block.turnToEnd) turnToEnd(block, strain);
		updateStressLanes<LawState<S>>(law, strain, block.sigma, block.internal, block.response, block.respond);
	});
}

template void updateBlock(InstructionSet, const Law&, bool, LawBlock<Uniaxial>&);
template void updateBlock(InstructionSet, const Law&, bool, LawBlock<PlaneStress>&);
template void updateBlock(InstructionSet, const Law&, bool, LawBlock<PlaneStrain>&);
template void updateBlock(InstructionSet, const Law&, bool, LawBlock<Axisymmetric>&);
template void updateBlock(InstructionSet, const Law&, bool, LawBlock<Solid>&);

} // namespace yade::mpm
