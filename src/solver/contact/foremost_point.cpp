// SPDX-License-Identifier: MIT
/// The place along a common face where two curved faces meet first.

#include "solver/contact/face_geometry.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace tribo {
namespace {

// The form of a face is that within this distance from the line through the node, with a weight that vanishes there
// [cells].
constexpr double window = 1.0;
// Heights of the face are taken on a grid with so many intervals of this length on each side of the node [cells].
template <int Dim>
constexpr int intervals = Dim == 2 ? 4 : 2;
template <int Dim>
constexpr double interval = Dim == 2 ? 0.22 : 0.44;
// The face is what lies at most this far behind its foremost corner [cells].
constexpr double face_depth = 0.2;
// Corners that lie behind the foremost one by this, times the curvature of the face, have the weight 1/e. A much
// smaller value selects a corner by its round-off error where a face is flattened, a larger one misses the foremost
// corner [cells^2].
constexpr double foremost_depth = 0.01, least_curvature = 0.01;
// Relative curvatures below the first value are taken for the noise of plane faces, where no place is foremost; above
// the second one the foremost place is that of the corners [1/cells].
constexpr double plane = 0.025, curved = 0.035;

constexpr double infinity = std::numeric_limits<double>::infinity();

template <int Dim>
using Along = Eigen::Matrix<double, Dim - 1, 1>;  // a vector along the face
template <int Dim>
using Square = Eigen::Matrix<double, Dim - 1, Dim - 1>;
template <int Dim>
using Tangents = Eigen::Matrix<double, Dim, Dim - 1>;

// Two unit vectors, or in the plane one, along a face with the normal n.
template <int Dim>
Tangents<Dim> tangents_of(const Vec<Dim>& n) {
  Tangents<Dim> t;
  if constexpr (Dim == 2) {
    t << -n[1], n[0];
  } else {
    t.col(0) = n.unitOrthogonal();
    t.col(1) = n.cross(Vec<3>(t.col(0)));
  }
  return t;
}

template <int Dim>
double weight_at(const Along<Dim>& t) {
  const double rest = 1 - t.squaredNorm() / (window * window);
  return rest > 0 ? rest * rest : 0.0;
}

// The places of the grid on which the heights of a face are taken [cells].
template <int Dim>
constexpr std::size_t places_per_axis = 2 * intervals<Dim> + 1;
template <int Dim>
using Heights = std::array<double, Dim == 2 ? places_per_axis<2> : places_per_axis<3> * places_per_axis<3>>;
template <int Dim>
Along<Dim> place(std::size_t number) {
  Along<Dim> t;
  for (int d = 0; d < Dim - 1; ++d, number /= places_per_axis<Dim>)
    t[d] = interval<Dim> * (static_cast<double>(number % places_per_axis<Dim>) - intervals<Dim>);
  return t;
}

// Replaces the eigenvalues of a symmetric matrix by f of them.
template <class Matrix, class F>
Matrix map_eigenvalues(const Matrix& m, F&& f) {
  const Eigen::SelfAdjointEigenSolver<Matrix> axes(m);
  return axes.eigenvectors() * axes.eigenvalues().unaryExpr(f).asDiagonal() * axes.eigenvectors().transpose();
}

// Sums for the least-squares fit of the height of a face, z = c + s . t - t . K t / 2.
template <int Dim>
class HeightFit {
 public:
  void add(const Along<Dim>& t, double z, double weight) {
    Row q;
    q[0] = 1;
    Eigen::Index k = 1;
    for (int i = 0; i < Dim - 1; ++i) q[k++] = t[i];
    for (int i = 0; i < Dim - 1; ++i)
      for (int j = i; j < Dim - 1; ++j) q[k++] = i == j ? -0.5 * t[i] * t[i] : -t[i] * t[j];
    squares_ += weight * q * q.transpose(), sums_ += weight * z * q, weight_ += weight;
  }
  // The curvature K; zero along directions in which there are too few points.
  Square<Dim> curvature() const {
    constexpr double least_of_place = 1e-6, least_of_curvature = 1e-3;
    if (!(weight_ > 0)) return Square<Dim>::Zero();
    Matrix A = squares_;
    for (int k = 0; k < size; ++k) A(k, k) += (k < Dim ? least_of_place : least_of_curvature) * weight_;
    const Row y = A.ldlt().solve(sums_);
    Square<Dim> out;
    Eigen::Index k = Dim;
    for (int i = 0; i < Dim - 1; ++i)
      for (int j = i; j < Dim - 1; ++j) out(i, j) = out(j, i) = y[k++];
    return out;
  }

