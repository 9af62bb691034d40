// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "../Text.hpp"
#include "NodeFields.hpp"
#include "Solver.hpp"

namespace yade::mpm {

/* Ends a run with the point, the place and the remedy. Positions are those at the end of the step. */
template <int dim, class Shape> class PointChecks {
public:
	explicit PointChecks(const Transfer<dim, Shape>& transfer)
	    : m_transfer(transfer)
	{
	}
	/* Throws unless the point is finite, in front of the walls and within the range of node indices. */
	void requireOnGrid(std::size_t p, bool hoop, double time) const
	{
		constexpr double range = 1 << 28, tolerance = 1e-9; // in cells
		const auto&      g = m_transfer.geometry;
		for (int d = 0; d < dim; ++d) {
			const std::size_t a = std::size_t(d);
			const double      x = position(d, p), xi = g.xi(d, x);
			if (!std::isfinite(x) || !std::isfinite(m_transfer.points.velocity[a][p]))
				fail(p, "has a non-finite position or velocity", "reduce O.dt (mpm.criticalTimeStep() is the limit), or check the loads on it",
					time);
			if (!(xi >= g.xiMin[a] - tolerance) || !(xi <= g.xiMax[a] + tolerance))
				fail(p, "has left the walls", "check that walls and points overlap as meant, reduce O.dt, or refine the points", time);
			if (hoop && d == 0 && !(x > 0))
				fail(p, "is not at a positive radius", "in axisymmetry x is the radius: place points at x > 0, or reduce O.dt", time);
			if (std::abs(xi) > range)
				fail(p, "is too far from the origin of the grid", "move the scene nearer to the origin, or enlarge cellSize", time);
		}
	}
	[[noreturn]] void fail(std::size_t p, const char* what, const char* remedy, double time) const
	{
		std::string where, cell;
		for (int d = 0; d < dim; ++d) {
			const double x = position(d, p), xi = m_transfer.geometry.xi(d, x);
			where += (d ? ", " : "") + number(x);
			cell += (d ? ", " : "") + (std::isfinite(xi) ? std::to_string((long long)(std::floor(xi))) : "none");
		}
		throw StepFailure("material point " + std::to_string(m_transfer.points.id[p]) + " " + what + " at time " + number(time) + " s, position ("
					  + where + ") m, cell (" + cell + "): " + remedy,
			m_transfer.points.id[p]);
	}

private:
	const Transfer<dim, Shape>& m_transfer;

	double position(int d, std::size_t p) const
	{
		const Points& P = m_transfer.points;
		return P.position[std::size_t(d)][p] + (P.displacementIncrement.empty() ? 0 : P.displacementIncrement[std::size_t(d)][p]);
	}
};

} // namespace yade::mpm
