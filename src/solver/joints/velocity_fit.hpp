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

/// Sets the weights of a least-squares fit of a linear velocity, so that rigid motions are reproduced. `importance`:
/// weight of each node in the fit, a function of the node. `regularisation`: variance of positions [cells^2] below
/// which the gradient along a direction tends to zero.
template <int Dim, class F>
void fit_velocity(std::vector<FitNode<Dim>>& nodes, F&& importance, double regularisation) {
  double total = 0.0;
  Vec<Dim> mean = Vec<Dim>::Zero();
  for (FitNode<Dim>& node : nodes) {
    node.weight = importance(node);
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

/// The fit of a face of a joint. The weights are the shape functions wherever these reproduce linear velocities, except
/// for nodes with less than a fraction `light` of the mean mass, which count as the root of their mass. A joint force
/// then accelerates no node by more than 1/light times the mean, which limits the time step; the stress next to the
/// face is the more uniform the smaller the fraction. Where nodes with next to no mass still would determine the
/// gradient, it tends to zero.
template <int Dim>
void fit_face_velocity(std::vector<FitNode<Dim>>& nodes, double light) {
  const double largest = 20.0 / light;  // square of a weight over the mass; light nodes of smooth faces have 9/light
  fit_velocity(
      nodes, [&](const FitNode<Dim>& node) { return node.shape * std::min(1.0, std::sqrt(node.mass / light)); }, 1e-5);
  if (std::any_of(nodes.begin(), nodes.end(),
                  [&](const FitNode<Dim>& node) { return node.weight * node.weight > largest * node.mass; }))
    fit_velocity(
        nodes,
        [](const FitNode<Dim>& node) {
          const double share = std::min(1.0, node.mass / 0.1);
          return node.shape * share * share;
        },
        0.01);
}

}  // namespace tribo
