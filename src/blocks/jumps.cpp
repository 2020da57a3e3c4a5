// SPDX-License-Identifier: MIT
/// Steps in which one block could pass through another one unseen.

#include "blocks/jumps.hpp"

#include "base/error.hpp"
#include "base/text.hpp"
#include "blocks/assembly.hpp"
#include "blocks/near_pairs.hpp"

#include <algorithm>
#include <limits>

namespace tribo {
namespace {

constexpr double most_travel = 0.25;  // of the thinner block, relative to the other one, per step

double reach_of(const BlockShape& shape) {
  double most = shape.radius;
  for (const Vec3& x : shape.corners) most = std::max(most, x.norm() + shape.radius);
  return most;
}

}  // namespace

double thinnest(const BlockShape& shape, bool plane) {
  if (shape.ball()) return 2 * shape.radius;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t f = 0; f < shape.faces.size(); ++f) {
    const Vec3 n = face_geometry(shape.face(f), plane, 1.0).normal;
    double low = 1e300, high = -1e300;
    for (const Vec3& x : shape.corners) low = std::min(low, n.dot(x)), high = std::max(high, n.dot(x));
    least = std::min(least, high - low);
  }
  return least;
}

void refuse_jumps(const Assembly& blocks, double dt, double harmless) {
  const std::size_t count = blocks.block_count();
  double most = 0.0;
  for (std::size_t k = 0; k < count; ++k) most = std::max(most, blocks.motion[k].v.squaredNorm());
  if (!(dt * std::sqrt(most) > 0.5 * harmless)) return;  // also if a velocity is not a number

  std::vector<Bounds> swept(count);
  for (std::size_t k = 0; k < count; ++k) {
    const Vec3 now = blocks.motion[k].x, before = now - dt * blocks.motion[k].v,
               reach = Vec3::Constant(reach_of(blocks.shapes[k]));
    swept[k] = {now.cwiseMin(before) - reach, now.cwiseMax(before) + reach};
  }
  each_near_pair(swept, [&](std::uint32_t a, std::uint32_t b) {
    const double travel = dt * (blocks.motion[a].v - blocks.motion[b].v).norm();
    if (!(travel > harmless)) return;
    const double thin =
        std::min(thinnest(blocks.shapes[a], blocks.plane()), thinnest(blocks.shapes[b], blocks.plane()));
    if (!(travel > most_travel * thin)) return;
    const Vec3& at = blocks.motion[b].x;
    throw SimulationError(
        format("the blocks %u and %u near (%.4g, %.4g, %.4g) approach by %.3g in one step at time "
               "%.4g, but the thinner one is %.3g thick: one could pass through the other unseen. Make "
               "the step smaller ('step' of <Blocks>, or <TimeStep>)",
               a + 1, b + 1, at[0], at[1], at[2], travel, blocks.time, thin));
  });
}

}  // namespace tribo
