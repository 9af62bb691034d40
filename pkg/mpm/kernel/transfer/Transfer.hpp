// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "../InstructionSet.hpp"
#include "Weights.hpp"

namespace yade::mpm {

/* The points of a scene laid over its grid: weights of the points, and the loops over tiles and nodes that all passes share. */
template <int dim, class Shape> struct Transfer {
	using Grid    = TileGrid<dim>;
	using Tile    = typename Grid::Tile;
	using Patch   = mpm::Patch<dim, Shape>;
	using Values  = typename Patch::Values;
	using Weights = mpm::Weights<dim, Shape>;

	Points&              points;
	const InstructionSet instructions = instructionSet();
	Geometry<dim>        geometry {};
	Grid                 grid {};
	int                  threads = 1;

	/* Half a point's size along an axis, in cells; 0 where the shape function does not depend on it. */
	double halfSize(int axis, std::size_t p) const { return Shape::usesSize ? .5 * points.size[p] / geometry.cell[axis] : 0; }

	/* Weights of a point, and those of a block of points at x. */
	Weights weights(const Tile& tile, std::size_t p) const
	{
		Lanes x[dim];
		for (int d = 0; d < dim; ++d)
			load(points.position[d], { p, 1 }, x[d]);
		WeightLanes<dim, Shape> w;
		weights(tile, { p, 1 }, x, w);
		return w[0];
	}
	void weights(const Tile& tile, Block block, const Lanes (&x)[dim], WeightLanes<dim, Shape>& w) const
	{
		Lanes s[dim], r[dim] {};
		int   first[lanes] {};
		for (int d = dim - 1; d >= 0; --d) {
			const double origin = geometry.origin[d], cell = geometry.cell[d];
			const int    corner = tile.index[d] * Grid::width;
			if constexpr (Shape::usesSize) {
				load(points.size, block, r[d]);
				forLanes([&](int l) { r[d][l] = .5 * r[d][l] / cell; });
			}
#pragma omp simd
			for (int l = 0; l < lanes; ++l) {
				const double xi   = (x[d][l] - origin) / cell;
				const int    base = clamp(floorToInt(xi - Shape::shift(r[d][l])), corner, corner + Grid::width - 1);
				s[d][l]           = xi - base;
				first[l]          = first[l] * Patch::extent + (base - corner);
			}
		}
		double perMetre[dim];
		for (int d = 0; d < dim; ++d)
			perMetre[d] = 1 / geometry.cell[d];
		for (int l = 0; l < block.count; ++l) {
			w[l].first = first[l];
			for (int d = 0; d < dim; ++d) {
				shapeRow(s[d][l], r[d][l], w[l].N[d], w[l].dN[d]);
#pragma omp simd
				for (int k = 0; k < Shape::row; ++k)
					w[l].dN[d][k] *= perMetre[d];
			}
		}
	}

	/* work(t) for every tile. Tiles of one colour share no node: any number of threads, one result. */
	template <class Work> void forEachTile(Work&& work) const
	{
		for (int c = 0; c < Grid::corners; ++c) {
			const std::vector<int>& tiles = grid.colour(c);
			const int               count = int(tiles.size());
			if (threads == 1 || count == 1 || points.count() <= 2000) { // a team of one is not free
				for (const int t : tiles)
					work(std::size_t(t));
				continue;
			}
#pragma omp parallel for schedule(dynamic) num_threads(threads)
			for (int k = 0; k < count; ++k)
				work(std::size_t(tiles[k]));
		}
	}
	/* work(begin, end) for ranges of nodes, whole blocks, that are all nodes together; compiled by run(). */
	template <class Work> void forEachNodeRange(Work&& work) const
	{
		constexpr std::size_t length = 32 * Grid::nodes;
		const std::size_t     count  = grid.nodeCount();
		if (threads == 1 || count <= 4 * length) return run(instructions, [&work, count] { work(0, count); });
#pragma omp parallel for schedule(static) num_threads(threads)
		for (std::size_t begin = 0; begin < count; begin += length)
			run(instructions, [&work, begin, end = std::min(begin + length, count)] { work(begin, end); });
	}

private:
	static void shapeRow(double s, double r, double* N, double* dN)
	{
		if constexpr (Shape::usesSize || Shape::row == Shape::support)
			Shape::evaluate(s, 0, r, N, dN);
		else
			Shape::template evaluate<Shape::row>(s, 0, r, N, dN);
		for (int k = Shape::support; Shape::usesSize && k < Shape::row; ++k)
			N[k] = dN[k] = 0;
	}
};

} // namespace yade::mpm