 private:
  static constexpr int size = Dim * (Dim + 1) / 2;
  using Row = Eigen::Matrix<double, size, 1>;
  using Matrix = Eigen::Matrix<double, size, size>;
  Matrix squares_ = Matrix::Zero();
  Row sums_ = Row::Zero();
  double weight_ = 0.0;
};

// Removes the heights in the gaps between domains, where the line meets a domain of the next row: they lie behind their
// neighbours on both sides, or at the end of the face behind the line through the next two.
template <int Dim>
void remove_holes(Heights<Dim>& z) {
  constexpr double depth = 0.04;  // cells
  constexpr auto per_axis = static_cast<std::ptrdiff_t>(places_per_axis<Dim>);
  const Heights<Dim> all = z;
  std::ptrdiff_t step = 1;
  for (int axis = 0; axis < Dim - 1; ++axis, step *= per_axis)
    for (std::ptrdiff_t k = 0; k < static_cast<std::ptrdiff_t>(all.size()); ++k) {
      const std::ptrdiff_t at = k / step % per_axis;
      const auto height = [&](std::ptrdiff_t steps) {
        return at + steps < 0 || at + steps >= per_axis ? -infinity : all[static_cast<std::size_t>(k + steps * step)];
      };
      const double low = height(-1), high = height(1);
      double expected = std::min(low, high);
      if (low == -infinity) expected = 2 * high - height(2);
      if (high == -infinity) expected = 2 * low - height(-2);
      if (std::isfinite(expected) && height(0) < expected - depth) z[static_cast<std::size_t>(k)] = -infinity;
    }
}

// The curvature of a face [1/cells], from its heights at the places where the other one has a height, too. At the end
// of a face both are thus fitted to the same places, so that faces which lie in each other have no relative curvature.
// Too few places show no curvature.
template <int Dim>
Square<Dim> curvature_of(const Heights<Dim>& face, const Heights<Dim>& other) {
  constexpr int least = Dim == 2 ? 4 : 9;
  HeightFit<Dim> fit;
  int count = 0;
  for (std::size_t k = 0; k < face.size(); ++k) {
    const Along<Dim> t = place<Dim>(k);
    const double w = weight_at<Dim>(t);
    if (w > 0 && face[k] > -infinity && other[k] > -infinity) fit.add(t, face[k], w), ++count;
  }
  return count >= least ? fit.curvature() : Square<Dim>(Square<Dim>::Zero());
}

// A domain at the face; all lengths in cells.
template <int Dim>
struct Domain {
  Vec<Dim> centre;
  Mat<Dim> half, inverse;
  bool in_band;

  // The largest height along n of its points on the line through x along n; -infinity if the line misses it.
  double height(const Vec<Dim>& n, const Vec<Dim>& x) const {
    const Vec<Dim> from = inverse * (x - centre), along = inverse * n;
    double low = -infinity, high = infinity;
    for (int k = 0; k < Dim; ++k) {
      if (std::abs(along[k]) < 1e-9) {  // the line is parallel to these two sides
        if (std::abs(from[k]) > 1) return -infinity;
        continue;
      }
      const double half_length = 1 / std::abs(along[k]), middle = -from[k] / along[k];
      low = std::max(low, middle - half_length), high = std::min(high, middle + half_length);
    }
    return low <= high ? high : -infinity;
  }
};

// The form of one side around the line through the node along n.
template <int Dim>
class Face {
 public:
  Face(ParticleSet<Dim>& side, const Vec<Dim>& n, const Tangents<Dim>& tangents, double band, double length)
      : n_(n), tangents_(tangents), top_(face_position<Dim>(side, n, band) / length) {
    const double in_band = side.band_limit(n, band), around = side.band_limit(n, band + length);
    for (std::size_t i = 0; i < side.size(); ++i) {
      if (side.offset_squared[i] > around || side.reach[i] < (top_ - face_depth) * length) continue;
      const Mat<Dim> half = side.half_axes(i) / length;
      domains_.push_back({side.centre(i) / length, half, half.inverse(), side.offset_squared[i] <= in_band});
    }
  }

