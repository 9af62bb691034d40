// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "Continuity.hpp"
#include "Points.hpp"
#include "Traction.hpp"
#include <string>

namespace yade::mpm {

/* Checks of columns that come from a file, before anything uses a length or an index of theirs. Each returns the first fault as a
text like "mass has 15 entries for 16 points", or an empty one. */

/* Lengths, numbers of columns and indices. materials: entries of the table that Points::material points into. */
std::string faultOf(const Points& points, std::size_t materials);

/* Lengths and indices of the memory of neighbours. */
std::string faultOf(const Continuity::Memory& memory);

/* Lengths of the columns of a load on a face. */
std::string faultOf(const Traction& face);

/* The first number of the points that is not finite, e.g. "stress[1] of material point 7 is nan". It is not an error of the file: a
scene may be saved after a step that has failed. */
std::string nonFiniteValue(const Points& points);

} // namespace yade::mpm
