// SPDX-License-Identifier: GPL-2.0-or-later
/* The passes are compiled for several instruction sets, whose results differ by rounding alone: 1e-11 of the greatest entry
of a column after 20 steps, in which errors of 1e-16 add up and pass through differences of nodal forces. Elastic and
yielding points, most of them in blocks of one material, points that change tiles, and tiles whose last block is not full.
For each instruction set two threads give the bits of one. */
#include "kernel/InstructionSet.hpp"
#include "Scene.hpp"
#include <gtest/gtest.h>

using namespace yade::mpm;

namespace {

struct Restore {
	const InstructionSet before = instructionSet();
	~Restore() { useInstructionSet(before); }
};

/* A spinning body, a third of it yielding, beside a wall. */
Scene spinning(Analysis analysis, ShapeKind shape, InstructionSet set, double n, int across)
{
	useInstructionSet(set);
	const int    dim = dimension(analysis);
	const double h   = 2. / across;
	Scene        s;
	s.laws           = { Scene::elastic(1e5, .3, 1000), Scene::boucWen(1e5, .3, 1000, 1e2, n, .05) };
	s.walls          = { Scene::wall(0, 1, -.5, Wall::Kind::slip) };
	const double off = -.5 + .13 * h; // no point on the border of a cell, where rounding decides
	s.addBox(dim, { off, off, off }, { off + 1, off + 1, off + 1 }, h / 2);
	for (std::size_t p = 0; p < s.points.count(); ++p)
		if (s.points.position[0][p] > .15) s.points.material[p] = 1;
	s.setVelocity([&](const std::array<double, 3>& x) {
		return std::array<double, 3> { 1 - x[1] + .02 * x[0], dim > 1 ? x[0] + .01 * x[1] * x[1] : 0, 0 };
	});
	s.control.dt = .1 * h / 20;
	s.start(analysis, shape, h);
	return s;
}

std::vector<Column> columns(Points& points)
{
	std::vector<Column> all;
	points.forEachColumn([&](Column& c) { all.push_back(c); });
	return all;
}

TEST(InstructionSetTest, AgreeToRounding)
{
	Restore restore;
	for (Analysis analysis : allAnalyses)
		for (ShapeKind shape : allShapes)
			for (double n : { 2.3, 10. })
				for (InstructionSet set : { InstructionSet::avx2, InstructionSet::avx512 }) {
					if (!isSupported(set)) continue;
					SCOPED_TRACE(std::string(name(analysis)) + ' ' + name(shape) + ' ' + name(set));
					const int across = analysis == Analysis::solid ? 7 : 30;
					Scene     a = spinning(analysis, shape, InstructionSet::sse2, n, across), b = spinning(analysis, shape, set, n, across);
					a.run(20), b.run(20);
					const auto atA = a.byId(), atB = b.byId();
					const auto x = columns(a.points), y = columns(b.points);
					for (std::size_t k = 0; k < x.size(); ++k) {
						double greatest = 0, difference = 0;
						for (std::size_t p = 0; p < x[k].size(); ++p) {
							greatest   = std::max(greatest, std::abs(x[k][atA[p]]));
							difference = std::max(difference, std::abs(x[k][atA[p]] - y[k][atB[p]]));
						}
						EXPECT_LE(difference, 1e-11 * greatest) << "column " << k;
					}
				}
}

TEST(InstructionSetTest, ThreadsChangeNoBit)
{
	Restore restore;
	for (InstructionSet set : { InstructionSet::sse2, InstructionSet::avx2, InstructionSet::avx512 })
		for (ShapeKind shape : allShapes) {
			if (!isSupported(set)) continue;
			SCOPED_TRACE(std::string(name(shape)) + ' ' + name(set));
			Scene a = spinning(Analysis::planeStress, shape, set, 10, 70), b = spinning(Analysis::planeStress, shape, set, 10, 70);
			b.control.threads = 2;
			a.run(10), b.run(10);
			EXPECT_EQ(a.points.id, b.points.id);
			EXPECT_EQ(columns(a.points), columns(b.points));
		}
}

TEST(InstructionSetTest, OneThatTheProcessorLacksIsRefused)
{
	for (InstructionSet set : { InstructionSet::avx2, InstructionSet::avx512 }) {
		if (isSupported(set)) continue;
		EXPECT_THROW(useInstructionSet(set), std::invalid_argument);
	}
	EXPECT_TRUE(isSupported(InstructionSet::sse2));
}

} // namespace
