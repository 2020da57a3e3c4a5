// SPDX-License-Identifier: MIT
/// A curve of any shape for each mode, but one damage, so that both modes fail together. It grows when the tractions
/// reach the ellipse of the strengths that are left, (T_n/S_n(D))^2 + (T_t/S_t(D))^2 = 1, which is the condition of
/// cohesive_law.hpp on the displacements. After Nairn & Aimene (2021), Eng. Fract. Mech. 248:107704.

#include "contact/cohesive_properties.hpp"

namespace tribo {
namespace {

struct MixedModeTraction final : CohesiveProperties {
  static constexpr std::string_view name = "MixedModeTraction";
  static constexpr std::string_view summary =
      "Cohesive zone with a curve of any shape for each mode and a common damage variable.";
  static constexpr int number = 33;
  static constexpr std::string_view needs =
      "the properties of the curves modelI and modelII; for cubic curves, for example, these are two of sigmaI, JIc "
      "and delIc, and two of sigmaII, JIIc and delIIc";
  static constexpr std::string_view example = R"(
<Material Type='MixedModeTraction' Name='glue'>
  <modelI>12</modelI>
  <sigmaI>2e6</sigmaI>
  <JIc>100</JIc>
  <modelII>14</modelII>
  <sigmaII>3e6</sigmaII>
  <JIIc>200</JIIc>
</Material>)";

  static auto parameters() {
    using L = MixedModeTraction;
    using Rows = CohesiveRows<L>;
    using P = Parameter<L>;
    constexpr Range types{12, 34};
    return Rows::join(
        std::array{P{"modelI", &L::modelI, Dimension::none, types,
                     "shape of the curve in opening: 12 triangular, 14 cubic, 20 trilinear, 34 exponential", 12.0},
                   P{"modelII", &L::modelII, Dimension::none, types,
                     "shape of the curve in sliding, with the same numbers", 12.0}},
        Rows::peaks(), Rows::energies(), Rows::ends(), Rows::slopes(), Rows::places(), Rows::second_corners(),
        Rows::decays(), Rows::closed());
  }
  void prepare(const Statement& s, Problems& problems) {
    const double models[] = {modelI, modelII};
    for (std::size_t k = 0; k < 2; ++k) curves_[k] = curve_of(models[k], mode(k), {s, problems, k});
    one_damage_ = true;
    finish();
  }
  static SharedCurve curve_of(double model, const ModeProperties& given, const ModeProblems& problems) {
    if (model == 12) return triangular_from(given, problems);
    if (model == 14) return cubic_from(given, problems);
    if (model == 20) return trilinear_from(given, problems);
    if (model == 34) return exponential_from(given, problems);
    problems.add(problems.name("model") + " must be 12 (triangular), 14 (cubic), 20 (trilinear) or 34 (exponential)");
    return nullptr;
  }
};

}  // namespace

Catalogue<JointLaw>::Item mixed_mode_traction() {
  return catalogue_item<JointLaw, MixedModeTraction, MixedModeTraction>({});
}

}  // namespace tribo
