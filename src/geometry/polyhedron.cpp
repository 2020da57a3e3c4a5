// SPDX-License-Identifier: MIT
#include "geometry/directions.hpp"
#include "geometry/interval.hpp"
#include "geometry/region.hpp"
#include "geometry/surface.hpp"

#include <Eigen/Geometry>

namespace tribo {
namespace {

// Distance of p from a triangle. Ericson, Real-Time Collision Detection (2005), section 5.1.5.
double distance(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 ab = b - a, ac = c - a, ap = p - a, bp = p - b, cp = p - c;
  const double d1 = ab.dot(ap), d2 = ac.dot(ap), d3 = ab.dot(bp), d4 = ac.dot(bp), d5 = ab.dot(cp), d6 = ac.dot(cp);
  if (d1 <= 0.0 && d2 <= 0.0) return ap.norm();
  if (d3 >= 0.0 && d4 <= d3) return bp.norm();
  if (d6 >= 0.0 && d5 <= d6) return cp.norm();
  const double vc = d1 * d4 - d3 * d2, vb = d5 * d2 - d1 * d6, va = d3 * d6 - d5 * d4;
  if (vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0) return (ap - d1 / (d1 - d3) * ab).norm();
  if (vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0) return (ap - d2 / (d2 - d6) * ac).norm();
  if (va <= 0.0 && d4 - d3 >= 0.0 && d5 - d6 >= 0.0) return (bp - (d4 - d3) / ((d4 - d3) + (d5 - d6)) * (c - b)).norm();
  const double sum = va + vb + vc;
  return (ap - vb / sum * ab - vc / sum * ac).norm();
}

// The facets are sorted into columns of a grid in the x-y plane. A point is inside if the number of facets above it is
// odd.
//
// Whether a vertical line crosses a facet is decided edge by edge with a half-open rule. Each edge is evaluated from
// its lower to its higher corner, so that both facets of an edge get identical results. The count is therefore even
// outside and odd inside for any closed surface, also if the line passes exactly through edges and corners.
class Polyhedron final : public Region {
 public:
  explicit Polyhedron(Surface surface) : surface_(std::move(surface)), volume_(surface_.volume()) {
    slack_ = rounding * std::max(surface_.low.cwiseAbs().maxCoeff(), surface_.high.cwiseAbs().maxCoeff());
    const double facets = static_cast<double>(surface_.facets.size());
    const double wide = surface_.high[0] - surface_.low[0], deep = surface_.high[1] - surface_.low[1];
    const double side = std::sqrt(wide * deep / facets);
    for (int k = 0; k < 2; ++k) {
      const double extent = surface_.high[k] - surface_.low[k];
      const double wanted = side > 0.0 ? extent / side : facets;
      columns_[k] =
          static_cast<int>(std::clamp(std::ceil(wanted), 1.0, std::min(4.0 * std::sqrt(facets) + 1.0, 4096.0)));
      scale_[k] = extent > 0.0 ? columns_[k] / extent : 0.0;
    }
    sort_into_columns();
  }

  bool contains(const Vec3& p) const override {
    if ((p.array() < surface_.low.array() - slack_).any() || (p.array() > surface_.high.array() + slack_).any())
      return false;
    const auto column = static_cast<std::size_t>(index(1, p[1]) * columns_[0] + index(0, p[0]));
    bool inside = false;
    for (auto k = starts_[column]; k < starts_[column + 1]; ++k) {
      const auto& f = surface_.facets[static_cast<std::size_t>(list_[k])];
      const Vec3 &a = at(f[0]), &b = at(f[1]), &c = at(f[2]);
      const auto beyond = [&](int i) {
        return p[i] > std::max({a[i], b[i], c[i]}) + slack_ || p[i] < std::min({a[i], b[i], c[i]}) - slack_;
      };
      if (beyond(0) || beyond(1) || p[2] > std::max({a[2], b[2], c[2]}) + slack_) continue;
      if (!beyond(2) && distance(p, a, b, c) <= slack_) return true;
      if (crosses(f, p) && height(a, b, c, p) > p[2]) inside = !inside;
    }
    return inside;
  }
  Bounds bounds() const override { return {surface_.low, surface_.high}; }
  std::optional<double> measure() const override { return volume_; }
  bool curved() const override {
    Directions normals;
    for (const auto& f : surface_.facets) normals.add((at(f[1]) - at(f[0])).cross(at(f[2]) - at(f[0])));
    return normals.curved();
  }

