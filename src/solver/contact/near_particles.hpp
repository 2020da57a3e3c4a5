// SPDX-License-Identifier: MIT
/// The particles of the two fields of a pair near a contact node.
#pragma once

#include "solver/contact/particle_cloud.hpp"
#include "solver/contact/particle_set.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <vector>

namespace tribo {

/// Working memory for the search for one face; each thread has one and reuses it from pair to pair.
template <int Dim>
struct NearParticles {
  using Groups = std::vector<const ParticleGroup<Dim>*>;

  std::array<Groups, 2> groups;           ///< per side: all groups with particles within reach of the node
  std::array<ParticleSet<Dim>, 2> sides;  ///< per side: the particles that determine the face
  Vec<Dim> direction;                     ///< from the mean position of the first side to that of the second [length]
  std::array<Vec<Dim>, 2> mean;           ///< per side: mean position of its particles, from the node          [length]
  std::array<Vec<Dim>, 2> low, high;      ///< per side: corners of the box around the domains of its groups   [length]
  double apart;                           ///< see apart_beside_corner()                                       [length]
  std::array<bool, 2> rigid;              ///< per side: the body is rigid
  bool curved;                            ///< one of the bodies keeps a curved surface, see Field::curved
  bool wide;                              ///< the normal is that of wide faces, not of corners or edges
  std::array<double, 2> max_reach;        ///< per side: reach of the foremost particle                        [length]

  std::vector<double> reach, bounds;  ///< scratch: reach of particles, upper bounds of the reach of groups
  std::vector<std::size_t> numbers;   ///< scratch: numbers of particles in the cloud
  std::vector<std::uint64_t> marks;   ///< scratch: per particle of the cloud, the number of the last set that it was in
  std::uint64_t mark = 0;             ///< number of such sets so far
};

/// Whether the two sides meet in a corner or an edge only, to judge by the boxes around them: along two axes the boxes
/// overlap by less than `overlap`, so that no face between the two is wider than that in any direction in which it must
/// extend. Returns how much more they would have to overlap for a face [length]; 0 if they may have one.
template <int Dim>
double apart_beside_corner(const NearParticles<Dim>& near, double overlap) {
  double least = std::numeric_limits<double>::infinity(), second = least;
  for (int d = 0; d < Dim; ++d) {
    const double along = std::min(near.high[0][d] - near.low[1][d], near.high[1][d] - near.low[0][d]);
    second = std::min(second, std::max(least, along)), least = std::min(least, along);
  }
  return std::max(0.0, overlap - second);
}

/// Calls f(domain, label) for the particles of `groups` within reach of a node at `centre`.
template <int Dim, class F>
void each_particle(const ParticleCloud<Dim>& cloud, const typename NearParticles<Dim>::Groups& groups,
                   const Vec<Dim>& centre, F&& f) {
  for (const auto* group : groups)
    cloud.each_point(*group, centre, [&](std::uint32_t k) { f(cloud.domain(k), cloud.label(k)); });
}

/// Weight of a particle at a node for means over the particles near it: a product of hat functions that vanish 1.5
/// cells from the node. `distance`: from the node to the particle, `spacing`: edges of a cell [length].
template <int Dim>
double particle_weight(const Vec<Dim>& distance, const Vec<Dim>& spacing) {
  double w = 1.0;
  for (int d = 0; d < Dim; ++d) w *= std::max(0.0, 1.0 - std::abs(distance[d]) / (1.5 * spacing[d]));
  return w;
}

}  // namespace tribo
