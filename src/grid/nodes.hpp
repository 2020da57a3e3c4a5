// SPDX-License-Identifier: MIT
/// Nodes of one velocity field, stored in blocks that exist only near particles.
#pragma once

#include "base/aligned.hpp"
#include "grid/block_table.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace tribo {

// Each kind of node fills one cache line with eight numbers: a weight, a vector, a spare number and a second vector.
// The transfers and the exchange treat all kinds alike; the members say what the numbers are. Two names for one member
// mean that the quantity is divided by the weight in the course of the step.

/// Balance of mass and momentum.
struct alignas(64) Node {
  double mass;
  union {
    double momentum[3];  ///< before the division by the mass [mass velocity]
    double velocity[3];
  };
  double spare;
  union {
    double force[3];  ///< before the division by the mass
    double acceleration[3];
  };
};

/// What the particles of a rigid body without a velocity field prescribe.
struct alignas(64) PrescribedNode {
  double mass;
  double momentum[3];
  double unused[4];
};

/// XPIC and FMPM: terms of the series of filtered velocities.
struct alignas(64) FilterNode {
  double mass;
  union {
    double increment[3];  ///< the present term of the series
    double velocity[3];   ///< the sum of all terms, once the series is complete
  };
  double spare;
  double sum[3];  ///< of the terms so far
};

/// Volume of the particles around a node, for the areas and normals of contact.
struct alignas(64) VolumeNode {
  double volume;
  double moment[3];  ///< sum of w V x, or of w V times the displacement                     [length^4]
  double spare;
  double gradient[3];  ///< sum of V grad w                                                  [length^2]
};

/// Conduction of heat.
struct alignas(64) HeatNode {
  double capacity;  ///< sum of w m c                                                        [energy/temperature]
  union {
    double heat;  ///< before the division by the capacity                                   [energy]
    double temperature;
  };
  union {
    double power;  ///< into the node, before the division by the capacity                   [power]
    double rate;   ///< of the temperature                                                   [temperature/time]
  };
  double unused[5];
};

/// B-bar: mean over the particles of a cell, stored at the lowest node of the cell.
struct alignas(64) CellNode {
  double volume;
  union {
    double sum;  ///< of volume times value, before the division by the volume
    double mean;
  };
  double unused[6];
};

/// The numbers of all nodes of a layer, whatever they are; refers to the layer.
class NodeNumbers {
 public:
  static constexpr std::size_t per_node = 8;
  static constexpr int first_vector = 1, second_vector = 5;  ///< where the two vectors begin

  NodeNumbers() = default;
  template <class N>
  NodeNumbers(AlignedVector<N>& layer) : numbers_(reinterpret_cast<double*>(layer.data())) {
    static_assert(sizeof(N) == per_node * sizeof(double));
    static_assert(alignof(N) == 64);
  }
  /// The eight numbers of a node.
  double* operator[](std::size_t node) const { return numbers_ + per_node * node; }

 private:
  double* numbers_ = nullptr;
};

/// A node whose mass is below this fraction of the largest nodal mass counts as empty (round-off of the weights).
inline constexpr double least_mass_ratio = 1e-14;

/// A block with particles, and the nodes that their shape functions reach.
template <int Dim>
struct BlockReach {
  std::int64_t block;    ///< lattice index
  Index<Dim> low, high;  ///< box of the reached nodes, from the first node of the block; at most one block beyond it

  /// A block all neighbours of which are reached.
  static BlockReach full(std::int64_t block) {
    BlockReach reach{block, {}, {}};
    reach.low.fill(-block_edge<Dim>), reach.high.fill(2 * block_edge<Dim> - 1);
    return reach;
  }
};

/// Bits of the nodes of a block that lie in a box, given from the first node of the block.
template <int Dim>
std::uint64_t nodes_in_box(Index<Dim> low, Index<Dim> high) {
  std::uint64_t bits = 0;
  for (std::size_t d = 0; d < Dim; ++d) low[d] = std::max(low[d], 0), high[d] = std::min(high[d], block_edge<Dim> - 1);
  each_in_box<Dim>(low, high, [&](const Index<Dim>& n) {
    int local = 0;
    for (std::size_t d = Dim; d-- > 0;) local = local * block_edge<Dim> + n[d];
    bits |= std::uint64_t{1} << local;
  });
  return bits;
}

