// SPDX-License-Identifier: MIT
#include "base/strain.hpp"

#include <catch2/catch.hpp>

using namespace tribo;

TEST_CASE("Biot strain and rotation decompose a deformation gradient", "[strain]") {
  const Vec3 turn(0.3, -0.7, 0.5);
  const Mat3 R = Eigen::AngleAxisd(turn.norm(), turn.normalized()).toRotationMatrix();
  Mat3 V;
  V << 1.2, 0.05, 0.1, 0.05, 0.9, -0.02, 0.1, -0.02, 1.05;
  const Mat3 F = V * R;
  CHECK((biot_strain(F) - (V - Mat3::Identity())).norm() < 1e-14);
  CHECK((rotation_of(F) - turn).norm() < 1e-14);
  CHECK(biot_strain(R).norm() < 1e-14);
  CHECK(rotation_of(V).norm() < 1e-12);
}

TEST_CASE("strain and rotation of simple shear agree with the closed form", "[strain]") {
  // V = [2 + g^2, g; g, 2] / sqrt(4 + g^2), tan(angle) = g/2, clockwise
  const double g = 0.8, root = std::sqrt(4 + g * g);
  Mat3 F = Mat3::Identity();
  F(0, 1) = g;
  const Mat3 e = biot_strain(F);
  CHECK(e(0, 0) == Approx((2 + g * g) / root - 1).epsilon(1e-14));
  CHECK(e(1, 1) == Approx(2 / root - 1).epsilon(1e-14));
  CHECK(e(0, 1) == Approx(g / root).epsilon(1e-14));
  CHECK(std::abs(e(2, 2)) < 1e-15);
  CHECK(rotation_of(F)[2] == Approx(-std::atan(g / 2)).epsilon(1e-14));
}
