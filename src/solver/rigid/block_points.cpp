// SPDX-License-Identifier: MIT
#include "solver/rigid/block_points.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace tribo {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double depth = 0.01;  // thickness of the surface layer [cells]

/// A piece of the surface: a parallelogram (in two dimensions a segment) with its centre and two half axes [length].
struct Patch {
  Vec3 centre, u, v;
};

/// The half space x . n <= at that a face bounds.
struct Plane {
  Vec3 n;
  double at;
};

/// Divides the surface of a block into patches.
class SurfaceLayer {
 public:
  explicit SurfaceLayer(double cell) : cell_(cell) {}
  std::vector<Patch> patches;

  void edge(const Vec3& a, const Vec3& b, double longest) {
    const int count = pieces(b - a, longest);
    for (int k = 0; k < count; ++k)
      patches.push_back({a + (k + 0.5) / count * (b - a), 0.5 / count * (b - a), Vec3::UnitZ()});
  }
  void parallelogram(const Vec3& corner, const Vec3& u, const Vec3& v) {
    const int m = pieces(u, 0.5), n = pieces(v, 0.5);
    for (int i = 0; i < m; ++i)
      for (int j = 0; j < n; ++j)
        patches.push_back({corner + (i + 0.5) / m * u + (j + 0.5) / n * v, 0.5 / m * u, 0.5 / n * v});
  }
  // One parallelogram at each corner, spanned by half of the two edges: their union is exactly the triangle.
  void triangle(const Vec3& a, const Vec3& b, const Vec3& c) {
    const std::array<Vec3, 3> x{a, b, c};
    const std::array<double, 3> length{(b - a).norm(), (c - b).norm(), (a - c).norm()};
    const auto k = static_cast<std::size_t>(std::max_element(length.begin(), length.end()) - length.begin());
    if (length[k] > cell_) {
      const Vec3 middle = 0.5 * (x[k] + x[(k + 1) % 3]);
      triangle(x[k], middle, x[(k + 2) % 3]), triangle(middle, x[(k + 1) % 3], x[(k + 2) % 3]);
      return;
    }
    for (std::size_t i = 0; i < 3; ++i)
      parallelogram(x[i], 0.5 * (x[(i + 1) % 3] - x[i]), 0.5 * (x[(i + 2) % 3] - x[i]));
  }
  void face(const std::vector<Vec3>& x) {
    if (x.size() == 4 && (x[0] - x[1] + x[2] - x[3]).norm() < 1e-9 * (x[2] - x[0]).norm())
      return parallelogram(x[0], x[1] - x[0], x[3] - x[0]);
    const Vec3 middle = face_geometry(x, false, 1.0).centre;
    for (std::size_t k = 0; k < x.size(); ++k) triangle(x[k], x[(k + 1) % x.size()], middle);
  }
  // Circumscribed polygon with short edges, symmetric to both axes; its distance from the disc is of second order in
  // their length.
  void disc(const Vec3& centre, double radius) {
    const int count = std::max(12, 4 * static_cast<int>(std::ceil(0.5 * pi * radius / (0.25 * cell_))));
    const auto at = [&](double k) {
      return Vec3(centre +
                  radius / std::cos(pi / count) * Vec3(std::cos(2 * pi * k / count), std::sin(2 * pi * k / count), 0));
    };
    for (int k = 0; k < count; ++k) edge(at(k), at(k + 1), 1.0);
  }
  // The sides of a cube divided by equal angles and projected to the sphere, which is symmetric to all axes.
  void ball(const Vec3& centre, double radius) {
    const int count = std::max(4, static_cast<int>(std::ceil(std::sqrt(4 * pi / 0.6) * radius / cell_)));
    const double half = 0.25 * pi / count;  // angle
    for (int side = 0; side < 6; ++side) {
      const int axis = side / 2;
      const Vec3 out = (side % 2 == 0 ? 1.0 : -1.0) * Vec3::Unit(axis), e = Vec3::Unit((axis + 1) % 3),
                 f = Vec3::Unit((axis + 2) % 3);
      for (int i = 0; i < count; ++i)
        for (int j = 0; j < count; ++j) {
          const double a = std::tan((2 * i + 1 - count) * half), b = std::tan((2 * j + 1 - count) * half);
          const Vec3 x = out + a * e + b * f, n = x.normalized();
          const auto along = [&](double slope, const Vec3& t) {  // half axis on the tangent plane
            return Vec3(radius * half * (1 + slope * slope) / x.norm() * (t - t.dot(n) * n));
          };
          patches.push_back({centre + radius * n, along(a, e), along(b, f)});
        }
    }
  }

