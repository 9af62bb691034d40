// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <Eigen/Dense>
#include <stdexcept>
#include <vector>

namespace yade::mpm {

/* Greatest eigenvalue of an operator that is self-adjoint and positive in the given inner product, by Lanczos' iteration
without re-orthogonalisation (the extreme values converge first, and only the greatest is needed; Golub & Van Loan, ch. 10).

Returns Ritz value plus residual. The Ritz value alone is a lower bound; an eigenvalue lies within the residual of it.

apply(x, y): y = A x; inner(x, y); both on vectors like start. Stops when the value has grown five times running by less than
1e-4 of itself (an edge mode that is nearly orthogonal to the start vector appears only after a plateau) and the residual is
below `accuracy` times the value. Throws std::runtime_error where the residual stays above a twentieth of the value. */
template <class Vector, class Apply, class Inner>
double largestEigenvalue(Vector start, Apply&& apply, Inner&& inner, double accuracy = 1e-3, int maxIterations = 200)
{
	auto scaled = [](Vector v, double factor) {
		for (double& x : v)
			x *= factor;
		return v;
	};
	const double norm = std::sqrt(inner(start, start));
	if (!(norm > 0)) return 0;
	Vector              q = scaled(std::move(start), 1 / norm), previous(q.size(), 0.), w(q.size());
	std::vector<double> alpha, beta;
	double              last = 0, residual = 0;
	int                 still = 0; // iterations running
	for (int k = 0; k < maxIterations; ++k) {
		apply(q, w);
		alpha.push_back(inner(q, w));
		for (std::size_t i = 0; i < w.size(); ++i)
			w[i] -= alpha.back() * q[i] + (k ? beta.back() * previous[i] : 0);
		const double b = std::sqrt(inner(w, w));

		Eigen::Map<const Eigen::VectorXd>              diagonal(alpha.data(), long(alpha.size())), off(beta.data(), long(beta.size()));
		Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> ritz;
		ritz.computeFromTridiagonal(diagonal, off, Eigen::EigenvaluesOnly);
		const double value = ritz.eigenvalues()[k]; // they come in ascending order
		still              = value - last < 1e-4 * value ? still + 1 : 0;
		last               = value;
		if (!(b > 1e-12 * value)) return value;
		if (still >= 5 || k + 1 == maxIterations) {
			ritz.computeFromTridiagonal(diagonal, off);
			residual = b * std::abs(ritz.eigenvectors()(k, k));
			if (residual <= accuracy * value) return value + residual;
		}
		beta.push_back(b);
		previous = std::move(q);
		q        = scaled(w, 1 / b);
	}
	if (!(residual <= .05 * last))
		throw std::runtime_error("the largest stable time step was not found in " + std::to_string(maxIterations)
					 + " iterations: look for points far stiffer or lighter than the others, or set O.dt and timeStepSafety = 0");
	return last + residual;
}

} // namespace yade::mpm
