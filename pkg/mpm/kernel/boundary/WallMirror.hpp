// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "../Geometry.hpp"
#include "../TileGrid.hpp"

namespace yade::mpm {

/* What a constraint makes of a nodal field: a velocity becomes that of the boundary, an increment of it vanishes there. */
enum class Motion { velocity, increment };

/* A wall as a mirror of the shape functions.

A node k behind the wall is node -k in front of it, with sign -1 for the components that the wall fixes (odd fields) and +1
for the others and for mass (even fields). Because the transfers are linear, adding the nodal sums behind the wall to their
mirror images (fold) after the points have been spread is the same as mirroring the shape functions, and it costs nothing
where there is no wall. Images written back (unfold) spare the transfer to the points any knowledge of walls. Order two is
kept at the wall (Steffen, Kirby & Berzins 2008, section 4, on the boundary splines that lose it). A moving wall is mirrored
in its own frame. */
template <int dim> struct WallMirror {
	struct Column { // of nodes through the wall: on the plane, one behind it, its mirror image; -1 where there is none
		std::ptrdiff_t          plane, ghost, mirror;
		std::array<double, dim> ghostMass; // when it was folded: walls that come later fold on it
	};
	std::size_t           wall;
	std::array<bool, dim> odd;
	std::vector<Column>   columns;

	/* Index of the plane's nodes along the wall's axis. */
	static int planeNode(const Geometry<dim>& g, const Wall& wall) { return int(wall.side > 0 ? g.xiMin[wall.axis] : g.xiMax[wall.axis]); }

	/* Of every node of the grid's blocks that lies on the plane, or beside it where there is none on the plane. */
	WallMirror(const TileGrid<dim>& grid, const Geometry<dim>& g, const std::vector<Wall>& walls, std::size_t w)
	    : wall(w)
	{
		const Wall& self = walls[w];
		for (int d = 0; d < dim; ++d)
			odd[d] = d == self.axis || self.kind == Wall::Kind::fixed;
		const int plane = planeNode(g, self);
		grid.forEachNode([&](const typename TileGrid<dim>::Index& node, std::ptrdiff_t, int group) {
			if (node[self.axis] != plane && node[self.axis] != plane - self.side) return;
			auto at = [&](int k) {
				auto n       = node;
				n[self.axis] = plane + k * self.side;
				return grid.find(n, group);
			};
			const bool onPlane = node[self.axis] == plane;
			if (!onPlane && at(0) >= 0) return; // its column is counted at the plane
			columns.push_back({ at(0), at(-1), at(1), {} });
		});
	}

	static void foldMass(const Column& c, const NodeMass<dim>& mass)
	{
		if (c.mirror < 0 || c.ghost < 0) return;
		for (int d = 0; d < dim; ++d)
			if (d == 0 || mass[d] != mass[d - 1]) (*mass[d])[c.mirror] += (*mass[d])[c.ghost];
	}
	/* A momentum, in the frame of the wall. */
	void foldMomentum(const Column& c, const Wall& self, const NodeMass<dim>& mass, NodeVector<dim>& momentum) const
	{
		for (int d = 0; d < dim; ++d) {
			const double w = self.velocity[d];
			if (c.plane >= 0 && odd[d]) momentum[d][c.plane] = (*mass[d])[c.plane] * w;
			if (c.mirror < 0 || c.ghost < 0) continue;
			const double ghost = momentum[d][c.ghost];
			momentum[d][c.mirror] += odd[d] ? 2 * c.ghostMass[d] * w - ghost : ghost;
		}
	}
	/* A force, or an increment of momentum: it vanishes at the wall. */
	void foldForce(const Column& c, NodeVector<dim>& force) const
	{
		for (int d = 0; d < dim; ++d) {
			if (c.plane >= 0 && odd[d]) force[d][c.plane] = 0;
			if (c.mirror < 0 || c.ghost < 0) continue;
			force[d][c.mirror] += odd[d] ? -force[d][c.ghost] : force[d][c.ghost];
		}
	}
	/* Nodes on the plane take the wall's motion ... */
	void setPlane(const Wall& self, Motion motion, NodeVector<dim>& field) const
	{
		for (const Column& c : columns)
			for (int d = 0; d < dim && c.plane >= 0; ++d)
				if (odd[d]) field[d][c.plane] = motion == Motion::velocity ? self.velocity[d] : 0;
	}
	/* ... and those behind it their images. */
	void setImages(const Wall& self, Motion motion, NodeVector<dim>& field) const
	{
		for (const Column& c : columns) {
			if (c.ghost < 0) continue;
			for (int d = 0; d < dim; ++d) {
				const double w     = motion == Motion::velocity && odd[d] ? self.velocity[d] : 0;
				const double image = c.mirror >= 0 ? field[d][c.mirror] : w;
				field[d][c.ghost]  = odd[d] ? 2 * w - image : image;
			}
		}
	}
	/* Zero where a field is given by its images. */
	void clearBehind(NodeVector<dim>& field) const
	{
		for (const Column& c : columns)
			for (int d = 0; d < dim; ++d) {
				if (c.ghost >= 0) field[d][c.ghost] = 0;
				if (c.plane >= 0 && odd[d]) field[d][c.plane] = 0;
			}
	}
};

} // namespace yade::mpm
