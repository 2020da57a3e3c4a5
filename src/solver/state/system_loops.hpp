// SPDX-License-Identifier: MIT
/// Loops over all bodies and all nodes of a system on several threads.
#pragma once

#include "base/parallel.hpp"
#include "solver/state/system.hpp"

#include <algorithm>
#include <cstring>
#include <vector>

namespace tribo {

/// With many small bodies there is too little work in one body, or in the nodes of one field, for several threads. Then
/// threads treat different bodies side by side, and ranges of the nodes of all fields. No result depends on it.
template <int Dim>
class SystemLoops {
 public:
  explicit SystemLoops(System<Dim>& system) : system_(system) {}

  /// Divides the work anew, after particles or nodes have changed their numbers.
  void divide() {
    constexpr std::size_t length = 16, per_thread = 4;
    ranges_.clear();
    for (std::size_t f = 0; f < system_.fields.size(); ++f) {
      const std::size_t blocks = system_.fields[f].map.active().size();
      for (std::size_t first = 0; first < blocks; first += length)
        ranges_.push_back({f, first, std::min(first + length, blocks)});
    }
    before_.assign(1, 0);
    std::vector<char> used(system_.fields.size(), 0);
    bool distinct = true;
    std::size_t largest = 0;
    for (const auto& body : system_.bodies) {
      before_.push_back(before_.back() + static_cast<std::uint32_t>(body.particles.size()));
      largest = std::max(largest, body.particles.size());
      distinct = distinct && !used[body.field];
      used[body.field] = 1;
    }
    side_by_side_ = distinct && largest * per_thread * static_cast<std::size_t>(threads()) <= before_.back();
  }

  /// Calls f(number of the body) for all deformable bodies. It may write to the body and to the nodes of its field.
  template <class F>
  void each_body(F&& f) const {
    const std::size_t count = system_.bodies.size();
    if (side_by_side_)
      return parallel_for_weighted(
          static_cast<std::ptrdiff_t>(count), [&](std::ptrdiff_t k) { return before_[static_cast<std::size_t>(k)]; },
          [&](std::ptrdiff_t k) { f(static_cast<std::size_t>(k)); });
    for (std::size_t k = 0; k < count; ++k) f(k);
  }

  /// Calls f(number of the field, first node, last node + 1) for ranges that cover the nodes of all fields that
  /// particles may reach.
  template <class F>
  void each_range(F&& f) const {
    parallel_for(static_cast<std::ptrdiff_t>(ranges_.size()), [&](std::ptrdiff_t k) {
      const Range& range = ranges_[static_cast<std::size_t>(k)];
      system_.fields[range.field].map.each_run(
          range.first, range.last, [&](std::size_t first, std::size_t last) { f(range.field, first, last); });
    });
  }

  /// Sets the nodes of all fields to zero that particles may reach, and Field::nodes_again where it is used.
  void zero_nodes() const {
    each_range([&](std::size_t f, std::size_t first, std::size_t last) {
      for (NodeLayer* layer : {&system_.fields[f].nodes, &system_.fields[f].nodes_again})
        if (!layer->empty()) std::memset(static_cast<void*>(layer->data() + first), 0, sizeof(Node) * (last - first));
    });
  }

 private:
  struct Range {
    std::size_t field, first, last;
  };
  System<Dim>& system_;
  std::vector<Range> ranges_;          // of the blocks of all fields
  std::vector<std::uint32_t> before_;  // number of particles of the bodies before the k-th
  bool side_by_side_ = false;          // the bodies are many, none of them is large, and each has its own field
};

}  // namespace tribo
