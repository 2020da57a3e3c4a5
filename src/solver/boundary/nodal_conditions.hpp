// SPDX-License-Identifier: MIT
/// Prescribed velocities on the nodes of one velocity field.
#pragma once

#include "solver/exchange/exchange.hpp"

#include <vector>

namespace tribo {

/// Nodal conditions of the model, translated to the nodes that exist at present.
template <int Dim>
class NodalConditions {
 public:
  /// The nodes are selected once from the whole lattice. Throws InputError for a condition that selects no node.
  NodalConditions(const Model& model, const Lattice<Dim>& lattice);

  /// Finds the selected nodes among the blocks that exist; to be called after every change of the map.
  void locate(const BlockMap<Dim>& map);

  /// Sets the velocities prescribed at `time` before a strain update, and stores by how much each velocity changed.
  void impose(NodeLayer& nodes, double time, double dt);
  /// Sets the velocities prescribed at time + dt after the momentum update. The accelerations follow the prescribed
  /// velocity from `time` to time + dt, not the difference that extrapolation left at a node. Only in the `first` step,
  /// when a body may start with another velocity than its supports, is that difference part of the reaction.
  /// `after_impose`: impose() was called earlier in the step.
  void impose_update(NodeLayer& nodes, const Exchange<Dim>& exchange, double time, double dt, bool after_impose,
                     bool first);
  /// Removes the prescribed components from the increments of a velocity filter.
  void release(AlignedVector<FilterNode>& nodes) const;

  /// Reaction force of the last step by condition [force].
  const std::vector<Vec3>& reactions() const { return reactions_; }
  /// Work done on the material since the start of the run [energy].
  double work() const { return work_; }
  /// Impulse of the conditions on the material since the start of the run [momentum]; without symmetry planes and
  /// walls.
  const Vec3& impulse() const { return impulse_; }

  /// The reactions are those of the last step; all else but the sums belongs to the model and the present nodes.
  friend void archive(Archive& a, NodalConditions& conditions) {
    auto& [model, lattice, chosen, located, reactions, work, impulse] = conditions;
    a.version(1);
    a("work", work), a("impulse", impulse);
  }

 private:
  // A node with the conditions on it that share a direction.
  struct Chosen {
    Index<Dim> node;
    Vec<Dim> direction;
    std::vector<std::size_t> conditions;
  };
  struct Located {
    std::int64_t node;
    std::size_t chosen;
    double pending = 0.0;  // change of the velocity component by impose()
  };

  double prescribed(const Chosen& chosen, const Vec<Dim>& x, double time, double dt) const;

  const Model& model_;
  Lattice<Dim> lattice_;
  std::vector<Chosen> chosen_;
  std::vector<Located> located_;
  std::vector<Vec3> reactions_;
  double work_ = 0.0;
  Vec3 impulse_ = Vec3::Zero();
};

}  // namespace tribo
