// SPDX-License-Identifier: MIT
/// The region that particles occupy.
#pragma once

#include "grid/cell_table.hpp"
#include "solver/neighbours/nodes_around.hpp"
#include "solver/state/particle_domain.hpp"

#include <algorithm>

namespace tribo {

/// Determines whether a point lies in the domain of a particle.
template <int Dim>
class BodyOccupancy {
 public:
  /// Occupancy of all deformable bodies. Only particles in the box from `low` to `high` [length] are considered.
  BodyOccupancy(const Model& model, System<Dim>& system, const Vec<Dim>& low, const Vec<Dim>& high)
      : BodyOccupancy(model, system.lattice, low, high) {
    for (auto& body : system.bodies) add(body);
  }
  /// Occupancy of the bodies that are added with add(), within the same box.
  BodyOccupancy(const Model& model, const Lattice<Dim>& lattice, const Vec<Dim>& low, const Vec<Dim>& high)
      : nodes_around_(model, lattice), cells_(lattice), low_(low), high_(high) {}
  /// Adds the particles of a body.
  void add(Body<Dim>& body) {
    const DomainReader<Dim> domains(body);
    const auto x = body.particles.x();
    body.each_known_particle([&](std::uint32_t i) {
      bool near = true;
      for (std::size_t d = 0; d < Dim; ++d) {
        const auto axis = static_cast<Eigen::Index>(d);
        near = near && x[d][i] >= low_[axis] && x[d][i] <= high_[axis];
      }
      if (!near) return;
      const ParticleDomain<Dim> domain = domains(i);
      const Vec<Dim> half = (1 + largest_slack) * domain.axes.cwiseAbs().rowwise().sum();
      cells_.add(domain.x - half, domain.x + half, domain);
    });
  }
  /// Whether a point lies beyond a symmetry plane.
  bool is_mirrored(const Vec<Dim>& x) const {
    return std::any_of(nodes_around_.planes().begin(), nodes_around_.planes().end(),
                       [&](const SymmetryPlane& plane) { return (plane.at - x[plane.axis]) * plane.inward > 0; });
  }
  /// Whether the point x [length], or its image inside the symmetry planes, lies in a particle domain. `slack`:
  /// tolerance in fractions of the particle size, at most 0.5.
  bool contains(Vec<Dim> x, double slack = 1e-9) const {
    for (const SymmetryPlane& plane : nodes_around_.planes())
      if ((plane.at - x[plane.axis]) * plane.inward > 0) x[plane.axis] = 2 * plane.at - x[plane.axis];
    bool found = false;
    cells_.each(x, x, [&](const ParticleDomain<Dim>& d) {
      found = found || d.axes.inverse().operator*(x - d.x).cwiseAbs().maxCoeff() <= 1 + 2 * slack;
    });
    return found;
  }

 private:
  static constexpr double largest_slack = 1.0;

  NodesAround<Dim> nodes_around_;
  CellTable<Dim, ParticleDomain<Dim>> cells_;
  Vec<Dim> low_, high_;
};

}  // namespace tribo
