// SPDX-License-Identifier: MIT
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

/// Centres relative to the node and half axes of the domains. What was last measured is kept, for it is asked for again
/// and again.
template <int Dim>
class ParticleSet {
 public:
  std::vector<std::size_t> which;  ///< number of the particle where it was taken from
  std::vector<double> reach;       ///< measured: how far each domain reaches; entries beyond size() mean nothing
  std::vector<double> sideways;    ///< measured: square of the distance from the line through the node
  std::vector<Vec<Dim>> corners;   ///< scratch
  std::vector<Facet<Dim>> facets;  ///< scratch

  std::size_t size() const { return which.size(); }
  bool empty() const { return which.empty(); }
  void clear() {
    which.clear();
    forget();
  }
  void add(const Vec<Dim>& centre, const Mat<Dim>& half, std::size_t number = 0) {
    if (size() == capacity_) grow();
    double* to = columns_.data() + size();
    for (int c = 0; c < Dim; ++c) to[static_cast<std::size_t>(c) * capacity_] = centre[c];
    for (int c = 0; c < Dim * Dim; ++c) to[static_cast<std::size_t>(Dim + c) * capacity_] = half.data()[c];
    which.push_back(number);
    forget();
  }

  /// Coordinates of centres, then half axes one after the other, of many particles.
  using Columns = std::array<const double*, Dim + Dim * Dim>;
  /// Takes the particles `numbers` out of columns, with their centres relative to `origin`, in place of what it had.
  void take(const std::vector<std::size_t>& numbers, const Columns& from, const Vec<Dim>& origin) {
    which.clear();
    while (capacity_ < numbers.size()) grow();
    which = numbers;
    for (int c = 0; c < columns; ++c) {
      const double* source = from[static_cast<std::size_t>(c)];
      const double zero = c < Dim ? origin[c] : 0.0;
      gather(source, numbers.data(), size(), zero, column(c));
    }
    forget();
  }

  /// Domain of a particle: centre, and half axes as columns.
  Vec<Dim> centre(std::size_t i) const {
    Vec<Dim> v;
    for (int c = 0; c < Dim; ++c) v[c] = column(c)[i];
    return v;
  }
  Mat<Dim> half_axes(std::size_t i) const {
    Mat<Dim> m;
    for (int c = 0; c < Dim * Dim; ++c) m.data()[c] = column(Dim + c)[i];
    return m;
  }

  /// reach[i] = x_i . n + share * sum_k |r_k . n|: how far each particle's domain, scaled by `share`, reaches along n.
  void measure(const Vec<Dim>& n, double share) {
    if (measured_ && n == reach_along_ && share == share_) return;
    measured_ = true, reach_along_ = n, share_ = share;
    const std::size_t whole = (size() + lanes - 1) / lanes * lanes;
    for (int c = 0; c < columns; ++c) std::fill(column(c) + size(), column(c) + whole, 0.0);
    reach.resize(capacity_);
    fill_reach(columns_.data(), capacity_, n, share, whole, reach.data());
  }
  /// The particle whose domain, scaled by `share`, reaches farthest along n; the first of equals.
  std::size_t foremost(const Vec<Dim>& n, double share) {
    measure(n, share);
    constexpr double infinity = std::numeric_limits<double>::infinity();
    const std::size_t whole = (size() + lanes - 1) / lanes * lanes;
    std::fill(reach.data() + size(), reach.data() + whole, -infinity);
    std::array<double, lanes> most;
    most.fill(-infinity);
    for (std::size_t i = 0; i < whole; i += lanes)
      for (std::size_t k = 0; k < lanes; ++k) most[k] = reach[i + k] > most[k] ? reach[i + k] : most[k];
    const auto end = reach.begin() + static_cast<std::ptrdiff_t>(size());
    const auto found = std::find(reach.begin(), end, *std::max_element(most.begin(), most.end()));
    return found == end ? 0 : static_cast<std::size_t>(found - reach.begin());
  }
  /// How far it reaches.
  double farthest_reach(const Vec<Dim>& n, double share) { return reach[foremost(n, share)]; }
  /// The corner of that domain that reaches farthest.
  Vec<Dim> farthest(const Vec<Dim>& n, double share) {
    const std::size_t best = foremost(n, share);
    const Mat<Dim> half = half_axes(best);
    Vec<Dim> corner = centre(best);
    for (int k = 0; k < Dim; ++k) corner += (half.col(k).dot(n) < 0 ? -share : share) * half.col(k);
    return corner;
  }

  /// Measures `sideways` from the line along n. Returns the square of the band's half width, widened to the nearest
  /// particle.
  double band_limit(const Vec<Dim>& n, double band) {
    if (sideways.size() != size() || n != line_) {
      line_ = n;
      sideways.resize(size());
      nearest_ = std::numeric_limits<double>::infinity();
      for (std::size_t i = 0; i < size(); ++i) {
        const Vec<Dim> x = centre(i);
        sideways[i] = x.squaredNorm() - x.dot(n) * x.dot(n);
        nearest_ = std::min(nearest_, sideways[i]);
      }
    }
    return std::max(band * band, nearest_ * (1 + 1e-6));
  }

 private:
  static constexpr int columns = Dim + Dim * Dim;
  static constexpr std::size_t lanes = 8;  // that compilers may take at a time

  double* column(int c) { return columns_.data() + static_cast<std::size_t>(c) * capacity_; }
  const double* column(int c) const { return columns_.data() + static_cast<std::size_t>(c) * capacity_; }
  void forget() {
    measured_ = false;
    sideways.clear();
  }
  void grow() {
    const std::size_t capacity = std::max(8 * lanes, 2 * capacity_);
    std::vector<double> wider(columns * capacity);
    for (int c = 0; c < columns; ++c)
      std::copy_n(column(c), size(), wider.data() + static_cast<std::size_t>(c) * capacity);
    columns_ = std::move(wider), capacity_ = capacity;
  }
  static void gather(const double* from, const std::size_t* numbers, std::size_t count, double zero,
                     double* __restrict to) {
    for (std::size_t i = 0; i < count; ++i) to[i] = from[numbers[i]] - zero;
  }
  // On its own, so that compilers see that nothing overlaps.
  static void fill_reach(const double* from, std::size_t stride, const Vec<Dim>& n, double share, std::size_t count,
                         double* __restrict out) {
    for (std::size_t i = 0; i < count; ++i) {
      double s = 0.0, e = 0.0;
      for (std::size_t d = 0; d < Dim; ++d) s += from[d * stride + i] * n[static_cast<Eigen::Index>(d)];
      for (std::size_t k = 1; k <= Dim; ++k) {
        double r = 0.0;
        for (std::size_t d = 0; d < Dim; ++d) r += from[(Dim * k + d) * stride + i] * n[static_cast<Eigen::Index>(d)];
        e += std::fabs(r);
      }
      out[i] = s + share * e;
    }
  }

  std::vector<double> columns_;  // one after the other, each with room for capacity_ particles
  std::size_t capacity_ = 0;     // a multiple of lanes
  bool measured_ = false;
  Vec<Dim> reach_along_ = Vec<Dim>::Zero(), line_ = Vec<Dim>::Zero();  // of `reach` and `sideways`
  double share_ = 0.0, nearest_ = 0.0;
};

}  // namespace tribo
