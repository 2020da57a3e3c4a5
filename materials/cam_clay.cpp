// SPDX-License-Identifier: MIT
/// Modified Cam-Clay: a critical state model of clay.
///
///   q^2 + M^2 p (p - pc) <= 0,  associated flow;   in this file p, pc > 0 in compression
///   elastic   p = p_n exp(e/k),                    k = kappa/(1 + e0), e the elastic volume strain of the step
///   hardening pc = pc_n exp(x/(l - k)),            l = lambda/(1 + e0), x the plastic volume strain of the step
///   shear     q = q_trial/(1 + 6 G d),             x = d M^2 (2 p - pc)
///
/// Volume strains are positive in compression. Backward Euler gives two nested equations. For a given plastic
/// multiplier d, the plastic volume strain x is the root of a monotonic function; the yield condition at the end of the
/// step determines d. Roscoe & Burland (1968); Borja & Lee, CMAME 78 (1990) 49-72. Volume strains are logarithmic, as
/// in Butterfield, Geotechnique 29 (1979) 469-480, so that the volume stays positive.

#include "materials/elastic_constants.hpp"
#include "materials/pressure_shear.hpp"

#include <algorithm>

namespace tribo {
namespace {

// Root of a decreasing f with f(low) >= 0 >= f(high): Illinois method, with bisection as a safeguard.
template <class F>
double zero(F&& f, double low, double high, double f_low, double f_high, double enough) {
  for (int k = 0, side = 0; k < 200; ++k) {
    const double x = k % 6 == 5 ? 0.5 * (low + high) : (low * f_high - high * f_low) / (f_high - f_low), at = f(x);
    if (std::abs(at) <= enough || !(x > low && x < high)) return x;
    if (at > 0) {
      low = x, f_low = at;
      if (side == 1) f_high *= 0.5;
      side = 1;
    } else {
      high = x, f_high = at;
      if (side == -1) f_low *= 0.5;
      side = -1;
    }
  }
  return 0.5 * (low + high);
}

struct CamClay {
  static constexpr std::string_view name = "CamClay";
  static constexpr std::string_view summary = "Modified Cam-Clay, a critical state model of clay.";
  static constexpr int number = 0;
  static constexpr std::string_view needs = "G or nu";
  static constexpr std::string_view example = R"(
<Material Type='CamClay' Name='kaolin'>
  <rho>1700</rho>
  <lambda>0.2</lambda>
  <kappa>0.04</kappa>
  <e0>1.2</e0>
  <M>0.9</M>
  <pc0>100e3</pc0>
  <nu>0.3</nu>
</Material>)";

  double density = 0, lambda = 0, kappa = 0, void_ratio = 0, slope = 0, consolidation = 0;
  double shear_modulus = absent, poisson_ratio = absent, least_pressure = absent;
  double l = 0, k = 0;

  static auto parameters() {
    using L = CamClay;
    using P = Parameter<L>;
    constexpr auto stress = Dimension::stress, none = Dimension::none;
    return std::array{
        P{"rho", &L::density, Dimension::density, positive, "mass density before deformation"},
        P{"lambda", &L::lambda, none, positive,
          "slope of the line of virgin compression, void ratio over ln p with the pressure p"},
        P{"kappa", &L::kappa, none, positive, "slope of the swelling lines, void ratio over ln p"},
        P{"e0", &L::void_ratio, none, not_negative, "void ratio before deformation"},
        P{"M", &L::slope, none, positive, "slope q/p of the critical state line, with the von Mises stress q"},
        P{"pc0", &L::consolidation, stress, positive, "consolidation pressure before deformation"},
        P{"G", &L::shear_modulus, stress, positive, "shear modulus, constant; or nu", {}, true},
        P{"nu",
          &L::poisson_ratio,
          none,
          between(-1.0, 0.5),
          "Poisson's ratio, constant, instead of G; the shear modulus is then proportional to the pressure",
          {},
          true},
        P{"pmin",
          &L::least_pressure,
          stress,
          positive,
          "lower bound of the pressure in the elastic stiffness (default pc0/1000)",
          {},
          true},
    };
  }

  void prepare(const Statement& statement, Problems& problems) {
    if (!(lambda > kappa)) problems.add(statement.child("lambda")->origin, "<lambda> must exceed <kappa>");
    if (given(shear_modulus) == given(poisson_ratio))
      problems.add(statement.origin, "Cam-Clay needs one of <G> and <nu>");
    l = lambda / (1 + void_ratio), k = kappa / (1 + void_ratio);
    if (!given(least_pressure)) least_pressure = 1e-3 * consolidation;
  }

