/// Which nodes of a regular lattice lie in a shape.
#pragma once

#include "geometry/region.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace tribo {

/// Node (i, j, k) is at low + (i, j, k) * spacing, counted from 0 to count - 1 on each axis; two dimensions: one layer.
struct NodeLattice {
  Vec3 low = Vec3::Zero(), spacing = Vec3::Ones();
  std::array<int, 3> count{1, 1, 1};

  Vec3 at(int i, int j, int k) const { return low + Vec3(i, j, k).cwiseProduct(spacing); }
};

/// Numbers i + count_x (j + count_y k) of the nodes in a shape, ascending. Only the shape's bounds are scanned.
/// A node that misses the shape by rounding (1e-9 of the spacing, along an axis) is in it.
inline std::vector<std::size_t> nodes_in(const NodeLattice& nodes, const Region& region) {
  constexpr double slack = 1e-9;
  const Bounds bounds = region.bounds();
  std::array<int, 3> first{}, end{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<Eigen::Index>(axis);
    const double low = (bounds.low[a] - nodes.low[a]) / nodes.spacing[a] - slack;
    const double high = (bounds.high[a] - nodes.low[a]) / nodes.spacing[a] + slack;
    first[axis] = static_cast<int>(std::ceil(std::clamp(low, 0.0, static_cast<double>(nodes.count[axis]))));
    end[axis] = static_cast<int>(std::floor(std::clamp(high, -1.0, nodes.count[axis] - 1.0))) + 1;
  }
  const auto inside = [&](const Vec3& x) {
    if (region.contains(x)) return true;
    for (int a = 0; a < 3; ++a)
      for (const double side : {-slack, slack})
        if (region.contains(x + side * nodes.spacing[a] * Vec3::Unit(a))) return true;
    return false;
  };
  std::vector<std::size_t> found;
  for (int k = first[2]; k < end[2]; ++k)
    for (int j = first[1]; j < end[1]; ++j)
      for (int i = first[0]; i < end[0]; ++i)
        if (inside(nodes.at(i, j, k)))
          found.push_back(static_cast<std::size_t>(i) +
                          static_cast<std::size_t>(nodes.count[0]) *
                              (static_cast<std::size_t>(j) +
                               static_cast<std::size_t>(nodes.count[1]) * static_cast<std::size_t>(k)));
  return found;
}

}  // namespace tribo
