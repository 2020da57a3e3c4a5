// SPDX-License-Identifier: MIT
/// A normal traction on the faces of a crack that does not depend on their displacement, such as the pressure of a
/// fluid (negative), as a function of time.

#include "base/expression.hpp"
#include "contact/joint_parts.hpp"

#include <algorithm>
#include <cmath>

namespace tribo {
namespace {

struct PressureTraction final : JointLaw {
  static constexpr std::string_view name = "PressureTraction";
  static constexpr std::string_view summary = "Prescribed normal traction on the faces of a crack, such as a pressure.";
  static constexpr int number = 26;
  static constexpr std::string_view example = R"(
<Material Type='PressureTraction' Name='fluid'>
  <function>-1e6*min(t/1e-3,1)</function>
</Material>)";

  double stress = 0, closed = 0;
  Expression function;
  double function_unit = 0;  ///< stress of a value 1 of `function`; 0: there is none
  double function_time = 1;  ///< time that is 1 in `function`

  static auto parameters() {
    using L = PressureTraction;
    using P = Parameter<L>;
    return std::array{P{"stress", &L::stress, Dimension::stress, any_value,
                        "normal traction on the faces; negative: a pressure, which opens the crack", 0.0},
                      P{"kClosed", &L::closed, Dimension::interface_stiffness, not_negative,
                        "normal stiffness of faces that are pressed together", 0.0}};
  }
  static std::vector<OwnProperty> own_properties() {
    return {{"function", "normal traction as a function of the time t [stress], instead of stress"}};
  }
  void prepare(const Statement& s, const Units& units, Problems& problems) {
    const Statement* f = s.child("function");
    if (!f) return;
    if (s.child("stress")) problems.add(f->origin, "<function> and <stress> exclude each other; give one of them");
    try {
      function = Expression(f->text, f->text_origin, "<function>");
      function_unit = units.factor(Dimension::stress), function_time = units.alternative_time();
    } catch (const InputError& error) {
      problems.add(error);
    }
  }

  Joint start(const JointSite& site) const override {
    Joint j;
    set_area(j, site, 0.0);
    j.gap = j.opening = site.gap, j.kn = closed, j.state = 1;
    return j;
  }
  double traction(double time) const {
    if (function_unit == 0) return stress;
    Variables at;
    at.t = time / function_time;
    return function_unit * function(at);
  }
  void update(std::span<Joint> joints, std::span<const JointIncrement> increments,
              std::vector<JointEvent>&) const override {
    for (std::size_t k = 0; k < joints.size(); ++k) {
      Joint& j = joints[k];
      const Joint before = j;
      const JointIncrement& d = increments[k];
      j.opening += d.normal, j.shear += d.shear, j.gap = d.gap;
      const double pressed = closed * std::min(j.opening, 0.0);
      j.Fn = j.area * (traction(d.time) + pressed);
      j.strain = 0.5 * j.area * pressed * std::min(j.opening, 0.0);
      add_work(j, before, d);
    }
  }
  std::string state_text(const Joint&) const override { return "pressed"; }
  std::vector<std::string_view> own_names() const override { return {}; }
  std::vector<double> own_values(const Joint&) const override { return {}; }
  double stiffness() const override { return closed; }
};

}  // namespace

Catalogue<JointLaw>::Item pressure_traction() {
  return catalogue_item<JointLaw, PressureTraction, PressureTraction>({});
}

}  // namespace tribo
