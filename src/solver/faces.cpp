#include "solver/faces.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <array>

namespace tribo {

template <int Dim>
std::optional<Vec<Dim>> shortest_vector(Side<Dim>& a, Side<Dim>& b, double share, const Vec<Dim>& guess) {
  // Corners of the simplex around the nearest point of the difference b - a, and its weights
  std::array<Vec<Dim>, Dim + 2> corner;
  std::array<double, Dim + 2> weight{};
  int count = 1;
  const auto support = [&](const Vec<Dim>& along) {
    return Vec<Dim>(b.farthest(-along, share) - a.farthest(along, share));
  };
  corner[0] = support(guess);
  weight[0] = 1.0;
  Vec<Dim> x = corner[0];
  for (int step = 0; step < 100; ++step) {
    const double size = x.squaredNorm();
    const Vec<Dim> w = support(x);
    double scale = w.squaredNorm();
    for (int k = 0; k < count; ++k) scale = std::max(scale, corner[static_cast<std::size_t>(k)].squaredNorm());
    if (size <= 1e-20 * scale) return std::nullopt;
    if (size - x.dot(w) <= 1e-13 * size + 1e-15 * std::sqrt(size * scale)) return x;
    corner[static_cast<std::size_t>(count)] = w;
    weight[static_cast<std::size_t>(count)] = 0.0;
    ++count;
    while (true) {
      // Nearest point of the affine hull: Gram matrix with the condition that the weights sum to one
      constexpr int most = Dim + 3;  // unused rows stay rows of the identity
      Mat<most> gram = Mat<most>::Identity();
      Vec<most> right = Vec<most>::Zero();
      right[count] = scale;
      gram(count, count) = 0.0;
      for (int r = 0; r < count; ++r) {
        for (int c = 0; c < count; ++c)
          gram(r, c) = corner[static_cast<std::size_t>(r)].dot(corner[static_cast<std::size_t>(c)]);
        gram(r, count) = gram(count, r) = scale;
      }
      const Vec<most> solution = gram.partialPivLu().solve(right);
      bool inside = solution.allFinite();
      if (!inside) return x;
      double t = 1.0;
      for (int k = 0; k < count; ++k) {
        const double from = weight[static_cast<std::size_t>(k)], to = solution[k];
        if (to <= 1e-14) {
          inside = false;
          if (from > to) t = std::min(t, from / (from - to));
        }
      }
      int kept = 0;
      for (int k = 0; k < count; ++k) {
        const auto from = static_cast<std::size_t>(k);
        const double value = inside ? solution[k] : weight[from] + t * (solution[k] - weight[from]);
        if (!inside && value <= 1e-14) continue;
        corner[static_cast<std::size_t>(kept)] = corner[from];
        weight[static_cast<std::size_t>(kept)] = value;
        ++kept;
      }
      count = std::max(kept, 1);
      if (inside || count == 1) break;
    }
    x.setZero();
    double sum = 0.0;
    for (int k = 0; k < count; ++k) sum += weight[static_cast<std::size_t>(k)];
    for (int k = 0; k < count; ++k)
      x += weight[static_cast<std::size_t>(k)] / sum * corner[static_cast<std::size_t>(k)];
    if (count == Dim + 1) return std::nullopt;  // the origin is inside
    if (!(x.squaredNorm() < size)) return x;
  }
  return x;
}

template <int Dim>
std::optional<Vec<Dim>> margin_normal(Side<Dim>& a, Side<Dim>& b, const Vec<Dim>& guess, double length) {
  // Domains of half size leave a margin of half a particle to faces that touch or overlap a little; if that is not
  // enough, centres alone may still be parted.
  for (const double share : {0.5, 0.0})
    if (const auto x = shortest_vector<Dim>(a, b, share, guess); x && x->norm() > 1e-3 * length) return x->normalized();
  return std::nullopt;
}

template <int Dim>
std::optional<Vec<Dim>> regression_normal(const Side<Dim>& a, const Side<Dim>& b, bool logistic, double length) {
  using Row = Eigen::Matrix<double, Dim + 1, 1>;
  using Square = Eigen::Matrix<double, Dim + 1, Dim + 1>;
  const auto each = [&](auto&& f) {
    for (const auto* side : {&a, &b})
      for (int i = 0; i < side->count; ++i) {
        Row X;
        for (int d = 0; d < Dim; ++d) X[d] = side->x[d][static_cast<std::size_t>(i)] / length;
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
double face_position(Side<Dim>& side, const Vec<Dim>& n, double band) {
  side.measure(n, 1.0);
  const double limit = side.band_limit(n, band);
  double most = -std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < side.reach.size(); ++i)
    if (side.reach[i] > most && side.sideways2(n, i) <= limit) most = side.reach[i];
  return most;
}

template std::optional<Vec<2>> shortest_vector<2>(Side<2>&, Side<2>&, double, const Vec<2>&);
template std::optional<Vec<2>> margin_normal<2>(Side<2>&, Side<2>&, const Vec<2>&, double);
template std::optional<Vec<2>> regression_normal<2>(const Side<2>&, const Side<2>&, bool, double);
template double face_position<2>(Side<2>&, const Vec<2>&, double);
template std::optional<Vec<3>> shortest_vector<3>(Side<3>&, Side<3>&, double, const Vec<3>&);
template std::optional<Vec<3>> margin_normal<3>(Side<3>&, Side<3>&, const Vec<3>&, double);
template std::optional<Vec<3>> regression_normal<3>(const Side<3>&, const Side<3>&, bool, double);
template double face_position<3>(Side<3>&, const Vec<3>&, double);

}  // namespace tribo
