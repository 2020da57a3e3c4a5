// SPDX-License-Identifier: MIT
#include "drive/solve.hpp"

#include <Eigen/QR>
#include <algorithm>

namespace tribo {

bool solve(const std::function<Eigen::VectorXd(const Eigen::VectorXd&)>& miss, const std::function<double()>& tolerance,
           Eigen::VectorXd& x, double fine) {
  const Eigen::Index n = x.size();
  Eigen::VectorXd f = miss(x);
  if (n == 0) return true;
  const auto size = [](const Eigen::VectorXd& v) { return v.allFinite() ? v.cwiseAbs().maxCoeff() : 1e300; };
  for (int iteration = 0; iteration < 60 && size(f) > 1e-3 * tolerance(); ++iteration) {
    Eigen::MatrixXd slope(n, n);
    for (Eigen::Index k = 0; k < n; ++k) {
      Eigen::VectorXd beside = x;
      const double by = std::max(fine, 1e-4 * std::abs(x[k]));
      beside[k] += by;
      slope.col(k) = (miss(beside) - f) / by;
    }
    Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> rows;
    rows.setThreshold(1e-5);
    const Eigen::VectorXd step = rows.compute(slope).solve(-f);
    double share = 1.0;
    Eigen::VectorXd there = miss(x + step);
    while (size(there) >= size(f) && share > 1e-4) share *= 0.5, there = miss(x + share * step);
    if (size(there) >= size(f)) break;
    x += share * step, f = there;
  }
  f = miss(x);
  return size(f) <= tolerance();
}

}  // namespace tribo
