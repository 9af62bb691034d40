// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "../TileGrid.hpp"

namespace yade::mpm {

template <int dim> using NodeVector = std::array<Column, dim>;  // one array over the nodes a component
template <int dim> using NodeMass   = std::array<Column*, dim>; // lumped mass that a component of the motion has

/* Walls as an operation on the grid.

A wall folds the spline about its plane: a node k behind the wall is node -k in front of it, with sign -1 for the
components that the wall fixes (odd fields) and +1 for the others and for mass (even fields). Because the transfers are
linear, folding the nodal sums after the points have been spread is the same as folding the shape functions, and costs
nothing where there is no wall. Order two is kept at the wall (Steffen et al. 2008, section 4, on the boundary splines
that lose it).

fold() adds the nodes behind the walls to their mirror images, unfold() writes the images back, so that the transfer to
the points needs to know of no wall. A moving wall is folded in its own frame.

A friction wall is a contact: it folds only those columns of nodes that press on it or approach it, and lets go of the
others; Coulomb's law limits its tangential traction, which is spread by the shape functions' values at the plane. */
template <int dim> class WallBand {
public:
	/* N0, N1: values of the shape function at the plane, of the node on it and of the one next to it. */
	void build(const TileGrid<dim>& grid, const Geometry<dim>& geometry, const std::vector<Wall>& walls, double N0, double N1)
	{
		m_N0 = N0, m_N1 = N1;
		m_bands.clear();
		m_reaction.clear();
		for (std::size_t w = 0; w < walls.size(); ++w)
			m_bands.push_back(makeBand(grid, geometry, walls, w));
		// contacts last, on what the other walls have folded
		std::stable_sort(m_bands.begin(), m_bands.end(), [](const Band& a, const Band& b) { return a.friction < b.friction; });
		collectReactionNodes(grid, geometry, walls);
	}

	/* Folds mass, momentum and force, applies friction and sets the walls' reactions. */
	void fold(std::vector<Wall>& walls, const NodeMass<dim>& mass, NodeVector<dim>& momentum, NodeVector<dim>& force, double dt)
	{
		if (m_bands.empty()) return;
		for (Wall& wall : walls)
			wall.force = { 0, 0, 0 };
		for (ReactionNode& r : m_reaction) {
			for (int d = 0; d < dim; ++d)
				r.mass[d] = (*mass[d])[r.node], r.force[d] = force[d][r.node];
		}
		for (Band& band : m_bands) {
			if (band.friction) decideContact(band, walls[band.wall], mass, momentum, force, dt);
			for (Column_& c : band.columns) {
				if (!c.folded) continue;
				for (int d = 0; d < dim; ++d)
					c.ghostMass[d] = c.ghost >= 0 ? (*mass[d])[c.ghost] : 0;
				foldMomentum(c, band, walls[band.wall], mass, momentum);
				foldForce(c, band, force);
				foldMass(c, mass);
			}
			if (band.friction) applyFriction(band, walls[band.wall], mass, momentum, force, dt);
		}
		clearPlanes(force); // a wall one cell further has folded on them
		addReactions(walls, mass, force);
	}
	/* Momentum that points bring to the nodes near the walls, before folding, ... */
	void keepMomentum(const NodeVector<dim>& momentum)
	{
		for (ReactionNode& r : m_reaction)
			for (int d = 0; d < dim; ++d)
				r.momentum[d] = momentum[d][r.node];
	}
	/* ... and the velocities that come of it: `rate` times what the walls have taken of it is added to their reactions (doc/method.md). */
	void addTaken(std::vector<Wall>& walls, const NodeVector<dim>& velocity, double rate) const
	{
		addToWalls(walls, [&](const ReactionNode& r, int d) { return rate * (r.momentum[d] - r.mass[d] * velocity[d][r.node]); });
	}
	/* Folds a momentum with the masses that fold() has met. */
	void foldMomentum(const std::vector<Wall>& walls, const NodeMass<dim>& mass, NodeVector<dim>& momentum) const
	{
		for (const Band& band : m_bands)
			for (const Column_& c : band.columns)
				if (c.folded) foldMomentum(c, band, walls[band.wall], mass, momentum);
	}
	/* Folds force or mass alone, walls at rest; contacts let go. For the stable time step. */
	void foldAtRest(NodeVector<dim>& force) const
	{
		for (const Band& band : m_bands)
			for (const Column_& c : band.columns)
				if (!band.friction) foldForce(c, band, force);
	}
	void foldMassAtRest(const NodeMass<dim>& mass) const
	{
		for (const Band& band : m_bands)
			for (const Column_& c : band.columns)
				if (!band.friction) foldMass(c, mass);
	}
	/* Folds a momentum increment, which vanishes at the walls. */
	void foldMomentumAtRest(NodeVector<dim>& momentum) const
	{
		for (const Band& band : m_bands)
			for (const Column_& c : band.columns)
				if (c.folded) foldForce(c, band, momentum);
	}
	/* Images of a velocity (moving: in the wall's frame) or of a velocity increment. */
	void unfold(const std::vector<Wall>& walls, NodeVector<dim>& field, bool moving) const
	{
		for (auto band = m_bands.rbegin(); band != m_bands.rend(); ++band) // planes first: they may be mirror images themselves
			for (const Column_& c : band->columns)
				for (int d = 0; d < dim && c.folded && c.plane >= 0; ++d)
					if (band->odd[d]) field[d][c.plane] = moving ? walls[band->wall].velocity[d] : 0;
		for (auto band = m_bands.rbegin(); band != m_bands.rend(); ++band)
			for (const Column_& c : band->columns) {
				if (!c.folded || c.ghost < 0) continue;
				for (int d = 0; d < dim; ++d) {
					const double w     = moving && band->odd[d] ? walls[band->wall].velocity[d] : 0;
					const double image = c.mirror >= 0 ? field[d][c.mirror] : w;
					field[d][c.ghost]  = band->odd[d] ? 2 * w - image : image;
				}
			}
	}
	/* Zero where a field is given by its images. */
	void clearBehind(NodeVector<dim>& field) const
	{
		for (const Band& band : m_bands)
			for (const Column_& c : band.columns)
				for (int d = 0; d < dim && c.folded; ++d) {
					if (c.ghost >= 0) field[d][c.ghost] = 0;
					if (c.plane >= 0 && band.odd[d]) field[d][c.plane] = 0;
				}
	}
	void releaseContacts()
	{
		for (Band& band : m_bands)
			for (Column_& c : band.columns)
				c.folded = !band.friction;
	}

private:
	struct Column_ { // of nodes through the wall: on the plane, one behind it, its mirror image; -1 where there is none
		std::ptrdiff_t          plane, ghost, mirror;
		bool                    folded, outside; // outside: behind a wall that is folded before
		double                  reaction;        // normal force of the material on the wall, pressing > 0
		std::array<double, dim> ghostMass;       // when it was folded: walls that come later fold on it
	};
	struct Band {
		std::size_t           wall;
		bool                  friction;
		std::array<bool, dim> odd;
		std::vector<Column_>  columns;
	};
	struct Cover { // of a node by a wall: the node lies on the plane or beside it
		int wall;
		int band, column; // whose contact decides, of a friction wall; -1: none
	};
	struct ReactionNode {
		std::ptrdiff_t             node;
		std::array<Cover, 2 * dim> covers;
		int                        count;
		std::array<double, dim>    mass, force; // of the node alone, before folding
		std::array<double, dim>    momentum;    // likewise
	};
	NodeVector<dim>           m_acceleration; // of the reaction nodes
	std::vector<Band>         m_bands;
	std::vector<ReactionNode> m_reaction;
	double                    m_N0 = 1, m_N1 = 0;

	static int planeNode(const Geometry<dim>& g, const Wall& wall) { return int(wall.side > 0 ? g.xiMin[wall.axis] : g.xiMax[wall.axis]); }

	/* Every node of the grid's blocks that lies on the plane, with those beside it. */
	static Band makeBand(const TileGrid<dim>& grid, const Geometry<dim>& g, const std::vector<Wall>& walls, std::size_t w)
	{
		const Wall& wall = walls[w];
		Band        band { w, wall.kind == Wall::Kind::friction, {}, {} };
		for (int d = 0; d < dim; ++d)
			band.odd[d] = d == wall.axis || wall.kind == Wall::Kind::fixed;
		const int plane = planeNode(g, wall);
		forEachNode(grid, [&](const typename TileGrid<dim>::Index& node, std::ptrdiff_t) {
			if (node[wall.axis] != plane && node[wall.axis] != plane - wall.side) return;
			auto at = [&](int k) {
				auto n       = node;
				n[wall.axis] = plane + k * wall.side;
				return grid.find(n);
			};
			const bool onPlane = node[wall.axis] == plane;
			if (!onPlane && at(0) >= 0) return; // its column is counted at the plane
			bool outside = false;
			for (const Wall& other : walls)
				if (other.axis != wall.axis && (other.kind != Wall::Kind::friction || &other < &wall))
					outside = outside || (node[other.axis] - planeNode(g, other)) * other.side < 0;
			band.columns.push_back({ at(0), at(-1), at(1), wall.kind != Wall::Kind::friction, outside, 0, {} });
		});
		return band;
	}
	template <class Visit> static void forEachNode(const TileGrid<dim>& grid, Visit&& visit)
	{
		for (std::size_t b = 0; b < grid.blocks().size(); ++b)
			for (int local = 0; local < TileGrid<dim>::nodes; ++local) {
				auto node = grid.blocks()[b];
				for (int d = 0, rest = local; d < dim; ++d, rest >>= TileGrid<dim>::log2Width)
					node[d] = node[d] * TileGrid<dim>::width + (rest & (TileGrid<dim>::width - 1));
				visit(node, std::ptrdiff_t(b) * TileGrid<dim>::nodes + local);
			}
	}

	/* Nodes through which a wall may act, with the walls that cover them. */
	void collectReactionNodes(const TileGrid<dim>& grid, const Geometry<dim>& g, const std::vector<Wall>& walls)
	{
		using Index = typename TileGrid<dim>::Index;
		auto depth  = [&](const Index& node, const Wall& wall) { return (node[wall.axis] - planeNode(g, wall)) * wall.side; };
		std::vector<std::vector<std::pair<std::ptrdiff_t, int>>> feet(m_bands.size()); // columns of contacts, by their node on the plane
		for (std::size_t b = 0; b < m_bands.size(); ++b)
			for (std::size_t c = 0; m_bands[b].friction && c < m_bands[b].columns.size(); ++c)
				feet[b].push_back({ m_bands[b].columns[c].plane, int(c) });
		for (auto& f : feet)
			std::sort(f.begin(), f.end());
		forEachNode(grid, [&](const Index& node, std::ptrdiff_t at) {
			ReactionNode r { at, {}, 0, {}, {}, {} };
			for (std::size_t b = 0; b < m_bands.size() && r.count < 2 * dim; ++b) {
				const Wall& wall = walls[m_bands[b].wall];
				if (std::abs(depth(node, wall)) > 1) continue;
				Cover cover { int(m_bands[b].wall), int(b), -1 };
				if (m_bands[b].friction) {
					Index foot      = node; // of the column, in front of the other walls
					foot[wall.axis] = planeNode(g, wall);
					for (const Wall& other : walls)
						if (other.axis != wall.axis && depth(foot, other) < 0)
							foot[other.axis] = 2 * planeNode(g, other) - foot[other.axis];
					const std::pair<std::ptrdiff_t, int> key { grid.find(foot), 0 };
					const auto                           column = std::lower_bound(feet[b].begin(), feet[b].end(), key);
					if (key.first >= 0 && column != feet[b].end() && column->first == key.first) cover.column = column->second;
				}
				r.covers[r.count++] = cover;
			}
			if (r.count > 0) m_reaction.push_back(r);
		});
		for (Column& c : m_acceleration)
			c.assign(m_reaction.empty() ? 0 : grid.nodeCount(), 0);
	}
	/* Force on a wall = force on the nodes - their mass times their acceleration. */
	void addReactions(std::vector<Wall>& walls, const NodeMass<dim>& mass, const NodeVector<dim>& force)
	{
		for (const ReactionNode& r : m_reaction)
			for (int d = 0; d < dim; ++d)
				m_acceleration[d][r.node] = (*mass[d])[r.node] > 0 ? force[d][r.node] / (*mass[d])[r.node] : 0;
		unfold(walls, m_acceleration, false);
		addToWalls(walls, [this](const ReactionNode& r, int d) { return r.force[d] - r.mass[d] * m_acceleration[d][r.node]; });
	}
	/* A component of force(node, d) is taken by the wall normal to it, else by a fixed wall, else by friction. */
	template <class Force> void addToWalls(std::vector<Wall>& walls, Force&& force) const
	{
		for (const ReactionNode& r : m_reaction) {
			std::array<int, dim> taker, rank {};
			taker.fill(-1);
			for (int k = 0; k < r.count; ++k) {
				const Cover& cover   = r.covers[k];
				const Wall&  wall    = walls[cover.wall];
				const bool   contact = wall.kind == Wall::Kind::friction;
				const bool   acts    = !contact || (cover.column >= 0 && m_bands[cover.band].columns[cover.column].folded);
				for (int d = 0; d < dim; ++d) {
					const int mine = acts ? (d == wall.axis ? 4 : wall.kind == Wall::Kind::fixed ? 3 : contact ? 2 : 0) : 1;
					if (mine > rank[d]) rank[d] = mine, taker[d] = cover.wall;
				}
			}
			for (int d = 0; d < dim; ++d)
				if (taker[d] >= 0) walls[taker[d]].force[d] += force(r, d);
		}
	}

	static void foldMass(const Column_& c, const NodeMass<dim>& mass)
	{
		if (c.mirror < 0 || c.ghost < 0) return;
		for (int d = 0; d < dim; ++d)
			if (d == 0 || mass[d] != mass[d - 1]) (*mass[d])[c.mirror] += (*mass[d])[c.ghost];
	}
	static void foldMomentum(const Column_& c, const Band& band, const Wall& wall, const NodeMass<dim>& mass, NodeVector<dim>& momentum)
	{
		for (int d = 0; d < dim; ++d) {
			const double w = wall.velocity[d];
			if (c.plane >= 0 && band.odd[d]) momentum[d][c.plane] = (*mass[d])[c.plane] * w;
			if (c.mirror < 0 || c.ghost < 0) continue;
			const double ghost = momentum[d][c.ghost];
			momentum[d][c.mirror] += band.odd[d] ? 2 * c.ghostMass[d] * w - ghost : ghost;
		}
	}
	void clearPlanes(NodeVector<dim>& force) const
	{
		for (const Band& band : m_bands)
			for (const Column_& c : band.columns)
				for (int d = 0; d < dim && c.folded && c.plane >= 0; ++d)
					if (band.odd[d]) force[d][c.plane] = 0;
	}
	static void foldForce(const Column_& c, const Band& band, NodeVector<dim>& force)
	{
		for (int d = 0; d < dim; ++d) {
			if (c.plane >= 0 && band.odd[d]) force[d][c.plane] = 0;
			if (c.mirror < 0 || c.ghost < 0) continue;
			force[d][c.mirror] += band.odd[d] ? -force[d][c.ghost] : force[d][c.ghost];
		}
	}

	/* A column is in contact when its node on the plane moves into the wall, or when it presses on the wall while that node
	leaves: the near points of a compressed body do, as it rebounds. An impulse that is nothing beside the node's momentum
	away from the wall is rounding, and no contact. */
	static void decideContact(
		Band& band, const Wall& wall, const NodeMass<dim>& masses, const NodeVector<dim>& momentum, const NodeVector<dim>& force, double dt)
	{
		const int     a    = wall.axis;
		const Column& mass = *masses[a];
		for (Column_& c : band.columns) {
			c.folded = false;
			if (c.plane < 0 || c.outside || !(mass[c.plane] > 0)) continue;
			double pressing = -wall.side * force[a][c.plane];
			if (c.ghost >= 0 && c.mirror >= 0) {
				const double m0 = mass[c.ghost], m1 = mass[c.mirror], f0 = force[a][c.ghost], f1 = force[a][c.mirror];
				if (m0 + m1 > 0) pressing -= wall.side * (f0 + f1 - (m1 - m0) * (f1 - f0) / (m0 + m1));
			}
			const double gap = wall.side * ((momentum[a][c.plane] + dt * force[a][c.plane]) / mass[c.plane] - wall.velocity[a]);
			c.folded         = gap < 0 || pressing * dt > 1e-3 * mass[c.plane] * gap;
			c.reaction       = c.folded ? pressing : 0;
		}
	}
	/* The tangential impulse that stops the sliding at the plane, or as much of it as Coulomb's law allows. */
	void applyFriction(
		const Band& band, const Wall& wall, const NodeMass<dim>& mass, const NodeVector<dim>& momentum, NodeVector<dim>& force, double dt) const
	{
		for (const Column_& c : band.columns) {
			if (!c.folded || !(c.reaction > 0)) continue;
			const double w0 = m_N0, w1       = 2 * m_N1;
			double       impulse[dim], norm2 = 0;
			bool         two = c.mirror >= 0;
			for (int d = 0; d < dim; ++d)
				two = two && (d == wall.axis || (*mass[d])[c.mirror] > 0);
			for (int d = 0; d < dim; ++d) {
				impulse[d] = 0;
				if (d == wall.axis) continue;
				const double m0 = (*mass[d])[c.plane], m1 = two ? (*mass[d])[c.mirror] : 1;
				if (!(m0 > 0)) continue; // on the axis nothing slides
				double slip = w0 * (momentum[d][c.plane] + dt * force[d][c.plane]) / m0, weight = w0 * w0 / m0, sum = w0;
				if (two) slip += w1 * (momentum[d][c.mirror] + dt * force[d][c.mirror]) / m1, weight += w1 * w1 / m1, sum += w1;
				impulse[d] = -(slip - sum * wall.velocity[d]) / weight;
				norm2 += impulse[d] * impulse[d];
			}
			const double limit = wall.friction * c.reaction * dt, norm = std::sqrt(norm2);
			const double scale = norm > limit ? limit / norm : 1;
			for (int d = 0; d < dim; ++d) {
				if (d == wall.axis) continue;
				force[d][c.plane] += w0 * scale * impulse[d] / dt;
				if (two) force[d][c.mirror] += w1 * scale * impulse[d] / dt;
			}
		}
	}
};

} // namespace yade::mpm
