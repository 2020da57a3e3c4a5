// SPDX-License-Identifier: MIT
/// The particles of a shape whose cells are cut by its surface.
#pragma once

#include "particles/cut_cell.hpp"
#include "particles/sites.hpp"

#include <unordered_map>

namespace tribo {

/// Which sites of a lattice carry particles of a shape, and which of these have cut cells.
class CutSites {
 public:
  /// `centres`: per site whether the shape contains it; sites whose neighbourhood is uniform are not examined further,
  /// unless `all` is true. `inside`: whether a point lies in the shape, called on several threads at a time; `reach`:
  /// bounding box of the shape.
  ///
  /// Parts of less than 0.3 of a cell are joined with the neighbour at their largest side inside the shape, so that no
  /// particle has a tiny mass.
  CutSites(const Sites& lattice, const Bounds& reach, const std::vector<bool>& centres,
           const std::function<bool(const Vec3&)>& inside, bool all);

  /// The cut cell of a site; null if its cell is whole or empty.
  const CutCell* cut(std::size_t site) const {
    const auto found = cut_.find(site);
    return found == cut_.end() ? nullptr : &found->second;
  }
  /// Whether the site carries a particle with a whole cell.
  bool is_whole(std::size_t site) const { return whole_[site]; }
  /// Scales the volumes of the cut cells so that all particles together have the volume `exact`. Does nothing if that
  /// would change them by more than 5 %.
  void scale_to(double exact);

 private:
  void join_small_parts();
  std::optional<std::size_t> best_neighbour(std::size_t site, const CutCell& cell) const;
  CutCell box(const Vec3& centre) const;

  const Sites& lattice_;
  std::vector<bool> whole_;
  std::unordered_map<std::size_t, CutCell> cut_;
  std::unordered_map<std::size_t, Vec3> centre_of_;  // of the cells that were examined
};

}  // namespace tribo
