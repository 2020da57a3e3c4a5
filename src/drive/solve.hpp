// SPDX-License-Identifier: MIT
/// Inputs of a law for a prescribed response.
#pragma once

#include <Eigen/Core>
#include <functional>

namespace tribo {

/// Solves miss(x) = 0 from `x` on, each component to tolerance() of what miss was last called with, and leaves miss
/// called with the solution last; false if it does not converge. Newton's method with differences over `fine`, halved
/// steps, and the shortest step where the derivative is singular (a stress on an edge of a yield surface moves with the
/// sum of two strains only).
bool solve(const std::function<Eigen::VectorXd(const Eigen::VectorXd&)>& miss, const std::function<double()>& tolerance,
           Eigen::VectorXd& x, double fine);

}  // namespace tribo
