// SPDX-License-Identifier: MIT
/// The partition by p4est, for both dimensions; to be included after the headers of p4est of one dimension.
#pragma once

#include "mpi/block_forest.hpp"

#include <mpi.h>

#include <algorithm>
#include <bit>
#include <vector>

namespace tribo {

/// All leaves have the size of a block. The trees form a brick that covers the lattice; each has the same power of two
/// of blocks along every axis. Leaves beyond the lattice have no weight.
template <int Dim>
class BlockForest final : public Partition<Dim> {
 public:
  BlockForest(const Lattice<Dim>& lattice, int layers) : lattice_(lattice), layers_(layers) {
    constexpr int most_trees = 4096, least_trees = 4;  // the latter along an axis, so that few leaves lie beyond
    const int shortest = *std::min_element(lattice.blocks.begin(), lattice.blocks.end());
    level_ = std::max(0, static_cast<int>(std::bit_width(static_cast<unsigned>(shortest / least_trees))) - 1);
    while (count_trees() > most_trees) ++level_;
    connectivity_ = make_brick();
    forest_ = p4est_new_ext(MPI_COMM_WORLD, connectivity_, 0, level_, 1, 0, nullptr, nullptr);
    find_ghosts();
  }
  ~BlockForest() override {
    p4est_destroy(forest_);
    p4est_connectivity_destroy(connectivity_);
  }

  int owner(const Index<Dim>& block) const override {
    Index<Dim> tree, within;
    for (std::size_t d = 0; d < Dim; ++d) tree[d] = block[d] >> level_, within[d] = block[d] - (tree[d] << level_);
    p4est_quadrant_t leaf{};
    const int shift = P4EST_MAXLEVEL - level_;
    leaf.x = within[0] << shift, leaf.y = within[1] << shift;
#ifdef P4_TO_P8
    leaf.z = within[2] << shift;
#endif
    leaf.level = static_cast<int8_t>(level_);
    return p4est_comm_find_owner(forest_, number_of_tree(tree), &leaf, forest_->mpirank);
  }
  const std::vector<typename Partition<Dim>::Neighbour>& neighbours() const override { return neighbours_; }

  void divide(const std::function<int(const Index<Dim>&)>& weight) override {
    weight_ = &weight;
    forest_->user_pointer = this;
    p4est_partition_ext(forest_, 0, [](p4est_t* forest, p4est_topidx_t tree, p4est_quadrant_t* leaf) {
      const auto& self = *static_cast<const BlockForest*>(forest->user_pointer);
      const Index<Dim> block = self.block_of(tree, *leaf);
      return self.is_in_lattice(block) ? (*self.weight_)(block) : 0;
    });
    weight_ = nullptr;
    find_ghosts();
  }

 private:
  int trees_along(std::size_t axis) const { return ((lattice_.blocks[axis] - 1) >> level_) + 1; }
  long count_trees() const {
    long count = 1;
    for (std::size_t d = 0; d < Dim; ++d) count *= trees_along(d);
    return count;
  }
  p4est_connectivity_t* make_brick() const {
#ifdef P4_TO_P8
    return p8est_connectivity_new_brick(trees_along(0), trees_along(1), trees_along(2), 0, 0, 0);
#else
    return p4est_connectivity_new_brick(trees_along(0), trees_along(1), 0, 0);
#endif
  }

  // The trees of a brick are numbered along a curve; their first vertices tell where they lie.
  Index<Dim> place_of_tree(p4est_topidx_t tree) const {
    const double* vertex =
        connectivity_->vertices + 3 * static_cast<std::ptrdiff_t>(connectivity_->tree_to_vertex[P4EST_CHILDREN * tree]);
    Index<Dim> place;
    for (std::size_t d = 0; d < Dim; ++d) place[d] = static_cast<int>(vertex[d]);
    return place;
  }
  p4est_topidx_t number_of_tree(const Index<Dim>& place) const {
    if (numbers_.empty()) {
      numbers_.resize(static_cast<std::size_t>(count_trees()));
      for (p4est_topidx_t tree = 0; tree < connectivity_->num_trees; ++tree)
        numbers_[position(place_of_tree(tree))] = tree;
    }
    return numbers_[position(place)];
  }
  std::size_t position(const Index<Dim>& tree) const {
    std::size_t n = 0;
    for (std::size_t d = Dim; d-- > 0;)
      n = n * static_cast<std::size_t>(trees_along(d)) + static_cast<std::size_t>(tree[d]);
    return n;
  }
  Index<Dim> block_of(p4est_topidx_t tree, const p4est_quadrant_t& leaf) const {
    Index<Dim> block = place_of_tree(tree);
    const int shift = P4EST_MAXLEVEL - level_;
    block[0] = (block[0] << level_) + (leaf.x >> shift), block[1] = (block[1] << level_) + (leaf.y >> shift);
#ifdef P4_TO_P8
    block[2] = (block[2] << level_) + (leaf.z >> shift);
#endif
    return block;
  }
  bool is_in_lattice(const Index<Dim>& block) const {
    for (std::size_t d = 0; d < Dim; ++d)
      if (block[d] >= lattice_.blocks[d]) return false;
    return true;
  }

  // The neighbours, and the blocks that they and this rank need of each other.
  void find_ghosts() {
    p4est_ghost_t* ghost = p4est_ghost_new(forest_, P4EST_CONNECT_FULL);
    for (int layer = 1; layer < layers_; ++layer) p4est_ghost_expand(forest_, ghost);
    neighbours_.clear();
    const auto append = [&](std::vector<std::int64_t>& to, const p4est_quadrant_t& leaf) {
      const Index<Dim> block = block_of(leaf.p.piggy3.which_tree, leaf);
      if (is_in_lattice(block)) to.push_back(lattice_.block_index(block));
    };
    for (int rank = 0; rank < forest_->mpisize; ++rank) {
      typename Partition<Dim>::Neighbour neighbour;
      neighbour.rank = rank;
      for (auto k = ghost->proc_offsets[rank]; k < ghost->proc_offsets[rank + 1]; ++k)
        append(neighbour.received, *p4est_quadrant_array_index(&ghost->ghosts, static_cast<std::size_t>(k)));
      for (auto k = ghost->mirror_proc_offsets[rank]; k < ghost->mirror_proc_offsets[rank + 1]; ++k)
        append(neighbour.sent,
               *p4est_quadrant_array_index(&ghost->mirrors, static_cast<std::size_t>(ghost->mirror_proc_mirrors[k])));
      if (!neighbour.sent.empty() || !neighbour.received.empty()) neighbours_.push_back(std::move(neighbour));
    }
    p4est_ghost_destroy(ghost);
  }

  Lattice<Dim> lattice_;
  int layers_, level_ = 0;
  p4est_connectivity_t* connectivity_ = nullptr;
  p4est_t* forest_ = nullptr;
  std::vector<typename Partition<Dim>::Neighbour> neighbours_;
  mutable std::vector<p4est_topidx_t> numbers_;                    // of the trees, by their place
  const std::function<int(const Index<Dim>&)>* weight_ = nullptr;  // within divide()
};

}  // namespace tribo
