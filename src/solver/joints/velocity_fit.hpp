// SPDX-License-Identifier: MIT
/// Velocity and velocity gradient at a face from the nodal velocities on one side of it.
#pragma once

#include "base/types.hpp"

#include <algorithm>
#include <array>
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

/// The root of x/whole, at most one. Most nodes are whole, and need no root.
inline double root_of_share(double x, double whole) { return x < whole ? std::sqrt(x / whole) : 1.0; }

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
  const double scale = 1 / total;
  mean *= scale;
  Mat<Dim> variance = regularisation * Mat<Dim>::Identity();
  for (FitNode<Dim>& node : nodes) {
    node.weight *= scale;
    const Vec<Dim> d = node.offset - mean, weighted = node.weight * d;
    for (int j = 0; j < Dim; ++j)
      for (int i = j; i < Dim; ++i) variance(i, j) += weighted[i] * d[j];
  }
  const Mat<Dim> inverse = Mat<Dim>(variance.template selfadjointView<Eigen::Lower>()).inverse();
  const Vec<Dim> middle = inverse * mean;
  for (FitNode<Dim>& node : nodes) {
    node.slope = node.weight * (inverse * node.offset - middle);
    node.weight -= node.slope.dot(mean);
  }
}

/// Nodes with less than this fraction of the mean mass count less in the fit of a face, as the root of their mass; no
/// node is then accelerated by more than 1/light times the mean.
inline constexpr double light_at_joints = 0.1, light_at_interfaces = 0.01;

/// Whether any node has more than this square of a weight over the mass, the mean mass being one. It would be
/// accelerated by a joint force so much more than others that it limits the time step.
template <int Dim>
bool exceeds(const std::vector<FitNode<Dim>>& nodes, double largest) {
  return std::any_of(nodes.begin(), nodes.end(),
                     [&](const FitNode<Dim>& node) { return node.weight * node.weight > largest * node.mass; });
}

/// The fit of a face of a joint. The weights are the shape functions wherever these reproduce linear velocities, except
/// for light nodes, see light_at_joints. Where nodes with next to no mass still would determine the gradient, it tends
/// to zero.
template <int Dim>
void fit_face_velocity(std::vector<FitNode<Dim>>& nodes, double light) {
  fit_velocity(
      nodes, [&](const FitNode<Dim>& node) { return node.shape * root_of_share(node.mass, light); }, 1e-5);
  if (!exceeds(nodes, 20.0 / light))  // light nodes of smooth faces come to 9/light
    return;
  fit_velocity(
      nodes,
      [](const FitNode<Dim>& node) {
        const double share = std::min(1.0, node.mass / 0.1);
        return node.shape * share * share;
      },
      0.01);
}

/// The fit of a face that lies in a grid plane normal to `axis`. The particles next to it are whole, so that the masses
/// of the nodes agree with their shape functions at the face: planes of nodes count in full however light they are,
/// and the stress next to the face is exact. Nodes beyond the ends of the face are light within their plane, and
/// count less. Where that would limit the time step, the fit is the one of any face.
template <int Dim>
void fit_aligned_face_velocity(std::vector<FitNode<Dim>>& nodes, int axis) {
  constexpr double next_to_nothing = 1e-5, largest = 20.0;
  // Planes of nodes are numbered from the one of the first node; the shape functions reach across six at most.
  constexpr int most = 6;
  std::array<double, 2 * most + 1> mean{}, shapes{};
  const auto plane_of = [&](const FitNode<Dim>& node) {
    return static_cast<std::size_t>(most + 0.5 + node.offset[axis] - nodes.front().offset[axis]);
  };
  for (const FitNode<Dim>& node : nodes)
    mean[plane_of(node)] += node.shape * node.mass, shapes[plane_of(node)] += node.shape;
  for (std::size_t k = 0; k < mean.size(); ++k)
    if (shapes[k] > 0) mean[k] /= shapes[k];
  fit_velocity(
      nodes,
      [&](const FitNode<Dim>& node) {
        const double plane = mean[plane_of(node)];
        return node.shape * root_of_share(plane, next_to_nothing) * root_of_share(node.mass, light_at_joints * plane);
      },
      1e-5);
  if (exceeds(nodes, largest)) fit_face_velocity(nodes, light_at_joints);
}

}  // namespace tribo
