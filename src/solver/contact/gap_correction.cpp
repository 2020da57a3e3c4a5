// SPDX-License-Identifier: MIT
/// The gap between curved faces.

#include "solver/contact/face_geometry.hpp"

#include <algorithm>

namespace tribo {
namespace {

// The facets of the particles in the band and within `depth` of the face position.
template <int Dim>
const std::vector<Facet<Dim>>& collect_facets(ParticleSet<Dim>& side, const Vec<Dim>& n, double band, double depth) {
  const double face = face_position<Dim>(side, n, band), limit = side.band_limit(n, band);
  side.facets.clear();
  for (std::size_t i = 0; i < side.size(); ++i) {
    if (side.reach[i] < face - depth || side.offset_squared[i] > limit) continue;
    const Vec<Dim> x = side.centre(i);
    const Mat<Dim> axes = side.half_axes(i);
    const Mat<Dim>& normals = side.side_normals(i);
    Eigen::Index front;
    (normals.transpose() * n).cwiseAbs().maxCoeff(&front);
    const double sign = normals.col(front).dot(n) < 0 ? -1.0 : 1.0;
    side.facets.push_back({x - x.dot(n) * n, x + sign * axes.col(front), sign * normals.col(front)});
  }
  return side.facets;
}

// Curvature of a face: linear regression of the slopes of its facets on their positions [1/length].
template <int Dim>
double curvature(const std::vector<Facet<Dim>>& facets, const Vec<Dim>& n) {
  Vec<Dim> place = Vec<Dim>::Zero(), slope = Vec<Dim>::Zero();
  const auto slope_of = [&](const Facet<Dim>& f) { return Vec<Dim>(n - f.normal / f.normal.dot(n)); };
  for (const auto& f : facets) place += f.offset, slope += slope_of(f);
  place /= static_cast<double>(facets.size()), slope /= static_cast<double>(facets.size());
  double with = 0.0, square = 0.0;
  for (const auto& f : facets) {
    with += (f.offset - place).dot(slope_of(f) - slope);
    square += (f.offset - place).squaredNorm();
  }
  return square > 0 ? with / square : 0.0;
}

}  // namespace

template <int Dim>
double gap_correction(ParticleSet<Dim>& a, ParticleSet<Dim>& b, const Vec<Dim>& n, double band, double max) {
  const auto &of_a = collect_facets<Dim>(a, n, band, max), &of_b = collect_facets<Dim>(b, -n, band, max);
  const auto opposite = [](const Facet<Dim>& facet, const auto& others) -> const Facet<Dim>& {
    const auto distance = [&](const Facet<Dim>& f) { return (f.offset - facet.offset).squaredNorm(); };
    return *std::min_element(others.begin(), others.end(),
                             [&](const auto& f, const auto& g) { return distance(f) < distance(g); });
  };
  double gap = std::numeric_limits<double>::infinity();
  const auto add_gap = [&](const Facet<Dim>& f, const Facet<Dim>& g) {
    const Vec<Dim> between = 0.5 * (f.offset + g.offset);
    gap = std::min(gap, g.height(n, between) - f.height(n, between));
  };
  for (const auto& facet : of_a) add_gap(facet, opposite(facet, of_b));
  for (const auto& facet : of_b) add_gap(opposite(facet, of_a), facet);
  const double correction = gap + face_position<Dim>(a, n, band) + face_position<Dim>(b, -n, band);
  if (!(correction > 0 && correction < max)) return 0.0;
  // The curvatures must be alike. For a plane face the difference is only due to the ends of particles outside the
  // band.
  const double curvature_a = curvature<Dim>(of_a, n), curvature_b = curvature<Dim>(of_b, n);
  const double alike =
      curvature_a * curvature_b > 0 ? std::min(curvature_a / curvature_b, curvature_b / curvature_a) : 0.0;
  return std::min(1.0, 4 * alike) * correction;
}

template double gap_correction<2>(ParticleSet<2>&, ParticleSet<2>&, const Vec<2>&, double, double);
template double gap_correction<3>(ParticleSet<3>&, ParticleSet<3>&, const Vec<3>&, double, double);

}  // namespace tribo
