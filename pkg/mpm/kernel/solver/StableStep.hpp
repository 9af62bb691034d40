// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "ElasticOperator.hpp"
#include "Lanczos.hpp"
#include "RoundTrip.hpp"

namespace yade::mpm {

/* With the points at rest a step is a symplectic Euler step of the grid velocities (doc/method.md derives it):

  w' = w - dt Q A u,  u' = u + dt w',   A = M^-1 K,  Q = M^-1 N^T m N

with lumped mass M, and K of the points' elastic stiffness. MUSL and USF are stable for dt < 2/omega with omega^2 the
greatest eigenvalue of Q A; USL, which updates stress with velocities that have not been through Q, for
dt^2 lambda (2 - q) < 4, which sqrt(2/lambda) of A alone always satisfies. With the mass correction (2 - Q) Q (2 - Q) takes the place of Q.

Q A is self-adjoint in the Q-weighted product of masses. The estimate has fields of its own: those of the last step stay. */
template <class D> class StableStep {
	static constexpr int dim = D::dim;
	using S                  = typename D::S;
	using Shape              = typename D::Shape;
	using Vector             = Field; // all components of a nodal field, one after the other

public:
	StableStep(D& d, const std::vector<Law>& laws, const StepControl& control)
	    : m_d(d)
	    , m_stiffness(d.transfer, laws, control.largeStrain)
	    , m_nodes(d.transfer.grid.nodeCount())
	{
		NodeFields<S>& sums = m_sums;
		sums.mass.resize(m_nodes), sums.radialMass.resize(hasHoop<S> ? m_nodes : 0), sums.leastMass = d.fields.leastMass;
		for (NodeVector<dim>* field : { &sums.momentum, &sums.force, &sums.velocity })
			field->fill(Field(m_nodes));
		auto masses = [&](std::size_t t) { pointsToGrid<Sums::motion>(d.transfer, sums, control, t); };
		sumOverTiles(d.transfer, masses, sums.mass, sums.radialMass, sums.momentum);
		d.constraints.afterSums(sums.masses());
	}
	/* Largest stable step [s]. */
	double value(Scheme scheme, bool fullMass)
	{
		const Vector start  = startVector();
		auto         apply  = [this](const Vector& x, Vector& y) { stiffness(x, y); };
		auto         inner  = [this](const Vector& x, const Vector& y) { return massProduct(x, y); };
		double       lambda = 0;
		if (scheme == Scheme::usl)
			lambda = 2 * largestEigenvalue(start, apply, inner);
		else {
			Vector     scratch(start.size());
			const bool corrected = fullMass && scheme == Scheme::musl;
			lambda               = largestEigenvalue(
					      start, [&](const Vector& x, Vector& y) { smoothing(x, scratch, corrected), stiffness(scratch, y); },
					      [&](const Vector& x, const Vector& y) {
                                        smoothing(y, scratch, corrected);
                                        return massProduct(x, scratch);
                                });
		}
		return lambda > 0 ? 2 / std::sqrt(lambda) : std::numeric_limits<double>::infinity();
	}

private:
	D&                        m_d;
	ElasticOperator<S, Shape> m_stiffness;
	NodeFields<S>             m_sums; // masses of the points at rest; velocity, momentum and force are scratch
	std::size_t               m_nodes;
	Vector                    m_Qy;

	double massOf(std::size_t k) const { return m_sums.massOf(int(k / m_nodes))[k % m_nodes]; }
	double massProduct(const Vector& x, const Vector& y) const
	{
		double sum = 0;
		for (std::size_t k = 0; k < x.size(); ++k)
			sum += massOf(k) * x[k] * y[k];
		return sum;
	}
	/* Irregular, by the places of the nodes and not by their order in memory. */
	Vector startVector()
	{
		Vector start(dim * m_nodes);
		m_d.transfer.grid.forEachNode([&](const auto& node, std::ptrdiff_t at, int) {
			double phase = 1;
			for (std::size_t d = 0; d < std::size_t(dim); ++d)
				phase += node[d] * (12.9898 + 65.2431 * double(d));
			for (std::size_t d = 0; d < std::size_t(dim); ++d) {
				const std::size_t k = d * m_nodes + std::size_t(at);
				start[k]            = massOf(k) > m_sums.leastMass ? std::sin(phase + 2.1 * double(d)) : 0;
			}
		});
		unpack(start, m_sums.velocity);
		m_d.constraints.clearBehind(m_sums.velocity);
		concatenate(m_sums.velocity, start);
		return start;
	}
	void concatenate(const NodeVector<dim>& field, Vector& y) const
	{
		for (int d = 0; d < dim; ++d)
			std::copy(field[d].begin(), field[d].end(), y.begin() + d * std::ptrdiff_t(m_nodes));
	}
	void unpack(const Vector& x, NodeVector<dim>& field) const
	{
		for (int d = 0; d < dim; ++d)
			std::copy(x.begin() + d * std::ptrdiff_t(m_nodes), x.begin() + (d + 1) * std::ptrdiff_t(m_nodes), field[d].begin());
		m_d.constraints.afterUpdate(field, Motion::increment);
	}
	/* Sums over mass, mirrored, zero behind the walls and on empty nodes. */
	void pack(NodeVector<dim>& sums, Vector& y)
	{
		m_d.constraints.afterSums(m_sums.masses(), sums, Motion::increment);
		divideByMass(m_d.transfer, m_sums, sums, sums);
		m_d.constraints.clearBehind(sums);
		concatenate(sums, y);
	}
	/* y = A x. */
	void stiffness(const Vector& x, Vector& y)
	{
		unpack(x, m_sums.velocity);
		m_stiffness.apply(m_sums.velocity, m_sums.force);
		pack(m_sums.force, y);
	}
	/* y = Q x; corrected: (2 - Q)^2 Q x. */
	void smoothing(const Vector& x, Vector& y, bool corrected)
	{
		roundTrip(x, y);
		m_Qy.resize(y.size());
		for (int k = 0; corrected && k < 2; ++k) {
			roundTrip(y, m_Qy);
			for (std::size_t i = 0; i < y.size(); ++i)
				y[i] = 2 * y[i] - m_Qy[i];
		}
	}
	void roundTrip(const Vector& x, Vector& y)
	{
		unpack(x, m_sums.velocity);
		spreadVelocities(m_d.transfer, &m_sums.velocity, m_sums.momentum);
		pack(m_sums.momentum, y);
	}
};

} // namespace yade::mpm
