// SPDX-License-Identifier: GPL-2.0-or-later
#include "MakeSolver.hpp"

namespace yade::mpm {

template std::unique_ptr<Solver> makeSolverOf<PlaneStress>(Analysis, ShapeKind, double, Points&, const std::vector<Law>&, std::vector<Wall>&);

} // namespace yade::mpm
