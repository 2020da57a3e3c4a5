// SPDX-License-Identifier: MIT
/// Friction that decreases with the sliding speed from a static to a dynamic coefficient, with a viscous share.
///
///   S <= mu_s N                              faces that stick
///   S  = mu(v) N                             faces that slide with the speed v at the end of the step
///   mu(v) = mu_d + (mu_s - mu_d) exp(-v/v_s) + k v
///
/// S is the shear traction, N the pressure, and v_s the Stribeck speed. The decrease is Tustin's exponential; the
/// viscous term makes friction increase again at high speed, as in a lubricated contact. Tustin, J. Inst. Electr. Eng.
/// 94 (1947) 143-151; Armstrong-Helouvry, Dupont & Canudas de Wit, Automatica 30 (1994) 1083-1138.
///
/// With v = (J_stick - J)/m, J = S A dt, the speed is the root of
///
///   f(v) = m v + mu(v) N A dt - J_stick = 0.
///
/// f is convex, f(0) < 0 for faces that do not stick, and f >= 0 at v = J_stick/m. There is thus exactly one positive
/// root, and Newton's method that starts from J_stick/m decreases to it monotonically. J lies between 0 and J_stick, so
/// no energy is created. If N A dt (mu_s - mu_d)/v_s > m, friction decreases faster with speed than the inertia of the
/// nodes resists within one step, and the speed jumps from zero to the root at the onset of sliding; with shorter steps
/// the same acceleration takes several steps.

#include "contact/friction.hpp"

namespace tribo {
namespace {

struct StribeckFriction final : ContactLaw {
  static constexpr std::string_view name = "StribeckFriction";
  static constexpr std::string_view summary =
      "Friction that decreases exponentially with the sliding speed and has a viscous part.";
  static constexpr int number = 0;
  static constexpr std::string_view example = R"(
<Material Type='StribeckFriction' Name='lubricated'>
  <coeff>0.1</coeff>
  <coeffStatic>0.25</coeffStatic>
  <vs>0.05</vs>
  <kmu>0.01</kmu>
</Material>)";

  double coefficient = 0, static_coefficient = 0, stribeck_speed = 0, viscous_coefficient = 0;
  double displacement_only = 0, contact_stiffness = -1;

  static auto parameters() {
    using L = StribeckFriction;
    using P = Parameter<L>;
    return std::array{P{"coeff", &L::coefficient, Dimension::none, not_negative, "dynamic friction coefficient mu_d"},
                      P{"coeffStatic", &L::static_coefficient, Dimension::none, not_negative,
                        "static friction coefficient mu_s, not less than coeff"},
                      P{"vs", &L::stribeck_speed, Dimension::velocity, positive,
                        "Stribeck speed, at which the excess of static over dynamic friction has decreased to 1/e"},
                      P{"kmu", &L::viscous_coefficient, Dimension::per_velocity, not_negative,
                        "increase of the friction coefficient per sliding speed", 0.0},
                      displacement_only_parameter(&L::displacement_only),
                      contact_stiffness_parameter(&L::contact_stiffness)};
  }

  void prepare(const Statement& statement, Problems& problems) {
    const Statement* given = statement.child("coeffStatic");
    if (given && static_coefficient < coefficient)
      problems.add(given->origin, "<coeffStatic> must not be less than <coeff>: friction decreases with speed");
  }

  /// Sliding speed [velocity] at the end of the step for the reduced mass `m`, the compressive impulse `N` and the
  /// impulse `stick` that stops the sliding, stick > mu_s N [all impulses in mass velocity].
  double sliding_speed(double m, double N, double stick) const {
    double v = stick / m;
    for (;;) {
      const double excess = (static_coefficient - coefficient) * std::exp(-v / stribeck_speed);
      const double f = m * v + N * (coefficient + excess + viscous_coefficient * v) - stick;
      const double slope = m + N * (viscous_coefficient - excess / stribeck_speed);
      const double next = v - f / slope;
      // The iterates decrease until rounding stops them; the comparison is also false for a vanishing slope.
      if (!(slope > 0 && next < v && next > 0)) return v;
      v = next;
    }
  }

  ContactResponse response(const ContactState& m) const override {
    const NormalContact c = resolve_contact(m, {displacement_only, contact_stiffness});
    if (!c.closed) return {Vec3::Zero(), ContactStatus::open, m.bond};
    const double N = c.pressure();
    const bool sticks = c.stick <= static_coefficient * N;
    const double slide = sticks ? c.stick : c.stick - m.mass * sliding_speed(m.mass, N, c.stick);
    return frictional_response(m, c, slide, sticks);
  }
  bool needs_closed_faces() const override { return true; }
  bool uses_area() const override { return contact_stiffness >= 0 || displacement_only < 0; }
};

}  // namespace

Catalogue<ContactLaw>::Item stribeck_friction() { return contact_law<StribeckFriction>(); }

}  // namespace tribo
