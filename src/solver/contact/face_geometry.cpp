// SPDX-License-Identifier: MIT
#include "solver/contact/face_geometry.hpp"

#include "solver/contact/face_tolerances.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>

namespace tribo {

template <int Dim>
std::optional<Vec<Dim>> margin_normal(ParticleSet<Dim>& a, ParticleSet<Dim>& b, const Vec<Dim>& guess, double length) {
  // With domains of half their size there is a margin of half a particle between faces that touch or overlap a little.
  // If the overlap is larger, the centres alone may still be separated.
  for (const double scale : {0.5, 0.0})
    if (const auto x = shortest_vector<Dim>(a, b, scale, guess); x && x->norm() > 1e-3 * length) return x->normalized();
  return std::nullopt;
}

namespace {

// A side is a corner if all of its points within this depth of the foremost one lie within this width [cells].
constexpr double corner_depth = 0.1, corner_width = 0.5;

// The corners of the domains within `depth` of the foremost point along n.
template <int Dim>
void collect_corners(ParticleSet<Dim>& side, const Vec<Dim>& n, double depth, std::vector<Vec<Dim>>& out) {
  out.clear();
  const double face = side.max_reach(n, 1.0);
  for (std::size_t i = 0; i < side.size(); ++i) {
    if (side.reach[i] < face - depth) continue;
    const Vec<Dim> centre = side.centre(i);
    const Mat<Dim> half = side.half_axes(i);
    for (int corner = 0; corner < 1 << Dim; ++corner) {
      Vec<Dim> x = centre;
      for (int k = 0; k < Dim; ++k) x += ((corner >> k & 1) != 0 ? 1.0 : -1.0) * half.col(k);
      if (x.dot(n) >= face - depth) out.push_back(x);
    }
  }
}

// An interval along some direction.
struct Extent {
  double low = std::numeric_limits<double>::infinity(), high = -std::numeric_limits<double>::infinity();
  double length() const { return high - low; }
};

// The interval of the points along t; may stop once its length is at least `enough`.
template <int Dim>
Extent extent(const std::vector<Vec<Dim>>& points, const Vec<Dim>& t,
              double enough = std::numeric_limits<double>::infinity()) {
  Extent e;
  for (const auto& x : points) {
    const double at = x.dot(t);
    e.low = std::min(e.low, at), e.high = std::max(e.high, at);
    if (e.length() >= enough) break;
  }
  return e;
}

// The distance from the node to the nearest point.
template <int Dim>
double nearest(const std::vector<Vec<Dim>>& points) {
  double square = std::numeric_limits<double>::infinity();
  for (const auto& x : points) square = std::min(square, x.squaredNorm());
  return std::sqrt(square);
}

// Normals of the sides of the foremost domain along n, as columns.
template <int Dim>
Mat<Dim> side_normals(ParticleSet<Dim>& side, const Vec<Dim>& n) {
  return side.half_axes(side.farthest_particle(n, 1.0)).inverse().transpose().colwise().normalized();
}

// Calls f(t) for the directions t normal to n along which the width of a face is examined: in three dimensions the
// projections of the normals of the domains' sides.
template <int Dim, class F>
void each_across(const Vec<Dim>& n, const std::array<Mat<Dim>, 2>& sides, F&& f) {
  if constexpr (Dim == 2) {
    f(Vec<2>(-n[1], n[0]));
  } else {
    for (const Mat<3>& normals : sides)
      for (int k = 0; k < 3; ++k) {
        const Vec<3> across = normals.col(k) - normals.col(k).dot(n) * n;
        if (across.norm() > 0.1) f(Vec<3>(across.normalized()));
      }
  }
}

}  // namespace

template <int Dim>
bool are_wide_faces(ParticleSet<Dim>& a, ParticleSet<Dim>& b, const Vec<Dim>& n, double length) {
  const std::array<Mat<Dim>, 2> sides{side_normals<Dim>(a, n), side_normals<Dim>(b, -n)};
  // Along each direction the centres of the particles at one of the faces must be farther apart than in a corner.
  const auto is_wide = [&](ParticleSet<Dim>& side, const Vec<Dim>& out, const Vec<Dim>& t) {
    const double face = side.max_reach(out, 1.0);
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (std::size_t i = 0; i < side.size(); ++i) {
      if (side.reach[i] < face - corner_depth * length) continue;
      const double at = side.centre(i).dot(t);
      low = std::min(low, at), high = std::max(high, at);
      if (high - low >= corner_width * length) return true;
    }
    return false;
  };
  bool wide = true;
  each_across<Dim>(n, sides, [&](const Vec<Dim>& t) { wide = wide && (is_wide(a, n, t) || is_wide(b, -n, t)); });
  return wide;
}

namespace {

// Collects the sides of the domains that face along n. Those whose centres lie more than `depth` behind the foremost
// one within `band` of the line through the node may be missing [length]. Returns the largest distance along n of the
// centre of a side within the band.
template <int Dim>
double collect_sides(ParticleSet<Dim>& side, const Vec<Dim>& n, double depth,
                     double band = std::numeric_limits<double>::infinity()) {
  constexpr double steepest = 0.9;  // cosine of 26 degrees
  side.facets.clear();
  side.compute_reach(n, 1.0);
  double highest = -std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < side.size(); ++i) {
    if (side.reach[i] < highest - depth) continue;
    const Mat<Dim>& normals = side.side_normals(i);
    Eigen::Index front;
    if ((normals.transpose() * n).cwiseAbs().maxCoeff(&front) < steepest) continue;
    const double sign = normals.col(front).dot(n) < 0 ? -1.0 : 1.0;
    const Vec<Dim> middle = side.centre(i) + sign * side.half_axes(i).col(front);
    const double height = middle.dot(n);
    const Vec<Dim> offset = middle - height * n;
    side.facets.push_back({offset, middle, sign * normals.col(front)});
    if (offset.squaredNorm() <= band * band) highest = std::max(highest, height);
  }
  return highest;
}

}  // namespace

