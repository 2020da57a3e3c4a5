// SPDX-License-Identifier: MIT
/// Isotropic von Mises plasticity with the hardening laws of NairnMPM.
///
///   q <= sigma_y(e, e'),   e the accumulated plastic strain, e' its rate
///
///   Linear        sigma_y = yield + Khard e, at least yieldMin  (or Ep, the slope in tension: Khard = E Ep/(E - Ep))
///   Nonlinear     sigma_y = yield (1 + Khard e)^nhard
///   Nonlinear2    sigma_y = yield (1 + Khard e^nhard)
///   JohnsonCook   sigma_y = (Ajc + Bjc e^njc) max(1/2, 1 + Cjc ln r + Djc (ln max(r, 1))^n2jc) (1 - t^mjc),
///                 r = e'/ep0jc, t = (T - T_0)/(Tmjc - T_0) within 0 and 1, T_0 the reference temperature
///
/// Radial return, backward Euler: q_trial - 3 G de = sigma_y(e + de, de/dt) is one scalar equation for de. Simo &
/// Hughes, Computational Inelasticity (1998), box 3.2; Johnson & Cook, Eng. Fract. Mech. 21 (1985) 31-48. The lower
/// bound 1/2 of the rate factor is that of NairnMPM; without it the logarithm diverges at small rates. The temperature
/// is that at the start of the step.

#include "materials/elastic_constants.hpp"
#include "materials/pressure_shear.hpp"

#include <algorithm>

namespace tribo {
namespace {

enum class Hardening { linear, nonlinear, johnson_cook, nonlinear2 };

struct IsoPlasticity {
  static constexpr std::string_view name = "IsoPlasticity";
  static constexpr std::string_view summary =
      "Elastic-plastic solid of von Mises type with linear, power-law or Johnson-Cook hardening.";
  static constexpr int number = 9;
  static constexpr std::string_view needs =
      "E and nu, or K and G; and yield, or with <Hardening> JohnsonCook instead Ajc";
  static constexpr std::string_view example = R"(
<Material Type='IsoPlasticity' Name='copper'>
  <rho>8930</rho>
  <E>117e9</E>
  <nu>0.35</nu>
  <Hardening>JohnsonCook</Hardening>
  <Ajc>90e6</Ajc>
  <Bjc>292e6</Bjc>
  <njc>0.31</njc>
  <Cjc>0.025</Cjc>
  <ep0jc>1</ep0jc>
</Material>)";

  double density = 0;
  double young_modulus = absent, poisson_ratio = absent, bulk_modulus = absent, shear_modulus = absent;
  double yield = absent, slope = absent, coefficient = absent, power = absent;
  double A = absent, B = absent, n = absent, C = absent, D = absent, n2 = absent, reference_rate = absent,
         melting = absent, m = absent, least = absent;
  Hardening hardening = Hardening::linear;
  Elasticity elastic;

  static auto parameters() {
    using L = IsoPlasticity;
    using P = Parameter<L>;
    constexpr auto stress = Dimension::stress, none = Dimension::none;
    return std::array{
        P{"rho", &L::density, Dimension::density, positive, "mass density before deformation"},
        P{"E", &L::young_modulus, stress, positive, "Young's modulus; with nu", {}, true},
        P{"nu", &L::poisson_ratio, none, between(-1.0, 0.5), "Poisson's ratio; with E", {}, true},
        P{"K", &L::bulk_modulus, stress, positive, "bulk modulus; with G, instead of E and nu", {}, true},
        P{"G", &L::shear_modulus, stress, positive, "shear modulus; with K, instead of E and nu", {}, true},
        P{"yield", &L::yield, stress, positive, "yield stress before hardening; not with JohnsonCook", {}, true},
        P{"yieldMin", &L::least, stress, not_negative, "Linear: lower bound of the yield stress (default 0)", {}, true},
        P{"Ep",
          &L::slope,
          stress,
          not_negative,
          "Linear: slope of stress over total strain after yield in uniaxial tension, instead of Khard",
          {},
          true},
        P{"Khard",
          &L::coefficient,
          none,
          any_value,
          "Linear: slope of the yield stress over the plastic strain [stress]; Nonlinear and Nonlinear2: coefficient "
          "of the plastic strain [-]",
          {},
          true},
        P{"nhard",
          &L::power,
          none,
          positive,
          "Nonlinear and Nonlinear2: exponent of the hardening (default 1)",
          {},
          true},
        P{"Ajc", &L::A, stress, positive, "JohnsonCook: yield stress A before hardening", {}, true},
        P{"Bjc", &L::B, stress, not_negative, "JohnsonCook: coefficient B of the hardening (default 0)", {}, true},
        P{"njc", &L::n, none, positive, "JohnsonCook: exponent n of the hardening (default 1)", {}, true},
        P{"Cjc",
          &L::C,
          none,
          not_negative,
          "JohnsonCook: coefficient C of the logarithm of the strain rate (default 0)",
          {},
          true},
        P{"Djc",
          &L::D,
          none,
          not_negative,
          "JohnsonCook: coefficient D of a second term with the logarithm of the strain rate (default 0)",
          {},
          true},
        P{"n2jc",
          &L::n2,
          none,
          positive,
          "JohnsonCook: exponent of the logarithm in the second term (default 1)",
          {},
          true},
        P{"ep0jc",
          &L::reference_rate,
          Dimension::rate,
          positive,
          "JohnsonCook: reference strain rate (default 1)",
          {},
          true},
        P{"Tmjc",
          &L::melting,
          Dimension::temperature,
          any_value,
          "JohnsonCook: temperature at which the strength vanishes (default: the strength does not depend on the "
          "temperature)",
          {},
          true},
        P{"mjc", &L::m, none, positive, "JohnsonCook: exponent of thermal softening (default 1)", {}, true},
    };
  }
  static std::vector<OwnProperty> own_properties() {
    return {
        {"Hardening",
         "hardening law, by name or number: Linear (1, default), Nonlinear (2), JohnsonCook (3) or Nonlinear2 (6)"}};
  }

