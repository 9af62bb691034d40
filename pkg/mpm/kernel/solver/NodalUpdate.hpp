// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "NodeFields.hpp"
#include "Solver.hpp"

namespace yade::mpm {

/* Eq. 14:  a_i = f_i / m_i,  v_i = (m v)_i / m_i + dt a_i, under the constraints. Cundall's damping takes `damping` times a_i off
where it speeds the node up and adds it where it slows it down; `lost`, where given, receives that part of a_i. */
template <class D> void updateNodes(D& d, const StepControl& control, NodeVector<D::dim>* lost)
{
	auto& fields = d.fields;
	d.constraints.afterSums(fields.masses(), fields.momentum, fields.force);
	d.transfer.forEachNodeRange([&](std::size_t begin, std::size_t end) {
		const double dt = control.dt, damping = control.damping, least = fields.leastMass;
		for (int a = 0; a < D::dim; ++a) {
			const double *mass = fields.massOf(a).data(), *momentum = fields.momentum[a].data(), *force = fields.force[a].data();
			double *      v = fields.velocity[a].data(), *dv = fields.velocityIncrement[a].data(), *braked = lost ? (*lost)[a].data() : nullptr;
#pragma omp simd
			for (std::size_t i = begin; i < end; ++i) {
				const double inverse = NodeFields<typename D::S>::inverse(mass[i], least), start = momentum[i] * inverse;
				const double accel = force[i] * inverse, trend = accel * (start + .5 * dt * accel);
				const double braking = trend > 0 ? damping * accel : trend < 0 ? -damping * accel : 0;
				dv[i]                = dt * (accel - braking);
				v[i]                 = start + dv[i];
				if (braked) braked[i] = braking;
			}
		}
	});
	d.constraints.afterUpdate(fields.velocity, Motion::velocity);
	d.constraints.afterUpdate(fields.velocityIncrement, Motion::increment);
}

/* Nodal velocities before the update. */
template <class S> NodeVector<S::dim> velocityAtStart(const NodeFields<S>& fields)
{
	NodeVector<S::dim> v = fields.velocity;
	for (int d = 0; d < S::dim; ++d)
		for (std::size_t i = 0; i < fields.mass.size(); ++i)
			v[d][i] -= fields.velocityIncrement[d][i];
	return v;
}

} // namespace yade::mpm
