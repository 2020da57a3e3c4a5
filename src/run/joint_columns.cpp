// SPDX-License-Identifier: MIT
#include "run/joint_columns.hpp"

#include "output/number.hpp"

#include <algorithm>

namespace tribo {

const std::vector<std::string>& joint_event_columns() {
  static const std::vector<std::string> names{"event", "mode", "strength", "energy", "force", "shear", "twist", "bend"};
  return names;
}

std::vector<std::string> joint_event_texts(const JointEvent& e) {
  const auto flag = [](bool is) { return std::string(is ? "1" : "0"); };
  return {std::string(e.name()), std::to_string(e.mode), number_text(e.strength), number_text(e.energy),
          number_text(e.force),  flag(e.shear),          flag(e.twist),           flag(e.bend)};
}

JointColumns::JointColumns(std::span<const JointLaw* const> laws) {
  for (const JointLaw* law : laws)
    for (const auto name : law->own_names())
      if (std::find(names_.begin(), names_.end(), name) == names_.end()) names_.push_back(name);
}

void JointColumns::add(Columns& out, const JointLaw& law, const Joint& j, const JointAxes& axes, double dashpot) const {
  out.text("state_text", law.state_text(j));
  const auto names = law.own_names();
  const auto values = law.own_values(j);
  for (const auto name : names_) {
    const auto found = std::find(names.begin(), names.end(), name);
    out.number(std::string(name), found == names.end() ? 0.0 : values[static_cast<std::size_t>(found - names.begin())]);
  }
  out.vector("dashpot_force", Vec3(axes.vector(j.dashpot_shear) - j.dashpot_normal * axes.n));
  out.vector("sn_pois_force", Vec3(axes.vector(j.poisson_shear) - j.poisson_normal * axes.n));
  out.number("strain_energy", j.strain);
  out.number("slip_energy", -j.slid);
  out.number("dashpot_energy", dashpot);
  out.number("released_energy", j.released());
}

}  // namespace tribo
