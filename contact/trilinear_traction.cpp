// SPDX-License-Identifier: MIT
/// Traction with two corners, in each mode: for example a brittle bond with a tail of bridging fibres.

#include "contact/cohesive_properties.hpp"

namespace tribo {
namespace {

struct TrilinearTraction final : CohesiveProperties {
  static constexpr std::string_view name = "TrilinearTraction";
  static constexpr std::string_view summary =
      "Cohesive zone whose traction follows three straight lines with two corners between them.";
  static constexpr int number = 20;
  static constexpr std::string_view needs =
      "for opening, five of sigmaI, delpkI, sigmaI2, delpkI2, delIc, JIc and kIe; if kIe is among them, exactly one of "
      "sigmaI and delpkI. For sliding the same of sigmaII, delpkII, sigmaII2, delpkII2, delIIc, JIIc and kIIe";
  static constexpr std::string_view example = R"(
<Material Type='TrilinearTraction' Name='fibres'>
  <sigmaI>2e6</sigmaI>
  <delpkI>0.02</delpkI>
  <sigmaI2>0.5e6</sigmaI2>
  <delpkI2>0.2</delpkI2>
  <delIc>1e-3</delIc>
  <sigmaII>2e6</sigmaII>
  <delpkII>0.02</delpkII>
  <sigmaII2>0.5e6</sigmaII2>
  <delpkII2>0.2</delpkII2>
  <delIIc>1e-3</delIIc>
</Material>)";

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
