// SPDX-License-Identifier: MIT
/// Drucker-Prager plasticity: a cone around the hydrostatic axis that replaces the Mohr-Coulomb pyramid.
///
///   q + A p <= B,   flow along q + A_psi p;   stresses beyond the cone's apex p = B/A return to the apex
///
/// p is the mean stress, tension positive; psi > 0 increases the volume under plastic shear.
/// A and B follow from cohesion and friction angle by one of four ways to match the pyramid:
///   1 compression   A = 6 sin phi/(3 - sin phi)                      its outer edges
///   2 extension     A = 6 sin phi/(3 + sin phi)                      its inner edges
///   3 inscribed     A = 3 sin phi/sqrt(3 + sin^2 phi)                the largest cone within
///   4 plane strain  same strength and dilation in plane plastic flow
///                   A = sqrt(3) sin phi/(f + sin phi A_psi/sqrt(27)), f = sqrt(1 - A_psi^2/9)
/// with B = A c cot phi, and A_psi the same of the dilation angle (4: as 3). Drucker & Prager, Quart. Appl. Math. 10
/// (1952) 157-165; de Souza Neto, Peric & Owen, Computational Methods for Plasticity (2008), 6.4.4 and 8.3.

#include "materials/elastic_constants.hpp"
#include "materials/pressure_shear.hpp"

namespace tribo {
namespace {

struct DruckerPrager {
  static constexpr std::string_view name = "DruckerPrager";
  static constexpr std::string_view summary =
      "Frictional elastic-plastic solid of Drucker-Prager type, whose cone is matched to a Mohr-Coulomb pyramid.";
  static constexpr int number = 0;
  static constexpr std::string_view needs = one_elastic_pair;
  static constexpr std::string_view example = R"(
<Material Type='DruckerPrager' Name='sand'>
  <rho>1600</rho>
  <E>10e6</E>
  <nu>0.3</nu>
  <cohesion>0</cohesion>
  <friction>32</friction>
  <dilation>0</dilation>
  <match>1</match>
</Material>)";

  double density = 0;
  double young_modulus = absent, poisson_ratio = absent, bulk_modulus = absent, shear_modulus = absent;
  double cohesion = 0, friction = 0, dilation = 0, match = 1;
  double A = 0, B = 0, A_psi = 0;
  Elasticity elastic;

  static auto parameters() {
    using L = DruckerPrager;
    using P = Parameter<L>;
    constexpr auto stress = Dimension::stress, none = Dimension::none, angle = Dimension::angle;
    return std::array{
        P{"rho", &L::density, Dimension::density, positive, "mass density before deformation"},
        P{"E", &L::young_modulus, stress, positive, "Young's modulus; with nu", {}, true},
        P{"nu", &L::poisson_ratio, none, between(-1.0, 0.5), "Poisson's ratio; with E", {}, true},
        P{"K", &L::bulk_modulus, stress, positive, "bulk modulus; with G, instead of E and nu", {}, true},
        P{"G", &L::shear_modulus, stress, positive, "shear modulus; with K, instead of E and nu", {}, true},
        P{"cohesion", &L::cohesion, stress, not_negative, "cohesion of the matched Mohr-Coulomb pyramid"},
        P{"friction", &L::friction, angle, {0.0, 90.0, false, true}, "friction angle of the matched pyramid"},
        P{"dilation",
          &L::dilation,
          angle,
          {0.0, 90.0, false, true},
          "dilation angle; with a positive angle the volume increases under plastic shear",
          0.0},
        P{"match", &L::match, none, within(1, 4),
          "how the cone is matched to the pyramid: 1 at its edges of triaxial compression, 2 of triaxial extension, 3 "
          "inscribed, 4 for plane strain",
          1.0},
    };
  }

  // Slope A of the cone for the sine of an angle, for matches 1 to 3.
  double slope(double sine) const {
    switch (static_cast<int>(match)) {
      case 1:
        return 6 * sine / (3 - sine);
      case 2:
        return 6 * sine / (3 + sine);
      default:
        return 3 * sine / std::sqrt(3 + sine * sine);
    }
  }