template <int Dim>
std::optional<Vec<Dim>> plane_face_normal(ParticleSet<Dim>& side, const Vec<Dim>& out, double length) {
  // The sides of a curved face differ the more, the farther they are apart. Of a plane they deviate from their mean by
  // less than 0.7 degrees per cell of its width, and than one degree.
  constexpr double most_bent = 0.012, same_direction = 0.0175;
  // The first guess tilts, so that a part of the plane lies behind its foremost corner.
  constexpr std::array depths{0.15, 0.05, 0.02};  // cells
  Vec<Dim> n = out;
  for (const double depth : depths) {
    const double highest = collect_sides<Dim>(side, n, 2 * depths.front() * length);
    Vec<Dim> sum = Vec<Dim>::Zero();
    for (const Facet<Dim>& facet : side.facets)
      if (facet.middle.dot(n) > highest - depth * length) sum += facet.normal;
    if (!(sum.norm() > 0)) return std::nullopt;
    n = sum.normalized();
  }
  double highest = -std::numeric_limits<double>::infinity();
  for (const Facet<Dim>& facet : side.facets) highest = std::max(highest, facet.middle.dot(n));
  double deviation = 0.0;
  std::vector<Vec<Dim>>& face = side.corners;
  face.clear();
  for (const Facet<Dim>& facet : side.facets) {
    if (facet.middle.dot(n) < highest - depths.back() * length) continue;
    deviation = std::max(deviation, (facet.normal - n).norm());
    face.push_back(facet.middle);
  }
  double width = same_direction / most_bent * length;
  for (const Vec<Dim>& t : directions_around<Dim>(n)) width = std::min(width, extent<Dim>(face, t, width).length());
  if (width < corner_width * length || deviation > most_bent * width / length) return std::nullopt;
  return n;
}

template <int Dim>
std::optional<Vec<Dim>> plane_normal_at_node(ParticleSet<Dim>& side, const Vec<Dim>& out, double band, double length) {
  constexpr double same_plane = 0.02;  // cells
  const auto n = plane_face_normal<Dim>(side, out, length);
  if (!n) return n;
  double of_plane = -std::numeric_limits<double>::infinity(), at_node = of_plane;
  for (const Facet<Dim>& facet : side.facets) {
    const double height = facet.middle.dot(*n);
    const Vec<Dim> offset = facet.middle - height * *n;
    of_plane = std::max(of_plane, height);
    if (offset.squaredNorm() <= band * band) at_node = std::max(at_node, height);
  }
  return at_node > of_plane - same_plane * length ? n : std::nullopt;
}

namespace {

// Removes the facets at the ends of a face. The sides of cut cells at corners are tilted.
template <int Dim>
void remove_ends(std::vector<Facet<Dim>>& facets, const Vec<Dim>& n, double length) {
  constexpr double width = 0.1;  // cells
  for (const Vec<Dim>& t : directions_around<Dim>(n)) {
    Extent e;
    for (const Facet<Dim>& f : facets)
      e.low = std::min(e.low, f.offset.dot(t)), e.high = std::max(e.high, f.offset.dot(t));
    std::erase_if(facets, [&](const Facet<Dim>& f) {
      const double at = f.offset.dot(t);
      return at < e.low + width * length || at > e.high - width * length;
    });
  }
}

}  // namespace

