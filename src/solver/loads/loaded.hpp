// SPDX-License-Identifier: MIT
/// The particles on which loads, tractions and heat fluxes act.
#pragma once

#include "solver/state/system.hpp"

#include <algorithm>
#include <vector>

namespace tribo {

/// Marks the particles on which each condition acts in the column `load_set`. Returns one factor per condition, by
/// which its value is multiplied: 1, or for net loads the inverse of the number of its particles. Throws InputError if
/// a condition selects no particle or if there are more conditions than bits in the column.
///
/// In the model of a stage no particle is marked: see mark_loaded().
template <int Dim>
std::vector<double> find_loaded(const Model& model, System<Dim>& system);

/// At the begin of the stage of a model: marks the particles on which its conditions act by their present positions.
/// Those that were there before (StagePlace::kept) keep their particles. Returns the factors as find_loaded(), and adds
/// the places of conditions without a particle to `none`.
template <int Dim>
std::vector<double> mark_loaded(const Model& model, System<Dim>& system, std::vector<Origin>& none);

/// Calls f(condition, body, particle) for every marked particle and ghost and each of its conditions of one kind, in
/// the order that the particles have in a single process.
template <int Dim, class F>
void each_loaded(const Model& model, System<Dim>& system, ParticleCondition::Kind kind, F&& f) {
  const auto& conditions = model.particle_conditions;
  if (std::none_of(conditions.begin(), conditions.end(), [&](const auto& c) { return c.kind == kind; })) return;
  for (auto& body : system.bodies) {
    if (!body.load_set) continue;
    const double* set = body.particles[body.load_set];
    body.each_known_particle([&](std::size_t i) {
      if (set[i] == 0.0) return;
      for (std::size_t c = 0; c < conditions.size(); ++c)
        if (conditions[c].kind == kind && (static_cast<std::uint64_t>(set[i]) >> c & 1U)) f(conditions[c], body, i);
    });
  }
}

}  // namespace tribo
