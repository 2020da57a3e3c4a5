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

using Polygon = std::vector<Vec3>;

// The part of a polygon with n . x <= limit, or < limit if `strictly`; `spare` is scratch memory.
void cut(Polygon& polygon, const Vec3& n, double limit, Polygon& spare, bool strictly = false) {
  spare.clear();
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Vec3 &p = polygon[k], &q = polygon[(k + 1) % polygon.size()];
    const double u = n.dot(p) - limit, v = n.dot(q) - limit;
    const bool p_in = strictly ? u < 0 : u <= 0, q_in = strictly ? v < 0 : v <= 0;
    if (p_in) spare.push_back(p);
    if (p_in != q_in) spare.push_back(p + u / (u - v) * (q - p));
  }
  polygon.swap(spare);
}

void cut(Polygon& polygon, const PlacedBlock& by, Polygon& spare, bool strictly = false) {
  for (std::size_t f = 0; f < by.normals.size() && polygon.size() > 2; ++f)
    cut(polygon, by.normals[f], by.heights[f], spare, strictly);
}

struct Extent {
  double low = infinity, high = -infinity;
  void take(double x) { low = std::min(low, x), high = std::max(high, x); }
  double middle() const { return 0.5 * (low + high); }
};

}  // namespace

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
  shape = &what, edges = its_edges, centre = x;
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

namespace {

void share_in_plane(const PlacedBlock& a, const PlacedBlock& b, const JointAxes& axes, std::span<SharedPart> parts) {
  thread_local Polygon common, half, spare;  // scratch memory, kept from step to step
  common = a.corners;
  cut(common, b, spare);
  if (common.size() < 3) return;
  Extent width;
  for (const Vec3& x : common) width.take(axes.t.dot(x));
  for (std::size_t side = 0; side < 2; ++side) {
    const double sign = side == 0 ? 1.0 : -1.0;
    half = common;
    cut(half, sign * axes.t, sign * width.middle(), spare);
    if (half.size() < 3) continue;
    SharedPart& part = parts[side];
    Vec3 first = Vec3::Zero();
    for (std::size_t k = 1; k + 1 < half.size(); ++k) {
      const Vec3 u = half[k] - half[0], v = half[k + 1] - half[0];
      const double area = 0.5 * std::abs(u[0] * v[1] - u[1] * v[0]);
      part.volume += area, first += area / 3 * (u + v);
    }
    part.area = 0.5 * (width.high - width.low);
    part.at = part.volume > 0 ? Vec3(half[0] + first / part.volume) : half[0];
  }
}

// The surface of the intersection: the faces of each block inside the other. Faces of cuts through the apex of the
// cones have neither volume nor projected area and are not needed.
void share_in_space(const PlacedBlock& a, const PlacedBlock& b, const JointAxes& axes, std::span<SharedPart> parts) {
  struct Face {
    Polygon corners;
    double facing;  // its normal along n
  };
  thread_local std::vector<Face> faces;
  thread_local Polygon piece, spare;
  std::size_t count = 0;
  Extent s, t;
  for (const auto& [own, other, strictly] : {std::tuple{&a, &b, false}, std::tuple{&b, &a, true}})
    for (std::size_t f = 0; f < own->normals.size(); ++f) {
      if (count == faces.size()) faces.emplace_back();
      Face& face = faces[count];
      face.corners.clear();
      for (const auto k : own->shape->faces[f]) face.corners.push_back(own->corners[k]);
      face.facing = own->normals[f].dot(axes.n);
      cut(face.corners, *other, spare, strictly);
      if (face.corners.size() < 3) continue;
      for (const Vec3& x : face.corners) s.take(axes.s.dot(x)), t.take(axes.t.dot(x));
      ++count;
    }
  if (count == 0) return;
  const Vec3 o = s.middle() * axes.s + t.middle() * axes.t + axes.n.dot(faces[0].corners[0]) * axes.n;
  for (std::size_t quarter = 0; quarter < 4; ++quarter) {
    SharedPart& part = parts[quarter];
    const double us = quarter & 1 ? -1.0 : 1.0, ut = quarter & 2 ? -1.0 : 1.0;
    Vec3 first = Vec3::Zero();
    for (std::size_t f = 0; f < count; ++f) {
      piece = faces[f].corners;
      cut(piece, us * axes.s, us * s.middle(), spare);
      if (piece.size() > 2) cut(piece, ut * axes.t, ut * t.middle(), spare);
      for (std::size_t k = 1; k + 1 < piece.size(); ++k) {
        const Vec3 p = piece[0] - o, q = piece[k] - o, r = piece[k + 1] - o;
        const double cone = p.dot(q.cross(r)) / 6;
        part.volume += cone, first += 0.25 * cone * (p + q + r);
        if (faces[f].facing > 0) part.area += 0.5 * (q - p).cross(r - p).dot(axes.n);
      }
    }
    part.at = part.volume > 0 ? Vec3(o + first / part.volume) : o;
  }
}

}  // namespace

void share(const PlacedBlock& a, const PlacedBlock& b, const JointAxes& axes, bool plane, std::span<SharedPart> parts) {
  std::fill(parts.begin(), parts.end(), SharedPart{0.5 * (a.centre + b.centre), 0.0, 0.0});
  plane ? share_in_plane(a, b, axes, parts) : share_in_space(a, b, axes, parts);
}

}  // namespace tribo