namespace {

// Linear regression of the slopes of facets, with respect to the plane normal to `out`, on their offsets.
template <int Dim>
struct SlopeFit {
  SlopeFit(const std::vector<Facet<Dim>>& facets, const Vec<Dim>& normal_guess, double length) : out(normal_guess) {
    constexpr double ridge = 1e-3;  // for directions in which the facets have the same place
    const auto count = static_cast<double>(facets.size());
    for (const Facet<Dim>& f : facets) place += f.offset / count, slope += slope_of(f) / count;
    Mat<Dim> with = Mat<Dim>::Zero(), squares = ridge * length * length * count * Mat<Dim>::Identity();
    for (const Facet<Dim>& f : facets) {
      const Vec<Dim> x = f.offset - place;
      with += (slope_of(f) - slope) * x.transpose(), squares += x * x.transpose();
    }
    curvature = with * squares.inverse();
  }
  Vec<Dim> slope_of(const Facet<Dim>& f) const { return f.normal / f.normal.dot(out) - out; }
  // The facet with the largest deviation from the regression, and this deviation.
  std::pair<std::size_t, double> worst(const std::vector<Facet<Dim>>& facets) const {
    std::pair<std::size_t, double> most{0, 0.0};
    for (std::size_t k = 0; k < facets.size(); ++k) {
      const double error = (slope_of(facets[k]) - slope - curvature * (facets[k].offset - place)).norm();
      if (error > most.second) most = {k, error};
    }
    return most;
  }
  // The normal on the line through the node.
  Vec<Dim> normal() const { return (out + slope - curvature * place).normalized(); }

  Vec<Dim> out, place = Vec<Dim>::Zero(), slope = Vec<Dim>::Zero();
  Mat<Dim> curvature;
};

}  // namespace

template <int Dim>
std::optional<SmoothNormal<Dim>> smooth_face_normal(ParticleSet<Dim>& side, const Vec<Dim>& out, double band,
                                                    double length, bool rigid) {
  constexpr double depth = 0.15;  // cells; the sagitta of the faces of a disc of five cells within two cells
  // Slopes deviate from a line by less than two degrees at a smooth face. Rigid faces may have blunt edges.
  const double largest_error = rigid ? 0.1 : 0.035;
  constexpr double curved_error = 0.15;
  constexpr double cover = 0.3;  // cells; a side is inside the body if another one is this near and in front of it
  const double highest = collect_sides<Dim>(side, out, depth * length, band);
  std::vector<Facet<Dim>>& facets = side.facets;
  const auto is_near = [&](const Facet<Dim>& f) { return f.offset.squaredNorm() <= band * band; };
  std::erase_if(facets, [&](const Facet<Dim>& f) { return f.middle.dot(out) < highest - depth * length; });
  std::vector<Facet<Dim>>& all = side.all_facets;
  all = facets;
  if (!rigid) std::erase_if(facets, [&](const Facet<Dim>& f) { return !is_near(f); });
  const auto is_covered = [&](const Facet<Dim>& f) {
    return std::any_of(all.begin(), all.end(), [&](const Facet<Dim>& g) {
      return (g.offset - f.offset).squaredNorm() < cover * cover * length * length &&
             g.height(out, f.offset) > f.middle.dot(out) + 0.02 * length;
    });
  };
  std::erase_if(facets, is_covered);
  if (rigid) {
    remove_ends<Dim>(facets, out, length);
    std::erase_if(facets, [&](const Facet<Dim>& f) { return !is_near(f); });
  }
  const std::size_t least = std::max<std::size_t>(2, facets.size() / 2);
  while (facets.size() >= least) {
    const SlopeFit<Dim> fit(facets, out, length);
    const auto [worst, error] = fit.worst(facets);
    if (error <= largest_error + curved_error * fit.curvature.norm() * length)
      return SmoothNormal<Dim>{fit.normal(), fit.place.norm()};
    facets.erase(facets.begin() + static_cast<std::ptrdiff_t>(worst));
  }
  return std::nullopt;
}

