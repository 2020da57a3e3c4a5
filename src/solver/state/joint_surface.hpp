// SPDX-License-Identifier: MIT
/// Joints along a crack or between two bodies.
#pragma once

#include "base/archive.hpp"
#include "base/types.hpp"
#include "contact/joint_geometry.hpp"
#include "contact/joint_law.hpp"

#include <array>
#include <memory>
#include <vector>

namespace tribo {

/// An integration point on a joint surface. The velocity jump of a joint is the mean over the integration points of
/// its part of the surface, and its force is distributed over the same points with the same weights.
template <int Dim>
struct JointSample {
  static constexpr auto count = static_cast<std::size_t>(Dim);
  using Corners = std::array<Vec<Dim>, count>;
  /// On a crack: numbers of the corners of the piece that holds the integration point.
  std::array<std::uint32_t, count> point{};
  /// Barycentric coordinates of the integration point with respect to these corners.
  std::array<double, count> weight{};
  /// Numbers of the joints to whose surfaces the integration point contributes.
  std::array<std::uint32_t, count> joint{};
  /// Fraction of the surface area of each of these joints; the fractions of one joint sum to one.
  std::array<double, count> area_fraction{};
  /// Between bodies: offset from the joint, components along its axes n, s, t [length].
  Vec3 local = Vec3::Zero();
};

/// The joints along one crack or on one common face of two bodies. Each joint belongs to a point that persists during
/// the run and stands for a part of the surface.
template <int Dim>
struct JointSurface {
  static constexpr std::size_t none = static_cast<std::size_t>(-1);

  const JointLaw* law = nullptr;
  /// Number of the crack; body 1 is then on its lower and body 2 on its upper side; `none`: two bodies.
  std::size_t crack = none;
  std::array<std::size_t, 2> field{none, none};  ///< between bodies: the velocity fields of the bodies 1 and 2
  std::array<int, 2> material{-1, -1};           ///< between bodies: the materials of the bodies 1 and 2
  std::vector<std::size_t> point;                ///< on a crack: number of the crack point of each joint
  std::vector<JointSample<Dim>> samples;
  std::vector<Vec<Dim>> x;  ///< positions of the joints, halfway between the faces                       [length]
  std::vector<JointAxes> axes;
  std::vector<Joint> joints;
  /// Nodal mass near the integration points on the side of body 1 and of body 2 at the start of the run, interpolated
  /// with the shape functions [mass]. 0: not computed yet. `detached`: between bodies, once one of the faces has moved
  /// away.
  std::array<std::vector<double>, 2> mass;
  static constexpr double detached = -1.0;
  /// An imperfect interface of two bodies: joints are added where faces meet, and removed once they have detached. Then
  /// it owns its law, `side` holds the side of a particle of body 1 that each joint belongs to
  /// (CommonFacePiece::side), and `dissipated` what the removed joints had dissipated [energy].
  std::shared_ptr<const JointLaw> interface;
  std::vector<std::int64_t> side;
  double dissipated = 0.0;
  /// Number of joints that deform in this step; later ones were added in it, and the step may be too long for them.
  std::size_t deforming = none;

  /// Force of the k-th joint on body 2, dashpots included [force].
  Vec3 force(std::size_t k) const {
    const Joint& j = joints[k];
    return -(j.Fn + j.dashpot_normal) * axes[k].n + axes[k].vector(j.Fs + j.dashpot_shear);
  }
};

template <int Dim>
void archive(Archive& a, JointSample<Dim>& sample) {
  auto& [point, weight, joint, area_fraction, local] = sample;
  a.version(1);
  a("joint", joint[0]), a("area_fraction", area_fraction[0]), a("local", local);
}

/// Refuses joints, restored from a checkpoint, that are not possible.
template <int Dim>
void check(const JointSurface<Dim>& surface) {
  for (const auto& of_body : surface.mass)
    for (const double mass : of_body)
      if (!(mass >= 0 || mass == JointSurface<Dim>::detached)) refuse_checkpoint("the mass at a joint is negative");
  if (!surface.interface || surface.crack != JointSurface<Dim>::none) return;
  static constexpr double largest_fraction = 1 + 1e-9;
  for (const JointSample<Dim>& sample : surface.samples)
    if (sample.joint[0] >= surface.joints.size() || !(sample.area_fraction[0] >= 0) ||
        sample.area_fraction[0] > largest_fraction)
      refuse_checkpoint("a part of an interface belongs to no joint");
}

/// Saves and restores the joints. The integration points follow from the model, except those of interfaces.
template <int Dim>
void archive(Archive& a, JointSurface<Dim>& surface) {
  auto& [law, crack, field, material, point, samples, x, axes, joints, mass, interface, side, dissipated, deforming] =
      surface;
  a.version(2);
  if (interface && crack == JointSurface<Dim>::none) {
    a.resizable("side", side), a.resizable("samples", samples);
    x.resize(side.size()), axes.resize(side.size()), joints.resize(side.size());
    for (auto& of_body : mass) of_body.resize(samples.size());
    a("dissipated", dissipated);
  }
  a("x", x), a("axes", axes), a("joints", joints), a("mass1", mass[0]), a("mass2", mass[1]);
  if (a.reading()) check(surface);
}

}  // namespace tribo
