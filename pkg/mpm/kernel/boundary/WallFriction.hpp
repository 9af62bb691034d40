// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "WallMirror.hpp"

namespace yade::mpm {

/* Friction walls: contacts that act on those columns of nodes that press on the wall or approach it. */

/* A column is in contact when its node on the plane moves into the wall, or when it presses on the wall while that node
leaves: the near points of a compressed body do, as it rebounds. An impulse that is negligible beside the node's momentum
away from the wall is rounding, and no contact. */
template <int dim>
void decideContact(
	WallMirror<dim>& mirror, const Wall& wall, const NodeMass<dim>& masses, const NodeVector<dim>& momentum, const NodeVector<dim>& force, double dt)
{
	const int    a    = wall.axis;
	const Field& mass = *masses[a];
	for (auto& c : mirror.columns) {
		c.active = false;
		if (c.plane < 0 || c.outside || !(mass[c.plane] > 0)) continue;
		double pressing = -wall.side * force[a][c.plane];
		if (c.ghost >= 0 && c.mirror >= 0) {
			const double m0 = mass[c.ghost], m1 = mass[c.mirror], f0 = force[a][c.ghost], f1 = force[a][c.mirror];
			if (m0 + m1 > 0) pressing -= wall.side * (f0 + f1 - (m1 - m0) * (f1 - f0) / (m0 + m1));
		}
		const double gap = wall.side * ((momentum[a][c.plane] + dt * force[a][c.plane]) / mass[c.plane] - wall.velocity[a]);
		c.active         = gap < 0 || pressing * dt > 1e-3 * mass[c.plane] * gap;
		c.reaction       = c.active ? pressing : 0;
	}
}

/* Coulomb's law: the tangential impulse that stops the sliding at the plane, or as much of it as friction allows, spread by
the values N0 and N1 of the shape function at the plane, of the node on it and of its neighbours. */
template <int dim>
void applyFriction(const WallMirror<dim>& mirror, const Wall& wall, double N0, double N1, const NodeMass<dim>& mass, const NodeVector<dim>& momentum,
	NodeVector<dim>& force, double dt)
{
	for (const auto& c : mirror.columns) {
		if (!c.active || !(c.reaction > 0)) continue;
		const double w0 = N0, w1         = 2 * N1;
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

} // namespace yade::mpm
