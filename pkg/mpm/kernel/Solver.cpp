// SPDX-License-Identifier: GPL-2.0-or-later
#include "MpmSolver.hpp"

namespace yade::mpm {

int dimension(Analysis analysis) { return analysis == Analysis::uniaxial ? 1 : analysis == Analysis::solid ? 3 : 2; }

int stressComponents(Analysis analysis)
{
	switch (analysis) {
		case Analysis::uniaxial: return Uniaxial::N;
		case Analysis::planeStress: return PlaneStress::N;
		case Analysis::planeStrain: return PlaneStrain::N;
		case Analysis::solid: return Solid::N;
	}
	throw std::logic_error("unknown analysis");
}

namespace {
	template <class S>
	std::unique_ptr<Solver> make(Analysis a, ShapeKind shape, double cellSize, Points& points, const std::vector<Law>& laws, std::vector<Wall>& walls)
	{
		switch (shape) {
			case ShapeKind::linear: return std::make_unique<MpmSolver<S, LinearShape>>(a, cellSize, points, laws, walls);
			case ShapeKind::gimp: return std::make_unique<MpmSolver<S, GimpShape>>(a, cellSize, points, laws, walls);
			case ShapeKind::quadratic: return std::make_unique<MpmSolver<S, QuadraticShape>>(a, cellSize, points, laws, walls);
			case ShapeKind::cubic: return std::make_unique<MpmSolver<S, CubicShape>>(a, cellSize, points, laws, walls);
		}
		throw std::logic_error("unknown shape function");
	}
} // namespace

std::unique_ptr<Solver> makeSolver(Analysis analysis, ShapeKind shape, double cellSize, Points& points, const std::vector<Law>& laws, std::vector<Wall>& walls)
{
	switch (analysis) {
		case Analysis::uniaxial: return make<Uniaxial>(analysis, shape, cellSize, points, laws, walls);
		case Analysis::planeStress: return make<PlaneStress>(analysis, shape, cellSize, points, laws, walls);
		case Analysis::planeStrain: return make<PlaneStrain>(analysis, shape, cellSize, points, laws, walls);
		case Analysis::solid: return make<Solid>(analysis, shape, cellSize, points, laws, walls);
	}
	throw std::logic_error("unknown analysis");
}

} // namespace yade::mpm
