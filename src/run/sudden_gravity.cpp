// SPDX-License-Identifier: MIT
#include "run/sudden_gravity.hpp"

#include "contact/contact_law.hpp"

#include <algorithm>

namespace tribo {
namespace {

// The tangential impulse against a tangential velocity, for a unit normal impulse, after slip over a length.
double friction(const ContactLaw& law, double velocity, double slip) {
  ContactState m;
  m.mass = m.dt = m.area = 1.0, m.velocity = Vec3(-1, velocity, 0), m.slip = slip;
  return law.response(m).impulse[1];
}

// Whether faces hold more at rest than while they slide.
bool holds_more_at_rest(const ContactLaw& law) {
  constexpr double far = 1e6;
  const double sliding = friction(law, far, far);
  return sliding > 0 && std::max(friction(law, far, 0.0), friction(law, 1.02 * sliding, 0.0)) > 1.01 * sliding;
}

bool has_initial_stress(const Piece& piece) { return piece.K0 || piece.stress.given(); }

}  // namespace

SuddenGravity sudden_gravity(const Model& model) {
  SuddenGravity out;
  const Damping& d = model.damping;
  const bool damped = d.grid || d.particle || d.grid_gain || d.particle_gain ||
                      std::any_of(model.materials.begin(), model.materials.end(),
                                  [](const MaterialSpec& m) { return m.particle_damping.value_or(0.0) > 0; });
  if ((!model.contact.active && model.cracks.empty()) || model.body_force.gravity.isZero() || damped ||
      std::any_of(model.pieces.begin(), model.pieces.end(), has_initial_stress))
    return out;
  const auto test = [&](const ContactLaw* law, bool& slips) {
    if (!law || !law->uses_face() || law->interface() || law->liquid() != 0) return;
    slips = slips || friction(*law, 1.0, 0.0) > 0;
    out.static_slip = out.static_slip || holds_more_at_rest(*law);
  };
  if (model.contact.active) test(model.contact.default_law.get(), out.slips);
  for (const auto& [materials, law] : model.contact.pair_laws) test(law.get(), out.slips);
  for (const CrackSpec& crack : model.cracks) test(crack.law.get(), out.crack_slips);
  return out;
}

std::string sudden_gravity_advice() {
  return "gravity acts suddenly on bodies without stress or damping: they vibrate, and faces that would stick slip "
         "whenever the pressure is low; let gravity grow (<GridBodyYForce> as a function of t), or damp the start";
}

}  // namespace tribo
