// SPDX-License-Identifier: MIT
/// A liquid at a wall with Navier's slip condition: the shear traction is proportional to viscosity and slip speed.
///
///   S = k eta(k v) v
///
/// The slip length is 1/k: k = 0 gives free slip, and k -> infinity no slip. v is the slip speed at the end of the
/// step, and eta the viscosity at the shear rate k v. For a constant viscosity S = S_stick c/(c + m) with c = k eta A
/// dt.

#include "contact/friction.hpp"

namespace tribo {
namespace {

struct LiquidContact final : ContactLaw {
  static constexpr std::string_view name = "LiquidContact";
  static constexpr std::string_view summary = "Viscous drag between a liquid and a wall with a slip length.";
  static constexpr int number = 64;
  static constexpr std::string_view example = R"(
<Material Type='LiquidContact' Name='drag'>
  <LiquidPhase>1</LiquidPhase>
  <coeff>1000</coeff>
</Material>)";

  double coefficient = 2, liquid_phase = 0;
  double displacement_only = 0, contact_stiffness = -1;
  Viscosity viscosity;

  static auto parameters() {
    using L = LiquidContact;
    using P = Parameter<L>;
    return std::array{
        P{"coeff", &L::coefficient, Dimension::per_length, not_negative, "inverse k of the slip length", 2.0},
        P{"LiquidPhase", &L::liquid_phase, Dimension::none, positive, "number of the material that is the liquid"},
        displacement_only_parameter(&L::displacement_only), contact_stiffness_parameter(&L::contact_stiffness)};
  }
  void prepare(const Statement&, Problems&) {}

  // The ratio x of the slip speed to the tangential speed v without contact is the root of x (1 + F eta(k v x)) = 1
  // with F = k A dt / m. It is found in the bracket [0, 1] by the Illinois algorithm. The left side is monotonic if the
  // shear stress grows with the shear rate.
  double slip_share(const ContactState& m, double speed) const {
    const double F = coefficient * m.area * m.dt / m.mass;
    const auto residual = [&](double x) { return x * (1 + F * viscosity(coefficient * speed * x)) - 1; };
    double low = 0, high = 1, f_low = -1, f_high = residual(1.0);
    if (!(f_high > 0)) return 1.0;
    for (int k = 0, side = 0; k < 100 && high - low > 1e-15 * high; ++k) {
      const double x = (low * f_high - high * f_low) / (f_high - f_low), f = residual(x);
      if (f == 0) return x;
      if (f > 0) {
        high = x, f_high = f;
        if (side == 1) f_low *= 0.5;
        side = 1;
      } else {
        low = x, f_low = f;
        if (side == -1) f_high *= 0.5;
        side = -1;
      }
      if (std::abs(f) < 1e-15) return x;
    }
    return 0.5 * (low + high);
  }

  ContactResponse response(const ContactState& m) const override {
    const NormalContact c = resolve_contact(m, {displacement_only, contact_stiffness});
    if (!c.closed) return {Vec3::Zero(), ContactStatus::open, m.bond};
    const double slip = slip_share(m, c.stick / m.mass);
    return {c.normal * m.normal + (1 - slip) * c.stop, ContactStatus::slip, m.bond};
  }
  bool uses_area() const override { return true; }
  int liquid() const override { return static_cast<int>(liquid_phase); }
  void set_viscosity(const Viscosity& v) override { viscosity = v; }
};

}  // namespace

Catalogue<ContactLaw>::Item liquid_contact() { return contact_law<LiquidContact>(); }

}  // namespace tribo
