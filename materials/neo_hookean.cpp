// SPDX-License-Identifier: MIT
/// Compressible neo-Hookean solid.
///
///   W = G/2 (I1 - 3) - G ln J + U(J)        sigma = G/J (b - 1) + U'(J) 1
///
/// with one of three volumetric energies of modulus lambda (hyperelastic.hpp). At small strain it equals Hooke's law
/// with lambda and G. Simo & Pister (1984); U = lambda/2 (ln J)^2 is Bonet & Wood, Nonlinear Continuum Mechanics,
/// eq. 6.27.

#include "materials/hyperelastic.hpp"

namespace tribo {
namespace {

struct NeoHookean {
  static constexpr std::string_view name = "NeoHookean";
  static constexpr std::string_view summary = "Compressible neo-Hookean solid for large elastic strains.";
  static constexpr int number = 28;
  static constexpr std::string_view needs = "E and nu, or K and G, or Lame and G";
  static constexpr std::string_view example = R"(
<Material Type='NeoHookean' Name='rubber'>
  <rho>1100</rho>
  <G>0.5e6</G>
  <K>50e6</K>
</Material>)";

  double density = 0;
  double young_modulus = absent, poisson_ratio = absent, bulk_modulus = absent, shear_modulus = absent, lame = absent;
  double volumetric_option = 0;
  int option = 0;
  Elasticity elastic;

  static auto parameters() {
    using P = Parameter<NeoHookean>;
    using L = NeoHookean;
    const auto stress = Dimension::stress;
    return std::array{
        P{"rho", &L::density, Dimension::density, positive, "mass density before deformation"},
        P{"E", &L::young_modulus, stress, positive, "Young's modulus; with nu", {}, true},
        P{"nu", &L::poisson_ratio, Dimension::none, between(-1.0, 0.5), "Poisson's ratio; with E", {}, true},
        P{"K", &L::bulk_modulus, stress, positive, "bulk modulus; with G, instead of E and nu", {}, true},
        P{"G", &L::shear_modulus, stress, positive, "shear modulus; with K or Lame", {}, true},
        P{"Lame", &L::lame, stress, any_value, "first Lame constant; with G", {}, true},
        P{"UJOption", &L::volumetric_option, Dimension::none, within(0, 2),
          "volumetric energy, with the first Lame constant k and the volume ratio J; 0: k/2 ((J^2 - 1)/2 - ln J), 1: "
          "k/2 (J - 1)^2, 2: k/2 (ln J)^2",
          0.0},
    };
  }

  void prepare(const Statement& statement, Problems& problems) {
    elastic =
        elastic_constants(statement, {young_modulus, poisson_ratio, bulk_modulus, shear_modulus, lame}, true, problems);
    option = volumetric_choice(volumetric_option, statement, problems);
  }

  double wave_modulus() const { return elastic.wave_modulus(); }

  template <int Option>
  Coefficients coefficients(const Invariants& at) const {
    const double c1 = elastic.mu / at.J;
    return {Volumetric<Option>{elastic.lambda}.slope(at.J) - c1, c1, 0};
  }
  template <int Option>
  double energy(const Invariants& at) const {
    return 0.5 * elastic.mu * (at.I1 - 3) - elastic.mu * std::log(at.J) +
           Volumetric<Option>{elastic.lambda}.energy(at.J);
  }
  static constexpr bool largest_stretch_decides = true;
  // J times the acoustic tensor is G (n.b.n) 1 + (G + J^2 U'') n n.
  template <int Option>
  double stiffness(const Invariants& at, const Triple& b) const {
    return elastic.mu * b[2] + std::max(0.0, elastic.mu + Volumetric<Option>{elastic.lambda}.stiffness(at.J));
  }
};

}  // namespace

Catalogue<Material>::Item neo_hookean() { return material_law<NeoHookean, HyperelasticMaterial<NeoHookean>>(); }

}  // namespace tribo
