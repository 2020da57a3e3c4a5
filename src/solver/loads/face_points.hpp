// SPDX-License-Identifier: MIT
/// Faces of particles, on which tractions and heat fluxes act, and the nodes around a point of a face.
#pragma once

#include "solver/exchange/exchange.hpp"
#include "solver/state/system.hpp"

namespace tribo {

/// A face of a particle domain, with two Gauss points along each tangent.
template <int Dim>
struct ParticleFace {
  static constexpr std::size_t count = Dim == 2 ? 2 : 4;
  Vec3 normal;        ///< outward unit normal of the undeformed face
  double area = 0.0;  ///< initial area, since tractions and fluxes are nominal                              [length^2]
  std::array<Vec<Dim>, count> points;  ///< positions of the Gauss points [length]

  /// Face `face` of the particle with index `particle` in `body`.
  static ParticleFace of(const System<Dim>& system, Body<Dim>& body, std::size_t particle, DomainFace face);

 private:
  static ParticleFace of_half_axes(const System<Dim>& system, Body<Dim>& body, std::size_t particle, DomainFace face);
};

/// The nodes around a point and the fractions of a force at the point that they receive. The fractions are the shape
/// functions, zero at nodes without mass, with splines and linear shape functions reduced at nodes with little mass,
/// and normalised to the sum one.
template <int Dim>
struct PointShares {
  static constexpr int most = Dim == 2 ? 16 : 64;
  int count = 0;
  std::array<std::size_t, most> field;
  std::array<std::int64_t, most> node;  ///< position in the nodal arrays of `field`
  std::array<double, most> share;       ///< fraction of the force

  /// `x`: the point [length]. uGIMP and CPDI use linear shape functions. `field_at(index)` returns the number of the
  /// velocity field to use at a node.
  template <class FieldAt>
  PointShares(Kernel kernel, const std::vector<Field<Dim>>& fields, const Exchanges<Dim>& exchanges, const Vec<Dim>& x,
              FieldAt&& field_at) {
    spread(kernel, fields.front().map.lattice(), x);
    for (std::size_t k = 0; k < static_cast<std::size_t>(count); ++k) field[k] = field_at(index_[k]);
    normalise(fields, exchanges, light_fraction(kernel));
  }

 private:
  void spread(Kernel kernel, const Lattice<Dim>& lattice, const Vec<Dim>& x);
  template <class K>
  void spread(const Lattice<Dim>& lattice, const Vec<Dim>& x);
  static double light_fraction(Kernel kernel);
  void normalise(const std::vector<Field<Dim>>& fields, const Exchanges<Dim>& exchanges, double light);

  std::array<Index<Dim>, most> index_;
};

}  // namespace tribo
