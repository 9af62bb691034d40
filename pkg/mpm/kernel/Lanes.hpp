// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "Pack.hpp"
#include "Points.hpp"

namespace yade::mpm {

/* The passes work on blocks of points, one lane a point. Lanes beyond the last point of a block repeat it, so that a point's
result does not depend on how many share its block. */
constexpr int lanes = 8;
using Lanes         = Pack<lanes>;

struct Block {
	std::size_t first;
	int         count; // 1 to lanes
};

template <class Visit> void forEachBlock(std::size_t begin, std::size_t end, Visit&& visit)
{
	for (std::size_t p = begin; p < end; p += lanes)
		visit(Block { p, int(end - p < lanes ? end - p : lanes) });
}
template <class Work> void forLanes(Work&& work) { forLanes<lanes>(work); }
inline void                load(const Column& column, Block block, Lanes& x)
{
	const double* from = column.data() + block.first;
	if (block.count == lanes)
		forLanes([&](int l) { x[l] = from[l]; });
	else
		for (int l = 0; l < lanes; ++l)
			x[l] = from[l < block.count ? l : block.count - 1];
}
inline void store(const Lanes& x, Block block, Column& column)
{
	double* to = column.data() + block.first;
	if (block.count == lanes)
		forLanes([&](int l) { to[l] = x[l]; });
	else
		for (int l = 0; l < block.count; ++l)
			to[l] = x[l];
}

/* floor for |x| < 2^31, without a call where the instruction set has no such operation. */
inline int floorToInt(double x)
{
	const int i = int(x);
	return i - (x < i);
}

inline int clamp(int i, int least, int greatest) { return i < least ? least : i > greatest ? greatest : i; }

} // namespace yade::mpm
