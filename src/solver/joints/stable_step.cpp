// SPDX-License-Identifier: MIT
/// Stable time step of joints in the grid, and the masses of their dashpots.

#include "solver/joints/joints.hpp"

#include <algorithm>
#include <cmath>

namespace tribo {

// The leapfrog scheme is stable if the largest eigenvalue of M^-1/2 K M^-1/2 is below 4/dt^2; the largest row sum
// bounds this eigenvalue (Gershgorin).
template <int Dim>
void Joints<Dim>::find_stable_step() {
  const double largest =
      find_row_sums([](const Share& share) { return std::abs(share.weight) * std::sqrt(share.mobility); },
                    [](const SampleNodes& nodes) { return nodes.scaled_sum; });
  constexpr double share_of_limit = 0.5;
  stable_step_ = largest > 0 ? share_of_limit * 2 / std::sqrt(largest) : std::numeric_limits<double>::max();
  double ratio = 0.0;
  for (const auto& surface : system_.joints) ratio = std::max(ratio, surface.law->damping_ratio());
  if (ratio > 0) stable_step_ = std::min(stable_step_, share_of_limit * find_masses(ratio));
}

// Row sums of a matrix of the stiffnesses of all joints at each node, whose entry for two nodes of a joint is
// kA row(node) column(other node); `sum_of_columns` is the sum of the second factor over the nodes of an integration
// point. Returns the largest one.
template <int Dim>
template <class Row, class Column>
double Joints<Dim>::find_row_sums(const Row& row, const Column& sum_of_columns) {
  for (std::size_t s = 0; s < surfaces_.size(); ++s) {
    Surface& surface = surfaces_[s];
    const auto& joints = system_.joints[s].joints;
    surface.row.resize(joints.size());
    each_joint(s, [&](std::size_t joint) {
      double sum = 0.0;
      each_contribution(s, joint,
                        [&](const SampleNodes& nodes, double fraction) { sum += fraction * sum_of_columns(nodes); });
      surface.row[joint] = std::max(joints[joint].kn, joints[joint].ks) * joints[joint].area * sum;
    });
  }
  clear_row_sums();
  largest_of_slab_.assign(slabs_.slabs(), 0.0);
  add_to_nodes([&](std::size_t slab, std::uint32_t s, SampleNodes& nodes, std::uint32_t joint, double fraction) {
    const double factor = surfaces_[s].row[joint] * fraction;
    double largest = largest_of_slab_[slab];
    for (const auto& side : nodes.side)
      for (const Share& share : side) {
        double& sum = row_sums_[share.field][share.node];
        sum += factor * row(share);
        largest = std::max(largest, sum);
      }
    largest_of_slab_[slab] = largest;
  });
  return largest_of_slab_.empty() ? 0.0 : *std::max_element(largest_of_slab_.begin(), largest_of_slab_.end());
}

// Sets the row sums to zero in all fields that joints act on.
template <int Dim>
void Joints<Dim>::clear_row_sums() {
  row_sums_.resize(system_.fields.size());
  for (auto& of_field : row_sums_) of_field.clear();
  for (const JointSurface<Dim>& surface : system_.joints)
    for (std::size_t side = 0; side < 2; ++side)
      for (const std::uint32_t f : face_nodes_.fields(surface, side))
        row_sums_[f].resize(system_.fields[f].nodes.size());
}

// The mass of a joint is the one with which its spring has the frequency sqrt(S), where S is the largest row sum of
// M^-1 K at its nodes. For joints that move together, it is the joint's part of the reduced mass of both faces; the
// nodes of a joint count for all joints that they belong to, so that their whole mass would be too large. The row sums
// of the dashpots of ratio beta are then at most 2 beta sqrt(S), and the scheme is stable if S dt^2/4 + beta sqrt(S) dt
// <= 1. Returns the largest such dt.
template <int Dim>
double Joints<Dim>::find_masses(double ratio) {
  const double largest = find_row_sums([](const Share& share) { return std::abs(share.weight) * share.mobility; },
                                       [](const SampleNodes& nodes) { return nodes.sum; });
  for (std::size_t s = 0; s < surfaces_.size(); ++s) {
    const auto& joints = system_.joints[s].joints;
    auto& mass = surfaces_[s].mass;
    mass.resize(joints.size());
    each_joint(s, [&](std::size_t joint) {
      double row = 0.0;
      each_contribution(s, joint, [&](const SampleNodes& nodes, double) {
        for (const auto& side : nodes.side)
          for (const Share& share : side) row = std::max(row, row_sums_[share.field][share.node]);
      });
      mass[joint] = row > 0 ? std::max(joints[joint].kn, joints[joint].ks) * joints[joint].area / row : 0.0;
    });
  }
  if (!(largest > 0)) return std::numeric_limits<double>::max();
  return 2 * (std::sqrt(1 + ratio * ratio) - ratio) / std::sqrt(largest);
}

template void Joints<2>::find_stable_step();
template void Joints<3>::find_stable_step();

}  // namespace tribo
