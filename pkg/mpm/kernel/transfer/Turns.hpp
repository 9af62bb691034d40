// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

namespace yade::mpm {

/* Rotation k turns axis turnsFrom(k) towards turnsTo(k): about x, y, z in space, about z in the plane. */
template <int dim> constexpr int turns = dim == 3 ? 3 : dim - 1;
template <int dim> constexpr int turnsFrom(int k) { return dim == 3 ? (k + 1) % 3 : 0; }
template <int dim> constexpr int turnsTo(int k) { return dim == 3 ? (k + 2) % 3 : dim - 1; }

} // namespace yade::mpm
