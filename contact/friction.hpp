// SPDX-License-Identifier: MIT
/// Normal contact, and the limit of tangential impulses, for all frictional laws.
#pragma once

#include "contact/contact_law.hpp"
#include "contact/spring_step.hpp"

namespace tribo {

/// The parameters of normal contact.
struct NormalContactRule {
  /// 0: overlapping faces are in contact under compression; > 0: whenever they overlap; < 0: also under a tension of at
  /// most minus this value [stress].
  double displacement_only = 0.0;
  /// Normal stiffness Dc of faces in contact; negative: rigid [stress/length].
  double compliance_stiffness = -1.0;
};

/// Slip-weakening friction: the coefficient decreases linearly from the static to the dynamic value while the faces
/// slide by the weakening distance. If it dropped at once, the onset of sliding would dissipate no energy beyond
/// dynamic friction, and slip would start at stress concentrations at any load above the dynamic one and propagate
/// along the face; the distance sets a length that the grid can resolve. Without a distance the drop is sudden: faces
/// stick in a step in which the static coefficient suffices for that, and slide with the dynamic one otherwise.
struct SlipWeakening {
  double static_coefficient = -1.0;  ///< not positive: always the dynamic coefficient
  double dynamic_coefficient = 0.0;
  double distance = -1.0;  ///< weakening distance [length]; 0: sudden drop; negative: 0.01 cells
  /// The coefficient that limits the force of faces that stick in this step.
  double at_rest(const ContactState& m) const {
    return static_coefficient > 0 && distance == 0 ? static_coefficient : weakened(m);
  }
  /// The coefficient of faces that slide in this step.
  double sliding(const ContactState& m) const {
    return static_coefficient > 0 && distance == 0 ? dynamic_coefficient : weakened(m);
  }
  /// The coefficients depend on the slip, which the particles then store.
  bool has_memory() const { return static_coefficient > 0 && distance != 0; }

 private:
  /// The coefficient for the slip of the state.
  double weakened(const ContactState& m) const {
    if (!(static_coefficient > 0)) return dynamic_coefficient;
    const double length = distance >= 0 ? distance : 0.01 * m.cell;
    return m.slip < length ? static_coefficient + (dynamic_coefficient - static_coefficient) * m.slip / length
                           : dynamic_coefficient;
  }
};

/// The normal impulse of a pair, and its tangential motion.
struct NormalContact {
  double normal;  ///< J . n; 0 if open                                                       [mass velocity]
  bool closed;    ///< the faces are in contact
  Vec3 stop;      ///< tangential impulse that stops the sliding                              [mass velocity]
  double stick;   ///< its magnitude                                                          [mass velocity]
  /// Unit vector along the tangential relative velocity; zero if that is zero.
  Vec3 direction() const { return stick > 0 ? Vec3(stop / stick) : Vec3(Vec3::Zero()); }
  /// Compressive impulse N A dt >= 0, where N is the pressure [mass velocity].
  double pressure() const { return normal < 0 ? -normal : 0.0; }
};

/// The normal impulse J_n = J . n [mass velocity] by Signorini's condition at the end of the step: -J_n >= 0,
/// g + dt v_n >= 0, and one of them is zero, where g is the gap at the start and v_n the normal velocity after contact.
/// Open faces may close their gap but not penetrate; the impulse never adds energy.
inline double normal_impulse(const ContactState& m, const NormalContactRule& rule) {
  const double v = m.velocity.dot(m.normal);
  if (rule.compliance_stiffness >= 0) {
    const double start = m.start.dot(m.normal);
    const double k = rule.compliance_stiffness * m.area;
    const double impulse = spring_impulse(m.mass, k, std::min(m.gap, 0.0), start, v, m.dt);
    return m.gap + m.dt * v < 0 ? std::min(0.0, impulse) : 0.0;
  }
  if (m.gap > 0) return std::min(0.0, m.mass * (v + m.gap / m.dt));
  const double hold = m.mass * v;
  if (rule.displacement_only > 0) return hold;
  return hold < -rule.displacement_only * m.area * m.dt ? hold : std::min(0.0, hold);
}

/// Solves the normal contact of a state, and resolves its tangential motion. `only_closed`: not of open faces.
inline NormalContact resolve_contact(const ContactState& m, const NormalContactRule& rule, bool only_closed = false) {
  NormalContact c{};
  c.normal = normal_impulse(m, rule);
  c.closed = c.normal != 0.0;
  if (!c.closed && only_closed) return c;
  c.stop = m.mass * (m.velocity - m.velocity.dot(m.normal) * m.normal);
  c.stick = c.stop.norm();
  return c;
}

/// Response with the smaller one of the tangential impulse `slide` that the law allows while sliding [mass velocity],
/// and the one that makes the faces stick. `hold`: the faces stick in any case.
inline ContactResponse frictional_response(const ContactState& m, const NormalContact& c, double slide, bool hold) {
  ContactResponse out;
  const bool sticks = hold || c.stick <= slide;
  out.status = sticks ? ContactStatus::stick : ContactStatus::slip;
  out.impulse = c.normal * m.normal;
  if (sticks)
    out.impulse += c.stop;
  else if (slide > 0)
    out.impulse += slide / c.stick * c.stop;
  out.bond = m.bond;
  return out;
}

/// Table entry of the parameter displacement_only of NormalContactRule.
template <class Law>
Parameter<Law> displacement_only_parameter(double Law::*member) {
  return {"displacementOnly",
          member,
          Dimension::stress,
          any_value,
          "when faces count as closed. Positive: whenever they overlap; 0: only under compression; negative: up to a "
          "tension of this magnitude",
          0.0};
}
/// Table entry of the weakening distance of SlipWeakening.
template <class Law>
Parameter<Law> weakening_parameter(double Law::*member) {
  return {"weakening",
          member,
          Dimension::length,
          any_value,
          "sliding distance over which the friction falls from static to dynamic; 0: it falls at once whenever faces "
          "slide; negative: 0.01 cells",
          -1.0};
}
/// Table entry of the parameter compliance_stiffness of NormalContactRule.
template <class Law>
Parameter<Law> contact_stiffness_parameter(double Law::*member) {
  return {"Dc",
          member,
          Dimension::interface_stiffness,
          any_value,
          "normal stiffness of closed faces; negative: the faces do not penetrate each other",
          -1.0};
}

}  // namespace tribo
