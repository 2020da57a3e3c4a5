// SPDX-License-Identifier: MIT
/// Candidate sites for particles.
#pragma once

#include "model/model.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

namespace tribo {

/// Regular sites: cell by cell, with `per_cell` sites in each cell. Covers the boxes passed to extend().
struct Sites {
  static constexpr double most_sites = 4e9;

  Vec3 origin = Vec3::Zero();   ///< low corner of cell 0
  Vec3 spacing = Vec3::Ones();  ///< distance between sites
  std::array<int, 3> per_cell{1, 1, 1};
  std::array<std::int64_t, 3> cells{1, 1, 1};  ///< number of cells; sites beyond are outside the grid
  bool of_cells = true;                        ///< the sites subdivide the grid cells
  bool flat = false;                           ///< two dimensions: sites at z = 0
  int last_piece = -1;                         ///< the last piece that uses it
  std::vector<bool> taken;

  using Range = std::array<std::array<std::int64_t, 2>, 3>;  ///< first cell and the one after the last, by axis

  /// Range of cells that overlap a box, enlarged by one cell on each side because of round-off.
  Range range(const Bounds& box) const {
    Range out{};
    for (std::size_t k = 0; k < 3; ++k) {
      const auto axis = static_cast<Eigen::Index>(k);
      const double size = spacing[axis] * per_cell[k], last = static_cast<double>(cells[k]);
      const auto cell = [&](double x) { return std::clamp(std::floor((x - origin[axis]) / size), -1.0, last); };
      if (flat && k == 2)
        out[k] = {0, 1};
      else if (box.low[axis] <= box.high[axis])
        out[k] = {std::max<std::int64_t>(0, static_cast<std::int64_t>(cell(box.low[axis])) - 1),
                  std::min(cells[k], static_cast<std::int64_t>(cell(box.high[axis])) + 2)};
    }
    return out;
  }

  /// Extends the covered range to the sites of a box.
  void extend(const Bounds& box) {
    const Range more = range(box);
    if (empty(more)) return;
    for (std::size_t k = 0; k < 3; ++k)
      extent_[k] = {started_ ? std::min(extent_[k][0], more[k][0]) : more[k][0],
                    started_ ? std::max(extent_[k][1], more[k][1]) : more[k][1]};
    started_ = true;
  }

  /// Allocates the sites. Returns false if there would be too many.
  bool allocate() {
    double count = 1.0;
    for (std::size_t k = 0; k < 3; ++k) count *= static_cast<double>(width(k));
    if (count > most_sites) return false;
    taken.assign(static_cast<std::size_t>(count), false);
    return true;
  }

  /// The same sites, but covering only those of the cells that overlap a box, and without `taken`. Visits of the box
  /// have the same order.
  Sites window(const Bounds& box) const {
    Sites out;
    out.origin = origin, out.spacing = spacing, out.per_cell = per_cell, out.cells = cells;
    out.of_cells = of_cells, out.flat = flat;
    out.extent_ = covered(box), out.started_ = true;
    return out;
  }

  /// Number of sites in the covered range.
  std::size_t count() const { return empty(extent_) ? 0 : sites_along(0) * sites_along(1) * sites_along(2); }
  /// Index of the neighbour of a site along an axis, at the low (-1) or high (+1) side; none beyond the covered range.
  std::optional<std::size_t> neighbour(std::size_t site, std::size_t axis, int side) const {
    const std::size_t stride = axis == 0 ? 1 : axis == 1 ? sites_along(0) : sites_along(0) * sites_along(1);
    const std::size_t at = site / stride % sites_along(axis);
    if (side < 0 ? at == 0 : at + 1 == sites_along(axis)) return std::nullopt;
    return side < 0 ? site - stride : site + stride;
  }

  /// Calls visit(position, index into `taken`) for the sites of the cells that overlap a box, in the fixed order.
  template <class F>
  void visit(const Bounds& box, F&& f) const {
    visit(covered(box), f);
  }
  /// Number of layers of cells that overlap a box.
  std::int64_t layers(const Bounds& box) const {
    const Range r = covered(box);
    return empty(r) ? 0 : r[slowest()][1] - r[slowest()][0];
  }
  /// The same as visit for one of these layers. One after the other, the layers give the fixed order.
  template <class F>
  void visit_layer(const Bounds& box, std::int64_t layer, F&& f) const {
    Range r = covered(box);
    auto& along = r[slowest()];
    along = {along[0] + layer, along[0] + layer + 1};
    visit(r, f);
  }