/// The existing blocks in lexicographic order: the sparse structure of the grid, shared by all layers of nodal data.
template <int Dim>
class BlockMap {
 public:
  static constexpr int neighbour_count = Dim == 2 ? 9 : 27;

  explicit BlockMap(const Lattice<Dim>& lattice) : lattice_(lattice) {}

  const Lattice<Dim>& lattice() const { return lattice_; }

  /// Makes the given blocks and the neighbours that they reach exist, and no others.
  void rebuild(std::span<const BlockReach<Dim>> occupied) {
    BlockBox<Dim> box;
    each_reached_block(occupied, [&](const Index<Dim>& block, std::uint64_t) { box.include(block); });
    slot_.reset(box);
    active_.clear(), own_.clear(), complete_.clear();
    each_reached_block(occupied, [&](const Index<Dim>& block, std::uint64_t) {
      int& s = slot_.at(block);
      if (s < 0) s = 0, active_.push_back(lattice_.block_index(block));
    });
    std::sort(active_.begin(), active_.end());
    for (std::size_t k = 0; k < active_.size(); ++k) slot_.at(lattice_.block_at(active_[k])) = static_cast<int>(k);
    reached_.assign(active_.size(), 0);
    each_reached_block(occupied, [&](const Index<Dim>& block, std::uint64_t nodes) {
      reached_[static_cast<std::size_t>(slot(block))] |= nodes;
    });
  }
  /// The same with all neighbours of the blocks, which are given as lattice indices.
  void rebuild(std::span<const std::int64_t> occupied) {
    std::vector<BlockReach<Dim>> with_neighbours;
    for (const auto block : occupied) with_neighbours.push_back(BlockReach<Dim>::full(block));
    rebuild(std::span<const BlockReach<Dim>>(with_neighbours));
  }

  /// Lattice indices of the existing blocks. The position in this list is the slot of a block.
  const std::vector<std::int64_t>& active() const { return active_; }
  /// The slot of a block, or -1 if it does not exist.
  int slot(const Index<Dim>& block) const { return slot_[block]; }

  /// Whether sums over nodes contain those of the block in a slot: of the processes whose maps have it, one sums.
  bool is_own(std::size_t slot) const { return own_.empty() || own_[slot] != 0; }
  /// Determines it: own(block) for the blocks that exist. complete(block): bits of the nodes of other blocks that are
  /// complete on this process, because no particles of others than those it knows can reach them.
  template <class Own, class Complete>
  void mark_own(Own&& own, Complete&& complete) {
    own_.resize(active_.size()), complete_.resize(active_.size());
    for (std::size_t k = 0; k < active_.size(); ++k) {
      const Index<Dim> block = lattice_.block_at(active_[k]);
      own_[k] = own(block) ? 1 : 0;
      complete_[k] = own_[k] != 0 ? ~std::uint64_t{0} : complete(block);
    }
  }
  /// Bits of the complete nodes of the block in a slot: all of them in a single process.
  std::uint64_t complete(std::size_t slot) const { return complete_.empty() ? ~std::uint64_t{0} : complete_[slot]; }

  /// Bits of the nodes of the block in a slot that the shape functions of particles may reach. The others stay empty.
  std::uint64_t reached(std::size_t slot) const { return reached_[slot]; }
  /// Makes all nodes of the blocks count as reached, because more than transfers writes to them.
  void reach_all() { std::fill(reached_.begin(), reached_.end(), ~std::uint64_t{0}); }
  /// Calls f(first node, last node + 1) for the runs of reached nodes of the blocks in the slots from `begin` to before
  /// `end`; the nodes are positions in the layers of nodal data.
  template <class F>
  void each_run(std::size_t begin, std::size_t end, F&& f) const {
    for (std::size_t s = begin; s < end; ++s) {
      std::size_t first = s * block_nodes<Dim>;
      for (std::uint64_t rest = reached_[s]; rest != 0;) {
        const int skipped = std::countr_zero(rest), length = std::countr_one(rest >> skipped);
        first += static_cast<std::size_t>(skipped);
        f(first, first + static_cast<std::size_t>(length));
        first += static_cast<std::size_t>(length);
        rest = skipped + length < 64 ? rest >> (skipped + length) : 0;
      }
    }
  }

