// SPDX-License-Identifier: MIT
/// The division of the blocks of a lattice among the processes of a run.
#pragma once

#include "base/ranks.hpp"
#include "grid/lattice.hpp"

#include <functional>
#include <memory>
#include <vector>

namespace tribo {

/// Every block of a lattice belongs to one rank, which updates the particles in it. The ghost blocks of a rank are the
/// blocks of other ranks that touch its own; it has copies of the particles in them.
template <int Dim>
class Partition {
 public:
  Partition() = default;
  virtual ~Partition() = default;
  Partition(const Partition&) = delete;
  Partition& operator=(const Partition&) = delete;

  /// The rank to which a block belongs.
  virtual int owner(const Index<Dim>& block) const = 0;
  bool is_own(const Index<Dim>& block) const { return owner(block) == ranks().rank(); }

  /// Another rank whose blocks touch those of this one.
  struct Neighbour {
    int rank = 0;
    std::vector<std::int64_t> sent;      ///< own blocks that are ghost blocks there, as lattice indices
    std::vector<std::int64_t> received;  ///< its blocks that are ghost blocks here
  };
  virtual const std::vector<Neighbour>& neighbours() const = 0;

  /// Divides the blocks anew, so that the sums of weight(block) of the ranks are as equal as the order of the blocks
  /// along a space-filling curve permits. Each rank gives the weights of its own blocks. Collective.
  virtual void divide(const std::function<int(const Index<Dim>&)>& weight) = 0;
};

/// Makes the partition of a lattice, with ghost blocks in so many layers.
template <int Dim>
using PartitionMaker = std::function<std::unique_ptr<Partition<Dim>>(const Lattice<Dim>&, int layers)>;

/// The function that makes partitions; empty in a program without several processes.
template <int Dim>
PartitionMaker<Dim>& partition_maker() {
  static PartitionMaker<Dim> maker;
  return maker;
}

}  // namespace tribo
