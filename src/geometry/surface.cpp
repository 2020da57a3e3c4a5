// SPDX-License-Identifier: MIT
#include "geometry/surface.hpp"

#include "base/text.hpp"
#include "geometry/interval.hpp"

#include <Eigen/Geometry>

#include <sstream>
#include <unordered_map>

namespace tribo {
namespace {

using Cell = std::array<std::int64_t, 3>;

struct CellHash {
  std::size_t operator()(const Cell& c) const {
    std::size_t h = 0;
    for (const auto k : c) h = (h ^ static_cast<std::size_t>(k)) * 0x9E3779B97F4A7C15ull, h ^= h >> 29;
    return h;
  }
};

// Merges points closer than a tolerance. Points in the same or neighbouring cells of a grid with this spacing are
// compared in their order; the first one within the tolerance is taken.
class Joiner {
 public:
  Joiner(std::vector<Vec3>& corners, const Vec3& low, double tolerance)
      : corners_(corners), low_(low), tolerance_(tolerance) {}

  std::int32_t operator()(const Vec3& x) {
    const Cell home = cell(x);
    if (const auto found = cells_.find(home); found != cells_.end() && near(found->second, x)) return found->second;
    Cell c;
    for (c[0] = home[0] - 1; c[0] <= home[0] + 1; ++c[0])
      for (c[1] = home[1] - 1; c[1] <= home[1] + 1; ++c[1])
        for (c[2] = home[2] - 1; c[2] <= home[2] + 1; ++c[2])
          if (const auto found = cells_.find(c); found != cells_.end() && near(found->second, x)) return found->second;
    corners_.push_back(x);
    const auto number = static_cast<std::int32_t>(corners_.size() - 1);
    cells_.emplace(home, number);
    return number;
  }

 private:
  Cell cell(const Vec3& x) const {
    Cell c;
    for (int k = 0; k < 3; ++k)
      c[static_cast<std::size_t>(k)] = static_cast<std::int64_t>(std::floor((x[k] - low_[k]) / tolerance_));
    return c;
  }
  bool near(std::int32_t corner, const Vec3& x) const {
    return (corners_[static_cast<std::size_t>(corner)] - x).cwiseAbs().maxCoeff() <= tolerance_;
  }

  std::vector<Vec3>& corners_;
  Vec3 low_;
  double tolerance_;
  std::unordered_map<Cell, std::int32_t, CellHash> cells_;
};

std::string coordinates(const Vec3& x) {
  std::ostringstream out;
  out.imbue(std::locale::classic());
  out << "(" << x[0] << ", " << x[1] << ", " << x[2] << ")";
  return out.str();
}

struct Uses {
  int count = 0;
  int direction = 0;  // sum of +1 per facet that traverses the edge from the lower to the higher corner, -1 otherwise
};

// Throws at the first open edge. Returns true if every edge is traversed once in each direction.
bool check_closed(const Surface& surface) {
  const auto key = [](std::int32_t a, std::int32_t b) {
    return (static_cast<std::uint64_t>(static_cast<std::uint32_t>(std::min(a, b))) << 32) |
           static_cast<std::uint32_t>(std::max(a, b));
  };
  std::unordered_map<std::uint64_t, Uses> edges;
  edges.reserve(surface.facets.size() * 3 / 2);
  for (const auto& f : surface.facets)
    for (std::size_t k = 0; k < 3; ++k) {
      Uses& uses = edges[key(f[k], f[(k + 1) % 3])];
      ++uses.count;
      uses.direction += f[k] < f[(k + 1) % 3] ? 1 : -1;
    }
  bool oriented = true;
  for (const auto& f : surface.facets)
    for (std::size_t k = 0; k < 3; ++k) {
      const Uses& uses = edges[key(f[k], f[(k + 1) % 3])];
      if (uses.count != 2)
        throw std::runtime_error("the surface is not closed: the edge from " +
                                 coordinates(surface.corners[static_cast<std::size_t>(f[k])]) + " to " +
                                 coordinates(surface.corners[static_cast<std::size_t>(f[(k + 1) % 3])]) +
                                 " belongs to " + counted(uses.count, "facet") + " instead of 2");
      oriented = oriented && uses.direction == 0;
    }
  return oriented;
}

}  // namespace

Surface::Surface(const std::vector<std::array<Vec3, 3>>& triangles, double tolerance) {
  if (triangles.empty()) throw std::runtime_error("the surface has no facets");
  if (triangles.size() > 500'000'000) throw std::runtime_error("the surface has more than 500 million facets");
  low = high = triangles.front()[0];
  for (const auto& t : triangles)
    for (const auto& x : t) {
      require_finite("the surface", x[0], x[1], x[2]);
      low = low.cwiseMin(x), high = high.cwiseMax(x);
    }
  const double extent = (high - low).maxCoeff();
  if (!std::isfinite(extent) || !(extent > 0.0)) throw std::runtime_error("the surface has no extent");

  Joiner join(corners, low, std::max(tolerance * extent, rounding * extent));
  facets.reserve(triangles.size());
  for (const auto& t : triangles) {
    const std::array<std::int32_t, 3> f{join(t[0]), join(t[1]), join(t[2])};
    if (f[0] != f[1] && f[1] != f[2] && f[2] != f[0]) facets.push_back(f);
  }
  if (facets.empty()) throw std::runtime_error("the surface has no facets with an area");
  oriented = check_closed(*this);
}

std::optional<double> Surface::volume() const {
  if (!oriented) return std::nullopt;
  double six = 0.0;
  const Vec3 middle = 0.5 * (low + high);
  for (const auto& f : facets) {
    const auto at = [&](std::size_t k) -> Vec3 { return corners[static_cast<std::size_t>(f[k])] - middle; };
    six += at(0).dot(at(1).cross(at(2)));
  }
  return std::abs(six) / 6.0;
}

}  // namespace tribo
