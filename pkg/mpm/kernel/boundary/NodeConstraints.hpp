// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "WallReactions.hpp"

namespace yade::mpm {

/* The mirrors among the constraints on the nodes' motion. Each has two hooks in a step: after the sums, where it changes masses,
momenta and forces, and after the update, where it sets velocities. Contacts and prescribed points act between the two (solver/). */
template <int dim> class NodeConstraints {
	using V = std::array<double, dim>;

public:
	explicit NodeConstraints(std::vector<Wall>& walls)
	    : m_walls(walls)
	{
	}
	void build(const TileGrid<dim>& grid, const Geometry<dim>& geometry)
	{
		m_mirrors.clear();
		for (std::size_t w = 0; w < m_walls.size(); ++w)
			if (m_walls[w].mirrors()) m_mirrors.emplace_back(grid, geometry, m_walls, w);
		m_reactions.build(grid, geometry, m_walls, m_mirrors);
		m_covered.clear();
	}
	bool mirrors() const { return !m_mirrors.empty(); }

	/* After the sums of a step: mirrors mass, momentum and force, sets the walls' reactions. */
	void afterSums(const NodeMass<dim>& mass, NodeVector<dim>& momentum, NodeVector<dim>& force)
	{
		if (m_mirrors.empty()) return;
		for (const Mirror& mirror : m_mirrors)
			m_walls[mirror.wall].force = { 0, 0, 0 };
		m_reactions.keepForces(mass, force);
		for (Mirror& mirror : m_mirrors)
			for (auto& c : mirror.columns) {
				for (int d = 0; d < dim; ++d)
					c.ghostMass[d] = c.ghost >= 0 ? (*mass[d])[c.ghost] : 0;
				mirror.foldMomentum(c, m_walls[mirror.wall], mass, momentum);
				mirror.foldForce(c, force);
				mirror.foldMass(c, mass);
			}
		for (const Mirror& mirror : m_mirrors) // a wall one cell further has folded on the planes
			mirror.setPlane(m_walls[mirror.wall], Motion::increment, force);
		m_reactions.add(m_walls, mass, force, [this](NodeVector<dim>& field) { afterUpdate(field, Motion::increment); });
	}
	/* After the sum of a momentum, or of an increment of it, with the masses of the step. */
	void afterSums(const NodeMass<dim>& mass, NodeVector<dim>& momentum, Motion motion) const
	{
		for (const Mirror& mirror : m_mirrors)
			for (const auto& c : mirror.columns) {
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
				mirror.foldMass(c, mass);
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
		m_reactions.addMomentumLoss(m_walls, velocity, rate);
		double work = 0;
		for (std::size_t k = 0; k < before.size(); ++k)
			for (std::size_t d = 0; d < 3; ++d)
				work += (m_walls[k].force[d] - before[k].force[d]) * m_walls[k].velocity[d] * dt;
		return work;
	}
	/* Impulses act on the nodes between these two: what mirrors take of them is added to their reactions. */
	void keepIncrements(const NodeVector<dim>& increment) { m_reactions.keepIncrements(increment); }
	void addImpulses(const NodeVector<dim>& impulse, const NodeVector<dim>& increment, double dt)
	{
		m_reactions.addImpulses(m_walls, impulse, increment, dt);
	}
	void clearBehind(NodeVector<dim>& field) const
	{
		for (const Mirror& mirror : m_mirrors)
			mirror.clearBehind(field);
	}

	/* The node that moves for a node behind a mirror or on its plane, in the same position of the arrays, or -1:
	v = still + sign v_image for each component. */
	struct Image {
		std::ptrdiff_t node;
		V              sign, still;
	};
	Image imageOf(std::ptrdiff_t node)
	{
		Image image { node, {}, {} };
		image.sign.fill(1);
		if (m_mirrors.empty()) return image;
		if (m_covered.empty()) findCovered();
		const std::size_t count = m_mirrors.size();
		for (std::size_t k = 0; k < 2 * count && image.node >= 0; ++k) { // twice: an image may lie behind an earlier mirror
			const std::size_t m = k % count;
			const Covered     key { image.node, m, 0 };
			const auto        at = std::lower_bound(m_covered.begin(), m_covered.end(), key);
			if (at == m_covered.end() || at->node != image.node || at->mirror != m) continue;
			const Mirror& mirror  = m_mirrors[m];
			const auto&   column  = mirror.columns[at->column];
			const bool    onPlane = column.plane == image.node;
			for (std::size_t d = 0; d < dim; ++d) {
				if (!mirror.odd[d]) continue;
				image.still[d] += (onPlane ? 1 : 2) * image.sign[d] * m_walls[mirror.wall].velocity[d];
				image.sign[d] *= onPlane ? 0 : -1;
			}
			if (!onPlane) image.node = column.mirror;
		}
		return image;
	}

private:
	using Mirror = WallMirror<dim>;
	struct Covered { // a node on the plane of a mirror or behind it
		std::ptrdiff_t node;
		std::size_t    mirror, column;
		bool           operator<(const Covered& o) const { return node != o.node ? node < o.node : mirror < o.mirror; }
	};
	std::vector<Wall>&   m_walls;
	std::vector<Mirror>  m_mirrors;
	WallReactions<dim>   m_reactions;
	std::vector<Covered> m_covered; // sorted; found when a contact first needs it

	void findCovered()
	{
		for (std::size_t m = 0; m < m_mirrors.size(); ++m)
			for (std::size_t c = 0; c < m_mirrors[m].columns.size(); ++c)
				for (const std::ptrdiff_t node : { m_mirrors[m].columns[c].plane, m_mirrors[m].columns[c].ghost })
					if (node >= 0) m_covered.push_back({ node, m, c });
		std::sort(m_covered.begin(), m_covered.end());
	}
};

} // namespace yade::mpm
