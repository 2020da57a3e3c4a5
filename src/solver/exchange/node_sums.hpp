// SPDX-License-Identifier: MIT
/// Sums over the nodes of a velocity field.
#pragma once

#include "base/parallel.hpp"
#include "base/ranks.hpp"
#include "solver/exchange/exchange.hpp"

#include <vector>

namespace tribo {

/// Forms sums over the nodes of each block, and adds those of all blocks without rounding, so that the result depends
/// neither on the number of threads nor on the processes to which the blocks belong.
template <int Dim>
class NodeSums {
 public:
  NodeSums(System<Dim>& system, const Exchanges<Dim>& exchanges) : system_(system), exchanges_(exchanges) {}

  /// Sum of term(position in the nodal arrays, node), weighted by ownership, over the nodes of field f with mass.
  template <class F>
  WorkAndImpulse operator()(std::size_t f, F&& term) {
    auto& field = system_.fields[f];
    by_block_.assign(field.map.active().size(), WorkAndImpulse::Zero());
    parallel_for(static_cast<std::ptrdiff_t>(by_block_.size()), [&](std::ptrdiff_t block) {
      WorkAndImpulse sum = WorkAndImpulse::Zero();
      const auto slot = static_cast<std::size_t>(block);
      field.map.each_run(slot, slot + 1, [&](std::size_t first, std::size_t last) {
        for (std::size_t at = first; at < last; ++at) {
          const auto n = static_cast<std::int64_t>(at);
          Node& node = field.nodes[at];
          if (node.mass > 0) sum += exchanges_[f]->ownership(n) * term(n, node);
        }
      });
      by_block_[static_cast<std::size_t>(block)] = sum;
    });
    OrderlessSums<4> all;
    for (std::size_t block = 0; block < by_block_.size(); ++block)
      if (field.map.is_own(block)) all.add(by_block_[block]);
    return all.total();
  }

 private:
  System<Dim>& system_;
  const Exchanges<Dim>& exchanges_;
  std::vector<WorkAndImpulse> by_block_;
};

}  // namespace tribo
