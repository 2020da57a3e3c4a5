// SPDX-License-Identifier: MIT
#include "blocks/shape.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

namespace tribo {
namespace {

double cross_z(const Vec3& a, const Vec3& b) { return a[0] * b[1] - a[1] * b[0]; }

MassProperties of_polygon(const BlockShape& shape, double thickness) {
  MassProperties out;
  const auto& x = shape.corners;
  const Vec3 origin = x.front();
  double area = 0, polar = 0;
  Vec3 first = Vec3::Zero();
  for (std::size_t k = 1; k + 1 < x.size(); ++k) {
    const Vec3 a = x[k] - origin, b = x[k + 1] - origin;
    const double twice = cross_z(a, b);
    area += 0.5 * twice;
    first += twice / 6 * (a + b);
    polar += twice / 12 * (a.squaredNorm() + a.dot(b) + b.squaredNorm());
  }
  const Vec3 c = first / area;
  out.volume = area * thickness, out.centre = origin + c;
  out.inertia = Mat3::Identity() * ((polar - area * c.squaredNorm()) * thickness);
  return out;
}

// By tetrahedra over the faces; covariance of a tetrahedron with a corner at the origin.
MassProperties of_polyhedron(const BlockShape& shape) {
  MassProperties out;
  const Vec3 origin = shape.corners.front();
  Vec3 first = Vec3::Zero();
  Mat3 second = Mat3::Zero();
  for (const auto& face : shape.faces)
    for (std::size_t k = 1; k + 1 < face.size(); ++k) {
      const Vec3 a = shape.corners[face[0]] - origin, b = shape.corners[face[k]] - origin,
                 c = shape.corners[face[k + 1]] - origin;
      const double det = a.dot(b.cross(c));
      out.volume += det / 6;
      const Vec3 sum = a + b + c;
      first += det / 24 * sum;
      second += det / 120 * (sum * sum.transpose() + a * a.transpose() + b * b.transpose() + c * c.transpose());
    }
  const Vec3 c = first / out.volume;
  out.centre = origin + c;
  second -= out.volume * c * c.transpose();
  out.inertia = second.trace() * Mat3::Identity() - second;
  return out;
}

}  // namespace

std::vector<Vec3> BlockShape::face(std::size_t f) const {
  std::vector<Vec3> out;
  for (const auto k : faces[f]) out.push_back(corners[k]);
  return out;
}

BlockShape polygon_block(std::vector<Vec3> corners) {
  const std::size_t n = corners.size();
  if (n < 3) throw std::runtime_error("a polygon needs at least three corners");
  double area = 0, size = 0;
  for (std::size_t k = 0; k < n; ++k) {
    area += 0.5 * cross_z(corners[k] - corners[0], corners[(k + 1) % n] - corners[0]);
    size = std::max(size, (corners[k] - corners[0]).squaredNorm());
  }
  if (std::abs(area) <= 1e-12 * size) throw std::runtime_error("the corners enclose no area");
  if (area < 0) std::reverse(corners.begin(), corners.end());
  double turned = 0;
  for (std::size_t k = 0; k < n; ++k) {
    const Vec3 u = corners[(k + 1) % n] - corners[k], v = corners[(k + 2) % n] - corners[(k + 1) % n];
    if (u.norm() * v.norm() <= 1e-14 * size) throw std::runtime_error("two corners coincide");
    const double sine = cross_z(u, v);
    if (sine < -1e-12 * size)
      throw std::runtime_error("the polygon is not convex; cut it into convex ones, and bond these");
    turned += std::atan2(sine, u.dot(v));
  }
  if (turned > 3 * std::numbers::pi) throw std::runtime_error("the polygon crosses itself");
  BlockShape out;
  out.corners = std::move(corners);
  for (std::uint32_t k = 0; k < n; ++k) out.faces.push_back({k, static_cast<std::uint32_t>((k + 1) % n)});
  return out;
}

BlockShape brick_block(const Vec3& low, const Vec3& high, bool plane) {
  if (plane)
    return polygon_block({{low[0], low[1], 0}, {high[0], low[1], 0}, {high[0], high[1], 0}, {low[0], high[1], 0}});
  if (!((high - low).minCoeff() > 0)) throw std::runtime_error("the box has no volume");
  BlockShape out;
  for (int k = 0; k < 8; ++k)
    out.corners.emplace_back(k & 1 ? high[0] : low[0], k & 2 ? high[1] : low[1], k & 4 ? high[2] : low[2]);
  out.faces = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
  return out;
}

BlockShape ball_block(const Vec3& centre, double radius) {
  if (!(radius > 0)) throw std::runtime_error("the radius must be positive");
  BlockShape out;
  out.corners = {centre}, out.radius = radius;
  return out;
}

MassProperties mass_properties(const BlockShape& shape, bool plane, double thickness) {
  if (!shape.ball()) return plane ? of_polygon(shape, thickness) : of_polyhedron(shape);
  constexpr double pi = std::numbers::pi;
  const double r = shape.radius;
  MassProperties out;
  out.centre = shape.corners.front();
  out.volume = plane ? pi * r * r * thickness : 4.0 / 3 * pi * r * r * r;
  out.inertia = Mat3::Identity() * (out.volume * r * r * (plane ? 0.5 : 0.4));
  return out;
}

FaceGeometry face_geometry(std::span<const Vec3> corners, bool plane, double thickness) {
  FaceGeometry out;
  if (plane) {
    const Vec3 along = corners[1] - corners[0];
    out.area = along.norm() * thickness;
    out.centre = 0.5 * (corners[0] + corners[1]);
    out.normal = Vec3(along[1], -along[0], 0).normalized();
    return out;
  }
  Vec3 sum = Vec3::Zero();
  for (std::size_t k = 1; k + 1 < corners.size(); ++k)
    sum += 0.5 * (corners[k] - corners[0]).cross(corners[k + 1] - corners[0]);
  out.area = sum.norm();
  out.normal = sum / out.area;
  for (std::size_t k = 1; k + 1 < corners.size(); ++k) {
    const double part = 0.5 * (corners[k] - corners[0]).cross(corners[k + 1] - corners[0]).dot(out.normal);
    out.centre += part / out.area * ((corners[k] - corners[0]) + (corners[k + 1] - corners[0])) / 3;
  }
  out.centre += corners[0];
  return out;
}

namespace {

Vec3 nearest_on_edge(const Vec3& a, const Vec3& b, const Vec3& x) {
  const Vec3 along = b - a;
  return a + std::clamp((x - a).dot(along) / along.squaredNorm(), 0.0, 1.0) * along;
}

}  // namespace

NearestPoint nearest_point(const BlockShape& shape, const Vec3& x, bool plane) {
  NearestPoint out;
  double highest = -std::numeric_limits<double>::infinity(), nearest = std::numeric_limits<double>::infinity();
  Vec3 above = Vec3::UnitX(), at = Vec3::Zero();  // of the face that x is highest above; the nearest point
  const auto take = [&](const Vec3& point) {
    const double square = (x - point).squaredNorm();
    if (square < nearest) nearest = square, at = point;
  };
  for (const auto& face : shape.faces) {
    const std::size_t n = face.size();
    const auto corner = [&](std::size_t k) -> const Vec3& { return shape.corners[face[k % n]]; };
    const Vec3 along = corner(1) - corner(0);
    const Vec3 normal =
        plane ? Vec3(along[1], -along[0], 0).normalized() : along.cross(corner(2) - corner(1)).normalized();
    const double height = normal.dot(x - corner(0));
    if (height > highest) highest = height, above = normal;
    if (height <= 0) continue;
    bool over = !plane;  // x lies over the face itself
    for (std::size_t k = 0; k < n && over; ++k)
      over = normal.dot((corner(k + 1) - corner(k)).cross(x - corner(k))) >= 0;
    if (over) take(x - height * normal);
    for (std::size_t k = 0; k < (plane ? 1 : n) && !over; ++k) take(nearest_on_edge(corner(k), corner(k + 1), x));
  }
  if (highest <= 0 || !(nearest > 0)) return {x - highest * above, above, highest};
  out.at = at, out.distance = std::sqrt(nearest), out.out = (x - at) / out.distance;
  return out;
}

}  // namespace tribo
