// SPDX-License-Identifier: MIT
#include "materials/material.hpp"

namespace tribo {

bool keeps_stress(const Material& law) {
  if (law.rigid()) return false;
  // A pressure far below any yield stress.
  const double pressure = 1e-6 * law.wave_modulus();
  Mat3 L = Mat3::Zero(), F = Mat3::Identity();
  std::array<double, 6> stress{};
  std::vector<double> history;
  for (const auto& h : law.history()) history.push_back(h.initial);
  std::vector<double*> columns;
  for (double& h : history) columns.push_back(&h);
  const double mass = law.density();
  double volume = 1.0;
  MaterialPoints<3> point;
  point.count = 1, point.dt = 1e-12, point.mass = &mass, point.volume = &volume, point.history = columns;
  for (std::size_t k = 0; k < 9; ++k) {
    const auto [row, column] = Layout<3>::full_at[k];
    point.L[k] = &L(row, column), point.F[k] = &F(row, column);
  }
  for (std::size_t k = 0; k < 6; ++k) point.stress[k] = &stress[k];
  store_symmetric<3>(-pressure * Mat3::Identity(), point.stress, 0);
  law.update(point);
  return (load_symmetric<3>(point.stress, 0) + pressure * Mat3::Identity()).norm() < 1e-3 * pressure;
}

}  // namespace tribo
