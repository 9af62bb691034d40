// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "TileGrid.hpp"

namespace yade::mpm {

template <int dim> using NodeVector = std::array<Column, dim>; // one array over the nodes a component

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
	void fold(std::vector<Wall>& walls, Column& mass, NodeVector<dim>& momentum, NodeVector<dim>& force, double dt)
	{
		if (m_bands.empty()) return;
		for (Wall& wall : walls)
			wall.force = { 0, 0, 0 };
		for (ReactionNode& r : m_reaction) {
			r.mass = mass[r.node];
			for (int d = 0; d < dim; ++d)
				if (r.wall[d] >= 0) walls[r.wall[d]].force[d] += force[d][r.node];
		}
		for (Band& band : m_bands) {
			if (band.friction) decideContact(band, walls[band.wall], mass, momentum, force, dt);
			for (Column_& c : band.columns) {
				if (!c.folded) continue;
				foldMomentum(c, band, walls[band.wall], mass, momentum);
				foldForce(c, band, force);
				if (c.mirror >= 0 && c.ghost >= 0) mass[c.mirror] += mass[c.ghost];
			}
			if (band.friction) applyFriction(band, walls[band.wall], mass, momentum, force, dt);
		}
		for (const ReactionNode& r : m_reaction) // wall force = force on the nodes - mass * their acceleration
			if (mass[r.image] > 0)
				for (int d = 0; d < dim; ++d)
					if (r.wall[d] >= 0) walls[r.wall[d]].force[d] -= r.mass * r.sign[d] * force[d][r.image] / mass[r.image];
	}
	/* Folds a momentum with the masses that fold() has left. */
	void foldMomentum(const std::vector<Wall>& walls, const Column& mass, NodeVector<dim>& momentum) const
	{
		for (const Band& band : m_bands)
			for (const Column_& c : band.columns)
				if (c.folded) {
					// mass[mirror] already holds the ghost's
					foldMomentum(c, band, walls[band.wall], mass, momentum);
				}
	}
	/* Folds mass and force alone, walls at rest; contacts let go. For the stable time step. */
	void foldAtRest(Column* mass, NodeVector<dim>& force) const
	{
		for (const Band& band : m_bands) {
			if (band.friction) continue;
			for (const Column_& c : band.columns) {
				foldForce(c, band, force);
				if (mass && c.mirror >= 0 && c.ghost >= 0) (*mass)[c.mirror] += (*mass)[c.ghost];
			}
		}
	}
	/* Images of a velocity (moving: in the wall's frame) or of a velocity increment. */
	void unfold(const std::vector<Wall>& walls, NodeVector<dim>& field, bool moving) const
	{
		for (auto band = m_bands.rbegin(); band != m_bands.rend(); ++band)
			for (const Column_& c : band->columns) {
				if (!c.folded) continue;
				for (int d = 0; d < dim; ++d) {
					const double w = moving && band->odd[d] ? walls[band->wall].velocity[d] : 0;
					if (c.plane >= 0 && band->odd[d]) field[d][c.plane] = w;
					if (c.ghost < 0) continue;
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
		std::ptrdiff_t plane, ghost, mirror;
		bool           folded, outside; // outside: behind another wall
		double         reaction;        // normal force of the material on the wall, pressing > 0
	};
	struct Band {
		std::size_t           wall;
		bool                  friction;
		std::array<bool, dim> odd;
		std::vector<Column_>  columns;
	};
	struct ReactionNode {
		std::ptrdiff_t       node, image; // image: its mirror image in front of all walls, or itself
		std::array<int, dim> wall, sign;  // which wall takes a component, or -1; sign of the image's acceleration, 0 on a plane
		double               mass;        // of the node alone, before folding
	};
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
				if (other.axis != wall.axis) outside = outside || (node[other.axis] - planeNode(g, other)) * other.side < 0;
			band.columns.push_back({ at(0), at(-1), at(1), wall.kind != Wall::Kind::friction, outside, 0 });
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

	/* Which wall takes which component of the reaction at a node: the wall normal to the component, else a fixed wall. */
	void collectReactionNodes(const TileGrid<dim>& grid, const Geometry<dim>& g, const std::vector<Wall>& walls)
	{
		forEachNode(grid, [&](const typename TileGrid<dim>::Index& node, std::ptrdiff_t at) {
			ReactionNode r { at, at, {}, {}, 0 };
			r.wall.fill(-1), r.sign.fill(1);
			auto image   = node;
			bool covered = false;
			for (std::size_t w = 0; w < walls.size(); ++w) {
				const Wall& wall = walls[w];
				if (wall.kind == Wall::Kind::friction) continue;
				const int depth = (node[wall.axis] - planeNode(g, wall)) * wall.side;
				if (depth < -1 || depth > 1) continue;
				covered = true;
				if (depth < 0) image[wall.axis] = planeNode(g, wall) - depth * wall.side;
				for (int d = 0; d < dim; ++d) {
					const bool normal = d == wall.axis, odd = normal || wall.kind == Wall::Kind::fixed;
					if (!odd) continue;
					r.sign[d] *= depth == 0 ? 0 : depth;
					if (normal || r.wall[d] < 0) r.wall[d] = int(w);
				}
			}
			if (!covered) return;
			r.image = grid.find(image);
			if (r.image >= 0) m_reaction.push_back(r);
		});
	}

	static void foldMomentum(const Column_& c, const Band& band, const Wall& wall, const Column& mass, NodeVector<dim>& momentum)
	{
		for (int d = 0; d < dim; ++d) {
			const double w = wall.velocity[d];
			if (c.plane >= 0 && band.odd[d]) momentum[d][c.plane] = mass[c.plane] * w;
			if (c.mirror < 0 || c.ghost < 0) continue;
			const double ghost = momentum[d][c.ghost];
			momentum[d][c.mirror] += band.odd[d] ? 2 * mass[c.ghost] * w - ghost : ghost;
		}
	}
	static void foldForce(const Column_& c, const Band& band, NodeVector<dim>& force)
	{
		for (int d = 0; d < dim; ++d) {
			if (c.plane >= 0 && band.odd[d]) force[d][c.plane] = 0;
			if (c.mirror < 0 || c.ghost < 0) continue;
			force[d][c.mirror] += band.odd[d] ? -force[d][c.ghost] : force[d][c.ghost];
		}
	}

	/* A column is in contact when it presses on the wall, or when its node on the plane moves into the wall. */
	static void decideContact(Band& band, Wall& wall, const Column& mass, const NodeVector<dim>& momentum, const NodeVector<dim>& force, double dt)
	{
		const int a = wall.axis;
		for (Column_& c : band.columns) {
			c.folded = false;
			if (c.plane < 0 || c.outside || !(mass[c.plane] > 0)) continue;
			double pressing = -wall.side * force[a][c.plane];
			if (c.ghost >= 0 && c.mirror >= 0) {
				const double m0 = mass[c.ghost], m1 = mass[c.mirror], f0 = force[a][c.ghost], f1 = force[a][c.mirror];
				if (m0 + m1 > 0) pressing -= wall.side * (f0 + f1 - (m1 - m0) * (f1 - f0) / (m0 + m1));
			}
			const double gap = wall.side * ((momentum[a][c.plane] + dt * force[a][c.plane]) / mass[c.plane] - wall.velocity[a]);
			c.folded         = pressing > 0 || gap < 0;
			c.reaction       = c.folded ? pressing : 0;
			wall.force[a] -= wall.side * c.reaction;
		}
	}
	/* The tangential impulse that stops the sliding at the plane, or as much of it as Coulomb's law allows. */
	void applyFriction(const Band& band, Wall& wall, const Column& mass, const NodeVector<dim>& momentum, NodeVector<dim>& force, double dt) const
	{
		for (const Column_& c : band.columns) {
			if (!c.folded || !(c.reaction > 0)) continue;
			const bool   two = c.mirror >= 0 && mass[c.mirror] > 0;
			const double w0 = m_N0, w1 = two ? 2 * m_N1 : 0;
			const double weight = w0 * w0 / mass[c.plane] + (two ? w1 * w1 / mass[c.mirror] : 0);
			double       impulse[dim], norm2 = 0;
			for (int d = 0; d < dim; ++d) {
				impulse[d] = 0;
				if (d == wall.axis) continue;
				double slip = w0 * (momentum[d][c.plane] + dt * force[d][c.plane]) / mass[c.plane];
				if (two) slip += w1 * (momentum[d][c.mirror] + dt * force[d][c.mirror]) / mass[c.mirror];
				impulse[d] = -(slip - (w0 + w1) * wall.velocity[d]) / weight;
				norm2 += impulse[d] * impulse[d];
			}
			const double limit = wall.friction * c.reaction * dt, norm = std::sqrt(norm2);
			const double scale = norm > limit ? limit / norm : 1;
			for (int d = 0; d < dim; ++d) {
				if (d == wall.axis) continue;
				force[d][c.plane] += w0 * scale * impulse[d] / dt;
				if (two) force[d][c.mirror] += w1 * scale * impulse[d] / dt;
				wall.force[d] -= (w0 + w1) * scale * impulse[d] / dt;
			}
		}
	}
};

} // namespace yade::mpm