  void prepare(const Statement& statement, const Units& units, Problems& problems) {
    elastic =
        elastic_constants(statement, {young_modulus, poisson_ratio, bulk_modulus, shear_modulus}, false, problems);
    if (const Statement* s = statement.child("Hardening")) hardening = choice(*s, problems);
    check_properties(statement, problems);
    const auto set = [](double& value, double fallback) { value = given(value) ? value : fallback; };
    if (hardening == Hardening::linear) {
      if (given(coefficient)) coefficient *= units.factor(Dimension::stress);
      if (given(slope)) coefficient = elastic_slope(statement, problems);
    }
    set(coefficient, 0), set(power, 1), set(B, 0), set(n, 1), set(C, 0), set(D, 0), set(n2, 1), set(reference_rate, 1),
        set(m, 1), set(least, 0);
    if (hardening != Hardening::linear && coefficient < 0)
      problems.add(statement.child("Khard")->origin,
                   "<Khard> must not be negative: softening needs an internal length, which this law does not have");
    if (hardening == Hardening::linear && 3 * elastic.mu + coefficient <= 0)
      problems.add(statement.origin, "the material softens faster than it unloads elastically: Khard must exceed -3 G");
  }

  void weaken(double factor) {
    for (double* stress : {&yield, &A, &B, &least}) *stress /= factor;
    if (hardening == Hardening::linear) coefficient /= factor;
  }

  double elastic_slope(const Statement& statement, Problems& problems) const {
    const double G = elastic.mu, K = elastic.bulk(), E = 9 * K * G / (3 * K + G);
    if (!(slope < E)) problems.add(statement.child("Ep")->origin, "<Ep> must be below Young's modulus");
    if (given(coefficient)) problems.add(statement.child("Khard")->origin, "give one of <Ep> and <Khard>");
    return E * slope / (E - slope);
  }

  static Hardening choice(const Statement& s, Problems& problems) {
    const std::array<std::pair<const char*, const char*>, 4> all{
        {{"Linear", "1"}, {"Nonlinear", "2"}, {"JohnsonCook", "3"}, {"Nonlinear2", "6"}}};
    for (std::size_t k = 0; k < all.size(); ++k)
      if (s.text == all[k].first || s.text == all[k].second) return static_cast<Hardening>(k);
    const std::vector<std::string> names{"Linear", "Nonlinear", "JohnsonCook", "Nonlinear2"};
    problems.add(s.text_origin, "there is no hardening law '" + s.text + "'" + did_you_mean(s.text, names) +
                                    "; valid: Linear (1), Nonlinear (2), JohnsonCook (3), Nonlinear2 (6)");
    return Hardening::linear;
  }

