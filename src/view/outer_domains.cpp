// SPDX-License-Identifier: MIT
#include "view/outer_domains.hpp"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>

namespace tribo {
namespace {

constexpr double box_size = 1.5;     // over the median width of the domains
constexpr double turned = 0.5;       // least cosine of the angle between an outer side and the surface
constexpr double least_depth = 0.1;  // of a centre behind a plane that cuts its domain, over the width of the domains
constexpr double slack = 0.03;       // over the median width: by which centres may lie beyond an outer side
constexpr double around = 1.8;       // over the median width: of neighbours that show where the surface is
constexpr double lopsided = 0.15;    // mean of the directions to these; 0.36 at a plane surface

CutPlane side_plane(const Vec3& centre, const Mat3& axes, std::uint32_t side) {
  const auto k = static_cast<int>(side / 2);
  const Vec3 outwards = side % 2 == 0 ? Vec3(-axes.col(k)) : Vec3(axes.col(k));
  Vec3 normal = axes.col((k + 1) % 3).cross(axes.col((k + 2) % 3)).normalized();
  if (normal.dot(outwards) < 0) normal = -normal;
  return {centre + outwards, normal};
}

// The corners in order around their middle; those that coincide are one.
std::vector<Vec3> face_of(const std::vector<Vec3>& corners, const Vec3& normal) {
  Vec3 middle = Vec3::Zero();
  for (const Vec3& x : corners) middle += x / static_cast<double>(corners.size());
  const Vec3 u = normal.unitOrthogonal(), v = normal.cross(u);
  std::vector<std::pair<double, Vec3>> sorted;
  for (const Vec3& x : corners) sorted.emplace_back(std::atan2((x - middle).dot(v), (x - middle).dot(u)), x);
  std::sort(sorted.begin(), sorted.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<Vec3> out;
  for (const auto& entry : sorted)
    if (out.empty() || (entry.second - out.back()).norm() > 1e-9 * (entry.second - middle).norm())
      out.push_back(entry.second);
  return out;
}

}  // namespace

Polyhedron clipped(const Polyhedron& whole, const CutPlane& plane) {
  Polyhedron out;
  std::vector<Vec3> section;
  for (const auto& face : whole) {
    std::vector<Vec3> kept;
    for (std::size_t k = 0; k < face.size(); ++k) {
      const Vec3 &a = face[k], &b = face[(k + 1) % face.size()];
      const double of_a = plane.normal.dot(a - plane.at), of_b = plane.normal.dot(b - plane.at);
      if (of_a <= 0) kept.push_back(a);
      if ((of_a <= 0) == (of_b <= 0)) continue;
      kept.emplace_back(a + of_a / (of_a - of_b) * (b - a));
      section.push_back(kept.back());
    }
    if (kept.size() > 2) out.push_back(std::move(kept));
  }
  if (section.size() > 2)
    if (auto face = face_of(section, plane.normal); face.size() > 2) out.push_back(std::move(face));
  return out;
}

OuterDomains::OuterDomains(const ParticleFrame& frame) : frame_(frame), material_(frame.field("material")) {
  if (frame.count() == 0) return;
  std::vector<double> widths;
  low_ = place(0);
  for (std::size_t i = 0; i < frame.count(); ++i) {
    widths.push_back(2 * std::cbrt(std::abs(axes(i).determinant())));
    low_ = low_.cwiseMin(place(i));
  }
  const auto middle = widths.begin() + static_cast<std::ptrdiff_t>(widths.size() / 2);
  std::nth_element(widths.begin(), middle, widths.end());
  if (!(*middle > 0)) return;
  size_ = box_size * *middle;
  boxes_.reserve(frame.count());
  for (std::size_t i = 0; i < frame.count(); ++i) boxes_[key(place(i))].push_back(static_cast<std::uint32_t>(i));
  for (std::size_t i = 0; i < frame.count(); ++i)
    if (!is_surrounded(place(i))) find_outer_sides(i);
}

OuterDomains::Key OuterDomains::key(const Vec3& x, int dx, int dy, int dz) const {
  const std::array<int, 3> shift{dx, dy, dz};
  Key out = 0;
  for (int d = 0; d < 3; ++d) {
    const double number = std::floor((x[d] - low_[d]) / size_) + 2 + shift[static_cast<std::size_t>(d)];
    out = out << 21U | static_cast<Key>(std::clamp(number, 0.0, 2097151.0));
  }
  return out;
}

// Of the particles in the box around a point and in those next to it.
template <class F>
void OuterDomains::each_neighbour(const Vec3& x, F&& f) const {
  for (int k = 0; k < 27; ++k)
    if (const auto found = boxes_.find(key(x, k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1)); found != boxes_.end())
      for (const std::uint32_t j : found->second) f(j);
}

// Nobody sees particles with others in all boxes around theirs.
bool OuterDomains::is_surrounded(const Vec3& x) const {
  for (int k = 0; k < 27; ++k)
    if (!boxes_.contains(key(x, k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1))) return false;
  return true;
}

Mat3 OuterDomains::axes(std::size_t particle) const {
  Mat3 out;
  for (std::size_t k = 0; k < 3; ++k)
    out.col(static_cast<Eigen::Index>(k)) = Vec3::Map(frame_.domains[particle][k].data());
  return out;
}

bool OuterDomains::same_material(std::size_t a, std::size_t b) const {
  return !material_ || material_->values[a] == material_->values[b];
}

// The centres of neighbours say where the surface is, since the domains of cut particles neither fill the body nor stay
// within it. A side is an outer one if it faces away from the body and none of these centres lies beyond its plane.
void OuterDomains::find_outer_sides(std::size_t particle) {
  const Vec3 x = place(particle);
  const Mat3 half = axes(particle);
  const double width = size_ / box_size;
  std::array<CutPlane, 6> planes;
  for (std::uint32_t side = 0; side < 6; ++side) planes[side] = side_plane(x, half, side);
  Outer outer;
  std::uint32_t covered = 0;
  int neighbours = 0;
  each_neighbour(x, [&](std::uint32_t j) {
    if (j == particle || !same_material(particle, j)) return;
    const Vec3 apart = place(j) - x;
    const double distance = apart.norm();
    if (!(distance < around * width && distance > 0)) return;
    outer.normal -= apart / distance, ++neighbours;
    for (std::uint32_t side = 0; side < 6; ++side)
      if (planes[side].normal.dot(place(j) - planes[side].at) > slack * width) covered |= 1U << side;
  });
  if (!(outer.normal.norm() > lopsided * neighbours)) return;
  outer.normal.normalize();
  for (std::uint32_t side = 0; side < 6; ++side)
    if (!(covered >> side & 1U) && planes[side].normal.dot(outer.normal) > turned) outer.sides |= 1U << side;
  outer_.emplace(static_cast<std::uint32_t>(particle), outer);
}

Polyhedron OuterDomains::domain(std::size_t particle, double extension) const {
  const Vec3 x = place(particle);
  const Mat3 half = axes(particle);
  const Outer& mine = outer_.at(static_cast<std::uint32_t>(particle));
  const auto reach = [&](std::uint32_t side) { return mine.sides >> side & 1U ? 1.0 : 1.0 + extension; };
  Polyhedron out;
  for (std::uint32_t side = 0; side < 6; ++side) {
    const std::uint32_t a = side / 2, b = (a + 1) % 3, c = (a + 2) % 3;
    const Vec3 centre = x + (side % 2 == 0 ? -1 : 1) * reach(side) * half.col(a);
    const auto corner = [&](bool high_b, bool high_c) {
      return Vec3(centre + (high_b ? reach(2 * b + 1) : -reach(2 * b)) * half.col(b) +
                  (high_c ? reach(2 * c + 1) : -reach(2 * c)) * half.col(c));
    };
    out.push_back({corner(false, false), corner(true, false), corner(true, true), corner(false, true)});
  }
  const double depth = least_depth * size_ / box_size, least = extension > 0 ? 0.0 : turned;
  each_neighbour(x, [&](std::uint32_t j) {
    const auto found = outer_.find(j);
    if (j == particle || found == outer_.end() || !same_material(particle, j)) return;
    const Vec3 centre = place(j);
    const Mat3 theirs = axes(j);
    for (std::uint32_t side = 0; side < 6; ++side) {
      if (!(found->second.sides >> side & 1U)) continue;
      const CutPlane plane = side_plane(centre, theirs, side);
      if (plane.normal.dot(mine.normal) > least && plane.normal.dot(x - plane.at) < -depth) out = clipped(out, plane);
    }
  });
  return out;
}

}  // namespace tribo
