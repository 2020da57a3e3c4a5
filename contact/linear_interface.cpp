// SPDX-License-Identifier: MIT
/// Linear imperfect interface: tractions are proportional to the opening displacement d.
///
///   T_N = Dnt d_N for d_N > 0,  T_N = Dnc d_N for d_N < 0,  T_S = Dt d_S
///
/// N and S denote the normal and the tangential direction. A negative stiffness means perfect bonding in that
/// direction. Each direction takes one step of a relative motion against a spring, see interface.hpp. Hashin, J. Mech.
/// Phys. Solids 50 (2002) 2509-2537; in MPM: Nairn, CMES 92 (2013) 271-299.

#include "contact/contact_law.hpp"
#include "contact/interface.hpp"

namespace tribo {
namespace {

struct LinearInterface final : ContactLaw {
  static constexpr std::string_view name = "LinearInterface";
  static constexpr std::string_view summary = "Imperfect interface with stiffnesses; negative: perfect.";
  static constexpr int number = 62;

  double open = -1, closed = -1, tangential = -1;

  static auto parameters() {
    using L = LinearInterface;
    using P = Parameter<L>;
    constexpr auto D = Dimension::interface_stiffness;
    return std::array{P{"Dnt", &L::open, D, any_value, "normal stiffness while open", -1.0, false, "Dn"},
                      P{"Dnc", &L::closed, D, any_value, "normal stiffness while closed (default: Dnt)", {}, true},
                      P{"Dt", &L::tangential, D, any_value, "tangential stiffness", -1.0}};
  }
  void prepare(const Statement& statement, Problems&) {
    if (!statement.child("Dnc")) closed = open;
  }

  double stiffness() const override { return std::max({open, closed, tangential, 0.0}); }

  // Impulse of one direction and the energy stored at the end of the step.
  struct Spring {
    double impulse, stored;
  };

  static Spring spring(const ContactState& m, double stiffness, double d0, double v0, double v_free) {
    if (stiffness < 0) return {m.mass * v_free, 0.0};
    const double k = stiffness * m.area;
    const double J = interface_impulse(m.mass, k, d0, v0, v_free, m.dt);
    const double d = d0 + m.dt * (v_free - J / m.mass);
    return {J, 0.5 * k * d * d};
  }

  // If the step begins open, the stiffness of the open interface applies to the whole step; the same holds if it begins
  // closed. If the other one of the two states is perfectly bonded, the motion stops at zero opening.
  Spring normal(const ContactState& m) const {
    const double d0 = m.opening.dot(m.normal), v0 = m.start.dot(m.normal), v = m.velocity.dot(m.normal);
    if (closed < 0 && open >= 0) {
      const double d = std::max(d0, 0.0), stop = m.mass * (v + d / m.dt);
      const Spring free = spring(m, open, d, v0, v);
      return free.impulse < stop ? free : Spring{stop, 0.0};
    }
    if (open < 0 && closed >= 0) {
      const double d = std::min(d0, 0.0), stop = m.mass * (v + d / m.dt);
      const Spring free = spring(m, closed, d, v0, v);
      return free.impulse > stop ? free : Spring{stop, 0.0};
    }
    const bool opens = d0 > 0 || (d0 == 0 && v > 0);
    Spring s = spring(m, opens ? open : closed, d0, v0, v);
    const double d1 = d0 + m.dt * (v - s.impulse / m.mass);
    if (open >= 0) s.stored = 0.5 * (d1 > 0 ? open : closed) * m.area * d1 * d1;
    return s;
  }

  ContactResponse response(const ContactState& m) const override {
    const Spring n = normal(m);
    ContactResponse out{n.impulse * m.normal, ContactStatus::stick, m.bond, n.stored};
    const auto along = [&](const Vec3& x) { return Vec3(x - x.dot(m.normal) * m.normal); };
    const Vec3 d = along(m.opening), v0 = along(m.start), v = along(m.velocity);
    for (int i = 0; i < 3; ++i) {  // isotropic, so components along any axes can be used
      const Spring t = spring(m, tangential, d[i], v0[i], v[i]);
      out.impulse[i] += t.impulse, out.stored += t.stored;
    }
    return out;
  }
  bool is_interface() const override { return true; }
  bool uses_area() const override { return true; }
};

}  // namespace

Catalogue<ContactLaw>::Item linear_interface() { return contact_law<LinearInterface>(); }

}  // namespace tribo
