// SPDX-License-Identifier: MIT
/// Touching faces of blocks.

#include "blocks/shape.hpp"

#include <algorithm>
#include <cmath>

namespace tribo {
namespace {

constexpr double parallel = 1 - 5e-9;  // cosine of 1e-4 rad

// Intersection of a segment with another one on the same line.
std::vector<Vec3> common_segment(const std::vector<Vec3>& mine, const std::vector<Vec3>& theirs) {
  const Vec3 along = mine[1] - mine[0];
  const double length = along.norm();
  const Vec3 t = along / length;
  double low = t.dot(theirs[0] - mine[0]), high = t.dot(theirs[1] - mine[0]);
  if (low > high) std::swap(low, high);
  low = std::max(low, 0.0), high = std::min(high, length);
  if (high - low <= 1e-6 * length) return {};
  return {mine[0] + low * t, mine[0] + high * t};
}

// Intersection of a convex polygon with another one projected to its plane (Sutherland and Hodgman).
std::vector<Vec3> common_polygon(const std::vector<Vec3>& mine, const std::vector<Vec3>& theirs, const Vec3& n) {
  std::vector<Vec3> out = mine;
  for (std::size_t k = 0; k < theirs.size() && out.size() > 2; ++k) {
    const Vec3 &a = theirs[k], &b = theirs[(k + 1) % theirs.size()];
    const Vec3 outward = n.cross(b - a);  // the other polygon has the opposite orientation
    const auto side = [&](const Vec3& p) { return outward.dot(p - a); };
    std::vector<Vec3> cut;
    for (std::size_t i = 0; i < out.size(); ++i) {
      const Vec3 &p = out[i], &q = out[(i + 1) % out.size()];
      const double u = side(p), v = side(q);
      if (u <= 0) cut.push_back(p);
      if ((u <= 0) != (v <= 0)) cut.push_back(p + u / (u - v) * (q - p));
    }
    out.swap(cut);
  }
  return out.size() > 2 ? out : std::vector<Vec3>{};
}

}  // namespace

void join_faces(std::span<const std::int64_t> group, bool plane, double thickness, double tolerance,
                std::vector<BlockFacet>& facets) {
  struct Free {
    std::size_t facet;
    Vec3 low, high;
    double covered = 0;
  };
  std::vector<Free> list;
  for (std::size_t k = 0; k < facets.size(); ++k) {
    if (facets[k].b != BlockFacet::none) continue;
    Free f{k, facets[k].corners[0], facets[k].corners[0]};
    for (const Vec3& x : facets[k].corners) f.low = f.low.cwiseMin(x), f.high = f.high.cwiseMax(x);
    list.push_back(f);
  }
  std::sort(list.begin(), list.end(), [&](const Free& a, const Free& b) {
    return a.low[0] < b.low[0] || (a.low[0] == b.low[0] && a.facet < b.facet);
  });
  std::vector<BlockFacet> found;
  for (std::size_t i = 0; i < list.size(); ++i)
    for (std::size_t j = i + 1; j < list.size() && list[j].low[0] <= list[i].high[0] + tolerance; ++j) {
      const Free &fi = list[i], &fj = list[j];
      const bool swap = facets[fi.facet].a > facets[fj.facet].a;
      const BlockFacet &a = facets[swap ? fj.facet : fi.facet], &b = facets[swap ? fi.facet : fj.facet];
      if (group[static_cast<std::size_t>(a.a)] == group[static_cast<std::size_t>(b.a)]) continue;
      if ((fi.low.array() > fj.high.array() + tolerance).any() || (fj.low.array() > fi.high.array() + tolerance).any())
        continue;
      const Vec3& n = a.geometry.normal;
      if (n.dot(b.geometry.normal) > -parallel) continue;
      const double gap = n.dot(b.geometry.centre - a.geometry.centre);
      if (std::abs(gap) > tolerance) continue;
      std::vector<Vec3> theirs = b.corners;
      for (Vec3& x : theirs) x -= n.dot(x - a.geometry.centre) * n;
      BlockFacet f;
      f.corners = plane ? common_segment(a.corners, theirs) : common_polygon(a.corners, theirs, n);
      if (f.corners.empty()) continue;
      f.a = a.a, f.b = b.a, f.gap = gap;
      f.geometry = face_geometry(f.corners, plane, thickness);
      if (f.geometry.area <= 1e-6 * std::min(a.geometry.area, b.geometry.area)) continue;
      const bool all_a = f.geometry.area > (1 - 1e-6) * a.geometry.area,
                 all_b = f.geometry.area > (1 - 1e-6) * b.geometry.area;
      f.owner = all_a == all_b ? 0 : all_a ? 1 : 2;
      list[i].covered += f.geometry.area, list[j].covered += f.geometry.area;
      found.push_back(std::move(f));
    }
  for (const Free& f : list) {
    BlockFacet& facet = facets[f.facet];
    facet.covered = f.covered > 0;
    if (f.covered > (1 - 1e-6) * facet.geometry.area) facet.a = BlockFacet::none;
  }
  std::erase_if(facets, [](const BlockFacet& f) { return f.a == BlockFacet::none; });
  std::sort(found.begin(), found.end(),
            [](const BlockFacet& x, const BlockFacet& y) { return x.a < y.a || (x.a == y.a && x.b < y.b); });
  for (auto& f : found) facets.push_back(std::move(f));
}

}  // namespace tribo
