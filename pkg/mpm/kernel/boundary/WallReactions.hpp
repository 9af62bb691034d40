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
		std::vector<std::vector<std::pair<std::ptrdiff_t, int>>> feet(mirrors.size()); // columns of contacts, by their node on the plane
		for (std::size_t b = 0; b < mirrors.size(); ++b)
			for (std::size_t c = 0; mirrors[b].friction && c < mirrors[b].columns.size(); ++c)
				feet[b].push_back({ mirrors[b].columns[c].plane, int(c) });
		for (auto& f : feet)
			std::sort(f.begin(), f.end());
		grid.forEachNode([&](const Index& node, std::ptrdiff_t at) {
			Node r { at, {}, 0, {}, {}, {} };
			for (std::size_t b = 0; b < mirrors.size() && r.count < 2 * dim; ++b) {
				const Wall& wall = walls[mirrors[b].wall];
				if (std::abs(depth(node, wall)) > 1) continue;
				Cover cover { int(mirrors[b].wall), int(b), -1 };
				if (mirrors[b].friction) {
					Index foot      = node; // of the column, in front of the other walls
					foot[wall.axis] = WallMirror<dim>::planeNode(g, wall);
					for (const Wall& other : walls)
						if (other.axis != wall.axis && depth(foot, other) < 0)
							foot[other.axis] = 2 * WallMirror<dim>::planeNode(g, other) - foot[other.axis];
					const std::pair<std::ptrdiff_t, int> key { grid.find(foot), 0 };
					const auto                           column = std::lower_bound(feet[b].begin(), feet[b].end(), key);
					if (key.first >= 0 && column != feet[b].end() && column->first == key.first) cover.column = column->second;
				}
				r.covers[r.count++] = cover;
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
	template <class Unfold>
	void add(
		std::vector<Wall>& walls, const std::vector<WallMirror<dim>>& mirrors, const NodeMass<dim>& mass, const NodeVector<dim>& force, Unfold&& unfold)
	{
		for (const Node& r : m_nodes)
			for (int d = 0; d < dim; ++d)
				m_acceleration[d][r.node] = (*mass[d])[r.node] > 0 ? force[d][r.node] / (*mass[d])[r.node] : 0;
		unfold(m_acceleration);
		addToWalls(walls, mirrors, [this](const Node& r, int d) { return r.force[d] - r.mass[d] * m_acceleration[d][r.node]; });
	}
	/* Momentum of the nodes alone, before it is mirrored ... */
	void keepMomentum(const NodeVector<dim>& momentum)
	{
		for (Node& r : m_nodes)
			for (int d = 0; d < dim; ++d)
				r.momentum[d] = momentum[d][r.node];
	}
	/* ... and `rate` times what the walls have taken of it, where it became `velocity` (doc/method.md). */
	void addMomentumLoss(std::vector<Wall>& walls, const std::vector<WallMirror<dim>>& mirrors, const NodeVector<dim>& velocity, double rate) const
	{
		addToWalls(walls, mirrors, [&](const Node& r, int d) { return rate * (r.momentum[d] - r.mass[d] * velocity[d][r.node]); });
	}

private:
	struct Cover { // of a node by a wall: the node lies on the plane or beside it
		int wall;
		int mirror, column; // whose contact decides, of a friction wall; -1: none
	};
	struct Node {
		std::ptrdiff_t             node;
		std::array<Cover, 2 * dim> covers;
		int                        count;
		std::array<double, dim>    mass, force; // of the node alone, before it is mirrored
		std::array<double, dim>    momentum;    // likewise
	};
	std::vector<Node> m_nodes;
	NodeVector<dim>   m_acceleration;

	/* A component of force(node, d) is taken by the wall normal to it, else by a fixed wall, else by friction. */
	template <class Force> void addToWalls(std::vector<Wall>& walls, const std::vector<WallMirror<dim>>& mirrors, Force&& force) const
	{
		for (const Node& r : m_nodes) {
			std::array<int, dim> taker, rank {};
			taker.fill(-1);
			for (int k = 0; k < r.count; ++k) {
				const Cover& cover   = r.covers[k];
				const Wall&  wall    = walls[cover.wall];
				const bool   contact = wall.kind == Wall::Kind::friction;
				const bool   acts    = !contact || (cover.column >= 0 && mirrors[cover.mirror].columns[cover.column].active);
				for (int d = 0; d < dim; ++d) {
					const int mine = acts ? (d == wall.axis ? 4 : wall.kind == Wall::Kind::fixed ? 3 : contact ? 2 : 0) : 1;
					if (mine > rank[d]) rank[d] = mine, taker[d] = cover.wall;
				}
			}
			for (int d = 0; d < dim; ++d)
				if (taker[d] >= 0) walls[taker[d]].force[d] += force(r, d);
		}
	}
};

} // namespace yade::mpm
