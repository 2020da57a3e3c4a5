// SPDX-License-Identifier: MIT
#include "materials/material.hpp"

namespace tribo {
namespace {

/// Stress that the law gives for a small strain from the reference state.
Mat3 stress_of(const Material& law, const Mat3& strain) {
  Mat3 F = Mat3::Identity() + strain;
  constexpr double dt = 1e-12;
  Mat3 L = strain / dt;
  std::array<double, 6> stress{};
  std::vector<double> history;
  for (const auto& h : law.history()) history.push_back(h.initial);
  std::vector<double*> columns;
  for (double& h : history) columns.push_back(&h);
  const double mass = law.density();
  double volume = F.determinant();
  MaterialPoints<3> point;
  point.count = 1, point.dt = dt, point.mass = &mass, point.volume = &volume, point.history = columns;
  for (std::size_t k = 0; k < 9; ++k) {
    const auto [row, column] = Layout<3>::full_at[k];
    point.L[k] = &L(row, column), point.F[k] = &F(row, column);
  }
  for (std::size_t k = 0; k < 6; ++k) point.stress[k] = &stress[k];
  law.update(point);
  return load_symmetric<3>(point.stress, 0);
}

}  // namespace

std::optional<ElasticModuli> elastic_moduli(const Material& law) {
  if (law.rigid() || law.liquid()) return std::nullopt;
  // A strain far below any strength, and far above round-off
  constexpr double e = 1e-7;
  std::array<Mat3, 6> stress;
  for (int k = 0; k < 6; ++k) {
    Mat3 strain = Mat3::Zero();
    strain(k % 3, (k % 3 + k / 3) % 3) = strain((k % 3 + k / 3) % 3, k % 3) = e;
    stress[static_cast<std::size_t>(k)] = stress_of(law, strain) / e;
  }
  const double lambda = stress[0](1, 1), two_G = stress[0](0, 0) - lambda;
  if (!(two_G > 0)) return std::nullopt;
  constexpr double same = 1e-4;
  for (int k = 0; k < 6; ++k) {
    const int i = k % 3, j = (i + k / 3) % 3;
    Mat3 isotropic = Mat3::Zero();
    if (i == j)
      isotropic = lambda * Mat3::Identity(), isotropic(i, i) += two_G;
    else
      isotropic(i, j) = isotropic(j, i) = two_G;
    if ((stress[static_cast<std::size_t>(k)] - isotropic).norm() > same * (two_G + std::abs(lambda)))
      return std::nullopt;
  }
  const double nu = lambda / (2 * lambda + two_G);
  return ElasticModuli{0.5 * two_G, nu};
}

}  // namespace tribo
