// SPDX-License-Identifier: MIT
/// Gravity that is applied at once to bodies that touch with friction.
#pragma once

#include "model/model.hpp"

#include <string>

namespace tribo {

/// Friction under gravity that acts from the start on bodies without stress and damping. Such bodies vibrate with
/// amplitudes of their whole pressure, and slip whenever the pressure is low, however large the static friction.
struct SuddenGravity {
  bool slips = false;        ///< a pair of materials has friction
  bool crack_slips = false;  ///< a crack has friction
  bool static_slip = false;  ///< a pair or a crack has a static friction above the dynamic one
};
SuddenGravity sudden_gravity(const Model& model);
/// What to do about it.
std::string sudden_gravity_advice();

}  // namespace tribo
