// SPDX-License-Identifier: MIT
/// Velocity and velocity gradient at a face from the nodal velocities on one side of it.
#pragma once

#include "base/types.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace tribo {

/// A node of a fit.
template <int Dim>
struct FitNode {
  Vec<Dim> offset;                    ///< from the point of the fit                         [cells]
  double shape = 0.0;                 ///< shape function at the point, shared by the fields of the node
  double mass = 0.0;                  ///< over the mean mass of the nodes
  double weight = 0.0;                ///< result: of the nodal velocity in the velocity at the point
  Vec<Dim> slope = Vec<Dim>::Zero();  ///< result: of the nodal velocity in the gradient     [1/cells]
};

/// Sets the weights of a least-squares fit of a linear velocity, so that rigid motions are reproduced. Nodes with less
/// than a tenth of the mean mass count as its power `exponent`. `regularisation`: variance of positions [cells^2] below
/// which the gradient along a direction tends to zero.
template <int Dim>
void fit_velocity(std::vector<FitNode<Dim>>& nodes, double exponent, double regularisation) {
  constexpr double light = 0.1;
  double total = 0.0;
  Vec<Dim> mean = Vec<Dim>::Zero();
  for (FitNode<Dim>& node : nodes) {
    node.weight = node.shape * std::min(1.0, std::pow(node.mass / light, exponent));
    total += node.weight, mean += node.weight * node.offset;
  }
  mean /= total;
  Mat<Dim> variance = regularisation * Mat<Dim>::Identity();
  for (const FitNode<Dim>& node : nodes)
    variance += node.weight / total * (node.offset - mean) * (node.offset - mean).transpose();
  const Mat<Dim> inverse = variance.inverse();
  for (FitNode<Dim>& node : nodes) {
    node.slope = node.weight / total * (inverse * (node.offset - mean));
    node.weight = node.weight / total - node.slope.dot(mean);
  }
}

/// The fit of a face of a joint. Usually light nodes count as the root of their mass. Where nodes with next to no mass
/// would determine the gradient, joint forces on them would need a minute time step; then they count as the square of
/// their mass, and the gradient they would determine tends to zero.
template <int Dim>
void fit_face_velocity(std::vector<FitNode<Dim>>& nodes) {
  constexpr double largest = 200.0;  // square of a weight over the mass; light nodes of smooth faces have up to 90
  fit_velocity(nodes, 0.5, 1e-5);
  if (std::any_of(nodes.begin(), nodes.end(),
                  [](const FitNode<Dim>& node) { return node.weight * node.weight > largest * node.mass; }))
    fit_velocity(nodes, 2.0, 0.01);
}

}  // namespace tribo
