// SPDX-License-Identifier: MIT
/// Prescribed changes of the temperature of all particles.
#pragma once

#include "base/ranks.hpp"
#include "solver/transfer/transfer.hpp"

namespace tribo {

/// Applies the temperature ramps of a model; it has no state of its own.
template <int Dim>
class TemperatureRamps {
 public:
  TemperatureRamps(const Model& model, System<Dim>& system) : ramps_(model.heat.ramps), system_(system) {}

  /// Adds the changes during the step dt that begins at the present time [time]. Returns the heat of these changes
  /// [energy].
  double apply(double dt);

 private:
  void heat_up(Body<Dim>& body, const TemperatureRamp& ramp, double change, double dt, OrderlessSums<1>& all);

  const std::vector<TemperatureRamp>& ramps_;
  System<Dim>& system_;
};

}  // namespace tribo
