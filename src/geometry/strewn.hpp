/// Points at random, but not too near to each other.
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

}  // namespace tribo
