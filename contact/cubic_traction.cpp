// SPDX-License-Identifier: MIT
/// T = 27/4 sigma x (1 - x)^2 with x = d/delta_c in each mode (Needleman 1987, J. Appl. Mech. 54:525): the peak is at a
/// third of the critical displacement, at which the slope is zero.

#include "contact/cohesive_properties.hpp"

namespace tribo {
namespace {

struct CubicTraction final : CohesiveProperties {
  static constexpr std::string_view name = "CubicTraction";
  static constexpr std::string_view summary =
      "Cohesive zone whose traction is a smooth cubic function of the displacement jump.";
  static constexpr int number = 14;
  static constexpr std::string_view needs =
      "for opening two of sigmaI, JIc and delIc, for sliding two of sigmaII, JIIc and delIIc";
  static constexpr std::string_view example = R"(
<Material Type='CubicTraction' Name='glue'>
  <sigmaI>2e6</sigmaI>
  <JIc>100</JIc>
  <sigmaII>3e6</sigmaII>
  <JIIc>200</JIIc>
</Material>)";

  static auto parameters() {
    using Rows = CohesiveRows<CubicTraction>;
    return Rows::join(Rows::peaks(), Rows::energies(), Rows::ends(), Rows::mixture(), Rows::closed());
  }
  void prepare(const Statement& s, Problems& problems) { make_curves(s, problems, cubic_from); }
};

}  // namespace

Catalogue<JointLaw>::Item cubic_traction() { return catalogue_item<JointLaw, CubicTraction, CubicTraction>({}); }

}  // namespace tribo
