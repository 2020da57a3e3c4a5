// SPDX-License-Identifier: MIT
/// Isotropic linear elasticity in rate form, for large rotations and small strains.
///
///   sigma(t+dt) = Q sigma Q^T + Q^(1/2) (C : D dt) Q^(1/2)T      D = sym(L), Q = exp(W dt), W = skew(L)
///
/// Jaumann rate, second order in dt and exactly objective for any rotation per step.
/// Simo & Hughes, Computational Inelasticity (1998), chapter 8. The law is hypoelastic: a closed cycle of large strain
/// does not return exactly to the initial stress, so it is meant for small elastic strains.

#include "materials/elastic.hpp"
#include "materials/material.hpp"

namespace tribo {
namespace {

struct LinearElasticParameters {
  static constexpr std::string_view name = "LinearElastic";
  static constexpr std::string_view summary =
      "Isotropic linear elastic solid with the Jaumann rate of stress, for large rotations.";
  static constexpr int number = 1;
  static constexpr std::string_view example = R"(
<Material Type='LinearElastic' Name='steel'>
  <rho>7850</rho>
  <E>210e9</E>
  <nu>0.3</nu>
</Material>)";

  double density = 0, young_modulus = 0, poisson_ratio = 0;
  Elasticity elastic;

  static auto parameters() {
    using P = Parameter<LinearElasticParameters>;
    return std::array{
        P{"rho", &LinearElasticParameters::density, Dimension::density, positive, "mass density before deformation"},
        P{"E", &LinearElasticParameters::young_modulus, Dimension::stress, positive, "Young's modulus"},
        P{"nu", &LinearElasticParameters::poisson_ratio, Dimension::none, between(-1.0, 0.5), "Poisson's ratio"},
    };
  }

  void prepare(const Statement&, Problems&) { elastic = Elasticity::young(young_modulus, poisson_ratio); }
};

class LinearElastic final : public Material {
 public:
  explicit LinearElastic(LinearElasticParameters p) : p_(p) {}
  void update(const MaterialPoints<2>& points) const override { elastic_step<2>(points, p_.elastic); }
  void update(const MaterialPoints<3>& points) const override { elastic_step<3>(points, p_.elastic); }
  double density() const override { return p_.density; }
  bool needs_deformation() const override { return false; }
  double wave_modulus() const override { return p_.elastic.wave_modulus(); }
  double stored_energy(const MaterialPoints<2>& points) const override { return stored<2>(points); }
  double stored_energy(const MaterialPoints<3>& points) const override { return stored<3>(points); }
  const std::vector<HistoryVariable>& history() const override {
    static const std::vector<HistoryVariable> none;
    return none;
  }

 private:
  template <int Dim>
  double stored(const MaterialPoints<Dim>& points) const {
    double sum = 0;
    for (int i = 0; i < points.count; ++i)
      sum += points.volume[i] * p_.elastic.energy(load_symmetric<Dim>(points.stress, i));
    return sum;
  }

  LinearElasticParameters p_;
};

}  // namespace

Catalogue<Material>::Item linear_elastic() {
  return material_law<LinearElasticParameters, LinearElastic>({"Isotropic"});
}

}  // namespace tribo
