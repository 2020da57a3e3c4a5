// SPDX-License-Identifier: MIT
/// What the frictional laws share: when faces touch, and what it takes to make them stick.
#pragma once

#include "contact/contact_law.hpp"
#include "contact/interface.hpp"

namespace tribo {

/// The parameters every frictional law has.
struct TouchRule {
  double displacement_only = 0.0;  ///< 0: faces touch under compression; > 0: whenever they overlap; < 0: also under
                                   ///< tension up to minus this
  double compliance_stiffness = -1.0;  ///< Dc, normal stiffness of faces in contact; negative: rigid [stress/length]
};

/// Coefficient between static and dynamic: it falls along the way the faces have slid, linearly within a weakening
/// distance. Friction that dropped at once would let slip run along a strong face like a crack from any corner, as
/// breaking would cost no energy; the distance gives it a length that the grid resolves. Default: 0.01 cells.
struct StaticFriction {
  double fixed = -1.0, sliding = 0.0, distance = -1.0;
  double coefficient(const ContactState& m) const {
    if (!(fixed > 0)) return sliding;
    const double way = distance >= 0 ? distance : 0.01 * m.cell;
    return m.slip < way ? fixed + (sliding - fixed) * m.slip / way : sliding;
  }
};

/// Tangential and normal part of a meeting.
struct Contact {
  double normal;   ///< J . n of the contact; 0 if open
  bool touching;   ///< faces are in contact
  Vec3 direction;  ///< of the relative sliding; zero if there is none
  double stick;    ///< impulse along `direction` that ends the sliding, >= 0
  double pressure() const { return normal < 0 ? -normal : 0.0; }  ///< compressive impulse N A dt >= 0
};

/// Signorini's condition at the end of the step: 0 <= -J_n, 0 <= g + dt v_n, one of them zero. Faces that are apart
/// may close their gap but not pass each other; the impulse never adds energy.
inline double normal_impulse(const ContactState& m, const TouchRule& rule) {
  const double v = m.velocity.dot(m.normal);
  if (rule.compliance_stiffness >= 0) {
    const double start = m.start.dot(m.normal);
    const double k = rule.compliance_stiffness * m.area;
    const double impulse = interface_impulse(m.mass, k, std::min(m.gap, 0.0), start, v, m.dt);
    return m.gap + m.dt * v < 0 ? std::min(0.0, impulse) : 0.0;
  }
  if (m.gap > 0) return std::min(0.0, m.mass * (v + m.gap / m.dt));
  const double hold = m.mass * v;
  if (rule.displacement_only > 0) return hold;
  return hold < -rule.displacement_only * m.area * m.dt ? hold : std::min(0.0, hold);
}

inline Contact resolve(const ContactState& m, const TouchRule& rule) {
  Contact c;
  c.normal = normal_impulse(m, rule);
  c.touching = c.normal != 0.0;
  const Vec3 slide = m.velocity - m.velocity.dot(m.normal) * m.normal;
  const double speed = slide.norm();
  c.direction = speed > 0 ? Vec3(slide / speed) : Vec3(Vec3::Zero());
  c.stick = m.mass * speed;
  return c;
}

/// Answer for a tangential impulse `slide` of the law: the smaller of it and what sticks.
inline ContactResponse rub(const ContactState& m, const Contact& c, double slide, bool hold) {
  ContactResponse out;
  const bool sticks = hold || c.stick <= slide;
  out.status = sticks ? ContactStatus::stick : ContactStatus::slip;
  out.impulse = c.normal * m.normal + (sticks ? c.stick : std::max(0.0, slide)) * c.direction;
  out.bond = m.bond;
  return out;
}

/// The two parameters of TouchRule for the table of a law with a member `rule`-like doubles.
template <class Law>
Parameter<Law> displacement_only_parameter(double Law::*member) {
  return {"displacementOnly",
          member,
          Dimension::none,
          any_value,
          "1: in contact whenever faces overlap; 0: only under compression; negative: up to that tension",
          0.0};
}
template <class Law>
Parameter<Law> weakening_parameter(double Law::*member) {
  return {"weakening",
          member,
          Dimension::length,
          any_value,
          "way of sliding along which friction falls from static to dynamic; negative: 0.01 cells",
          -1.0};
}
template <class Law>
Parameter<Law> contact_stiffness_parameter(double Law::*member) {
  return {"Dc",
          member,
          Dimension::interface_stiffness,
          any_value,
          "normal stiffness of faces in contact; negative: they do not penetrate",
          -1.0};
}

}  // namespace tribo
