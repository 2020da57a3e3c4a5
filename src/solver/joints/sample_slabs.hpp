// SPDX-License-Identifier: MIT
/// The order in which integration points of joints add to nodes, so that several threads do it at the same time with
/// the same result as one.
#pragma once

#include "base/parallel.hpp"
#include "solver/joints/face_nodes.hpp"

#include <algorithm>
#include <cstdint>
#include <vector>

namespace tribo {

/// Integration points in slabs of the grid normal to one of its axes. A slab is at least as thick as the range of nodes
/// of any point, so that points of slabs which are not neighbours have no node in common.
template <int Dim>
class SampleSlabs {
 public:
  struct Entry {
    std::uint32_t surface, sample;
    NodeRange<Dim> range;
  };

  void clear() { entries_.clear(); }
  void add(const Entry& entry) { entries_.push_back(entry); }
  /// Sorts the points by slab. Points of a slab keep the order in which they were added.
  void sort() {
    begin_.assign(1, 0);
    if (entries_.empty()) return;
    NodeRange<Dim> all;
    Index<Dim> widest{};
    for (const Entry& e : entries_) {
      all.include(e.range.low), all.include(e.range.high);
      for (std::size_t d = 0; d < widest.size(); ++d)
        widest[d] = std::max(widest[d], e.range.high[d] - e.range.low[d] + 1);
    }
    std::size_t axis = 0;
    const auto slabs = [&](std::size_t d) { return (all.high[d] - all.low[d]) / widest[d] + 1; };
    for (std::size_t d = 1; d < widest.size(); ++d)
      if (slabs(d) > slabs(axis)) axis = d;
    const auto slab = [&](const Entry& e) {
      return static_cast<std::size_t>((e.range.low[axis] - all.low[axis]) / widest[axis]);
    };
    begin_.assign(static_cast<std::size_t>(slabs(axis)) + 1, 0);
    for (const Entry& e : entries_) ++begin_[slab(e) + 1];
    for (std::size_t k = 1; k < begin_.size(); ++k) begin_[k] += begin_[k - 1];
    sorted_.resize(entries_.size());
    next_ = begin_;
    for (const Entry& e : entries_) sorted_[next_[slab(e)]++] = e;
  }

  std::size_t slabs() const { return begin_.size() - 1; }
  /// Calls f(slab, surface, sample) for all points. Slabs with even numbers run at the same time on several threads,
  /// those with odd numbers afterwards.
  template <class F>
  void each(F&& f) const {
    for (std::size_t parity = 0; parity < 2; ++parity)
      parallel_for(static_cast<std::ptrdiff_t>((slabs() + 1 - parity) / 2), [&](std::ptrdiff_t k) {
        const std::size_t slab = 2 * static_cast<std::size_t>(k) + parity;
        for (std::size_t i = begin_[slab]; i < begin_[slab + 1]; ++i) f(slab, sorted_[i].surface, sorted_[i].sample);
      });
  }

 private:
  std::vector<Entry> entries_, sorted_;
  std::vector<std::size_t> begin_{0}, next_;
};

}  // namespace tribo
