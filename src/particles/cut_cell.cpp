// SPDX-License-Identifier: MIT
#include "particles/cut_cell.hpp"

#include "particles/convex_cell.hpp"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>

namespace tribo {
namespace {

using Inside = std::function<bool(const Vec3&)>;

// Normals that deviate by less than 25 degrees from their mean belong to one smooth piece of surface.
constexpr double same_piece = 0.906;

struct SurfacePoint {
  Vec3 x, normal;
  std::size_t piece = 0;
};

struct Plane {
  Vec3 normal;
  double at = 0.0;
};

// Finds points of the surface within a box by bisection along lines parallel to the axes.
class SurfaceSampler {
 public:
  SurfaceSampler(const Inside& inside, const Vec3& low, const Vec3& high, bool flat)
      : inside_(inside), low_(low), size_(high - low), axes_(flat ? 2 : 3) {}

  std::vector<SurfacePoint> points() const {
    std::vector<SurfacePoint> out;
    const int lines = axes_ == 2 ? 9 : 4;
    for (int axis = 0; axis < axes_; ++axis) {
      const int u = (axis + 1) % axes_, v = axes_ == 2 ? 2 : (axis + 2) % 3;
      for (int i = 0; i < lines; ++i)
        for (int j = 0; j < (axes_ == 2 ? 1 : lines); ++j) {
          Vec3 start = low_;
          start[u] += (i + 0.5) / lines * size_[u];
          if (axes_ == 3) start[v] += (j + 0.5) / lines * size_[v];
          if (axes_ == 2) start[2] = 0.0;
          along_line(start, axis, out);
        }
    }
    return out;
  }

  // The surface, if it is a plane normal to an axis: all lines along this axis leave or enter the shape at the same
  // place. Most cut cells of boxes are of this kind, and few points show it.
  std::optional<Plane> plane_across_axis() const {
    for (int axis = 0; axis < axes_; ++axis)
      if (auto plane = plane_across(axis)) return plane;
    return std::nullopt;
  }

 private:
  std::optional<Plane> plane_across(int axis) const {
    static constexpr int lines = 3;
    static constexpr double same = 1e-11;  // of the edge of the cell
    const int u = (axis + 1) % axes_, v = axes_ == 2 ? 2 : (axis + 2) % 3;
    std::vector<Vec3> starts;
    for (int i = 0; i < lines; ++i)
      for (int j = 0; j < (axes_ == 2 ? 1 : lines); ++j) {
        Vec3 start = low_;
        start[u] += (i + 0.5) / lines * size_[u];
        start[v] = axes_ == 2 ? 0.0 : start[v] + (j + 0.5) / lines * size_[v];
        starts.push_back(start);
      }
    const bool begins_inside = at(starts[0], axis, 0.0);
    for (const Vec3& start : starts)
      if (at(start, axis, 0.0) != begins_inside || at(start, axis, 1.0) == begins_inside) return std::nullopt;
    const double place = bisect(starts[0], axis, 0.0, 1.0);
    for (const Vec3& start : starts)
      if (std::abs(bisect(start, axis, 0.0, 1.0) - place) > same) return std::nullopt;
    const double side = begins_inside ? 1.0 : -1.0;
    return Plane{side * Vec3::Unit(axis), side * on_line(starts[0], axis, place)[axis]};
  }

  Vec3 on_line(Vec3 start, int axis, double t) const {
    start[axis] = low_[axis] + t * size_[axis];
    return start;
  }
  bool at(const Vec3& start, int axis, double t) const { return inside_(on_line(start, axis, t)); }

  // The position of the surface between a and b, at which the line is on different sides.
  double bisect(const Vec3& start, int axis, double a, double b) const {
    const bool side = at(start, axis, a);
    for (int k = 0; k < 46; ++k) {
      const double middle = 0.5 * (a + b);
      (at(start, axis, middle) == side ? a : b) = middle;
    }
    return 0.5 * (a + b);
  }

  void along_line(const Vec3& start, int axis, std::vector<SurfacePoint>& out) const {
    constexpr int parts = 6;
    bool before = at(start, axis, 0.0);
    for (int k = 1; k <= parts; ++k) {
      const bool now = at(start, axis, static_cast<double>(k) / parts);
      if (now != before) {
        const double t = bisect(start, axis, (k - 1.0) / parts, static_cast<double>(k) / parts);
        if (auto n = normal(start, axis, t, now)) out.push_back({on_line(start, axis, t), *n});
      }
      before = now;
    }
  }

