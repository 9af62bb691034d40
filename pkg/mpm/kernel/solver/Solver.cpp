// SPDX-License-Identifier: GPL-2.0-or-later
#include "Solver.hpp"

namespace yade::mpm {

int dimension(Analysis analysis) { return analysis == Analysis::uniaxial ? 1 : analysis == Analysis::solid ? 3 : 2; }

int stressComponents(Analysis analysis)
{
	switch (analysis) {
		case Analysis::uniaxial: return Uniaxial::N;
		case Analysis::planeStress: return PlaneStress::N;
		case Analysis::planeStrain: return PlaneStrain::N;
		case Analysis::axisymmetric: return Axisymmetric::N;
		case Analysis::solid: return Solid::N;
	}
	throw std::logic_error("unknown analysis");
}

template <class S> std::unique_ptr<Solver> makeSolverOf(Analysis, ShapeKind, double, Points&, const std::vector<Law>&, std::vector<Wall>&);

std::unique_ptr<Solver> makeSolver(Analysis analysis, ShapeKind shape, double cellSize, Points& points, const std::vector<Law>& laws, std::vector<Wall>& walls)
{
	switch (analysis) {
		case Analysis::uniaxial: return makeSolverOf<Uniaxial>(analysis, shape, cellSize, points, laws, walls);
		case Analysis::planeStress: return makeSolverOf<PlaneStress>(analysis, shape, cellSize, points, laws, walls);
		case Analysis::planeStrain: return makeSolverOf<PlaneStrain>(analysis, shape, cellSize, points, laws, walls);
		case Analysis::axisymmetric: return makeSolverOf<Axisymmetric>(analysis, shape, cellSize, points, laws, walls);
		case Analysis::solid: return makeSolverOf<Solid>(analysis, shape, cellSize, points, laws, walls);
	}
	throw std::logic_error("unknown analysis");
}

template <class S> Energies storedEnergyOf(const Law& law, const Points& points, std::size_t p)
{
	double sigma[S::N], internal[maxInternals(S::N)] {};
	for (std::size_t k = 0; k < std::size_t(S::N); ++k)
		sigma[k] = points.stress[k][p];
	for (std::size_t k = 0; k < points.internal.size(); ++k)
		internal[k] = points.internal[k][p];
	Energies stored;
	stored.elastic = elasticEnergy<S>(law, sigma, internal), stored.hardening = hardeningEnergy<S>(law, internal);
	return stored;
}

Energies storedEnergy(Analysis analysis, const Law& law, const Points& points, std::size_t p)
{
	switch (analysis) {
		case Analysis::uniaxial: return storedEnergyOf<Uniaxial>(law, points, p);
		case Analysis::planeStress: return storedEnergyOf<PlaneStress>(law, points, p);
		case Analysis::planeStrain: return storedEnergyOf<PlaneStrain>(law, points, p);
		case Analysis::axisymmetric: return storedEnergyOf<Axisymmetric>(law, points, p);
		case Analysis::solid: return storedEnergyOf<Solid>(law, points, p);
	}
	throw std::logic_error("unknown analysis");
}

} // namespace yade::mpm
