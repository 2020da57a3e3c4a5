// SPDX-License-Identifier: MIT
/// No contact law: at common nodes the two materials have one velocity, as with a single velocity field.

#include "contact/contact_law.hpp"

namespace tribo {
namespace {

struct IgnoreContact final : ContactLaw {
  static constexpr std::string_view name = "IgnoreContact";
  static constexpr std::string_view summary =
      "No contact: where materials meet they move with one velocity, and the faces of a crack ignore each other.";
  static constexpr int number = 60;
  static constexpr std::string_view example = R"(
<Material Type='IgnoreContact' Name='none'/>)";
  static std::array<Parameter<IgnoreContact>, 0> parameters() { return {}; }
  void prepare(const Statement&, Problems&) {}

  ContactResponse response(const ContactState& m) const override {
    ContactResponse out;
    out.impulse = m.mass * m.velocity;
    out.status = ContactStatus::stick;
    out.bond = m.bond;
    return out;
  }
  bool uses_face() const override { return false; }
};

}  // namespace

Catalogue<ContactLaw>::Item ignore_contact() { return contact_law<IgnoreContact>(); }

}  // namespace tribo
