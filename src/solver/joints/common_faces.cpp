// SPDX-License-Identifier: MIT
#include "solver/joints/common_faces.hpp"

#include "contact/joint_geometry.hpp"
#include "solver/neighbours/body_occupancy.hpp"

#include <algorithm>
#include <cmath>

namespace tribo {
namespace {

constexpr double largest_gap = 0.05;   // largest distance between two sides with a common face [cells]
constexpr double step_cosine = 0.866;  // cosine of the angle between neighbours that form a step
constexpr double largest_piece = 0.5;  // largest edge of a piece [cells]

/// A side of a particle domain: a segment in two dimensions, a parallelogram in three.
template <int Dim>
struct DomainSide {
  Vec<Dim> middle, normal;                   // outwards
  Eigen::Matrix<double, Dim, Dim - 1> half;  // columns: half edges
  double thickness = 1.0;
  std::int64_t number = 0;  // see CommonFacePiece::side

  Vec<Dim> extent() const { return half.cwiseAbs().rowwise().sum(); }
  double largest() const { return 2 * half.colwise().norm().maxCoeff(); }
  /// Signed distance from `at` to the plane of the side along n.
  double height(const Vec<Dim>& at, const Vec<Dim>& n) const { return (middle - at).dot(normal) / n.dot(normal); }
};

template <int Dim, class F>
void each_side(const ParticleDomain<Dim>& domain, double thickness, std::int64_t particle, F&& f) {
  const Mat<Dim> normals = domain.axes.inverse().transpose().colwise().normalized();
  for (int k = 0; k < Dim; ++k)
    for (const double sign : {-1.0, 1.0}) {
      DomainSide<Dim> side;
      side.middle = domain.x + sign * domain.axes.col(k), side.normal = sign * normals.col(k);
      for (int c = 0; c < Dim - 1; ++c) side.half.col(c) = domain.axes.col((k + 1 + c) % Dim);
      side.thickness = thickness, side.number = 2 * Dim * particle + 2 * k + (sign > 0);
      f(side);
    }
}

/// Calls f(part) for equal parts of a side, none longer than `most`.
template <int Dim, class F>
void each_part(const DomainSide<Dim>& side, double most, F&& f) {
  std::array<int, 2> count{1, 1};
  for (int c = 0; c < Dim - 1; ++c)
    count[static_cast<std::size_t>(c)] =
        std::max(1, static_cast<int>(std::ceil(2 * side.half.col(c).norm() / most - 1e-6)));
  for (int j = 0; j < count[1]; ++j)
    for (int i = 0; i < count[0]; ++i) {
      DomainSide<Dim> part = side;
      const std::array<int, 2> at{i, j};
      for (int c = 0; c < Dim - 1; ++c) {
        const auto k = static_cast<std::size_t>(c);
        part.middle += (2 * at[k] + 1 - count[k]) / static_cast<double>(count[k]) * side.half.col(c);
        part.half.col(c) /= count[k];
      }
      f(part);
    }
}

/// A point of the intersection of two sides, projected along the normal, and the length or area that it represents.
template <int Dim>
using OverlapPoint = std::pair<Vec<Dim>, double>;

std::vector<OverlapPoint<2>> overlap(const DomainSide<2>& a, const DomainSide<2>& b, const Vec<2>& n,
                                     double negligible) {
  const Vec<2> t(-n[1], n[0]);
  const auto reach = [&](const DomainSide<2>& side) { return std::abs(side.half.col(0).dot(t)); };
  const double low = std::max(a.middle.dot(t) - reach(a), b.middle.dot(t) - reach(b)),
               high = std::min(a.middle.dot(t) + reach(a), b.middle.dot(t) + reach(b));
  if (high - low <= negligible) return {};
  const Vec<2> middle = a.middle + (0.5 * (low + high) - a.middle.dot(t)) * t;
  const double gauss = (high - low) / std::sqrt(12.0);
  return {{middle - gauss * t, 0.5 * (high - low)}, {middle + gauss * t, 0.5 * (high - low)}};
}

using Polygon = std::vector<Tangent>;
double cross(const Tangent& a, const Tangent& b) { return a.s * b.t - a.t * b.s; }

/// Clips a polygon to the half plane to the left of the line from p to q (Sutherland and Hodgman, Comm. ACM 17, 1974).
Polygon clip(const Polygon& polygon, const Tangent& p, const Tangent& q) {
  Polygon out;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Tangent &from = polygon[k], &to = polygon[(k + 1) % polygon.size()];
    const double at = cross(q - p, from - p), then = cross(q - p, to - p);
    if (at >= 0) out.push_back(from);
    if ((at > 0 && then < 0) || (at < 0 && then > 0)) out.push_back(from + at / (at - then) * (to - from));
  }
  return out;
}

std::vector<OverlapPoint<3>> overlap(const DomainSide<3>& a, const DomainSide<3>& b, const Vec3& n, double negligible) {
  const JointAxes axes = JointAxes::of_normal(n);
  const auto outline = [&](const DomainSide<3>& side) {
    Tangent u = axes.tangent(side.half.col(0)), v = axes.tangent(side.half.col(1));
    if (cross(u, v) < 0) std::swap(u, v);
    const Tangent at = axes.tangent(side.middle - a.middle);
    return Polygon{at - u - v, at + u - v, at + u + v, at - u + v};
  };
  Polygon common = outline(a);
  const Polygon other = outline(b);
  for (std::size_t k = 0; k < other.size(); ++k) common = clip(common, other[k], other[(k + 1) % other.size()]);
  if (common.size() < 3) return {};
  const PolygonMoments found = polygon_moments(common);
  if (found.area <= negligible * negligible) return {};
  return {{a.middle + axes.vector(found.centroid), found.area}};
}

/// Thickness of a particle in the third direction in two dimensions; 1 in three dimensions. The domain of a cut cell
/// has another area than the cell, so that its thickness does not follow from its volume.
template <int Dim>
double thickness(Body<Dim>& body, std::uint32_t i, const ParticleDomain<Dim>& domain) {
  if constexpr (Dim == 2) {
    if (!body.half_axes) return body.particles.volume()[i] / std::abs(4 * domain.axes.determinant());
    constexpr std::size_t out_of_plane = 4;  // component of F
    const auto F = body.particles.F();
    return body.thickness * (F[out_of_plane] ? F[out_of_plane][i] : 1.0);
  } else {
    return 1.0;
  }
}

}  // namespace

