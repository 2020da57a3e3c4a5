// SPDX-License-Identifier: MIT
#include "solver/contact/face_geometry.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <array>

namespace tribo {

template <int Dim>
std::optional<Vec<Dim>> margin_normal(ParticleSet<Dim>& a, ParticleSet<Dim>& b, const Vec<Dim>& guess, double length) {
  // Domains of half size leave a margin of half a particle to faces that touch or overlap a little; if that is not
  // enough, centres alone may still be parted.
  for (const double share : {0.5, 0.0})
    if (const auto x = shortest_vector<Dim>(a, b, share, guess); x && x->norm() > 1e-3 * length) return x->normalized();
  return std::nullopt;
}

namespace {

// What a corner is: the points within this depth of the foremost are within this width of each other [length].
constexpr double corner_depth = 0.1, corner_width = 0.5;

// The corners of the domains within `depth` of the face along n.
template <int Dim>
void collect_corners(ParticleSet<Dim>& side, const Vec<Dim>& n, double depth, std::vector<Vec<Dim>>& out) {
  out.clear();
  const double face = side.farthest_reach(n, 1.0);
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

struct Extent {
  double low = std::numeric_limits<double>::infinity(), high = -std::numeric_limits<double>::infinity();
  double length() const { return high - low; }
};

// From where to where points reach along t; it is enough to know that the length is at least `enough`.
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

// The distance of the nearest one from the node.
template <int Dim>
double nearest(const std::vector<Vec<Dim>>& points) {
  double square = std::numeric_limits<double>::infinity();
  for (const auto& x : points) square = std::min(square, x.squaredNorm());
  return std::sqrt(square);
}

// Normals of the sides of the particle that reaches farthest along n.
template <int Dim>
Mat<Dim> side_normals(ParticleSet<Dim>& side, const Vec<Dim>& n) {
  return side.half_axes(side.foremost(n, 1.0)).inverse().transpose().colwise().normalized();
}

// The directions across n in which faces may part: in three dimensions those of the particles' sides.
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
bool wide_faces(ParticleSet<Dim>& a, ParticleSet<Dim>& b, const Vec<Dim>& n, double length) {
  const std::array<Mat<Dim>, 2> sides{side_normals<Dim>(a, n), side_normals<Dim>(b, -n)};
  // The centres of the particles at the face must be as far apart along every direction as a wide face is.
  const auto is_wide = [&](ParticleSet<Dim>& side, const Vec<Dim>& out, const Vec<Dim>& t) {
    const double face = side.farthest_reach(out, 1.0);
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

template <int Dim>
bool flat_face(ParticleSet<Dim>& side, const Vec<Dim>& out, double even) {
  const double face = side.farthest_reach(out, 1.0);
  for (std::size_t i = 0; i < side.size(); ++i) {
    const double depth = face - side.reach[i];
    const double thickness = 2 * (side.reach[i] - side.centre(i).dot(out));
    if (depth > even && depth < 0.9 * thickness) return false;  // it is not of the layer behind
  }
  return true;
}

template <int Dim>
bool goes_on(ParticleSet<Dim>& side, const Vec<Dim>& out, double radius, double even) {
  std::array<Vec<Dim>, 2 * Dim> places;
  std::array<bool, 2 * Dim> has_near{};
  std::size_t k = 0;
  for (const Vec<Dim>& t : directions_around<Dim>(out)) places[k++] = radius * t, places[k++] = -radius * t;
  const double face = side.farthest_reach(out, 1.0);
  for (std::size_t i = 0; i < side.size(); ++i) {
    if (side.reach[i] < face - even) continue;
    const Vec<Dim> x = side.centre(i), sideways = x - x.dot(out) * out;
    for (k = 0; k < places.size(); ++k)
      has_near[k] = has_near[k] || (sideways - places[k]).squaredNorm() < 0.25 * radius * radius;
  }
  return std::all_of(has_near.begin(), has_near.end(), [](bool near) { return near; });
}

template <int Dim>
std::optional<Vec<Dim>> facing_normal(ParticleSet<Dim>& a, ParticleSet<Dim>& b, const Vec<Dim>& n, double length) {
  const double depth = corner_depth * length, narrow = corner_width * length;
  std::vector<Vec<Dim>>&at_a = a.corners, &at_b = b.corners;
  const auto collect = [&](const Vec<Dim>& m) {
    collect_corners<Dim>(a, m, depth, at_a);
    collect_corners<Dim>(b, -m, depth, at_b);
  };
  collect(n);
  // Far from the node the clouds end where they were cut off; that is no corner.
  if (std::max(nearest<Dim>(at_a), nearest<Dim>(at_b)) > 1.6 * length) return n;
  const std::array<Mat<Dim>, 2> sides{side_normals<Dim>(a, n), side_normals<Dim>(b, -n)};
  bool corners = false;
  each_across<Dim>(n, sides, [&](const Vec<Dim>& t) {
    const auto is_narrow = [&](const auto& points) { return extent<Dim>(points, t, narrow).length() < narrow; };
    corners = corners || (is_narrow(at_a) && is_narrow(at_b));
  });
  if (!corners) return n;
  std::optional<Vec<Dim>> best;
  double largest = -std::numeric_limits<double>::infinity();
  const auto try_normal = [&](const Vec<Dim>& m) {
    const double gap = -a.farthest_reach(m, 1.0) - b.farthest_reach(-m, 1.0);
    collect(m);
    double opposite = std::numeric_limits<double>::infinity();
    each_across<Dim>(m, sides, [&](const Vec<Dim>& t) {
      const Extent of_a = extent<Dim>(at_a, t), of_b = extent<Dim>(at_b, t);
      opposite = std::min({opposite, of_a.high - of_b.low, of_b.high - of_a.low});
    });
    if (gap > largest && opposite >= 0.05 * length) best = m, largest = gap;
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
  side.measure(n, 1.0);
  const double limit = side.band_limit(n, band);
  double most = -std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < side.size(); ++i)
    if (side.reach[i] > most && side.sideways[i] <= limit) most = side.reach[i];
  return most;
}

namespace {

// The facets of the particles within the band and within `depth` of the face.
template <int Dim>
const std::vector<Facet<Dim>>& collect_facets(ParticleSet<Dim>& side, const Vec<Dim>& n, double band, double depth) {
  const double face = face_position<Dim>(side, n, band), limit = side.band_limit(n, band);
  side.facets.clear();
  for (std::size_t i = 0; i < side.size(); ++i) {
    if (side.reach[i] < face - depth || side.sideways[i] > limit) continue;
    const Vec<Dim> x = side.centre(i);
    const Mat<Dim> axes = side.half_axes(i);
    const Mat<Dim> normals = axes.inverse().transpose().colwise().normalized();
    Eigen::Index front;
    (normals.transpose() * n).cwiseAbs().maxCoeff(&front);
    const double sign = normals.col(front).dot(n) < 0 ? -1.0 : 1.0;
    side.facets.push_back({x - x.dot(n) * n, x + sign * axes.col(front), sign * normals.col(front)});
  }
  return side.facets;
}

// How the height along n of the facets' planes bends across n: the regression of their slopes on their places.
template <int Dim>
double bend(const std::vector<Facet<Dim>>& facets, const Vec<Dim>& n) {
  Vec<Dim> place = Vec<Dim>::Zero(), slope = Vec<Dim>::Zero();
  const auto slope_of = [&](const Facet<Dim>& f) { return Vec<Dim>(n - f.normal / f.normal.dot(n)); };
  for (const auto& f : facets) place += f.sideways, slope += slope_of(f);
  place /= static_cast<double>(facets.size()), slope /= static_cast<double>(facets.size());
  double with = 0.0, square = 0.0;
  for (const auto& f : facets) {
    with += (f.sideways - place).dot(slope_of(f) - slope);
    square += (f.sideways - place).squaredNorm();
  }
  return square > 0 ? with / square : 0.0;
}

}  // namespace

template <int Dim>
double play_between(ParticleSet<Dim>& a, ParticleSet<Dim>& b, const Vec<Dim>& n, double band, double most) {
  const auto &of_a = collect_facets<Dim>(a, n, band, most), &of_b = collect_facets<Dim>(b, -n, band, most);
  const auto opposite = [](const Facet<Dim>& facet, const auto& others) -> const Facet<Dim>& {
    const auto distance = [&](const Facet<Dim>& f) { return (f.sideways - facet.sideways).squaredNorm(); };
    return *std::min_element(others.begin(), others.end(),
                             [&](const auto& f, const auto& g) { return distance(f) < distance(g); });
  };
  double gap = std::numeric_limits<double>::infinity();
  const auto look = [&](const Facet<Dim>& f, const Facet<Dim>& g) {
    const Vec<Dim> between = 0.5 * (f.sideways + g.sideways);
    gap = std::min(gap, g.height(n, between) - f.height(n, between));
  };
  for (const auto& facet : of_a) find_nearby(facet, opposite(facet, of_b));
  for (const auto& facet : of_b) find_nearby(opposite(facet, of_a), facet);
  const double play = gap + face_position<Dim>(a, n, band) + face_position<Dim>(b, -n, band);
  if (!(play > 0 && play < most)) return 0.0;
  // Only if they bend the same way: what a plane seems to have is but the ends of particles beyond the band.
  const double bend_a = bend<Dim>(of_a, n), bend_b = bend<Dim>(of_b, n);
  const double alike = bend_a * bend_b > 0 ? std::min(bend_a / bend_b, bend_b / bend_a) : 0.0;
  return std::min(1.0, 4 * alike) * play;
}

template std::optional<Vec<2>> margin_normal<2>(ParticleSet<2>&, ParticleSet<2>&, const Vec<2>&, double);
template bool flat_face<2>(ParticleSet<2>&, const Vec<2>&, double);
template bool goes_on<2>(ParticleSet<2>&, const Vec<2>&, double, double);
template bool wide_faces<2>(ParticleSet<2>&, ParticleSet<2>&, const Vec<2>&, double);
template std::optional<Vec<2>> facing_normal<2>(ParticleSet<2>&, ParticleSet<2>&, const Vec<2>&, double);
template std::optional<Vec<2>> regression_normal<2>(const ParticleSet<2>&, const ParticleSet<2>&, bool, double);
template double face_position<2>(ParticleSet<2>&, const Vec<2>&, double);
template double play_between<2>(ParticleSet<2>&, ParticleSet<2>&, const Vec<2>&, double, double);
template std::optional<Vec<3>> margin_normal<3>(ParticleSet<3>&, ParticleSet<3>&, const Vec<3>&, double);
template bool flat_face<3>(ParticleSet<3>&, const Vec<3>&, double);
template bool goes_on<3>(ParticleSet<3>&, const Vec<3>&, double, double);
template bool wide_faces<3>(ParticleSet<3>&, ParticleSet<3>&, const Vec<3>&, double);
template std::optional<Vec<3>> facing_normal<3>(ParticleSet<3>&, ParticleSet<3>&, const Vec<3>&, double);
template std::optional<Vec<3>> regression_normal<3>(const ParticleSet<3>&, const ParticleSet<3>&, bool, double);
template double face_position<3>(ParticleSet<3>&, const Vec<3>&, double);
template double play_between<3>(ParticleSet<3>&, ParticleSet<3>&, const Vec<3>&, double, double);

}  // namespace tribo
