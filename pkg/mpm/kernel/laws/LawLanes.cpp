// SPDX-License-Identifier: GPL-2.0-or-later
#include "LawLanes.hpp"
#include "StrainIncrement.hpp"
#include "UpdateStress.hpp"

namespace yade::mpm {

template <class S> void updateBlock(InstructionSet set, const Law& law, bool largeStrain, LawBlock<S>& block)
{
	run(set, [&] {
		constexpr int dim2 = S::dim * S::dim;
		Lanes         strain[S::N];
		strainIncrement<S, lanes>(law, largeStrain, block.G, block.F, block.sigma, block.internal, strain);
		forLanes([&](int l) {
			double g[dim2], f[dim2];
			for (int k = 0; k < dim2; ++k)
				g[k] = block.G[k][l], f[k] = block.F[k][l];
			advanceDeformation<S::dim>(g, largeStrain, f);
			for (int k = 0; k < dim2; ++k)
				block.F[k][l] = f[k];
		});
		updateStressLanes<LawState<S>>(law, strain, block.sigma, block.internal, block.response, block.respond);
	});
}

template void updateBlock(InstructionSet, const Law&, bool, LawBlock<Uniaxial>&);
template void updateBlock(InstructionSet, const Law&, bool, LawBlock<PlaneStress>&);
template void updateBlock(InstructionSet, const Law&, bool, LawBlock<PlaneStrain>&);
template void updateBlock(InstructionSet, const Law&, bool, LawBlock<Axisymmetric>&);
template void updateBlock(InstructionSet, const Law&, bool, LawBlock<Solid>&);

} // namespace yade::mpm
