// SPDX-License-Identifier: MIT
/// The velocity of a rigid material whose force on the rest follows a function of time.
#pragma once

#include "base/archive.hpp"
#include "model/model.hpp"

#include <algorithm>
#include <cmath>

namespace tribo {

/// Feedback with proportional, integral and derivative terms. The error of the load becomes one of the position by the
/// stiffness load/displacement, which is estimated all the time.
struct LoadController {
  double velocity = 0.0;      ///< prescribed in the next step                       [velocity]
  double displacement = 0.0;  ///< since the start                                   [length]
  double stiffness = 0.0;     ///< estimate of load/displacement; 0: not yet         [force/length]
  double error = 0.0;         ///< smoothed error of the position                    [length]
  double integral = 0.0;      ///< of the error over time                            [length time]

  /// Looks at the load [force] at the end of a step dt [time] that ended at `time`.
  void update(double load, double time, double dt, const LoadControl& control) {
    displacement += dt * velocity;
    estimate(load, control.smooth);
    if (!(stiffness > 0)) return;
    Variables at;
    at.t = time / control.function_time;
    const double now = (control.load_unit * control.load(at) - load) / stiffness;
    const double smoothed = control.smooth * error + (1 - control.smooth) * now;
    const double rate = (smoothed - error) / dt;
    const double wanted = control.Kp * smoothed + control.Ki * (integral + dt * now) + control.Kd * rate;
    velocity = std::clamp(wanted, -control.fastest, control.fastest);
    if (velocity == wanted) integral += dt * now;  // a velocity at its limit does not wind the integral up
    error = smoothed;
  }

 private:
  // The value that is close to load/displacement and to the last estimate, relative to both.
  void estimate(double load, double smooth) {
    const double now = displacement != 0 ? load / displacement : 0.0;
    if (!(now > 0)) return;
    if (!(stiffness > 0)) {
      stiffness = now;
      return;
    }
    const double near = 2 * (1 - smooth) / (load * load + std::pow(stiffness * displacement, 2)),
                 keep = smooth / (stiffness * stiffness);
    stiffness = (near * load * displacement + keep * stiffness) / (near * displacement * displacement + keep);
  }
};

inline void archive(Archive& a, LoadController& controller) {
  auto& [velocity, displacement, stiffness, error, integral] = controller;
  a.version(1);
  a("velocity", velocity), a("displacement", displacement), a("stiffness", stiffness);
  a("error", error), a("integral", integral);
}

}  // namespace tribo
