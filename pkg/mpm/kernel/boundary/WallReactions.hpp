// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "WallMirror.hpp"

namespace yade::mpm {

/* Forces of the material on the walls, from the balance of the nodes through which they act: force on the nodes minus their
mass times their acceleration. */
template <int dim> class WallReactions {
public:
	/* Finds the nodes on the walls' planes and beside them, with the walls that cover them. */
	void build(const TileGrid<dim>& grid, const Geometry<dim>& g, const std::vector<Wall>& walls, const std::vector<WallMirror<dim>>& mirrors)
	{
		using Index = typename TileGrid<dim>::Index;
		m_nodes.clear();
		auto depth = [&](const Index& node, const Wall& wall) { return (node[wall.axis] - WallMirror<dim>::planeNode(g, wall)) * wall.side; };
		grid.forEachNode([&](const Index& node, std::ptrdiff_t at, int) {
			Node r { at, {}, 0, {}, {}, {}, {} };
			for (std::size_t b = 0; b < mirrors.size() && r.count < 2 * dim; ++b) {
				const Wall& wall = walls[mirrors[b].wall];
				if (std::abs(depth(node, wall)) > 1) continue;
				r.covers[r.count++] = int(mirrors[b].wall);
			}
			if (r.count > 0) m_nodes.push_back(r);
		});
		for (Field& c : m_acceleration)
			c.assign(m_nodes.empty() ? 0 : grid.nodeCount(), 0);
	}

	/* Mass and force of the nodes alone, before they are mirrored ... */
	void keepForces(const NodeMass<dim>& mass, const NodeVector<dim>& force)
	{
		for (Node& r : m_nodes)
			for (int d = 0; d < dim; ++d)
				r.mass[d] = (*mass[d])[r.node], r.force[d] = force[d][r.node];
	}
	/* ... and what the walls take of it; unfold(field) writes the images of an acceleration. */
	template <class Unfold> void add(std::vector<Wall>& walls, const NodeMass<dim>& mass, const NodeVector<dim>& force, Unfold&& unfold)
	{
		for (const Node& r : m_nodes)
			for (int d = 0; d < dim; ++d)
				m_acceleration[d][r.node] = (*mass[d])[r.node] > 0 ? force[d][r.node] / (*mass[d])[r.node] : 0;
		unfold(m_acceleration);
		addToWalls(walls, [this](const Node& r, int d) { return r.force[d] - r.mass[d] * m_acceleration[d][r.node]; });
	}
	/* Momentum of the nodes alone, before it is mirrored ... */
	void keepMomentum(const NodeVector<dim>& momentum)
	{
		for (Node& r : m_nodes)
			for (int d = 0; d < dim; ++d)
				r.momentum[d] = momentum[d][r.node];
	}
	/* ... and `rate` times what the walls have taken of it, where it became `velocity` (doc/method.md). */
	void addMomentumLoss(std::vector<Wall>& walls, const NodeVector<dim>& velocity, double rate) const
	{
		addToWalls(walls, [&](const Node& r, int d) { return rate * (r.momentum[d] - r.mass[d] * velocity[d][r.node]); });
	}

	/* Increments of the nodes before impulses act in front of the walls ... */
	void keepIncrements(const NodeVector<dim>& increment)
	{
		for (Node& r : m_nodes)
			for (int d = 0; d < dim; ++d)
				r.increment[d] = increment[d][r.node];
	}
	/* ... and what the walls take of the impulses (before they are mirrored) that have made of them what they are. */
	void addImpulses(std::vector<Wall>& walls, const NodeVector<dim>& impulse, const NodeVector<dim>& increment, double dt) const
	{
		addToWalls(walls, [&](const Node& r, int d) { return (impulse[d][r.node] - r.mass[d] * (increment[d][r.node] - r.increment[d])) / dt; });
	}

private:
	struct Node {
		std::ptrdiff_t           node;
		std::array<int, 2 * dim> covers; // walls: the node lies on the plane or beside it
		int                      count;
		std::array<double, dim>  mass, force;         // of the node alone, before it is mirrored
		std::array<double, dim>  momentum, increment; // likewise
	};
	std::vector<Node> m_nodes;
	NodeVector<dim>   m_acceleration;

	/* A component of force(node, d) is taken by the wall normal to it, else by a fixed wall. */
	template <class Force> void addToWalls(std::vector<Wall>& walls, Force&& force) const
	{
		for (const Node& r : m_nodes) {
			std::array<int, dim> taker, rank {};
			taker.fill(-1);
			for (int k = 0; k < r.count; ++k) {
				const Wall& wall = walls[std::size_t(r.covers[k])];
				for (int d = 0; d < dim; ++d) {
					const int mine = d == wall.axis ? 2 : wall.kind == Wall::Kind::fixed ? 1 : 0;
					if (mine > rank[d]) rank[d] = mine, taker[d] = r.covers[k];
				}
			}
			for (int d = 0; d < dim; ++d)
				if (taker[d] >= 0) walls[taker[d]].force[d] += force(r, d);
		}
	}
};

} // namespace yade::mpm
