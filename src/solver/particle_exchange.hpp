// SPDX-License-Identifier: MIT
/// Particles that enter at sources, and particles that are removed during a run.
#pragma once

#include "solver/state/system.hpp"

#include <cstdint>
#include <vector>

namespace tribo {

/// Removes particles that have failed or left the grid, and adds rows of particles at sources, between two steps.
template <int Dim>
class ParticleExchange {
 public:
  ParticleExchange(const Model& model, System<Dim>& system);

  /// Looks for particles of this process to remove, and advances the sources over the last step, of size `dt`. Returns
  /// whether apply() has something to do.
  bool find(double dt);
  /// Looks again for particles to remove, once all of them are in this process.
  void find_again() { find_leaving(); }
  /// Removes and adds what was found. The particles must then be sorted. Throws SimulationError if more particles have
  /// left the grid than the model permits.
  void apply();

 private:
  // The particles of a body that are to be removed, in increasing order.
  struct Leaving {
    Body<Dim>* body;
    std::vector<std::uint32_t> particles;
    std::int64_t failed = 0, outside = 0;  // for what reason
  };
  void find_leaving();
  bool is_outside(const Vec<Dim>& x) const;
  void remove(const Leaving& leaving);
  void inject(Inflow<Dim>& inflow);

  const Model& model_;
  System<Dim>& system_;
  std::vector<Leaving> leaving_;
  std::vector<std::size_t> entering_;  // indices into System::inflow
};

}  // namespace tribo
