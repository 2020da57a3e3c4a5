// SPDX-License-Identifier: MIT
/// Output times.
#pragma once

#include "model/model.hpp"

#include <cmath>
#include <cstdint>
#include <vector>

namespace tribo {

/// Times from groups of constant intervals, or one interval; the k-th time is computed, not summed.
class Schedule {
 public:
  Schedule() = default;
  explicit Schedule(std::vector<OutputSpec::Group> groups) : groups_(std::move(groups)) {}
  static Schedule every(double interval) { return Schedule({{0.0, interval, 0}}); }

  /// True at most once per scheduled time: if the time has reached the next one (within `tolerance`).
  bool due(double time, double tolerance) {
    bool hit = false;
    while (next() <= time + tolerance) ++count_, hit = true;
    return hit;
  }
  std::int64_t count() const { return count_; }
  void set_count(std::int64_t count) { count_ = count; }

 private:
  double next() const {
    std::int64_t k = count_;
    for (std::size_t g = 0; g < groups_.size(); ++g) {
      const auto& group = groups_[g];
      const double end = g + 1 < groups_.size() ? groups_[g + 1].start : HUGE_VAL;
      if (group.interval <= 0) {
        if (k == 0) return group.start;
        --k;
        continue;
      }
      const auto inside = std::isinf(end)
                              ? std::int64_t{1} << 62
                              : static_cast<std::int64_t>(std::ceil((end - group.start) / group.interval - 1e-9));
      if (k < inside) return group.start + static_cast<double>(k) * group.interval;
      k -= inside;
    }
    return HUGE_VAL;
  }

  std::vector<OutputSpec::Group> groups_;
  std::int64_t count_ = 0;
};

}  // namespace tribo
