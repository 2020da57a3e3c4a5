// SPDX-License-Identifier: MIT
/// What a bin needs where a crack runs through it.
#pragma once

#include "solver/transfer/stencils.hpp"
#include "solver/transfer/transfer.hpp"

#include <memory>

namespace tribo {

/// The nodes of a bin across cracks: patches that only cut bins have.
template <int Dim, int width>
class CutPatches {
 public:
  using NodePatch = Patch<Dim, width>;

  explicit CutPatches(bool wanted) {
    if (!wanted) return;
    if (!kept()) kept() = std::make_unique<std::array<NodePatch, 3>>();
    patches_ = kept().get();
    for (NodePatch& patch : *patches_) patch.clear();
  }
  /// Calls f(side, patch) for the fields there are.
  template <class F>
  void each(const Target<Dim>& target, F&& f) {
    for (std::size_t k = 1; patches_ && k < 4; ++k)
      if (target.map[k]) f(k, (*patches_)[k - 1]);
  }
  std::array<double*, 4> data(NodePatch& own) {
    if (!patches_) return {own.data, nullptr, nullptr, nullptr};
    auto& beyond = *patches_;
    return {own.data, beyond[0].data, beyond[1].data, beyond[2].data};
  }

 private:
  // Of this thread: made once, not in every step.
  static std::unique_ptr<std::array<NodePatch, 3>>& kept() {
    thread_local std::unique_ptr<std::array<NodePatch, 3>> mine;
    return mine;
  }

  std::array<NodePatch, 3>* patches_ = nullptr;
};

}  // namespace tribo
