// SPDX-License-Identifier: MIT
/// Functions for joints between bodies only: the range of the joints, and rigid bodies on one side.

#include "solver/joints/joints.hpp"

#include <algorithm>
#include <cmath>

namespace tribo {

// Calls f(block, surface, joint) for the joints between bodies that have both faces.
template <int Dim>
template <class F>
void Joints<Dim>::each_point(F&& f) const {
  for (std::size_t s = 0; s < system_.joints.size(); ++s) {
    const JointSurface<Dim>& surface = system_.joints[s];
    if (surface.crack != JointSurface<Dim>::none) continue;
    for (std::size_t k = 0; k < surface.joints.size(); ++k)
      if (is_supported(s, k)) f(system_.lattice.block_of(surface.x[k]), s, k);
  }
}

// Lists the joints between bodies by blocks.
template <int Dim>
void Joints<Dim>::list_points() {
  BlockBox<Dim> box;
  each_point([&](const Index<Dim>& block, std::size_t, std::size_t) { box.include(block); });
  points_of_.reset(box);
  each_point([&](const Index<Dim>& block, std::size_t, std::size_t) { ++points_of_.at(block).end; });
  std::uint32_t count = 0;
  each_in_box<Dim>(box.low, box.high, [&](const Index<Dim>& block) {
    PointRange& here = points_of_.at(block);
    here.first = count, count += here.end, here.end = here.first;
  });
  points_.resize(count);
  each_point([&](const Index<Dim>& block, std::size_t surface, std::size_t joint) {
    points_[points_of_.at(block).end++] = {static_cast<std::uint32_t>(surface), static_cast<std::uint32_t>(joint)};
  });
}

template <int Dim>
auto Joints<Dim>::near_joint(std::size_t a, std::size_t b, const Vec<Dim>& x, double close_enough) const -> NearJoint {
  NearJoint out;
  if (points_.empty()) return out;
  const Vec<Dim> reach = Vec<Dim>::Constant(reach_);
  const auto list_joints_of = [&](const Index<Dim>& block) {
    const PointRange range = points_of_[block];
    for (std::uint32_t p = range.first; p < range.end; ++p) {
      const PointOf& point = points_[p];
      if (out.distance <= close_enough) return;
      const JointSurface<Dim>& surface = system_.joints[point.surface];
      const auto& [one, two] = surface.field;
      if (!((one == a && two == b) || (one == b && two == a))) continue;
      const Vec<Dim> from = x - surface.x[point.joint], n = surface.axes[point.joint].n.template head<Dim>();
      if (!(from.cwiseAbs().maxCoeff() <= reach_)) continue;
      const double distance = (from - from.dot(n) * n).norm();
      if (distance < out.distance) out.distance = distance, out.normal = n;
    }
  };
  each_in_box<Dim>(system_.lattice.block_of(x - reach), system_.lattice.block_of(x + reach), list_joints_of);
  return out;
}

// Records work and impulse of rigid bodies, whose motion is prescribed, on the joints.
template <int Dim>
void Joints<Dim>::record_rigid_work(std::size_t s, const std::vector<Vec3>& before, double dt) {
  const JointSurface<Dim>& surface = system_.joints[s];
  for (std::size_t f = 0; f < 2; ++f)
    for (std::size_t k = 0; k < surface.joints.size() && rigid(surface, f); ++k) {
      if (!is_supported(s, k)) continue;
      // the force of the rigid body is opposite to the joint force on it
      const double sign = f == 0 ? 1.0 : -1.0;
      const Vec3 mean = 0.5 * (before[k] + surface.force(k));
      Vec3 velocity = Vec3::Zero();
      velocity.template head<Dim>() = surfaces_[s].motion[k][f].velocity;
      rigid_.first += sign * dt * mean.dot(velocity), rigid_.second += sign * dt * before[k];
    }
}

template void Joints<2>::list_points();
template auto Joints<2>::near_joint(std::size_t, std::size_t, const Vec<2>&, double) const -> NearJoint;
template void Joints<2>::record_rigid_work(std::size_t, const std::vector<Vec3>&, double);
template void Joints<3>::list_points();
template auto Joints<3>::near_joint(std::size_t, std::size_t, const Vec<3>&, double) const -> NearJoint;
template void Joints<3>::record_rigid_work(std::size_t, const std::vector<Vec3>&, double);

}  // namespace tribo
