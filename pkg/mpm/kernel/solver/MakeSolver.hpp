// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "MpmSolver.hpp"

namespace yade::mpm {

/* The solvers of a stress state. Each state has a source file of its own, to be compiled side by side. */
template <class S>
std::unique_ptr<Solver> makeSolverOf(Analysis a, ShapeKind shape, double cellSize, Points& points, const std::vector<Law>& laws, std::vector<Wall>& walls)
{
	switch (shape) {
		case ShapeKind::linear: return std::make_unique<MpmSolver<S, LinearShape>>(a, cellSize, points, laws, walls);
		case ShapeKind::gimp: return std::make_unique<MpmSolver<S, GimpShape>>(a, cellSize, points, laws, walls);
		case ShapeKind::quadratic: return std::make_unique<MpmSolver<S, QuadraticShape>>(a, cellSize, points, laws, walls);
		case ShapeKind::cubic: return std::make_unique<MpmSolver<S, CubicShape>>(a, cellSize, points, laws, walls);
	}
	throw std::logic_error("unknown shape function");
}

} // namespace yade::mpm
