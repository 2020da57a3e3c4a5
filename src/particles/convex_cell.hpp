// SPDX-License-Identifier: MIT
/// Convex polyhedra: a box from which half spaces are cut off.
#pragma once

#include "base/types.hpp"

#include <vector>

namespace tribo {

/// A plane face of a polyhedron.
struct CellFace {
  std::vector<Vec3> corners;  ///< in order around the face, counterclockwise seen from outside  [length]
  /// 0 to 5: the sides of the box, low x, high x, low y ...; 6 + k: the cut with number k.
  int plane = 0;

  Vec3 vector_area() const;  ///< area times outward unit normal                              [length^2]
  Vec3 centre() const;       ///< centroid                                                    [length]
  Mat3 covariance() const;   ///< mean of (x - centre)(x - centre)^T over the face            [length^2]
};

/// A box cut by planes.
class ConvexCell {
 public:
  static constexpr int first_cut = 6;

  ConvexCell(const Vec3& low, const Vec3& high);
  /// Keeps the part with x . n <= at. `n`: unit vector; `number`: of the cut, at least 0.
  void cut(const Vec3& n, double at, int number);

  const std::vector<CellFace>& faces() const { return faces_; }
  double volume() const;  ///< [length^3]
  Vec3 centroid() const;  ///< of a cell with a volume [length]

 private:
  std::vector<CellFace> faces_;
};

}  // namespace tribo
