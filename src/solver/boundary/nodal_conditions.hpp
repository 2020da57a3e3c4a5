// SPDX-License-Identifier: MIT
/// Prescribed velocities on the nodes of one velocity field.
#pragma once

#include "base/ranks.hpp"
#include "solver/boundary/moving_walls.hpp"
#include "solver/boundary/selected_nodes.hpp"

#include <memory>
#include <vector>

namespace tribo {

/// The nodal conditions of the model, applied to the nodes that exist at present.
template <int Dim>
class NodalConditions {
 public:
  /// The nodes are selected once from the whole lattice; copies, for other fields, share them. Throws InputError for a
  /// condition that selects no node.
  NodalConditions(const Model& model, const Lattice<Dim>& lattice);

  /// Finds the selected nodes among the blocks that exist; to be called after every change of the map.
  void locate(const BlockMap<Dim>& map);

  /// Sets the velocities prescribed at `time` before a strain update, and stores the change of each velocity.
  void impose(NodeLayer& nodes, double time, double dt);
  /// Sets the velocities prescribed at time + dt after the momentum update. The acceleration is the change of the
  /// prescribed velocity from `time` to time + dt; it does not include the difference between the prescribed velocity
  /// and the nodal velocity that the transfer from the particles gives. Only in the `first` step, that difference is
  /// part of the reaction, since a body may start with a velocity that differs from that of its supports.
  /// `after_impose`: impose() was called earlier in the step. `replaced`: share of the nodal velocities that the
  /// particles take over; with this share the difference is part of the impulse.
  void impose_update(NodeLayer& nodes, const Exchange<Dim>& exchange, double time, double dt, bool after_impose,
                     bool first, double replaced);
  /// Removes the prescribed components from the increments of a velocity filter.
  void release(AlignedVector<FilterNode>& nodes) const;
  /// The same for increments that the particles take over: what is removed is part of the impulse.
  void release(AlignedVector<FilterNode>& nodes, const Exchange<Dim>& exchange);

  /// Reaction force of each condition on the material in the last step [force].
  const std::vector<Vec3>& reactions() const { return reactions_; }
  /// Work done on the material since the start of the run [energy].
  double work() const { return work_; }
  /// Impulse of the conditions on the material since the start of the run [momentum]; symmetry planes and walls are
  /// not included.
  const Vec3& impulse() const { return impulse_; }

  /// Saves and restores the sums of work and impulse. The reactions are computed in every step; all other members
  /// follow from the model and the current nodes.
  friend void archive(Archive& a, NodalConditions& conditions) {
    auto& [model, lattice, selected, located, walls, sums, reactions, work, impulse] = conditions;
    a.version(1);
    a("work", work), a("impulse", impulse);
  }

 private:
  NodalConditions(const Model& model, const Lattice<Dim>& lattice, Problems problems);

  // A selected node that exists at present.
  struct Located {
    std::int64_t node;
    std::size_t selected;
    bool own;              // whether it counts in the sums of this process
    double pending = 0.0;  // change of the velocity component in impose()
  };

  double prescribed(const SelectedNode<Dim>& selected, const Vec<Dim>& x, double time, double dt) const;
  // Adds to the sums of a step, and these to the members.
  void book_reaction(std::size_t condition, const Vec3& force);
  void book_impulse(const Vec3& impulse);
  void add_booked(double dt);

  const Model& model_;
  Lattice<Dim> lattice_;
  std::shared_ptr<const SelectedNodes<Dim>> selected_;
  std::vector<Located> located_;
  MovingWalls<Dim> walls_;
  SumList sums_;  // of a step: the components of the reaction of each condition and of a further impulse, and the power
  std::vector<Vec3> reactions_;
  double work_ = 0.0;
  Vec3 impulse_ = Vec3::Zero();
};

}  // namespace tribo
