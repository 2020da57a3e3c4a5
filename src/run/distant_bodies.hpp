// SPDX-License-Identifier: MIT
/// Bodies that are apart at the start.
#pragma once

#include "model/model.hpp"
#include "particles/seeds.hpp"

#include <set>
#include <string>
#include <vector>

namespace tribo {

/// For each material without a neighbour the one that is nearest to it along an axis, beside or above which it lies:
/// "'striker' and 'bar', 2.5 cells (5 mm) along x, closed at time 0.5". `near`: the materials with a neighbour; `cell`:
/// edge length of a cell.
std::vector<std::string> distant_bodies(const Model& model, const Seeds& seeds, const std::set<int>& near, double cell);

}  // namespace tribo
