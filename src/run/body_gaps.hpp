// SPDX-License-Identifier: MIT
/// Distances between bodies at the start.
#pragma once

#include "grid/lattice.hpp"
#include "particles/seeds.hpp"

#include <map>
#include <utility>
#include <vector>

namespace tribo {

/// Distance of two materials' particle domains at the start, in cells; negative: they overlap.
using Gaps = std::map<std::pair<int, int>, double>;

/// Of all pairs of materials that come within two cells of each other, by pair, smaller index first.
template <int Dim>
Gaps smallest_gaps(const Seeds& seeds, const Lattice<Dim>& lattice);

}  // namespace tribo
