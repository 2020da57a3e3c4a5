// SPDX-License-Identifier: MIT
/// Joints along a crack or between two bodies.
#pragma once

#include "base/archive.hpp"
#include "base/types.hpp"
#include "contact/joint_geometry.hpp"
#include "contact/joint_law.hpp"

#include <array>
#include <vector>

namespace tribo {

/// A point of integration. Joints feel the mean motion of the faces over their part of the surface, and push all of it.
template <int Dim>
struct JointSample {
  static constexpr auto count = static_cast<std::size_t>(Dim);
  using Corners = std::array<Vec<Dim>, count>;
  std::array<std::uint32_t, count> point{};  ///< of a crack; the sample lies between them
  std::array<double, count> share{};         ///< of these points in its position
  std::array<std::uint32_t, count> joint{};  ///< whose surface it stands for
  std::array<double, count> part{};          ///< of the surface of each; over all samples of a joint their sum is one
  Vec3 local = Vec3::Zero();                 ///< between bodies: from the joint's point along its n, s, t   [length]
};

/// Points that persist, each with its part of the surface and a joint.
template <int Dim>
struct JointSurface {
  static constexpr std::size_t none = static_cast<std::size_t>(-1);

  const JointLaw* law = nullptr;
  std::size_t crack = none;                     ///< whose points these are, from its lower (1) to its upper face (2)
  std::array<std::size_t, 2> home{none, none};  ///< else: the fields of the bodies 1 and 2
  std::array<int, 2> material{-1, -1};          ///< and their materials
  std::vector<std::size_t> point;               ///< of the crack
  std::vector<JointSample<Dim>> samples;
  std::vector<Vec<Dim>> x;  ///< halfway between the faces                       [length]
  std::vector<JointAxes> axes;
  std::vector<Joint> joints;
  /// Around the faces at each sample at the start; 0: not known yet, `lost`: between bodies, once a face has left.
  std::array<std::vector<double>, 2> mass;
  static constexpr double lost = -1.0;

  /// On body 2, dashpots included.
  Vec3 force(std::size_t k) const {
    const Joint& j = joints[k];
    return -(j.Fn + j.dashpot_normal) * axes[k].n + axes[k].vector(j.Fs + j.dashpot_shear);
  }
};

/// Where the samples lie on the surface belongs to the model.
template <int Dim>
void archive(Archive& a, JointSurface<Dim>& surface) {
  auto& [law, crack, home, material, point, samples, x, axes, joints, mass] = surface;
  a.version(1);
  a("x", x), a("axes", axes), a("joints", joints), a("mass1", mass[0]), a("mass2", mass[1]);
}

}  // namespace tribo
