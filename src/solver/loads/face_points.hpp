// SPDX-License-Identifier: MIT
/// Faces of particles, where tractions and heat fluxes act: on the face, not at the particle's centre.
#pragma once

#include "solver/exchange/exchange.hpp"
#include "solver/state/system.hpp"

namespace tribo {

/// A face of a particle with two Gauss points along every tangent.
template <int Dim>
struct ParticleFace {
  static constexpr std::size_t count = Dim == 2 ? 2 : 4;
  Vec3 normal;        ///< outward, of the undeformed face
  double area = 0.0;  ///< before deformation: loads are nominal                              [length^2]
  std::array<Vec<Dim>, count> points;

  /// Face `face` of the particle with index `particle` in `body`.
  static ParticleFace of(const System<Dim>& system, Body<Dim>& body, std::size_t particle, DomainFace face);
};

/// The nodes around a point with the kernel's weights there; the shares sum to one. Nodes without mass, beyond the
/// surface, leave theirs to the others, nodes with little mass a part of it.
template <int Dim>
struct PointShares {
  static constexpr int most = Dim == 2 ? 16 : 64;
  int count = 0;
  std::array<std::size_t, most> field;
  std::array<std::int64_t, most> node;  ///< position in the layers of `field`
  std::array<double, most> share;

  /// `x`: the point; uGIMP and CPDI interpolate with hats. `field_at(index)` says which field a node's share is of.
  template <class FieldAt>
  PointShares(Kernel kernel, const std::vector<Field<Dim>>& fields, const Exchanges<Dim>& exchanges, const Vec<Dim>& x,
              FieldAt&& field_at) {
    spread(kernel, fields.front().map.lattice(), x);
    for (std::size_t k = 0; k < static_cast<std::size_t>(count); ++k) field[k] = field_at(index_[k]);
    keep_heavy(fields, exchanges);
  }

 private:
  void spread(Kernel kernel, const Lattice<Dim>& lattice, const Vec<Dim>& x);
  template <class K>
  void spread(const Lattice<Dim>& lattice, const Vec<Dim>& x);
  void keep_heavy(const std::vector<Field<Dim>>& fields, const Exchanges<Dim>& exchanges);

  std::array<Index<Dim>, most> index_;
};

}  // namespace tribo
