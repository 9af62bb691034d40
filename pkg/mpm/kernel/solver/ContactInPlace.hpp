// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "../boundary/ContactImpulses.hpp"
#include "../boundary/NearestOfHull.hpp"
#include "../boundary/Surface.hpp"
#include "../laws/Law.hpp"
#include "PointChecks.hpp"
#include "PointShares.hpp"
#include "Solver.hpp"
#include "TileReport.hpp"

namespace yade::mpm {

/* Contacts of the points' surfaces with walls of kind friction and with points of other groups, between the sums of a step and
the motion of its points.

A point meets the convex hull of the points of another group around it: the normal is that from the nearest place of the hull to
the point, the gap what the distance has more than the reach of both. So a flat face is flat though points make it, and each
side of a pair sees the other: every contact has half the stiffness. Both sides take the impulse at one place, with levers to it:
neither momentum nor moment is lost.

The forces of the last step enter the sums as external forces do, so that Cundall's damping leaves a reaction alone that holds
the balance; what the step adds to them are the impulses of ContactImpulses.hpp. A contact's stiffness is that of the material
between point and surface, E V/(2 r^2) with half the point's size r, times `stiffness`. */
template <class D> class ContactInPlace {
	static constexpr int dim = D::dim;
	using V                  = std::array<double, dim>;
	using V3                 = std::array<double, 3>;
	using Shares             = PointShares<D>;

public:
	/* Points have been added or moved by hand. */
	void pointsChanged() { m_fresh = true; }
	/* After the sums: finds the contacts and adds their last forces to the nodes' forces. */
	void begin(D& d, const StepControl& control, const std::vector<Law>& laws, std::vector<Wall>& walls)
	{
		m_impulses.clear(), m_sides.clear(), m_order.clear();
		for (std::size_t w = 0; w < walls.size(); ++w)
			if (!walls[w].mirrors()) walls[w].setPlane(), m_order.push_back(w);
		if (m_order.empty()) {
			if (d.transfer.points.group.empty()) d.transfer.points.contactForces.clear();
			if (d.transfer.points.group.empty()) return;
		}
		// the order in which walls act is theirs, not that of a list
		std::sort(m_order.begin(), m_order.end(), [&](std::size_t a, std::size_t b) {
			return std::tie(walls[a].normal, walls[a].origin, a) < std::tie(walls[b].normal, walls[b].origin, b);
		});
		const auto& tiles = d.transfer.grid.tiles();
		for (std::size_t t = 0; t < tiles.size(); ++t)
			searchTile(d, control, laws, walls, t);
		if (!d.transfer.points.group.empty()) searchGroups(d, control, laws);
		for (const Side& side : m_sides) {
			const Contact<dim>& c = m_impulses.contacts[side.contact];
			V                   force;
			for (std::size_t a = 0; a < dim; ++a)
				force[a] = side.sign * c.impulse[a] / control.dt;
			Shares::addForce(tiles[side.tile], d.transfer.weights(tiles[side.tile], side.point), side.lever, force, d.fields.force);
		}
	}
	/* Whether impulses can act in this step. */
	bool acts() const { return !m_sides.empty(); }
	/* After the update: finds the impulses and the walls' reactions. raw, where given, receives the impulses beyond those of the last
	step, before mirrors act on them. */
	void finish(D& d, const StepControl& control, std::vector<Wall>& walls, NodeVector<dim>* raw)
	{
		m_before.clear();
		for (const std::size_t w : m_order)
			walls[w].force = walls[w].torque = { 0, 0, 0 };
		if (m_order.empty() && d.transfer.points.group.empty()) return;
		const auto& tiles = d.transfer.grid.tiles();
		std::size_t last  = nowhere; // sides of a contact follow each other
		for (const Side& side : m_sides) {
			Contact<dim>& c = m_impulses.contacts[side.contact];
			if (side.contact != last) c.range = m_impulses.shares.begin();
			last = side.contact;
			Shares::add(d, tiles[side.tile], d.transfer.weights(tiles[side.tile], side.point), side.lever, side.sign, m_impulses.shares, c.range);
		}
		if (raw) {
			for (const Contact<dim>& c : m_impulses.contacts)
				m_before.push_back(c.impulse);
		}
		m_impulses.solve(d.fields.velocity, d.fields.velocityIncrement, control.dt);
		for (const Side& side : m_sides) {
			if (!raw) break;
			V change = m_impulses.contacts[side.contact].impulse;
			for (std::size_t a = 0; a < dim; ++a)
				change[a] = side.sign * (change[a] - m_before[side.contact][a]);
			Shares::addForce(tiles[side.tile], d.transfer.weights(tiles[side.tile], side.point), side.lever, change, *raw);
		}
		for (const Contact<dim>& c : m_impulses.contacts) {
			if (c.other < 0) continue;
			Wall& wall = walls[std::size_t(c.other)];
			V3    arm {}, force {};
			for (std::size_t a = 0; a < dim; ++a)
				arm[a] = c.place[a] - wall.origin[a], force[a] = c.impulse[a] / control.dt, wall.force[a] -= force[a];
			const V3 moment = cross(arm, force);
			for (std::size_t a = 0; a < 3; ++a)
				wall.torque[a] -= moment[a];
		}
		m_fresh = false;
	}
	/* Points that take an impulse move with the velocities that strain the material, as points in contact with bodies of YADE do
	(ContactPoints.hpp): any other motion of the surface would give or take energy of the contact's springs. */
	void move(D& d, double dt, std::vector<TileReport>& reports)
	{
		m_impulses.advanceSlips(d.fields.velocity, dt);
		remember(d.transfer.points, dt);
		Points&            P    = d.transfer.points;
		const auto&        g    = d.transfer.geometry;
		std::size_t        read = nowhere;
		typename D::Values v[dim];
		for (const Side& side : m_sides) {
			const V& impulse = m_impulses.contacts[side.contact].impulse;
			if (std::all_of(impulse.begin(), impulse.end(), [](double x) { return x == 0; })) continue;
			const auto& tile = d.transfer.grid.tiles()[side.tile];
			for (int a = 0; a < dim && side.tile != read; ++a)
				D::Patch::read(tile, d.fields.velocity[a], v[a]);
			read         = side.tile;
			const auto w = d.transfer.weights(tile, side.point);
			for (std::size_t a = 0; a < dim; ++a) {
				if (!P.prescribedDofs.empty() && P.prescribedDofs[side.point] >> a & 1) continue;
				P.displacementIncrement[a][side.point] = dt * w.gather(v[a]);
				const double xi                        = g.xi(int(a), P.position[a][side.point] + P.displacementIncrement[a][side.point]);
				const double inTile = xi - D::Shape::shift(d.transfer.halfSize(int(a), side.point)) - tile.index[a] * D::T::Grid::width;
				reports[side.tile].left |= !(inTile >= 0 && inTile < D::T::Grid::width && xi >= g.xiMin[a] && xi <= g.xiMax[a]);
			}
		}
	}

private:
	struct Side { // a point that takes part in a contact, with a share of its impulse
		std::size_t contact, tile, point;
		V           lever;
		double      sign;
	};
	static constexpr std::size_t nowhere = std::size_t(-1);
	ContactImpulses<dim>         m_impulses;
	std::vector<Side>            m_sides;  // in the order of contacts
	std::vector<V>               m_before; // impulses of the last step
	std::vector<std::size_t>     m_order;  // walls

	static constexpr double stiffness = .25;

	/* Keeps force and slip of the contacts that act. */
	void remember(Points& P, double dt) const
	{
		P.contactForces.clear();
		for (const Contact<dim>& c : m_impulses.contacts) {
			SurfaceForce kept { c.point, c.other, {}, {} };
			bool         acts = false;
			for (std::size_t a = 0; a < dim; ++a)
				kept.force[a] = c.impulse[a] / dt, kept.slip[a] = c.slip[a], acts = acts || c.impulse[a] != 0;
			if (acts) P.contactForces.push_back(kept);
		}
		std::sort(P.contactForces.begin(), P.contactForces.end());
	}
	static V3 cross(const V3& a, const V3& b) { return { a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0] }; }

