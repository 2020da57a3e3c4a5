// SPDX-License-Identifier: MIT
/// What the Mohr-Coulomb tests share: the law of the published simple-shear case and loops over steps.
#pragma once

#include "material_point.hpp"

#include <numbers>

namespace tribo::test {

inline constexpr double degree = std::numbers::pi / 180;

/// K = G = 200 MPa, c = 1 MPa, phi = 30 deg, psi = 0, with changes.
inline std::unique_ptr<Material> published(const Properties& changes = {}) {
  Properties p{{"rho", "2000"}, {"K", "200e6"}, {"G", "200e6"}, {"cohesion", "1e6"}, {"friction", "30"}};
  for (const auto& change : changes) {
    const auto old = std::find_if(p.begin(), p.end(), [&](const auto& q) { return q.first == change.first; });
    if (old == p.end())
      p.push_back(change);
    else
      *old = change;
  }
  return make_material("MohrCoulomb", p);
}

/// The velocity gradient of simple shear, without its rotation.
inline Mat3 pure_shear(double rate) { return symmetric(0, 0, 0, 0.5 * rate); }
/// The velocity gradient of simple shear.
inline Mat3 simple_shear(double rate) {
  Mat3 L = Mat3::Zero();
  L(0, 1) = rate;
  return L;
}

/// `count` equal steps.
template <int Dim>
void march(MaterialPoint<Dim>& point, const Mat3& L, double dt, int count) {
  for (int n = 0; n < count; ++n) point.step(L, dt);
}

}  // namespace tribo::test
