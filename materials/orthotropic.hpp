// SPDX-License-Identifier: MIT
/// Common parts of elastic laws with material axes: stiffness along the axes, stress and energy.
///
///   sigma = F A S A^T F^T / J,     S = C : E,     E = (A^T F^T F A - 1)/2
///
/// with the material axes as columns of A: the orthotropic Saint Venant-Kirchhoff solid. It is exact for any rotation
/// and has a stored energy. The axes are given for the undeformed body, rotated about z by the angle of the body, and
/// move with the material. Valid for strains of some per cent: the force has its maximum at compression to 0.58 of the
/// length. Bonet & Wood, Nonlinear Continuum Mechanics (2008), 6.5.
#pragma once

#include "materials/material.hpp"

#include <string>

namespace tribo {

/// Moduli along three axes and between them [stress]. nu_ij: contraction along j divided by extension along i.
struct OrthotropicConstants {
  double Ex = 0, Ey = 0, Ez = 0, Gyz = 0, Gxz = 0, Gxy = 0, nu_xy = 0, nu_yz = 0, nu_xz = 0;
};

/// Stiffness along the material axes.
class OrthotropicElasticity {
 public:
  OrthotropicElasticity() = default;
  /// Reports a problem at the statement if the stiffness is not positive definite.
  OrthotropicElasticity(const OrthotropicConstants& c, const Statement& statement, Problems& problems);

  /// Second Piola-Kirchhoff stress of a Green strain, both in material axes.
  Mat3 stress(const Mat3& strain) const;
  /// Stored energy per initial volume of a Green strain [stress].
  double energy(const Mat3& strain) const { return 0.5 * stress(strain).cwiseProduct(strain).sum(); }
  /// Largest rho c^2 of any wave in any direction in the reference state [stress].
  double wave_modulus() const { return wave_modulus_; }

 private:
  Mat3 normal_ = Mat3::Zero();  // of xx, yy, zz
  Vec3 shear_ = Vec3::Zero();   // of yz, xz, xy
  double wave_modulus_ = 0.0;
};

/// Law for one point, from a parameter struct with a member `OrthotropicElasticity elastic`.
template <class Parameters>
struct OrthotropicLaw : Parameters {
  struct State {
    double angle = 0.0;  // of the axes about z, before deformation [rad]
  };
  static auto history() { return std::tuple{StateVariable<State>{material_angle, Dimension::none, &State::angle}}; }
  static auto parameters() { return Parameters::template parameters_of<OrthotropicLaw>(); }

  double wave_modulus() const { return this->elastic.wave_modulus(); }
  // J times the acoustic tensor is (S : N N) m.m + (C of F) with N = F^T n. It is at most l^2 ((l^2 - 1)/2 + l^2) times
  // the modulus of the reference state, l the largest stretch. The row sums of F^T F bound l^2.
  double wave_modulus(const Mat3& F, const Mat3&, const State&) const {
    const double square = std::max(1.0, (F.transpose() * F).cwiseAbs().rowwise().sum().maxCoeff());
    return wave_modulus() * square * (1.5 * square - 0.5) / F.determinant();
  }
  Mat3 stress(const Motion& motion, const Mat3&, State& state) const {
    const double J = motion.F.determinant();
    if (!(J > 0))
      throw SimulationError(std::string(Parameters::name) +
                            ": the deformation gradient of a particle is singular or inverted (det F <= 0)");
    const Mat3 FA = motion.F * axes(state);
    return FA * this->elastic.stress(green(FA)) * FA.transpose() / J;
  }
  double energy_density(const Mat3& F, const Mat3&, const State& state) const {
    return this->elastic.energy(green(F * axes(state))) / F.determinant();
  }

 private:
  static Mat3 axes(const State& state) { return Eigen::AngleAxisd(state.angle, Vec3::UnitZ()).toRotationMatrix(); }
  static Mat3 green(const Mat3& FA) { return 0.5 * (FA.transpose() * FA - Mat3::Identity()); }
};

/// Parameters of a solid with one axis of symmetry, `Axis` (1: y, 2: z) of the body.
template <int Axis>
struct Transverse {
  static constexpr std::string_view name = Axis == 2 ? "Transverse1" : "Transverse2";
  static constexpr std::string_view summary = Axis == 2 ? "Transversely isotropic elastic solid, axial direction z."
                                                        : "Transversely isotropic elastic solid, axial direction y.";
  static constexpr int number = Axis == 2 ? 2 : 3;
  static constexpr std::string_view example = Axis == 2 ? R"(
<Material Type='Transverse1' Name='carbon'>
  <rho>1600</rho>
  <EA>140e9</EA>
  <ET>9e9</ET>
  <GA>5e9</GA>
  <nuA>0.3</nuA>
  <nuT>0.45</nuT>
</Material>)"
                                                        : R"(
<Material Type='Transverse2' Name='carbon'>
  <rho>1600</rho>
  <EA>140e9</EA>
  <ET>9e9</ET>
  <GA>5e9</GA>
  <nuA>0.3</nuA>
  <nuT>0.45</nuT>
</Material>)";

  double density = 0, EA = 0, ET = 0, GA = 0, nu_A = 0, nu_T = 0;
  OrthotropicElasticity elastic;

  template <class Law>
  static auto parameters_of() {
    using P = Parameter<Law>;
    return std::array{
        P{"rho", &Law::density, Dimension::density, positive, "mass density before deformation"},
        P{"EA", &Law::EA, Dimension::stress, positive, "Young's modulus along the axial direction"},
        P{"ET", &Law::ET, Dimension::stress, positive, "Young's modulus in the isotropic plane"},
        P{"GA", &Law::GA, Dimension::stress, positive,
          "shear modulus between the axial direction and the isotropic plane"},
        P{"nuA", &Law::nu_A, Dimension::none, any_value,
          "contraction in the isotropic plane divided by axial extension"},
        P{"nuT", &Law::nu_T, Dimension::none, between(-1.0, 1.0), "Poisson's ratio in the isotropic plane"},
    };
  }
  void prepare(const Statement& statement, Problems& problems) {
    const double GT = ET / (2 * (1 + nu_T)), nu_TA = nu_A * ET / EA;
    elastic = {Axis == 2 ? OrthotropicConstants{ET, ET, EA, GA, GA, GT, nu_T, nu_TA, nu_TA}
                         : OrthotropicConstants{ET, EA, ET, GA, GT, GA, nu_TA, nu_A, nu_T},
               statement, problems};
  }
};

}  // namespace tribo
