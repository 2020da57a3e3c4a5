// SPDX-License-Identifier: MIT
/// Compressible Mooney-Rivlin rubber with uncoupled volumetric energy.
///
///   W = G1/2 (J^(-2/3) I1 - 3) + G2/2 (J^(-4/3) I2 - 3) + U(J)
///   sigma = G1 J^(-5/3) dev b + G2 J^(-7/3) dev(I1 b - b^2) + U'(J) 1
///
/// Rivlin (1948) with G1 = 2 C10, G2 = 2 C01; Simo, Taylor & Pister (1985). At small strain it equals Hooke's law with
/// shear modulus G1 + G2 and bulk modulus K.

#include "materials/hyperelastic.hpp"

namespace tribo {
namespace {

struct MooneyRivlin {
  static constexpr std::string_view name = "MooneyRivlin";
  static constexpr std::string_view summary = "Compressible Mooney-Rivlin solid, for rubber.";
  static constexpr int number = 8;
  static constexpr std::string_view needs = "G1 and K, or E and nu";
  static constexpr std::string_view example = R"(
<Material Type='MooneyRivlin' Name='rubber'>
  <rho>1100</rho>
  <G1>0.4e6</G1>
  <G2>0.1e6</G2>
  <K>50e6</K>
</Material>)";

  double density = 0;
  double G1 = absent, G2 = 0, bulk_modulus = absent, young_modulus = absent, poisson_ratio = absent;
  double volumetric_option = 0;
  int option = 0;

  static auto parameters() {
    using P = Parameter<MooneyRivlin>;
    using L = MooneyRivlin;
    const auto stress = Dimension::stress;
    return std::array{
        P{"rho", &L::density, Dimension::density, positive, "mass density before deformation"},
        P{"G1", &L::G1, stress, not_negative, "modulus of the first invariant; with K", {}, true},
        P{"G2", &L::G2, stress, not_negative, "modulus of the second invariant", 0.0},
        P{"K", &L::bulk_modulus, stress, positive, "bulk modulus; with G1", {}, true},
        P{"E", &L::young_modulus, stress, positive, "Young's modulus; with nu, instead of G1 and K", {}, true},
        P{"nu", &L::poisson_ratio, Dimension::none, between(-1.0, 0.5), "Poisson's ratio; with E", {}, true},
        P{"UJOption", &L::volumetric_option, Dimension::none, within(0, 2),
          "volumetric energy, with the bulk modulus k and the volume ratio J; 0: k/2 ((J^2 - 1)/2 - ln J), 1: k/2 (J - "
          "1)^2, 2: k/2 (ln J)^2",
          0.0},
    };
  }

  void prepare(const Statement& statement, Problems& problems) {
    option = volumetric_choice(volumetric_option, statement, problems);
    const bool engineering = given(young_modulus) && given(poisson_ratio) && !given(G1) && !given(bulk_modulus);
    const bool direct = given(G1) && given(bulk_modulus) && !given(young_modulus) && !given(poisson_ratio);
    if (engineering) {
      const Elasticity elastic = Elasticity::young(young_modulus, poisson_ratio);
      G1 = elastic.mu - G2, bulk_modulus = elastic.bulk();
      if (!(G1 >= 0))
        problems.add(statement.child("G2")->origin, "<G2> must not exceed the shear modulus E/(2 + 2 nu) = G1 + G2");
    } else if (!direct) {
      problems.add(statement.origin,
                   "the elastic constants must be G1 and K, or E and nu (G1 follows), each with an optional G2");
    } else if (G1 + G2 == 0) {
      problems.add(statement.origin, "<G1> and <G2> are both 0: the material would have no shear stiffness");
    }
  }

  double wave_modulus() const { return bulk_modulus + 4.0 / 3.0 * (G1 + G2); }

  template <int Option>
  Coefficients coefficients(const Invariants& at) const {
    const double root = 1 / std::cbrt(at.J), root2 = root * root, root5 = root2 * root2 * root;
    const double g1 = G1 * root5, g2 = G2 * root5 * root2;
    return {Volumetric<Option>{bulk_modulus}.slope(at.J) - (g1 * at.I1 + 2 * g2 * at.I2) / 3, g1 + g2 * at.I1, -g2};
  }
  template <int Option>
  double energy(const Invariants& at) const {
    const double root = 1 / std::cbrt(at.J), root2 = root * root;
    return 0.5 * G1 * (root2 * at.I1 - 3) + 0.5 * G2 * (root2 * root2 * at.I2 - 3) +
           Volumetric<Option>{bulk_modulus}.energy(at.J);
  }
  // Upper bound of the largest eigenvalue of J times the acoustic tensor, for a wave in direction n with displacement
  // m. With k = m.n and a = b^-1 its two shear terms are
  //   G1 J^(-2/3) [n.b.n - 4/3 k m.b.n + 5/9 I1 k^2]   and   G2 J^(2/3) [m.a.m + 2/3 k n.a.m - k^2 tr(a)/9].
  // The bound is exact in the reference state.
  template <int Option>
  double stiffness(const Invariants& at, const Triple& b) const {
    const double root = std::cbrt(at.J), root2 = root * root;
    const double first = std::max(b[2], 5.0 / 9.0 * at.I1 - b[0] / 3) + (b[2] - b[0]) / 3;
    const double second = 5.0 / 3.0 / b[0] - (1 / b[0] + 1 / b[1] + 1 / b[2]) / 9;
    return G1 / root2 * first + G2 * root2 * second + std::max(0.0, Volumetric<Option>{bulk_modulus}.stiffness(at.J));
  }
};

}  // namespace

Catalogue<Material>::Item mooney_rivlin() {
  return material_law<MooneyRivlin, HyperelasticMaterial<MooneyRivlin>>({"Mooney"});
}

}  // namespace tribo
