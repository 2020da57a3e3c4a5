// SPDX-License-Identifier: MIT
/// Single blocks at a place, for tests of their geometry.
#pragma once

#include "blocks/block_cases.hpp"
#include "blocks/overlap.hpp"

namespace tribo::test {

/// A shape with its edges where it is.
struct Placed {
  BlockShape shape;
  std::vector<BlockEdge> edges;
  PlacedBlock block;
  Placed(BlockShape what, const Vec3& x, const Mat3& R, bool plane) : shape(std::move(what)), edges(edges_of(shape)) {
    block.place(shape, edges, x, R, plane);
  }
};

inline BlockShape cube(double half, bool plane) {
  return brick_block(Vec3::Constant(-half), Vec3::Constant(half), plane);
}

inline Mat3 turned(double angle, const Vec3& axis) {
  return Eigen::AngleAxisd(angle, axis.normalized()).toRotationMatrix();
}

}  // namespace tribo::test
