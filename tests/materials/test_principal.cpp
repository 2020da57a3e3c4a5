// SPDX-License-Identifier: MIT
#include "materials/principal.hpp"

#include <Eigen/Eigenvalues>
#include <catch2/catch.hpp>
#include <random>

using namespace tribo;

namespace {

Mat3 random_rotation(std::mt19937& random) {
  std::normal_distribution<double> normal;
  Eigen::Vector4d q(normal(random), normal(random), normal(random), normal(random));
  q.normalize();
  const double w = q[0], x = q[1], y = q[2], z = q[3];
  Mat3 R;
  R << 1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y), 2 * (x * y + w * z), 1 - 2 * (x * x + z * z),
      2 * (y * z - w * x), 2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y);
  return R;
}

// Largest error of values, of orthonormality and of the tensor put together again, relative to the tensor.
double error_of(const Mat3& s) {
  const Principal p = principal(s);
  const Eigen::SelfAdjointEigenSolver<Mat3> reference(s);
  Mat3 axes, again = Mat3::Zero();
  double worst = 0;
  for (int k = 0; k < 3; ++k) {
    const auto& n = p.axis[static_cast<std::size_t>(k)];
    axes.col(k) = Vec3(n[0], n[1], n[2]);
    again += p.value[static_cast<std::size_t>(k)] * axes.col(k) * axes.col(k).transpose();
    worst = std::max(worst, std::abs(p.value[static_cast<std::size_t>(k)] - reference.eigenvalues()(k)) / s.norm());
  }
  worst = std::max(worst, (again - s).norm() / s.norm());
  return std::max(worst, (axes.transpose() * axes - Mat3::Identity()).norm());
}

}  // namespace

TEST_CASE("principal values and axes are exact to round-off, however close the values", "[materials]") {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(-1, 1);
  double worst = 0;
  for (int k = 0; k < 200000; ++k) {
    const double gap = std::pow(10.0, -8.5 + 8.5 * uniform(random));  // 1e-17 ... 1
    const double gap2 = std::pow(10.0, -8.5 + 8.5 * uniform(random));
    const double first = uniform(random);
    const double size = std::pow(10.0, 9 * uniform(random));
    const Mat3 R = random_rotation(random);
    const Vec3 values = size * Vec3(first, first + gap, k % 2 ? first + gap2 : uniform(random));
    const Mat3 s = R * values.asDiagonal() * R.transpose();
    worst = std::max(worst, error_of(0.5 * (s + s.transpose())));
  }
  REQUIRE(worst < 3e-15);
}

TEST_CASE("principal values of axis-parallel, isotropic and vanishing tensors come out sorted", "[materials]") {
  REQUIRE(error_of(Vec3(3, -2, 1).asDiagonal().toDenseMatrix()) < 2e-15);
  REQUIRE(error_of(Vec3(-1, -1, 5).asDiagonal().toDenseMatrix()) < 2e-15);
  REQUIRE(error_of(Vec3(5, -1, 5).asDiagonal().toDenseMatrix()) < 2e-15);
  REQUIRE(error_of(Vec3(7, 7, 7).asDiagonal().toDenseMatrix()) < 2e-15);
  const Principal nothing = principal(Mat3::Zero());
  REQUIRE(nothing.value == Triple{0, 0, 0});
  REQUIRE(nothing.axis[2] == Triple{0, 0, 1});
}

TEST_CASE("the separate root of the cubic needs no third Newton step", "[materials]") {
  for (int k = 0; k <= 1000; ++k) {
    const double r = k / 1000.0;
    REQUIRE(std::abs(separate_root(r) - 2 * std::cos(std::acos(r) / 3)) < 2e-15);
  }
}
