// SPDX-License-Identifier: MIT
/// The faces on which imperfect interfaces of two bodies act.
#pragma once

#include "base/archive.hpp"
#include "solver/state/system.hpp"

namespace tribo {

/// Adds a surface without joints for every two bodies whose contact law is an imperfect interface with an elastic
/// direction (InterfaceLaw), unless they have a joint law or share a velocity field. Throws InputError if one of the
/// bodies is a block, or if particles of the model split.
template <int Dim>
void add_imperfect_interfaces(const Model& model, System<Dim>& system);

/// Adds joints to the surfaces of imperfect interfaces where faces have met.
///
/// An interface begins where two faces touch, free of stress. From then on its joint keeps the displacement jump. A
/// joint that has opened by more than a cell, or one of whose faces ends there, is removed; the faces may then meet
/// again.
template <int Dim>
class InterfaceFaces {
 public:
  InterfaceFaces(const Model& model, System<Dim>& system);

  /// Finds the faces that have met, if particles may have moved far enough since the last search.
  void find();
  /// `travel`: largest distance that a particle moved in the step [cells].
  void add_travel(double travel) { travel_ += travel; }

  friend void archive(Archive& a, InterfaceFaces& faces) {
    auto& [model, system, any, travel] = faces;
    a.version(1);
    a("travel", travel);
  }

 private:
  void remove_detached(JointSurface<Dim>& surface);
  void add_joints(JointSurface<Dim>& surface);

  const Model& model_;
  System<Dim>& system_;
  bool any_;
  double travel_;  ///< since the last search [cells]
};

}  // namespace tribo
