// SPDX-License-Identifier: MIT
/// Node patches for the additional velocity fields of bins near cracks.
#pragma once

#include "solver/transfer/stencils.hpp"
#include "solver/transfer/transfer.hpp"

#include <cstddef>
#include <memory>

namespace tribo {

/// Patches of nodes for the sides 1, 2 and 3 of a bin near cracks; other bins do not need them.
template <int Dim, int width>
class CutPatches {
 public:
  using NodePatch = Patch<Dim, width>;

  /// `cut`: the sides of the bin, null if all are 0. Sets all nodes of the additional fields that exist to zero.
  CutPatches(const CutBin* cut, const Target<Dim>& target) {
    if (!cut) return;
    if (!kept()) kept() = std::make_unique<std::array<NodePatch, 3>>();
    patches_ = kept().get();
    each(target, [](std::size_t, NodePatch& patch) { patch.clear(); });
  }
  /// Calls f(side, patch) for the additional fields that exist.
  template <class F>
  void each(const Target<Dim>& target, F&& f) {
    for (std::size_t k = 1; patches_ && k < 4; ++k)
      if (target.map[k]) f(k, (*patches_)[k - 1]);
  }
  /// Nodal data by side; `own` is the patch of side 0.
  std::array<double*, 4> data(NodePatch& own) {
    if (!patches_) return {own.data, nullptr, nullptr, nullptr};
    auto& beyond = *patches_;
    return {own.data, beyond[0].data, beyond[1].data, beyond[2].data};
  }

 private:
  // Patches of the calling thread, allocated once.
  static std::unique_ptr<std::array<NodePatch, 3>>& kept() {
    thread_local std::unique_ptr<std::array<NodePatch, 3>> mine;
    return mine;
  }

  std::array<NodePatch, 3>* patches_ = nullptr;
};

/// The nodes of a particle in the patch of one field. Called with the number of a node in the stencil, x fastest, and
/// its offset from the lowest node, it returns the data of the node.
struct NodesOfOneField {
  double* data;
  /// The same from the lowest node of a particle, at an offset in the patch.
  NodesOfOneField from(std::ptrdiff_t lowest) const { return {data + lowest}; }
  double* operator()(int, std::ptrdiff_t offset) const { return data + offset; }
};

/// The nodes of a particle near a crack, each in the patch of its side.
struct NodesBySide {
  const std::array<double*, 4>& data;  ///< by side
  const std::uint8_t* sides;           ///< per node of the stencil
  std::ptrdiff_t lowest = 0;
  NodesBySide from(std::ptrdiff_t at) const { return {data, sides, at}; }
  double* operator()(int node, std::ptrdiff_t offset) const { return data[sides[node]] + lowest + offset; }
};

}  // namespace tribo
