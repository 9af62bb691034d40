// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "MpmSolver.hpp"

namespace yade::mpm {

/* With the points at rest a step is a symplectic Euler step of the grid velocities (doc/method.md derives it):

  w' = w - dt Q A u,  u' = u + dt w',   A = M^-1 K,  Q = M^-1 N^T m N

with lumped mass M, and K of the points' elastic stiffness. MUSL and USF are stable for dt < 2/omega with omega^2 the
greatest eigenvalue of Q A; USL, which updates stress with velocities that have not been through Q, for
dt^2 lambda (2 - q) < 4, which sqrt(2/lambda) of A alone always satisfies. With the full mass (2 - Q) Q (2 - Q) takes the place of Q. */
template <class S, class Shape> double MpmSolver<S, Shape>::acousticTimeStep(Scheme scheme, bool fullMass)
{
	if (m_points.count() == 0) return std::numeric_limits<double>::infinity();
	finish();
	layGrid();
	m_band.releaseContacts();
	clearSums();
	forEachTile([&](std::size_t t) { pointsToGrid<false>(t); });
	const std::size_t nodes = m_mass.size();
	NodeVector<dim>   f;
	for (Column& c : f)
		c.assign(nodes, 0);
	m_band.foldAtRest(f);
	m_band.foldMassAtRest(nodeMass()); // masses in front of the walls
	const double      least   = leastMass();
	std::vector<Wall> resting = m_walls;
	for (Wall& wall : resting)
		wall.velocity = { 0, 0, 0 };

	auto unpack = [&](const Column& x, NodeVector<dim>& field) {
		for (int d = 0; d < dim; ++d)
			std::copy(x.begin() + d * std::ptrdiff_t(nodes), x.begin() + (d + 1) * std::ptrdiff_t(nodes), field[d].begin());
		m_band.unfold(resting, field, false);
	};
	// folded sums over mass, zero behind the walls and on empty nodes
	auto pack = [&](NodeVector<dim>& sums, Column& y) {
		m_band.foldAtRest(sums);
		divideByMass(sums);
		m_band.clearBehind(sums);
		for (int d = 0; d < dim; ++d)
			std::copy(sums[d].begin(), sums[d].end(), y.begin() + d * std::ptrdiff_t(nodes));
	};
	auto stiffness = [&](const Column& x, Column& y) { // y = A x
		unpack(x, m_velocity);
		clear(f);
		forEachTile([&](std::size_t t) {
			const auto& tile = m_grid.tiles()[t];
			Patch       v[dim], fi[dim] {};
			for (int d = 0; d < dim; ++d)
				read(tile, m_velocity[d], v[d]);
			for (std::size_t p = tile.begin; p < tile.end; ++p) {
				const Weights w   = weights(tile, p);
				const Law&    law = m_laws[m_points.material[p]];
				double        G[gradients<S>], F[dim * dim], s[N], Vs[dim][dim];
				const double  r = m_points.position[0][p];
				Increment<S>  increment;
				displacementGradient(w, v, r, 1, G);
				increment.small(G);
				S::elastic(law.elastic, increment.strain, s);
				for (int k = 0; k < dim * dim; ++k)
					F[k] = m_points.deformation[k][p];
				const double V = law.stiffnessBound() * volume(p, F);
				for (int d = 0; d < dim; ++d)
					for (int e = 0; e < dim; ++e)
						Vs[d][e] = V * s[component(d, e)];
				forEachNode(w, [&](int i, double Nip, const std::array<double, dim>& grad) {
					for (int d = 0; d < dim; ++d)
						for (int e = 0; e < dim; ++e)
							fi[d][i] += Vs[d][e] * grad[e];
					if constexpr (hoop) fi[0][i] += V * s[2] / r * Nip;
				});
			}
			for (int d = 0; d < dim; ++d)
				add(tile, fi[d], f[d]);
		});
		pack(f, y);
	};
	auto smoothing = [&](const Column& x, Column& y) { // y = Q x
		unpack(x, m_velocity);
		spreadVelocities(&m_velocity, f);
		pack(f, y);
	};

	// Q A is self-adjoint where A is the metric: iterate on A Q instead, similar to it and symmetric in the Q-weighted product
	const auto masses = nodeMass();
	auto       massOf = [&](std::size_t k) { return (*masses[k / nodes])[k % nodes]; };
	Column     start(dim * nodes), scratch(dim * nodes);
	for (std::size_t k = 0; k < start.size(); ++k)
		start[k] = massOf(k) > least ? std::sin(1 + 12.9898 * double(k)) : 0;
	NodeVector<dim> shaped = m_velocity;
	unpack(start, shaped);
	m_band.clearBehind(shaped);
	for (int d = 0; d < dim; ++d)
		std::copy(shaped[d].begin(), shaped[d].end(), start.begin() + d * std::ptrdiff_t(nodes));

	auto massInner = [&](const Column& x, const Column& y) {
		double sum = 0;
		for (std::size_t k = 0; k < x.size(); ++k)
			sum += massOf(k) * x[k] * y[k];
		return sum;
	};
	Column trip(dim * nodes);
	auto   massFactor = [&](const Column& x, Column& y) { // Q x or (2 - Q)^2 Q x
                smoothing(x, y);
                for (int k = 0; fullMass && scheme == Scheme::musl && k < 2; ++k) {
			  smoothing(y, trip);
			  for (std::size_t i = 0; i < y.size(); ++i)
                                y[i] = 2 * y[i] - trip[i];
                }
	};
	double lambda;
	if (scheme == Scheme::usl)
		lambda = 2 * largestEigenvalue(start, stiffness, massInner);
	else
		lambda = largestEigenvalue(
			start, [&](const Column& x, Column& y) { massFactor(x, scratch), stiffness(scratch, y); },
			[&](const Column& x, const Column& y) {
				massFactor(y, scratch);
				return massInner(x, scratch);
			});
	return lambda > 0 ? 2 / std::sqrt(lambda) : std::numeric_limits<double>::infinity();
}

template <class S, class Shape> double MpmSolver<S, Shape>::crossingRate() const
{
	const auto cell     = makeGeometry<dim>(m_cellSize, m_walls).cell;
	double     crossing = 0;
	for (int d = 0; d < dim; ++d)
		for (std::size_t p = 0; p < m_points.count(); ++p)
			crossing = std::max(crossing, std::abs(m_points.velocity[d][p]) / cell[d]);
	return crossing;
}

} // namespace yade::mpm