template <int Dim>
bool is_flat_face(ParticleSet<Dim>& side, const Vec<Dim>& out, double flatness) {
  const double face = side.max_reach(out, 1.0);
  for (std::size_t i = 0; i < side.size(); ++i) {
    const double depth = face - side.reach[i];
    const double thickness = 2 * (side.reach[i] - side.centre(i).dot(out));
    if (depth > flatness && depth < 0.9 * thickness) return false;  // neither at the face nor in the second layer
  }
  return true;
}

template <int Dim>
bool surrounds_line(ParticleSet<Dim>& side, const Vec<Dim>& out, double radius, double flatness) {
  std::array<Vec<Dim>, 2 * Dim> places;
  std::array<bool, 2 * Dim> has_near{};
  std::size_t k = 0;
  for (const Vec<Dim>& t : directions_around<Dim>(out)) places[k++] = radius * t, places[k++] = -radius * t;
  const double face = side.max_reach(out, 1.0);
  for (std::size_t i = 0; i < side.size(); ++i) {
    if (side.reach[i] < face - flatness) continue;
    const Vec<Dim> x = side.centre(i), offset = x - x.dot(out) * out;
    for (k = 0; k < places.size(); ++k)
      has_near[k] = has_near[k] || (offset - places[k]).squaredNorm() < 0.25 * radius * radius;
  }
  return std::all_of(has_near.begin(), has_near.end(), [](bool near) { return near; });
}

template <int Dim>
bool are_corners(ParticleSet<Dim>& a, ParticleSet<Dim>& b, const Vec<Dim>& n, double length) {
  const double depth = corner_depth * length, narrow = corner_width * length;
  collect_corners<Dim>(a, n, depth, a.corners);
  collect_corners<Dim>(b, -n, depth, b.corners);
  // Far from the node the sets end because they contain only particles near the node, which is no corner.
  if (std::max(nearest<Dim>(a.corners), nearest<Dim>(b.corners)) > 1.6 * length) return false;
  bool corners = false;
  each_across<Dim>(n, {side_normals<Dim>(a, n), side_normals<Dim>(b, -n)}, [&](const Vec<Dim>& t) {
    const auto is_narrow = [&](const auto& points) { return extent<Dim>(points, t, narrow).length() < narrow; };
    corners = corners || (is_narrow(a.corners) && is_narrow(b.corners));
  });
  return corners;
}

template <int Dim>
std::optional<Vec<Dim>> corner_normal(ParticleSet<Dim>& a, ParticleSet<Dim>& b, const Vec<Dim>& n, double length) {
  if (!are_corners<Dim>(a, b, n, length)) return n;
  const double depth = corner_depth * length;
  std::vector<Vec<Dim>>&at_a = a.corners, &at_b = b.corners;
  const auto collect = [&](const Vec<Dim>& m) {
    collect_corners<Dim>(a, m, depth, at_a);
    collect_corners<Dim>(b, -m, depth, at_b);
  };
  const std::array<Mat<Dim>, 2> sides{side_normals<Dim>(a, n), side_normals<Dim>(b, -n)};
  std::optional<Vec<Dim>> best;
  double largest = -std::numeric_limits<double>::infinity();
  const auto try_normal = [&](const Vec<Dim>& m) {
    const double gap = -a.max_reach(m, 1.0) - b.max_reach(-m, 1.0);
    if (!(gap > largest)) return;
    collect(m);
    bool opposite = true;
    each_across<Dim>(m, sides, [&](const Vec<Dim>& t) {
      if (!opposite) return;
      const Extent of_a = extent<Dim>(at_a, t), of_b = extent<Dim>(at_b, t);
      opposite = std::min(of_a.high - of_b.low, of_b.high - of_a.low) >= face_tolerance::least_opposite * length;
    });
    if (opposite) best = m, largest = gap;
  };
  try_normal(n);
  for (const Mat<Dim>& normals : sides)
    for (int k = 0; k < Dim; ++k) {
      const Vec<Dim> m = normals.col(k);
      if (std::abs(m.dot(n)) > 0.1) try_normal(m.dot(n) > 0 ? m : Vec<Dim>(-m));
    }
  return best;
}