	/* The part of a wall that lies nearest to x: its place, the direction from it to x, and whether x is beside the wall's extent. */
	struct Nearest {
		V      place, normal;
		double distance;
		bool   edge;
	};
	static Nearest nearest(const Wall& wall, const V& x)
	{
		V3     r {}, n = wall.normal, on {};
		double height = 0;
		for (std::size_t a = 0; a < dim; ++a)
			r[a] = x[a] - wall.origin[a], height += n[a] * r[a];
		for (std::size_t a = 0; a < 3; ++a)
			on[a] = r[a] - height * n[a];
		const V3 flat = on;
		if (wall.extent.size() == 1) {
			const double length = std::sqrt(on[0] * on[0] + on[1] * on[1] + on[2] * on[2]);
			for (double& component : on)
				component *= length > wall.extent[0] ? wall.extent[0] / length : 1;
		} else if (wall.extent.size() == 2) {
			const V3 sides[2] = { wall.along, cross(n, wall.along) };
			on                = { 0, 0, 0 };
			for (std::size_t k = 0; k < 2; ++k) {
				double s = 0;
				for (std::size_t a = 0; a < 3; ++a)
					s += flat[a] * sides[k][a];
				s = std::min(std::max(s, -wall.extent[k]), wall.extent[k]);
				for (std::size_t a = 0; a < 3; ++a)
					on[a] += s * sides[k][a];
			}
		}
		Nearest found { {}, {}, height, false };
		double  beside = 0;
		for (std::size_t a = 0; a < 3; ++a)
			beside += (flat[a] - on[a]) * (flat[a] - on[a]);
		found.edge = beside > 0 && !wall.extent.empty() && std::sqrt(beside) > 1e-12 * (std::abs(height) + std::sqrt(beside));
		if (found.edge) found.distance = std::sqrt(beside + height * height);
		for (std::size_t a = 0; a < dim; ++a) {
			found.place[a]  = wall.origin[a] + on[a];
			found.normal[a] = found.edge ? (r[a] - on[a]) / found.distance : n[a];
		}
		return found;
	}
	static V velocityOf(const Wall& wall, const V& place)
	{
		V3 arm {};
		for (std::size_t a = 0; a < dim; ++a)
			arm[a] = place[a] - wall.origin[a];
		const V3 turning = cross(wall.angularVelocity, arm);
		V        v;
		for (std::size_t a = 0; a < dim; ++a)
			v[a] = wall.velocity[a] + turning[a];
		return v;
	}

