// SPDX-License-Identifier: MIT
/// Traction with two corners, in each mode: for example a brittle bond with a tail of bridging fibres.

#include "contact/cohesive_properties.hpp"

namespace tribo {
namespace {

struct TrilinearTraction final : CohesiveProperties {
  static constexpr std::string_view name = "TrilinearTraction";
  static constexpr std::string_view summary = "Cohesive zone: traction in three straight lines between two corners.";
  static constexpr int number = 20;

  static auto parameters() {
    using Rows = CohesiveRows<TrilinearTraction>;
    return Rows::join(Rows::peaks(), Rows::energies(), Rows::ends(), Rows::slopes(), Rows::places(),
                      Rows::second_corners(), Rows::mixture(), Rows::closed());
  }
  void prepare(const Statement& s, Problems& problems) { make_curves(s, problems, trilinear_from); }
};

}  // namespace

Catalogue<JointLaw>::Item trilinear_traction() {
  return catalogue_item<JointLaw, TrilinearTraction, TrilinearTraction>({});
}

}  // namespace tribo
