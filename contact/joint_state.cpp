// SPDX-License-Identifier: MIT
/// Saving and restoring joints.

#include "base/archive.hpp"
#include "contact/joint_law.hpp"

namespace tribo {

void archive(Archive& a, Joint& joint) {
  auto& [area, kn, ks, twist_stiffness, bend_stiffness, radius, inertia, polar, Fn, Fs, Mt, Mb, dashpot_normal,
         dashpot_shear, poisson_normal, poisson_shear, opening, shear, gap, rest_gap, slip, elongation, onset, state,
         slips, bends, twists, shear_weak, torn, away, strain, slid, damped, work, start] = joint;
  a.version(1);
  a("area", area), a("kn", kn), a("ks", ks), a("twist_stiffness", twist_stiffness);
  a("bend_stiffness", bend_stiffness), a("radius", radius), a("inertia", inertia), a("polar", polar);
  a("Fn", Fn), a("Fs", Fs), a("Mt", Mt), a("Mb", Mb);
  a("dashpot_normal", dashpot_normal), a("dashpot_shear", dashpot_shear);
  a("poisson_normal", poisson_normal), a("poisson_shear", poisson_shear);
  a("opening", opening), a("shear", shear), a("gap", gap), a("rest_gap", rest_gap), a("slip", slip);
  a("elongation", elongation), a("onset", onset), a("state", state);
  a("slips", slips), a("bends", bends), a("twists", twists);
  a("shear_weak", shear_weak), a("torn", torn), a("away", away);
  a("strain", strain), a("slid", slid), a("damped", damped), a("work", work), a("start", start);
}

}  // namespace tribo
