// SPDX-License-Identifier: MIT
/// One curve for the effective displacement d = sqrt(d_n^2 + d_t^2) and the effective traction
/// T = sqrt(T_n^2 + T_t^2), with tractions along the displacement: T_n = (1 - D) k d_n, T_t = (1 - D) k d_t.

#include "contact/cohesive_properties.hpp"

namespace tribo {
namespace {

struct CoupledTraction final : CohesiveProperties {
  static constexpr std::string_view name = "CoupledTraction";
  static constexpr std::string_view summary =
      "Cohesive zone with one triangular curve for the effective displacement, which combines opening and sliding.";
  static constexpr int number = 23;
  static constexpr std::string_view needs = "two of sigmaI, JIc and delIc, or one of them with kIe and delpkI";
  static constexpr std::string_view example = R"(
<Material Type='CoupledTraction' Name='glue'>
  <sigmaI>2e6</sigmaI>
  <JIc>100</JIc>
  <delpkI>0.1</delpkI>
</Material>)";

  static auto parameters() {
    using L = CoupledTraction;
    using Rows = CohesiveRows<L>;
    using D = Dimension;
    return Rows::join(
        std::array{
            Rows::row("sigmaI", &L::sigmaI, D::stress, "largest effective traction"),
            Rows::row("JIc", &L::JIc, D::energy_release,
                      "toughness, which is the area under the curve of effective traction over effective displacement"),
            Rows::row("delIc", &L::delIc, D::length, "effective displacement at which the traction has vanished"),
            Rows::row("kIe", &L::kIe, D::interface_stiffness, "initial slope of the effective traction"),
            Rows::row("delpkI", &L::delpkI, D::none, "effective displacement at the peak divided by delIc",
                      {0, 1, true, false}),
            Rows::row("alphaI", &L::alphaI, D::none,
                      "if given, the traction decays exponentially after the peak with this exponent (default: linear "
                      "decay)")},
        Rows::closed());
  }
  void prepare(const Statement& s, Problems& problems) {
    const ModeProblems mine(s, problems, 0);
    curves_[0] = curves_[1] = alphaI > 0 ? exponential_from(mode(0), mine) : triangular_from(mode(0), mine);
    one_damage_ = true;
    finish();
  }
};

}  // namespace

Catalogue<JointLaw>::Item coupled_traction() { return catalogue_item<JointLaw, CoupledTraction, CoupledTraction>({}); }

}  // namespace tribo
