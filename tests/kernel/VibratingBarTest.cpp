// SPDX-License-Identifier: GPL-2.0-or-later
/* V3, of VibratingBar.hpp: energy of the three schemes in small and large motion.

Table: greatest error of the centre-of-mass velocity over its amplitude; energy at the end over that at the start (of an
independent NumPy implementation, which sums strains by forward Euler; the kernel takes them at mid-step). Two per cent of
the first number, and 2e-4 of the energy, are what that difference costs. Energy: kinetic plus V0 E (F ln F - F + 1), which is
what sigma = E ln F stores. */
#include "VibratingBar.hpp"
#include <gtest/gtest.h>

using namespace yade::mpm;

namespace {

struct BarRow {
	ShapeKind shape;
	int       cells;
	Scheme    scheme;
	double    velocityError, energyRatio;
};
std::ostream& operator<<(std::ostream& out, const BarRow& row) { return out << name(row.shape) << ' ' << row.cells << ' ' << name(row.scheme); }
class VibratingBarTest : public ::testing::TestWithParam<BarRow> {};

TEST_P(VibratingBarTest, Table)
{
	const BarRow row = GetParam();
	const Bar    bar = vibrate(row.shape, row.cells, row.scheme, .1);
	EXPECT_NEAR(bar.velocityError, row.velocityError, .02 * row.velocityError);
	EXPECT_NEAR(bar.energyRatio, row.energyRatio, 2e-4);
}
INSTANTIATE_TEST_SUITE_P(V3, VibratingBarTest,
	::testing::Values(BarRow { ShapeKind::linear, 16, Scheme::usf, 7.28e-2, 1.00078 }, BarRow { ShapeKind::linear, 16, Scheme::usl, 8.49e-2, .99810 },
		BarRow { ShapeKind::linear, 16, Scheme::musl, 8.49e-2, .99920 }, BarRow { ShapeKind::linear, 32, Scheme::usf, 1.63e-2, 1.00009 },
		BarRow { ShapeKind::linear, 32, Scheme::usl, 2.23e-2, .99976 }, BarRow { ShapeKind::linear, 32, Scheme::musl, 2.23e-2, .99990 },
		BarRow { ShapeKind::cubic, 16, Scheme::musl, .204, .9981 }, BarRow { ShapeKind::cubic, 32, Scheme::musl, 5.44e-2, .99975 },
		BarRow { ShapeKind::cubic, 64, Scheme::musl, 1.65e-2, .99997 }),
	[](const auto& info) { return std::string(name(info.param.shape)) + std::to_string(info.param.cells) + name(info.param.scheme); });

/* v0 = 0.75: points cross cells all the time. Cubic splines keep the energy to 0.1 %; linear functions lose the bar. */
TEST(VibratingBarLargeTest, CubicKeepsTheEnergy)
{
	for (Scheme scheme : allSchemes)
		EXPECT_NEAR(vibrate(ShapeKind::cubic, 32, scheme, .75).energyRatio, 1, 1e-3) << name(scheme);
}
TEST(VibratingBarLargeTest, LinearDoesNot)
{
	for (Scheme scheme : { Scheme::usf, Scheme::usl }) {
		double ratio = 0; // lost altogether
		try {
			ratio = vibrate(ShapeKind::linear, 32, scheme, .75).energyRatio;
		} catch (const StepFailure&) {
		}
		EXPECT_GT(std::abs(ratio - 1), .2) << name(scheme) << ": the case has become harmless, and the one above with it";
	}
}

/* One per cent of PIC a step: energy 0.902 of that at the start after ten periods (computed). */
TEST(VibratingBarPicTest, DissipatesAsComputed) { EXPECT_NEAR(vibrate(ShapeKind::cubic, 32, Scheme::musl, .1, .99).energyRatio, .902, .001); }

} // namespace