template <int Dim>
std::vector<CommonFacePiece<Dim>> common_face_pieces(const Model& model, System<Dim>& system, Body<Dim>& a,
                                                     Body<Dim>& b, double largest_angle) {
  const double least_cosine = std::cos(largest_angle);
  const double h = system.lattice.spacing.maxCoeff(), near = largest_gap * h;
  const auto box = [&](Body<Dim>& body) {
    Vec<Dim> low = Vec<Dim>::Constant(std::numeric_limits<double>::infinity()), high = -low;
    body.each_known_particle([&](std::uint32_t i) {
      low = low.cwiseMin(body.particles.position(i)), high = high.cwiseMax(body.particles.position(i));
    });
    return std::pair(low, high);
  };
  const auto [low_a, high_a] = box(a);
  const auto [low_b, high_b] = box(b);
  const Vec<Dim> margin = Vec<Dim>::Constant(2 * h), low = low_a.cwiseMax(low_b) - margin,
                 high = high_a.cwiseMin(high_b) + margin;
  std::array<BodyOccupancy<Dim>, 2> occupancy{BodyOccupancy<Dim>(model, system.lattice, low, high),
                                              BodyOccupancy<Dim>(model, system.lattice, low, high)};
  occupancy[0].add(a), occupancy[1].add(b);

  const auto each_near = [&](Body<Dim>& body, auto&& f) {
    const DomainReader<Dim> domains(body);
    body.each_known_particle([&](std::uint32_t i) {
      const Vec<Dim> x = body.particles.position(i);
      if ((x.array() < low.array()).any() || (x.array() > high.array()).any()) return;
      const ParticleDomain<Dim> domain = domains(i);
      each_side<Dim>(domain, thickness(body, i, domain), body.particles.number(i), f);
    });
  };
  std::vector<DomainSide<Dim>> sides_b;
  CellTable<Dim, std::uint32_t> table(system.lattice);
  each_near(b, [&](const DomainSide<Dim>& side) {
    table.add(side.middle - side.extent(), side.middle + side.extent(), static_cast<std::uint32_t>(sides_b.size()));
    sides_b.push_back(side);
  });

  std::vector<CommonFacePiece<Dim>> out;
  std::vector<std::uint32_t> candidates;
  std::uint32_t number = 0;
  const Vec<Dim> around = Vec<Dim>::Constant(near);
  const auto add_pieces = [&](const DomainSide<Dim>& one, const DomainSide<Dim>& two) {
    if (-one.normal.dot(two.normal) < least_cosine) return;
    const Vec<Dim> n = (one.normal - two.normal).normalized();
    for (const auto& [at, size] : overlap(one, two, n, 1e-9 * h)) {
      const double below = one.height(at, n), above = two.height(at, n);
      if (std::abs(above - below) > near) continue;
      CommonFacePiece<Dim> piece;
      piece.x = at + 0.5 * (below + above) * n, piece.n = n;
      // a side inside of the other body, where two bodies overlap, is no face
      if (occupancy[0].contains(piece.x + near * n) || occupancy[1].contains(piece.x - near * n)) continue;
      piece.area =
          size * (model.analysis == Analysis::axisymmetric ? piece.x[0] : std::min(one.thickness, two.thickness));
      piece.size = std::max(one.largest(), two.largest()), piece.side_number = number;
      piece.side = one.number;
      out.push_back(piece);
    }
  };
  each_near(a, [&](const DomainSide<Dim>& side) {
    candidates.clear();
    table.each(side.middle - side.extent() - around, side.middle + side.extent() + around,
               [&](std::uint32_t k) { candidates.push_back(k); });
    if (candidates.empty()) return;
    std::sort(candidates.begin(), candidates.end());
    candidates.erase(std::unique(candidates.begin(), candidates.end()), candidates.end());
    each_part<Dim>(side, largest_piece * h, [&](const DomainSide<Dim>& part) {
      for (const auto k : candidates) add_pieces(part, sides_b[k]);
      ++number;
    });
  });
  return out;
}

