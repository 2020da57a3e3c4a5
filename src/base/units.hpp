// SPDX-License-Identifier: MIT
/// Units of the input. The solver uses one consistent system of length, mass and time.
#pragma once

#include <string>
#include <string_view>

namespace tribo {

/// Physical dimension of a parameter, for conversion and for the manual.
enum class Dimension {
  none,
  length,
  mass,
  time,
  velocity,
  acceleration,
  density,
  stress,
  force,
  rate,       ///< 1/time
  expansion,  ///< thermal expansion, 1/temperature (ppm in legacy input)
  temperature,
  heat_capacity,
  conductivity,
  heat_flux,  ///< power/area
  viscosity,
  interface_stiffness,  ///< stress/length
  energy_release,       ///< energy/area
  stress_intensity,     ///< stress length^1/2
  per_length,
  per_velocity,
  angle  ///< degrees in input, radians inside
};

/// The unit system a command file was written in.
struct Units {
  bool legacy = false;  ///< the dialect's mixed units without <ConsistentUnits>; inside: mm, g, s
  std::string length = "L", mass = "M", time = "T";

  /// What a number of this dimension is multiplied with when read.
  double factor(Dimension dimension) const;
  /// Factor for times in functions, conditions and ramps (ms in legacy files).
  double alternative_time() const { return legacy ? 1e-3 : 1.0; }
  /// `g/(mm s^2)`: the unit inside, for column heads and the manual.
  std::string name(Dimension dimension) const;
};

/// Generic unit of a dimension, as manuals print it: `stress`, `1/time`.
std::string_view dimension_name(Dimension dimension);

}  // namespace tribo