  // Each hardening law has its own properties. A property of another hardening law would have no effect: it is an
  // error.
  void check_properties(const Statement& statement, Problems& problems) const {
    const bool cook = hardening == Hardening::johnson_cook, linear = hardening == Hardening::linear;
    const auto only = [&](bool fits, const char* word, const char* law) {
      if (const Statement* s = statement.child(word); s && !fits)
        problems.add(s->origin, "<" + std::string(word) + "> belongs to <Hardening>" + law + "</Hardening>");
    };
    for (const char* word : {"Ajc", "Bjc", "njc", "Cjc", "Djc", "n2jc", "ep0jc", "Tmjc", "mjc"})
      only(cook, word, "JohnsonCook");
    for (const char* word : {"yield", "Khard"}) only(!cook, word, "Linear, Nonlinear or Nonlinear2");
    only(linear, "Ep", "Linear"), only(linear, "yieldMin", "Linear");
    only(!cook && !linear, "nhard", "Nonlinear or Nonlinear2");
    if (const Statement* s = statement.child("mjc"); s && !given(melting))
      problems.add(s->origin, "<mjc> needs <Tmjc>, the temperature at which the strength vanishes");
    if (!given(cook ? A : yield))
      problems.add(statement.origin,
                   cook ? "<Ajc> is missing, the yield stress" : "<yield> is missing, the yield stress");
  }

  double wave_modulus() const { return elastic.wave_modulus(); }
  bool feels_temperature() const { return given(melting); }

  struct State {
    double plastic_strain = 0, dissipation = 0;
  };
  static auto history() {
    return std::make_tuple(StateVariable<State>{"plastic_strain", Dimension::none, &State::plastic_strain},
                           StateVariable<State>{"dissipation", Dimension::stress, &State::dissipation});
  }

  // Factor of the strength due to the temperature, 1 - t^m.
  double cold_share(const ReturnStep& at) const {
    if (!feels_temperature()) return 1.0;
    const double warmth = (at.temperature - at.reference_temperature) / (melting - at.reference_temperature);
    return 1.0 - std::pow(std::clamp(warmth, 0.0, 1.0), m);
  }

  double yield_stress(double e, double rate) const {
    switch (hardening) {
      case Hardening::nonlinear:
        return yield * std::pow(1 + coefficient * e, power);
      case Hardening::nonlinear2:
        return yield * (1 + coefficient * std::pow(e, power));
      case Hardening::johnson_cook: {
        double growth = C > 0 && rate > 0 ? 1 + C * std::log(rate / reference_rate) : C > 0 ? 0.5 : 1.0;
        if (D > 0 && rate > reference_rate) growth += D * std::pow(std::log(rate / reference_rate), n2);
        return (A + B * std::pow(e, n)) * std::max(0.5, growth);
      }
      case Hardening::linear:
        break;
    }
    return std::max(least, yield + coefficient * e);
  }

  // The increment x of plastic strain: the root of excess(x) = q - 3 G x - share sigma_y(e + x, x/dt), which decreases
  // and changes its sign between 0 and q/(3 G). Safeguarded secant steps (Illinois); linear hardening needs one.
  double flow(double q, double e, double dt, double share) const {
    const auto excess = [&](double x) { return q - 3 * elastic.mu * x - share * yield_stress(e + x, x / dt); };
    double low = 0, high = q / (3 * elastic.mu), f_low = excess(low), f_high = excess(high);
    if (!(f_low > 0)) return 0.0;
    const double enough = 1e-14 * q;
    for (int k = 0, side = 0; k < 200; ++k) {
      const double x = k % 8 == 7 ? 0.5 * (low + high) : (low * f_high - high * f_low) / (f_high - f_low);
      const double f = excess(x);
      if (std::abs(f) <= enough || !(x > low && x < high)) return x;
      if (f > 0) {
        low = x, f_low = f;
        if (side == 1) f_high *= 0.5;
        side = 1;
      } else {
        high = x, f_high = f;
        if (side == -1) f_low *= 0.5;
        side = -1;
      }
    }
    return 0.5 * (low + high);
  }

  PressureShear returned(const PressureShear& trial, const ReturnStep& step, State& state) const {
    const double x = flow(trial.q, state.plastic_strain, step.dt, cold_share(step));
    if (x == 0) return trial;
    const double q = trial.q - 3 * elastic.mu * x;
    state.plastic_strain += x;
    state.dissipation += step.J * q * x;
    return {trial.p, q};
  }
  Mat3 stress(const Motion& motion, const Mat3& old, State& state) const {
    return plastic_step(*this, motion, old, state);
  }
  double energy_density(const Mat3&, const Mat3& stress, const State&) const { return elastic.energy(stress); }
};

}  // namespace

Catalogue<Material>::Item iso_plasticity() {
  return material_law<IsoPlasticity, PressureShearMaterial<IsoPlasticity>>({"VonMises"});
}

}  // namespace tribo
