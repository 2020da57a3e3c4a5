// SPDX-License-Identifier: MIT
/// Cracks with joints along a row of particles.
///
/// A particle that a crack cuts belongs to one side with its whole domain. Where a straight crack runs along a row of
/// particles, the faces of the two sides are therefore at an edge of this row, while the tractions of joints act at the
/// crack: the rows next to it would have the wrong stress, with a correct mean, and a row whose centres the crack
/// touches would change sides as the faces approach. Such a crack is moved to the edge. Where a crack crosses rows of
/// particles at an angle, these errors have no preferred sign, and it stays where it is.
#pragma once

#include "solver/state/system.hpp"

#include <vector>

namespace tribo {

/// The displacement that moves a plane surface with the corners `points` [length] to the nearest edge of the particles
/// that it cuts, at most half a particle [length]. Zero if the surface is not normal to a grid axis, or if the
/// particles that it cuts do not form one row with edges along the grid.
template <int Dim>
Vec<Dim> shift_to_particle_edges(System<Dim>& system, const std::vector<Vec<Dim>>& points);

}  // namespace tribo
