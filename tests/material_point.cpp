// SPDX-License-Identifier: MIT
#include "material_point.hpp"

#include <Eigen/QR>

#include <algorithm>
#include <cmath>

namespace tribo::test {

namespace {

// Logarithm by inverse scaling: square roots (Denman-Beavers iteration) until the matrix is close to the identity, then
// log A = 2 artanh((A - 1) (A + 1)^-1). Eigen's function does the same for any size and takes half a minute to compile.
Mat3 logarithm(Mat3 a) {
  const Mat3 identity = Mat3::Identity();
  double scale = 2.0;
  for (; (a - identity).norm() > 0.1; scale *= 2.0) {
    Mat3 root = a, inverse_root = identity;
    for (int k = 0; k < 12; ++k) {  // the number of right digits doubles with each
      const Mat3 next = 0.5 * (root + inverse_root.inverse());
      inverse_root = (0.5 * (inverse_root + root.inverse())).eval();
      root = next;
    }
    a = root;
  }
  const Mat3 z = (a - identity) * (a + identity).inverse(), z2 = z * z;
  Mat3 power = z, sum = z;
  for (int k = 3; power.norm() > 1e-20; k += 2) {
    power = (power * z2).eval();
    sum += power / k;
  }
  return scale * sum;
}

}  // namespace

Mat3 exponential(const Mat3& m) {
  const int halvings = std::max(0, std::ilogb(m.norm()) + 2);  // the series then converges in some fifteen terms
  const Mat3 small = m * std::ldexp(1.0, -halvings);
  Mat3 term = Mat3::Identity(), sum = term;
  for (int k = 1; term.norm() > 1e-20; ++k) {
    term = (term * small / k).eval();
    sum += term;
  }
  for (int k = 0; k < halvings; ++k) sum = (sum * sum).eval();
  return sum;
}

template <int Dim>
void MaterialPoint<Dim>::step(const Mat3& gradient, double dt) {
  const Mat3 before = stress;
  const double J_before = F.determinant();
  L = gradient;
  const Mat3 increment = exponential(L * dt);
  F = increment * F;
  volume = F.determinant();
  update(dt);
  work += 0.5 * dt * ((before * J_before + stress * F.determinant()).cwiseProduct(L)).sum();
}

template <int Dim>
void MaterialPoint<Dim>::deform(const Mat3& target) {
  const Mat3 rate = logarithm(target * F.inverse());
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
