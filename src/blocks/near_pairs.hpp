// SPDX-License-Identifier: MIT
/// Search for overlapping boxes.
#pragma once

#include "geometry/region.hpp"

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <vector>

namespace tribo {

/// Calls f(i, j), i < j, for all pairs of boxes that overlap or touch, ordered along x.
template <class F>
void each_near_pair(const std::vector<Bounds>& boxes, F&& f) {
  std::vector<std::uint32_t> order(boxes.size());
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(), [&](auto i, auto j) {
    return boxes[i].low[0] < boxes[j].low[0] || (boxes[i].low[0] == boxes[j].low[0] && i < j);
  });
  for (std::size_t i = 0; i < order.size(); ++i)
    for (std::size_t j = i + 1; j < order.size() && boxes[order[j]].low[0] <= boxes[order[i]].high[0]; ++j) {
      const Bounds &a = boxes[order[i]], &b = boxes[order[j]];
      if ((a.low.array() <= b.high.array()).all() && (b.low.array() <= a.high.array()).all())
        f(std::min(order[i], order[j]), std::max(order[i], order[j]));
    }
}

}  // namespace tribo
