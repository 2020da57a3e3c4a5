// SPDX-License-Identifier: MIT
/// Where two clouds of particles face each other: normal and gap at a node.
#pragma once

#include "solver/contact/particle_set.hpp"

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <optional>

namespace tribo {

/// Unit vectors across a unit vector that lie evenly around it.
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

/// Shortest vector from the convex hull of a's domains to that of b's, domains scaled by `share`; nothing if they
/// overlap. Wolfe, "Finding the nearest point in a polytope", Math. Programming 11 (1976) 128-149. `guess`: direction
/// from a to b to begin with.
template <int Dim>
std::optional<Vec<Dim>> shortest_vector(ParticleSet<Dim>& a, ParticleSet<Dim>& b, double share, const Vec<Dim>& guess);

/// Unit normal of largest margin from a to b, or nothing if no plane parts the clouds. Its plane has all of a on one
/// side and all of b on the other, as far from both as possible: exact for flat faces, their corners and edges.
template <int Dim>
std::optional<Vec<Dim>> margin_normal(ParticleSet<Dim>& a, ParticleSet<Dim>& b, const Vec<Dim>& guess, double length);

/// The normal along which faces can press: `n`, unless it joins two corners (or edges) narrower than half a `length`.
/// Then that of the particles' sides there with the largest gap and with faces opposite each other. A corner that
/// slides past another one has none: touching in a point, they do not stop each other.
template <int Dim>
std::optional<Vec<Dim>> facing_normal(ParticleSet<Dim>& a, ParticleSet<Dim>& b, const Vec<Dim>& n, double length);

/// Whether the faces along n are wide: then facing_normal gives n. Quick, and true only if it is sure.
template <int Dim>
bool wide_faces(ParticleSet<Dim>& a, ParticleSet<Dim>& b, const Vec<Dim>& n, double length);

/// Whether a side's foremost particles along `out` make a plane face, even to `even`, wherever it ends.
template <int Dim>
bool flat_face(ParticleSet<Dim>& side, const Vec<Dim>& out, double even);

/// Whether such a face goes on all around the node, `radius` away from the line through it along `out`.
template <int Dim>
bool goes_on(ParticleSet<Dim>& side, const Vec<Dim>& out, double radius, double even);

/// Logistic (or only linear) regression of the classes a = -1, b = 1. Nairn, Hammerquist & Smith, "New material point
/// method contact algorithms for improved accuracy, large-deformation problems, and proper null-space filtering",
/// CMAME 362 (2020) 112859.
template <int Dim>
std::optional<Vec<Dim>> regression_normal(const ParticleSet<Dim>& a, const ParticleSet<Dim>& b, bool logistic,
                                          double length);

/// Position of the face along n: of a, the largest reach, of b, the smallest (pass -n and negate). Only particles with
/// a tangential distance from the node below `band` count; if there are none, those that come nearest.
template <int Dim>
double face_position(ParticleSet<Dim>& side, const Vec<Dim>& n, double band);

/// How much wider the gap between two faces is, where they lie opposite each other, than that between their positions:
/// a hollow face stands out at the band's ends, but there a round one that lies in it stands back. 0 if the faces are
/// not smooth: if that is more than `most`.
template <int Dim>
double play_between(ParticleSet<Dim>& a, ParticleSet<Dim>& b, const Vec<Dim>& n, double band, double most);

/// Calls f(i) for the particles that reach within `depth` of that face, also `beside` the band.
template <int Dim, class F>
void each_at_face(ParticleSet<Dim>& side, const Vec<Dim>& n, double band, double beside, double depth, F&& f) {
  const double face = face_position<Dim>(side, n, band);  // leaves `reach` and `sideways`
  const double limit = side.band_limit(n, band + beside);
  for (std::size_t i = 0; i < side.size(); ++i)
    if (side.reach[i] >= face - depth && side.sideways[i] <= limit) f(i);
}

}  // namespace tribo
