// SPDX-License-Identifier: MIT
/// Bodies that are apart at the start.
#pragma once

#include "model/model.hpp"
#include "particles/seeds.hpp"
#include "run/body_gaps.hpp"

#include <string>
#include <vector>

namespace tribo {

/// For each material without a neighbour the one that is nearest to it along an axis, beside or above which it lies:
/// "'striker' and 'bar', 2.5 cells (5 mm) along x, closed at time 0.5". `gaps`: of pairs that are near each other; a
/// neighbour is less than a cell away. `cell`: edge length of a cell.
std::vector<std::string> distant_bodies(const Model& model, const Seeds& seeds, const Gaps& gaps, double cell);

}  // namespace tribo
