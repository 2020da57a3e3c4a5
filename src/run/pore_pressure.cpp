// SPDX-License-Identifier: MIT
#include "run/pore_pressure.hpp"

#include "base/text.hpp"

namespace tribo {
namespace {

// Whether a law tears a joint at rest whose pressure stays as it is.
bool tears_at_rest(const JointLaw& law, const Joint& joint) {
  if (joint.torn || joint.away) return false;
  Joint after = joint;
  JointIncrement rest;
  rest.gap = joint.gap, rest.pressure = joint.pressure;
  rest.poisson_normal = joint.poisson_normal, rest.poisson_shear = joint.poisson_shear;
  std::vector<JointEvent> events;
  law.update({&after, 1}, {&rest, 1}, events);
  return after.torn || (law.is_bonded(joint) && !law.is_bonded(after));
}

std::string sentence(std::size_t count) {
  if (count == 0) return {};
  return std::to_string(count) + (count == 1 ? " joint tears" : " joints tear") +
         " in the first step: their pore pressure exceeds the stress at the start and the tensile strength. Give the "
         "stress of the ground at the start, or let the joints begin in equilibrium with the pressure "
         "(pressure-in-equilibrium or sn_porp_equilibrium 1)";
}

}  // namespace

template <int Dim>
std::string torn_by_pressure(const System<Dim>& system) {
  std::size_t count = 0;
  for (const JointSurface<Dim>& surface : system.joints) {
    if (surface.interface) continue;
    for (const Joint& joint : surface.joints) count += tears_at_rest(*surface.law, joint);
  }
  return sentence(count);
}

std::string torn_by_pressure(const Assembly& blocks) {
  std::size_t count = 0;
  for (const ContactGroup& group : blocks.groups)
    for (std::size_t k = group.begin; k < group.end; ++k) count += tears_at_rest(*group.law, blocks.joints[k]);
  return sentence(count);
}

template std::string torn_by_pressure(const System<2>&);
template std::string torn_by_pressure(const System<3>&);

}  // namespace tribo
