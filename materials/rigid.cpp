// SPDX-License-Identifier: MIT
/// Rigid particles that prescribe grid velocities in chosen directions: moving kinematic constraints.

#include "materials/rigid_material.hpp"

namespace tribo {
namespace {

struct Rigid {
  static constexpr std::string_view name = "Rigid";
  static constexpr std::string_view summary = "Rigid particles with prescribed motion, as moving boundary conditions.";
  static constexpr int number = 11;
  static constexpr std::string_view needs = "a direction in SetDirection for each <SettingFunction>";
  static constexpr std::string_view example = R"(
<Material Type='Rigid' Name='piston'>
  <SetDirection>2</SetDirection>
  <SettingFunction>-0.5*min(t/0.1,1)</SettingFunction>
</Material>)";
  static std::array<Parameter<Rigid>, 0> parameters() { return {}; }
  // Read by the model: see Builder::rigid_functions.
  static std::vector<OwnProperty> own_properties() {
    return {{"SetDirection",
             "directions whose velocity is prescribed: sum of 1 (x), 2 (y) and 4 (z); default 0: none. 8: the body "
             "interacts by contact instead, as RigidContact"},
            {"SettingFunction",
             "velocity in the first direction set, a function of t, x, y, z (default: the velocity of the body)"},
            {"SettingFunction2", "the same in the second direction set"},
            {"SettingFunction3", "the same in the third direction set"},
            {"mirrored",
             "1 or -1: the first node beyond the face at the high or low end of the body has the mirrored velocity; "
             "needs one direction in SetDirection; default 0"}};
  }
  void prepare(const Statement&, Problems&) {}
};

}  // namespace

Catalogue<Material>::Item rigid() { return material_law<Rigid, RigidBody<Rigid>>({"RigidBC"}); }

}  // namespace tribo
