// SPDX-License-Identifier: MIT
/// Contacts of SpringNetwork at a square face of 10 x 10 mm, E = 50 GPa, d = 10 mm.
#pragma once

#include "contact/joint_cases.hpp"

#include <cmath>
#include <numbers>
#include <stdexcept>

namespace tribo::test::bonds {

inline constexpr double A = 1e-4, kA = 5e8, k_twist = 8333.333333333334, k_bend = 4166.666666666667;
inline const double R = std::sqrt(A / std::numbers::pi), I = A * A / (4 * std::numbers::pi), J = 2 * I;

inline JointSite face() {
  JointSite site;
  site.area = A, site.distance = 0.01, site.plane = false;
  site.has_moments = true, site.moments = {A * A / 12, A * A / 12, 0};
  return site;
}
inline Contact bond(const Properties& properties) {
  return {"SpringNetwork", Properties{{"compute-stiffness", "emod 50e9"}, {"bond", ""}} + properties, face()};
}
inline Contact loose(const Properties& properties) {
  return {"SpringNetwork", Properties{{"compute-stiffness", "emod 50e9"}} + properties, face()};
}
inline const JointEvent& last_break(const Contact& c) {
  for (auto e = c.events.rbegin(); e != c.events.rend(); ++e)
    if (e->kind == JointEvent::Kind::bond_break) return *e;
  throw std::logic_error("nothing broke");
}
inline const Properties strong{{"sn_ten", "1e12"}, {"sn_coh", "1e12"}};
inline const Properties brittle{{"sn_ten", "5e6"}, {"sn_coh", "50e6"}};
inline const Properties rock{{"sn_ten", "5e6"}, {"sn_coh", "10e6"}, {"sn_fa", "30"}};
inline const Properties soft = brittle + Properties{{"sn_tendc", "4e-6"}};
/// Slides along s under F_n until the bond breaks; the largest shear force.
inline double slide_to_break(Contact& c, double by = 1e-9) {
  double most = 0;
  for (int k = 0; k < 20000 && c.joint.state >= 3; ++k) {
    most = std::max(most, c.joint.Fs.norm());
    c.shear(by);
  }
  return most;
}

}  // namespace tribo::test::bonds
