// SPDX-License-Identifier: MIT
/// Sets of points in a box: random with a smallest distance, or on a lattice.
#pragma once

#include "base/types.hpp"

#include <cstdint>
#include <vector>

namespace tribo {

/// `count` random points in a box (a rectangle at z of `low` if `plane`). The smallest distance between two points is
/// `apart` times the edge length of the cube (square) with the mean volume (area) per point. The result depends on the
/// seed only, not on the platform. Throws std::runtime_error if the points cannot be placed; the limit of `apart` is
/// about 0.8.
std::vector<Vec3> random_points(std::size_t count, const Vec3& low, const Vec3& high, bool plane, double apart,
                                std::uint64_t seed);

/// Lattices, named by the Voronoi cells of their points. The comments define the spacing.
enum class PointLattice {
  cubes,     ///< the edge length; squares in the plane
  hexagons,  ///< the distance between opposite sides of a hexagon; plane only
  octahedra  ///< the distance between opposite squares of a truncated octahedron: body-centred cubic lattice
};
/// The points of a lattice in a box, starting at its low corner; points beyond the high end are omitted.
std::vector<Vec3> lattice_points(PointLattice lattice, double spacing, const Vec3& low, const Vec3& high, bool plane);

}  // namespace tribo
