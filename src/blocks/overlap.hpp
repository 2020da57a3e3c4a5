// SPDX-License-Identifier: MIT
/// Two convex blocks that overlap: distance and direction.
#pragma once

#include "blocks/shape.hpp"

#include <span>
#include <vector>

namespace tribo {

/// An edge of a polyhedron: from one corner to another, counter-clockwise around the face on its left, seen from
/// outside.
struct BlockEdge {
  std::uint32_t from = 0, to = 0, left = 0, right = 0;
};
/// All edges of a polyhedron whose faces share them; none of polygons and balls.
std::vector<BlockEdge> edges_of(const BlockShape& shape);

/// A polygon or polyhedron at its present position.
struct PlacedBlock {
  const BlockShape* shape = nullptr;
  std::span<const BlockEdge> edges;  ///< of polyhedra
  Vec3 centre = Vec3::Zero();
  std::vector<Vec3> corners, normals;  ///< outward normals of the faces
  std::vector<double> heights;         ///< of the faces: normal . x
  std::size_t back = no_face;          ///< a face that was moved inwards; `corners` are those without that
  double grown = 0.0;                  ///< all faces count as moved outwards by this for what the blocks share
  static constexpr std::size_t no_face = static_cast<std::size_t>(-1);
  double height(std::size_t face) const { return heights[face] + grown; }

  /// Allocates nothing if it held a block of this size before.
  void place(const BlockShape& what, std::span<const BlockEdge> edges, const Vec3& x, const Mat3& R, bool plane);
  /// Moves a face inwards, one at most; a negative distance moves it back again.
  void set_back(std::size_t face, double by) { back = face, heights[face] -= by; }
};

/// Largest distance of two blocks along any direction, negative: least overlap along any direction; n points from a to
/// b. Between edges it is at most the true distance.
struct BlockGap {
  double gap = 0.0;
  Vec3 n = Vec3::UnitX();
};
/// The search ends at the first direction along which the distance exceeds `enough`. Directions: normals of faces,
/// and of pairs of edges whose arcs on the sphere of normals cross (Gregorius, Game Developers Conference 2013).
/// Between overlapping blocks a pair of edges must be better by a twentieth, so that face contacts persist.
BlockGap separation(const PlacedBlock& a, const PlacedBlock& b, bool plane, double enough);

}  // namespace tribo
