// SPDX-License-Identifier: MIT
/// Orthotropic elastic solid: wood, rolled sheet, laminates. See orthotropic.hpp for the law.

#include "materials/orthotropic.hpp"

#include "materials/elastic_constants.hpp"

#include <Eigen/Eigenvalues>
#include <cmath>

namespace tribo {

OrthotropicElasticity::OrthotropicElasticity(const OrthotropicConstants& c, const Statement& statement,
                                             Problems& problems) {
  Mat3 compliance;
  compliance << 1 / c.Ex, -c.nu_xy / c.Ex, -c.nu_xz / c.Ex,  //
      -c.nu_xy / c.Ex, 1 / c.Ey, -c.nu_yz / c.Ey,            //
      -c.nu_xz / c.Ex, -c.nu_yz / c.Ey, 1 / c.Ez;
  // The scaling removes the size of the moduli, so that it does not hide a negative eigenvalue in round-off.
  const Vec3 scale(std::sqrt(c.Ex), std::sqrt(c.Ey), std::sqrt(c.Ez));
  const Mat3 ratios = scale.asDiagonal() * compliance * scale.asDiagonal();
  if (!(Eigen::SelfAdjointEigenSolver<Mat3>(ratios, Eigen::EigenvaluesOnly).eigenvalues()[0] > 1e-12)) {
    problems.add(
        statement.origin,
        "these Poisson's ratios are impossible: some strains would not store positive energy. Every nu_ij^2 must be "
        "below E_i/E_j, and all three together must leave the compliance positive definite");
    return;
  }
  normal_ = compliance.inverse();
  shear_ = Vec3(c.Gyz, c.Gxz, c.Gxy);
  // The acoustic (Christoffel) tensor of directions in one octant, every 5 degrees
  constexpr int steps = 18;
  const double step = std::acos(0.0) / steps;
  for (int i = 0; i <= steps; ++i)
    for (int j = 0; j <= steps; ++j) {
      const Vec3 n(std::sin(i * step) * std::cos(j * step), std::sin(i * step) * std::sin(j * step),
                   std::cos(i * step));
      Mat3 christoffel;
      for (int k = 0; k < 3; ++k) {
        const Vec3 m = Vec3::Unit(k);
        christoffel.col(k) = stress(0.5 * (n * m.transpose() + m * n.transpose())) * n;
      }
      const Eigen::SelfAdjointEigenSolver<Mat3> waves(christoffel, Eigen::EigenvaluesOnly);
      wave_modulus_ = std::max(wave_modulus_, waves.eigenvalues()[2]);
    }
}

Mat3 OrthotropicElasticity::stress(const Mat3& strain) const {
  const Vec3 normal = normal_ * strain.diagonal();
  Mat3 s;
  s << normal[0], 2 * shear_[2] * strain(0, 1), 2 * shear_[1] * strain(0, 2),  //
      2 * shear_[2] * strain(1, 0), normal[1], 2 * shear_[0] * strain(1, 2),   //
      2 * shear_[1] * strain(2, 0), 2 * shear_[0] * strain(2, 1), normal[2];
  return s;
}

namespace {

struct OrthotropicParameters {
  static constexpr std::string_view name = "Orthotropic";
  static constexpr std::string_view summary = "Orthotropic elastic solid for small strains and any rotation.";
  static constexpr int number = 4;
  static constexpr std::string_view needs = "nuxy or nuyx, nuyz or nuzy, nuxz or nuzx";
  static constexpr std::string_view example = R"(
<Material Type='Orthotropic' Name='spruce'>
  <rho>430</rho>
  <Ex>11e9</Ex>
  <Ey>0.9e9</Ey>
  <Ez>0.5e9</Ez>
  <Gxy>0.7e9</Gxy>
  <Gyz>0.04e9</Gyz>
  <Gxz>0.6e9</Gxz>
  <nuxy>0.4</nuxy>
  <nuyz>0.5</nuyz>
  <nuxz>0.45</nuxz>
</Material>)";

  double density = 0;
  double nu_xy = absent, nu_yz = absent, nu_xz = absent, nu_yx = absent, nu_zy = absent, nu_zx = absent;
  double Ex = 0, Ey = 0, Ez = 0, Gxy = 0, Gyz = 0, Gxz = 0;
  OrthotropicElasticity elastic;

  template <class Law>
  static auto parameters_of() {
    using P = Parameter<Law>;
    const auto stress = Dimension::stress;
    const auto ratio = [](const char* key, double Law::*member, const char* meaning) {
      return P{key, member, Dimension::none, any_value, meaning, {}, true};
    };
    return std::array{
        P{"rho", &Law::density, Dimension::density, positive, "mass density before deformation"},
        P{"Ex", &Law::Ex, stress, positive, "Young's modulus along the first axis", {}, false, "ER"},
        P{"Ey", &Law::Ey, stress, positive, "Young's modulus along the second axis", {}, false, "EZ"},
        P{"Ez", &Law::Ez, stress, positive, "Young's modulus along the third axis", {}, false, "ET"},
        P{"Gxy", &Law::Gxy, stress, positive, "shear modulus between x and y", {}, false, "Gyx"},
        P{"Gyz", &Law::Gyz, stress, positive, "shear modulus between y and z", {}, false, "Gzy"},
        P{"Gxz", &Law::Gxz, stress, positive, "shear modulus between x and z", {}, false, "Gzx"},
        ratio("nuxy", &Law::nu_xy, "contraction along y divided by extension along x; or nuyx"),
        ratio("nuyz", &Law::nu_yz, "contraction along z divided by extension along y; or nuzy"),
        ratio("nuxz", &Law::nu_xz, "contraction along z divided by extension along x; or nuzx"),
        ratio("nuyx", &Law::nu_yx, "contraction along x divided by extension along y, nuxy Ey/Ex; instead of nuxy"),
        ratio("nuzy", &Law::nu_zy, "contraction along y divided by extension along z, nuyz Ez/Ey; instead of nuyz"),
        ratio("nuzx", &Law::nu_zx, "contraction along x divided by extension along z, nuxz Ez/Ex; instead of nuxz"),
    };
  }

  void prepare(const Statement& statement, Problems& problems) {
    const auto either = [&](double there, double back, double E_there, double E_back, const char* names) {
      if (given(there) == given(back))
        problems.add(statement.origin, std::string("give ") + names + ", and only one of them");
      return given(there) ? there : given(back) ? back * E_there / E_back : 0.0;
    };
    OrthotropicConstants all{Ex, Ey, Ez, Gyz, Gxz, Gxy, 0, 0, 0};
    all.nu_xy = either(nu_xy, nu_yx, Ex, Ey, "<nuxy> or <nuyx>");
    all.nu_yz = either(nu_yz, nu_zy, Ey, Ez, "<nuyz> or <nuzy>");
    all.nu_xz = either(nu_xz, nu_zx, Ex, Ez, "<nuxz> or <nuzx>");
    elastic = {all, statement, problems};
  }
};

}  // namespace

Catalogue<Material>::Item orthotropic() { return material_law<OrthotropicLaw<OrthotropicParameters>>(); }

}  // namespace tribo
