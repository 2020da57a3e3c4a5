// SPDX-License-Identifier: MIT
/// Weakly compressible liquid with a viscosity that may depend on the shear rate.
///
///   p = C K (exp((1 - J)/C) - 1),  C = 0.0894 (Tait);    sigma = -p 1 + 2 eta(g) dev D,  g = sqrt(2 dev D : dev D)
///
/// Li, "Equation of state of water and sea water", J. Geophys. Res. 72 (1967) 2665-2678. A viscosity that depends on
/// the shear rate is given as pairs <viscosity>, <logshearrate> (log10 of the rate). It is interpolated linearly in
/// log10 and constant beyond both ends.

#include "materials/material.hpp"

#include <algorithm>

namespace tribo {
namespace {

struct TaitLiquid {
  static constexpr std::string_view name = "TaitLiquid";
  static constexpr std::string_view summary =
      "Weakly compressible viscous liquid: Tait equation, viscosity as a function of shear rate.";
  static constexpr int number = 27;
  static constexpr std::string_view example = R"(
<Material Type='TaitLiquid' Name='water'>
  <rho>1000</rho>
  <K>2e7</K>
  <viscosity>1e-3</viscosity>
</Material>)";
  static constexpr double C = 0.0894;

  double density = 0, bulk_modulus = 0;
  std::vector<std::pair<double, double>> curve;  ///< log10 of the rate, viscosity; one entry: constant

  static auto parameters() {
    using P = Parameter<TaitLiquid>;
    return std::array{
        P{"rho", &TaitLiquid::density, Dimension::density, positive, "mass density at zero pressure"},
        P{"K", &TaitLiquid::bulk_modulus, Dimension::stress, positive, "bulk modulus at zero pressure"},
    };
  }
  static std::vector<OwnProperty> own_properties() {
    return {{"viscosity", "viscosity [stress time]: one value, or one value for each <logshearrate>; required"},
            {"logshearrate",
             "decimal logarithm of the shear rate to which a <viscosity> belongs; repeated for each <viscosity> in "
             "increasing order"}};
  }

  void prepare(const Statement& statement, const Units& units, Problems& problems) {
    std::vector<double> values, rates;
    bool refused = false;
    for (const auto& child : statement.children) {
      const bool rate = child.name == "logshearrate";
      if (!rate && child.name != "viscosity") continue;
      const auto number_read = to_number(child.text);
      if (!number_read || (!rate && *number_read < 0)) {
        problems.add(child.text_origin, "<" + child.name + "> needs one number" + (rate ? "" : ", not negative") +
                                            ", not '" + child.text + "'");
        refused = true;
      } else
        (rate ? rates : values).push_back(rate ? *number_read : *number_read * units.factor(Dimension::viscosity));
    }
    if (refused) return;
    if (values.empty()) problems.add(statement.origin, "<viscosity> is missing");
    const bool constant = values.size() == 1 && rates.empty();
    if (!constant && values.size() != rates.size())
      problems.add(statement.origin, "a viscosity curve needs as many <logshearrate> as <viscosity>, here " +
                                         std::to_string(rates.size()) + " and " + std::to_string(values.size()));
    else
      for (std::size_t k = 0; k < values.size(); ++k) curve.emplace_back(constant ? 0.0 : rates[k], values[k]);
    for (std::size_t k = 1; k < curve.size(); ++k)
      if (!(curve[k].first > curve[k - 1].first)) problems.add(statement.origin, "the <logshearrate>s must increase");
  }

  double viscosity(double rate) const {
    if (curve.size() == 1 || rate <= 0) return curve.front().second;
    const double x = std::log10(rate);
    if (x <= curve.front().first) return curve.front().second;
    for (std::size_t k = 1; k < curve.size(); ++k)
      if (x < curve[k].first) {
        const auto &a = curve[k - 1], &b = curve[k];
        return a.second + (b.second - a.second) * (x - a.first) / (b.first - a.first);
      }
    return curve.back().second;
  }
  double largest_viscosity() const {
    double most = 0;
    for (const auto& [rate, value] : curve) most = std::max(most, value);
    return most;
  }

  double pressure(double J) const { return C * bulk_modulus * std::expm1((1 - J) / C); }
  double wave_modulus() const { return bulk_modulus; }

  struct State {
    double dissipation = 0;
  };
  double wave_modulus(const Mat3& F, const Mat3&, const State&) const {
    return bulk_modulus * std::exp((1 - F.determinant()) / C) * F.determinant();
  }
  static auto history() {
    return std::make_tuple(StateVariable<State>{"dissipation", Dimension::none, &State::dissipation});
  }

  Mat3 stress(const Motion& motion, const Mat3&, State& state) const {
    const Mat3 D = 0.5 * (motion.L + motion.L.transpose());
    const Mat3 deviator = D - D.trace() / 3 * Mat3::Identity();
    const double square = deviator.squaredNorm(), eta = viscosity(std::sqrt(2 * square)), J = motion.F.determinant();
    state.dissipation += 2 * eta * square * J * motion.dt;
    return -pressure(J) * Mat3::Identity() + 2 * eta * deviator;
  }
  // Minus the integral of p over J from 1, divided by J: energy per current volume
  double energy_density(const Mat3& F, const Mat3&, const State&) const {
    const double J = F.determinant();
    return C * bulk_modulus * (C * std::expm1((1 - J) / C) + J - 1) / J;
  }
};

class Liquid final : public PointwiseMaterial<TaitLiquid> {
 public:
  using PointwiseMaterial::PointwiseMaterial;
  bool liquid() const override { return true; }
  double viscosity(double rate) const override { return law().viscosity(rate); }
  double largest_viscosity() const override { return law().largest_viscosity(); }
};

}  // namespace

Catalogue<Material>::Item tait_liquid() { return material_law<TaitLiquid, Liquid>({"Tait"}); }

}  // namespace tribo
