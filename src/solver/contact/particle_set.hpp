// SPDX-License-Identifier: MIT
/// A set of particle domains near a node, and their support function.
#pragma once

#include "base/types.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace tribo {

/// The side of a particle domain whose outward normal is nearest to a direction n.
template <int Dim>
struct Facet {
  Vec<Dim> offset;  ///< centre of the particle from the node, projected on the plane normal to n   [length]
  Vec<Dim> middle;  ///< centre of the side, from the node                                          [length]
  Vec<Dim> normal;  ///< outward unit normal of the side
  /// Distance along n from the point `line` to the plane of the side [length].
  double height(const Vec<Dim>& n, const Vec<Dim>& line) const { return (middle - line).dot(normal) / normal.dot(n); }
};

/// The particles of one side of a contact pair: centres relative to the node, and half axes of the domains, in columns.
///
/// Results of the last compute_reach() and band_limit() are kept, as several algorithms need them for the same normal.
template <int Dim>
class ParticleSet {
 public:
  std::vector<std::size_t> numbers;  ///< per particle: its number in the columns from which it was assigned
  std::vector<double> reach;         ///< result of compute_reach() [length]; entries beyond size() are undefined
  std::vector<double>
      offset_squared;  ///< result of band_limit(): squared distances from the line through the node [length^2]
  std::vector<Vec<Dim>> corners;               ///< working memory of face_geometry.cpp
  std::vector<Facet<Dim>> facets, all_facets;  ///< working memory of face_geometry.cpp

  std::size_t size() const { return numbers.size(); }
  bool empty() const { return numbers.empty(); }
  void clear() {
    numbers.clear();
    invalidate();
  }
  /// Adds a particle by its centre, relative to the node, and its half axes as columns [length].
  void add(const Vec<Dim>& centre, const Mat<Dim>& half, std::size_t number = 0) {
    if (size() == capacity_) grow();
    double* to = columns_.data() + size();
    for (int c = 0; c < Dim; ++c) to[static_cast<std::size_t>(c) * capacity_] = centre[c];
    for (int c = 0; c < Dim * Dim; ++c) to[static_cast<std::size_t>(Dim + c) * capacity_] = half.data()[c];
    numbers.push_back(number);
    invalidate();
  }

  /// Columns of the coordinates of centres, then of the components of the first, second ... half axes.
  using Columns = std::array<const double*, Dim + Dim * Dim>;
  /// Replaces the set by the particles `selected` of the columns `from`. `origin`: position of the node [length].
  void assign(const std::vector<std::size_t>& selected, const Columns& from, const Vec<Dim>& origin) {
    numbers.clear();
    while (capacity_ < selected.size()) grow();
    numbers = selected;
    for (int c = 0; c < columns; ++c) {
      const double* source = from[static_cast<std::size_t>(c)];
      const double zero = c < Dim ? origin[c] : 0.0;
      gather(source, selected.data(), size(), zero, column(c));
    }
    invalidate();
  }

  /// The domain of a particle: its centre, and its half axes as columns [length].
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

  /// The unit normals of the sides of a domain, as columns; those of the sides at the positive ends of the half axes.
  /// They are kept, as several searches along different directions need them.
  const Mat<Dim>& side_normals(std::size_t i) {
    if (has_normals_.size() != size())
      has_normals_.assign(size(), 0), normals_.resize(std::max(normals_.size(), size()));
    if (has_normals_[i] == 0)
      has_normals_[i] = 1, normals_[i] = half_axes(i).inverse().transpose().colwise().normalized();
    return normals_[i];
  }

