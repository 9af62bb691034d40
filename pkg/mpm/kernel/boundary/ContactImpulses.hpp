// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "NodalShares.hpp"
#include <algorithm>
#include <cmath>

namespace yade::mpm {

/* Contacts of surface places with something else, and the impulses that they exchange in a step.

With u the velocity of the place relative to the other side after the update of the nodes, g its distance from it before the step
along the normal, and k the stiffness of the material between the point and its surface, the impulse lambda of a step dt obeys

  lambda_n = max(0, -k dt (g + dt u_n/2)),     lambda_t = -k dt (s + dt u_t/2)  or  |lambda_t| = mu lambda_n against it,

s being the elastic part of the slip. Springs at mid-step are stable in any step and take less energy than at its end: a mass m on
one keeps 1/(1 + k dt^2/(2 m)) of its phase area in a step. s makes sticking a state of rest: without it every step in which the
traction swings past Coulomb's limit would leave some slip.

Written with c = 2/(k dt^2) and the response K of the place, one sweep of Gauss and Seidel sets for each contact in turn

  lambda <- lambda - (u + 2 g/dt + c lambda) / (K + c)

(and the same with s for the tangential part), from the impulse of the step before. Sweeps go forth and back in a fixed order:
the result does not depend on threads. */
template <int dim> struct Contact {
	using V                                = std::array<double, dim>;
	int                              point = 0, other = 0;                // ids: of the point, and of the wall or group
	V                                normal {};                           // towards the point
	V                                place {};                            // of the contact [m]
	V                                otherVelocity {};                    // of the other side there, where it is not made of points [m/s]
	double                           gap = 0, softness = 0, friction = 0; // softness: 2/(k dt^2)
	bool                             slides = false;                      // at Coulomb's limit
	typename NodalShares<dim>::Range range {};
	V                                impulse {}; // on the point [Ns]
	V                                slip {};    // elastic part [m]
};

template <int dim> class ContactImpulses {
	using V = std::array<double, dim>;

public:
	std::vector<Contact<dim>> contacts;
	NodalShares<dim>          shares;

	void clear() { contacts.clear(), shares.clear(); }

	/* Finds the impulses and adds their effect to velocities and increments. */
	void solve(NodeVector<dim>& velocity, NodeVector<dim>& increment, double dt)
	{
		constexpr int sweeps = 4;
		for (int sweep = 0; sweep < sweeps; ++sweep)
			for (std::size_t k = 0, n = contacts.size(); k < n; ++k)
				relax(contacts[sweep % 2 ? n - 1 - k : k], velocity, increment, dt);
	}
	/* Elastic slips at the end of the step, in which the places move with the velocities that strain the material. */
	void advanceSlips(const NodeVector<dim>& velocity, double dt)
	{
		for (Contact<dim>& c : contacts) {
			const double normal = dot(c.normal, c.impulse);
			V            u      = shares.velocity(c.range, velocity);
			for (std::size_t d = 0; d < dim; ++d)
				u[d] -= c.otherVelocity[d];
			const double along = dot(c.normal, u);
			for (std::size_t d = 0; d < dim; ++d) {
				if (c.slides) // as far as the springs hold at the limit
					c.slip[d] = -.5 * (c.impulse[d] - normal * c.normal[d]) * c.softness * dt;
				else
					c.slip[d] = normal > 0 ? c.slip[d] + dt * (u[d] - along * c.normal[d]) : 0;
			}
		}
	}

	static double dot(const V& a, const V& b)
	{
		double sum = 0;
		for (std::size_t d = 0; d < dim; ++d)
			sum += a[d] * b[d];
		return sum;
	}
	/* The tangential part of a vector, no longer than a limit. */
	static V tangential(const V& vector, const V& normal, double limit)
	{
		const double along = dot(vector, normal);
		V            t;
		for (std::size_t d = 0; d < dim; ++d)
			t[d] = vector[d] - along * normal[d];
		const double length = std::sqrt(dot(t, t));
		if (length > limit)
			for (double& x : t)
				x *= limit / length;
		return t;
	}

private:
	void relax(Contact<dim>& c, NodeVector<dim>& velocity, NodeVector<dim>& increment, double dt)
	{
		V u = shares.velocity(c.range, velocity);
		for (std::size_t d = 0; d < dim; ++d)
			u[d] -= c.otherVelocity[d];
		double along = 0, across = 0; // responses to a normal and to a tangential impulse
		for (std::size_t d = 0; d < dim; ++d)
			along += c.normal[d] * c.normal[d] * c.range.response[d], across = std::max(across, c.range.response[d]);
		const double before = dot(c.normal, c.impulse);
		const double normal = std::max(0., before - (dot(c.normal, u) + 2 * c.gap / dt + c.softness * before) / (along + c.softness));
		V            change, tangent;
		for (std::size_t d = 0; d < dim; ++d) {
			const double t = c.impulse[d] - before * c.normal[d];
			tangent[d]     = t - (u[d] + 2 * c.slip[d] / dt + c.softness * t) / (across + c.softness);
		}
		const double limit = c.friction * normal;
		c.slides           = dot(tangent, tangent) > limit * limit; // the normal part of it is rounding
		tangent            = tangential(tangent, c.normal, limit);
		bool acted         = false;
		for (std::size_t d = 0; d < dim; ++d) {
			const double impulse = normal * c.normal[d] + tangent[d];
			change[d]            = impulse - c.impulse[d];
			acted                = acted || change[d] != 0;
			c.impulse[d]         = impulse;
		}
		if (!acted) return;
		shares.push(c.range, change, velocity);
		shares.push(c.range, change, increment);
	}
};

} // namespace yade::mpm
