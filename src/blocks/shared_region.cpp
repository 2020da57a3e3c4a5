// SPDX-License-Identifier: MIT
#include "blocks/shared_region.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tribo {
namespace {

using Polygon = std::vector<Vec3>;

// The part of a polygon, or of an edge of two corners, with n . x <= limit, or < limit if `strictly`; `spare` is
// scratch memory.
void cut(Polygon& polygon, const Vec3& n, double limit, Polygon& spare, bool strictly = false) {
  spare.clear();
  const auto inside = [&](double u) { return strictly ? u < 0 : u <= 0; };
  const std::size_t count = polygon.size(), edges = count == 2 ? 1 : count;
  for (std::size_t k = 0; k < edges; ++k) {
    const Vec3 &p = polygon[k], &q = polygon[k + 1 < count ? k + 1 : 0];
    const double u = n.dot(p) - limit, v = n.dot(q) - limit;
    if (inside(u)) spare.push_back(p);
    if (inside(u) != inside(v)) spare.push_back(p + u / (u - v) * (q - p));
    if (count == 2 && inside(v)) spare.push_back(q);
  }
  polygon.swap(spare);
}

// A corner of a polygon and the face of the edge that begins there.
struct Corner {
  Vec3 x;
  std::size_t face;
};

void cut(std::vector<Corner>& polygon, const Vec3& n, double limit, std::size_t face, std::vector<Corner>& spare) {
  spare.clear();
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Corner &p = polygon[k], &q = polygon[k + 1 < polygon.size() ? k + 1 : 0];
    const double u = n.dot(p.x) - limit, v = n.dot(q.x) - limit;
    if (u <= 0) spare.push_back(p);
    if ((u <= 0) != (v <= 0)) spare.push_back({p.x + u / (u - v) * (q.x - p.x), u <= 0 ? face : p.face});
  }
  polygon.swap(spare);
}

struct Extent {
  double low = std::numeric_limits<double>::infinity(), high = -std::numeric_limits<double>::infinity();
  void take(double x) { low = std::min(low, x), high = std::max(high, x); }
  double middle() const { return 0.5 * (low + high); }
};

}  // namespace

SharedRegion::Side& SharedRegion::add_side() {
  if (count_ == sides_.size()) sides_.emplace_back();
  sides_[count_].corners.clear();
  return sides_[count_];
}

void SharedRegion::find_edges(const PlacedBlock& a, const PlacedBlock& b) {
  thread_local std::vector<Corner> common, spare;
  common.clear();
  for (std::size_t f = 0; f < a.normals.size(); ++f) {
    common.push_back({a.corners[a.shape->faces[f][0]], f});
    if (!(a.grown > 0)) continue;
    const Vec3 both = a.normals[f > 0 ? f - 1 : a.normals.size() - 1] + a.normals[f];
    common.back().x += 2 * a.grown / both.squaredNorm() * both;
  }
  if (a.back < a.normals.size()) cut(common, a.normals[a.back], a.height(a.back), a.back, spare);
  for (std::size_t f = 0; f < b.normals.size() && common.size() > 2; ++f)
    cut(common, b.normals[f], b.height(f), faces_of_a_ + f, spare);
  if (common.size() < 3) return;
  for (std::size_t k = 0; k < common.size(); ++k) {
    Side& side = add_side();
    side.corners = {common[k].x, common[(k + 1) % common.size()].x};
    side.face = common[k].face;
    side.out = side.face < faces_of_a_ ? a.normals[side.face] : b.normals[side.face - faces_of_a_];
    ++count_;
  }
}

namespace {

// The section of a block where one of its faces was moved to; `polygon` is this face where it was.
void section(const PlacedBlock& block, std::size_t face, Polygon& polygon, Polygon& spare) {
  const Vec3& n = block.normals[face];
  const Vec3 middle = polygon[0] - (n.dot(polygon[0]) - block.height(face)) * n;
  double wide = 0.0;
  for (const Vec3& x : block.corners) wide = std::max(wide, 4 * ((x - middle).norm() + block.grown));
  const Vec3 s = wide * (polygon[1] - polygon[0]).normalized(), t = n.cross(s);
  polygon.assign({middle - s - t, middle + s - t, middle + s + t, middle - s + t});
  for (std::size_t g = 0; g < block.normals.size() && polygon.size() > 2; ++g)
    if (g != face) cut(polygon, block.normals[g], block.height(g), spare);
}

}  // namespace

// The faces of one block inside the other.
void SharedRegion::find_faces(const PlacedBlock& own, const PlacedBlock& other, bool strictly, std::size_t first_face) {
  thread_local Polygon spare;
  for (std::size_t f = 0; f < own.normals.size(); ++f) {
    Side& side = add_side();
    Polygon& polygon = side.corners;
    for (const auto k : own.shape->faces[f]) polygon.push_back(own.corners[k]);
    if (f == own.back || own.grown > 0)
      section(own, f, polygon, spare);
    else if (own.back < own.normals.size())
      cut(polygon, own.normals[own.back], own.height(own.back), spare);
    for (std::size_t g = 0; g < other.normals.size() && polygon.size() > 2; ++g)
      cut(polygon, other.normals[g], other.height(g), spare, strictly);
    if (polygon.size() < 3) continue;
    side.out = own.normals[f], side.face = first_face + f;
    ++count_;
  }
}

