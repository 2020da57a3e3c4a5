// SPDX-License-Identifier: MIT
#include "blocks/overlap.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

namespace tribo {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
}

std::vector<BlockEdge> edges_of(const BlockShape& shape) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> left;  // of directed edges
  for (std::uint32_t f = 0; f < shape.faces.size(); ++f) {
    const auto& face = shape.faces[f];
    for (std::size_t k = 0; face.size() > 2 && k < face.size(); ++k) left[{face[k], face[(k + 1) % face.size()]}] = f;
  }
  std::vector<BlockEdge> out;
  for (const auto& [ends, face] : left)
    if (const auto other = left.find({ends.second, ends.first}); ends.first < ends.second && other != left.end())
      out.push_back({ends.first, ends.second, face, other->second});
  return out;
}

void PlacedBlock::place(const BlockShape& what, std::span<const BlockEdge> its_edges, const Vec3& x, const Mat3& R,
                        bool plane) {
  shape = &what, edges = its_edges, centre = x, back = no_face, grown = 0.0;
  corners.clear(), normals.clear(), heights.clear();
  for (const Vec3& c : what.corners) corners.push_back(x + R * c);
  for (const auto& face : what.faces) {
    const Vec3 &p = corners[face[0]], &q = corners[face[1]];
    Vec3 n(q[1] - p[1], p[0] - q[0], 0);
    if (!plane) {  // from the whole face, as corners may be close together
      n.setZero();
      for (std::size_t k = 1; k + 1 < face.size(); ++k) n += (corners[face[k]] - p).cross(corners[face[k + 1]] - p);
    }
    normals.push_back(n.normalized()), heights.push_back(normals.back().dot(p));
  }
}

namespace {

void separate_by_faces(const PlacedBlock& a, const PlacedBlock& b, double sign, double enough, BlockGap& best) {
  for (std::size_t f = 0; f < a.normals.size() && !(best.gap > enough); ++f) {
    double least = infinity;
    for (const Vec3& x : b.corners) least = std::min(least, a.normals[f].dot(x));
    if (least - a.heights[f] > best.gap) best = {least - a.heights[f], sign * a.normals[f]};
  }
}

void separate_by_edges(const PlacedBlock& a, const PlacedBlock& b, double enough, BlockGap& best) {
  if (best.gap < 0) best.gap *= 0.95;
  const BlockGap faces = best;
  thread_local std::vector<double> along;  // edge of a times the normals of b
  for (const BlockEdge& i : a.edges) {
    const Vec3 &p = a.corners[i.from], u = a.corners[i.to] - p;
    const Vec3 &left = a.normals[i.left], &right = a.normals[i.right];
    along.clear();
    for (const Vec3& n : b.normals) along.push_back(n.dot(u));
    for (const BlockEdge& j : b.edges) {
      const double c = along[j.left], d = along[j.right];
      if (c * d >= 0) continue;
      const Vec3 &q = b.corners[j.from], v = b.corners[j.to] - q;
      const double e = left.dot(v), f = right.dot(v);
      if (e * f >= 0 || c * f >= 0) continue;
      Vec3 n = u.cross(v);
      const double size = n.norm();
      if (size <= 1e-6 * std::sqrt(u.squaredNorm() * v.squaredNorm())) continue;
      n /= n.dot(p - a.centre) > 0 ? size : -size;
      if (const double gap = n.dot(q - p); gap > best.gap) best = {gap, n};
      if (best.gap > enough) return;
    }
  }
  if (best.n == faces.n && faces.gap < 0) best.gap = faces.gap / 0.95;
}

}  // namespace

BlockGap separation(const PlacedBlock& a, const PlacedBlock& b, bool plane, double enough) {
  BlockGap best{-infinity, Vec3::UnitX()};
  separate_by_faces(a, b, 1.0, enough, best);
  separate_by_faces(b, a, -1.0, enough, best);
  if (!plane && !(best.gap > enough)) separate_by_edges(a, b, enough, best);
  return best;
}

}  // namespace tribo