	void searchTile(D& d, const StepControl& control, const std::vector<Law>& laws, const std::vector<Wall>& walls, std::size_t t)
	{
		const auto&   tile   = d.transfer.grid.tiles()[t];
		const auto&   g      = d.transfer.geometry;
		const Points& P      = d.transfer.points;
		constexpr int width  = D::T::Grid::width;
		double        margin = 0; // of cells: reach and motion of a point
		for (const double cell : g.cell)
			margin = std::max(margin, 3 * cell);
		for (const std::size_t w : m_order) {
			const Wall& wall  = walls[w];
			double      lower = 0;
			for (std::size_t a = 0; a < dim; ++a) {
				const double middle = g.origin[a] + (tile.index[a] * width + .5 * width + 1) * g.cell[a], half = (.5 * width + 1) * g.cell[a];
				lower += wall.normal[a] * (middle - wall.origin[a]) - std::abs(wall.normal[a]) * half;
			}
			if (lower > margin) continue;
			for (std::size_t p = tile.begin; p < tile.end; ++p)
				searchPoint(d, control, laws, wall, w, t, p, P);
		}
	}
	void searchPoint(
		D& d, const StepControl& control, const std::vector<Law>& laws, const Wall& wall, std::size_t w, std::size_t t, std::size_t p, const Points& P)
	{
		V x;
		for (std::size_t a = 0; a < dim; ++a)
			x[a] = P.position[a][p];
		const Nearest at = nearest(wall, x);
		if (at.distance < 0 && (!wall.extent.empty() || at.distance < -.5 * P.size[p])) {
			if (wall.extent.empty())
				PointChecks<dim, typename D::Shape>(d.transfer)
					.fail(p, "has left the walls", "check that walls and points overlap as meant, reduce O.dt, or refine the points",
						control.time);
			return;
		}
		const double size = P.size[p];
		if (at.distance > 3 * largestCell(d) + 2 * size) return;
		const V lever = leverToSurface<dim>(P, p, at.normal);
		V       place, motion = velocityOf(wall, at.place);
		double  gap = at.distance, approach = 0;
		for (std::size_t a = 0; a < dim; ++a) {
			place[a] = x[a] + lever[a];
			gap += lever[a] * at.normal[a];
			approach += (P.velocity[a][p] - motion[a]) * at.normal[a];
		}
		if (gap - 2 * control.dt * std::max(0., -approach) > .1 * size) return;
		Contact<dim> c;
		c.point = P.id[p], c.other = int(w);
		c.normal = at.normal, c.place = place, c.otherVelocity = velocityOf(wall, place);
		c.gap = gap, c.friction = wall.friction;
		c.softness = softness(P, laws, control.dt, p) * yielding(gap / size);
		recall(P, control.dt, c);
		m_sides.push_back({ m_impulses.contacts.size(), t, p, lever, 1 });
		m_impulses.contacts.push_back(c);
	}
	static double largestCell(const D& d) { return *std::max_element(d.transfer.geometry.cell.begin(), d.transfer.geometry.cell.end()); }
	/* Softness under a gap in sizes of a point, over that at none: springs stiffen with penetration, so that soft bodies do not sink in.
	The secant at the start of the step and the place at its middle keep the loss of a linear spring: no step gains energy. */
	static double yielding(double gap)
	{
		constexpr double doubled = .08; // penetration at which the stiffness is twice that of the first touch
		return 1 / (1 + std::max(-gap, 0.) / doubled);
	}
	/* 2/(k dt^2) of a point. */
	static double softness(const Points& P, const std::vector<Law>& laws, double dt, std::size_t p)
	{
		const Law& law = laws[std::size_t(P.material[p])];
		return P.size[p] * P.size[p] / (stiffness * law.elastic.young * P.volume0[p] * dt * dt);
	}