  /// The support function of each domain, scaled about its centre by `scale`: reach[i] = x_i . n + scale * sum_k |r_k .
  /// n|, where r_k are the half axes [length]. `n`: unit vector.
  void compute_reach(const Vec<Dim>& n, double scale) {
    if (reach_valid_ && n == reach_along_ && scale == scale_) return;
    reach_valid_ = true, reach_along_ = n, scale_ = scale;
    const std::size_t padded = (size() + lanes - 1) / lanes * lanes;
    for (int c = 0; c < columns; ++c) std::fill(column(c) + size(), column(c) + padded, 0.0);
    reach.resize(capacity_);
    fill_reach(columns_.data(), capacity_, n, scale, padded, reach.data());
  }
  /// The particle with the largest reach; the first one of equals.
  std::size_t farthest_particle(const Vec<Dim>& n, double scale) {
    compute_reach(n, scale);
    constexpr double infinity = std::numeric_limits<double>::infinity();
    const std::size_t padded = (size() + lanes - 1) / lanes * lanes;
    std::fill(reach.data() + size(), reach.data() + padded, -infinity);
    std::array<double, lanes> most;
    most.fill(-infinity);
    for (std::size_t i = 0; i < padded; i += lanes)
      for (std::size_t k = 0; k < lanes; ++k) most[k] = reach[i + k] > most[k] ? reach[i + k] : most[k];
    const auto end = reach.begin() + static_cast<std::ptrdiff_t>(size());
    const auto found = std::find(reach.begin(), end, *std::max_element(most.begin(), most.end()));
    return found == end ? 0 : static_cast<std::size_t>(found - reach.begin());
  }
  /// The largest reach [length].
  double max_reach(const Vec<Dim>& n, double scale) { return reach[farthest_particle(n, scale)]; }
  /// The corner of a scaled domain that has the largest reach [length].
  Vec<Dim> farthest_corner(const Vec<Dim>& n, double scale) {
    const std::size_t best = farthest_particle(n, scale);
    const Mat<Dim> half = half_axes(best);
    Vec<Dim> corner = centre(best);
    for (int k = 0; k < Dim; ++k) corner += (half.col(k).dot(n) < 0 ? -scale : scale) * half.col(k);
    return corner;
  }

  /// Computes offset_squared from the line through the node along the unit vector n. Returns the square of the half
  /// width `band` of the band around this line [length^2], but at least so much that the nearest particle is inside.
  double band_limit(const Vec<Dim>& n, double band) {
    if (offset_squared.size() != size() || n != line_) {
      line_ = n;
      offset_squared.resize(size());
      nearest_ = std::numeric_limits<double>::infinity();
      for (std::size_t i = 0; i < size(); ++i) {
        const Vec<Dim> x = centre(i);
        offset_squared[i] = x.squaredNorm() - x.dot(n) * x.dot(n);
        nearest_ = std::min(nearest_, offset_squared[i]);
      }
    }
    return std::max(band * band, nearest_ * (1 + 1e-6));
  }

 private:
  static constexpr int columns = Dim + Dim * Dim;
  static constexpr std::size_t lanes = 8;  // compilers may process so many values at a time

  double* column(int c) { return columns_.data() + static_cast<std::size_t>(c) * capacity_; }
  const double* column(int c) const { return columns_.data() + static_cast<std::size_t>(c) * capacity_; }
  void invalidate() {
    reach_valid_ = false;
    offset_squared.clear(), has_normals_.clear();
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
  // A separate function, so that compilers can assume that the arrays do not overlap.
  static void fill_reach(const double* from, std::size_t stride, const Vec<Dim>& n, double scale, std::size_t count,
                         double* __restrict out) {
    for (std::size_t i = 0; i < count; ++i) {
      double s = 0.0, e = 0.0;
      for (std::size_t d = 0; d < Dim; ++d) s += from[d * stride + i] * n[static_cast<Eigen::Index>(d)];
      for (std::size_t k = 1; k <= Dim; ++k) {
        double r = 0.0;
        for (std::size_t d = 0; d < Dim; ++d) r += from[(Dim * k + d) * stride + i] * n[static_cast<Eigen::Index>(d)];
        e += std::fabs(r);
      }
      out[i] = s + scale * e;
    }
  }

  std::vector<double> columns_;  // one after the other, each of capacity_ values
  std::size_t capacity_ = 0;     // a multiple of lanes
  bool reach_valid_ = false;
  Vec<Dim> reach_along_ = Vec<Dim>::Zero(), line_ = Vec<Dim>::Zero();  // of `reach` and `offset_squared`
  double scale_ = 0.0, nearest_ = 0.0;
  std::vector<Mat<Dim>> normals_;  // result of side_normals() where has_normals_ is 1
  std::vector<char> has_normals_;
};

}  // namespace tribo
