// SPDX-License-Identifier: GPL-2.0-or-later
#include "kernel/TileGrid.hpp"
#include "Scene.hpp"
#include <gtest/gtest.h>
#include <random>

using namespace yade::mpm;

namespace {

template <int dim> using Bases = std::vector<std::array<int, dim>>; // by id

template <int dim> bool sortAll(TileGrid<dim>& grid, Points& points, const Bases<dim>& bases, int threads = 1)
{
	return grid.sort(
		points, false, threads, [&](std::size_t p) { return bases[std::size_t(points.id[p])]; }, [](std::size_t) { return true; });
}

/* Every point in the tile of its base and in one tile; the blocks that the tiles write to, and no others. */
template <int dim> void expectSorted(const TileGrid<dim>& grid, const Points& points, const Bases<dim>& bases)
{
	std::size_t                                   next = 0;
	std::vector<typename TileGrid<dim>::BlockKey> wanted;
	std::array<std::size_t, 1 << dim>             seen {};
	for (std::size_t t = 0; t < grid.tiles().size(); ++t) {
		const auto& tile = grid.tiles()[t];
		ASSERT_EQ(tile.begin, next);
		ASSERT_LT(tile.begin, tile.end) << "an empty tile";
		next = tile.end;
		for (std::size_t p = tile.begin; p < tile.end; ++p)
			for (int d = 0; d < dim; ++d)
				ASSERT_EQ(int(std::floor(double(bases[std::size_t(points.id[p])][d]) / TileGrid<dim>::width)), tile.index[d]);
		int colour = 0;
		for (int d = 0; d < dim; ++d)
			colour |= (tile.index[d] & 1) << d;
		ASSERT_LT(seen[colour], grid.colour(colour).size());
		ASSERT_EQ(std::size_t(grid.colour(colour)[seen[colour]++]), t);
		for (int c = 0; c < TileGrid<dim>::corners; ++c) {
			auto block = tile.index;
			for (int d = 0; d < dim; ++d)
				block[d] += c >> d & 1;
			ASSERT_TRUE(grid.blocks()[std::size_t(tile.blocks[c])].index == block);
			wanted.push_back({ tile.group, block });
		}
	}
	ASSERT_EQ(next, points.count());
	std::sort(wanted.begin(), wanted.end());
	wanted.erase(std::unique(wanted.begin(), wanted.end()), wanted.end());
	ASSERT_TRUE(grid.blocks() == wanted);
}

Points numbered(int count)
{
	Points       points;
	const double zero[3] = { 0, 0, 0 };
	for (int k = 0; k < count; ++k) {
		const double x[3] = { double(k), 0, 0 };
		points.append(k, 0, x, zero, 1, 1, 1, 1);
	}
	return points;
}

/* Points that wander, a few of them far: what is sorted from the tiles that some have left is what is sorted from all
points, to the order in the arrays. */
template <int dim> void wander(int count, int offset, int threads)
{
	std::mt19937                       random(unsigned(5 + dim));
	std::uniform_int_distribution<int> place(-2 * TileGrid<dim>::width, 2 * TileGrid<dim>::width), step(-1, 1), one(0, count - 1);
	Bases<dim>                         bases(static_cast<std::size_t>(count));
	for (auto& base : bases)
		for (int& b : base)
			b = offset + place(random);
	Points        some = numbered(count), all = numbered(count);
	TileGrid<dim> kept, anew;
	sortAll<dim>(kept, some, bases), sortAll<dim>(anew, all, bases);
	expectSorted<dim>(kept, some, bases);
	int shuffles = 0;
	for (int round = 0; round < 60; ++round) {
		std::vector<char> left(kept.tiles().size(), 0);
		const auto        before = bases;
		for (int k = 0; k < std::max(1, count / 20); ++k) // few, and now and then all of them
			for (int& b : bases[std::size_t(one(random))])
				b += step(random);
		if (round % 20 == 19)
			for (auto& base : bases)
				base[0] += TileGrid<dim>::width;
		if (round % 7 == 0) bases[std::size_t(one(random))][dim - 1] += 5 * TileGrid<dim>::width;
		for (std::size_t t = 0; t < kept.tiles().size(); ++t)
			for (std::size_t p = kept.tiles()[t].begin; p < kept.tiles()[t].end; ++p)
				for (int d = 0; d < dim; ++d)
					if (bases[std::size_t(some.id[p])][d] >> TileGrid<dim>::log2Width != kept.tiles()[t].index[d]) left[t] = 1;
		const std::size_t generation = some.generation;
		const bool        changed    = kept.sort(
				  some, true, threads, [&](std::size_t p) { return bases[std::size_t(some.id[p])]; }, [&](std::size_t t) { return !left[t]; });
		ASSERT_EQ(changed, sortAll<dim>(anew, all, bases)) << round;
		ASSERT_EQ(some.id, all.id) << round;
		for (std::size_t p = 0; p < some.count(); ++p)
			ASSERT_EQ(some.position[0][p], some.id[p]) << "columns have not moved together";
		expectSorted<dim>(kept, some, bases);
		shuffles += some.generation != generation;
	}
	EXPECT_GT(shuffles, count > 2 ? 8 : -1);
}

TEST(TileGridTest, WhatIsSortedFromChangedTilesIsWhatIsSortedFromAllPoints)
{
	for (int offset : { 0, -3, (1 << 28) - 100, -(1 << 28) + 100 })
		for (int count : { 1, 2, 300 }) {
			SCOPED_TRACE(std::to_string(count) + " points at " + std::to_string(offset));
			wander<1>(count, offset, 1), wander<2>(count, offset, 1), wander<3>(count, offset, 1);
		}
	wander<2>(20000, 0, 2); // enough for two threads
}

/* The same scene, so many cells further: points at the edges of tiles and cells, and points that cross them. Cells are a
power of two, so that nothing but the sums' order differs. */
TEST(TileGridTest, WhereTilesBeginDoesNotMatter)
{
	const double h = .25;
	for (Analysis analysis : { Analysis::uniaxial, Analysis::planeStress, Analysis::solid })
		for (ShapeKind shape : allShapes) {
			SCOPED_TRACE(std::string(name(analysis)) + ' ' + name(shape));
			const int            dim = dimension(analysis);
			std::vector<Columns> ends; // velocity, stress
			for (int cells : { 0, 1, 2, 3, 4, 5, 6, 7, 8, 61, 62, 63, 64, -1, -5, -64 }) {
				const double x0 = h * cells;
				Scene        s;
				s.laws = { Scene::elastic(1e5, .3, 1000) };
				s.addBox(dim, { x0, x0, x0 }, { x0 + 1, x0 + 1, x0 + 1 }, h / 2);
				for (std::size_t p = 0; p < s.points.count(); ++p) {
					for (int d = 0; d < dim; ++d)
						s.points.velocity[std::size_t(d)][p] =
							(d ? 2 : -4) + .1 * std::sin(double(3 * p) + d);  // a cell in ten steps, and against each other
					if (p % 5 == 0) s.points.position[0][p] = x0 + h * double(p % 3); // on a node
				}
				s.control.dt = .006;
				s.start(analysis, shape, h);
				s.run(20);
				const auto at = s.byId();
				Columns    end;
				for (const Columns* columns : { &s.points.velocity, &s.points.stress })
					for (const Column& c : *columns) {
						end.emplace_back();
						for (const std::size_t p : at)
							end.back().push_back(c[p]);
					}
				ends.push_back(end);
			}
			for (const Columns& end : ends)
				for (std::size_t c = 0; c < end.size(); ++c)
					for (std::size_t p = 0; p < end[c].size(); ++p)
						ASSERT_NEAR(end[c][p], ends[0][c][p], c < 3 ? 1e-12 : 1e-9)
							<< "column " << c << " of point " << p; // of 1 m/s and 1e3 Pa
			double greatest = 0;
			for (double sigma : ends[0][3])
				greatest = std::max(greatest, std::abs(sigma));
			EXPECT_GT(greatest, 300) << "nothing has been strained";
		}
}

} // namespace