  // The outward normal from neighbouring points of the surface at both sides; none where they disagree, next to an
  // edge, or where the surface is steep with respect to the line, so that other lines describe it better.
  std::optional<Vec3> normal(const Vec3& start, int axis, double t, bool enters) const {
    constexpr double step = 1e-3, steepest = 1.6;
    Vec3 n = Vec3::Unit(axis) / size_[axis];
    for (int across = 0; across < axes_; ++across) {
      if (across == axis) continue;
      std::array<double, 2> shift{};
      for (int side = 0; side < 2; ++side) {
        Vec3 beside = start;
        beside[across] += (side == 0 ? -step : step) * size_[across];
        const double from = t - steepest * step, to = t + steepest * step;
        if (at(beside, axis, from) == at(beside, axis, to)) return std::nullopt;
        shift[static_cast<std::size_t>(side)] = (bisect(beside, axis, from, to) - t) * (side == 0 ? -1.0 : 1.0) / step;
      }
      if (std::abs(shift[0] - shift[1]) > 0.02) return std::nullopt;
      n[across] = -0.5 * (shift[0] + shift[1]) / size_[across];
    }
    n.normalize();
    return enters ? Vec3(-n) : n;
  }

  const Inside& inside_;
  Vec3 low_, size_;
  int axes_;
};

// Divides the points into at most `most` pieces of similar normals; none if these do not suffice.
std::optional<std::vector<Plane>> fit_planes(std::vector<SurfacePoint>& points, std::size_t most) {
  std::vector<Vec3> centres{points.front().normal};
  for (std::size_t count = 1; count <= most; ++count) {
    if (count > 1) {  // the normal that fits worst starts a new piece
      const auto worst = std::min_element(points.begin(), points.end(), [&](const auto& a, const auto& b) {
        return a.normal.dot(centres[a.piece]) < b.normal.dot(centres[b.piece]);
      });
      centres.push_back(worst->normal);
    }
    for (int iteration = 0; iteration < 10; ++iteration) {
      for (SurfacePoint& p : points)
        for (std::size_t k = 0; k < count; ++k)
          if (p.normal.dot(centres[k]) > p.normal.dot(centres[p.piece])) p.piece = k;
      for (std::size_t k = 0; k < count; ++k) {
        Vec3 sum = Vec3::Zero();
        for (const SurfacePoint& p : points)
          if (p.piece == k) sum += p.normal;
        if (sum.norm() > 0) centres[k] = sum.normalized();
      }
    }
    const bool fits = std::all_of(points.begin(), points.end(),
                                  [&](const SurfacePoint& p) { return p.normal.dot(centres[p.piece]) > same_piece; });
    if (!fits) continue;
    std::vector<Plane> out;
    for (std::size_t k = 0; k < count; ++k) {
      double sum = 0.0, number = 0.0;
      for (const SurfacePoint& p : points)
        if (p.piece == k) sum += p.x.dot(centres[k]), number += 1;
      if (number > 0) out.push_back({centres[k], sum / number});
    }
    return out;
  }
  return std::nullopt;
}

// Positions in a box: the centres of n equal parts along each axis.
template <class F>
void each_sample(const Vec3& low, const Vec3& high, bool flat, int n, F&& f) {
  for (int k = 0; k < (flat ? 1 : n); ++k)
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i) {
        const Vec3 s((i + 0.5) / n, (j + 0.5) / n, flat ? 0.5 : (k + 0.5) / n);
        f(Vec3(low + s.cwiseProduct(high - low)));
      }
}

// Volume and centroid from points inside, for surfaces of other forms. The represented domain is a box of the same
// volume.
std::optional<CutCell> sampled(const Inside& inside, const Vec3& low, const Vec3& high, bool flat) {
  double count = 0.0, all = 0.0;
  Vec3 sum = Vec3::Zero();
  each_sample(low, high, flat, flat ? 32 : 10, [&](const Vec3& x) {
    all += 1;
    if (inside(x)) count += 1, sum += x;
  });
  if (count == 0) return std::nullopt;
  CutCell out = whole_cell(low, high);
  const double fraction = count / all;
  out.volume *= fraction, out.centroid = sum / count;
  Vec3 half = 0.5 * (high - low) * (flat ? std::sqrt(fraction) : std::cbrt(fraction));
  if (flat) half[2] = 0.5;
  out.low = out.centroid - half, out.high = out.centroid + half;
  for (double& a : out.open_areas) a *= fraction;
  return out;
}

SurfaceFacet facet_of(const CellFace& face) {
  const Vec3 area = face.vector_area();
  return {area.normalized(), area.norm(), face.centre(), face.covariance()};
}

// The convex part of the box below all planes.
std::optional<CutCell> part_below(const std::vector<Plane>& planes, const Vec3& low, const Vec3& high) {
  ConvexCell cell(low, high);
  for (std::size_t k = 0; k < planes.size(); ++k) cell.cut(planes[k].normal, planes[k].at, static_cast<int>(k));
  CutCell out;
  out.volume = cell.volume();
  if (!(out.volume > 0)) return std::nullopt;
  out.centroid = cell.centroid();
  out.low = high, out.high = low;
  for (const CellFace& face : cell.faces()) {
    for (const Vec3& x : face.corners) out.low = out.low.cwiseMin(x), out.high = out.high.cwiseMax(x);
    if (face.plane >= ConvexCell::first_cut)
      out.facets.push_back(facet_of(face));
    else
      out.open_areas[static_cast<std::size_t>(face.plane)] = face.vector_area().norm();
  }
  return out;
}

// The box without the convex part beyond all planes: an inner edge or corner.
std::optional<CutCell> part_without(std::vector<Plane> planes, const Vec3& low, const Vec3& high) {
  for (Plane& plane : planes) plane.normal *= -1, plane.at *= -1;
  CutCell out = whole_cell(low, high);
  const auto hollow = part_below(planes, low, high);
  if (!hollow) return out;
  const double whole = out.volume;
  out.volume -= hollow->volume;
  if (!(out.volume > 1e-9 * whole)) return std::nullopt;
  out.centroid = (whole * out.centroid - hollow->volume * hollow->centroid) / out.volume;
  for (std::size_t k = 0; k < 6; ++k) out.open_areas[k] -= hollow->open_areas[k];
  out.facets = hollow->facets;
  for (SurfaceFacet& facet : out.facets) facet.normal *= -1;
  return out;
}

}  // namespace

