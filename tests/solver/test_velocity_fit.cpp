// SPDX-License-Identifier: MIT
/// Weights of nodal velocities at the faces of joints.

#include "solver/joints/velocity_fit.hpp"

#include <catch2/catch.hpp>

using namespace tribo;

namespace {

/// Nodes of a lattice of 3 x 3 around a point. The upper row, at 1.3 cells above the point, has the mass `light`.
std::vector<FitNode<2>> lattice(double light) {
  std::vector<FitNode<2>> nodes;
  for (int j = 0; j < 3; ++j)
    for (int i = 0; i < 3; ++i) nodes.push_back({Vec<2>(i - 1.2, j - 0.7), 0.1 + 0.05 * i, j == 2 ? light : 1.0});
  return nodes;
}

double largest(const std::vector<FitNode<2>>& nodes) {
  double out = 0.0;
  for (const auto& node : nodes) out = std::max(out, node.weight * node.weight / node.mass);
  return out;
}

}  // namespace

TEST_CASE("the fit of a face reproduces linear velocities", "[joints]") {
  auto nodes = lattice(0.03);
  GENERATE(0, 1) == 0 ? fit_face_velocity(nodes, light_at_joints) : fit_aligned_face_velocity(nodes, 1);
  const Vec<2> v(0.3, -0.2);
  Mat<2> gradient;
  gradient << 0.1, 0.7, -0.4, 0.2;
  Vec<2> velocity = Vec<2>::Zero();
  Mat<2> slope = Mat<2>::Zero();
  for (const auto& node : nodes) {
    const Vec<2> at_node = v + gradient * node.offset;
    velocity += node.weight * at_node, slope += at_node * node.slope.transpose();
  }
  CHECK((velocity - v).norm() < 1e-4);
  CHECK((slope - gradient).norm() < 1e-4);
}

TEST_CASE("nodes with next to no mass do not determine the velocity of a face", "[joints]") {
  const bool aligned = GENERATE(false, true);
  for (const double light : {1e-2, 1e-4, 1e-8, 1e-14}) {
    auto nodes = lattice(light);  // two rows of mass 1, one of none
    aligned ? fit_aligned_face_velocity(nodes, 1) : fit_face_velocity(nodes, light_at_joints);
    CHECK(largest(nodes) < 200);
    std::erase_if(nodes, [](const auto& node) { return node.offset[1] < -0.5; });  // one of each
    aligned ? fit_aligned_face_velocity(nodes, 1) : fit_face_velocity(nodes, light_at_joints);
    CHECK(largest(nodes) < 200);
    double sum = 0.0;
    for (const auto& node : nodes) sum += node.weight;
    CHECK(sum == Approx(1));
  }
}

TEST_CASE("at a face in a grid plane, light planes of nodes count as their shape functions, light ends do not",
          "[joints]") {
  // A quadratic spline at a node. The rows have the masses 1, 1 and `plane`, the columns these times 1, 1 and `end`.
  const auto fitted = [](double plane, double end) {
    std::vector<FitNode<2>> nodes;
    for (int j = 0; j < 3; ++j)
      for (int i = 0; i < 3; ++i)
        nodes.push_back({Vec<2>(i - 1, j - 1), (i == 1 ? 0.75 : 0.125) * (j == 1 ? 0.75 : 0.125),
                         (j == 2 ? plane : 1.0) * (i == 2 ? end : 1.0)});
    fit_aligned_face_velocity(nodes, 1);
    double top = 0.0, right = 0.0;
    for (const auto& node : nodes) {
      if (node.offset[1] > 0.5) top += node.weight;
      if (node.offset[0] > 0.5) right += node.weight;
    }
    return std::pair{top, right};
  };
  CHECK(fitted(0.02, 1).first == Approx(0.125).epsilon(1e-3));
  CHECK(fitted(1, 0.02).second < 0.11);
  CHECK(fitted(1e-9, 1).first < 0.01);  // limits the step
}
