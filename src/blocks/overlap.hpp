// SPDX-License-Identifier: MIT
/// Two convex blocks that press into one another: how far they are apart, along which direction, and what they share.
#pragma once

#include "blocks/shape.hpp"
#include "contact/joint_geometry.hpp"

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

/// A polygon or polyhedron where it is now.
struct PlacedBlock {
  const BlockShape* shape = nullptr;
  std::span<const BlockEdge> edges;  ///< of polyhedra
  Vec3 centre = Vec3::Zero();
  std::vector<Vec3> corners, normals;  ///< outward normals of the faces
  std::vector<double> heights;         ///< of the faces: normal . x

  /// Allocates nothing where it held a block as large before.
  void place(const BlockShape& what, std::span<const BlockEdge> edges, const Vec3& x, const Mat3& R, bool plane);
};

/// Distance along the direction that separates two blocks best, negative: by how much they overlap along the direction
/// of the least overlap; n points from a to b. Between edges it is at most the true distance.
struct BlockGap {
  double gap = 0.0;
  Vec3 n = Vec3::UnitX();
};
/// Stops looking at the first direction along which they are further apart than `enough`. Directions: normals of faces,
/// and of pairs of edges whose arcs on the sphere of normals cross (Gregorius, Game Developers Conference 2013).
/// Between overlapping blocks a pair of edges must be better by a twentieth, so that faces stay faces.
BlockGap separation(const PlacedBlock& a, const PlacedBlock& b, bool plane, double enough);

/// A part of what two blocks share. Its mean depth volume/area is the overlap of springs k A there: parts add up to
/// k times the common volume, and its moment.
struct SharedPart {
  Vec3 at = Vec3::Zero();  ///< its centre
  double area = 0.0;       ///< seen along n; two dimensions: length
  double volume = 0.0;     ///< two dimensions: area
};
/// Parts of a pair: one more than these would not resist more motions of two bodies.
constexpr std::size_t shared_parts(bool plane) { return plane ? 2 : 4; }
/// What two blocks share, cut in the middle along the axes t, and in space also s.
/// `parts` has the length shared_parts(plane).
void share(const PlacedBlock& a, const PlacedBlock& b, const JointAxes& axes, bool plane, std::span<SharedPart> parts);

}  // namespace tribo
