// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "laws/Law.hpp"
#include <array>
#include <functional>
#include <vector>

namespace yade::mpm {

/* What a material point went through, at every entry of its path; tensors are 3x3, row-major, nine numbers an entry. */
struct PointHistory {
	std::vector<double> stress, backStress;         // [Pa]
	std::vector<double> strain;                     // with the free components found
	std::vector<double> plasticStrain, dissipation; // accumulated: equivalent [-], a volume [J/m3]
};

/* One material point, from rest without stress, through a path of small strains: strain holds symmetric 3x3 tensors
(tensor shear), row-major. Between two entries the strain grows in a straight line. The normal components marked free have
no stress instead of a prescribed strain; what the path says of them is not read. Where some are free, the back stress
stands in the subspace of the others (it has no component there).

Throws std::invalid_argument on a law that validate() refuses, on a path that is not one, and on a step that the law cannot follow.
pause, where given, is called every few hundred entries; an exception that it throws ends the run. */
PointHistory drivePoint(
	const Law& law, const std::vector<double>& strain, const std::array<bool, 3>& free = { false, false, false }, const std::function<void()>& pause = {});

} // namespace yade::mpm
