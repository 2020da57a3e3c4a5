// SPDX-License-Identifier: MIT
/// Friction with cohesion, with bonds that break under shear and tension, and with a coefficient that depends on speed.
///
///   in contact      sliding at the shear traction S = Sa + (mu + k v) N,
///                   or with v_half at S = Sa + (mu(v) + k v) N,  mu(v) = (mu_s v_half + mu v)/(v_half + v)
///   not in contact  bonded faces hold while (S/Sa)^2 + (N/Na)^2 < 1; the bond of faces that separate is broken
///
/// N is the pressure in contact and the tension out of contact, S the shear traction, and v the sliding speed at the
/// end of the step, v = (S_stick - S) A dt/m. So each case is a scalar equation for S, which is solved in closed form.
/// Nairn, "Modeling imperfect interfaces in the material point method using multimaterial methods", CMES 92 (2013)
/// 271-299; speed dependence: Nairn, Bardenhagen & Smith, Comput. Part. Mech. 5 (2018) 285-296.

#include "contact/friction.hpp"

namespace tribo {
namespace {

struct AdhesiveFriction final : ContactLaw {
  static constexpr std::string_view name = "AdhesiveFriction";
  static constexpr std::string_view summary =
      "Coulomb friction with cohesion and adhesion of a bond, and with a coefficient that depends on the sliding "
      "speed.";
  static constexpr int number = 63;
  static constexpr std::string_view example = R"(
<Material Type='AdhesiveFriction' Name='glued'>
  <coeff>0.3</coeff>
  <Sa>2e5</Sa>
  <Na>1e5</Na>
</Material>)";

  double coefficient = 0, static_coefficient = -1, weakening = -1, speed_coefficient = 0, half_speed = 0;
  double shear_strength = 0, normal_strength = 0, rebond = 0;
  double displacement_only = 0, contact_stiffness = -1;

  static auto parameters() {
    using L = AdhesiveFriction;
    using P = Parameter<L>;
    return std::array{
        P{"coeff", &L::coefficient, Dimension::none, not_negative, "friction coefficient while sliding", 0.0},
        P{"coeffStatic", &L::static_coefficient, Dimension::none, any_value,
          "static friction coefficient, at which sliding begins; 0 or negative: it equals coeff", -1.0},
        P{"kmu", &L::speed_coefficient, Dimension::per_velocity, any_value,
          "increase of the friction coefficient per sliding speed", 0.0},
        P{"vhalf", &L::half_speed, Dimension::velocity, not_negative,
          "sliding speed at which the friction coefficient is half way from static to dynamic; 0: it falls to the "
          "dynamic one at once",
          0.0},
        P{"Sa", &L::shear_strength, Dimension::stress, not_negative,
          "shear strength of the bond, which acts as a cohesion in contact; faces are bonded only if Na is positive, "
          "too",
          0.0},
        P{"Na", &L::normal_strength, Dimension::stress, not_negative,
          "tensile strength of the bond; without effect if Sa is 0", 0.0},
        P{"rebond", &L::rebond, Dimension::none, within(0, 1), "1: broken bonds form again in contact", 0.0},
        weakening_parameter(&L::weakening),
        displacement_only_parameter(&L::displacement_only),
        contact_stiffness_parameter(&L::contact_stiffness)};
  }

  void prepare(const Statement& statement, Problems& problems) {
    if (static_coefficient > 0 && static_coefficient <= coefficient)
      problems.add(statement.child("coeffStatic")->origin,
                   "<coeffStatic> must exceed <coeff>: faces begin to slide at "
                   "the first and go on sliding with the second");
    if (half_speed > 0 && !(static_coefficient > 0))
      problems.add(statement.child("vhalf")->origin, "<vhalf> needs <coeffStatic>, the friction at rest");
    if (normal_strength > 0 && !(shear_strength > 0))
      problems.warn(statement.child("Na")->origin, "<Na> has no effect without <Sa>: a bond needs both strengths");
    if (shear_strength > 0 && !(normal_strength > 0))
      problems.warn(statement.child("Sa")->origin,
                    "without <Na> there is no bond: <Sa> is the cohesion of faces that are pressed together");
  }

  // The tangential impulse S A dt of sliding faces for the compressive impulse N, or a value above `stick` if they
  // stick.
  double slide(const ContactState& m, double stick, double N, double mu) const {
    const double cohesion = shear_strength * m.area * m.dt;
    const double k = speed_coefficient / m.mass;
    if (half_speed > 0) {
      // Root of (s - S + kappa)(S - C - mu N - k N (s - S)) = kappa N (mu_s - mu), where kappa = v_half m, s = stick,
      // and C is the cohesion; all as impulses.
      const double kappa = half_speed * m.mass, q = 1 + k * N;
      const double a0 = (cohesion + coefficient * N + k * N * stick) / q, D = stick + kappa;
      const double under = 0.25 * (D - a0) * (D - a0) - kappa * N * (static_coefficient - coefficient) / q;
      return under < 0 ? 2 * stick + 1 : 0.5 * (D + a0) - std::sqrt(under);
    }
    const double denominator = 1 + k * N;
    if (denominator <= 0)
      return 2 * stick +
             1;  // friction decreases faster than the sliding speed rises, so stable sliding is not possible
    return (cohesion + (mu + k * stick) * N) / denominator;
  }

  ContactResponse response(const ContactState& m) const override {
    const NormalContact c = resolve_contact(m, {displacement_only, contact_stiffness});
    const bool adheres = shear_strength > 0 && normal_strength > 0;
    if (c.closed) {
      const double N = c.pressure();
      const SlipWeakening friction{static_coefficient, coefficient, weakening};
      const double at_rest = half_speed > 0 ? static_coefficient : friction.at_rest(m);
      const bool holds = c.stick <= shear_strength * m.area * m.dt + at_rest * N;
      ContactResponse out = frictional_response(m, c, slide(m, c.stick, N, friction.sliding(m)), holds);
      if (adheres && (m.bond == Bond::none || rebond > 0)) out.bond = Bond::whole;
      return out;
    }
    if (!adheres || m.bond != Bond::whole) return {Vec3::Zero(), ContactStatus::open, m.bond};
    const double pull = std::max(0.0, m.mass * m.velocity.dot(m.normal));
    const double strength = m.area * m.dt;
    const double load =
        std::pow(c.stick / (shear_strength * strength), 2) + std::pow(pull / (normal_strength * strength), 2);
    if (!(load < 1)) return {Vec3::Zero(), ContactStatus::open, Bond::broken};
    return {m.mass * m.velocity, ContactStatus::stick, Bond::whole};
  }
  bool needs_closed_faces() const override { return !(shear_strength > 0 && normal_strength > 0); }
  bool has_memory() const override {
    return (half_speed == 0 && SlipWeakening{static_coefficient, coefficient, weakening}.has_memory()) ||
           (shear_strength > 0 && normal_strength > 0);
  }
  bool uses_area() const override { return true; }
};

}  // namespace

Catalogue<ContactLaw>::Item adhesive_friction() { return contact_law<AdhesiveFriction>(); }

}  // namespace tribo