	// ---- points of other groups ------------------------------------------------------------------------------------------

	using Vector = typename NearestOfHull<dim>::Vector;
	struct Placed { // a point near another group
		std::array<int, dim> bin;
		int                  group;
		std::size_t          tile, point;
		bool operator<(const Placed& o) const { return bin != o.bin ? bin < o.bin : group != o.group ? group < o.group : point < o.point; }
	};
	std::vector<Placed> m_placed; // by bins

	void searchGroups(D& d, const StepControl& control, const std::vector<Law>& laws)
	{
		const auto&   tiles = d.transfer.grid.tiles();
		const Points& P     = d.transfer.points;
		double        size  = 0;
		m_placed.clear();
		std::vector<std::pair<std::array<int, dim>, int>> known; // tiles with their groups
		for (const auto& tile : tiles)
			known.push_back({ tile.index, tile.group });
		std::sort(known.begin(), known.end());
		std::vector<std::size_t> near;
		for (std::size_t t = 0; t < tiles.size(); ++t)
			if (meetsOther(known, tiles[t].index, tiles[t].group)) {
				near.push_back(t);
				for (std::size_t p = tiles[t].begin; p < tiles[t].end; ++p)
					size = std::max(size, P.size[p]);
			}
		const double around = 2.2 * size; // of a point: the part of the hull that it may touch
		for (const std::size_t t : near)
			for (std::size_t p = tiles[t].begin; p < tiles[t].end; ++p) {
				Placed placed { {}, tiles[t].group, t, p };
				for (std::size_t a = 0; a < dim; ++a)
					placed.bin[a] = floorToInt(P.position[a][p] / around);
				m_placed.push_back(placed);
			}
		std::sort(m_placed.begin(), m_placed.end());
		for (const std::size_t t : near)
			for (std::size_t p = tiles[t].begin; p < tiles[t].end; ++p)
				meetGroups(d, control, laws, t, p, around);
	}
	/* Whether a tile of another group lies at this tile or beside it. */
	static bool meetsOther(const std::vector<std::pair<std::array<int, dim>, int>>& known, const std::array<int, dim>& index, int group)
	{
		for (int k = 0; k < ipow(3, dim); ++k) {
			std::array<int, dim> at = index;
			for (int a = 0, rest = k; a < dim; ++a, rest /= 3)
				at[std::size_t(a)] += rest % 3 - 1;
			auto first = std::lower_bound(known.begin(), known.end(), std::make_pair(at, std::numeric_limits<int>::min()));
			for (; first != known.end() && first->first == at; ++first)
				if (first->second != group) return true;
		}
		return false;
	}
	void meetGroups(D& d, const StepControl& control, const std::vector<Law>& laws, std::size_t t, std::size_t p, double around)
	{
		const Points&                              P = d.transfer.points;
		std::array<int, dim>                       bin;
		std::vector<std::pair<int, const Placed*>> others; // by group
		for (std::size_t a = 0; a < dim; ++a)
			bin[a] = floorToInt(P.position[a][p] / around);
		for (int k = 0; k < ipow(3, dim); ++k) {
			Placed key { bin, std::numeric_limits<int>::min(), 0, 0 };
			for (int a = 0, rest = k; a < dim; ++a, rest /= 3)
				key.bin[std::size_t(a)] += rest % 3 - 1;
			for (auto q = std::lower_bound(m_placed.begin(), m_placed.end(), key); q != m_placed.end() && q->bin == key.bin; ++q) {
				if (q->group == P.group[p]) continue;
				double distance2 = 0;
				for (std::size_t a = 0; a < dim; ++a)
					distance2 += (P.position[a][q->point] - P.position[a][p]) * (P.position[a][q->point] - P.position[a][p]);
				if (distance2 < around * around) others.push_back({ q->group, &*q });
			}
		}
		std::stable_sort(others.begin(), others.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
		for (std::size_t first = 0, last = 0; first < others.size(); first = last) {
			std::vector<Vector> places;
			for (; last < others.size() && others[last].first == others[first].first; ++last) {
				Vector y;
				for (int a = 0; a < dim; ++a)
					y[a] = P.position[std::size_t(a)][others[last].second->point] - P.position[std::size_t(a)][p];
				places.push_back(y);
			}
			meetHull(d, control, laws, t, p, others[first].first, NearestOfHull<dim>(places), &others[first]);
		}
	}
	void meetHull(D& d, const StepControl& control, const std::vector<Law>& laws, std::size_t t, std::size_t p, int group, const NearestOfHull<dim>& hull,
		const std::pair<int, const Placed*>* others)
	{
		const Points& P        = d.transfer.points;
		const double  distance = hull.nearest.norm();
		if (!(distance > 1e-3 * P.size[p])) overlap(d, p, others[hull.corners[0]].second->point, P.size[p], control.time);
		Contact<dim> c;
		V            back;
		for (std::size_t a = 0; a < dim; ++a)
			c.normal[a] = -hull.nearest[int(a)] / distance, back[a] = -c.normal[a];
		const V lever = leverToSurface<dim>(P, p, c.normal, true);
		double  angle = laws[std::size_t(P.material[p])].frictionAngle, approach = 0;
		c.gap      = distance + ContactImpulses<dim>::dot(lever, c.normal);
		c.softness = softness(P, laws, control.dt, p);
		for (std::size_t a = 0; a < dim; ++a)
			c.place[a] = P.position[a][p] + lever[a], approach -= P.velocity[a][p] * c.normal[a];
		for (std::size_t k = 0; k < hull.corners.size(); ++k) {
			const std::size_t q      = others[hull.corners[k]].second->point;
			const double      weight = hull.weights[k];
			c.gap -= weight * ContactImpulses<dim>::dot(leverToSurface<dim>(P, q, back, true), c.normal);
			c.softness += weight * softness(P, laws, control.dt, q);
			angle = std::min(angle, laws[std::size_t(P.material[q])].frictionAngle);
			for (std::size_t a = 0; a < dim; ++a)
				approach += weight * P.velocity[a][q] * c.normal[a];
		}
		c.softness *= 2 * yielding(c.gap / P.size[p]);
		if (c.gap - 2 * control.dt * std::max(0., approach) > .1 * P.size[p]) return;
		if (m_fresh && P.contactForces.empty() && c.gap < -.25 * P.size[p]) overlap(d, p, others[hull.corners[0]].second->point, -c.gap, control.time);
		c.friction = std::tan(angle);
		c.point = P.id[p], c.other = -1 - group;
		recall(P, control.dt, c);
		const std::size_t number = m_impulses.contacts.size();
		m_impulses.contacts.push_back(c);
		m_sides.push_back({ number, t, p, lever, 1 });
		for (std::size_t k = 0; k < hull.corners.size(); ++k) {
			const Placed& other = *others[hull.corners[k]].second;
			V             arm;
			for (std::size_t a = 0; a < dim; ++a)
				arm[a] = c.place[a] - P.position[a][other.point];
			m_sides.push_back({ number, other.tile, other.point, arm, -hull.weights[k] });
		}
	}
	[[noreturn]] static void overlap(const D& d, std::size_t p, std::size_t q, double depth, double time)
	{
		const Points&     P    = d.transfer.points;
		const std::string what = "of group " + std::to_string(P.group[p]) + " and point " + std::to_string(P.id[q]) + " of group "
					 + std::to_string(P.group[q]) + " overlap by " + std::to_string(depth) + " m";
		PointChecks<dim, typename D::Shape>(d.transfer)
			.fail(p, what.c_str(), "fill the groups side by side, half a spacing from each other's faces, or reduce O.dt", time);
	}
	bool m_fresh = true; // no step yet with these points; a loaded scene has contactForces where bodies touch

	/* Force and slip of the last step, turned with the normal. */
	static void recall(const Points& P, double dt, Contact<dim>& c)
	{
		const SurfaceForce key { c.point, c.other, {}, {} };
		const auto         at = std::lower_bound(P.contactForces.begin(), P.contactForces.end(), key);
		if (at == P.contactForces.end() || at->point != c.point || at->other != c.other) return;
		V force, slip;
		for (std::size_t a = 0; a < dim; ++a)
			force[a] = at->force[a] * dt, slip[a] = at->slip[a];
		const double normal = std::max(0., ContactImpulses<dim>::dot(force, c.normal));
		const V      t      = ContactImpulses<dim>::tangential(force, c.normal, c.friction * normal);
		c.slip              = ContactImpulses<dim>::tangential(slip, c.normal, std::numeric_limits<double>::infinity());
		for (std::size_t a = 0; a < dim; ++a)
			c.impulse[a] = normal * c.normal[a] + t[a];
	}
};

} // namespace yade::mpm
