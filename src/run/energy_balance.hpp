// SPDX-License-Identifier: MIT
/// The energy balance of a run with a grid.
#pragma once

#include "solver/measures.hpp"
#include "solver/step.hpp"

namespace tribo {

/// The energies that no sum over particles contains. `all`: measures of the system in its present state.
template <int Dim>
RunEnergies run_energies(const Model& model, const System<Dim>& system, Stepper<Dim>& stepper, const Measures& all);

/// Content of energy: kinetic, stored, dissipated by materials, contact, damping and transfers, and potential, and what
/// thermal expansion has taken [energy].
inline double energy_content(const Measures& all, const RunEnergies& run) {
  return all.kinetic + all.stored + all.dissipated + all.expansion + run.potential + run.damping + run.transfer +
         run.contact + run.interface;
}

/// What the balance of a run cannot explain [energy]. `initial`: content at the start.
inline double energy_residual(const Measures& all, const RunEnergies& run, double initial) {
  return energy_content(all, run) - initial - run.external_work - run.boundary_work - run.stages;
}

}  // namespace tribo
