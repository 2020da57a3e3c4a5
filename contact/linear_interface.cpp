// SPDX-License-Identifier: MIT
/// Linear imperfect interface: tractions are proportional to the displacement jump d.
///
///   T_N = Dnt d_N for d_N > 0,  T_N = Dnc d_N for d_N < 0,  T_S = Dt d_S
///
/// N and S denote the normal and the tangential direction. A negative stiffness means perfect bonding in that
/// direction. Hashin, J. Mech. Phys. Solids 50 (2002) 2509-2537; in MPM: Nairn, CMES 92 (2013) 271-299.

#include "contact/interface.hpp"

namespace tribo {
namespace {

struct LinearInterface final : InterfaceLaw {
  static constexpr std::string_view name = "LinearInterface";
  static constexpr std::string_view summary =
      "Imperfect interface with a normal and a tangential stiffness; a negative stiffness means a perfect interface.";
  static constexpr int number = 62;
  static constexpr std::string_view example = R"(
<Material Type='LinearInterface' Name='interface'>
  <Dnt>1e9</Dnt>
  <Dnc>1e10</Dnc>
  <Dt>5e8</Dt>
</Material>)";

  double open = -1, closed = -1, tangential = -1;

  static auto parameters() {
    using L = LinearInterface;
    using P = Parameter<L>;
    constexpr auto D = Dimension::interface_stiffness;
    return std::array{
        P{"Dnt", &L::open, D, any_value, "normal stiffness of the open interface; negative: it cannot open", -1.0,
          false, "Dn"},
        P{"Dnc", &L::closed, D, any_value, "normal stiffness of the closed interface (default: Dnt)", {}, true},
        P{"Dt", &L::tangential, D, any_value, "tangential stiffness; negative: it cannot slip", -1.0}};
  }
  void prepare(const Statement& statement, Problems&) {
    if (!statement.child("Dnc")) closed = open;
  }

  double stiffness() const override { return std::max({open, closed, tangential, 0.0}); }
  bool bonds_normal() const override { return open < 0 && closed < 0; }
  bool bonds_tangential() const override { return tangential < 0; }
  std::shared_ptr<const InterfaceLaw> limited(double largest) const override {
    auto law = std::make_shared<LinearInterface>(*this);
    limit_normal(law->open, law->closed, largest);
    if (tangential > largest) law->tangential = -1;
    return law;
  }
  Traction traction(double normal, double shear) const override {
    Traction t;
    t.normal = std::max(normal > 0 ? open : closed, 0.0) * normal, t.tangential = std::max(tangential, 0.0) * shear;
    t.energy = 0.5 * (t.normal * normal + t.tangential * shear);
    return t;
  }
};

}  // namespace

Catalogue<ContactLaw>::Item linear_interface() { return contact_law<LinearInterface>(); }

}  // namespace tribo
