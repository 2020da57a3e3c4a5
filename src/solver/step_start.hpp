// SPDX-License-Identifier: MIT
/// Copies of particle columns as they are at the start of a step.
#pragma once

#include "solver/state/system.hpp"

#include <algorithm>

namespace tribo {

/// Stores F for CPDI, whose shape functions stay constant within a step although stress-first schemes update F.
template <int Dim>
void keep_start_domains(System<Dim>& system) {
  for (auto* bodies : {&system.bodies, &system.rigids})
    for (auto& body : *bodies) {
      if (!body.domain) continue;
      const auto F = body.particles.F();
      for (std::size_t k = 0; k < Dim * Dim; ++k)
        std::copy_n(F[k], body.particles.size(), body.particles[body.domain][k]);
    }
}

/// Stores the positions for the "+" schemes, which compute the strain of the moved particles with the shape functions
/// at their earlier positions.
template <int Dim>
void keep_start_positions(System<Dim>& system) {
  for (auto* bodies : {&system.bodies, &system.rigids})
    for (auto& body : *bodies) {
      const auto from = body.particles.x();
      const auto to = body.particles[body.start];
      const std::size_t count = body.particles.size() + body.particles.ghosts();
      for (std::size_t d = 0; d < Dim; ++d) std::copy_n(from[d], count, to[d]);
    }
}

}  // namespace tribo
