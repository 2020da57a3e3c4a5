// SPDX-License-Identifier: MIT
#include "geometry/point_sets.hpp"

#include <algorithm>
#include <cmath>
#include <random>
#include <stdexcept>

namespace tribo {
namespace {

/// Points in a box, stored in square (cubic) cells with the smallest allowed distance as edge: at most a few per cell.
class Places {
 public:
  Places(const Vec3& low, const Vec3& high, double distance, bool plane)
      : low_(low), distance_(distance), plane_(plane) {
    for (int d = 0; d < 3; ++d) count_[d] = plane && d == 2 ? 1 : 1 + static_cast<int>((high[d] - low[d]) / distance);
    cells_.resize(static_cast<std::size_t>(count_[0]) * static_cast<std::size_t>(count_[1]) *
                  static_cast<std::size_t>(count_[2]));
  }
  bool free(const Vec3& x) const {
    const auto at = cell(x);
    for (int k = plane_ ? 0 : -1; k <= (plane_ ? 0 : 1); ++k)
      for (int j = -1; j <= 1; ++j)
        for (int i = -1; i <= 1; ++i) {
          const Eigen::Vector3i n = at + Eigen::Vector3i(i, j, k);
          if ((n.array() < 0).any() || (n.array() >= count_.array()).any()) continue;
          for (const Vec3& other : cells_[index(n)])
            if ((other - x).squaredNorm() < distance_ * distance_) return false;
        }
    return true;
  }
  void add(const Vec3& x) { cells_[index(cell(x))].push_back(x); }

 private:
  Eigen::Vector3i cell(const Vec3& x) const {
    Eigen::Vector3i n;
    for (int d = 0; d < 3; ++d) n[d] = std::clamp(static_cast<int>((x[d] - low_[d]) / distance_), 0, count_[d] - 1);
    return n;
  }
  std::size_t index(const Eigen::Vector3i& n) const {
    return static_cast<std::size_t>((n[2] * count_[1] + n[1]) * count_[0] + n[0]);
  }
  Vec3 low_;
  double distance_;
  bool plane_;
  Eigen::Vector3i count_;
  std::vector<std::vector<Vec3>> cells_;
};

}  // namespace

std::vector<Vec3> random_points(std::size_t count, const Vec3& low, const Vec3& high, bool plane, double apart,
                                std::uint64_t seed) {
  const Vec3 size = high - low;
  const double volume_per_point = (plane ? size[0] * size[1] : size.prod()) / static_cast<double>(count);
  const double distance = apart * (plane ? std::sqrt(volume_per_point) : std::cbrt(volume_per_point));
  // The generator gives the same bits on every platform; the distributions of the standard library do not.
  std::mt19937_64 bits(seed);
  const auto some = [&] { return std::ldexp(static_cast<double>((bits() >> 11) | 1), -53); };
  Places places(low, high, std::max(distance, 1e-3 * std::cbrt(volume_per_point)), plane);
  std::vector<Vec3> out;
  for (std::size_t tries = 0; out.size() < count; ++tries) {
    if (tries > 2000 * count)
      throw std::runtime_error("only " + std::to_string(out.size()) + " of " + std::to_string(count) +
                               " nuclei could be placed; reduce 'apart'");
    Vec3 x = low;
    for (int d = 0; d < (plane ? 2 : 3); ++d) x[d] += some() * size[d];
    if (!places.free(x)) continue;
    places.add(x), out.push_back(x);
  }
  return out;
}

std::vector<Vec3> lattice_points(PointLattice lattice, double spacing, const Vec3& low, const Vec3& high, bool plane) {
  Vec3 cell = Vec3::Ones();
  std::vector<Vec3> basis{Vec3::Constant(0.5)};  // points of one cell
  if (lattice == PointLattice::hexagons)
    cell[0] = std::sqrt(3.0), basis = {{0.25, 0.25, 0}, {0.75, 0.75, 0}};
  else if (lattice == PointLattice::octahedra)
    basis = {Vec3::Constant(0.25), Vec3::Constant(0.75)};
  std::vector<Vec3> out;
  const Vec3 size = ((high - low) / spacing).cwiseQuotient(cell) * (1 - 1e-9);
  for (int i = 0; i < size[0]; ++i)
    for (const Vec3& at : basis)
      for (int j = 0; i + at[0] < size[0] && j + at[1] < size[1]; ++j)
        for (int k = 0; plane ? k == 0 : k + at[2] < size[2]; ++k) {
          const Vec3 x = low + spacing * cell.cwiseProduct(Vec3(i, j, k) + at);
          out.emplace_back(x[0], x[1], plane ? 0.0 : x[2]);
        }
  return out;
}

}  // namespace tribo