  /// A block and its neighbours, x fastest; the block itself is in the middle.
  struct Neighbours {
    std::array<int, neighbour_count> slots;              ///< -1: the block does not exist
    std::array<std::uint64_t, neighbour_count> reached;  ///< bits of the reached nodes; 0 if the block does not exist
  };
  Neighbours neighbours(std::int64_t block) const {
    Neighbours out{};
    std::size_t k = 0;
    each_neighbour(block, [&](const Index<Dim>& n) {
      const int s = out.slots[k] = slot(n);
      out.reached[k++] = s < 0 ? 0 : reached_[static_cast<std::size_t>(s)];
    });
    return out;
  }

  /// Position of a node in the layers of nodal data, or -1 if its block does not exist.
  std::int64_t node(const Index<Dim>& n) const {
    Index<Dim> block;
    std::int64_t local = 0;
    for (std::size_t d = Dim; d-- > 0;) {
      if (n[d] < 0 || n[d] >= lattice_.blocks[d] * block_edge<Dim>) return -1;
      block[d] = n[d] / block_edge<Dim>;
      local = local * block_edge<Dim> + n[d] % block_edge<Dim>;
    }
    const int s = slot(block);
    return s < 0 ? -1 : static_cast<std::int64_t>(s) * block_nodes<Dim> + local;
  }

  /// Lattice index of the node at a position in the layers of nodal data.
  Index<Dim> node_at(std::int64_t position) const {
    auto n = lattice_.block_at(active_[static_cast<std::size_t>(position / block_nodes<Dim>)]);
    auto local = static_cast<int>(position % block_nodes<Dim>);
    for (std::size_t d = 0; d < Dim; ++d)
      n[d] = n[d] * block_edge<Dim> + local % block_edge<Dim>, local /= block_edge<Dim>;
    return n;
  }

  std::int64_t node_count() const { return static_cast<std::int64_t>(active_.size()) * block_nodes<Dim>; }

 private:
  // Calls f(block, bits of its nodes) for the blocks that the given ones reach.
  template <class F>
  void each_reached_block(std::span<const BlockReach<Dim>> occupied, F&& f) const {
    constexpr int edge = block_edge<Dim>;
    for (const BlockReach<Dim>& from : occupied) {
      const auto middle = lattice_.block_at(from.block);
      Index<Dim> low, high;
      for (std::size_t d = 0; d < Dim; ++d) low[d] = from.low[d] < 0 ? -1 : 0, high[d] = from.high[d] < edge ? 0 : 1;
      each_in_box<Dim>(low, high, [&](Index<Dim> n) {
        Index<Dim> first = from.low, last = from.high;
        for (std::size_t d = 0; d < Dim; ++d) first[d] -= n[d] * edge, last[d] -= n[d] * edge, n[d] += middle[d];
        f(n, nodes_in_box<Dim>(first, last));
      });
    }
  }

  template <class F>
  void each_neighbour(std::int64_t block, F&& f) const {
    const auto b = lattice_.block_at(block);
    for (int k = Dim == 2 ? 0 : -1; k <= (Dim == 2 ? 0 : 1); ++k)
      for (int j = -1; j <= 1; ++j)
        for (int i = -1; i <= 1; ++i) {
          auto n = b;
          n[0] += i, n[1] += j;
          if constexpr (Dim == 3) n[2] += k;
          f(n);
        }
  }

  Lattice<Dim> lattice_;
  BlockTable<Dim, int> slot_{-1};
  std::vector<std::int64_t> active_;
  std::vector<std::uint64_t> reached_;   // per slot
  std::vector<char> own_;                // per slot; empty if all count
  std::vector<std::uint64_t> complete_;  // per slot; empty if all are complete
};

using NodeLayer = AlignedVector<Node>;

}  // namespace tribo
