// SPDX-License-Identifier: MIT
/// Properties of traction laws: from those that are given, the curves follow.
#pragma once

#include "contact/cohesive_law.hpp"
#include "contact/traction_curve.hpp"

#include <optional>

namespace tribo {

/// What is given of the curve of one mode; negative: not given.
struct ModeProperties {
  double peak = -1, toughness = -1, critical = -1, slope = -1;
  double first = -1;               ///< displacement of the (first) peak divided by the critical one
  double peak2 = -1, second = -1;  ///< traction and relative displacement of the second corner
  double alpha = -1;               ///< decay of an exponential curve
};

/// Reports what is missing or contradicts itself in the properties of a mode.
class ModeProblems {
 public:
  /// `mode`: 0 opening, 1 sliding.
  ModeProblems(const Statement& material, Problems& problems, std::size_t mode)
      : material_(material), problems_(problems), mode_(mode) {}
  void add(const std::string& message) const;
  /// The name of a property of this mode: `sigma` gives <sigmaI> or <sigmaII>.
  std::string name(const std::string& stem) const;

 private:
  const Statement& material_;
  Problems& problems_;
  std::size_t mode_;
};

/// The curves of the laws; null if there were problems.
SharedCurve triangular_from(const ModeProperties& given, const ModeProblems& problems);
SharedCurve exponential_from(const ModeProperties& given, const ModeProblems& problems);
SharedCurve cubic_from(const ModeProperties& given, const ModeProblems& problems);
SharedCurve trilinear_from(const ModeProperties& given, const ModeProblems& problems);

/// Common part of the traction laws with curves: their properties, as members that a table of parameters can name.
struct CohesiveProperties : CohesiveLaw {
  double sigmaI = -1, sigmaII = -1, JIc = -1, JIIc = -1, delIc = -1, delIIc = -1, kIe = -1, kIIe = -1;
  double delpkI = -1, delpkII = -1, sigmaI2 = -1, sigmaII2 = -1, delpkI2 = -1, delpkII2 = -1, alphaI = -1, alphaII = -1;
  double nmix = 1, kClosed = -1, modelI = 12, modelII = 12;

  ModeProperties mode(std::size_t number) const {
    if (number == 0) return {sigmaI, JIc, delIc, kIe, delpkI, sigmaI2, delpkI2, alphaI};
    return {sigmaII, JIIc, delIIc, kIIe, delpkII, sigmaII2, delpkII2, alphaII};
  }
  /// Makes the curves of both modes with `make` and sets the remaining properties.
  void make_curves(const Statement& s, Problems& problems,
                   SharedCurve (*make)(const ModeProperties&, const ModeProblems&)) {
    for (std::size_t k = 0; k < 2; ++k) curves_[k] = make(mode(k), {s, problems, k});
    finish();
  }
  /// The stiffness of closed faces and the exponent of mixed modes.
  void finish() {
    exponent_ = nmix;
    if (curves_[0]) closed_ = kClosed >= 0 ? kClosed : curves_[0]->slope();
  }
};

/// Rows of parameter tables: the properties that several laws have.
template <class L>
struct CohesiveRows {
  using P = Parameter<L>;
  using D = Dimension;
  static constexpr P row(std::string_view name, double L::*member, Dimension dimension, std::string_view meaning,
                         Range range = positive) {
    return {name, member, dimension, range, meaning, {}, true};
  }
  static constexpr auto peaks() {
    return std::array{row("sigmaI", &L::sigmaI, D::stress, "largest traction in opening"),
                      row("sigmaII", &L::sigmaII, D::stress, "largest traction in sliding")};
  }
  static constexpr auto energies() {
    return std::array{row("JIc", &L::JIc, D::energy_release,
                          "toughness in opening, which is the area under the curve of traction over opening"),
                      row("JIIc", &L::JIIc, D::energy_release,
                          "toughness in sliding, which is the area under the curve of traction over slip")};
  }
  static constexpr auto ends() {
    return std::array{row("delIc", &L::delIc, D::length, "opening at which the traction has vanished"),
                      row("delIIc", &L::delIIc, D::length, "slip at which the traction has vanished")};
  }
  static constexpr auto slopes() {
    return std::array{row("kIe", &L::kIe, D::interface_stiffness, "initial slope of the traction in opening"),
                      row("kIIe", &L::kIIe, D::interface_stiffness, "initial slope of the traction in sliding")};
  }
  static constexpr auto places() {
    return std::array{row("delpkI", &L::delpkI, D::none, "opening at the peak divided by delIc", {0, 1, true, false}),
                      row("delpkII", &L::delpkII, D::none, "slip at the peak divided by delIIc", {0, 1, true, false})};
  }
  static constexpr auto second_corners() {
    return std::array{
        row("sigmaI2", &L::sigmaI2, D::stress, "traction at the second corner in opening", not_negative),
        row("sigmaII2", &L::sigmaII2, D::stress, "traction at the second corner in sliding", not_negative),
        row("delpkI2", &L::delpkI2, D::none, "opening at the second corner divided by delIc", {0, 1, true, false}),
        row("delpkII2", &L::delpkII2, D::none, "slip at the second corner divided by delIIc", {0, 1, true, false})};
  }
  static constexpr auto decays() {
    return std::array{
        row("alphaI", &L::alphaI, D::none, "exponent of the decay of the traction after the peak in opening"),
        row("alphaII", &L::alphaII, D::none, "exponent of the decay of the traction after the peak in sliding")};
  }
  static constexpr auto mixture() {
    return std::array{P{"nmix", &L::nmix, D::none, any_value,
                        "exponent n of the condition of failure in mixed mode, (GI/JIc)^n + (GII/JIIc)^n = 1 with the "
                        "released energies GI and GII; 0 or negative: each mode fails on its own",
                        1.0}};
  }
  static constexpr auto closed() {
    return std::array{row("kClosed", &L::kClosed, D::interface_stiffness,
                          "normal stiffness of faces that are pressed together (default: the initial slope in opening)",
                          not_negative)};
  }
  /// One table of several.
  template <std::size_t... N>
  static constexpr auto join(const std::array<P, N>&... parts) {
    return std::apply([](const auto&... rows) { return std::array<P, sizeof...(rows)>{rows...}; },
                      std::tuple_cat(parts...));
  }
};

}  // namespace tribo
