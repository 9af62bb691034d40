// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "ContactPoints.hpp"
#include "MassCorrection.hpp"
#include "NodalUpdate.hpp"
#include "PrescribedPoints.hpp"

namespace yade::mpm {

/* The balance of energies. With a_i = dv_i/dt the nodal accelerations, a step of FLIP changes the points' kinetic energy by

  sum_p m_p dv_p . (v_p + dv_p/2) = sum_i m_i dv_i . u_i,   m_i u_i = m_i v_i + sum_p N_ip m_p dv_p / 2

exactly, with dv_p the change that a point takes: of a prescribed component it takes none, and PIC adds to it; either is a
force on the point, whose work is that of this change at the point's mean velocity. With the mass correction a_i is (2 - Q) f_i/m_i, and since Q is
self-adjoint the forces do work as if u_i were (2 - Q) u_i (MassCorrection.hpp). m_i a_i is the sum of internal, external, damping and wall forces: each does
the work f_i . u_i dt. Masses and forces are those of the nodes before mirroring, velocities those with images; walls at rest then do no work. The
internal forces' work is not used: V_p sigma_p : d eps_p at the points takes its place, and the difference of the two is the error of the time
integration, which the sum of all energies shows. */
template <class D> class EnergyBalance {
	static constexpr int dim = D::dim;
	using S                  = typename D::S;
	using Values             = typename D::Values;

public:
	/* Energies that the points hold when tracking begins. */
	void start(const D& d, Analysis analysis, const std::vector<Law>& laws, bool largeStrain)
	{
		Points& P          = d.transfer.points;
		P.energies         = {};
		P.energies.started = true;
		for (std::size_t p = 0; p < P.count(); ++p) {
			const Energies stored = storedEnergy(analysis, laws[std::size_t(P.material[p])], P, p);
			const double   V      = currentVolume<dim>(P, p, largeStrain);
			P.energies.elastic += V * stored.elastic, P.energies.hardening += V * stored.hardening;
		}
	}
	/* Work at the points, by tile: the stress update adds to it. */
	void      resize(std::size_t tiles) { m_tiles.resize(tiles); }
	Energies* tiles() { return m_tiles.data(); }
	/* After the sums: nodal masses and forces before they are mirrored, and the external part of the forces. */
	void keepSums(const D& d, const StepControl& control)
	{
		const auto& transfer = d.transfer;
		m_mass.fill(d.fields.mass);
		if constexpr (hasHoop<S>) m_mass[0] = d.fields.radialMass;
		m_force = d.fields.force;
		for (NodeVector<dim>* field : { &m_damping, &m_external })
			field->fill(Field(d.fields.mass.size()));
		sumOverTiles(
			transfer,
			[&](std::size_t t) {
				const auto& tile = transfer.grid.tiles()[t];
				Values      f[dim] {};
				for (std::size_t p = tile.begin; p < tile.end; ++p) {
					Lanes mp, fp[dim];
					load(transfer.points.mass, { p, 1 }, mp);
					externalForces(transfer.points, { p, 1 }, control, mp, fp);
					transfer.weights(tile, p).forEachNode([&](int i, double Nip, const std::array<double, dim>&) {
						for (int a = 0; a < dim; ++a)
							f[a][i] += Nip * fp[a][0];
					});
				}
				for (int a = 0; a < dim; ++a)
					D::Patch::add(tile, f[a], m_external[a]);
				if (!transfer.points.inContact.empty()) spreadTorques(transfer, t, m_external);
			},
			m_external);
	}
	/* Nodal external forces that keepSums() has found; loads that are not the points' are added. */
	NodeVector<dim>& external() { return m_external; }
	/* Acceleration that damping takes away: for the update of the nodes. */
	NodeVector<dim>* damping() { return &m_damping; }
	/* After the update: velocities at the start of the step, and their change. */
	void keepMotion(const D& d)
	{
		m_change        = d.fields.velocityIncrement;
		m_start         = velocityAtStart(d.fields);
		const Points& P = d.transfer.points;
		m_velocity.assign(P.velocity.begin(), P.velocity.begin() + dim);
		m_kineticAtStart = kineticEnergy<dim>(P);
		d.constraints.afterUpdate(m_damping, Motion::increment);
	}
	/* Work of the step's forces, when the points have taken the new velocities. */
	void addWork(D& d, const StepControl& control, const AddedWallWork& added, const PrescribedPoints<D>& prescribed, NodeVector<dim>& scratch)
	{
		const double          dt = control.dt;
		Points&               P  = d.transfer.points;
		NodeVector<dim>       dv = m_change, u = m_change;
		std::vector<Energies> atPoints(d.transfer.grid.tiles().size());
		if (correctsMass(control)) correctMass(d, dv, scratch, Motion::increment);
		sumOverTiles(
			d.transfer, [&](std::size_t t) { sumMeanChange(d, control.flip, dv, t, u, atPoints[t]); }, u);
		velocityFromMomentum(d, u, u, Motion::increment);
		for (int a = 0; a < dim; ++a)
			for (std::size_t i = 0; i < u[a].size(); ++i)
				u[a][i] += m_start[a][i];
		if (correctsMass(control)) correctMass(d, u, scratch, Motion::velocity);

		collectTiles(P);
		Energies     work;
		const double least = d.fields.leastMass;
		for (int a = 0; a < dim; ++a)
			for (std::size_t i = 0; i < u[a].size(); ++i) {
				const double m = m_mass[a][i];
				if (!(m > least)) continue;
				const double half = .5 * u[a][i], braking = m * m_damping[a][i] * dt;
				work.external -= m_external[a][i] * dt * half;
				work.damping += braking * half;
				work.walls -= (m * m_change[a][i] + braking - m_force[a][i] * dt) * half;
			}
		for (const Energies& tile : atPoints)
			work.add(tile);
		work.walls -= .5 * prescribed.workBeyond(d, u);
		if (correctsMass(control)) work.walls += .5 * added.correction;
		work.walls += .5 * added.pic, work.damping -= .5 * added.pic;
		P.energies.add(P.upcoming);
		P.energies.add(work); // half of the step's work until its start ...
		P.upcoming = work;    // ... and half of it after
	}
	/* After the stress update that ends the step. */
	void finish(Points& P)
	{
		P.energies.kinetic = .5 * (m_kineticAtStart + kineticEnergy<dim>(P));
		collectTiles(P);
	}

private:
	std::vector<Energies> m_tiles;             // what the passes have found, summed in the order of tiles
	NodeVector<dim>       m_mass;              // of the nodes, not mirrored
	NodeVector<dim>       m_force, m_external; // likewise; all forces, and the external ones
	NodeVector<dim>       m_damping;           // acceleration that damping takes away
	NodeVector<dim>       m_start, m_change;   // nodal velocities at the start of the step, and their change
	Columns               m_velocity;          // of the points at the start
	double                m_kineticAtStart = 0;

	/* (m Q dv)_i / 2 of the changes that the points take, and the work of prescribed motion and PIC. */
	void sumMeanChange(const D& d, double flip, const NodeVector<dim>& dv, std::size_t t, NodeVector<dim>& u, Energies& half) const
	{
		const auto&   tile = d.transfer.grid.tiles()[t];
		const Points& P    = d.transfer.points;
		Values        change[dim], sum[dim] {};
		for (int a = 0; a < dim; ++a)
			D::Patch::read(tile, dv[a], change[a]);
		for (std::size_t p = tile.begin; p < tile.end; ++p) {
			const auto   w = d.transfer.weights(tile, p);
			const double m = P.mass[p];
			double       taken[dim]; // change of velocity
			for (std::size_t a = 0; a < std::size_t(dim); ++a) {
				const double old = m_velocity[a][p], dvp = w.gather(change[a]);
				if (!P.prescribedDofs.empty() && P.prescribedDofs[p] >> a & 1) {
					taken[a] = 0;
					half.walls += .5 * m * dvp * old;
				} else {
					taken[a] = flip == 1 ? dvp : P.velocity[a][p] - old;
					half.damping -= .5 * m * (taken[a] - dvp) * (old + .5 * taken[a]);
				}
			}
			w.forEachNode([&](int i, double Nip, const std::array<double, dim>&) {
				for (int a = 0; a < dim; ++a)
					sum[a][i] += .5 * Nip * m * taken[a];
			});
		}
		for (int a = 0; a < dim; ++a)
			D::Patch::add(tile, sum[a], u[a]);
	}
	/* Work at the points belongs to the next step's start. */
	void collectTiles(Points& P)
	{
		for (Energies& tile : m_tiles) {
			P.upcoming.add(tile);
			tile = {};
		}
	}
};

} // namespace yade::mpm
