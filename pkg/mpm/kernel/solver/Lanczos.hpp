// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <Eigen/Dense>
#include <vector>

namespace yade::mpm {

/* Greatest eigenvalue of an operator that is self-adjoint and positive in the given inner product, by Lanczos' iteration
without re-orthogonalisation (the extreme values converge first and are what is wanted; Golub & Van Loan, ch. 10).

apply(x, y): y = A x; inner(x, y); both on vectors like start. Stops when the value has grown five times running by less than 1e-4 of itself: an
eigenvector that start has little of, at the edge of a body, shows after a plateau. */
template <class Vector, class Apply, class Inner> double largestEigenvalue(Vector start, Apply&& apply, Inner&& inner, int maxIterations = 100)
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
	double              last  = 0;
	int                 still = 0; // iterations running
	for (int k = 0; k < maxIterations; ++k) {
		apply(q, w);
		alpha.push_back(inner(q, w));
		for (std::size_t i = 0; i < w.size(); ++i)
			w[i] -= alpha.back() * q[i] + (k ? beta.back() * previous[i] : 0);
		Eigen::Map<const Eigen::VectorXd>              diagonal(alpha.data(), long(alpha.size())), off(beta.data(), long(beta.size()));
		Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver;
		solver.computeFromTridiagonal(diagonal, off, Eigen::EigenvaluesOnly);
		const double value = solver.eigenvalues().maxCoeff();
		const double b     = std::sqrt(inner(w, w));
		still              = value - last < 1e-4 * value ? still + 1 : 0;
		if (!(b > 1e-12 * value) || still == 5) return value;
		last = value;
		beta.push_back(b);
		previous = std::move(q);
		q        = scaled(w, 1 / b);
	}
	return last;
}

} // namespace yade::mpm
