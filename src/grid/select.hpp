// SPDX-License-Identifier: MIT
/// Selection of the lattice nodes in a shape.
#pragma once

#include "geometry/region.hpp"
#include "grid/lattice.hpp"

#include <algorithm>
#include <cmath>

namespace tribo {

/// Calls f(node) for the nodes in a shape, x fastest. Only the bounding box of the shape is scanned. A node within
/// round-off of the shape (1e-9 of the spacing along an axis) is included.
template <int Dim, class F>
void each_node_in(const Lattice<Dim>& lattice, const Region& region, F&& f) {
  constexpr double slack = 1e-9;
  const Bounds bounds = region.bounds();
  Index<3> from{0, 0, 0}, to{0, 0, 0};
  for (std::size_t d = 0; d < Dim; ++d) {
    const auto axis = static_cast<Eigen::Index>(d);
    const double last = lattice.blocks[d] * block_edge<Dim> - 1.0;
    const auto cells = [&](double x) { return (x - lattice.origin[axis]) / lattice.spacing[axis]; };
    from[d] = static_cast<int>(std::ceil(std::clamp(cells(bounds.low[axis]) - slack, 0.0, last + 1)));
    to[d] = static_cast<int>(std::floor(std::clamp(cells(bounds.high[axis]) + slack, -1.0, last)));
  }
  const auto inside = [&](const Vec3& x) {
    if (region.contains(x)) return true;
    // A box without thickness contains only points with exactly its coordinate, from which round-off moves nodes.
    const Vec3 nearest = x.cwiseMax(bounds.low).cwiseMin(bounds.high);
    if ((nearest - x).template head<Dim>().cwiseAbs().cwiseQuotient(lattice.spacing).maxCoeff() <= slack &&
        region.contains(nearest))
      return true;
    for (int d = 0; d < Dim; ++d)
      for (const double side : {-slack, slack})
        if (region.contains(x + side * lattice.spacing[d] * Vec3::Unit(d))) return true;
    return false;
  };
  for (int k = from[2]; k <= to[2]; ++k)
    for (int j = from[1]; j <= to[1]; ++j)
      for (int i = from[0]; i <= to[0]; ++i) {
        Index<Dim> node{};
        node[0] = i, node[1] = j;
        if constexpr (Dim == 3) node[2] = k;
        Vec3 x = Vec3::Zero();
        x.head<Dim>() = lattice.position(node);
        if (inside(x)) f(node);
      }
}

}  // namespace tribo