template <int Dim>
void smooth_steps(const Lattice<Dim>& lattice, std::vector<CommonFacePiece<Dim>>& pieces) {
  const double h = lattice.spacing.maxCoeff();
  const std::array radii{2.5 * h, 1.5 * h};
  const std::vector<CommonFacePiece<Dim>> original = pieces;
  CellTable<Dim, std::uint32_t> table(lattice);
  for (std::uint32_t k = 0; k < original.size(); ++k) table.add(original[k].x, original[k].x, k);
  for (CommonFacePiece<Dim>& piece : pieces) {
    const auto each_around = [&](double radius, auto&& f) {
      const Vec<Dim> reach = Vec<Dim>::Constant(radius);
      table.each(piece.x - reach, piece.x + reach, [&](std::uint32_t k) {
        const double share = (original[k].x - piece.x).squaredNorm() / (radius * radius);
        if (share < 1) f(original[k], (1 - share) * (1 - share) * original[k].area);
      });
    };
    const CommonFacePiece<Dim> own = piece;
    bool stepped = false;
    each_around(radii[0], [&](const auto& other, double) { stepped = stepped || other.n.dot(own.n) < step_cosine; });
    for (std::size_t r = 0; stepped && r < radii.size(); ++r) {
      Vec<Dim> n = Vec<Dim>::Zero(), centre = n;
      double total = 0.0, highest = 0.0;
      each_around(radii[r], [&](const auto& other, double weight) {
        n += weight * other.n, centre += weight * other.x, total += weight;
      });
      if (!(n.norm() > 0)) continue;
      n.normalize(), centre /= total;
      each_around(radii[r],
                  [&](const auto& other, double) { highest = std::max(highest, std::abs((other.x - centre).dot(n))); });
      // this height admits steps and curved faces with a radius of at least five cells; corners exceed it
      if (highest > 0.5 * own.size + 0.1 * h) continue;
      piece.n = n, piece.x = own.x - (own.x - centre).dot(n) * n;
      piece.area = own.area * std::max(0.0, own.n.dot(n));
      break;
    }
  }
  std::erase_if(pieces, [](const CommonFacePiece<Dim>& piece) { return !(piece.area > 0); });
}

template std::vector<CommonFacePiece<2>> common_face_pieces(const Model&, System<2>&, Body<2>&, Body<2>&, double);
template std::vector<CommonFacePiece<3>> common_face_pieces(const Model&, System<3>&, Body<3>&, Body<3>&, double);
template void smooth_steps(const Lattice<2>&, std::vector<CommonFacePiece<2>>&);
template void smooth_steps(const Lattice<3>&, std::vector<CommonFacePiece<3>>&);

}  // namespace tribo
