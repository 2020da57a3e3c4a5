/// Where two clouds of particles face each other: normal and gap at a node.
#pragma once

#include "base/types.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

namespace tribo {

/// Particles of one body near a node: centres relative to the node and half axes, one array per component.
template <int Dim>
struct Side {
  std::vector<double> x[Dim], axes[Dim][Dim];  ///< axes[k][d]: component d of half axis k
  std::vector<std::size_t> which;              ///< number of the particle where it was taken from
  std::vector<double> reach;                   ///< scratch
  std::vector<Vec<Dim>> corners;               ///< scratch
  int count = 0;

  void clear() {
    count = 0;
    which.clear();
    for (int d = 0; d < Dim; ++d) {
      x[d].clear();
      for (int k = 0; k < Dim; ++k) axes[k][d].clear();
    }
  }
  void add(const Vec<Dim>& centre, const Mat<Dim>& half, std::size_t number = 0) {
    ++count;
    which.push_back(number);
    for (int d = 0; d < Dim; ++d) {
      x[d].push_back(centre[d]);
      for (int k = 0; k < Dim; ++k) axes[k][d].push_back(half(d, k));
    }
  }

  /// reach[i] = x_i . n + share * sum_k |r_k . n|: how far each particle's domain, scaled by `share`, reaches along n.
  void measure(const Vec<Dim>& n, double share) {
    reach.resize(static_cast<std::size_t>(count));
    double* __restrict out = reach.data();
    for (int i = 0; i < count; ++i) {
      double s = 0.0, e = 0.0;
      for (int d = 0; d < Dim; ++d) s += x[d][static_cast<std::size_t>(i)] * n[d];
      for (int k = 0; k < Dim; ++k) {
        double r = 0.0;
        for (int d = 0; d < Dim; ++d) r += axes[k][d][static_cast<std::size_t>(i)] * n[d];
        e += std::fabs(r);
      }
      out[i] = s + share * e;
    }
  }

  /// Square of a particle's distance from the line through the node along n.
  double sideways2(const Vec<Dim>& n, std::size_t i) const {
    double along = 0.0, square = 0.0;
    for (int d = 0; d < Dim; ++d) along += x[d][i] * n[d], square += x[d][i] * x[d][i];
    return square - along * along;
  }
  /// Square of the band's half width, widened to the nearest particle.
  double band_limit(const Vec<Dim>& n, double band) const {
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) nearest = std::min(nearest, sideways2(n, i));
    return std::max(band * band, nearest * (1 + 1e-6));
  }

  /// The corner of a domain, scaled by `share`, that reaches farthest along n.
  Vec<Dim> farthest(const Vec<Dim>& n, double share) {
    measure(n, share);
    std::size_t best = 0;
    for (std::size_t i = 1; i < reach.size(); ++i)
      if (reach[i] > reach[best]) best = i;
    Vec<Dim> corner;
    for (int d = 0; d < Dim; ++d) corner[d] = x[d][best];
    for (int k = 0; k < Dim; ++k) {
      Vec<Dim> r;
      for (int d = 0; d < Dim; ++d) r[d] = axes[k][d][best];
      corner += (r.dot(n) < 0 ? -share : share) * r;
    }
    return corner;
  }
};

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
std::optional<Vec<Dim>> shortest_vector(Side<Dim>& a, Side<Dim>& b, double share, const Vec<Dim>& guess);

/// Unit normal of largest margin from a to b, or nothing if no plane parts the clouds. Its plane has all of a on one
/// side and all of b on the other, as far from both as possible: exact for flat faces, their corners and edges.
template <int Dim>
std::optional<Vec<Dim>> margin_normal(Side<Dim>& a, Side<Dim>& b, const Vec<Dim>& guess, double length);

/// The normal along which faces can press: `n`, unless it joins two corners (or edges) narrower than half a `length`.
/// Then that of the particles' sides there with the largest gap and with faces opposite each other. A corner that
/// slides past another one has none: touching in a point, they do not stop each other.
template <int Dim>
std::optional<Vec<Dim>> facing_normal(Side<Dim>& a, Side<Dim>& b, const Vec<Dim>& n, double length);

/// Whether the faces along n are wide: then facing_normal gives n. Quick, and true only if it is sure.
template <int Dim>
bool wide_faces(Side<Dim>& a, Side<Dim>& b, const Vec<Dim>& n, double length);

/// Whether a side's foremost particles along `out` make a plane face, even to `even`, wherever it ends.
template <int Dim>
bool flat_face(Side<Dim>& side, const Vec<Dim>& out, double even);

/// Logistic (or only linear) regression of the classes a = -1, b = 1. Nairn, Hammerquist & Smith, "New material point
/// method contact algorithms for improved accuracy, large-deformation problems, and proper null-space filtering",
/// CMAME 362 (2020) 112859.
template <int Dim>
std::optional<Vec<Dim>> regression_normal(const Side<Dim>& a, const Side<Dim>& b, bool logistic, double length);

/// Position of the face along n: of a, the largest reach, of b, the smallest (pass -n and negate). Only particles with
/// a tangential distance from the node below `band` count; if there are none, those that come nearest.
template <int Dim>
double face_position(Side<Dim>& side, const Vec<Dim>& n, double band);

/// How much wider the gap between two faces is, where they lie opposite each other, than that between their positions:
/// a hollow face stands out at the band's ends, but there a round one that lies in it stands back. 0 if the faces are
/// not smooth: if that is more than `most`.
template <int Dim>
double play_between(Side<Dim>& a, Side<Dim>& b, const Vec<Dim>& n, double band, double most);

/// Calls f(i) for the particles that reach within `depth` of that face, also `beside` the band.
template <int Dim, class F>
void each_at_face(Side<Dim>& side, const Vec<Dim>& n, double band, double beside, double depth, F&& f) {
  const double face = face_position<Dim>(side, n, band);  // leaves `reach`
  const double limit = side.band_limit(n, band + beside);
  for (std::size_t i = 0; i < side.reach.size(); ++i)
    if (side.reach[i] >= face - depth && side.sideways2(n, i) <= limit) f(i);
}

}  // namespace tribo