template <int Dim>
std::optional<Vec<Dim>> regression_normal(const ParticleSet<Dim>& a, const ParticleSet<Dim>& b, bool logistic,
                                          double length) {
  using Row = Eigen::Matrix<double, Dim + 1, 1>;
  using Square = Eigen::Matrix<double, Dim + 1, Dim + 1>;
  const auto each = [&](auto&& f) {
    for (const auto* side : {&a, &b})
      for (std::size_t i = 0; i < side->size(); ++i) {
        Row X;
        X.template head<Dim>() = side->centre(i) / length;
        X[Dim] = 1.0;
        f(X, side == &a ? -1.0 : 1.0);
      }
  };
  Square A = Square::Zero();
  Row r = Row::Zero();
  each([&](const Row& X, double c) { A += X * X.transpose(), r += c * X; });
  A(Dim, Dim) += 0.1;
  Row beta = A.ldlt().solve(r);
  if (!beta.allFinite() || !(beta.template head<Dim>().norm() > 0)) return std::nullopt;
  const Vec<Dim> linear = beta.template head<Dim>().normalized();
  if (!logistic) return linear;
  beta *= 2.0;
  Vec<Dim> n = linear;
  for (int step = 0; step < 60; ++step) {
    A.setZero(), r.setZero();
    each([&](const Row& X, double c) {
      const double e = std::exp(-std::clamp(beta.dot(X), -500.0, 500.0)), phi = 2 * e / ((1 + e) * (1 + e));
      A += phi * phi * X * X.transpose();
      r += phi * (c - (2 / (1 + e) - 1)) * X;
    });
    for (int d = 0; d < Dim; ++d) A(d, d) += 1e-7, r[d] -= 1e-7 * beta[d];
    const Row change = A.ldlt().solve(r);
    beta += change;
    if (!beta.allFinite() || !(beta.template head<Dim>().norm() > 0)) return linear;
    const Vec<Dim> next = beta.template head<Dim>().normalized();
    const bool done = 1 - next.dot(n) < 1e-5;
    n = next;
    if (done) break;
  }
  return n;
}

template <int Dim>
double face_position(ParticleSet<Dim>& side, const Vec<Dim>& n, double band) {
  side.compute_reach(n, 1.0);
  const double limit = side.band_limit(n, band);
  double most = -std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < side.size(); ++i)
    if (side.reach[i] > most && side.offset_squared[i] <= limit) most = side.reach[i];
  return most;
}

template std::optional<Vec<2>> margin_normal<2>(ParticleSet<2>&, ParticleSet<2>&, const Vec<2>&, double);
template std::optional<Vec<2>> plane_face_normal<2>(ParticleSet<2>&, const Vec<2>&, double);
template std::optional<Vec<2>> plane_normal_at_node<2>(ParticleSet<2>&, const Vec<2>&, double, double);
template std::optional<SmoothNormal<2>> smooth_face_normal<2>(ParticleSet<2>&, const Vec<2>&, double, double, bool);
template bool is_flat_face<2>(ParticleSet<2>&, const Vec<2>&, double);
template bool surrounds_line<2>(ParticleSet<2>&, const Vec<2>&, double, double);
template bool are_wide_faces<2>(ParticleSet<2>&, ParticleSet<2>&, const Vec<2>&, double);
template bool are_corners<2>(ParticleSet<2>&, ParticleSet<2>&, const Vec<2>&, double);
template std::optional<Vec<2>> corner_normal<2>(ParticleSet<2>&, ParticleSet<2>&, const Vec<2>&, double);
template std::optional<Vec<2>> regression_normal<2>(const ParticleSet<2>&, const ParticleSet<2>&, bool, double);
template double face_position<2>(ParticleSet<2>&, const Vec<2>&, double);
template std::optional<Vec<3>> margin_normal<3>(ParticleSet<3>&, ParticleSet<3>&, const Vec<3>&, double);
template std::optional<Vec<3>> plane_face_normal<3>(ParticleSet<3>&, const Vec<3>&, double);
template std::optional<Vec<3>> plane_normal_at_node<3>(ParticleSet<3>&, const Vec<3>&, double, double);
template std::optional<SmoothNormal<3>> smooth_face_normal<3>(ParticleSet<3>&, const Vec<3>&, double, double, bool);
template bool is_flat_face<3>(ParticleSet<3>&, const Vec<3>&, double);
template bool surrounds_line<3>(ParticleSet<3>&, const Vec<3>&, double, double);
template bool are_wide_faces<3>(ParticleSet<3>&, ParticleSet<3>&, const Vec<3>&, double);
template bool are_corners<3>(ParticleSet<3>&, ParticleSet<3>&, const Vec<3>&, double);
template std::optional<Vec<3>> corner_normal<3>(ParticleSet<3>&, ParticleSet<3>&, const Vec<3>&, double);
template std::optional<Vec<3>> regression_normal<3>(const ParticleSet<3>&, const ParticleSet<3>&, bool, double);
template double face_position<3>(ParticleSet<3>&, const Vec<3>&, double);

}  // namespace tribo
