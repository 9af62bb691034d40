// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "RoundTrip.hpp"

namespace yade::mpm {

/* Null-space modes of the point velocities, (1 - S S+)^2 v_p (XPIC(2): Hammerquist & Nairn, CMAME 318 (2017) 724), with the affine transfer of
v_p and W_p together: `part` of them is removed. At a wall they carry momentum, which goes into its reaction.

synchronized: they are those of the velocities at the time of the positions, v_p - S dt a/2. The leapfrog conserves (without rotation of the
points) the sum of elastic energy and of the kinetic energy of these velocities, up to a term of the positions alone. So a synchronized filtering
lowers what the leapfrog conserves, for every part from 0 to 1 and at whatever intervals. Velocities of half a step later have another phase, and a
filtering at regular intervals can then drive the modes that it meets in this phase. */
namespace detail {
	/* v += (1 - Q)^2 dv / 2. Returns the work on moving walls. */
	template <class D> double addUnseenIncrement(D& d, NodeVector<D::dim>& v, double rate, double dt)
	{
		NodeVector<D::dim> rest = d.fields.velocityIncrement, trip;
		double             work = 0;
		for (const double share : { -.5 * rate, .5 * rate }) {
			spreadVelocities(d.transfer, &rest, trip, rotates(d));
			work += projectWithReactions(d, trip, Motion::increment, share, dt);
			for (int a = 0; a < D::dim; ++a)
				for (std::size_t i = 0; i < trip[a].size(); ++i)
					rest[a][i] -= trip[a][i];
		}
		for (int a = 0; a < D::dim; ++a)
			for (std::size_t i = 0; i < rest[a].size(); ++i)
				v[a][i] += .5 * rest[a][i];
		return work;
	}
	/* Moves the velocities of a tile's points by `part` towards those of the nodal field `seen`. Returns the sum of m times the change and, where
	dv is given, half the velocity increment of the step [J]. */
	template <class D>
	double filterTile(D& d, std::size_t t, double part, const NodeVector<D::dim>& seen, const NodeVector<D::dim>* dv)
	{
		constexpr int      dim  = D::dim;
		Points&            P    = d.transfer.points;
		const auto&        tile = d.transfer.grid.tiles()[t];
		typename D::Values v[dim], increment[dim] {};
		double             sum = 0;
		for (int a = 0; a < dim; ++a) {
			D::Patch::read(tile, seen[a], v[a]);
			if (dv) D::Patch::read(tile, (*dv)[a], increment[a]);
		}
		for (std::size_t p = tile.begin; p < tile.end; ++p) {
			const auto w = d.transfer.weights(tile, p);
			for (std::size_t a = 0; a < std::size_t(dim); ++a)
				if (P.prescribedDofs.empty() || !(P.prescribedDofs[p] >> a & 1)) {
					const double change = part * (w.gather(v[a]) - P.velocity[a][p]);
					P.velocity[a][p] += change;
					if (dv) sum += .5 * P.mass[p] * change * w.gather(increment[a]);
				}
			if constexpr (dim > 1)
				if (rotates(d) && (P.prescribedDofs.empty() || !P.prescribedDofs[p])) {
					const Arms<dim, typename D::Shape> arms(w, d.transfer.geometry.cell);
					double                             u[dim], W[turns<dim>], dW[turns<dim>] {};
					gatherMotion(w, arms, v, u, W);
					if (dv) gatherMotion(w, arms, increment, u, dW);
					for (std::size_t k = 0; k < std::size_t(turns<dim>); ++k) {
						const double change = part * (W[k] - P.angularVelocity[k][p]);
						P.angularVelocity[k][p] += change;
						sum += .5 * P.mass[p] * arms.inertia(int(k)) * change * dW[k];
					}
				}
		}
		return sum;
	}
} // namespace detail

template <class D> void filterVelocities(D& d, const StepControl& control, double part, bool synchronized)
{
	constexpr int   dim    = D::dim;
	Points&         P      = d.transfer.points;
	const bool      affine = rotates(d), both = synchronized && control.trackEnergy;
	const double    before = control.trackEnergy ? kineticEnergy(d) : 0, rate = part / control.dt, tau = .5 * control.dt;
	NodeVector<dim> seen, trip;
	spreadVelocities(d.transfer, noField<dim>, seen, affine, tau);
	double work = projectWithReactions(d, seen, Motion::velocity, rate, control.dt);
	spreadVelocities(d.transfer, &seen, trip, affine, tau);
	work += projectWithReactions(d, trip, Motion::velocity, -rate, control.dt);
	subtractRoundTrip(d.transfer, seen, trip);
	if (synchronized) work += detail::addUnseenIncrement(d, seen, rate, control.dt);
	std::vector<double> half(d.transfer.grid.tiles().size());
	d.transfer.forEachTile([&](std::size_t t) { half[t] = detail::filterTile(d, t, part, seen, both ? &d.fields.velocityIncrement : nullptr); });
	if (!control.trackEnergy) return;
	double lost = before - kineticEnergy(d) - work;
	for (const double sum : half)
		lost += sum;
	for (Energies* energies : { &P.energies, &P.upcoming })
		energies->damping += .5 * lost, energies->walls += .5 * work;
}

/* With the affine transfer, in a body that turns. Its lattice of points turns over the grid: the parts of v_p and W_p that the nodes have not received
come back as motion. The centrifugal stress feeds them, so that without a filter the energy grows, slowly, with less than a factor of e in a turn. A part 1 - exp(-theta) of them
is removed after each eighth of a radian, theta the angle since the last time, by the greatest mean spin of a point (StressUpdate.hpp). */
template <class D> void filterTurning(D& d, const StepControl& control)
{
	Points& P = d.transfer.points;
	if (P.turned < .125) return;
	filterVelocities(d, control, -std::expm1(-P.turned), true);
	P.turned = 0;
}

} // namespace yade::mpm
