// SPDX-License-Identifier: MIT
/// The nodes on which nodal conditions act.
#pragma once

#include "grid/nodes.hpp"
#include "model/model.hpp"

#include <cstdint>
#include <vector>

namespace tribo {

/// A node, and its conditions with the same direction.
template <int Dim>
struct SelectedNode {
  Index<Dim> node;
  Vec<Dim> direction;                   ///< unit vector
  std::vector<std::size_t> conditions;  ///< indices into Model::node_conditions
};

/// The nodes that the nodal conditions of a model, moving walls excepted, select from the whole lattice. They are the
/// same for all velocity fields.
template <int Dim>
class SelectedNodes {
 public:
  /// Reports conditions that select no node to `problems`.
  SelectedNodes(const Model& model, const Lattice<Dim>& lattice, Problems& problems);

  const SelectedNode<Dim>& operator[](std::size_t number) const { return nodes_[number]; }

  /// A selected node that exists in a map.
  struct Existing {
    std::size_t number;     ///< of the selected node
    std::int64_t position;  ///< in the layers of nodal data
  };
  /// Replaces a list by the selected nodes that exist in a map, in the order of their numbers. Only the blocks of the
  /// map are examined.
  void find(const BlockMap<Dim>& map, std::vector<Existing>& existing) const;

 private:
  void select(const Model& model, const Lattice<Dim>& lattice, Problems& problems);

  struct InBlock {
    std::int64_t block;
    std::size_t number;
  };
  std::vector<SelectedNode<Dim>> nodes_;
  std::vector<InBlock> by_block_;  // in ascending order of blocks
};

}  // namespace tribo
