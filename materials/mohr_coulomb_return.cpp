// SPDX-License-Identifier: MIT
#include "materials/mohr_coulomb_return.hpp"

namespace tribo {
namespace {

// A plane F_ij (from = i, to = j) or T_j (from = -1), with indices of the sorted principal stresses.
struct Plane {
  int from, to;
};
constexpr Plane F13{0, 2}, F12{0, 1}, F23{1, 2}, T3{-1, 2}, T2{-1, 1}, T1{-1, 0};

struct Geometry {
  double lambda, mu;
  Strength s;
  Triple trial;
  double tolerance;  // [stress]

  // Gradient of the plane: 1 = S_to, the other S_from. `sine` is that of the friction (yield) or dilation angle (flow).
  static Triple gradient(Plane p, double sine) {
    Triple n{};
    n[static_cast<std::size_t>(p.to)] = p.from < 0 ? 1.0 : 0.5 * (1 + sine);
    if (p.from >= 0) n[static_cast<std::size_t>(p.from)] = -0.5 * (1 - sine);
    return n;
  }
  Triple normal(Plane p) const { return gradient(p, s.sin_friction); }
  Triple flow(Plane p) const {  // D r
    Triple r = gradient(p, s.sin_dilation);
    const double spread = lambda * (r[0] + r[1] + r[2]);
    for (double& x : r) x = spread + 2 * mu * x;
    return r;
  }
  double excess(Plane p, const Triple& S) const {
    const Triple n = normal(p);
    return n[0] * S[0] + n[1] * S[1] + n[2] * S[2] - (p.from < 0 ? s.tension : s.cohesion * s.cos_friction);
  }
  // Largest violation of the conditions for an admissible stress [stress]; NaN if the candidate does not exist.
  double violation(const Triple& S) const {
    const double order = std::max(S[0] - S[1], S[1] - S[2]);
    return std::max(order, std::max(excess(F13, S), S[2] - s.tension));
  }
};

// Solves the 1x1, 2x2 or 3x3 system by Cramer's rule.
template <std::size_t N>
std::array<double, N> solve(const std::array<std::array<double, N>, N>& m, const std::array<double, N>& f) {
  if constexpr (N == 1) {
    return {f[0] / m[0][0]};
  } else if constexpr (N == 2) {
    const double d = m[0][0] * m[1][1] - m[0][1] * m[1][0];
    return {(f[0] * m[1][1] - f[1] * m[0][1]) / d, (m[0][0] * f[1] - m[1][0] * f[0]) / d};
  } else {
    const auto cofactor = [&](std::size_t i, std::size_t j) {
      const std::size_t r = (i + 1) % 3, q = (i + 2) % 3, c = (j + 1) % 3, e = (j + 2) % 3;
      return m[r][c] * m[q][e] - m[r][e] * m[q][c];
    };
    const double d = m[0][0] * cofactor(0, 0) + m[0][1] * cofactor(0, 1) + m[0][2] * cofactor(0, 2);
    std::array<double, N> x{};
    for (std::size_t j = 0; j < 3; ++j)
      x[j] = (cofactor(0, j) * f[0] + cofactor(1, j) * f[1] + cofactor(2, j) * f[2]) / d;
    return x;
  }
}

// The best candidate found so far. `done` is set when one is admissible to round-off.
struct Search {
  const Geometry& g;
  double drag;
  Returned best{};
  double least = std::numeric_limits<double>::infinity();

  bool done() const { return least <= g.tolerance; }

  template <Plane... planes>
  bool attempt() {
    constexpr std::size_t N = sizeof...(planes);
    constexpr std::array<Plane, N> set{planes...};
    const std::array<Triple, N> flow{g.flow(planes)...};
    const std::array<double, N> f{g.excess(planes, g.trial)...};
    std::array<std::array<double, N>, N> m;
    for (std::size_t i = 0; i < N; ++i) {
      const Triple n = g.normal(set[i]);
      for (std::size_t j = 0; j < N; ++j) m[i][j] = n[0] * flow[j][0] + n[1] * flow[j][1] + n[2] * flow[j][2];
    }
    const auto corrected = [&](const std::array<double, N>& multipliers) {
      Returned r{g.trial, 0};
      for (std::size_t j = 0; j < N; ++j) {
        for (std::size_t i = 0; i < 3; ++i) r.stress[i] -= flow[j][i] * multipliers[j];
        if (set[j].from < 0) r.opening += multipliers[j];
      }
      return r;
    };
    const auto multipliers = solve(m, f);
    Returned r = corrected(multipliers);
    double miss = g.violation(r.stress);
    for (const double x : multipliers) miss = std::max(miss, -2 * g.mu * x);
    for (const double x : r.stress)
      if (!std::isfinite(x)) return false;
    if (!(miss < least)) return false;
    least = miss;
    if (drag > 0) {
      for (std::size_t i = 0; i < N; ++i) m[i][i] += drag;
      r = corrected(solve(m, f));
    }
    best = r;
    return done();
  }
};

}  // namespace

Returned Pyramid::corner(const Triple& trial, double drag) const {
  const double size = std::max(std::abs(trial[0]), std::abs(trial[2]));
  const Geometry g{lambda_, mu_, s_, trial, 1e-12 * std::max(s_.cohesion, size)};
  Search search{g, drag};

  // The tension planes can be active only if the trial stress exceeds them, unless shear flow raises S3 (lambda < 0).
  const bool tension = trial[2] > s_.tension || (lambda_ < 0 && std::isfinite(s_.tension));
  if (trial[0] > s_.tension && search.attempt<T3, T2, T1>()) return search.best;
  if (search.attempt<F13, F12>() || search.attempt<F13, F23>() || search.attempt<F13>()) return search.best;
  if (tension && (search.attempt<T3>() || search.attempt<F13, T3>() || search.attempt<T3, T2>() ||
                  search.attempt<T3, T2, T1>() || search.attempt<F13, F23, T3>() || search.attempt<F13, F12, T3>() ||
                  search.attempt<F13, T3, T2>() || search.attempt<F12, T3, T2>() || search.attempt<F13, F12, T2>()))
    return search.best;
  if (search.attempt<F13, F12, F23>()) return search.best;

  // At corners shared by several sets of planes, round-off can make every candidate fail by a very small amount.
  if (search.least <= 1e-9 * std::max(s_.cohesion, size)) return search.best;
  const double apex = s_.tension;
  const double volume = (trial[0] + trial[1] + trial[2] - 3 * apex) / (3 * lambda_ + 2 * mu_);
  Returned r{{apex, apex, apex}, std::max(0.0, volume)};
  if (drag > 0) {  // overstress at the apex of the three tension planes
    const double kept = drag / (3 * lambda_ + 2 * mu_ + drag);
    for (std::size_t i = 0; i < 3; ++i) r.stress[i] += kept * (trial[i] - apex);
    r.opening *= 1 - kept;
  }
  return r;
}

}  // namespace tribo
