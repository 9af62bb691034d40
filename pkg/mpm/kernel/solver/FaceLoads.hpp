// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "../Text.hpp"
#include "../Traction.hpp"
#include "NodeFields.hpp"
#include "Solver.hpp"
#include <Eigen/Dense>

namespace yade::mpm {

/* Tractions: f_i += sum_k N_i(x_k) t_k, the integral of N_i t over the face by its quadrature points x_k, which then move with
the nodal velocities, dx_k = dt sum_i N_i(x_k) v_i.

A face lies further out than the outermost material points, and some of its nodes may have no mass. They have no velocity either: their part of N goes
to the other nodes of the same quadrature point in proportion, so that the whole load arrives. A node counts as massless below 1e-3 N of the
greatest mass around: the load would throw its sliver of material away, and the face after it (USF, USL). Where a body is full up to a face on
nodes, the ratio is 1/4 for cubic functions, in a corner 1/64. */
template <class D> class FaceLoads {
	static constexpr int dim = D::dim, support = D::Shape::support;

public:
	/* Finds the nodes that each quadrature point loads; after the sums. */
	void locate(const D& d, double time)
	{
		constexpr double sliver = 1e-3;
		constexpr int    count  = ipow(support, dim);
		const auto&      g      = d.transfer.geometry;
		m_nodes.clear(), m_ends.clear();
		for (std::size_t f = 0; f < d.transfer.points.tractions.size(); ++f) {
			const Traction& face = *d.transfer.points.tractions[f];
			for (std::size_t k = 0; k < face.count(); ++k) {
				double     N[dim][support], dN[dim][support];
				NodeIndex  base;
				const auto begin = std::ptrdiff_t(m_nodes.size());
				for (int a = 0; a < dim; ++a) {
					const double xi = g.xi(a, face.position[std::size_t(a)][k]), r = d.transfer.halfSize(a, 0);
					if (!(std::abs(xi) < 1 << 28)) fail(face, f, k, "has left the grid", time);
					const double first   = std::floor(xi - D::Shape::shift(r));
					base[std::size_t(a)] = int(first);
					D::Shape::evaluate(xi, first, r, N[a], dN[a]);
				}
				double greatest = 0, sum = 0;
				for (int n = 0; n < count; ++n) {
					Node      node { 0, 1, {} };
					NodeIndex at = base;
					node.gradient.fill(1);
					for (int a = 0, rest = n; a < dim; ++a, rest /= support) {
						const int i = rest % support;
						at[std::size_t(a)] += i;
						node.N *= N[a][i];
						for (int e = 0; e < dim; ++e)
							node.gradient[std::size_t(e)] *= e == a ? dN[a][i] / g.cell[std::size_t(a)] : N[a][i];
					}
					const std::ptrdiff_t place = d.transfer.grid.find(at);
					if (place < 0) continue;
					node.node = std::size_t(place);
					greatest  = std::max(greatest, d.fields.mass[node.node]);
					m_nodes.push_back(node);
				}
				const auto massless = [&](const Node& n) {
					return d.fields.mass[n.node] <= std::max(d.fields.leastMass, sliver * n.N * greatest);
				};
				m_nodes.erase(std::remove_if(m_nodes.begin() + begin, m_nodes.end(), massless), m_nodes.end());
				for (auto n = m_nodes.begin() + begin; n != m_nodes.end(); ++n)
					sum += n->N;
				if (!(sum > .5))
					fail(face, f, k, "has lost the material: less than half of its shape functions belongs to nodes with mass", time);
				for (auto n = m_nodes.begin() + begin; n != m_nodes.end(); ++n)
					n->N /= sum;
				m_ends.push_back(m_nodes.size());
			}
		}
	}
	/* Adds the loads to a nodal force. */
	void spread(const D& d, NodeVector<dim>& force) const
	{
		for (Traction* face : d.transfer.points.tractions)
			face->resultant = { 0, 0, 0 };
		forEachPoint(d, [&](Traction& face, std::size_t k, const Node* begin, const Node* end) {
			for (std::size_t a = 0; a < std::size_t(dim); ++a) {
				const double f = face.force(k, a);
				face.resultant[a] += f;
				for (const Node* n = begin; n != end; ++n)
					force[a][n->node] += n->N * f;
			}
		});
	}
	/* Moves the faces with the nodes' velocities. */
	void move(const D& d, double dt, bool largeStrain) const
	{
		using Vector = Eigen::Matrix<double, dim, 1>;
		forEachPoint(d, [&](Traction& face, std::size_t k, const Node* begin, const Node* end) {
			Vector                          v = Vector::Zero();
			Eigen::Matrix<double, dim, dim> A = Eigen::Matrix<double, dim, dim>::Identity(); // 1 + dt grad v
			for (const Node* n = begin; n != end; ++n)
				v += n->N * velocity(d, *n);
			for (const Node* n = begin; n != end; ++n) // massless nodes move with the face
				A += dt * (velocity(d, *n) - v) * Eigen::Map<const Vector>(n->gradient.data()).transpose();
			const double radius = face.position[0][k];
			for (int a = 0; a < dim; ++a)
				face.position[std::size_t(a)][k] += dt * v[a];
			if (!largeStrain) return;
			Vector area; // Nanson: n da = det(A) A^-T N dA
			for (int a = 0; a < dim; ++a)
				area[a] = face.area[std::size_t(a)][k];
			area = A.determinant() * (hasHoop<typename D::S> ? 1 + dt * v[0] / radius : 1) * (A.inverse().transpose() * area).eval();
			for (int a = 0; a < dim; ++a)
				face.area[std::size_t(a)][k] = area[a];
		});
	}

private:
	using NodeIndex = typename D::T::Grid::Index;
	struct Node { // of a quadrature point of a face
		std::size_t             node;
		double                  N;
		std::array<double, dim> gradient; // [1/m]
	};
	std::vector<Node>        m_nodes;
	std::vector<std::size_t> m_ends; // of the nodes of each quadrature point

	/* visit(face, its point, nodes begin to end) */
	template <class Visit> void forEachPoint(const D& d, Visit&& visit) const
	{
		std::size_t begin = 0, place = 0;
		for (Traction* face : d.transfer.points.tractions)
			for (std::size_t k = 0; k < face->count(); ++k) {
				const std::size_t end = m_ends[place++];
				visit(*face, k, m_nodes.data() + begin, m_nodes.data() + end);
				begin = end;
			}
	}
	static Eigen::Matrix<double, dim, 1> velocity(const D& d, const Node& n)
	{
		Eigen::Matrix<double, dim, 1> v;
		for (int a = 0; a < dim; ++a)
			v[a] = d.fields.velocity[std::size_t(a)][n.node];
		return v;
	}
	[[noreturn]] static void fail(const Traction& face, std::size_t f, std::size_t k, const char* what, double time)
	{
		std::string where;
		for (std::size_t a = 0; a < std::size_t(dim); ++a)
			where += (a ? ", " : "") + number(face.position[a][k]);
		throw StepFailure("point " + std::to_string(k) + " of traction " + std::to_string(f) + " " + what + " at time " + number(time)
					  + " s, position (" + where + ") m: place the face on the surface of the material points, or reduce O.dt or the load",
			-1);
	}
};

} // namespace yade::mpm
