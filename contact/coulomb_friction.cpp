// SPDX-License-Identifier: MIT
/// Coulomb friction.
///
///   S <= mu N
///
/// S is the shear traction, which opposes the relative velocity at the end of the step, and N the pressure. With a
/// static coefficient mu_s, faces that stick begin to slide at S = mu_s N. The coefficient then decreases to the
/// dynamic one within the weakening distance, see SlipWeakening, and is mu_s again once they stick. Without a weakening
/// distance it drops at once: S = mu N in every step in which mu_s N does not suffice to make the faces stick. With a
/// negative coefficient faces in contact do not slide, but separate freely.

#include "contact/friction.hpp"

namespace tribo {
namespace {

struct CoulombFriction final : ContactLaw {
  static constexpr std::string_view name = "CoulombFriction";
  static constexpr std::string_view summary = "Coulomb friction with a static and a dynamic coefficient.";
  static constexpr int number = 61;
  static constexpr std::string_view example = R"(
<Material Type='CoulombFriction' Name='friction'>
  <coeff>0.3</coeff>
  <coeffStatic>0.4</coeffStatic>
</Material>)";

  double coefficient = 0, static_coefficient = -1, weakening = -1;
  double displacement_only = 0, contact_stiffness = -1;

  static auto parameters() {
    using L = CoulombFriction;
    using P = Parameter<L>;
    return std::array{
        P{"coeff", &L::coefficient, Dimension::none, any_value,
          "friction coefficient, during sliding the dynamic one; negative: the faces cannot slide", 0.0},
        P{"coeffStatic", &L::static_coefficient, Dimension::none, any_value,
          "static friction coefficient, at which sliding begins; it must exceed coeff. 0 or negative: it equals coeff",
          -1.0},
        weakening_parameter(&L::weakening), displacement_only_parameter(&L::displacement_only),
        contact_stiffness_parameter(&L::contact_stiffness)};
  }

  void prepare(const Statement& statement, Problems& problems) {
    if (static_coefficient > 0 && static_coefficient <= coefficient)
      problems.add(statement.child("coeffStatic")->origin,
                   "<coeffStatic> must exceed <coeff>: faces begin to slide at "
                   "the first and go on sliding with the second");
    if (static_coefficient > 0 && coefficient < 0)
      problems.add(statement.child("coeffStatic")->origin,
                   "<coeffStatic> has no meaning with a negative <coeff>, which forbids sliding");
  }

  ContactResponse response(const ContactState& m) const override {
    const NormalContact c = resolve_contact(m, {displacement_only, contact_stiffness}, true);
    if (!c.closed) return {Vec3::Zero(), ContactStatus::open, m.bond};
    const SlipWeakening friction{static_coefficient, coefficient, weakening};
    const bool holds = coefficient < 0 || c.stick <= friction.at_rest(m) * c.pressure();
    return frictional_response(m, c, friction.sliding(m) * c.pressure(), holds);
  }
  bool needs_closed_faces() const override { return true; }
  bool has_memory() const override { return SlipWeakening{static_coefficient, coefficient, weakening}.has_memory(); }
  bool uses_area() const override { return contact_stiffness >= 0 || displacement_only < 0; }
};

}  // namespace

Catalogue<ContactLaw>::Item coulomb_friction() { return contact_law<CoulombFriction>(); }

}  // namespace tribo