// Integrals over a piece of a side, from the prisms between it and the plane through the origin normal to n. Sides and
// cuts parallel to n add nothing.
void SharedRegion::add(const Side& side, const Polygon& piece, const Vec3& n, bool pushes, Sums& to) const {
  const std::size_t m = plane_ ? 2 : 3;
  for (std::size_t k = 1; k + (m - 2) < piece.size(); ++k) {
    const std::array<Vec3, 3> x{piece[0] - origin_, piece[k] - origin_, piece[plane_ ? k : k + 1] - origin_};
    const double size = plane_ ? (x[1] - x[0]).norm() : 0.5 * (x[1] - x[0]).cross(x[2] - x[0]).dot(side.out);
    // of linear functions over a segment or a triangle: mean f = sum f/m, mean f g = (sum f sum g + sum f g)/(m (m+1))
    const auto moment = [&](const std::array<double, 3>& f) {
      Vec3 sum = Vec3::Zero(), product = Vec3::Zero();
      double all = 0;
      for (std::size_t i = 0; i < m; ++i) sum += x[i], product += f[i] * x[i], all += f[i];
      return Vec3((all * sum + product) / static_cast<double>(m * (m + 1)));
    };
    const auto mean = [&](const std::array<double, 3>& f) {
      return plane_ ? 0.5 * (f[0] + f[1]) : (f[0] + f[1] + f[2]) / 3;
    };
    const std::array<double, 3> z{n.dot(x[0]), n.dot(x[1]), n.dot(x[2])};
    const double facing = size * side.out.dot(n);
    Vec3 first = facing * moment(z);
    first -= 0.5 * n.dot(first) * n;
    to.volume += facing * mean(z), to.first += first;
    if (!pushes || side.face == face_ || (side.face < faces_of_a_) != of_a_) continue;
    std::array<double, 3> depth;
    for (std::size_t i = 0; i < 3; ++i) depth[i] = std::max(0.0, height_ - out_.dot(origin_ + x[i]));
    to.push += size * mean(depth) * side.out, to.turn += (size * moment(depth)).cross(side.out);
  }
}

void SharedRegion::choose_face(const PlacedBlock& a, const PlacedBlock& b) {
  double least = std::numeric_limits<double>::infinity();
  const auto take = [&](const PlacedBlock& of, std::size_t first_face) {
    for (std::size_t f = 0; f < of.normals.size(); ++f) {
      const double depth = of.height(f) - of.normals[f].dot(centre_);
      if (!(depth < (1 - 1e-9) * least)) continue;  // equal ones: always the first
      least = depth, face_ = first_face + f, height_ = of.height(f), out_ = of.normals[f];
    }
  };
  take(a, 0), take(b, faces_of_a_);
  of_a_ = face_ < faces_of_a_;
  normal_ = of_a_ ? out_ : Vec3(-out_);
}

bool SharedRegion::find(const PlacedBlock& a, const PlacedBlock& b, const Vec3& along, bool plane) {
  count_ = 0, volume_ = 0.0, plane_ = plane, faces_of_a_ = a.normals.size();
  if (plane)
    find_edges(a, b);
  else
    find_faces(a, b, false, 0), find_faces(b, a, true, faces_of_a_);
  if (count_ == 0) return false;
  origin_ = sides_[0].corners[0];
  Sums all;
  for (std::size_t k = 0; k < count_; ++k) add(sides_[k], sides_[k].corners, along, false, all);
  if (!(all.volume > 0)) return false;
  volume_ = all.volume, centre_ = origin_ + all.first / all.volume;
  choose_face(a, b);
  return energy() > 0;
}

double SharedRegion::deepest(const PlacedBlock& block, std::size_t face) const {
  double out = 0.0;
  for (std::size_t k = 0; k < count_; ++k)
    for (const Vec3& x : sides_[k].corners) out = std::max(out, block.height(face) - block.normals[face].dot(x));
  return out;
}

SharedPart SharedRegion::part_of(const Sums& sums) const {
  SharedPart out{centre_, normal_, 0.0, 0.0, 0.0};
  if (!(sums.volume > 0)) return out;
  const Vec3 c = sums.first / sums.volume, at = origin_ + c;
  const double sign = of_a_ ? 1.0 : -1.0, energy = sums.volume * (height_ - out_.dot(at));
  const Vec3 force = sums.volume * normal_ + sign * sums.push, turn = sign * (sums.turn - c.cross(sums.push));
  const double size = force.norm();
  if (!(energy > 0 && size > 0)) return out;
  out.n = force / size, out.at = at + force.cross(turn) / (size * size);
  out.area = size * size / (2 * energy), out.depth = 2 * energy / size;
  if (!plane_) out.couple = turn.dot(out.n) / size;
  return out;
}

void SharedRegion::share(const JointAxes& axes, std::span<SharedPart> parts) const {
  thread_local Polygon piece, spare;
  Extent s, t;
  for (std::size_t k = 0; k < count_; ++k)
    for (const Vec3& x : sides_[k].corners) s.take(axes.s.dot(x)), t.take(axes.t.dot(x));
  for (std::size_t quarter = 0; quarter < parts.size(); ++quarter) {
    const double us = quarter & 2 ? -1.0 : 1.0, ut = quarter & 1 ? -1.0 : 1.0;
    Sums sums;
    for (std::size_t k = 0; k < count_; ++k) {
      piece = sides_[k].corners;
      cut(piece, ut * axes.t, ut * t.middle(), spare);
      if (!plane_ && piece.size() > 2) cut(piece, us * axes.s, us * s.middle(), spare);
      if (piece.size() > (plane_ ? 1 : 2)) add(sides_[k], piece, normal_, true, sums);
    }
    parts[quarter] = part_of(sums);
  }
}

}  // namespace tribo
