// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "WallFriction.hpp"
#include "WallReactions.hpp"

namespace yade::mpm {

/* The constraints on the nodes' motion. Each has two hooks in a step: after the sums, where it changes masses, momenta and
forces, and after the update, where it sets velocities. Today the constraints are walls; prescribed points, contacts of
bodies and absorbing boundaries belong here too. */
template <int dim> class NodeConstraints {
public:
	explicit NodeConstraints(std::vector<Wall>& walls)
	    : m_walls(walls)
	{
	}

	/* N0, N1: values of the shape function at a node and one cell from it. */
	void build(const TileGrid<dim>& grid, const Geometry<dim>& geometry, double N0, double N1)
	{
		m_N0 = N0, m_N1 = N1;
		m_mirrors.clear();
		for (std::size_t w = 0; w < m_walls.size(); ++w)
			m_mirrors.emplace_back(grid, geometry, m_walls, w);
		// contacts last, on what the other walls have mirrored
		std::stable_sort(m_mirrors.begin(), m_mirrors.end(), [](const Mirror& a, const Mirror& b) { return a.friction < b.friction; });
		m_reactions.build(grid, geometry, m_walls, m_mirrors);
	}

	/* After the sums of a step: mirrors mass, momentum and force, applies friction, sets the walls' reactions. */
	void afterSums(const NodeMass<dim>& mass, NodeVector<dim>& momentum, NodeVector<dim>& force, double dt)
	{
		if (m_mirrors.empty()) return;
		for (Wall& wall : m_walls)
			wall.force = { 0, 0, 0 };
		m_reactions.keepForces(mass, force);
		for (Mirror& mirror : m_mirrors) {
			const Wall& wall = m_walls[mirror.wall];
			if (mirror.friction) decideContact(mirror, wall, mass, momentum, force, dt);
			for (auto& c : mirror.columns) {
				if (!c.active) continue;
				for (int d = 0; d < dim; ++d)
					c.ghostMass[d] = c.ghost >= 0 ? (*mass[d])[c.ghost] : 0;
				mirror.foldMomentum(c, wall, mass, momentum);
				mirror.foldForce(c, force);
				mirror.foldMass(c, mass);
			}
			if (mirror.friction) applyFriction(mirror, wall, m_N0, m_N1, mass, momentum, force, dt);
		}
		for (const Mirror& mirror : m_mirrors) // a wall one cell further has folded on the planes
			mirror.setPlane(m_walls[mirror.wall], Motion::increment, force);
		m_reactions.add(m_walls, m_mirrors, mass, force, [this](NodeVector<dim>& field) { afterUpdate(field, Motion::increment); });
	}
	/* After the sum of a momentum, or of an increment of it, with the masses and contacts of the step. */
	void afterSums(const NodeMass<dim>& mass, NodeVector<dim>& momentum, Motion motion) const
	{
		for (const Mirror& mirror : m_mirrors)
			for (const auto& c : mirror.columns) {
				if (!c.active) continue;
				if (motion == Motion::velocity)
					mirror.foldMomentum(c, m_walls[mirror.wall], mass, momentum);
				else
					mirror.foldForce(c, momentum);
			}
	}
	/* After the sum of the masses alone. */
	void afterSums(const NodeMass<dim>& mass) const
	{
		for (const Mirror& mirror : m_mirrors)
			for (const auto& c : mirror.columns)
				if (c.active) mirror.foldMass(c, mass);
	}
	/* After the update: velocities, or their increments, on the walls' planes and behind them. */
	void afterUpdate(NodeVector<dim>& field, Motion motion) const
	{
		for (auto mirror = m_mirrors.rbegin(); mirror != m_mirrors.rend(); ++mirror) // planes first: they may be mirror images themselves
			mirror->setPlane(m_walls[mirror->wall], motion, field);
		for (auto mirror = m_mirrors.rbegin(); mirror != m_mirrors.rend(); ++mirror)
			mirror->setImages(m_walls[mirror->wall], motion, field);
	}

	/* For what a later mapping adds to the reactions: the momentum before it is mirrored, then the velocity that it became. */
	void keepMomentum(const NodeVector<dim>& momentum) { m_reactions.keepMomentum(momentum); }
	/* Adds `rate` times the walls' share to their reactions; returns the work of that on moving walls in a step dt [J]. */
	double addMomentumLoss(const NodeVector<dim>& velocity, double rate, double dt)
	{
		const std::vector<Wall> before = m_walls;
		m_reactions.addMomentumLoss(m_walls, m_mirrors, velocity, rate);
		double work = 0;
		for (std::size_t k = 0; k < before.size(); ++k)
			for (std::size_t d = 0; d < 3; ++d)
				work += (m_walls[k].force[d] - before[k].force[d]) * m_walls[k].velocity[d] * dt;
		return work;
	}

	void clearBehind(NodeVector<dim>& field) const
	{
		for (const Mirror& mirror : m_mirrors)
			mirror.clearBehind(field);
	}
	void releaseContacts()
	{
		for (Mirror& mirror : m_mirrors)
			for (auto& c : mirror.columns)
				c.active = !mirror.friction;
	}

private:
	using Mirror = WallMirror<dim>;
	std::vector<Wall>&  m_walls;
	std::vector<Mirror> m_mirrors;
	WallReactions<dim>  m_reactions;
	double              m_N0 = 1, m_N1 = 0;
};

} // namespace yade::mpm
