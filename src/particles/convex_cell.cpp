// SPDX-License-Identifier: MIT
#include "particles/convex_cell.hpp"

#include <algorithm>
#include <cmath>

namespace tribo {
namespace {

// Calls f(a, b, c) for the triangles of a fan around the first corner.
template <class F>
void each_triangle(const std::vector<Vec3>& x, F&& f) {
  for (std::size_t k = 2; k < x.size(); ++k) f(x[0], x[k - 1], x[k]);
}

// Removes the part of a face beyond the plane. The points where its edges cross the plane are added to `cut`.
std::vector<Vec3> part_below(const std::vector<Vec3>& corners, const Vec3& n, double at, std::vector<Vec3>& cut) {
  std::vector<Vec3> kept;
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const Vec3 &a = corners[k], &b = corners[(k + 1) % corners.size()];
    const double ha = a.dot(n) - at, hb = b.dot(n) - at;
    if (ha <= 0) kept.push_back(a);
    if (ha == 0) cut.push_back(a);
    if ((ha < 0 && hb > 0) || (ha > 0 && hb < 0)) {
      // From the lower to the higher end, so that both faces of an edge find the same point
      const Vec3 x = ha < 0 ? Vec3(a + ha / (ha - hb) * (b - a)) : Vec3(b + hb / (hb - ha) * (a - b));
      kept.push_back(x), cut.push_back(x);
    }
  }
  return kept;
}

// Sorts points of a plane around their mean, counterclockwise seen from the side to which n points.
void sort_around(std::vector<Vec3>& points, const Vec3& n) {
  Vec3 middle = Vec3::Zero();
  for (const Vec3& x : points) middle += x;
  middle /= static_cast<double>(points.size());
  Eigen::Index least;
  n.cwiseAbs().minCoeff(&least);
  const Vec3 u = n.cross(Vec3::Unit(least)).normalized(), v = n.cross(u);
  const auto angle = [&](const Vec3& x) { return std::atan2((x - middle).dot(v), (x - middle).dot(u)); };
  std::sort(points.begin(), points.end(), [&](const Vec3& a, const Vec3& b) { return angle(a) < angle(b); });
}

}  // namespace

Vec3 CellFace::vector_area() const {
  Vec3 sum = Vec3::Zero();
  each_triangle(corners, [&](const Vec3& a, const Vec3& b, const Vec3& c) { sum += 0.5 * (b - a).cross(c - a); });
  return sum;
}

Vec3 CellFace::centre() const {
  const Vec3 n = vector_area().normalized();
  Vec3 sum = Vec3::Zero();
  double area = 0.0;
  each_triangle(corners, [&](const Vec3& a, const Vec3& b, const Vec3& c) {
    const double of = 0.5 * (b - a).cross(c - a).dot(n);
    area += of, sum += of / 3 * (a + b + c);
  });
  return area > 0 ? Vec3(sum / area) : corners.front();
}

// The quadrature at the middles of the edges of a triangle is exact for second moments.
Mat3 CellFace::covariance() const {
  const Vec3 n = vector_area().normalized(), middle = centre();
  Mat3 sum = Mat3::Zero();
  double area = 0.0;
  each_triangle(corners, [&](const Vec3& a, const Vec3& b, const Vec3& c) {
    const double of = 0.5 * (b - a).cross(c - a).dot(n);
    area += of;
    for (const Vec3& x : {Vec3(0.5 * (a + b) - middle), Vec3(0.5 * (b + c) - middle), Vec3(0.5 * (c + a) - middle)})
      sum += of / 3 * x * x.transpose();
  });
  return area > 0 ? Mat3(sum / area) : sum;
}

ConvexCell::ConvexCell(const Vec3& low, const Vec3& high) {
  const auto corner = [&](int bits) {
    return Vec3((bits & 1) != 0 ? high[0] : low[0], (bits & 2) != 0 ? high[1] : low[1],
                (bits & 4) != 0 ? high[2] : low[2]);
  };
  for (int axis = 0; axis < 3; ++axis) {
    const int u = 1 << (axis + 1) % 3, v = 1 << (axis + 2) % 3, w = 1 << axis;
    faces_.push_back({{corner(0), corner(v), corner(u | v), corner(u)}, 2 * axis});
    faces_.push_back({{corner(w), corner(w | u), corner(w | u | v), corner(w | v)}, 2 * axis + 1});
  }
}

void ConvexCell::cut(const Vec3& n, double at, int number) {
  double highest = -1.0;
  for (const CellFace& face : faces_)
    for (const Vec3& x : face.corners) highest = std::max(highest, x.dot(n) - at);
  if (!(highest > 0)) return;
  CellFace cap;
  cap.plane = first_cut + number;
  std::vector<CellFace> kept;
  for (const CellFace& face : faces_) {
    CellFace rest{part_below(face.corners, n, at, cap.corners), face.plane};
    if (rest.corners.size() >= 3) kept.push_back(std::move(rest));
  }
  faces_ = std::move(kept);
  if (faces_.empty() || cap.corners.size() < 3) return;
  sort_around(cap.corners, n);
  faces_.push_back(std::move(cap));
}

double ConvexCell::volume() const {
  if (faces_.empty()) return 0.0;
  const Vec3 from = faces_.front().corners.front();
  double six = 0.0;
  for (const CellFace& face : faces_)
    each_triangle(face.corners, [&](const Vec3& a, const Vec3& b, const Vec3& c) {
      six += (a - from).dot((b - from).cross(c - from));
    });
  return six / 6;
}

Vec3 ConvexCell::centroid() const {
  const Vec3 from = faces_.front().corners.front();
  Vec3 sum = Vec3::Zero();
  double six = 0.0;
  for (const CellFace& face : faces_)
    each_triangle(face.corners, [&](const Vec3& a, const Vec3& b, const Vec3& c) {
      const double of = (a - from).dot((b - from).cross(c - from));
      six += of, sum += 0.25 * of * (a + b + c + from - 4 * from);
    });
  return from + sum / six;
}

}  // namespace tribo
