// SPDX-License-Identifier: MIT
/// Wolfe's algorithm for the shortest vector between the convex hulls of two sets of particle domains.

#include "solver/contact/face_geometry.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>

namespace tribo {
namespace {

// A simplex of corners of a polytope, with the weights of the point of the simplex that is nearest to the origin.
template <int Dim>
class Simplex {
 public:
  void add(const Vec<Dim>& corner) {
    corners_[count_] = corner;
    weights_[count_++] = 0.0;
  }
  bool has(const Vec<Dim>& corner) const {
    return std::find(corners_.begin(), corners_.begin() + count_, corner) != corners_.begin() + count_;
  }
  bool full() const { return count_ == Dim + 1; }
  /// The largest squared distance of a corner from the origin.
  double scale() const {
    double scale = 0.0;
    for (std::size_t k = 0; k < count_; ++k) scale = std::max(scale, corners_[k].squaredNorm());
    return scale;
  }
  /// Finds the point of the simplex nearest to the origin, and removes the corners without a weight in it.
  Vec<Dim> nearest() {
    Weights next;
    while (count_ > 1 && affine(next) && !advance(next)) {
    }
    Vec<Dim> x = Vec<Dim>::Zero();
    double sum = 0.0;
    for (std::size_t k = 0; k < count_; ++k) sum += weights_[k], x += weights_[k] * corners_[k];
    return count_ > 1 ? Vec<Dim>(x / sum) : corners_[0];
  }
  /// Gives equal weights to all corners, to begin with.
  void spread() { std::fill_n(weights_.begin(), count_, 1.0 / static_cast<double>(count_)); }

 private:
  using Weights = std::array<double, Dim + 1>;

  // Weights of the point of the affine hull of the corners that is nearest to the origin; false if the corners are
  // affinely dependent.
  bool affine(Weights& to) const {
    if (count_ == 2) return affine_of<1>(to);
    if (count_ == 3) return affine_of<2>(to);
    return affine_of<Dim>(to);
  }

  template <int Edges>
  bool affine_of(Weights& to) const {
    Eigen::Matrix<double, Dim, Edges> edges;
    for (int k = 0; k < Edges; ++k) edges.col(k) = corners_[static_cast<std::size_t>(k + 1)] - corners_[0];
    const Mat<Edges> gram = edges.transpose() * edges;
    const Vec<Edges> right = edges.transpose() * corners_[0];
    Vec<Edges> solution;
    if constexpr (Edges == 1)
      solution[0] = -right[0] / gram(0, 0);
    else
      solution = gram.ldlt().solve(-right);  // also works if corners are nearly in line
    if (!solution.allFinite()) return false;
    to[0] = 1.0 - solution.sum();
    for (int k = 0; k < Edges; ++k) to[static_cast<std::size_t>(k + 1)] = solution[k];
    return true;
  }

  // Changes the weights towards new ones as far as all stay positive, and removes the corners whose weight vanishes;
  // true if the new weights are reached.
  bool advance(const Weights& to) {
    constexpr double zero = 1e-14;
    double t = 1.0;
    for (std::size_t k = 0; k < count_; ++k)
      if (to[k] <= zero && weights_[k] > to[k]) t = std::min(t, weights_[k] / (weights_[k] - to[k]));
    const bool inside = std::all_of(to.begin(), to.begin() + count_, [&](double w) { return w > zero; });
    std::size_t kept = 0;
    for (std::size_t k = 0; k < count_; ++k) {
      const double value = inside ? to[k] : weights_[k] + t * (to[k] - weights_[k]);
      if (!inside && value <= zero) continue;
      corners_[kept] = corners_[k];
      weights_[kept++] = value;
    }
    count_ = std::max<std::size_t>(kept, 1);
    return inside;
  }

  std::array<Vec<Dim>, Dim + 1> corners_;
  Weights weights_{};
  std::size_t count_ = 0;
};

}  // namespace

template <int Dim>
std::optional<Vec<Dim>> shortest_vector(ParticleSet<Dim>& a, ParticleSet<Dim>& b, double scale, const Vec<Dim>& guess) {
  const auto support = [&](const Vec<Dim>& along) {
    return Vec<Dim>(b.farthest_corner(-along, scale) - a.farthest_corner(along, scale));
  };
  // Between flat faces, the simplex of corners that are far apart already contains the nearest point.
  constexpr double tilt = 0.05;
  Simplex<Dim> simplex;
  for (const Vec<Dim>& t : directions_around<Dim>(guess))
    if (const Vec<Dim> corner = support(guess + tilt * t); !simplex.has(corner)) simplex.add(corner);
  simplex.spread();
  Vec<Dim> x = simplex.nearest();
  for (int step = 0; step < 100; ++step) {
    const double size = x.squaredNorm();
    const Vec<Dim> w = support(x);
    const double largest = std::max(w.squaredNorm(), simplex.scale());
    if (size <= 1e-20 * largest) return std::nullopt;
    if (size - x.dot(w) <= 1e-13 * size + 1e-15 * std::sqrt(size * largest)) return x;
    simplex.add(w);
    x = simplex.nearest();
    if (simplex.full()) return std::nullopt;  // the origin is inside
    if (!(x.squaredNorm() < size)) return x;
  }
  return x;
}

template std::optional<Vec<2>> shortest_vector<2>(ParticleSet<2>&, ParticleSet<2>&, double, const Vec<2>&);
template std::optional<Vec<3>> shortest_vector<3>(ParticleSet<3>&, ParticleSet<3>&, double, const Vec<3>&);

}  // namespace tribo