CutCell whole_cell(const Vec3& low, const Vec3& high) {
  CutCell out;
  const Vec3 size = high - low;
  out.volume = size.prod(), out.centroid = 0.5 * (low + high);
  out.low = low, out.high = high;
  for (std::size_t k = 0; k < 6; ++k) out.open_areas[k] = out.volume / size[static_cast<Eigen::Index>(k / 2)];
  return out;
}

std::optional<CutCell> cut_cell(const Inside& inside, const Vec3& low, const Vec3& high, bool flat, int probes) {
  // Surfaces within round-off of a side do not cut the cell
  const Vec3 inset = 1e-8 * (high - low);
  Vec3 inner_low = low + inset, inner_high = high - inset;
  if (flat) inner_low[2] = inner_high[2] = 0.0;
  int in = 0, all = 0;
  for (int k = 0; k < (flat ? 1 : probes); ++k)
    for (int j = 0; j < probes; ++j)
      for (int i = 0; i < probes; ++i, ++all)
        if (inside(inner_low + Vec3(i, j, k).cwiseProduct(inner_high - inner_low) / (probes - 1))) ++in;
  if (in == 0) return std::nullopt;
  if (in == all) return whole_cell(low, high);

  const SurfaceSampler surface(inside, low, high, flat);
  if (const auto plane = surface.plane_across_axis()) return part_below({*plane}, low, high);
  auto points = surface.points();
  if (points.empty()) return sampled(inside, low, high, flat);
  const auto planes = fit_planes(points, flat ? 2 : 3);
  if (!planes) return sampled(inside, low, high, flat);
  // Whether the part lies below all planes (a face, an outer edge) or below any of them (an inner edge)
  int wrong_all = 0, wrong_any = 0, count = 0;
  each_sample(low, high, flat, flat ? 8 : 5, [&](const Vec3& x) {
    const auto below = [&](const Plane& plane) { return x.dot(plane.normal) <= plane.at; };
    const bool is = inside(x);
    ++count;
    wrong_all += is != std::all_of(planes->begin(), planes->end(), below) ? 1 : 0;
    wrong_any += is != std::any_of(planes->begin(), planes->end(), below) ? 1 : 0;
  });
  if (std::min(wrong_all, wrong_any) > 0.1 * count) return sampled(inside, low, high, flat);
  return wrong_all <= wrong_any ? part_below(*planes, low, high) : part_without(*planes, low, high);
}

