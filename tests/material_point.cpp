// SPDX-License-Identifier: MIT
#include "material_point.hpp"

#include <Eigen/Dense>
#include <unsupported/Eigen/MatrixFunctions>

namespace tribo::test {

Mat3 exponential(const Mat3& m) { return m.exp(); }

template <int Dim>
void MaterialPoint<Dim>::step(const Mat3& gradient, double dt) {
  const Mat3 before = stress;
  const double J_before = F.determinant();
  L = gradient;
  const Mat3 increment = (L * dt).eval().exp();
  F = increment * F;
  volume = F.determinant();
  update(dt);
  work += 0.5 * dt * ((before * J_before + stress * F.determinant()).cwiseProduct(L)).sum();
}

template <int Dim>
void MaterialPoint<Dim>::deform(const Mat3& target) {
  const Mat3 rate = (target * F.inverse()).eval().log();
  step(rate, 1.0);
  F = target;
  volume = F.determinant();
}

template <int Dim>
void MaterialPoint<Dim>::step_mixed(Mat3 gradient, double dt, const std::vector<int>& free, const Mat3& target,
                                    double tolerance) {
  const MaterialPoint start = *this;
  const auto n = static_cast<Eigen::Index>(free.size());
  Eigen::VectorXd x(n);
  for (Eigen::Index k = 0; k < n; ++k)
    x(k) = gradient(free[static_cast<std::size_t>(k)], free[static_cast<std::size_t>(k)]);
  const auto residual = [&](const Eigen::VectorXd& rates) {
    *this = start;
    Eigen::VectorXd r(n);
    for (Eigen::Index k = 0; k < n; ++k) {
      const int a = free[static_cast<std::size_t>(k)];
      gradient(a, a) = rates(k);
    }
    step(gradient, dt);
    for (Eigen::Index k = 0; k < n; ++k) {
      const int a = free[static_cast<std::size_t>(k)];
      r(k) = stress(a, a) - target(a, a);
    }
    return r;
  };
  Eigen::VectorXd r = residual(x);
  for (int iteration = 0; iteration < 60; ++iteration) {
    if (r.cwiseAbs().maxCoeff() <= tolerance) return;
    Eigen::MatrixXd jacobian(n, n);
    for (Eigen::Index k = 0; k < n; ++k) {
      Eigen::VectorXd y = x;
      const double h = 1e-7 / dt;
      y(k) += h;
      jacobian.col(k) = (residual(y) - r) / h;
    }
    const Eigen::VectorXd change = -jacobian.completeOrthogonalDecomposition().solve(r);
    double share = 1.0;
    for (;; share *= 0.5) {
      const Eigen::VectorXd trial = residual(x + share * change);
      if (trial.norm() < r.norm() || share < 1e-3) {
        x += share * change;
        r = trial;
        break;
      }
    }
  }
  throw std::runtime_error("the prescribed stress was not reached");
}

template class MaterialPoint<2>;
template class MaterialPoint<3>;

}  // namespace tribo::test
