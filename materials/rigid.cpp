// SPDX-License-Identifier: MIT
/// Rigid particles that prescribe grid velocities in chosen directions: moving kinematic constraints.

#include "materials/rigid_material.hpp"

namespace tribo {
namespace {

struct Rigid {
  static constexpr std::string_view name = "Rigid";
  static constexpr std::string_view summary =
      "Rigid particles with a prescribed motion, which act as moving boundary conditions.";
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
             "directions in which the velocity is prescribed: sum of 1 (x), 2 (y) and 4 (z); 0 (default): none. 8: the "
             "body interacts by contact instead, as RigidContact"},
            {"SettingFunction",
             "velocity in the first of these directions, a function of t, x, y, z (default: the velocity of the body)"},
            {"SettingFunction2", "velocity in the second of these directions"},
            {"SettingFunction3", "velocity in the third of these directions"},
            {"mirrored",
             "1 or -1: the first node beyond the face of the body at its high (1) or low (-1) end has the mirrored "
             "velocity. SetDirection must then have a single direction (default 0: none)"}};
  }
  void prepare(const Statement&, Problems&) {}
};

}  // namespace

Catalogue<Material>::Item rigid() { return material_law<Rigid, RigidBody<Rigid>>({"RigidBC"}); }

}  // namespace tribo
