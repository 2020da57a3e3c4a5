// SPDX-License-Identifier: MIT
/// Finding the inputs that make a law answer as prescribed.
#pragma once

#include <Eigen/Core>
#include <functional>

namespace tribo {

/// Solves miss(x) = 0 from `x` on, each component to tolerance() of what miss was last called with, and leaves miss
/// called with the solution last; false if it does not get there. Newton's method with differences over `fine`, halved
/// steps, and the shortest step where some inputs do nothing (a stress on an edge of a yield surface moves with the sum
/// of two strains only).
bool solve(const std::function<Eigen::VectorXd(const Eigen::VectorXd&)>& miss, const std::function<double()>& tolerance,
           Eigen::VectorXd& x, double fine);

}  // namespace tribo
