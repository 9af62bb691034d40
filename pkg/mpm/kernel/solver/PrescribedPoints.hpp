// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "PointShares.hpp"
#include "Solver.hpp"

namespace yade::mpm {

/* Points whose motion is prescribed prescribe it to the material: impulses lambda_p at the points, m_i dv_i = sum N_ip lambda_p,
make sum N_ip v_i the prescribed velocity of every such point, at the update of the nodes and again for the velocities that
strain the points. It is the projection that changes the nodes' kinetic energy least; its equations N M^-1 N^T lambda = w - N v
are solved by conjugate gradients, component by component. They may be singular (more points than nodes). A softness of a
hundredth of each point's response bounds the impulses in directions that the grid hardly has; since the impulses of the last
step are kept, it delays equality by some steps and leaves no error at rest. -lambda/dt of the update is the reaction. */
template <class D> class PrescribedPoints {
	static constexpr int dim = D::dim;
	using V                  = std::array<double, dim>;
	using Shares             = PointShares<D>;

public:
	/* The points as they stand, with the forces of the last step. */
	void find(const D& d, const StepControl& control)
	{
		m_points.clear(), m_shares.clear();
		const Points& P = d.transfer.points;
		if (P.prescribedDofs.empty()) return;
		const auto& tiles = d.transfer.grid.tiles();
		for (std::size_t t = 0; t < tiles.size(); ++t)
			for (std::size_t p = tiles[t].begin; p < tiles[t].end; ++p) {
				if (!P.prescribedDofs[p]) continue;
				Held       held { t, p, {}, {}, {}, {}, {}, {}, {} };
				const auto at = std::lower_bound(P.reactions.begin(), P.reactions.end(), SurfaceForce { P.id[p], 0, {}, {} });
				if (at != P.reactions.end() && at->point == P.id[p])
					for (std::size_t a = 0; a < dim; ++a)
						held.impulse[a] = P.prescribedDofs[p] >> a & 1 ? at->force[a] * control.dt : 0;
				held.last = held.impulse;
				m_points.push_back(held);
			}
	}
	/* After the sums: adds the last forces to those of the nodes, lest damping act on a reaction in balance. */
	void begin(D& d, const StepControl& control)
	{
		find(d, control);
		const auto& tiles = d.transfer.grid.tiles();
		for (const Held& held : m_points) {
			V force;
			for (std::size_t a = 0; a < dim; ++a)
				force[a] = held.impulse[a] / control.dt;
			Shares::addForce(tiles[held.tile], d.transfer.weights(tiles[held.tile], held.point), {}, force, d.fields.force);
		}
	}
	/* Shares of the nodes, with their masses after mirrors have acted. */
	void share(D& d)
	{
		const auto& tiles = d.transfer.grid.tiles();
		m_shares.clear();
		for (Held& held : m_points) {
			held.range = m_shares.begin();
			Shares::add(d, tiles[held.tile], d.transfer.weights(tiles[held.tile], held.point), {}, 1, m_shares, held.range);
		}
	}
	bool acts() const { return !m_points.empty(); }
	/* After the update: projects velocities and increments, and keeps the forces; raw as for contacts. */
	void finish(D& d, const StepControl& control, NodeVector<dim>* raw)
	{
		Points& P = d.transfer.points;
		if (m_points.empty()) {
			P.reactions.clear();
			return;
		}
		const auto& tiles = d.transfer.grid.tiles();
		share(d);
		solve(d, d.fields.velocity);
		for (Held& held : m_points) {
			m_shares.push(held.range, held.step, d.fields.velocityIncrement);
			for (std::size_t a = 0; a < dim; ++a)
				held.impulse[a] += held.step[a];
		}
		for (const Held& held : m_points)
			if (raw) Shares::addForce(tiles[held.tile], d.transfer.weights(tiles[held.tile], held.point), {}, held.step, *raw);
		P.reactions.clear();
		for (const Held& held : m_points) {
			SurfaceForce kept { P.id[held.point], 0, {}, {} };
			for (std::size_t a = 0; a < dim; ++a)
				kept.force[a] = held.impulse[a] / control.dt;
			P.reactions.push_back(kept);
		}
		std::sort(P.reactions.begin(), P.reactions.end());
	}
	/* Work of the reactions in a step [J] beyond that of the nodes' mean velocities u: the second mapping strains the material with the
	prescribed velocity itself. The reactions of the last step are in balance with the stress; a jump of the velocity is not among them. */
	double workBeyond(const D& d, const NodeVector<dim>& u) const
	{
		const Points& P    = d.transfer.points;
		double        work = 0;
		for (const Held& held : m_points) {
			const V at = m_shares.velocity(held.range, u);
			for (std::size_t a = 0; a < dim; ++a)
				if (isHeld(d, held, a)) work += held.last[a] * (P.velocity[a][held.point] - at[a]);
		}
		return work;
	}
	/* The velocities of the second mapping. */
	void project(D& d)
	{
		if (m_points.empty()) return;
		solve(d, d.fields.velocity);
		if (d.constraints.mirrors()) d.constraints.afterUpdate(d.fields.velocity, Motion::velocity);
	}

private:
	struct Held {
		std::size_t                      tile, point;
		typename NodalShares<dim>::Range range;
		V                                impulse; // of the step [Ns]
		V                                last;    // of the last step
		V                                step, residual, direction, image;
	};
	std::vector<Held> m_points;
	NodalShares<dim>  m_shares;
	NodeVector<dim>   m_scratch;

	bool isHeld(const D& d, const Held& held, std::size_t a) const
	{
		return d.transfer.points.prescribedDofs[held.point] >> a & 1 && held.range.response[a] > 0;
	}
	/* Impulses `step` that give the points their velocities, and their effect on the nodes. */
	void solve(D& d, NodeVector<dim>& velocity)
	{
		constexpr int    most      = 200;
		constexpr double tolerance = 1e-12, softness = 1e-2; // beside the response of a point
		const Points&    P = d.transfer.points;
		for (Field& field : m_scratch)
			field.resize(d.fields.mass.size());
		double norm[dim] {}, scale[dim] {};
		for (Held& held : m_points) {
			const V u = m_shares.velocity(held.range, velocity);
			for (std::size_t a = 0; a < dim; ++a) {
				const double w    = P.velocity[a][held.point];
				held.step[a]      = 0;
				held.residual[a]  = isHeld(d, held, a) ? w - u[a] : 0;
				held.direction[a] = held.residual[a];
				norm[a] += held.residual[a] * held.residual[a];
				scale[a] += isHeld(d, held, a) ? w * w + u[a] * u[a] : 0;
			}
		}
		double least[dim];
		bool   active[dim], any = false;
		for (std::size_t a = 0; a < dim; ++a) {
			least[a]  = std::max(tolerance * tolerance * norm[a], 1e-32 * scale[a]);
			active[a] = norm[a] > least[a];
			any       = any || active[a];
		}
		for (int k = 0; k < most && any; ++k) {
			for (const Held& held : m_points)
				m_shares.push(held.range, held.direction, m_scratch);
			double product[dim] {}, next[dim] {};
			for (Held& held : m_points) {
				auto range  = held.range;
				range.still = {};
				held.image  = m_shares.velocity(range, m_scratch);
				for (std::size_t a = 0; a < dim; ++a) {
					held.image[a] += softness * held.range.response[a] * held.direction[a];
					if (isHeld(d, held, a)) product[a] += held.direction[a] * held.image[a];
				}
			}
			for (const Held& held : m_points)
				for (std::size_t s = held.range.first; s < held.range.last; ++s)
					for (std::size_t a = 0; a < dim; ++a)
						m_scratch[a][std::size_t(m_shares[s].node)] = 0;
			for (Held& held : m_points)
				for (std::size_t a = 0; a < dim; ++a) {
					if (!active[a] || !isHeld(d, held, a) || !(product[a] > 0)) continue;
					held.step[a] += norm[a] / product[a] * held.direction[a];
					held.residual[a] -= norm[a] / product[a] * held.image[a];
					next[a] += held.residual[a] * held.residual[a];
				}
			any = false;
			for (std::size_t a = 0; a < dim; ++a) {
				if (!active[a]) continue;
				active[a] = product[a] > 0 && next[a] > least[a];
				for (Held& held : m_points)
					held.direction[a] = active[a] ? held.residual[a] + next[a] / norm[a] * held.direction[a] : 0;
				norm[a] = next[a];
				any     = any || active[a];
			}
		}
		for (const Held& held : m_points)
			m_shares.push(held.range, held.step, velocity);
	}
};

} // namespace yade::mpm
