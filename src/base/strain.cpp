// SPDX-License-Identifier: MIT
#include "base/strain.hpp"

#include <Eigen/Eigenvalues>

namespace tribo {
namespace {

struct Stretch {
  Vec3 values;
  Mat3 axes;
};

// V = sqrt(F F^T)
Stretch left_stretch(const Mat3& F) {
  const Eigen::SelfAdjointEigenSolver<Mat3> solver(Mat3(F * F.transpose()));
  return {solver.eigenvalues().cwiseMax(0.0).cwiseSqrt(), solver.eigenvectors()};
}

}  // namespace

Mat3 biot_strain(const Mat3& F) {
  const Stretch V = left_stretch(F);
  return V.axes * (V.values - Vec3::Ones()).asDiagonal() * V.axes.transpose();
}

Vec3 rotation_of(const Mat3& F) {
  const Stretch V = left_stretch(F);
  if (!(V.values.minCoeff() > 0)) return Vec3::Zero();
  const Mat3 R = V.axes * V.values.cwiseInverse().asDiagonal() * V.axes.transpose() * F;
  const Eigen::AngleAxisd turn(R);
  return turn.angle() * turn.axis();
}

}  // namespace tribo
