// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "Geometry.hpp"
#include "Points.hpp"
#include <cstdint>
#include <numeric>

namespace yade::mpm {

using Field = Column; // one number a node
/* One field a component. */
template <int dim> struct NodeVector : std::array<Field, dim> {
};
/* The lumped mass for the motion along each axis. */
template <int dim> struct NodeMass : std::array<Field*, dim> {
};

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
		int                      group;      // of its points: a field of their own
		std::size_t              begin, end; // its points
		std::array<int, corners> blocks;     // bit d of the position: one further along axis d
	};

	struct BlockKey {
		int   group;
		Index index;
		bool  operator<(const BlockKey& o) const { return group != o.group ? group < o.group : index < o.index; }
		bool  operator==(const BlockKey& o) const { return group == o.group && index == o.index; }
		bool  operator!=(const BlockKey& o) const { return !(*this == o); }
	};

	const std::vector<Tile>&     tiles() const { return m_tiles; }
	const std::vector<int>&      colour(int c) const { return m_colours[c]; }
	const std::vector<BlockKey>& blocks() const { return m_blocks; }
	std::size_t                  nodeCount() const { return m_blocks.size() * nodes; }

	/* Position of a group's node in the node arrays, or -1 where the grid has none. */
	std::ptrdiff_t find(const Index& node, int group = 0) const
	{
		BlockKey key { group, {} };
		Index&   block = key.index;
		int      local = 0;
		for (int d = dim - 1; d >= 0; --d) {
			block[d] = node[d] >> log2Width;
			local    = local * width + (node[d] & (width - 1));
		}
		const auto at = std::lower_bound(m_blocks.begin(), m_blocks.end(), key);
		return at == m_blocks.end() || *at != key ? -1 : (at - m_blocks.begin()) * nodes + local;
	}

	/* visit(index, position in the node arrays, group) for every node. */
	template <class Visit> void forEachNode(Visit&& visit) const
	{
		for (std::size_t b = 0; b < m_blocks.size(); ++b)
			for (int local = 0; local < nodes; ++local) {
				Index node = m_blocks[b].index;
				for (int d = 0, rest = local; d < dim; ++d, rest >>= log2Width)
					node[d] = node[d] * width + (rest & (width - 1));
				visit(node, std::ptrdiff_t(b) * nodes + local, m_blocks[b].group);
			}
	}

	/* Brings the points of a tile together and finds the blocks. baseOf(p) is the first node of a point's support. isKept(t):
	no point of tile t has left it since the last sorting; without sortedBefore none is asked for. What comes of it depends
	on the points' order and bases alone. Few points are moved where few are out of place; else all are sorted, by tile and
	by cell inside a tile. Returns whether the blocks are other ones than before. */
	template <class BaseOf, class IsKept> bool sort(Points& points, bool sortedBefore, int threads, BaseOf&& baseOf, IsKept&& isKept)
	{
		const std::size_t      count = points.count();
		const std::vector<Run> runs  = findRuns(points, sortedBefore, threads, baseOf, isKept);
		m_tiles.clear();
		for (const Run& run : runs)
			if (m_tiles.empty() || !sameTile(m_tiles.back(), run)) m_tiles.push_back({ run.index, run.group, 0, 0, {} });
		auto before = [](const Tile& a, const Tile& b) { // colour by colour, as forEachTile() goes through memory
			const int ca = colourOf(a.index), cb = colourOf(b.index);
			return ca != cb ? ca < cb : a.index != b.index ? a.index < b.index : a.group < b.group;
		};
		std::sort(m_tiles.begin(), m_tiles.end(), before);
		m_tiles.erase(std::unique(m_tiles.begin(), m_tiles.end(), sameTile<Tile, Tile>), m_tiles.end());
		std::vector<std::size_t> tileOf; // a run
		for (const Run& run : runs) {
			tileOf.push_back(std::size_t(
				std::lower_bound(m_tiles.begin(), m_tiles.end(), Tile { run.index, run.group, 0, 0, {} }, before) - m_tiles.begin()));
			m_tiles[tileOf.back()].end += run.end - run.begin;
		}
		for (std::size_t t = 1; t < m_tiles.size(); ++t)
			m_tiles[t].begin = m_tiles[t - 1].end, m_tiles[t].end += m_tiles[t].begin;

		// points out of their tile's range; the places that they leave are those that they take, tile by tile
		std::vector<std::pair<std::size_t, std::size_t>> strays; // tile, place
		for (std::size_t r = 0; r < runs.size(); ++r) {
			const Tile& tile = m_tiles[tileOf[r]];
			for (std::size_t p = runs[r].begin; p < std::min(runs[r].end, tile.begin); ++p)
				strays.push_back({ tileOf[r], p });
			for (std::size_t p = std::max(runs[r].begin, tile.end); p < runs[r].end; ++p)
				strays.push_back({ tileOf[r], p });
		}
		if (strays.size() > count / 4) {
			std::vector<std::size_t> at(m_tiles.size() * nodes + 1, 0), order(count);
			auto                     cell = [&](std::size_t p, std::size_t tile) {
                                const Index base  = baseOf(p);
                                int         local = 0;
                                for (int d = 0; d < dim; ++d)
                                        local = local * width + (base[d] & (width - 1));
                                return tile * nodes + std::size_t(local);
			};
			for (std::size_t r = 0; r < runs.size(); ++r)
				for (std::size_t p = runs[r].begin; p < runs[r].end; ++p)
					++at[cell(p, tileOf[r]) + 1];
			std::partial_sum(at.begin(), at.end(), at.begin());
			for (std::size_t r = 0; r < runs.size(); ++r)
				for (std::size_t p = runs[r].begin; p < runs[r].end; ++p)
					order[at[cell(p, tileOf[r])]++] = p;
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
	std::vector<BlockKey>                 m_blocks;

	template <class A, class B> static bool sameTile(const A& a, const B& b) { return a.group == b.group && a.index == b.index; }

	static int colourOf(const Index& index)
	{
		int parity = 0;
		for (int d = 0; d < dim; ++d)
			parity |= (index[d] & 1) << d;
		return parity;
	}
	struct Run { // of points that follow each other and share a tile
		std::size_t begin, end;
		Index       index;
		int         group;
	};
	/* The points as runs, in the order of the arrays. */
	template <class BaseOf, class IsKept>
	std::vector<Run> findRuns(const Points& points, bool sortedBefore, int threads, const BaseOf& baseOf, const IsKept& isKept) const
	{
		constexpr std::size_t length = 4096; // of the parts that threads take
		const std::size_t     count  = points.count();
		const std::size_t     number = sortedBefore ? m_tiles.size() : (count + length - 1) / length;
		auto                  scan   = [&](std::size_t k) {
                        if (sortedBefore && isKept(k)) return std::vector<Run> { { m_tiles[k].begin, m_tiles[k].end, m_tiles[k].index, m_tiles[k].group } };
                        const std::size_t begin = sortedBefore ? m_tiles[k].begin : k * length;
                        const std::size_t end   = sortedBefore ? m_tiles[k].end : std::min(begin + length, count);
                        std::vector<Run>  runs;
                        for (std::size_t p = begin; p < end; ++p) {
                                Index index = baseOf(p);
                                for (int& i : index)
                                        i >>= log2Width;
                                const Run next { p, p, index, points.group.empty() ? 0 : points.group[p] };
                                if (runs.empty() || !sameTile(runs.back(), next)) runs.push_back(next);
                                runs.back().end = p + 1;
                        }
                        return runs;
		};
		std::vector<std::vector<Run>> parts(number);
		if (threads == 1 || count <= 2 * length)
			for (std::size_t k = 0; k < number; ++k)
				parts[k] = scan(k);
		else {
#pragma omp parallel for schedule(static) num_threads(threads)
			for (std::size_t k = 0; k < number; ++k)
				parts[k] = scan(k);
		}
		std::vector<Run> runs;
		for (const std::vector<Run>& part : parts)
			runs.insert(runs.end(), part.begin(), part.end());
		return runs;
	}

	bool findBlocks()
	{
		auto neighbour = [](Index index, int corner) {
			for (int d = 0; d < dim; ++d)
				index[d] += corner >> d & 1;
			return index;
		};
		std::vector<BlockKey> blocks;
		for (const Tile& tile : m_tiles)
			for (int c = 0; c < corners; ++c)
				blocks.push_back({ tile.group, neighbour(tile.index, c) });
		std::sort(blocks.begin(), blocks.end());
		blocks.erase(std::unique(blocks.begin(), blocks.end()), blocks.end());
		const bool changed = blocks != m_blocks;
		m_blocks.swap(blocks);
		for (auto& colour : m_colours)
			colour.clear();
		for (std::size_t t = 0; t < m_tiles.size(); ++t) {
			Tile& tile = m_tiles[t];
			m_colours[colourOf(tile.index)].push_back(int(t));
			for (int c = 0; c < corners; ++c)
				tile.blocks[c] = int(std::lower_bound(m_blocks.begin(), m_blocks.end(), BlockKey { tile.group, neighbour(tile.index, c) })
						     - m_blocks.begin());
		}
		return changed;
	}
};

} // namespace yade::mpm
