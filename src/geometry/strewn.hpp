// SPDX-License-Identifier: MIT
/// Points that fill a box: at random, but not too near to each other, or on a lattice.
#pragma once

#include "base/types.hpp"

#include <cstdint>
#include <vector>

namespace tribo {

/// `count` points strewn over a box (a rectangle, z of `low`, if `plane`), none nearer to another than `apart` times
/// the edge of the cube (square) that is one's due; the same for a seed on every machine. Throws std::runtime_error if
/// there is no room: 0.8 is about the limit.
std::vector<Vec3> strewn_points(std::size_t count, const Vec3& low, const Vec3& high, bool plane, double apart,
                                std::uint64_t seed);

/// By the shapes of the cells around its points.
enum class PointLattice {
  cubes,     ///< edge; squares in the plane
  hexagons,  ///< between flat tops; in the plane
  octahedra  ///< truncated ones, between opposite squares: a body-centred cubic lattice
};
/// The points of a lattice in a box, from its low corner on; what sticks out at the other ends is left out.
std::vector<Vec3> lattice_points(PointLattice lattice, double spacing, const Vec3& low, const Vec3& high, bool plane);

}  // namespace tribo
