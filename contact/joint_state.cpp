// SPDX-License-Identifier: MIT
/// Saving and restoring joints.

#include "base/archive.hpp"
#include "contact/joint_law.hpp"

#include <cmath>

namespace tribo {
namespace {

bool is_possible(const Joint& joint) {
  static constexpr double most = 1e150;  // the squares must be numbers, too
  for (const double x :
       {joint.Fn, joint.Fs.s, joint.Fs.t, joint.Mt, joint.Mb.s, joint.Mb.t, joint.opening, joint.shear.s, joint.shear.t,
        joint.gap, joint.pressure, joint.rest_gap, joint.strain, joint.work})
    if (!(std::abs(x) < most)) return false;
  for (const double x :
       {joint.area, joint.kn, joint.ks, joint.twist_stiffness, joint.radius, joint.inertia, joint.polar, joint.slip,
        joint.elongation, joint.largest[0], joint.largest[1], joint.decohesion[0], joint.decohesion[1]})
    if (!(x >= 0 && x < most)) return false;
  for (const double x : joint.damage)
    if (!(x >= 0 && x <= 1)) return false;
  return joint.state >= 0;
}

}  // namespace

void archive(Archive& a, Joint& joint) {
  auto& [area, kn, ks, twist_stiffness, bend_stiffness, radius, inertia, polar, Fn, Fs, Mt, Mb, dashpot_normal,
         dashpot_shear, poisson_normal, poisson_shear, opening, shear, gap, pressure, rest_gap, slip, elongation, onset,
         state, slips, bends, twists, shear_weak, torn, away, largest, damage, decohesion, strain, slid, damped, work,
         start] = joint;
  a.version(3);
  a("area", area), a("kn", kn), a("ks", ks), a("twist_stiffness", twist_stiffness);
  a("bend_stiffness", bend_stiffness), a("radius", radius), a("inertia", inertia), a("polar", polar);
  a("Fn", Fn), a("Fs", Fs), a("Mt", Mt), a("Mb", Mb);
  a("dashpot_normal", dashpot_normal), a("dashpot_shear", dashpot_shear);
  a("poisson_normal", poisson_normal), a("poisson_shear", poisson_shear);
  a("opening", opening), a("shear", shear), a("gap", gap), a("pressure", pressure);
  a("rest_gap", rest_gap), a("slip", slip);
  a("elongation", elongation), a("onset", onset), a("state", state);
  a("slips", slips), a("bends", bends), a("twists", twists);
  a("shear_weak", shear_weak), a("torn", torn), a("away", away);
  a("largest", largest), a("damage", damage), a("decohesion", decohesion);
  a("strain", strain), a("slid", slid), a("damped", damped), a("work", work), a("start", start);
  if (a.reading() && !is_possible(joint)) refuse_checkpoint("'" + a.full_name("") + "': the state of a joint");
}

}  // namespace tribo