 private:
  std::size_t slowest() const { return flat ? 1 : 2; }
  // The covered cells that overlap a box.
  Range covered(const Bounds& box) const {
    Range r = range(box);
    for (std::size_t k = 0; k < 3; ++k) r[k] = {std::max(r[k][0], extent_[k][0]), std::min(r[k][1], extent_[k][1])};
    return r;
  }
  template <class F>
  void visit(const Range& r, F&& f) const {
    if (empty(r)) return;
    for (auto z = r[2][0]; z < r[2][1]; ++z)
      for (auto y = r[1][0]; y < r[1][1]; ++y)
        for (auto x = r[0][0]; x < r[0][1]; ++x)
          for (int c = 0; c < per_cell[2]; ++c)
            for (int b = 0; b < per_cell[1]; ++b)
              for (int a = 0; a < per_cell[0]; ++a) {
                const std::array<std::int64_t, 3> site{x * per_cell[0] + a, y * per_cell[1] + b, z * per_cell[2] + c};
                f(position(site), index(site));
              }
  }

  static bool empty(const Range& r) { return r[0][0] >= r[0][1] || r[1][0] >= r[1][1] || r[2][0] >= r[2][1]; }
  std::int64_t width(std::size_t k) const { return (extent_[k][1] - extent_[k][0]) * per_cell[k]; }
  std::size_t sites_along(std::size_t k) const { return static_cast<std::size_t>(width(k)); }
  std::size_t index(const std::array<std::int64_t, 3>& site) const {
    const auto in = [&](std::size_t k) { return site[k] - extent_[k][0] * per_cell[k]; };
    return static_cast<std::size_t>((in(2) * width(1) + in(1)) * width(0) + in(0));
  }
  Vec3 position(const std::array<std::int64_t, 3>& site) const {
    Vec3 x;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto axis = static_cast<Eigen::Index>(k);
      x[axis] = origin[axis] + (static_cast<double>(site[k]) + 0.5) * spacing[axis];
    }
    if (flat) x[2] = 0.0;
    return x;
  }

  Range extent_{};
  bool started_ = false;
};

/// The grid of the input as a box.
struct GridBox {
  Vec3 low, high, cell;
  std::array<int, 3> cells{};
  bool flat;

  /// Throws InputError if the grid has no extent or no cells.
  explicit GridBox(const Model& model) : flat(model.dimension() == 2) {
    for (std::size_t k = 0; k < 3; ++k) {
      const auto axis = static_cast<Eigen::Index>(k);
      low[axis] = model.grid.low[k], high[axis] = model.grid.high[k];
      cells[k] = flat && k == 2 ? 1 : model.grid.cells[k];
      if (flat && k == 2) low[axis] = -0.5, high[axis] = 0.5;
      if (!(high[axis] > low[axis]) || cells[k] < 1)
        throw InputError(model.grid.origin, "the grid has no extent or no cells");
      cell[axis] = (high[axis] - low[axis]) / cells[k];
    }
  }

  Sites lattice(const std::array<int, 3>& per_cell) const {
    Sites out;
    out.origin = low;
    out.per_cell = per_cell;
    out.flat = flat;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto axis = static_cast<Eigen::Index>(k);
      out.cells[k] = cells[k];
      out.spacing[axis] = cell[axis] / per_cell[k];
    }
    return out;
  }

  /// Lattice of single sites with spacing `size`, from a corner to the end of the grid.
  Sites lattice(const Vec3& corner, double size) const {
    Sites out;
    out.origin = corner;
    out.spacing = Vec3::Constant(size);
    out.of_cells = false;
    out.flat = flat;
    for (std::size_t k = 0; k < (flat ? 2u : 3u); ++k) {
      const auto axis = static_cast<Eigen::Index>(k);
      out.cells[k] = static_cast<std::int64_t>(std::clamp((high[axis] - corner[axis]) / size + 1.0, 1.0, 1e15));
    }
    return out;
  }

  Bounds clip(const Bounds& b) const {
    Bounds out{b.low.cwiseMax(low), b.high.cwiseMin(high)};
    if (flat) out.low[2] = low[2], out.high[2] = high[2];
    return out;
  }
  bool contains(const Vec3& x) const {
    for (int k = 0; k < (flat ? 2 : 3); ++k)
      if (!(x[k] >= low[k] && x[k] <= high[k])) return false;
    return true;
  }
  bool overlap(const Bounds& a, const Bounds& b) const {
    for (int k = 0; k < (flat ? 2 : 3); ++k)
      if (a.high[k] <= b.low[k] || b.high[k] <= a.low[k]) return false;
    return true;
  }
  bool overlaps(const Bounds& b) const { return overlap(b, {low, high}); }
  bool holds(const Bounds& b) const {
    const double slack = 1e-9 * cell.maxCoeff();
    for (int k = 0; k < (flat ? 2 : 3); ++k)
      if (b.low[k] < low[k] - slack || b.high[k] > high[k] + slack) return false;
    return true;
  }
};

}  // namespace tribo