  struct State {
    double consolidation = 0, plastic_volume = 0, plastic_shear = 0, dissipation = 0;
    double opening = 0;  ///< volume strain beyond the state of least pressure that has not closed again
  };
  State initial_state() const { return {consolidation, 0, 0, 0, 0}; }
  static auto history() {
    return std::make_tuple(StateVariable<State>{"consolidation", Dimension::stress, &State::consolidation},
                           StateVariable<State>{"plastic_volume", Dimension::none, &State::plastic_volume},
                           StateVariable<State>{"plastic_shear", Dimension::none, &State::plastic_shear},
                           StateVariable<State>{"dissipation", Dimension::stress, &State::dissipation},
                           StateVariable<State>{"opening", Dimension::none, &State::opening});
  }

  Material::Opening opening() const { return {4, std::nullopt, 0.0}; }

  double bulk(double p) const { return std::max(p, least_pressure) / k; }
  double shear(double p) const {
    return given(shear_modulus) ? shear_modulus : 1.5 * bulk(p) * (1 - 2 * poisson_ratio) / (1 + poisson_ratio);
  }
  double wave_modulus() const { return bulk(consolidation) + 4.0 / 3 * shear(consolidation); }
  double wave_modulus(const Mat3&, const Mat3& stress, const State&) const {
    const double p = -stress.trace() / 3;
    return bulk(p) + 4.0 / 3 * shear(p);
  }

  struct Return {
    double p, q, pc, volume, shear;  // volume, shear: plastic strain increments, volume positive in compression
  };

  Return returned(double p_trial, double q_trial, double G, double pc_old) const {
    const double M2 = slope * slope, h = l - k;
    const auto at = [&](double d) {
      const auto residual = [&](double x) {
        return d * M2 * (2 * p_trial * std::exp(-x / k) - pc_old * std::exp(x / h)) - x;
      };
      // the root lies between 0 and the value at which 2 p - pc vanishes
      const double turn = std::log(2 * p_trial / pc_old) * k * h / (k + h), low = std::min(0.0, turn),
                   high = std::max(0.0, turn);
      const double x = zero(residual, low, high, residual(low), residual(high), 0.0);
      return Return{p_trial * std::exp(-x / k), q_trial / (1 + 6 * G * d), pc_old * std::exp(x / h), x,
                    2 * d * q_trial / (1 + 6 * G * d)};
    };
    const auto excess = [&](double d) {
      const Return r = at(d);
      return r.q * r.q + M2 * r.p * (r.p - r.pc);
    };
    const double size = q_trial * q_trial + M2 * p_trial * p_trial, first = excess(0.0);
    if (!(first > 1e-13 * size)) return {p_trial, q_trial, pc_old, 0.0, 0.0};
    double high = 1e-6 / (M2 * pc_old), f_high = excess(high);
    for (int n = 0; n < 200 && f_high > 0; ++n) high *= 4, f_high = excess(high);
    return at(zero(excess, 0.0, high, first, f_high, 1e-13 * size));
  }

  Mat3 stress(const Motion& motion, const Mat3& old, State& state) const {
    const Mat3 half = spin_rotation(motion.L, 0.5 * motion.dt);
    const Mat3 D = 0.5 * motion.dt * (motion.L + motion.L.transpose());
    const double before = std::max(-old.trace() / 3, least_pressure), G = shear(before);
    // What opens at the least pressure closes again before the pressure grows.
    const double closing = std::clamp(-D.trace(), 0.0, state.opening);
    const double alone = before * std::exp(-(D.trace() + closing) / k), p_trial = std::max(alone, least_pressure);
    state.opening += k * std::log(p_trial / alone) - closing;
    const Mat3 deviator = old - old.trace() / 3 * Mat3::Identity();
    const Mat3 trial =
        half * (half * deviator * half.transpose() + 2 * G * (D - D.trace() / 3 * Mat3::Identity())) * half.transpose();
    const double q_trial = std::sqrt(1.5 * trial.squaredNorm());
    const Return r = returned(p_trial, q_trial, G, state.consolidation);
    state.consolidation = r.pc;
    state.plastic_volume -= r.volume;
    state.plastic_shear += 0.5 * std::sqrt(3.0) * r.shear;
    state.dissipation += motion.F.determinant() * (r.p * r.volume + r.q * r.shear);
    return -r.p * Mat3::Identity() + (q_trial > 0 ? r.q / q_trial : 1.0) * trial;
  }
  // int p de = k p, integrated from p = 0, plus the shear energy with the current shear modulus
  double energy_density(const Mat3&, const Mat3& stress, const State&) const {
    const auto [mean, q] = pressure_shear(stress);
    const double p = std::max(-mean, least_pressure);
    return k * p + q * q / (6 * shear(p));
  }
};

}  // namespace

Catalogue<Material>::Item cam_clay() { return material_law<CamClay>({"ModifiedCamClay"}); }

}  // namespace tribo
