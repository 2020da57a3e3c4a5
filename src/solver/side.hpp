/// Particles of one body near a node, and how far they reach.
#pragma once

#include "base/types.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace tribo {

/// The side of a particle's domain that faces along a direction n.
template <int Dim>
struct Facet {
  Vec<Dim> sideways;  ///< centre of the particle, across n
  Vec<Dim> middle, normal;
  /// Where a line along n meets its plane.
  double height(const Vec<Dim>& n, const Vec<Dim>& line) const { return (middle - line).dot(normal) / normal.dot(n); }
};

/// Centres relative to the node and half axes of the domains, one array per component. What was last measured is kept,
/// for it is asked for again and again.
template <int Dim>
struct Side {
  std::vector<double> x[Dim], axes[Dim][Dim];  ///< axes[k][d]: component d of half axis k
  std::vector<std::size_t> which;              ///< number of the particle where it was taken from
  std::vector<double> reach;                   ///< measured: how far each domain reaches
  std::vector<double> sideways;                ///< measured: square of the distance from the line through the node
  std::vector<Vec<Dim>> corners;               ///< scratch
  std::vector<Facet<Dim>> facets;              ///< scratch

  std::size_t size() const { return which.size(); }
  bool empty() const { return which.empty(); }

  void clear() {
    which.clear();
    for (int d = 0; d < Dim; ++d) {
      x[d].clear();
      for (int k = 0; k < Dim; ++k) axes[k][d].clear();
    }
  }
  void add(const Vec<Dim>& centre, const Mat<Dim>& half, std::size_t number = 0) {
    which.push_back(number);
    for (int d = 0; d < Dim; ++d) {
      x[d].push_back(centre[d]);
      for (int k = 0; k < Dim; ++k) axes[k][d].push_back(half(d, k));
    }
    reach.clear(), sideways.clear();
  }

  /// Domain of a particle: centre and half axes as columns.
  Vec<Dim> centre(std::size_t i) const {
    Vec<Dim> v;
    for (int d = 0; d < Dim; ++d) v[d] = x[d][i];
    return v;
  }
  Mat<Dim> half_axes(std::size_t i) const {
    Mat<Dim> m;
    for (int k = 0; k < Dim; ++k)
      for (int d = 0; d < Dim; ++d) m(d, k) = axes[k][d][i];
    return m;
  }

  /// reach[i] = x_i . n + share * sum_k |r_k . n|: how far each particle's domain, scaled by `share`, reaches along n.
  void measure(const Vec<Dim>& n, double share) {
    if (reach.size() == size() && n == reach_along_ && share == share_) return;
    reach_along_ = n, share_ = share;
    reach.resize(size());
    Columns from;
    for (int d = 0; d < Dim; ++d) {
      from[d] = x[d].data();
      for (int k = 0; k < Dim; ++k) from[Dim * (k + 1) + d] = axes[k][d].data();
    }
    fill_reach(from, n, share, size(), reach.data());
  }
  /// The particle whose domain, scaled by `share`, reaches farthest along n; the first of equals.
  std::size_t foremost(const Vec<Dim>& n, double share) {
    measure(n, share);
    // In lanes, so that compilers take several at a time.
    constexpr std::size_t lanes = 8;
    std::array<double, lanes> most;
    most.fill(-std::numeric_limits<double>::infinity());
    std::size_t i = 0;
    for (; i + lanes <= size(); i += lanes)
      for (std::size_t k = 0; k < lanes; ++k) most[k] = reach[i + k] > most[k] ? reach[i + k] : most[k];
    for (; i < size(); ++i) most[0] = std::max(most[0], reach[i]);
    const double all = *std::max_element(most.begin(), most.end());
    const auto found = std::find(reach.begin(), reach.end(), all);
    return found == reach.end() ? 0 : static_cast<std::size_t>(found - reach.begin());
  }
  /// How far it reaches.
  double farthest_reach(const Vec<Dim>& n, double share) { return reach[foremost(n, share)]; }
  /// The corner of that domain that reaches farthest.
  Vec<Dim> farthest(const Vec<Dim>& n, double share) {
    const std::size_t best = foremost(n, share);
    Vec<Dim> corner = centre(best);
    for (int k = 0; k < Dim; ++k) {
      Vec<Dim> r;
      for (int d = 0; d < Dim; ++d) r[d] = axes[k][d][best];
      corner += (r.dot(n) < 0 ? -share : share) * r;
    }
    return corner;
  }

  /// Measures `sideways` from the line along n. Returns the square of the band's half width, widened to the nearest
  /// particle.
  double band_limit(const Vec<Dim>& n, double band) {
    if (sideways.size() != size() || n != line_) {
      line_ = n;
      sideways.resize(size());
      for (std::size_t i = 0; i < size(); ++i) {
        double along = 0.0, square = 0.0;
        for (int d = 0; d < Dim; ++d) along += x[d][i] * n[d], square += x[d][i] * x[d][i];
        sideways[i] = square - along * along;
      }
      nearest_ = std::numeric_limits<double>::infinity();
      for (const double s : sideways) nearest_ = std::min(nearest_, s);
    }
    return std::max(band * band, nearest_ * (1 + 1e-6));
  }

 private:
  using Columns = std::array<const double*, Dim*(Dim + 1)>;
  // On its own, so that compilers see that nothing overlaps, and take several particles at a time.
  static void fill_reach(const Columns& from, const Vec<Dim>& n, double share, std::size_t count,
                         double* __restrict out) {
    for (std::size_t i = 0; i < count; ++i) {
      double s = 0.0, e = 0.0;
      for (int d = 0; d < Dim; ++d) s += from[d][i] * n[d];
      for (int k = 1; k <= Dim; ++k) {
        double r = 0.0;
        for (int d = 0; d < Dim; ++d) r += from[Dim * k + d][i] * n[d];
        e += std::fabs(r);
      }
      out[i] = s + share * e;
    }
  }

  Vec<Dim> reach_along_ = Vec<Dim>::Zero(), line_ = Vec<Dim>::Zero();  // of `reach` and `sideways`
  double share_ = 0.0, nearest_ = 0.0;
};

}  // namespace tribo