void CutCell::join(const CutCell& other) {
  centroid = (volume * centroid + other.volume * other.centroid) / (volume + other.volume);
  volume += other.volume;
  low = low.cwiseMin(other.low), high = high.cwiseMax(other.high);
  for (const SurfaceFacet& more : other.facets) {
    const auto same = std::find_if(facets.begin(), facets.end(),
                                   [&](const auto& f) { return f.normal.dot(more.normal) > same_piece; });
    if (same == facets.end()) {
      facets.push_back(more);
      continue;
    }
    const double area = same->area + more.area, a = same->area / area, b = more.area / area;
    const Vec3 between = more.centre - same->centre;
    same->covariance = a * same->covariance + b * more.covariance + a * b * between * between.transpose();
    same->centre += b * between;
    same->normal = (a * same->normal + b * more.normal).normalized();
    same->area = area;
  }
}

namespace {

// The largest facets, as many as can bound a parallelepiped: each normal must deviate from the span of those before.
std::vector<SurfaceFacet> bounding_facets(std::vector<SurfaceFacet> facets, std::size_t most) {
  std::stable_sort(facets.begin(), facets.end(), [](const auto& a, const auto& b) { return a.area > b.area; });
  std::vector<SurfaceFacet> out;
  std::vector<Vec3> basis;
  for (const SurfaceFacet& facet : facets) {
    if (out.size() == most) break;
    Vec3 rest = facet.normal;
    for (const Vec3& e : basis) rest -= rest.dot(e) * e;
    if (rest.norm() < 0.2) continue;
    basis.push_back(rest.normalized()), out.push_back(facet);
  }
  return out;
}

// A side with the facet's centre, area and, within limits, ratio of extents. The third axis goes from the centroid to
// the centre of the facet, but at least `least` far along the normal.
Mat3 axes_of_face(const SurfaceFacet& facet, const Vec3& centroid, bool flat, double least) {
  const Vec3& n = facet.normal;
  Mat3 axes;
  if (flat) {
    axes.col(0) = 0.5 * facet.area * Vec3(n[1], -n[0], 0);
    axes.col(2) = 0.5 * Vec3::UnitZ();
  } else {
    constexpr double narrowest = 0.4;
    const Eigen::SelfAdjointEigenSolver<Mat3> extents(facet.covariance);  // variances in ascending order, 0 along n
    const double ratio =
        std::sqrt(std::max(extents.eigenvalues()[1] / extents.eigenvalues()[2], narrowest * narrowest));
    Vec3 t = extents.eigenvectors().col(2);
    t = (t - t.dot(n) * n).normalized();
    axes.col(0) = 0.5 * std::sqrt(facet.area / ratio) * t;
    axes.col(2) = 0.5 * std::sqrt(facet.area * ratio) * t.cross(n);
  }
  axes.col(1) = facet.centre - centroid;
  axes.col(1) += std::max(0.0, least - axes.col(1).dot(n)) * n;
  return axes;
}

}  // namespace

Mat3 CutCell::half_axes(bool flat) const {
  const Vec3 size = high - low;
  const auto used = bounding_facets(facets, flat ? 2 : 3);
  if (used.empty()) return (0.5 * size).asDiagonal();
  const double least = 0.02 * size.head(flat ? 2 : 3).minCoeff();
  if (used.size() == 1) return axes_of_face(used.front(), centroid, flat, least);
  // The slabs |n . (x - centroid)| <= depth, the outer sides of which are the facets
  Mat3 normals;
  Vec3 depth;
  for (std::size_t k = 0; k < used.size(); ++k) {
    const auto row = static_cast<Eigen::Index>(k);
    normals.row(row) = used[k].normal.transpose();
    depth[row] = std::max(least, (used[k].centre - centroid).dot(used[k].normal));
  }
  if (used.size() == 2) {
    const Vec3 along = flat ? Vec3(Vec3::UnitZ()) : Vec3(used[0].normal.cross(used[1].normal).normalized());
    normals.row(2) = along.transpose();
    depth[2] = flat ? 0.5 : 0.5 * along.cwiseAbs().dot(size) / along.cwiseAbs().sum();
  }
  Mat3 axes = normals.inverse() * depth.asDiagonal();
  const double longest = 0.6 * size.head(flat ? 2 : 3).norm();  // domains at acute edges would be longer
  for (int k = 0; k < 3; ++k)
    if (axes.col(k).norm() > longest) axes.col(k) *= longest / axes.col(k).norm();
  if (axes.determinant() < 0) axes.col(0).swap(axes.col(1));
  return axes;
}

}  // namespace tribo
