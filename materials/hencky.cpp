// SPDX-License-Identifier: MIT
/// Hencky's hyperelastic solid: Hooke's law between Kirchhoff stress and logarithmic strain.
///
///   W = lambda/2 (tr h)^2 + mu h:h,     J sigma = lambda (tr h) 1 + 2 mu h,     h = ln V = ln(F F^T)/2
///
/// Tension and compression by reciprocal stretches have opposite Kirchhoff stresses. In uniaxial stress J sigma = E ln
/// (stretch), and the lateral stretch is stretch^-nu. The law agrees with experiments on metals and rubber for
/// stretches between 0.7 and 1.3 (Anand, J. Appl. Mech. 46 (1979) 78-82). Waves of every direction have real speeds if
/// all stretches lie between 0.21 and 1.39 (Bruhns, Xiao & Meyers, Proc. R. Soc. A 457 (2001) 2207-2226).

#include "materials/elastic_constants.hpp"
#include "materials/material.hpp"
#include "materials/principal.hpp"

namespace tribo {
namespace {

struct Hencky {
  static constexpr std::string_view name = "Hencky";
  static constexpr std::string_view summary =
      "Hencky solid: the Kirchhoff stress is a linear function of the logarithmic strain.";
  static constexpr int number = 0;
  static constexpr std::string_view needs = one_elastic_pair;
  static constexpr std::string_view example = R"(
<Material Type='Hencky' Name='rubber'>
  <rho>1100</rho>
  <E>1.5e6</E>
  <nu>0.45</nu>
</Material>)";

  double density = 0;
  double young_modulus = absent, poisson_ratio = absent, bulk_modulus = absent, shear_modulus = absent;
  Elasticity elastic;

  static auto parameters() {
    using L = Hencky;
    using P = Parameter<L>;
    const auto stress = Dimension::stress;
    return std::array{
        P{"rho", &L::density, Dimension::density, positive, "mass density before deformation"},
        P{"E", &L::young_modulus, stress, positive, "Young's modulus; with nu", {}, true},
        P{"nu", &L::poisson_ratio, Dimension::none, between(-1.0, 0.5), "Poisson's ratio; with E", {}, true},
        P{"K", &L::bulk_modulus, stress, positive, "bulk modulus; with G, instead of E and nu", {}, true},
        P{"G", &L::shear_modulus, stress, positive, "shear modulus; with K, instead of E and nu", {}, true},
    };
  }

  void prepare(const Statement& statement, Problems& problems) {
    elastic = elastic_constants(statement, {young_modulus, poisson_ratio, bulk_modulus, shear_modulus, absent}, false,
                                problems);
  }

  /// Principal logarithmic strains of F in ascending order, and the principal axes of V.
  struct LogarithmicStrain {
    Triple value;
    std::array<Triple, 3> axis;
    double trace() const { return value[0] + value[1] + value[2]; }
    double square() const { return value[0] * value[0] + value[1] * value[1] + value[2] * value[2]; }
  };

  static LogarithmicStrain strain(const Mat3& F) {
    if (!(F.determinant() > 0))
      throw SimulationError("Hencky: the deformation gradient of a particle is singular or inverted (det F <= 0)");
    const Principal b = principal(Mat3(F * F.transpose()));
    return {{0.5 * std::log(b.value[0]), 0.5 * std::log(b.value[1]), 0.5 * std::log(b.value[2])}, b.axis};
  }

  double wave_modulus() const { return elastic.wave_modulus(); }

  using State = NoState;

  /// Upper bound of the spatial modulus rho c^2 over all waves, exact in the reference state. For a wave with unit
  /// direction n and unit amplitude m, J times the acoustic tensor gives, in the principal axes with stresses tau_i,
  ///
  ///   lambda (n.m)^2 + sum_ij n_i^2 m_j^2 mu g_ij + sum_ij k_i k_j s_ij,      k_i = n_i m_i,
  ///   g_ij = 2 x/(1 - exp(-2 x)),  x = h_i - h_j,      s_ij = s_ji = mu g_ij - tau_i.
  ///
  /// The second sum is at most mu times the largest g. Since sum |k_i| <= 1, the third is at most c (n.m)^2 + r, where
  /// c - r and c + r are the smallest and the largest s_ij.
  double wave_modulus(const Mat3& F, const Mat3&, const State&) const {
    const LogarithmicStrain h = strain(F);
    const double lambda = elastic.lambda, mu = elastic.mu;
    double least = std::numeric_limits<double>::infinity(), most = -least;
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j) {
        const double s = mu * ratio(h.value[i] - h.value[j]) - (lambda * h.trace() + 2 * mu * h.value[i]);
        least = std::min(least, s), most = std::max(most, s);
      }
    const double bound = std::max(lambda + most, 0.5 * (most - least)) + mu * ratio(h.value[2] - h.value[0]);
    return bound / F.determinant();
  }

  Mat3 stress(const Motion& motion, const Mat3&, State&) const {
    const LogarithmicStrain h = strain(motion.F);
    Mat3 tau = elastic.lambda * h.trace() * Mat3::Identity();
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3 n(h.axis[i][0], h.axis[i][1], h.axis[i][2]);
      tau += 2 * elastic.mu * h.value[i] * n * n.transpose();
    }
    return tau / motion.F.determinant();
  }

  double energy_density(const Mat3& F, const Mat3&, const State&) const {
    const LogarithmicStrain h = strain(F);
    return (0.5 * elastic.lambda * h.trace() * h.trace() + elastic.mu * h.square()) / F.determinant();
  }

 private:
  /// 2 x/(1 - exp(-2 x)), 1 for x = 0.
  static double ratio(double x) { return x == 0 ? 1.0 : -2 * x / std::expm1(-2 * x); }
};

}  // namespace

Catalogue<Material>::Item hencky() { return material_law<Hencky>(); }

}  // namespace tribo
