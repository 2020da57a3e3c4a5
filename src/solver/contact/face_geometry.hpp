// SPDX-License-Identifier: MIT
/// Normals, positions and shapes of the faces of two sets of particle domains near a node. All positions are relative
/// to the node.
#pragma once

#include "solver/contact/particle_set.hpp"

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <optional>

namespace tribo {

/// Unit vectors normal to the unit vector n, at equal angles around it.
template <int Dim>
std::array<Vec<Dim>, Dim> directions_around(const Vec<Dim>& n) {
  if constexpr (Dim == 2) {
    const Vec<2> t(-n[1], n[0]);
    return {t, -t};
  } else {
    const Vec<3> t = n.unitOrthogonal(), s = n.cross(t);
    const double high = std::sqrt(0.75);
    return {t, -0.5 * t + high * s, -0.5 * t - high * s};
  }
}

/// Shortest vector from the convex hull of the domains of a to that of the domains of b [length], the domains scaled
/// about their centres by `scale`; std::nullopt if the hulls overlap. `guess`: estimate of the direction from a to b.
/// Wolfe, "Finding the nearest point in a polytope", Math. Programming 11 (1976) 128-149.
template <int Dim>
std::optional<Vec<Dim>> shortest_vector(ParticleSet<Dim>& a, ParticleSet<Dim>& b, double scale, const Vec<Dim>& guess);

/// Unit normal, from a to b, of the plane that separates the two sets with the largest margin; std::nullopt if no plane
/// separates them. It is exact for flat faces, and for corners and edges opposite a flat face. `guess`: estimate of the
/// normal; `length`: cell size [length].
template <int Dim>
std::optional<Vec<Dim>> margin_normal(ParticleSet<Dim>& a, ParticleSet<Dim>& b, const Vec<Dim>& guess, double length);

/// Whether both sides are corners or edges along n, that is narrower than half a cell along the same direction.
/// `length`: cell size.
template <int Dim>
bool are_corners(ParticleSet<Dim>& a, ParticleSet<Dim>& b, const Vec<Dim>& n, double length);

/// The contact normal where two corners or edges may face each other. It is the normal of largest margin `n`, unless
/// are_corners(). Then it is the normal of that side of the foremost particle domains for which the gap is largest and
/// parts of both sets are opposite each other. std::nullopt if there is no such side: a corner that slides past another
/// one touches it in a point only and is not stopped by it. `length`: cell size.
template <int Dim>
std::optional<Vec<Dim>> corner_normal(ParticleSet<Dim>& a, ParticleSet<Dim>& b, const Vec<Dim>& n, double length);

/// Whether one of the two faces along n is certainly wide, so that they are no corners. A quick test: it may be
/// false for wide faces. `length`: cell size.
template <int Dim>
bool are_wide_faces(ParticleSet<Dim>& a, ParticleSet<Dim>& b, const Vec<Dim>& n, double length);

/// Outward unit normal of a plane face near the unit vector `out`: the mean normal of the sides of the foremost
/// domains, if these sides lie in one plane, deviate from it by less than a degree (less where the face is narrow)
/// and are together at least half a cell wide in every direction; std::nullopt otherwise. `length`: cell size.
template <int Dim>
std::optional<Vec<Dim>> plane_face_normal(ParticleSet<Dim>& side, const Vec<Dim>& out, double length);

/// The same, if the line through the node along `out` meets the plane: the foremost domain within `band` of this line
/// [length] has a side in it. Next to a blunt edge the foremost plane may lie beside the node.
template <int Dim>
std::optional<Vec<Dim>> plane_normal_at_node(ParticleSet<Dim>& side, const Vec<Dim>& out, double band, double length);

/// The normal of a smooth face on a line.
template <int Dim>
struct SmoothNormal {
  Vec<Dim> normal;  ///< outward unit vector
  double beside;    ///< distance from the line to the mean place of the facets from which it follows [length]
};

/// The normal of a smooth face on the line through the node along the unit vector `out`, by linear regression of the
/// normals of the foremost domains within `band` of this line [length] on their offsets; std::nullopt if there are
/// fewer than two domains, or if more than half of them deviate from the regression, by over two degrees and 15 % of
/// the change of the normal within a cell. `length`: cell size. A `rigid` face may have blunt edges, where the
/// deviation is up to six degrees, and the domains at its ends do not count.
template <int Dim>
std::optional<SmoothNormal<Dim>> smooth_face_normal(ParticleSet<Dim>& side, const Vec<Dim>& out, double band,
                                                    double length, bool rigid = false);

/// Whether the foremost particles along the unit vector `out` form a plane face normal to `out`, up to deviations of
/// `flatness` [length]. The face may end within the set.
template <int Dim>
bool is_flat_face(ParticleSet<Dim>& side, const Vec<Dim>& out, double flatness);

/// Whether a flat face has particles at the distance `radius` from the line through the node along `out` in all
/// directions [length].
template <int Dim>
bool surrounds_line(ParticleSet<Dim>& side, const Vec<Dim>& out, double radius, double flatness);

/// Unit normal from a to b by logistic (or only linear) regression of the classes a = -1, b = 1 on the positions of the
/// particles; std::nullopt if it is undetermined. `length`: cell size. Nairn, Hammerquist & Smith, "New material point
/// method contact algorithms for improved accuracy, large-deformation problems, and proper null-space filtering",
/// CMAME 362 (2020) 112859.
template <int Dim>
std::optional<Vec<Dim>> regression_normal(const ParticleSet<Dim>& a, const ParticleSet<Dim>& b, bool logistic,
                                          double length);

/// Position of the face of a set along the unit vector n, from the node: the largest reach of its domains [length]. For
/// the second side of a pair pass -n and change the sign of the result. Only particles whose distance from the line
/// through the node along n is at most `band` [length] count; if there are none, the nearest ones.
template <int Dim>
double face_position(ParticleSet<Dim>& side, const Vec<Dim>& n, double band);

/// Correction of the gap between curved faces, such as a shaft in its bearing: the smallest gap between domains
/// opposite each other minus the gap between the face positions [length]. The face position of a concave face is that
/// at the ends of the band, where a convex face that lies in it is farther back. 0 if the faces are not smooth, which
/// is assumed if the correction would exceed `max` [length], and if their curvatures have different signs.
template <int Dim>
double gap_correction(ParticleSet<Dim>& a, ParticleSet<Dim>& b, const Vec<Dim>& n, double band, double max);

/// Where two faces meet first: the offset, normal to n, of the foremost points of the sides within a cell from the line
/// through the node along n [length]. `n` points from the first to the second of the `sides`. It is zero along
/// directions in which the faces are plane, or have the same curvature, as a shaft and its bearing. `curves`: whether
/// the body of the side has a curved surface; others are taken for plane or concave. `band`: as for face_position();
/// `length`: cell size.
template <int Dim>
Vec<Dim> foremost_offset(const std::array<ParticleSet<Dim>*, 2>& sides, const std::array<bool, 2>& curves,
                         const Vec<Dim>& n, double band, double length);

/// Calls f(i) for the particles whose reach along n is at most `depth` less than the face position, in the band widened
/// by `margin` [length].
template <int Dim, class F>
void each_particle_at_face(ParticleSet<Dim>& side, const Vec<Dim>& n, double band, double margin, double depth, F&& f) {
  const double face = face_position<Dim>(side, n, band);  // computes reach and offset_squared
  const double limit = side.band_limit(n, band + margin);
  for (std::size_t i = 0; i < side.size(); ++i)
    if (side.reach[i] >= face - depth && side.offset_squared[i] <= limit) f(i);
}

}  // namespace tribo
