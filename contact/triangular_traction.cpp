// SPDX-License-Identifier: MIT
/// Traction that grows linearly up to a peak and then falls linearly to zero, in each mode.

#include "contact/cohesive_properties.hpp"

namespace tribo {
namespace {

struct TriangularTraction final : CohesiveProperties {
  static constexpr std::string_view name = "TriangularTraction";
  static constexpr std::string_view summary =
      "Cohesive zone whose traction rises to a peak and falls to zero in straight lines.";
  static constexpr int number = 12;
  static constexpr std::string_view needs =
      "for opening, two of sigmaI, JIc and delIc, or one of them with kIe and delpkI; for sliding, two of sigmaII, "
      "JIIc and delIIc, or one of them with kIIe and delpkII";
  static constexpr std::string_view example = R"(
<Material Type='TriangularTraction' Name='glue'>
  <sigmaI>2e6</sigmaI>
  <JIc>100</JIc>
  <sigmaII>3e6</sigmaII>
  <JIIc>200</JIIc>
</Material>)";

  static auto parameters() {
    using Rows = CohesiveRows<TriangularTraction>;
    return Rows::join(Rows::peaks(), Rows::energies(), Rows::ends(), Rows::slopes(), Rows::places(), Rows::mixture(),
                      Rows::closed());
  }
  void prepare(const Statement& s, Problems& problems) { make_curves(s, problems, triangular_from); }
};

}  // namespace

Catalogue<JointLaw>::Item triangular_traction() {
  return catalogue_item<JointLaw, TriangularTraction, TriangularTraction>({});
}

}  // namespace tribo
