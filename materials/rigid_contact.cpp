// SPDX-License-Identifier: MIT
/// Rigid bodies with prescribed motion that interact with other materials through contact laws.

#include "materials/rigid_material.hpp"

namespace tribo {
namespace {

struct RigidContact {
  static constexpr std::string_view name = "RigidContact";
  static constexpr std::string_view summary =
      "Rigid body with a prescribed motion, which touches other materials by contact laws.";
  static constexpr int number = 35;
  static constexpr std::string_view example = R"(
<Material Type='RigidContact' Name='tool'>
  <SettingFunction>0.2</SettingFunction>
  <SettingFunction2>-0.1*sin(20*t)</SettingFunction2>
</Material>)";
  static std::array<Parameter<RigidContact>, 0> parameters() { return {}; }
  // Read by the model: see Builder::rigid_functions.
  static std::vector<OwnProperty> own_properties() {
    return {{"SettingFunction",
             "velocity along x, a function of t and of the present position x, y, z (default: the velocity of the "
             "body). A rotation about the origin with angular velocity w is -w*y along x and w*x along y"},
            {"SettingFunction2", "velocity along y, in the same way"},
            {"SettingFunction3", "velocity along z, in the same way"}};
  }
  void prepare(const Statement&, Problems&) {}
};

}  // namespace

Catalogue<Material>::Item rigid_contact() { return material_law<RigidContact, RigidBody<RigidContact>>(); }

}  // namespace tribo
