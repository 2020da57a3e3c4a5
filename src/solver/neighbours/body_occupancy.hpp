// SPDX-License-Identifier: MIT
/// Where there are particles.
#pragma once

#include "grid/cell_table.hpp"
#include "solver/neighbours/nodes_around.hpp"
#include "solver/state/particle_domain.hpp"

#include <algorithm>

namespace tribo {

/// Tells whether a point lies in the domain of a particle.
template <int Dim>
class BodyOccupancy {
 public:
  /// Of all deformable bodies within a box.
  BodyOccupancy(const Model& model, System<Dim>& system, const Vec<Dim>& low, const Vec<Dim>& high)
      : BodyOccupancy(model, system.lattice, low, high) {
    for (auto& body : system.bodies) add(body);
  }
  /// Of the bodies that are added.
  BodyOccupancy(const Model& model, const Lattice<Dim>& lattice, const Vec<Dim>& low, const Vec<Dim>& high)
      : around_(model, lattice), cells_(lattice), low_(low), high_(high) {}
  void add(Body<Dim>& body) {
    const DomainReader<Dim> domains(body);
    const auto x = body.particles.x();
    for (std::uint32_t i = 0; i < body.particles.size(); ++i) {
      bool near = true;
      for (std::size_t d = 0; d < Dim; ++d) {
        const auto axis = static_cast<Eigen::Index>(d);
        near = near && x[d][i] >= low_[axis] && x[d][i] <= high_[axis];
      }
      if (!near) continue;
      const ParticleDomain<Dim> domain = domains(i);
      const Vec<Dim> half = (1 + widest) * domain.axes.cwiseAbs().rowwise().sum();
      cells_.add(domain.x - half, domain.x + half, domain);
    }
  }
  /// Whether a point lies beyond a symmetry plane.
  bool mirrored(const Vec<Dim>& x) const {
    return std::any_of(around_.planes().begin(), around_.planes().end(),
                       [&](const SymmetryPlane& plane) { return (plane.at - x[plane.axis]) * plane.inward > 0; });
  }
  /// `slack`: parts of a particle's size by which a point may lie beside it, up to a half.
  bool at(Vec<Dim> x, double slack = 1e-9) const {
    for (const SymmetryPlane& plane : around_.planes())
      if ((plane.at - x[plane.axis]) * plane.inward > 0) x[plane.axis] = 2 * plane.at - x[plane.axis];
    bool found = false;
    cells_.each(x, x, [&](const ParticleDomain<Dim>& d) {
      found = found || d.axes.inverse().operator*(x - d.x).cwiseAbs().maxCoeff() <= 1 + 2 * slack;
    });
    return found;
  }

 private:
  static constexpr double widest = 1.0;

  NodesAround<Dim> around_;
  CellTable<Dim, ParticleDomain<Dim>> cells_;
  Vec<Dim> low_, high_;
};

}  // namespace tribo
