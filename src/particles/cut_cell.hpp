// SPDX-License-Identifier: MIT
/// The part of a particle's cell that lies inside a shape.
#pragma once

#include "base/types.hpp"

#include <array>
#include <functional>
#include <optional>
#include <vector>

namespace tribo {

/// A plane piece of the surface of a shape, within a cell.
struct SurfaceFacet {
  Vec3 normal;      ///< outward unit normal
  double area;      ///< [length^2]
  Vec3 centre;      ///< [length]
  Mat3 covariance;  ///< mean of (x - centre)(x - centre)^T [length^2]
};

/// The part of a box inside a shape. In two dimensions the box has the thickness 1, from z = -1/2 to 1/2.
struct CutCell {
  double volume = 0.0;                 ///< [length^3]
  Vec3 centroid = Vec3::Zero();        ///< [length]
  Vec3 low, high;                      ///< bounding box [length]
  std::vector<SurfaceFacet> facets;    ///< of the surface of the shape; one at most for each of its normals
  std::array<double, 6> open_areas{};  ///< areas of the sides low x, high x, low y ... inside the shape [length^2]

  /// Joins the parts of two neighbouring cells. Facets that continue each other become one.
  void join(const CutCell& other);
  /// Half axes, as columns, of the parallelepiped that represents the part: it is centred at the centroid, and the
  /// facets lie in its sides. Where there is one facet, one side has the facet's centre and area. [length]
  Mat3 half_axes(bool flat) const;
};

/// The part of the box `low`..`high` inside a shape; none if it is empty. Bounded by plane facets, whose normals and
/// positions follow from points of the surface, found by bisection along lines through the cell.
///
/// `inside`: whether a point lies in the shape; `flat`: two dimensions, only z = 0 is examined; `probes`: number of
/// points per axis, at least one of which must lie inside. Exact (1e-10 of the volume) where the surface within the box
/// consists of at most two (in space three) planes; relative error of second order in the size of the box for smooth
/// surfaces.
std::optional<CutCell> cut_cell(const std::function<bool(const Vec3&)>& inside, const Vec3& low, const Vec3& high,
                                bool flat, int probes = 3);

/// The whole box as an uncut part.
CutCell whole_cell(const Vec3& low, const Vec3& high);

}  // namespace tribo
