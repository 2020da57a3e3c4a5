// SPDX-License-Identifier: MIT
/// Sorting of the particles of all bodies into bins.
#pragma once

#include "solver/state/system.hpp"

namespace tribo {

/// Sorts when a particle may have left the reach of its bin, and returns particles that left the grid, as often as the
/// model allows.
template <int Dim>
class ParticleSort {
 public:
  ParticleSort(const Model& model, System<Dim>& system) : model_(model), system_(system) {}

  bool is_due() const { return !system_.sorted || system_.drift >= 1.0 - 1e-6; }
  /// Throws SimulationError if a particle left the grid, or a position is not a number.
  void sort();
  /// Number of times that a particle was returned to the grid, see Model::leave_limit.
  long returned = 0;

  friend void archive(Archive& a, ParticleSort& sort) {
    auto& [returned, model, system] = sort;
    a.version(1);
    a("returned", returned);
  }

 private:
  void return_to_grid(Body<Dim>& body);

  const Model& model_;
  System<Dim>& system_;
};

}  // namespace tribo
