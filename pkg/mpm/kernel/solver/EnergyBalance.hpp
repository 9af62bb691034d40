// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "MpmSolver.hpp"

namespace yade::mpm {

/* Where the energy goes. With a_i = dv_i/dt the nodal accelerations, a step of FLIP changes the points' kinetic energy by

  sum_p m_p dv_p . (v_p + dv_p/2) = sum_i m_i dv_i . u_i,   m_i u_i = m_i v_i + sum_p N_ip m_p dv_p / 2

exactly, with dv_p the change that a point takes: of a prescribed component it takes none, and PIC adds to it; either is a
force on the point, whose work is that of this change at the point's mean velocity. With the full mass a_i is (2 - Q) f_i/m_i, and since Q is
self-adjoint the forces do work as if u_i were (2 - Q) u_i (FullMass.hpp). m_i a_i is the sum of internal, external, damping and wall forces: each does
the work f_i . u_i dt. Masses and forces are those of the nodes before folding, velocities those that unfolding has written; walls at rest then do no work. The
internal forces' work is not used: it is set against V_p sigma_p : d eps_p at the points, and what is left over between the two is the error of the time
integration, which the sum of all energies shows. */

/* V sigma : d eps over a step at a point, by the trapezoidal rule, and where it goes. */
template <class S, class Shape> struct MpmSolver<S, Shape>::StressWork {
	const MpmSolver& solver;
	const Law&       law;
	std::size_t      point;
	const double*    strain;
	double           volume, work, hardening;

	StressWork(const MpmSolver& s, const Law& l, std::size_t p, const double (&F)[dim * dim], const double* de, const double* sigma, const double* internal)
	    : solver(s)
	    , law(l)
	    , point(p)
	    , strain(de)
	    , volume(s.volume(p, F))
	    , work(.5 * volume * dot<S>(sigma, de))
	    , hardening(hardeningEnergy<S>(l, internal))
	{
	}
	void add(const double (&F)[dim * dim], const double* sigma, const double* internal, const Response& response, Energies& sum) const
	{
		const double after = solver.volume(point, F), middle = .5 * (volume + after);
		const double heat = middle * response.dissipation, stored = middle * (hardeningEnergy<S>(law, internal) - hardening);
		sum.dissipation += heat;
		sum.hardening += stored;
		sum.elastic += work + .5 * after * dot<S>(sigma, strain) - heat - stored;
		solver.m_points.dissipation[point] += heat / solver.m_points.volume0[point];
	}
};

/* Energies that the points hold when tracking begins. */
template <class S, class Shape> void MpmSolver<S, Shape>::startEnergies()
{
	if (m_points.energies.started) return;
	finish();
	Energies& energies = m_points.energies;
	energies           = {};
	energies.started   = true;
	for (std::size_t p = 0; p < m_points.count(); ++p) {
		double F[dim * dim];
		for (int k = 0; k < dim * dim; ++k)
			F[k] = m_points.deformation[k][p];
		const Energies stored = storedEnergy(m_analysis, m_laws[m_points.material[p]], m_points, p);
		energies.elastic += volume(p, F) * stored.elastic, energies.hardening += volume(p, F) * stored.hardening;
	}
}

/* Nodal masses and forces as the points have spread them, before the walls fold them, and the external part of the forces. */
template <class S, class Shape> void MpmSolver<S, Shape>::keepSums()
{
	m_tracking.mass.fill(m_mass);
	if constexpr (hoop) m_tracking.mass[0] = m_radialMass;
	m_tracking.force    = m_force;
	m_tracking.damping  = m_force;
	m_tracking.external = m_force;
	clear(m_tracking.damping), clear(m_tracking.external);
	forEachTile([&](std::size_t t) {
		const auto& tile = m_grid.tiles()[t];
		Patch       f[dim] {};
		for (std::size_t p = tile.begin; p < tile.end; ++p) {
			double fp[dim], Vs[dim][dim];
			pointForces(p, fp, Vs);
			forEachNode(weights(tile, p), [&](int i, double Nip, const std::array<double, dim>&) {
				for (int d = 0; d < dim; ++d)
					f[d][i] += Nip * fp[d];
			});
		}
		for (int d = 0; d < dim; ++d)
			add(tile, f[d], m_tracking.external[d]);
		if (!m_points.touched.empty()) spreadCouples(t, m_tracking.external);
	});
}

/* Velocities at the start of the step, and the change of those of the nodes. */
template <class S, class Shape> void MpmSolver<S, Shape>::keepMotion()
{
	Tracking& T = m_tracking;
	T.change    = m_force;
	T.start     = startOfStep();
	T.velocity.assign(m_points.velocity.begin(), m_points.velocity.begin() + dim);
	m_band.unfold(m_walls, T.damping, false);
}

/* Work of the step's forces, when the points have taken the new velocities. */
template <class S, class Shape> void MpmSolver<S, Shape>::trackWork()
{
	Tracking&       T  = m_tracking;
	const double    dt = m_control.dt;
	NodeVector<dim> dv = T.change, u = m_force, trip;
	const bool      full = correctsMass(m_control);
	if (full) correct(dv, trip, false);
	clear(u);
	std::vector<Energies> halfWork(m_grid.tiles().size());
	forEachTile([&](std::size_t t) { // (m Q dv)_i / 2 of the changes that the points take, and what prescribed motion and PIC make of the others
		const auto& tile = m_grid.tiles()[t];
		Patch       change[dim], sum[dim] {};
		for (int d = 0; d < dim; ++d)
			read(tile, dv[d], change[d]);
		for (std::size_t p = tile.begin; p < tile.end; ++p) {
			const Weights w = weights(tile, p);
			const double  m = m_points.mass[p];
			double        taken[dim]; // change of velocity
			for (int d = 0; d < dim; ++d) {
				const double old = T.velocity[d][p], dvp = gather(w, change[d]);
				if (!m_points.fixed.empty() && m_points.fixed[p] >> d & 1) {
					taken[d] = 0;
					halfWork[t].walls += .5 * m * dvp * old;
				} else {
					taken[d] = m_control.flip == 1 ? dvp : m_points.velocity[d][p] - old;
					halfWork[t].damping -= .5 * m * (taken[d] - dvp) * (old + .5 * taken[d]);
				}
			}
			forEachNode(w, [&](int i, double Nip, const std::array<double, dim>&) {
				for (int d = 0; d < dim; ++d)
					sum[d][i] += .5 * Nip * m * taken[d];
			});
		}
		for (int d = 0; d < dim; ++d)
			add(tile, sum[d], u[d]);
	});
	fromMomentum(u, false);
	for (int d = 0; d < dim; ++d)
		for (std::size_t i = 0; i < m_mass.size(); ++i)
			u[d][i] += T.start[d][i];
	if (full) correct(u, trip, true);

	collectTiles();
	Energies     work;
	const double least = leastMass();
	for (int d = 0; d < dim; ++d)
		for (std::size_t i = 0; i < m_mass.size(); ++i) {
			const double m = T.mass[d][i];
			if (!(m > least)) continue;
			const double half = .5 * u[d][i], braking = m * T.damping[d][i] * dt;
			work.external -= T.external[d][i] * dt * half;
			work.damping += braking * half;
			work.walls -= (m * T.change[d][i] + braking - T.force[d][i] * dt) * half;
		}
	for (const Energies& tile : halfWork)
		work.add(tile);
	if (full) work.walls += .5 * m_correctionWork;
	work.walls += .5 * m_picWork, work.damping -= .5 * m_picWork;
	m_points.energies.add(m_points.upcoming);
	m_points.energies.add(work); // half of the step's work until its start ...
	m_points.upcoming = work;    // ... and half of it after
}

/* Work at the points that belongs to the next step's start. */
template <class S, class Shape> void MpmSolver<S, Shape>::collectTiles()
{
	for (Energies& tile : m_tracking.tiles) {
		m_points.upcoming.add(tile);
		tile = {};
	}
}

template <class S, class Shape> double MpmSolver<S, Shape>::kineticEnergy() const
{
	double kinetic = 0;
	for (int d = 0; d < dim; ++d)
		for (std::size_t p = 0; p < m_points.count(); ++p)
			kinetic += .5 * m_points.mass[p] * m_points.velocity[d][p] * m_points.velocity[d][p];
	return kinetic;
}

} // namespace yade::mpm
