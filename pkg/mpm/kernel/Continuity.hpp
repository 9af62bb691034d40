// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "Geometry.hpp"
#include "Points.hpp"
#include "laws/Law.hpp"

namespace yade::mpm {

/* Finds numerical fracture: points that were neighbours, and between which the grid no longer carries anything.

For two points dX apart in the undeformed body every smooth motion has

  x_q - x_p = integral of F along dX = (F_p + F_q)/2 dX + O(|dX|^3).

F at a point comes from the velocities of the nodes around it. While two points are moved by the same nodes both sides go on
agreeing, however far the body is stretched. Points farther apart than the shape functions reach share no node: F stands
still on both sides and the gap grows. The gap, what the one length has more than the other, is next to nothing in a whole body and
grows without bound in a torn one; neither F nor the distance alone tells. (Lengths, because a rotation is not a gap.)

The same holds for a point and a fixed wall, whose image behind the wall it is tied to. A slip wall is left out: bodies rebound
from it. So are points of a law that lets go by itself in tension (Drucker-Prager, Mohr-Coulomb). */
class Continuity {
public:
	/* Throws StepFailure where a gap is wider than `largest` [m]. Neighbours are looked for where none are known, and where there are
	points that have not been seen before; their deformation then counts as right. */
	void check(const Points& points, const std::vector<Law>& laws, const std::vector<Wall>& walls, double cellSize, double largest, double time);
	/* Points or walls have been put elsewhere by hand. */
	void forget() { memory = {}; }

	struct Gap {
		std::size_t p = 0, q = nowhere;        // places in the arrays; no q: a wall
		double      distance = 0, opening = 0; // [m]
	};
	/* The widest gap of all, once the neighbours are known. */
	Gap widest(const Points& points, const std::vector<Law>& laws, const std::vector<Wall>& walls);

	/* What it remembers, in plain columns that can be saved with the points: of a body that is torn neither positions nor F tell any more who
	was whose neighbour. A point's slot is its place when the neighbours were found. */
	using Slot = std::uint32_t;
	struct Memory {
		std::vector<int>   ids;        // of the slots; none: nothing is known
		std::vector<Slot>  neighbours; // as many of each slot as there are axes; itself where it has less
		std::vector<float> dX;         // to each of them, undeformed, a number an axis
		std::vector<Slot>  footings;   // slots of points on a fixed wall ...
		std::vector<Slot>  walls;      // ... which wall each stands on ...
		Column             depths;     // ... and how far from it, undeformed
		std::vector<int>   kinds;      // kind, axis and side of all walls, as the footings have been found for
	} memory;

private:
	static constexpr std::size_t nowhere = std::size_t(-1);
	// made from the memory
	std::vector<std::pair<int, Slot>> m_slots;                       // id and slot, sorted: ids may be of any size
	std::vector<std::size_t>          m_place;                       // of each slot, in the arrays as they stand, or nowhere
	std::size_t                       m_generation = 0, m_count = 0; // of the points that m_place is good for

	bool locate(const Points& points);
	void findNeighbours(const Points& points, const std::vector<Law>& laws);
	void findFootings(const Points& points, const std::vector<Law>& laws, const std::vector<Wall>& walls);
};

} // namespace yade::mpm
