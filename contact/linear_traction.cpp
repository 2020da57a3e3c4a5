// SPDX-License-Identifier: MIT
/// Springs between the faces, which never fail.

#include "contact/cohesive_properties.hpp"

namespace tribo {
namespace {

struct LinearTraction final : CohesiveProperties {
  static constexpr std::string_view name = "LinearTraction";
  static constexpr std::string_view summary =
      "Traction that is proportional to the displacement jump of the faces, without failure.";
  static constexpr int number = 13;
  static constexpr std::string_view example = R"(
<Material Type='LinearTraction' Name='glue'>
  <kIe>1e10</kIe>
  <kIIe>5e9</kIIe>
</Material>)";

  static auto parameters() {
    using Rows = CohesiveRows<LinearTraction>;
    return Rows::join(Rows::slopes(), Rows::closed());
  }
  void prepare(const Statement&, Problems&) {
    curves_[0] = linear_curve(std::max(kIe, 0.0)), curves_[1] = linear_curve(std::max(kIIe, 0.0));
    finish();
  }
};

}  // namespace

Catalogue<JointLaw>::Item linear_traction() { return catalogue_item<JointLaw, LinearTraction, LinearTraction>({}); }

}  // namespace tribo
