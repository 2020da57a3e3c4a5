// SPDX-License-Identifier: MIT
/// Temperatures of particles and their changes.
#pragma once

#include "base/expression.hpp"
#include "geometry/region.hpp"
#include "model/prescribed.hpp"

#include <optional>
#include <vector>

namespace tribo {

/// Change of the temperature of all particles from `start` to `start + duration`, besides all other changes.
struct TemperatureRamp {
  double start = 0.0, duration = 0.0;  ///< [time]; a duration of 0: in one step
  double change = 0.0;                 ///< [temperature]
  bool sigmoidal = false;              ///< with a smooth start and end
  double lifetimes = 0.0;              ///< > 0: share 1 - exp(-(lifetimes x)^stretch) of the change, x from 0 to 1
  double stretch = 1.0;
  std::optional<Expression> share;  ///< of the change, as a function of position and time
  double function_time = 1.0;       ///< consistent time of one unit of the functions' argument t
  /// Fraction of the change that is done at a time.
  double done(double time) const;
};

struct HeatSpec {
  bool kept = false;  ///< particles have temperatures, because one of the options below or a law needs them
  bool conduction = false;
  bool work_heating = false;     ///< the work dissipated by material laws becomes heat
  bool contact_heating = false;  ///< the work of friction becomes heat
  double reference = 0.0;        ///< initial temperature of bodies without one of their own
  bool expansion = false;        ///< a material expands with its temperature
  std::vector<TemperatureRamp> ramps;
};

/// Prescribed temperature of grid nodes in a region.
struct TemperatureCondition {
  RegionPtr where;
  Prescribed temperature;
  Origin origin;
};

}  // namespace tribo
