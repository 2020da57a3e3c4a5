// SPDX-License-Identifier: MIT
/// Sorting of the particles of all bodies into bins.
#pragma once

#include "solver/distribution/distribution.hpp"

namespace tribo {

/// Sorts the particles when one of them may have moved by a cell since the last sort, and returns particles that left
/// the grid, as often as the model permits.
template <int Dim>
class ParticleSort {
 public:
  ParticleSort(const Model& model, System<Dim>& system, Distribution<Dim>& distribution)
      : model_(model), system_(system), distribution_(distribution) {}

  /// Whether the particles must be sorted before the next step.
  bool is_due() const { return system_.sort_is_due(); }
  /// Sorts the particles of all bodies, and moves those that are now in blocks of other processes to these. Throws
  /// SimulationError if a position is not finite, or if a particle left the grid more often than Model::leave_limit
  /// permits.
  void sort();
  /// Number of times that a particle was returned to the grid, see Model::leave_limit.
  long returned = 0;

  friend void archive(Archive& a, ParticleSort& sort) {
    auto& [its_returned, model, system, distribution] = sort;
    a.version(1);
    a("returned", its_returned);
  }

 private:
  void return_to_grid(Body<Dim>& body);

  const Model& model_;
  System<Dim>& system_;
  Distribution<Dim>& distribution_;
};

}  // namespace tribo
