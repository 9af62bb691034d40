// SPDX-License-Identifier: GPL-2.0-or-later
// One material point through a path: components, free normals, axes, refusals; and objectivity of the stored tensors.
#include "kernel/PointDriver.hpp"
#include "LawPoint.hpp"
#include "kernel/Kinematics.hpp"
#include <gtest/gtest.h>

using namespace yade::mpm;

namespace {

std::vector<double> helix(int steps, double xz = 0, double yz = 0)
{
	std::vector<double> path;
	for (int i = 0; i <= steps; ++i) {
		const double t = 4. * i / steps, x = 3 * std::sin(t) * yieldStrain, y = .8 * t * yieldStrain, xy = std::sin(2 * t) * yieldStrain;
		path.insert(path.end(), { x, xy, xz * t, xy, y, yz * t, xz * t, yz * t, -.3 * t * yieldStrain });
	}
	return path;
}
template <class S> LawPoint<S> follow(const Law& law, const std::vector<double>& path)
{
	LawPoint<S>              point(law);
	std::array<double, S::N> before {};
	for (std::size_t i = 0; i < path.size(); i += 9) {
		const double             e[6] = { path[i], path[i + 4], path[i + 8], 2 * path[i + 5], 2 * path[i + 2], 2 * path[i + 1] };
		std::array<double, S::N> increment;
		for (std::size_t k = 0; k < S::N; ++k)
			increment[k] = e[S::voigtIndex[k]] - before[k], before[k] = e[S::voigtIndex[k]];
		point.strain(increment);
	}
	return point;
}

std::vector<Law> someLaws()
{
	Law elastic                              = j2Law(0);
	elastic.model                            = Elastic();
	Law soil                                 = elastic;
	soil.model                               = DruckerPrager();
	as<DruckerPrager>(soil).cohesion         = .3 * yieldStress;
	as<DruckerPrager>(soil).internalFriction = .5, as<DruckerPrager>(soil).dilatancy = .2;
	return { elastic, j2Law(.05), boucWenLaw(4, .05, 1e-5), soil };
}

TEST(PointDriver, IsTheLawInEveryStressState)
{
	for (const Law& law : someLaws()) {
		const auto path  = helix(300);
		const auto close = [&](double a, double b) { EXPECT_NEAR(a, b, 1e-9 * yieldStress) << law.model.index(); };

		const PointHistory solid  = drivePoint(law, path);
		const auto         solid_ = follow<Solid>(law, path);
		const std::size_t  last   = 9 * 300;
		const int          at[6]  = { 0, 4, 8, 5, 2, 1 };
		for (int k = 0; k < 6; ++k)
			close(solid.stress[last + std::size_t(at[k])], solid_.sigma[k]);
		EXPECT_EQ(solid.strain, path);
		EXPECT_DOUBLE_EQ(solid.dissipation.back(), solid_.response.dissipation);

		const PointHistory plane  = drivePoint(law, path, { false, false, true });
		const auto         plane_ = follow<PlaneStress>(law, path);
		close(plane.stress[last], plane_.sigma[0]), close(plane.stress[last + 4], plane_.sigma[1]), close(plane.stress[last + 1], plane_.sigma[2]);
		close(plane.stress[last + 8], 0);
		EXPECT_NEAR(plane.strain.back(), plane_.response.freeStrain, 1e-12);
		if (is<Elastic>(law)) {
			EXPECT_NEAR(plane.strain.back(), -poissonRatio / youngModulus * (plane_.sigma[0] + plane_.sigma[1]), 1e-15);
			EXPECT_EQ(plane.dissipation.back(), 0);
		} else {
			EXPECT_GT(plane.dissipation.back(), yieldStress * yieldStrain);
			EXPECT_GT(plane.plasticStrain.back(), yieldStrain);
		}

		auto shearless = path;
		for (std::size_t i = 0; i < path.size(); i += 9)
			shearless[i + 1] = shearless[i + 3] = 0;
		const PointHistory bar = drivePoint(law, shearless, { false, true, true });
		close(bar.stress[last], follow<Uniaxial>(law, shearless).sigma[0]);
		EXPECT_DOUBLE_EQ(bar.strain[last + 4], bar.strain[last + 8]);
	}
}

TEST(PointDriver, AxesAreAllAlike)
{
	// the path with its axes renamed x -> z -> y -> x gives the same history renamed
	const int to[3] = { 2, 0, 1 };
	for (const Law& law : someLaws()) {
		const auto path    = helix(200, .1 * yieldStrain, -.3 * yieldStrain);
		auto       renamed = path;
		for (std::size_t i = 0; i < path.size(); i += 9)
			for (std::size_t r = 0; r < 3; ++r)
				for (std::size_t c = 0; c < 3; ++c)
					renamed[i + std::size_t(3 * to[r] + to[c])] = path[i + 3 * r + c];
		for (const std::array<bool, 3>& free :
			{ std::array<bool, 3> { false, false, false }, { true, false, false }, { false, true, true }, { true, true, true } }) {
			std::array<bool, 3> freeRenamed {};
			for (std::size_t d = 0; d < 3; ++d)
				freeRenamed[std::size_t(to[d])] = free[d];
			const PointHistory a = drivePoint(law, path, free), b = drivePoint(law, renamed, freeRenamed);
			double             worst = 0, greatest = 0;
			for (std::size_t i = 0; i < path.size(); i += 9)
				for (std::size_t r = 0; r < 3; ++r)
					for (std::size_t c = 0; c < 3; ++c) {
						const std::size_t there = i + std::size_t(3 * to[r] + to[c]);
						worst                   = std::max({ worst, std::abs(a.stress[i + 3 * r + c] - b.stress[there]) / yieldStress,
									  std::abs(a.strain[i + 3 * r + c] - b.strain[there]) / yieldStrain,
									  std::abs(a.backStress[i + 3 * r + c] - b.backStress[there]) / yieldStress });
						greatest                = std::max(greatest, std::abs(a.stress[i + 3 * r + c]) / yieldStress);
						if (r == c && free[r]) {
							EXPECT_EQ(a.stress[i + 3 * r + c], 0);
						}
					}
			EXPECT_LT(worst, 1e-4) << law.model.index();
			EXPECT_GT(greatest, .1);
		}
	}
}

TEST(PointDriver, SaysWhatIsWrong)
{
	const auto complaint = [](const Law& law, const std::vector<double>& path) -> std::string {
		try {
			drivePoint(law, path, { false, false, true });
		} catch (const std::invalid_argument& e) {
			return e.what();
		}
		return "";
	};
	const Law law = boucWenLaw(2, 0, 1e-4);
	auto      bad = helix(3);
	EXPECT_EQ(complaint(law, bad), "");
	bad[8] = std::nan(""); // free: not read
	EXPECT_EQ(complaint(law, bad), "");
	bad[9] = std::nan("");
	EXPECT_NE(complaint(law, bad).find("strain xx of entry 1"), std::string::npos);
	Law soft                      = boucWenLaw(10, 0, 1e-4);
	as<BoucWen>(soft).yieldStress = 240, as<BoucWen>(soft).strengthDegradation = .1;
	EXPECT_NE(complaint(soft, helix(3)).find("strain of entry 1: "), std::string::npos) << complaint(soft, helix(3));
	bad = helix(3), bad[10] += 1e-6;
	EXPECT_NE(complaint(law, bad).find("symmetric"), std::string::npos);
	EXPECT_NE(complaint(law, { 1, 2, 3 }).find("nine"), std::string::npos);
	Law wrong            = law;
	as<BoucWen>(wrong).n = -1;
	EXPECT_EQ(complaint(wrong, helix(3)).rfind("n = -1", 0), 0u);
}

TEST(LawObjectivity, RotationByTwoPiReturnsStressAndBackStress)
{
	for (const Law& law : { boucWenLaw(4, .05, 1e-4), boucWenLaw(2.5, .2, 1e-4), j2Law(.05) }) {
		LawPoint<PlaneStress> plane(law);
		LawPoint<Solid>       solid(law);
		plane.strain({ 3 * yieldStrain, -yieldStrain, 2 * yieldStrain });
		solid.strain({ 3 * yieldStrain, -yieldStrain, 0, .5 * yieldStrain, -yieldStrain, 2 * yieldStrain });
		const auto            plane0 = plane;
		const auto            solid0 = solid;
		const double          angle  = 2 * std::acos(-1.) / 100;
		const Eigen::Matrix3d G      = Eigen::AngleAxisd(angle, Eigen::Vector3d(1, 2, -2) / 3).toRotationMatrix() - Eigen::Matrix3d::Identity();
		double                g[9], p[4] = { std::cos(angle) - 1, -std::sin(angle), std::sin(angle), std::cos(angle) - 1 };
		for (int k = 0; k < 9; ++k)
			g[k] = G(k / 3, k % 3);
		double turned = 0;
		for (int i = 0; i < 100; ++i) {
			plane.deform(true, p), solid.deform(true, g);
			turned = std::max(turned, std::abs(plane.sigma[0] - plane0.sigma[0]));
		}
		EXPECT_GT(turned, .5 * yieldStress);
		for (int k = 0; k < 3; ++k) {
			EXPECT_NEAR(plane.sigma[k], plane0.sigma[k], 1e-10 * yieldStress);
			EXPECT_NEAR(plane.internal[std::size_t(k)], plane0.internal[std::size_t(k)], 1e-10 * yieldStress);
		}
		EXPECT_GT(std::abs(plane0.internal[0]), .05 * yieldStress);
		for (int k = 0; k < 6; ++k) {
			EXPECT_NEAR(solid.sigma[k], solid0.sigma[k], 1e-10 * yieldStress);
			EXPECT_NEAR(solid.internal[std::size_t(k)], solid0.internal[std::size_t(k)], 1e-10 * yieldStress);
		}
	}
}

} // namespace
