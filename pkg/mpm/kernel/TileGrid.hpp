// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "Geometry.hpp"
#include "Points.hpp"
#include <cstdint>
#include <numeric>

namespace yade::mpm {

constexpr int ipow(int base, int exponent) { return exponent == 0 ? 1 : base * ipow(base, exponent - 1); }

/* The background grid: blocks of width^dim nodes, only where points are, found anew whenever the points are sorted.

A point belongs to the tile of the first node of its support. A tile therefore writes to its own block and to those
one further along each axis, 2^dim in all; two tiles of one colour (parity of their indices) share no block, so that the
tiles of a colour can be worked on in parallel, without atomics and in an order that no number of threads changes. */
template <int dim> class TileGrid {
public:
	static constexpr int log2Width = dim == 1 ? 6 : dim == 2 ? 3 : 2;
	static constexpr int width     = 1 << log2Width; // nodes of a block along an axis
	static constexpr int nodes     = ipow(width, dim);
	static constexpr int corners   = 1 << dim;

	using Index = std::array<int, dim>;
	struct Tile {
		Index                    index;
		std::size_t              begin, end; // its points
		std::array<int, corners> blocks;     // bit d of the position: one further along axis d
	};

	const std::vector<Tile>&  tiles() const { return m_tiles; }
	const std::vector<int>&   colour(int c) const { return m_colours[c]; }
	const std::vector<Index>& blocks() const { return m_blocks; }
	std::size_t               nodeCount() const { return m_blocks.size() * nodes; }

	/* Position of a node in the node arrays, or -1 where the grid has none. */
	std::ptrdiff_t find(const Index& node) const
	{
		Index block;
		int   local = 0;
		for (int d = dim - 1; d >= 0; --d) {
			block[d] = node[d] >> log2Width;
			local    = local * width + (node[d] & (width - 1));
		}
		const auto at = std::lower_bound(m_blocks.begin(), m_blocks.end(), block);
		return at == m_blocks.end() || *at != block ? -1 : (at - m_blocks.begin()) * nodes + local;
	}

	/* Brings the points of a tile together and finds the blocks, from the first nodes of the points: bases[d][p] along axis
	d. What comes of it depends on the points' order and bases alone. Few points are moved where few are out of place; else
	all are sorted, by tile and by cell inside a tile. Returns whether the blocks are other ones than before. */
	bool sort(Points& points, const std::array<std::vector<int>, dim>& bases)
	{
		const std::size_t count  = points.count();
		auto              tileOf = [&](std::size_t p) {
                        Index index;
                        for (int d = 0; d < dim; ++d)
                                index[d] = bases[d][p] >> log2Width;
                        return index;
		};
		struct Run { // of points that follow each other and share a tile
			std::size_t begin, end, tile;
			Index       index;
		};
		std::vector<Run> runs;
		for (std::size_t p = 0; p < count; ++p) {
			const Index index = tileOf(p);
			if (runs.empty() || runs.back().index != index) runs.push_back({ p, p, 0, index });
			runs.back().end = p + 1;
		}
		m_tiles.clear();
		for (const Run& run : runs)
			m_tiles.push_back({ run.index, 0, 0, {} });
		auto before = [](const Tile& a, const Tile& b) { return a.index < b.index; };
		std::sort(m_tiles.begin(), m_tiles.end(), before);
		m_tiles.erase(std::unique(m_tiles.begin(), m_tiles.end(), [](const Tile& a, const Tile& b) { return a.index == b.index; }), m_tiles.end());
		for (Run& run : runs) {
			run.tile = std::size_t(std::lower_bound(m_tiles.begin(), m_tiles.end(), Tile { run.index, 0, 0, {} }, before) - m_tiles.begin());
			m_tiles[run.tile].end += run.end - run.begin;
		}
		for (std::size_t t = 1; t < m_tiles.size(); ++t)
			m_tiles[t].begin = m_tiles[t - 1].end, m_tiles[t].end += m_tiles[t].begin;

		// points out of their tile's range; the places that they leave are those that they take, tile by tile
		std::vector<std::pair<std::size_t, std::size_t>> strays; // tile, place
		for (const Run& run : runs)
			for (std::size_t p = run.begin; p < run.end; ++p)
				if (p < m_tiles[run.tile].begin || p >= m_tiles[run.tile].end) strays.push_back({ run.tile, p });
		if (strays.size() > count / 4) {
			std::vector<std::size_t> at(m_tiles.size() * nodes + 1, 0), order(count);
			auto                     cell = [&](std::size_t p, std::size_t tile) {
                                int local = 0;
                                for (int d = 0; d < dim; ++d)
                                        local = local * width + (bases[d][p] & (width - 1));
                                return tile * nodes + std::size_t(local);
			};
			for (const Run& run : runs)
				for (std::size_t p = run.begin; p < run.end; ++p)
					++at[cell(p, run.tile) + 1];
			std::partial_sum(at.begin(), at.end(), at.begin());
			for (const Run& run : runs)
				for (std::size_t p = run.begin; p < run.end; ++p)
					order[at[cell(p, run.tile)]++] = p;
			points.select(order);
		} else if (!strays.empty()) {
			std::vector<std::size_t> from, to;
			for (const auto& stray : strays)
				to.push_back(stray.second);
			std::sort(strays.begin(), strays.end());
			for (const auto& stray : strays)
				from.push_back(stray.second);
			points.move(from, to);
		}
		return findBlocks();
	}

private:
	std::vector<Tile>                     m_tiles;
	std::array<std::vector<int>, corners> m_colours;
	std::vector<Index>                    m_blocks;

	bool findBlocks()
	{
		auto neighbour = [](Index index, int corner) {
			for (int d = 0; d < dim; ++d)
				index[d] += corner >> d & 1;
			return index;
		};
		std::vector<Index> blocks;
		for (const Tile& tile : m_tiles)
			for (int c = 0; c < corners; ++c)
				blocks.push_back(neighbour(tile.index, c));
		std::sort(blocks.begin(), blocks.end());
		blocks.erase(std::unique(blocks.begin(), blocks.end()), blocks.end());
		const bool changed = blocks != m_blocks;
		m_blocks.swap(blocks);
		for (auto& colour : m_colours)
			colour.clear();
		for (std::size_t t = 0; t < m_tiles.size(); ++t) {
			Tile& tile   = m_tiles[t];
			int   parity = 0;
			for (int d = 0; d < dim; ++d)
				parity |= (tile.index[d] & 1) << d;
			m_colours[parity].push_back(int(t));
			for (int c = 0; c < corners; ++c)
				tile.blocks[c] = int(std::lower_bound(m_blocks.begin(), m_blocks.end(), neighbour(tile.index, c)) - m_blocks.begin());
		}
		return changed;
	}
};

} // namespace yade::mpm