 private:
  const Vec3& at(std::int32_t corner) const { return surface_.corners[static_cast<std::size_t>(corner)]; }

  int index(int k, double x) const {
    return std::clamp(static_cast<int>((x - surface_.low[k]) * scale_[k]), 0, columns_[k] - 1);
  }

  // Whether the edge lies to the right of p, seen from above, within a half-open range of y.
  bool right(std::int32_t i, std::int32_t j, const Vec3& p) const {
    const Vec3 &a = at(std::min(i, j)), &b = at(std::max(i, j));
    if ((a[1] > p[1]) == (b[1] > p[1])) return false;
    return a[0] + (p[1] - a[1]) / (b[1] - a[1]) * (b[0] - a[0]) > p[0];
  }
  bool crosses(const std::array<std::int32_t, 3>& f, const Vec3& p) const {
    return right(f[0], f[1], p) != (right(f[1], f[2], p) != right(f[2], f[0], p));
  }
  // Height of the plane of the facet at p; for a vertical facet any height on it.
  static double height(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& p) {
    const Vec3 n = (b - a).cross(c - a);
    const double low = std::min({a[2], b[2], c[2]}), high = std::max({a[2], b[2], c[2]});
    if (n[2] == 0.0) return 0.5 * (low + high);
    return std::clamp(a[2] - (n[0] * (p[0] - a[0]) + n[1] * (p[1] - a[1])) / n[2], low, high);
  }

  template <class F>
  void for_each_column(const std::array<std::int32_t, 3>& f, F&& visit) const {
    const Vec3 low = at(f[0]).cwiseMin(at(f[1])).cwiseMin(at(f[2])).array() - slack_;
    const Vec3 high = at(f[0]).cwiseMax(at(f[1])).cwiseMax(at(f[2])).array() + slack_;
    for (int j = index(1, low[1]); j <= index(1, high[1]); ++j)
      for (int i = index(0, low[0]); i <= index(0, high[0]); ++i)
        visit(static_cast<std::size_t>(j) * static_cast<std::size_t>(columns_[0]) + static_cast<std::size_t>(i));
  }

  void sort_into_columns() {
    starts_.assign(static_cast<std::size_t>(columns_[0]) * static_cast<std::size_t>(columns_[1]) + 1, 0);
    for (const auto& f : surface_.facets) for_each_column(f, [&](std::size_t column) { ++starts_[column + 1]; });
    for (std::size_t k = 1; k < starts_.size(); ++k) starts_[k] += starts_[k - 1];
    list_.resize(starts_.back());
    auto next = starts_;
    for (std::size_t k = 0; k < surface_.facets.size(); ++k)
      for_each_column(surface_.facets[k],
                      [&](std::size_t column) { list_[next[column]++] = static_cast<std::int32_t>(k); });
  }

  Surface surface_;
  std::optional<double> volume_;
  double slack_ = 0.0;
  int columns_[2] = {1, 1};
  double scale_[2] = {0.0, 0.0};
  std::vector<std::size_t> starts_;
  std::vector<std::int32_t> list_;
};

}  // namespace

RegionPtr polyhedron(const std::vector<std::array<Vec3, 3>>& triangles) {
  return std::make_shared<Polyhedron>(Surface(triangles, 1e-9));
}

RegionPtr surface_body(const std::string& path, double scale, const Vec3& shift, const std::string& group) {
  auto triangles = read_surface(path, group);
  for (auto& t : triangles)
    for (auto& x : t) x = scale * x + shift;
  try {
    // Such files have single precision: coordinates of the same corner may differ in their last bits.
    return std::make_shared<Polyhedron>(Surface(triangles, 1e-6));
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(path + ": " + error.what());
  }
}

}  // namespace tribo
