// SPDX-License-Identifier: MIT
/// Parameters of the Mohr-Coulomb law and what one point does with a principal trial stress.
#pragma once

#include "materials/elastic_constants.hpp"
#include "materials/mohr_coulomb_return.hpp"

namespace tribo {

struct MohrCoulombState {
  double plastic_shear = 0;   ///< kappa: path length of sqrt(e:e/2), e the deviatoric plastic strain
  double plastic_volume = 0;  ///< trace of the plastic strain, positive: dilation
  double tension_strain = 0;  ///< kappa_t: plastic volume strain of the tension cut-off
  double dissipation = 0;     ///< plastic work per initial volume [stress]
  double opening = 0;         ///< volume strain by which the tension planes have opened and not closed again
};

struct MohrCoulombLaw {
  static constexpr std::string_view name = "MohrCoulomb";
  static constexpr std::string_view summary =
      "Elastic-plastic or viscoplastic frictional solid of Mohr-Coulomb type, with dilation, tension cut-off and "
      "softening.";
  static constexpr int number = 0;
  static constexpr std::string_view needs =
      "E and nu, or K and G. If one of cohesion_residual, friction_residual, dilation_residual and tension_residual is "
      "given, also softening_end; with softening_end at least one of these four";
  static constexpr std::string_view example = R"(
<Material Type='MohrCoulomb' Name='clay'>
  <rho>1900</rho>
  <E>40e6</E>
  <nu>0.3</nu>
  <cohesion>20e3</cohesion>
  <friction>25</friction>
  <dilation>0</dilation>
  <cohesion_residual>5e3</cohesion_residual>
  <softening_end>0.1</softening_end>
</Material>)";

  double density = 0;
  double young_modulus = absent, poisson_ratio = absent, bulk_modulus = absent, shear_modulus = absent;
  double cohesion = 0, friction = 0, dilation = 0, tension = absent;
  double relaxation_time = 0, viscosity = 0;
  double cohesion_residual = absent, friction_residual = absent, dilation_residual = absent, tension_residual = absent;
  double softening_start = 0, softening_end = absent;

  static std::array<Parameter<MohrCoulombLaw>, 17> parameters();
  void prepare(const Statement& statement, Problems& problems);
  /// Divides the strength by `factor`, see Material::weakened.
  void weaken(double factor);

  /// Strength after the plastic shear kappa and the tension strain kappa_t.
  Strength strength(double kappa, double kappa_t) const;
  bool softens() const { return softens_; }
  /// The yield surface before softening.
  const Pyramid& pyramid() const { return *pyramid_; }

  /// Without cohesion, closes what is open before it is pressed: a negative mean trial stress is reduced by the bulk
  /// modulus times the closing strain, at most state.opening, which is reduced by this strain. Returns the change to be
  /// added to the principal trial stresses. With cohesion there is no change: cracks stay open.
  Triple close(const Triple& trial, MohrCoulombState& state) const;
  /// Whether there is no cohesion, at any plastic strain.
  bool cohesionless() const { return cohesion == 0 && cohesion_residual == 0; }

  /// Viscoplastic flow in one step from a sorted principal trial stress beyond yield. Returns the change to be
  /// subtracted from the trial stress and advances the state. `J` is the volume ratio det F.
  Triple flow(const Triple& trial, double dt, double J, MohrCoulombState& state) const;

  /// Stress of one point as a tensor, with the trial stress of elastic_step.
  Mat3 stress(const Motion& motion, const Mat3& old, MohrCoulombState& state) const;

  Elasticity elastic;

 private:
  Strength limit(double c, double phi, double psi, double cut_off) const;
  Returned return_implicitly(const Triple& trial, double share, double drag, MohrCoulombState& state) const;
  void check_softening(const Statement& statement, Problems& problems);

  bool softens_ = false, angles_soften_ = false, tension_softens_ = false;
  std::optional<Pyramid> pyramid_;
};

}  // namespace tribo
