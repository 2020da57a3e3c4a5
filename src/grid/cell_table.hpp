// SPDX-License-Identifier: MIT
/// Table of objects by the lattice cells that their bounding boxes overlap.
#pragma once

#include "grid/lattice.hpp"

#include <cmath>
#include <cstdint>
#include <unordered_map>
#include <vector>

namespace tribo {

template <int Dim, class T>
class CellTable {
 public:
  explicit CellTable(const Lattice<Dim>& lattice) : lattice_(lattice) {}

  /// Adds an object to all cells that overlap its bounding box; the box must be finite.
  void add(const Vec<Dim>& low, const Vec<Dim>& high, const T& thing) {
    each_cell(low, high, [&](std::int64_t cell) { cells_[cell].push_back(thing); });
  }
  /// Calls f(object) for the objects in all cells of a box. An object is visited once for each of its cells in the box.
  template <class F>
  void each(const Vec<Dim>& low, const Vec<Dim>& high, F&& f) const {
    each_cell(low, high, [&](std::int64_t cell) {
      const auto found = cells_.find(cell);
      if (found == cells_.end()) return;
      for (const T& thing : found->second) f(thing);
    });
  }

 private:
  template <class F>
  void each_cell(const Vec<Dim>& low, const Vec<Dim>& high, F&& f) const {
    Index<Dim> first, last;
    for (std::size_t d = 0; d < Dim; ++d) {
      const auto axis = static_cast<Eigen::Index>(d);
      const auto cell = [&](double at) {
        return static_cast<int>(std::floor((at - lattice_.origin[axis]) / lattice_.spacing[axis]));
      };
      first[d] = cell(low[axis]), last[d] = cell(high[axis]);
    }
    each_in_box<Dim>(first, last, [&](const Index<Dim>& cell) {
      constexpr std::int64_t row = std::int64_t{1} << 20;
      f(((Dim == 3 ? cell[Dim - 1] : 0) * row + cell[1]) * row + cell[0]);
    });
  }

  const Lattice<Dim>& lattice_;
  std::unordered_map<std::int64_t, std::vector<T>> cells_;
};

}  // namespace tribo
