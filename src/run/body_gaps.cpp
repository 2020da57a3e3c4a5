// SPDX-License-Identifier: MIT
#include "run/body_gaps.hpp"

#include <Eigen/LU>

#include <array>
#include <cmath>
#include <limits>
#include <set>

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

}  // namespace

template <int Dim>
Gaps smallest_gaps(const std::vector<Seed>& seeds, const Lattice<Dim>& lattice) {
  const double h = lattice.smallest_spacing();
  using Cell = std::array<int, 3>;
  const auto cell_of = [&](const Vec3& x) {
    Cell c{};
    for (std::size_t d = 0; d < Dim; ++d) {
      const auto k = static_cast<Eigen::Index>(d);
      c[d] = static_cast<int>(std::floor((x[k] - lattice.low[k]) / lattice.spacing[k]));
    }
    return c;
  };
  std::map<Cell, std::vector<std::size_t>> cells;
  std::map<Cell, std::set<int>> here;
  for (std::size_t i = 0; i < seeds.size(); ++i) {
    const Cell c = cell_of(seeds[i].x);
    cells[c].push_back(i);
    here[c].insert(seeds[i].material);
  }
  Gaps gaps;
  const auto around = [](const Cell& c, auto&& f) {
    const int deep = Dim == 3 ? 2 : 0;
    for (int k = -deep; k <= deep; ++k)
      for (int j = -2; j <= 2; ++j)
        for (int i = -2; i <= 2; ++i) f(Cell{c[0] + i, c[1] + j, c[2] + k});
  };
  for (const auto& entry : cells) {
    const Cell& c = entry.first;
    const auto& list = entry.second;
    bool alone = true;
    around(c, [&](const Cell& n) {
      if (const auto found = here.find(n); found != here.end() && found->second != here.at(c)) alone = false;
    });
    if (alone && here.at(c).size() == 1) continue;
    around(c, [&](const Cell& n) {
      const auto found = cells.find(n);
      if (found == cells.end()) return;
      for (const std::size_t i : list)
        for (const std::size_t j : found->second)
          if (seeds[i].material < seeds[j].material) {
            const Vec<Dim> between = (seeds[i].x - seeds[j].x).template head<Dim>();
            const double gap = separation<Dim>(between, axes_of<Dim>(seeds[i]), axes_of<Dim>(seeds[j])) / h;
            const auto [known, fresh] = gaps.try_emplace({seeds[i].material, seeds[j].material}, gap);
            if (!fresh) known->second = std::min(known->second, gap);
          }
    });
  }
  return gaps;
}

template Gaps smallest_gaps<2>(const std::vector<Seed>&, const Lattice<2>&);
template Gaps smallest_gaps<3>(const std::vector<Seed>&, const Lattice<3>&);

}  // namespace tribo
