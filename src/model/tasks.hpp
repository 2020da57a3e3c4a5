// SPDX-License-Identifier: MIT
/// Tasks that act during a run: removal and inflow of particles, reversal and control of loads, search for the factor
/// of safety.
#pragma once

#include "base/expression.hpp"
#include "base/types.hpp"

#include <array>
#include <cstddef>
#include <optional>

namespace tribo {

/// Removal of particles of a material during a run.
struct DeletionSpec {
  int material = 0;
  double opening = 0.0;  ///< of the crack in a failed particle, from which on it is removed       [length]
  double time = -1.0;    ///< all particles of the material are removed at this time; negative: never
};

/// An inlet through which particles of a material enter the grid. Their velocity is prescribed on the nodes around it.
struct SourceSpec {
  int material = 0;
  Vec3 centre = Vec3::Zero();
  Vec3 direction = Vec3::UnitX();   ///< of the flow, a unit vector; in space along an axis
  double width = 0.0, depth = 0.0;  ///< of the inlet, across the flow                            [length]
  std::array<int, 2> count{1, 1};   ///< particles along width and depth
  double size = 0.0;                ///< edge of the particles                                    [length]
  Expression rate;                  ///< volume per time, as a function of t
  double function_time = 1.0;       ///< consistent time of one unit of t in `rate`
  /// Speed of the flow.
  double speed(double time) const {
    Variables at;
    at.t = time / function_time;
    return rate(at) / (width * depth);
  }
};

/// Strength reduction method: search for the factor of safety by which all strengths are divided at failure.
struct StrengthReduction {
  double low = 1.0, high = 2.0;  ///< initial bracket
  double tolerance = 0.01;       ///< width of the final bracket
  double growth = 0.05;          ///< failure: relative growth of the largest displacement in the run's last quarter
  std::optional<double> displacement;  ///< failure: largest displacement [length]
};

/// What loads, tractions and the motion of rigid materials do when a history passes a value, or when a crack has
/// reached a length. Cracks do not grow beyond that length.
struct LoadReversal {
  std::size_t history = 0;  ///< index into OutputSpec::history, unless `crack` is given
  double value = 0.0;       ///< in the unit of the history; with `crack` the length  [length]
  enum class Style {
    reverse,  ///< they go back the way they came, and the run ends when they are back
    hold,     ///< they stay as they are, rigid materials stop
    stop,     ///< the run ends
    none      ///< they go on; only the growth of cracks ends
  } style = Style::reverse;
  double hold = 0.0;                   ///< reverse: they stay as they are for this time first [time]
  std::optional<double> least;         ///< reverse: the run ends when the history passes this value on the way back
  std::optional<std::size_t> crack{};  ///< of the crack that reaches the length; beyond the last: any of them
};

/// Feedback that moves a rigid material so that its force on the rest follows a function of time.
struct LoadControl {
  int material = -1;           ///< the rigid material
  int axis = 0;                ///< direction of motion and load
  Expression load;             ///< wanted force, in the units of the input, as a function of t
  double load_unit = 1.0;      ///< force of a value 1 of `load`                            [force]
  double function_time = 1.0;  ///< time of one unit of t in `load`                         [time]
  double start = 0.0;          ///< velocity until the stiffness is known                   [velocity]
  double fastest = 0.0;        ///< largest speed                                           [velocity]
  double Kp = 0.0;             ///< gain of the error                                       [1/time]
  double Ki = 0.0;             ///< gain of its integral                                    [1/time^2]
  double Kd = 0.0;             ///< gain of its rate
  double smooth = 0.9;         ///< share of the last value in the smoothed ones, per step
};

}  // namespace tribo
