// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "../TileGrid.hpp"
#include <cstring>

namespace yade::mpm {

/* The nodes that the points of a tile touch, as a dense array of their own: a pass works on patches and exchanges them with
the node arrays once a tile. A patch has `extent` nodes along each axis, x fastest; its first node is the tile's corner. */
template <int dim, class Shape> struct Patch {
	using Grid                   = TileGrid<dim>;
	using Tile                   = typename Grid::Tile;
	static constexpr int support = Shape::support, row = Shape::row;
	static constexpr int extent = Grid::width + support - 1;
	static constexpr int rows   = ipow(extent, dim - 1);
	static constexpr int nodes  = rows * extent;

	/* One nodal quantity; the excess lets whole vectors be read at the last node. */
	using Values = double[nodes + row - support];

	static void read(const Tile& tile, const Field& field, Values& patch)
	{
		for (int k = support; k < row; ++k)
			patch[nodes + k - support] = 0;
		forEachRun(tile, [&](int at, std::size_t node, int length) { std::memcpy(patch + at, &field[node], length * sizeof(double)); });
	}
	static void add(const Tile& tile, const Values& patch, Field& field)
	{
		forEachRun(tile, [&](int at, std::size_t node, int length) {
			for (int k = 0; k < length; ++k)
				field[node + k] += patch[at + k];
		});
	}

	/* Place in the node arrays of a node of the patch. */
	static std::ptrdiff_t nodeOf(const Tile& tile, int at)
	{
		int corner = 0, offset = 0;
		for (int d = 0, stride = 1; d < dim; ++d, at /= extent, stride *= Grid::width) {
			const int k = at % extent;
			corner |= (k >> Grid::log2Width) << d;
			offset += (k & (Grid::width - 1)) * stride;
		}
		return std::ptrdiff_t(tile.blocks[std::size_t(corner)]) * Grid::nodes + offset;
	}

private:
	/* visit(offset in the patch, offset in the node arrays, length) for every run of nodes that is contiguous in both. */
	template <class Visit> static void forEachRun(const Tile& tile, Visit&& visit)
	{
		for (int row = 0; row < rows; ++row) {
			int corner = 0, offset = 0;
			for (int d = 1, rest = row, stride = Grid::width; d < dim; ++d, rest /= extent, stride *= Grid::width) {
				const int k = rest % extent;
				corner |= (k >> Grid::log2Width) << d;
				offset += (k & (Grid::width - 1)) * stride;
			}
			visit(row * extent, std::size_t(tile.blocks[corner]) * Grid::nodes + offset, Grid::width);
			visit(row * extent + Grid::width, std::size_t(tile.blocks[corner | 1]) * Grid::nodes + offset, support - 1);
		}
	}
};

} // namespace yade::mpm