 private:
  int pieces(const Vec3& along, double longest) const {
    return std::max(1, static_cast<int>(std::ceil(along.norm() / (longest * cell_) - 1e-9)));
  }
  double cell_;
};

std::vector<Plane> planes_of(const BlockShape& shape, bool plane) {
  std::vector<Plane> out;
  for (std::size_t f = 0; f < shape.faces.size(); ++f) {
    const auto corners = shape.face(f);
    const Vec3 n = face_geometry(corners, plane, 1.0).normal;
    out.push_back({n, n.dot(corners.front())});
  }
  return out;
}

/// Whether a cube (in plane analyses a square) with centre x and half edge `half` lies within a block with its centre
/// at the origin.
bool contains(const BlockShape& shape, const std::vector<Plane>& planes, const Vec3& x, double half, bool plane) {
  if (shape.ball()) return x.norm() + half * std::sqrt(plane ? 2.0 : 3.0) <= shape.radius;
  return std::all_of(planes.begin(), planes.end(),
                     [&](const Plane& p) { return p.n.dot(x) + half * p.n.lpNorm<1>() <= p.at; });
}

/// A particle whose domain has the half axes `axes`: an orthogonal domain deformed by F.
Seed seed_from_axes(const Vec3& x, Mat3 axes, double volume) {
  if (axes.determinant() < 0) axes.col(0) *= -1;
  Seed seed;
  seed.x = x;
  seed.half_size = axes.colwise().norm().transpose();
  seed.F = axes.colwise().normalized();
  seed.volume = volume / seed.F.determinant();
  return seed;
}

}  // namespace

std::vector<Seed> block_points(const BlockShape& shape, const Vec3& centre, int material, double density, bool plane,
                               double thickness, double cell) {
  Vec3 reach = Vec3::Zero();
  for (const Vec3& x : shape.corners) reach = reach.cwiseMax(x.cwiseAbs());
  if (shape.ball()) reach.setConstant(shape.radius);

  std::vector<Seed> out;
  double inside = 0.0;
  const double size = 0.5 * cell, cell_volume = size * size * (plane ? thickness : size);
  const auto planes = planes_of(shape, plane);
  const auto count = [&](int d) { return static_cast<int>(std::ceil(reach[d] / size)); };
  const int layers = plane ? 1 : 2 * count(2);
  for (int k = 0; k < layers; ++k)
    for (int j = -count(1); j < count(1); ++j)
      for (int i = -count(0); i < count(0); ++i) {
        const Vec3 x((i + 0.5) * size, (j + 0.5) * size, plane ? 0.0 : (k - count(2) + 0.5) * size);
        if (!contains(shape, planes, x, 0.5 * size, plane)) continue;
        Mat3 axes = 0.5 * size * Mat3::Identity();
        if (plane) axes(2, 2) = 0.5 * thickness;
        out.push_back(seed_from_axes(centre + x, axes, cell_volume));
        inside += cell_volume;
      }

  SurfaceLayer layer(cell);
  if (shape.ball() && plane)
    layer.disc(Vec3::Zero(), shape.radius);
  else if (shape.ball())
    layer.ball(Vec3::Zero(), shape.radius);
  else
    for (std::size_t f = 0; f < shape.faces.size(); ++f) {
      const auto corners = shape.face(f);
      plane ? layer.edge(corners[0], corners[1], 0.5) : layer.face(corners);
    }
  double area = 0.0;
  for (const Patch& p : layer.patches) area += p.u.cross(p.v).norm();
  const double volume = mass_properties(shape, plane, thickness).volume,
               rest = std::max(volume - inside, 1e-3 * volume);
  for (const Patch& p : layer.patches) {
    Vec3 n = p.u.cross(p.v).normalized();
    if (n.dot(p.centre) < 0) n = -n;
    Mat3 axes;
    axes << p.u, 0.5 * depth * cell * n, p.v;
    if (plane) axes.col(2) *= 0.5 * thickness;
    out.push_back(
        seed_from_axes(centre + p.centre - 0.5 * depth * cell * n, axes, rest * p.u.cross(p.v).norm() / area));
  }
  for (Seed& seed : out) seed.material = material, seed.mass = density * seed.volume * seed.F.determinant();
  return out;
}

}  // namespace tribo
