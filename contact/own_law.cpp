// SPDX-License-Identifier: MIT
#include "contact/own_law.hpp"

#include <cmath>

namespace tribo {

NormalContact rigid_contact_of(const ContactState& state) { return resolve_contact(state, {}); }

ContactResponse sliding_beyond(const ContactState& state, double limit) {
  return frictional_response(state, resolve_contact(state, {}), limit, false);
}

ContactResponse response_with(const ContactState& state, const Vec3& impulse) {
  static constexpr double same = 1e-9;  // of two impulses, relative
  ContactResponse out;
  out.bond = state.bond, out.impulse = impulse;
  if (impulse == Vec3::Zero()) return out;
  const auto along = [&](const Vec3& v) { return Vec3(v - v.dot(state.normal) * state.normal); };
  const Vec3 stop = state.mass * along(state.velocity);
  const bool sticks = (along(impulse) - stop).norm() <= same * (stop.norm() + std::abs(impulse.dot(state.normal)));
  out.status = sticks ? ContactStatus::stick : ContactStatus::slip;
  return out;
}

}  // namespace tribo
