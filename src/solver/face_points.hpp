/// Faces of particles, where tractions and heat fluxes act: on the face, not at the particle's centre.
#pragma once

#include "solver/conditions.hpp"
#include "solver/system.hpp"

namespace tribo {

/// A face of a particle with two Gauss points along every tangent.
template <int Dim>
struct ParticleFace {
  static constexpr std::size_t count = Dim == 2 ? 2 : 4;
  Vec3 normal;        ///< outward, of the undeformed face
  double area = 0.0;  ///< before deformation: loads are nominal                              [length^2]
  std::array<Vec<Dim>, count> points;

  /// `face`: the dialect's number, 2D 1 bottom 2 right 3 top 4 left; 3D 1-4 likewise, 5 bottom 6 top in z.
  static ParticleFace of(const System<Dim>& system, Body<Dim>& body, std::size_t particle, int face);
};

/// Calls f(node, share) for the nodes around a point in the kernel's point form; the shares sum to one. Nodes without
/// mass, beyond the surface, leave theirs to the others.
template <int Dim>
struct PointShares {
  static constexpr int most = Dim == 2 ? 16 : 64;
  int count = 0;
  std::array<std::int64_t, most> node;
  std::array<double, most> share;

  /// `x`: the point; uGIMP and CPDI interpolate with hats.
  PointShares(Kernel kernel, const Field<Dim>& field, const Conditions<Dim>& conditions, const Vec<Dim>& x);

 private:
  template <class K>
  void fill(const Field<Dim>& field, const Conditions<Dim>& conditions, const Vec<Dim>& x);
};

}  // namespace tribo
