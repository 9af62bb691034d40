// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <Eigen/Dense>
#include <algorithm>
#include <vector>

namespace yade::mpm {

/* The point nearest to the origin of the convex hull of some places: Wolfe's algorithm (Mathematical Programming 11 (1976) 128).
It is given by at most dim + 1 of the places and their weights, which sum to one. */
template <int dim> class NearestOfHull {
public:
	using Vector = Eigen::Matrix<double, dim, 1>;
	std::vector<std::size_t> corners; // the places
	std::vector<double>      weights;
	Vector                   nearest = Vector::Zero();

	explicit NearestOfHull(const std::vector<Vector>& places)
	{
		if (places.empty()) return;
		std::size_t first = 0;
		double      scale = 0;
		for (std::size_t k = 0; k < places.size(); ++k) {
			scale = std::max(scale, places[k].squaredNorm());
			if (places[k].squaredNorm() < places[first].squaredNorm()) first = k;
		}
		corners = { first }, weights = { 1. }, nearest = places[first];
		for (std::size_t major = 0; major < 4 * places.size() + 8; ++major) {
			std::size_t next = first;
			for (std::size_t k = 0; k < places.size(); ++k)
				if (nearest.dot(places[k]) < nearest.dot(places[next])) next = k;
			if (nearest.dot(places[next]) > nearest.squaredNorm() - 1e-12 * scale) return;
			if (std::find(corners.begin(), corners.end(), next) != corners.end()) return;
			corners.push_back(next), weights.push_back(0);
			while (!takeAffine(places)) {
			}
		}
	}

private:
	/* The nearest point of the corners' affine hull, or of the way to it before a weight turns negative; false: a corner was dropped. */
	bool takeAffine(const std::vector<Vector>& places)
	{
		const int       n = int(corners.size());
		Eigen::MatrixXd gram(n, n);
		for (int i = 0; i < n; ++i)
			for (int j = 0; j < n; ++j)
				gram(i, j) = places[corners[std::size_t(i)]].dot(places[corners[std::size_t(j)]]);
		const double scale = gram.trace() / n;
		gram.array() += scale; // G + 1 1^T is regular where the corners are affinely independent
		Eigen::VectorXd alpha = gram.ldlt().solve(Eigen::VectorXd::Ones(n));
		alpha /= alpha.sum();
		double theta = 1;
		for (int i = 0; i < n; ++i)
			if (alpha[i] < 1e-13) theta = std::min(theta, weights[std::size_t(i)] / (weights[std::size_t(i)] - alpha[i]));
		std::size_t gone = corners.size();
		nearest.setZero();
		double least = 1e-13;
		for (std::size_t i = 0; i < corners.size(); ++i) {
			weights[i] += theta * (alpha[int(i)] - weights[i]);
			if (theta < 1 && weights[i] < least) least = weights[i], gone = i;
		}
		if (gone < corners.size()) {
			corners.erase(corners.begin() + std::ptrdiff_t(gone)), weights.erase(weights.begin() + std::ptrdiff_t(gone));
			double sum = 0;
			for (const double w : weights)
				sum += w;
			for (double& w : weights)
				w /= sum;
		}
		for (std::size_t i = 0; i < corners.size(); ++i)
			nearest += weights[i] * places[corners[i]];
		return theta >= 1 || corners.size() == 1;
	}
};

} // namespace yade::mpm
