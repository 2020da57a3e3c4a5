// SPDX-License-Identifier: MIT
/// The pairs of contact nodes near a particle.
#pragma once

#include "solver/contact/contact_search.hpp"
#include "solver/contact/near_particles.hpp"

#include <cmath>

namespace tribo {

/// Calls f(pair, signs, weight, side, distance) for the pairs of two bodies near a particle to which its field belongs,
/// also for the mirror images of pairs beyond the symmetry planes. `signs` are those of the components of an image's
/// vectors, and 1 for the pair itself; `side` is 1 if the particle is on side a, -1 if on side b. `distance`: the
/// largest component of that of the node [cells].
///
/// `max_distance`: of the nodes along each axis, at most 2 [cells]. The weight is that of particle_weight for the
/// distance along the face: the nodes on both sides of a face share its tractions, so the distance across the face does
/// not count.
template <int Dim, class F>
void each_pair_near(const ContactSearch<Dim>& search, const Lattice<Dim>& lattice, const MirrorPlanes<Dim>& planes,
                    const ParticleDomain<Dim>& particle, std::size_t field, double max_distance, F&& f) {
  constexpr int nodes_per_axis = 6, count = Dim == 2 ? 36 : 216;
  const ContactNodes<Dim>& contacts = search.found();
  Index<Dim> low, n;
  for (std::size_t d = 0; d < Dim; ++d) {
    const auto axis = static_cast<Eigen::Index>(d);
    low[d] = static_cast<int>(std::floor((particle.x[axis] - lattice.origin[axis]) / lattice.spacing[axis])) - 2;
  }
  for (int k = 0; k < count; ++k) {
    n[0] = low[0] + k % nodes_per_axis, n[1] = low[1] + k / nodes_per_axis % nodes_per_axis;
    if constexpr (Dim == 3) n[2] = low[2] + k / (nodes_per_axis * nodes_per_axis);
    const Vec<Dim> distance = particle.x - lattice.position(n);
    const double cells = distance.cwiseQuotient(lattice.spacing).cwiseAbs().maxCoeff();
    if (cells > max_distance) continue;
    const Vec<Dim> signs = planes.reflect(n);
    const ContactNode<Dim>* node = search.node_at(n);
    if (!node) continue;
    for (const ContactPair& pair : contacts.pairs_of(*node)) {
      if (pair.has_no_face || pair.crack >= 0) continue;
      const Vec<Dim> normal = signs.cwiseProduct(pair.state.normal.template head<Dim>());
      const double w = particle_weight<Dim>(distance - distance.dot(normal) * normal, lattice.spacing);
      if (!(w > 0)) continue;
      if (contacts.members[pair.a].field == field) f(pair, signs, w, 1.0, cells);
      if (contacts.members[pair.b].field == field) f(pair, signs, w, -1.0, cells);
    }
  }
}

}  // namespace tribo
