// SPDX-License-Identifier: GPL-2.0-or-later
/* Laws in lanes: eight points on random paths of their own, in sub-steps and iterations of their own, are what each of them is
alone, to rounding, for every law and option, stress state, instruction set, small and large strain. */
#include "kernel/laws/LawLanes.hpp"
#include "EveryLaw.hpp"
#include "kernel/Kinematics.hpp"
#include <cstring>
#include <gtest/gtest.h>

using namespace yade::mpm;

namespace {

template <class S> void comparePaths(const Law& law, InstructionSet set, bool largeStrain, unsigned seed)
{
	constexpr int                          N = S::N, dim2 = S::dim * S::dim;
	const Internals                        layout  = Internals::of(law);
	const int                              columns = layout.columns(N);
	std::mt19937                           random(seed);
	std::uniform_real_distribution<double> unit(0, 1);
	std::normal_distribution<double>       normal;
	double                                 worst = 0, flow = 0;
	for (int path = 0; path < 3; ++path) {
		LawBlock<S> block {};
		block.respond = true;
		std::vector<LawPoint<S>> alone(lanes, LawPoint<S>(law));
		for (int l = 0; l < lanes; ++l)
			for (int k = 0; k < dim2; ++k)
				block.F[k][l] = k % (S::dim + 1) == 0;
		for (int i = 0; i < 6; ++i) {
			for (int l = 0; l < lanes; ++l) {
				double       G[dim2];
				const double size = l == 3 ? 0 : std::pow(10, -4 + 5 * unit(random)); // one lane stands still
				for (int k = 0; k < dim2; ++k)
					G[k] = block.G[k][l] = size * yieldStrain * normal(random) / S::dim;
				alone[std::size_t(l)].deform(largeStrain, G);
			}
			updateBlock(set, law, largeStrain, block);
			for (int l = 0; l < lanes; ++l) {
				const LawPoint<S>& point   = alone[std::size_t(l)];
				auto               compare = [&](double a, double b, double scale) { worst = std::max(worst, std::abs(a - b) / scale); };
				for (int k = 0; k < N; ++k)
					compare(block.sigma[k][l], point.sigma[k], yieldStress);
				for (int k = 0; k < columns; ++k) { // stresses, then p, and the rest over the yield strain, 1 or the yield stress
					const int    scalar = k - layout.tensors * N;
					const double scale  = std::max(scalar == 0 ? yieldStrain : 1e-3, std::abs(point.internal[std::size_t(k)]));
					compare(block.internal[k][l], point.internal[std::size_t(k)], scalar < 0 ? yieldStress : scale);
				}
				for (int k = 0; k < dim2; ++k)
					compare(block.F[k][l], point.F[std::size_t(k)], 1);
				compare(block.response.dissipation[l], point.response.dissipation, yieldStress * yieldStrain + point.response.dissipation);
				compare(block.response.freeStrain[l], point.response.freeStrain, yieldStrain);
				if (columns > 0) flow = std::max(flow, point.plasticStrain());
				ASSERT_TRUE(std::isfinite(block.sigma[0][l]));
			}
			// a short reloading is stiff, as n = r/(f_rev - f_0) would be, and sub-steps at the limit of stability amplify rounding
			const bool stiff = is<BoucWen>(law) && as<BoucWen>(law).remembers() && std::isfinite(as<BoucWen>(law).reloading);
			// at a sharp knee the last bit, which fused multiply-add rounds otherwise, can decide whether a sub-step is taken; either way the
			// error of the stress is below the law's tolerance
			const bool sharp = is<BoucWen>(law) && as<BoucWen>(law).n >= 100 && set != InstructionSet::sse2;
			ASSERT_LT(worst, sharp ? as<BoucWen>(law).tolerance : stiff ? 1e-6 : 1e-11) << "path " << path << ", increment " << i;
		}
	}
	if (columns > 0) {
		EXPECT_GT(flow, yieldStrain) << "nothing flows";
	}
	static double greatest = 0;
	if (worst > greatest) std::printf("greatest difference so far %.1e\n", greatest = worst);
}

template <class S> class LawLanes : public ::testing::Test {
};
using States = ::testing::Types<Uniaxial, PlaneStress, PlaneStrain, Solid>;
TYPED_TEST_SUITE(LawLanes, States);

TYPED_TEST(LawLanes, ArePointsAlone)
{
	for (const NamedLaw& named : everyLaw())
		for (InstructionSet set : { InstructionSet::sse2, InstructionSet::avx2, InstructionSet::avx512 }) {
			if (!isSupported(set)) continue;
			for (bool largeStrain : { false, true }) {
				SCOPED_TRACE(std::string(named.name) + ", " + name(set) + (largeStrain ? ", large strain" : ""));
				ASSERT_EQ(validate(named.law), "");
				comparePaths<TypeParam>(named.law, set, largeStrain, 17);
			}
		}
}

/* Two laws are equal only if every parameter is: a change of the last bit of any makes another law of it. */
TEST(LawTest, EveryParameterCounts)
{
	for (const NamedLaw& named : everyLaw()) {
		EXPECT_TRUE(named.law == Law(named.law)) << named.name;
		Law other   = named.law;
		other.model = is<J2>(other) ? Model(DruckerPrager()) : Model(J2());
		EXPECT_FALSE(other == named.law) << named.name;
		other         = named.law;
		other.density = std::nextafter(other.density, 1e300);
		EXPECT_FALSE(other == named.law) << named.name;
		for (double Hooke::*parameter : { &Hooke::young, &Hooke::poisson }) {
			other                    = named.law;
			other.elastic.*parameter = std::nextafter(other.elastic.*parameter, 1e300);
			EXPECT_FALSE(other == named.law) << named.name;
		}
		named.law.visit([&](const auto& model) {
			using M = std::decay_t<decltype(model)>;
			static_assert(std::is_trivially_copyable_v<M>);
			for (std::size_t at = 0; at + sizeof(double) <= sizeof(M); at += sizeof(double)) { // a number, or a choice in its lower half
				unsigned char bytes[sizeof(M)];
				std::memcpy(bytes, &model, sizeof(M));
				bytes[at] ^= 1;
				other = named.law;
				std::memcpy(static_cast<void*>(&as<M>(other)), bytes, sizeof(M));
				EXPECT_FALSE(other == named.law) << named.name << ", byte " << at;
			}
		});
	}
}

/* A lane strained by thousands of yield strains, or by more than can be followed, has a way of its own; the others do not notice. */
TYPED_TEST(LawLanes, AFarStrainLeavesTheOthersAlone)
{
	for (const Law& law : { boucWenLaw(10, .05, 1e-4), everyLaw().back().law })
		for (InstructionSet set : { InstructionSet::sse2, InstructionSet::avx2, InstructionSet::avx512 }) {
			if (!isSupported(set)) continue;
			LawBlock<TypeParam> near {}, far {};
			for (int step = 0; step < 3; ++step) {
				for (int l = 0; l < lanes; ++l)
					for (int k = 0; k < TypeParam::dim * TypeParam::dim; ++k)
						near.G[k][l] = far.G[k][l] = (k ? .7 : 2) * (l + step) * yieldStrain;
				far.G[0][3] = is<BoucWen>(law) && as<BoucWen>(law).paper() ? HUGE_VAL : 5e3 * yieldStrain;
				updateBlock(set, law, false, near), updateBlock(set, law, false, far);
				EXPECT_EQ(std::isfinite(far.sigma[0][3]), !as<BoucWen>(law).paper());
				for (int l = 0; l < lanes; ++l)
					for (int k = 0; k < TypeParam::N && l != 3; ++k)
						ASSERT_EQ(near.sigma[k][l], far.sigma[k][l]) << name(set) << ", lane " << l;
			}
		}
}

} // namespace