  void prepare(const Statement& statement, Problems& problems) {
    elastic =
        elastic_constants(statement, {young_modulus, poisson_ratio, bulk_modulus, shear_modulus}, false, problems);
    const auto origin = [&](std::string_view word) {
      const Statement* child = statement.child(word);
      return child ? child->origin : statement.origin;
    };
    if (dilation > friction)
      problems.add(origin("dilation"), "<dilation> must not exceed <friction>: the flow would create energy");
    if (cohesion == 0 && friction == 0)
      problems.add(origin("cohesion"), "<cohesion> and <friction> are both 0: the material would have no strength");
    if (match != std::floor(match)) problems.add(origin("match"), "<match> is 1, 2, 3 or 4");
    fit();
  }

  void weaken(double factor) {
    cohesion /= factor, friction = std::atan(std::tan(friction) / factor), dilation = std::min(dilation, friction);
    fit();
  }

  // Computes the cone from the angles.
  void fit() {
    const double sine = std::sin(friction), cosine = std::cos(friction);
    A_psi = slope(std::sin(dilation));
    // Plane plastic flow has an out-of-plane stress that depends on the dilation; then q = sqrt(3) R/flat.
    const double flat = std::sqrt(1 - A_psi * A_psi / 9), root = std::sqrt(3.0);
    A = match == 4 ? root * sine / (flat + root * sine * A_psi / 9) : slope(sine);
    const double per_cohesion = match == 1   ? 6 * cosine / (3 - sine)
                                : match == 2 ? 6 * cosine / (3 + sine)
                                : match == 3 ? 3 * cosine / std::sqrt(3 + sine * sine)
                                             : root * cosine / (flat + root * sine * A_psi / 9);
    B = cohesion * per_cohesion;
  }

  double wave_modulus() const { return elastic.wave_modulus(); }

  struct State {
    double plastic_shear = 0, plastic_volume = 0, dissipation = 0;
    double opening = 0;  ///< volume strain by which the apex has opened and not closed again
  };
  static auto history() {
    return std::make_tuple(StateVariable<State>{"plastic_shear", Dimension::none, &State::plastic_shear},
                           StateVariable<State>{"plastic_volume", Dimension::none, &State::plastic_volume},
                           StateVariable<State>{"dissipation", Dimension::stress, &State::dissipation},
                           StateVariable<State>{"opening", Dimension::none, &State::opening});
  }

  Material::Opening opening() const { return {3, 1, elastic.bulk()}; }

  PressureShear returned(PressureShear trial, const ReturnStep& step, State& state) const {
    const double G = elastic.mu, K = elastic.bulk();
    if (state.opening > 0 && trial.p < 0) {  // what is open closes before it is pressed
      const double closing = std::min(-trial.p / K, state.opening);
      trial.p += K * closing;
      state.opening -= closing, state.plastic_volume -= closing;
    }
    const double excess = trial.q + A * trial.p - B;
    if (!(excess > 0)) return trial;
    const double flow = excess / (3 * G + K * A * A_psi);
    PressureShear to{trial.p - K * A_psi * flow, trial.q - 3 * G * flow};
    const bool apex = to.q < 0;  // without friction q > 0 always
    if (apex) to = {B / A, 0.0};
    const double shear = (trial.q - to.q) / (3 * G), volume = (trial.p - to.p) / K;
    state.plastic_shear += 0.5 * std::sqrt(3.0) * shear;
    state.plastic_volume += volume;
    if (apex) state.opening += volume;
    state.dissipation += step.J * (to.q * shear + to.p * volume);
    return to;
  }
  Mat3 stress(const Motion& motion, const Mat3& old, State& state) const {
    return plastic_step(*this, motion, old, state);
  }
  double energy_density(const Mat3&, const Mat3& stress, const State&) const { return elastic.energy(stress); }
};

}  // namespace

Catalogue<Material>::Item drucker_prager() {
  return material_law<DruckerPrager, PressureShearMaterial<DruckerPrager>>();
}

}  // namespace tribo
