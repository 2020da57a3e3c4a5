// SPDX-License-Identifier: MIT
/// Search among many boxes.
#pragma once

#include "base/parallel.hpp"
#include "base/types.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace tribo {

/// A box along the axes.
template <int Dim>
struct Box {
  Vec<Dim> low, high;

  bool overlaps(const Box& other) const {
    return (low.array() <= other.high.array()).all() && (other.low.array() <= high.array()).all();
  }
  /// Squared distance to a point; 0 inside.
  double distance_squared(const Vec<Dim>& x) const { return (low - x).cwiseMax(x - high).cwiseMax(0.0).squaredNorm(); }
};

/// A segment, for tests against boxes that may err by finding an intersection where there is none.
template <int Dim>
class SegmentTest {
 public:
  /// `margin`: larger than the round-off of coordinates [length].
  SegmentTest(const Vec<Dim>& from, const Vec<Dim>& to, double margin)
      : from_(from), along_(to - from), margin_(margin), box_{from.cwiseMin(to), from.cwiseMax(to)} {}

  bool operator()(const Box<Dim>& box) const {
    if (!box.overlaps(box_)) return false;
    const Vec<Dim> centre = 0.5 * (box.low + box.high) - from_;
    const Vec<Dim> half = (0.5 * (box.high - box.low)).array() + margin_;
    for (int i = 0; i < Dim; ++i)
      for (int j = i + 1; j < Dim; ++j)
        if (std::abs(along_[i] * centre[j] - along_[j] * centre[i]) >
            std::abs(along_[i]) * half[j] + std::abs(along_[j]) * half[i])
          return false;
    return true;
  }

 private:
  Vec<Dim> from_, along_;
  double margin_;
  Box<Dim> box_;
};

/// The boxes of items of which neighbours in the list are mostly neighbours in space, such as the segments of a line:
/// a tree in which a box contains those of four successive boxes of the level below.
template <int Dim>
class BoxTree {
 public:
  /// Finds the boxes anew. `box_of(i)`: box of item i.
  template <class F>
  void build(std::size_t count, F&& box_of) {
    levels_.resize(1);
    for (std::size_t l = 0; count > 0; ++l) {
      const std::size_t parents = (count + children - 1) / children;
      if (levels_.size() <= l) levels_.emplace_back();
      levels_[l].resize(parents);
      parallel_for(
          static_cast<std::ptrdiff_t>(parents),
          [&](std::ptrdiff_t p) {
            const auto at = static_cast<std::size_t>(p);
            const std::size_t end = std::min(count, children * (at + 1));
            Box<Dim> box{Vec<Dim>::Constant(std::numeric_limits<double>::infinity()), {}};
            box.high = -box.low;
            for (std::size_t i = children * at; i < end; ++i) {
              const Box<Dim> part = l == 0 ? Box<Dim>(box_of(i)) : levels_[l - 1][i];
              box.low = box.low.cwiseMin(part.low), box.high = box.high.cwiseMax(part.high);
            }
            levels_[l][at] = box;
          },
          fewest);
      count = parents;
      if (parents == 1) {
        levels_.resize(l + 1);
        return;
      }
    }
    levels_.clear();
  }
  /// Calls f(first, end) for ranges of items, in ascending order, that contain all items whose boxes pass test(box). A
  /// box that contains others must pass if one of them does. The test may become stricter meanwhile.
  template <class Test, class F>
  void each(Test&& test, F&& f) const {
    if (!levels_.empty()) visit(levels_.size() - 1, 0, 1, test, f);
  }
  /// Calls f(first, end) for ranges of items that contain all items whose boxes have a squared distance from x of at
  /// most `bound` [length^2]. The nearest box comes first at each level. f may reduce `bound` meanwhile.
  template <class F>
  void each_near(const Vec<Dim>& x, const double& bound, F&& f) const {
    if (!levels_.empty()) visit_near(levels_.size() - 1, 0, 1, x, bound, f);
  }
  static constexpr std::size_t children = 4;

 private:
  static constexpr std::ptrdiff_t fewest = 1000;  // boxes that are worth several threads

  template <class Test, class F>
  void visit(std::size_t level, std::size_t first, std::size_t end, Test& test, F& f) const {
    for (std::size_t i = first; i < std::min(end, levels_[level].size()); ++i) {
      if (!test(levels_[level][i])) continue;
      if (level == 0)
        f(children * i, children * (i + 1));
      else
        visit(level - 1, children * i, children * (i + 1), test, f);
    }
  }

  template <class F>
  void visit_near(std::size_t level, std::size_t first, std::size_t end, const Vec<Dim>& x, const double& bound,
                  F& f) const {
    struct Near {
      double distance_squared;
      std::size_t box;
    };
    std::array<Near, children> near;  // in ascending order of the distance
    std::size_t count = 0;
    for (std::size_t i = first; i < std::min(end, levels_[level].size()); ++i) {
      const Near box{levels_[level][i].distance_squared(x), i};
      if (box.distance_squared > bound) continue;
      std::size_t at = count++;
      for (; at > 0 && near[at - 1].distance_squared > box.distance_squared; --at) near[at] = near[at - 1];
      near[at] = box;
    }
    for (std::size_t k = 0; k < count; ++k) {
      if (near[k].distance_squared > bound) return;
      if (level == 0)
        f(children * near[k].box, children * (near[k].box + 1));
      else
        visit_near(level - 1, children * near[k].box, children * (near[k].box + 1), x, bound, f);
    }
  }

  std::vector<std::vector<Box<Dim>>> levels_;  // from the lowest
};

}  // namespace tribo
