// SPDX-License-Identifier: MIT
/// Rigid particles that prescribe grid velocities in chosen directions: moving kinematic constraints.

#include "materials/rigid_material.hpp"

namespace tribo {
namespace {

struct Rigid {
  static constexpr std::string_view name = "Rigid";
  static constexpr std::string_view summary = "Rigid particles with prescribed motion, as moving boundary conditions.";
  static constexpr int number = 11;
  static std::array<Parameter<Rigid>, 0> parameters() { return {}; }
  void prepare(const Statement&, Problems&) {}
};

}  // namespace

Catalogue<Material>::Item rigid() { return material_law<Rigid, RigidBody<Rigid>>({"RigidBC"}); }

}  // namespace tribo
