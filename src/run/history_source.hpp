// SPDX-License-Identifier: MIT
/// What the quantities of history.csv are computed from in a run with a grid.
#pragma once

#include "model/quantities.hpp"
#include "solver/measures.hpp"
#include "solver/step.hpp"

namespace tribo {

template <int Dim>
class RunHistorySource final : public HistorySource {
 public:
  /// `measures`: of what `quantity` refers to; `dt`: present step [time]. All but `measures` must outlive the source.
  RunHistorySource(const Model& model, System<Dim>& system, Stepper<Dim>& stepper, const HistoryQuantity& quantity,
                   Measures measures, const RunEnergies& energies, double dt)
      : model_(model),
        system_(system),
        stepper_(stepper),
        quantity_(quantity),
        measures_(std::move(measures)),
        energies_(energies),
        dt_(dt) {}

  const Measures& measures() const override { return measures_; }
  const RunEnergies& energies() const override { return energies_; }
  Vec3 reaction() const override;
  ContactSums contact() const override;
  double heat_supplied() const override { return stepper_.heat().supplied; }
  double contact_heat() const override { return stepper_.heat().from_contact; }
  double grid_damping() const override { return stepper_.damping().grid; }
  double particle_damping() const override { return stepper_.damping().particle; }
  std::int64_t step() const override { return system_.step; }
  double step_size() const override { return dt_; }
  double processor_time() const override;
  double elapsed_time() const override;

 private:
  bool has_material(std::size_t field, int material) const;

  const Model& model_;
  System<Dim>& system_;
  Stepper<Dim>& stepper_;
  const HistoryQuantity& quantity_;
  Measures measures_;
  const RunEnergies& energies_;
  double dt_;
};

}  // namespace tribo
