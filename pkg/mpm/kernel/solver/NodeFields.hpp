// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "../boundary/NodeConstraints.hpp"
#include "../laws/StressState.hpp"
#include "../transfer/Transfer.hpp"

namespace yade::mpm {

/* The nodal fields of a step, each with one meaning throughout. */
template <class S> struct NodeFields {
	static constexpr int  dim  = S::dim;
	static constexpr bool hoop = hasHoop<S>;

	Field           mass;              // m_i = sum N_ip m_p
	Field           radialMass;        // axisymmetry: sum N_ip m_p r_p / r_i, the lumped mass for radial motion
	NodeVector<dim> momentum;          // (m v)_i = sum N_ip m_p v_p: eq. 12, and again with the new velocities in MUSL
	NodeVector<dim> force;             // f_i, eq. 13
	NodeVector<dim> velocity;          // v_i that eq. 14 ends with; after MUSL's second mapping those that strain the points
	NodeVector<dim> velocityIncrement; // dt a_i, eq. 14
	double          leastMass = 0;     // nodes with no more are empty but for rounding

	/* Lumped mass for the motion along axis d. */
	const Field&  massOf(int d) const { return hoop && d == 0 ? radialMass : mass; }
	NodeMass<dim> masses()
	{
		NodeMass<dim> all;
		all.fill(&mass);
		if constexpr (hoop) all[0] = &radialMass;
		return all;
	}
	static double inverse(double mass, double least) { return mass > least ? 1 / mass : 0; }

	void resize(std::size_t nodes)
	{
		mass.assign(nodes, 0);
		if (hoop) radialMass.assign(nodes, 0);
		for (auto* field : { &momentum, &force, &velocity, &velocityIncrement })
			for (Field& component : *field)
				component.assign(nodes, 0);
	}
	std::size_t bytes() const { return mass.size() * sizeof(double) * (1 + hoop + 4 * dim); }
};

/* Points laid over the grid, nodal fields, and the constraints on the nodes: what all rooms of a step work on. */
template <class S_, class Shape_> struct Discretization {
	using S                  = S_;
	using Shape              = Shape_;
	static constexpr int dim = S::dim;
	using T                  = Transfer<dim, Shape>;
	using Tile               = typename T::Tile;
	using Values             = typename T::Values;
	using Weights            = typename T::Weights;
	using Patch              = typename T::Patch;

	T                    transfer;
	NodeConstraints<dim> constraints;
	NodeFields<S>        fields {};
};

/* Whether the points carry rotation: the affine transfer. */
template <class D> bool rotates(const D& d) { return !d.transfer.points.angularVelocity.empty(); }

namespace detail {
	inline void zero(Field& field, std::size_t begin, std::size_t end)
	{
		if (!field.empty()) std::fill(field.data() + begin, field.data() + end, 0.);
	}
	template <std::size_t dim> void zero(std::array<Field, dim>& field, std::size_t begin, std::size_t end)
	{
		for (Field& component : field)
			zero(component, begin, end);
	}
} // namespace detail

template <int dim, class Shape, class... Fields> void clear(const Transfer<dim, Shape>& transfer, Fields&... fields)
{
	transfer.forEachNodeRange([&](std::size_t begin, std::size_t end) { (detail::zero(fields, begin, end), ...); });
}

/* The one way from points to nodes. Every tile adds its share to the fields, work(t); afterwards each node has its whole sum.
What makes up a sum besides tiles (the halo of another rank) enters here, and nowhere else. */
template <int dim, class Shape, class Work, class... Fields> void sumOverTiles(const Transfer<dim, Shape>& transfer, Work&& work, Fields&... sums)
{
	clear(transfer, sums...);
	transfer.forEachTile(work);
}

/* v_i = (m v)_i / m_i; zero on empty nodes. The two may be one field. */
template <class S, class Shape>
void divideByMass(const Transfer<S::dim, Shape>& transfer, const NodeFields<S>& fields, const NodeVector<S::dim>& momentum, NodeVector<S::dim>& velocity)
{
	transfer.forEachNodeRange([&](std::size_t begin, std::size_t end) {
		const double least = fields.leastMass;
		for (int d = 0; d < S::dim; ++d) {
			const double *m = fields.massOf(d).data(), *mv = momentum[d].data();
			double*       v = velocity[d].data();
#pragma omp simd
			for (std::size_t i = begin; i < end; ++i)
				v[i] = mv[i] * NodeFields<S>::inverse(m[i], least);
		}
	});
}

/* v_i = (m v)_i / m_i under the constraints, of a momentum that the points have brought to the nodes or of an increment of one. */
template <class D> void velocityFromMomentum(D& d, NodeVector<D::dim>& momentum, NodeVector<D::dim>& velocity, Motion motion)
{
	d.constraints.afterSums(d.fields.masses(), momentum, motion);
	divideByMass(d.transfer, d.fields, momentum, velocity);
	d.constraints.afterUpdate(velocity, motion);
}

} // namespace yade::mpm
