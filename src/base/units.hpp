// SPDX-License-Identifier: MIT
/// Units of the input. The solver uses one consistent system of length, mass and time.
#pragma once

#include <optional>
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

/// The system of units of a command file.
struct Units {
  bool legacy = false;  ///< legacy units of NairnMPM, without <ConsistentUnits>; internally mm, g, s
  std::string length = "L", mass = "M", time = "T";

  /// Conversion factor from a number of this dimension in the file to consistent units.
  double factor(Dimension dimension) const;
  /// Factor for times in functions, conditions and ramps (ms in legacy files).
  double alternative_time() const { return legacy ? 1e-3 : 1.0; }
  /// Size of the consistent unit of a length, mass or time in m, kg or s; none for units without a name.
  std::optional<double> size_in_si(Dimension dimension) const;
  /// Name of the consistent unit, e.g. `g/(mm s^2)`, for column heads and the manual.
  std::string name(Dimension dimension) const;
};

/// Generic unit of a dimension, for the manual: `stress`, `1/time`.
std::string_view dimension_name(Dimension dimension);

}  // namespace tribo
