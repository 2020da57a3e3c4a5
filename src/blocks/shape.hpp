// SPDX-License-Identifier: MIT
/// Shapes of rigid blocks: convex polygons and polyhedra, discs and balls.
#pragma once

#include "base/types.hpp"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace tribo {

/// A convex body. In two dimensions a polygon in the plane z = 0 whose corners are in counter-clockwise order.
struct BlockShape {
  std::vector<Vec3> corners;
  /// Corners of each face, counter-clockwise seen from outside; in two dimensions the two ends of each edge.
  std::vector<std::vector<std::uint32_t>> faces;
  double radius = 0.0;  ///< a ball or disc around the only corner

  bool ball() const { return radius > 0; }
  /// The corners of a face.
  std::vector<Vec3> face(std::size_t f) const;
};

/// Polygon through corners in any orientation. Throws std::runtime_error if it is not convex or has no area.
BlockShape polygon_block(std::vector<Vec3> corners);
/// Rectangle (z ignored) or box.
BlockShape brick_block(const Vec3& low, const Vec3& high, bool plane);
BlockShape ball_block(const Vec3& centre, double radius);

struct MassProperties {
  double volume = 0.0;          ///< two dimensions: area times thickness
  Vec3 centre = Vec3::Zero();   ///< of mass
  Mat3 inertia = Mat3::Zero();  ///< about it, over density; in two dimensions only zz has a meaning
};
MassProperties mass_properties(const BlockShape& shape, bool plane, double thickness);

/// Area, centroid and unit normal of a convex polygon in space, oriented by its corners; an edge of two corners in the
/// plane z = 0: length times `thickness`, normal to the right of it, which is outward.
struct FaceGeometry {
  double area = 0.0;
  Vec3 centre = Vec3::Zero(), normal = Vec3::UnitX();
};
FaceGeometry face_geometry(std::span<const Vec3> corners, bool plane, double thickness);

/// A face of block `a`, shared with block `b` or free.
struct BlockFacet {
  static constexpr std::int64_t none = -1;
  std::int64_t a = none, b = none;
  std::vector<Vec3> corners;  ///< as of the face of a
  FaceGeometry geometry;      ///< normal from a to b
  double gap = 0.0;           ///< from a's face to b's
  Vec3 shift = Vec3::Zero();  ///< periodic boxes: the image of b is at its position + shift
  /// If it is a whole face of only one of the blocks: 1 for a, 2 for b; else 0. Such a contact moves with that block
  /// when it slides along the larger face of the other.
  int owner = 0;
  bool covered = false;  ///< a free face that another block covers in part
};

/// Blocks that fill a box, and the faces between them.
struct Tessellation {
  std::vector<BlockShape> shapes;
  std::vector<BlockFacet> facets;
};

/// Voronoi cells of nuclei in a box, cell k around nucleus k. Faces much smaller than the largest of their cell are
/// left out. In two dimensions by half-planes, in three by Voro++ (Rycroft, Chaos 19 (2009) 041111).
/// Throws std::runtime_error if two nuclei coincide or one lies outside.
Tessellation voronoi(std::span<const Vec3> nuclei, const Vec3& low, const Vec3& high, bool plane, double thickness,
                     const std::array<bool, 3>& periodic = {});

/// Finds touching free facets of blocks of different groups, at most `tolerance` apart, and adds facets of their
/// intersections; free facets that are covered as a whole are removed, others are marked. `group[k]` is that of block
/// k.
void join_faces(std::span<const std::int64_t> group, bool plane, double thickness, double tolerance,
                std::vector<BlockFacet>& facets);

/// The point of the surface of a convex body with faces that is nearest to x, the outward direction from there to x,
/// and the distance, negative inside.
struct NearestPoint {
  Vec3 at = Vec3::Zero(), out = Vec3::UnitX();
  double distance = 0.0;
};
NearestPoint nearest_point(const BlockShape& shape, const Vec3& x, bool plane);

}  // namespace tribo
