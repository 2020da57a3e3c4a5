// SPDX-License-Identifier: MIT
/// Two convex blocks that overlap: distance, direction and intersection.
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

/// A polygon or polyhedron at its present position.
struct PlacedBlock {
  const BlockShape* shape = nullptr;
  std::span<const BlockEdge> edges;  ///< of polyhedra
  Vec3 centre = Vec3::Zero();
  std::vector<Vec3> corners, normals;  ///< outward normals of the faces
  std::vector<double> heights;         ///< of the faces: normal . x

  /// Allocates nothing if it held a block of this size before.
  void place(const BlockShape& what, std::span<const BlockEdge> edges, const Vec3& x, const Mat3& R, bool plane);
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

/// A part of the intersection of two blocks. Its mean depth volume/area is the overlap of springs k A there: parts add
/// up to k times the common volume, and its moment.
struct SharedPart {
  Vec3 at = Vec3::Zero();  ///< its centre
  double area = 0.0;       ///< projected along n; two dimensions: length
  double volume = 0.0;     ///< two dimensions: area
};
/// Number of parts of a pair: enough to resist all relative motions of two bodies.
constexpr std::size_t shared_parts(bool plane) { return plane ? 2 : 4; }
/// The intersection of two blocks, cut in the middle along the axes t, and in space also s.
/// `parts` has the length shared_parts(plane).
void share(const PlacedBlock& a, const PlacedBlock& b, const JointAxes& axes, bool plane, std::span<SharedPart> parts);

}  // namespace tribo
