// SPDX-License-Identifier: MIT
/// The domains of the particles at the surface of bodies in space, as pictures show them.
#pragma once

#include "base/types.hpp"
#include "output/vtk.hpp"

#include <cstdint>
#include <unordered_map>
#include <vector>

namespace tribo {

/// A convex polyhedron as its faces, each with its corners in order.
using Polyhedron = std::vector<std::vector<Vec3>>;

/// The side of a polyhedron's corners that is kept: normal . (x - at) <= 0.
struct CutPlane {
  Vec3 at, normal;
};
/// The part of a polyhedron on the inner side of a plane.
Polyhedron clipped(const Polyhedron& whole, const CutPlane& plane);

/// Parallelepipeds that stand for cut particles have one side in the surface of their body, but their other sides reach
/// beyond the surface, or leave gaps. Here each is extended towards its neighbours and cut by the planes of their outer
/// sides, so that the domains form a surface that is as smooth as these sides are. Outer sides face away from the body
/// and have no particle of the same material behind them.
///
/// A plane cuts only particles whose centres lie on its inner side, where the surface is turned by less than 60
/// degrees: concave surfaces and edges keep their form.
class OuterDomains {
 public:
  /// Of particles in space with domains; the frame must outlive the object.
  explicit OuterDomains(const ParticleFrame& frame);

  /// Whether a particle lies at the surface of a body.
  bool is_outer(std::size_t particle) const { return outer_.contains(static_cast<std::uint32_t>(particle)); }
  /// The domain of such a particle, cut by its neighbours. `extension`: by which it reaches beyond its inner sides,
  /// over its half axes.
  Polyhedron domain(std::size_t particle, double extension) const;

 private:
  using Key = std::uint64_t;
  struct Outer {
    std::uint32_t sides = 0;     // bits of the outer sides: -a, +a, -b, +b, -c, +c
    Vec3 normal = Vec3::Zero();  // away from the body
  };
  Key key(const Vec3& x, int dx = 0, int dy = 0, int dz = 0) const;
  template <class F>
  void each_neighbour(const Vec3& x, F&& f) const;
  bool is_surrounded(const Vec3& x) const;
  void find_outer_sides(std::size_t particle);
  Vec3 place(std::size_t particle) const { return Vec3::Map(frame_.position[particle].data()); }
  Mat3 axes(std::size_t particle) const;
  bool same_material(std::size_t a, std::size_t b) const;

  const ParticleFrame& frame_;
  const ParticleFrame::Field* material_;
  Vec3 low_ = Vec3::Zero();
  double size_ = 1.0;                                          // of the boxes
  std::unordered_map<Key, std::vector<std::uint32_t>> boxes_;  // particles by box
  std::unordered_map<std::uint32_t, Outer> outer_;             // particles at the surface
};

}  // namespace tribo