  // Heights along the normal at the places of the grid; -infinity where the body has no face [cells].
  Heights<Dim> heights() const {
    Heights<Dim> out;
    for (std::size_t k = 0; k < out.size(); ++k) {
      double& z = out[k] = -infinity;
      for (const Domain<Dim>& domain : domains_) z = std::max(z, domain.height(n_, tangents_ * place<Dim>(k)));
      if (!(z > top_ - face_depth)) z = -infinity;
    }
    remove_holes<Dim>(out);
    return out;
  }

  // The mean place of the foremost corners [cells].
  Along<Dim> foremost(const Square<Dim>& curvature) const {
    const double depth = foremost_depth * std::max(curvature.trace(), least_curvature);
    double sum = 0.0;
    Along<Dim> mean = Along<Dim>::Zero();
    for (const Domain<Dim>& domain : domains_)
      for (int corner = 0; domain.in_band && corner < 1 << Dim; ++corner) {
        Vec<Dim> x = domain.centre;
        for (int d = 0; d < Dim; ++d) x += ((corner >> d & 1) != 0 ? 1.0 : -1.0) * domain.half.col(d);
        const Along<Dim> t = tangents_.transpose() * x;
        const double w = weight_at<Dim>(t) * std::exp((x.dot(n_) - top_) / depth);
        sum += w, mean += w * t;
      }
    return sum > 0 ? Along<Dim>(mean / sum) : mean;
  }

 private:
  Vec<Dim> n_;
  Tangents<Dim> tangents_;
  double top_;  // height of the foremost corner in the band
  std::vector<Domain<Dim>> domains_;
};

}  // namespace

template <int Dim>
Vec<Dim> foremost_offset(const std::array<ParticleSet<Dim>*, 2>& sides, const std::array<bool, 2>& curves,
                         const Vec<Dim>& n, double band, double length) {
  if (!curves[0] && !curves[1]) return Vec<Dim>::Zero();
  const Tangents<Dim> tangents = tangents_of<Dim>(n);
  // The more curved side decides where they meet. A face that is not curved counts only if it has become concave.
  Square<Dim> relative = Square<Dim>::Zero(), convex = relative;
  Along<Dim> moment = Along<Dim>::Zero();
  const std::array<Face<Dim>, 2> faces{Face<Dim>(*sides[0], n, tangents, band, length),
                                       Face<Dim>(*sides[1], -n, tangents, band, length)};
  const std::array<Heights<Dim>, 2> heights{faces[0].heights(), faces[1].heights()};
  for (std::size_t k = 0; k < 2; ++k) {
    const Square<Dim> curvature = curvature_of<Dim>(heights[k], heights[1 - k]);
    const Square<Dim> outward = map_eigenvalues(curvature, [](double c) { return std::max(c, 0.0); });
    relative += curves[k] ? curvature : Square<Dim>(curvature - outward);
    if (curves[k]) convex += outward, moment += outward * faces[k].foremost(curvature);
  }
  if (!(relative.trace() > plane)) return Vec<Dim>::Zero();
  const auto inverse = [](double c) { return c > 1e-6 ? 1 / c : 0.0; };
  const auto share = [](double c) { return std::clamp((c - plane) / (curved - plane), 0.0, 1.0); };
  return length * (tangents * (map_eigenvalues(relative, share) * (map_eigenvalues(convex, inverse) * moment)));
}

template Vec<2> foremost_offset<2>(const std::array<ParticleSet<2>*, 2>&, const std::array<bool, 2>&, const Vec<2>&,
                                   double, double);
template Vec<3> foremost_offset<3>(const std::array<ParticleSet<3>*, 2>&, const std::array<bool, 2>&, const Vec<3>&,
                                   double, double);

}  // namespace tribo
