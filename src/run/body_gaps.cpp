// SPDX-License-Identifier: MIT
#include "run/body_gaps.hpp"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <limits>
#include <unordered_map>

namespace tribo {
namespace {

// Half axes of the domain of a particle at the start, as columns.
template <int Dim>
Mat<Dim> axes_of(const Seed& seed) {
  return (seed.F * seed.half_axes.value_or(Mat3(seed.half_size.asDiagonal()))).template topLeftCorner<Dim, Dim>();
}

// Distance of two parallelepipeds along the one of their face normals where it is largest; negative: they overlap.
template <int Dim>
double separation(const Vec<Dim>& between, const Mat<Dim>& a, const Mat<Dim>& b) {
  double most = -std::numeric_limits<double>::infinity();
  for (const Mat<Dim>* of : {&a, &b}) {
    const Mat<Dim> normals = of->inverse().transpose().colwise().normalized();
    for (int k = 0; k < Dim; ++k) {
      const auto n = normals.col(k);
      most = std::max(
          most, std::abs(between.dot(n)) - (a.transpose() * n).cwiseAbs().sum() - (b.transpose() * n).cwiseAbs().sum());
    }
  }
  return most;
}

// The smallest and the largest number of the materials with particles in a cell or its neighbourhood.
struct MaterialRange {
  int low, high;
  void include(const MaterialRange& other) { low = std::min(low, other.low), high = std::max(high, other.high); }
};
using CellMaterials = std::unordered_map<std::int64_t, MaterialRange>;

constexpr int reach = 2;  // cells

// For the cells near particles the range of the materials within `reach` cells, axis by axis.
template <int Dim>
CellMaterials materials_near(const Seeds& seeds, const Lattice<Dim>& lattice) {
  CellMaterials cells;
  const auto add = [](CellMaterials& to, std::int64_t cell, const MaterialRange& range) {
    const auto [known, fresh] = to.try_emplace(cell, range);
    if (!fresh) known->second.include(range);
  };
  for (const Seed& seed : seeds)
    add(cells, lattice.cell_number(seed.x.template head<Dim>()), {seed.material, seed.material});
  for (int axis = 0; axis < Dim; ++axis) {
    CellMaterials wider;
    for (const auto& [cell, range] : cells)
      for (int k = -reach; k <= reach; ++k) add(wider, cell + k * lattice.cell_stride(axis), range);
    cells = std::move(wider);
  }
  return cells;
}

bool one_material(const Seeds& seeds) {
  const int first = seeds.empty() ? 0 : seeds.front().material;
  return std::all_of(seeds.begin(), seeds.end(), [&](const Seed& seed) { return seed.material == first; });
}

}  // namespace

template <int Dim>
Gaps smallest_gaps(const Seeds& seeds, const Lattice<Dim>& lattice) {
  Gaps gaps;
  if (one_material(seeds)) return gaps;
  const auto near = materials_near(seeds, lattice);
  std::unordered_map<std::int64_t, std::vector<Seed>> cells;  // that another material is near, with their particles
  for (const Seed& seed : seeds) {
    const std::int64_t cell = lattice.cell_number(seed.x.template head<Dim>());
    if (const MaterialRange& range = near.at(cell); range.low != range.high) cells[cell].push_back(seed);
  }
  const double h = lattice.smallest_spacing();
  const auto compare = [&](const Seed& a, const Seed& b) {
    if (a.material >= b.material) return;
    const double gap = separation<Dim>((a.x - b.x).template head<Dim>(), axes_of<Dim>(a), axes_of<Dim>(b)) / h;
    const auto [known, fresh] = gaps.try_emplace({a.material, b.material}, gap);
    if (!fresh) known->second = std::min(known->second, gap);
  };
  Index<Dim> low, high;
  low.fill(-reach), high.fill(reach);
  for (const auto& [cell, mine] : cells) {
    const std::int64_t at = cell;
    const std::vector<Seed>& here = mine;
    each_in_box<Dim>(low, high, [&](const Index<Dim>& shift) {
      std::int64_t other = at;
      for (int axis = 0; axis < Dim; ++axis) other += shift[static_cast<std::size_t>(axis)] * lattice.cell_stride(axis);
      const auto found = cells.find(other);
      if (found == cells.end()) return;
      for (const Seed& a : here)
        for (const Seed& b : found->second) compare(a, b);
    });
  }
  return gaps;
}

template Gaps smallest_gaps<2>(const Seeds&, const Lattice<2>&);
template Gaps smallest_gaps<3>(const Seeds&, const Lattice<3>&);

}  // namespace tribo
