// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "Dual.hpp"
#include "Response.hpp"
#include "StressState.hpp"

namespace yade::mpm {

/* The consistent tangent d sigma/d epsilon of a law's update over a strain increment, N x N and row-major: the derivative of the
stress at the end of the step, by automatic differentiation of the update itself. sigma and internal are those at the start. */
template <class S, class Model>
void differentiateUpdate(const Model& law, const Hooke& C, const double* strain, const double* sigma, const double* internal, double* tangent)
{
	constexpr int N = S::N;
	using T         = Dual<N>;
	Pack<1, T>      e[N], s[N], state[Model::maxInternals.columns(N) + 1] {};
	Responses<1, T> response;
	for (int k = 0; k < N; ++k)
		e[k][0] = strain[k], e[k][0].slope[k] = 1, s[k][0] = sigma[k];
	for (int k = 0; k < law.internals().columns(N); ++k)
		state[k][0] = internal[k];
	law.template update<S, 1, T>(C, e, s, state, response);
	for (int i = 0; i < N; ++i)
		for (int j = 0; j < N; ++j)
			tangent[i * N + j] = s[i].value[0].slope[j];
}

/* Carries a tangent in the components of Solid over to a stress state with stress-free normals, which all have the same strain:
static condensation of that strain. */
template <class S> void condenseTangent(const double* solid, double* tangent)
{
	constexpr int N = S::N, kept = normals<S>();
	// columns: the components of S, then the common strain of the free normals
	double rows[N][N + 1], freeRow[N + 1];
	auto   column = [&](int i, int j) {
                if (j < N) return solid[6 * i + S::voigtIndex[std::size_t(j)]];
                double sum = 0;
                for (int k = kept; k < 3; ++k)
                        sum += solid[6 * i + k];
                return sum;
	};
	for (int j = 0; j <= N; ++j) {
		for (int i = 0; i < N; ++i)
			rows[i][j] = column(S::voigtIndex[std::size_t(i)], j);
		freeRow[j] = column(2, j);
	}
	// where the free normals carry no tension, their strain has no effect
	const bool opens = !(std::abs(freeRow[N]) > 1e-9 * std::abs(solid[0])) && !(std::abs(freeRow[N]) > 1e-9 * std::abs(rows[0][0]));
	for (int i = 0; i < N; ++i)
		for (int j = 0; j < N; ++j)
			tangent[i * N + j] = rows[i][j] - (opens ? 0 : rows[i][N] * freeRow[j] / freeRow[N]);
}

} // namespace yade::mpm
