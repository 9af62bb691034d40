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

	/* Sorts the points by tile, and by cell inside a tile where they are not in order of tiles already, and finds the
	blocks. bases[d][p] is the first node of point p along axis d. */
	void sort(Points& points, const std::array<std::vector<int>, dim>& bases)
	{
		const std::size_t        count = points.count();
		std::vector<std::size_t> order(count);
		std::iota(order.begin(), order.end(), std::size_t(0));
		auto tileLess = [&](std::size_t p, std::size_t q) { return compare(bases, p, q, log2Width) < 0; };
		if (!std::is_sorted(order.begin(), order.end(), tileLess)) {
			std::stable_sort(order.begin(), order.end(), [&](std::size_t p, std::size_t q) {
				const int tile = compare(bases, p, q, log2Width);
				return tile ? tile < 0 : compare(bases, p, q, 0) < 0;
			});
			points.select(order);
		}
		collect(order, bases);
	}

private:
	std::vector<Tile>                     m_tiles;
	std::array<std::vector<int>, corners> m_colours;
	std::vector<Index>                    m_blocks;

	static int compare(const std::array<std::vector<int>, dim>& bases, std::size_t p, std::size_t q, int shift)
	{
		for (int d = 0; d < dim; ++d) {
			const int a = bases[d][p] >> shift, b = bases[d][q] >> shift;
			if (a != b) return a < b ? -1 : 1;
		}
		return 0;
	}

	/* order[k]: where the point that is now k-th was when bases was filled. */
	void collect(const std::vector<std::size_t>& order, const std::array<std::vector<int>, dim>& bases)
	{
		m_tiles.clear();
		for (std::size_t k = 0; k < order.size(); ++k) {
			Index index;
			for (int d = 0; d < dim; ++d)
				index[d] = bases[d][order[k]] >> log2Width;
			if (m_tiles.empty() || m_tiles.back().index != index) m_tiles.push_back({ index, k, k, {} });
			m_tiles.back().end = k + 1;
		}
		auto neighbour = [](Index index, int corner) {
			for (int d = 0; d < dim; ++d)
				index[d] += corner >> d & 1;
			return index;
		};
		m_blocks.clear();
		for (const Tile& tile : m_tiles)
			for (int c = 0; c < corners; ++c)
				m_blocks.push_back(neighbour(tile.index, c));
		std::sort(m_blocks.begin(), m_blocks.end());
		m_blocks.erase(std::unique(m_blocks.begin(), m_blocks.end()), m_blocks.end());
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
	}
};

} // namespace yade::mpm
