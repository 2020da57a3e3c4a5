// SPDX-License-Identifier: MIT
/// Branch-free returns to the faces, edges and corners of the pyramid, for loops over points of constant strength.
/// They give the same stresses as Pyramid::nearest, which searches all sets of planes.
#pragma once

#include "materials/mohr_coulomb_law.hpp"

#include <Eigen/LU>

namespace tribo {

// Subtracted from the sorted principal stresses. All zero if the return does not end on the planes that were tried.
struct Change {
  double c1, c2, c3;  // [stress]
  double opening;     // plastic volume strain of the tension planes
};

// Returns to the face F_13. The coefficients are constant without softening.
struct Face {
  Strength strength;
  double spread, rise, fall;  // D r: the return lowers S2 by spread and S3 by fall, and raises S1 by rise [stress]
  double inverse;             // 1/a
  double share;               // fraction of the plastic multiplier that flows in the step, due to viscosity

  Face(const MohrCoulombLaw& law, double dt) : strength(law.pyramid().strength()) {
    const double lambda = law.elastic.lambda, mu = law.elastic.mu;
    const double sf = strength.sin_friction, sp = strength.sin_dilation;
    const double a = mu + (lambda + mu) * sf * sp;
    spread = lambda * sp, rise = mu * (1 - sp) - spread, fall = mu * (1 + sp) + spread, inverse = 1 / a;
    share = dt / (dt + law.relaxation_time) * a / (a + law.viscosity / dt);
  }

  [[gnu::always_inline]] Change operator()(double S1, double S2, double S3) const {
    const double excess = 0.5 * (1 + strength.sin_friction) * S3 - 0.5 * (1 - strength.sin_friction) * S1 -
                          strength.cohesion * strength.cos_friction;
    const double m = excess * inverse, middle = S2 - spread * m, last = S3 - fall * m;
    const bool here = (excess > 0) & (S1 + rise * m <= middle) & (middle <= last) & (last <= strength.tension);
    const double flows = here ? share * m : 0.0;
    return {-rise * flows, spread * flows, fall * flows, 0.0};
  }
};

// Returns to the edges S2 = S3 and S1 = S2 and to the corners with tension planes: sets of planes with constant
// matrices. The points that remain are returned one by one by Pyramid::corner.
struct Edges {
  struct Pair {
    Triple first, second;       // D r of F_13 and of the other plane [stress]
    double i11, i12, i21, i22;  // matrix from yield excesses to multipliers [1/stress]
  };
  struct Corner {
    Triple point;                   // [stress]
    std::array<Triple, 3> inverse;  // matrix from the stress beyond the point to multipliers [1/stress]
    double opens;                   // number of tension planes among the planes, counted from the last
    bool exists;
  };
  Strength strength;
  double resistance, high, low, share = 1.0;  // share: fraction of the return that flows in the step
  Pair upper, lower;
  std::array<Corner, 3> corners;

  explicit Edges(const MohrCoulombLaw& law) : strength(law.pyramid().strength()) {
    const double sf = strength.sin_friction, sp = strength.sin_dilation;
    resistance = strength.cohesion * strength.cos_friction, high = 0.5 * (1 + sf), low = 0.5 * (1 - sf);
    const auto plane = [](int from, int to, double sine) {
      Vec3 n = Vec3::Zero();
      n[to] = from < 0 ? 1.0 : 0.5 * (1 + sine);
      if (from >= 0) n[from] = -0.5 * (1 - sine);
      return n;
    };
    const auto flow = [&](int from, int to) {
      const Vec3 r = plane(from, to, sp);
      return Vec3(Vec3::Constant(law.elastic.lambda * r.sum()) + 2 * law.elastic.mu * r);
    };
    const auto triple = [](const Vec3& v) { return Triple{v[0], v[1], v[2]}; };
    const auto pair = [&](int from, int to) {
      const Vec3 n = plane(0, 2, sf), m = plane(from, to, sf), a = flow(0, 2), b = flow(from, to);
      const double nn = n.dot(a), nm = n.dot(b), mn = m.dot(a), mm = m.dot(b), d = nn * mm - nm * mn;
      return Pair{triple(a), triple(b), mm / d, -nm / d, -mn / d, nn / d};
    };
    upper = pair(0, 1), lower = pair(1, 2);
    const auto corner = [&](const std::array<std::array<int, 2>, 3>& planes, double opens) {
      Mat3 normals, flows;
      Vec3 limits;
      for (int k = 0; k < 3; ++k) {
        const auto [from, to] = planes[static_cast<std::size_t>(k)];
        normals.row(k) = plane(from, to, sf).transpose(), flows.col(k) = flow(from, to);
        limits[k] = from < 0 ? strength.tension : resistance;
      }
      Corner c{{}, {}, opens, std::isfinite(strength.tension)};
      const Vec3 at = normals.inverse() * limits;
      const Mat3 inverse = flows.inverse();
      c.point = triple(at);
      for (int k = 0; k < 3; ++k) c.inverse[static_cast<std::size_t>(k)] = triple(inverse.row(k).transpose());
      const double hair = 1e-12 * std::max(strength.cohesion, at.cwiseAbs().maxCoeff());
      c.exists &= at.allFinite() && inverse.allFinite() && at[0] <= at[1] + hair && at[1] <= at[2] + hair &&
                  high * at[2] - low * at[0] - resistance <= hair && at[2] <= strength.tension + hair;
      return c;
    };
    corners = {corner({{{-1, 0}, {-1, 1}, {-1, 2}}}, 3), corner({{{0, 2}, {1, 2}, {-1, 2}}}, 1),
               corner({{{0, 2}, {0, 1}, {-1, 2}}}, 1)};
  }

  [[gnu::always_inline]] Change operator()(double S1, double S2, double S3) const {
    const double f13 = high * S3 - low * S1 - resistance, f12 = high * S2 - low * S1 - resistance,
                 f23 = high * S3 - low * S2 - resistance;
    const bool beyond = (f13 > 0) | (S3 > strength.tension);
    Change out{0, 0, 0, 0};
    const auto choose = [&](bool here, double c1, double c2, double c3, double opening) {
      out.c1 = here ? c1 : out.c1, out.c2 = here ? c2 : out.c2, out.c3 = here ? c3 : out.c3;
      out.opening = here ? opening : out.opening;
    };
    // the set with the lowest priority comes first, so that later ones overwrite it
    for (std::size_t k = 3; k-- > 0;) {
      const Corner& c = corners[k];
      const double x = S1 - c.point[0], y = S2 - c.point[1], z = S3 - c.point[2];
      const auto multiplier = [&](std::size_t r) {
        return c.inverse[r][0] * x + c.inverse[r][1] * y + c.inverse[r][2] * z;
      };
      const double a = multiplier(0), b = multiplier(1), d = multiplier(2);
      choose(beyond & c.exists & (a >= 0) & (b >= 0) & (d >= 0), x, y, z, k == 0 ? a + b + d : d);
    }
    const auto pair = [&](const Pair& p, double f, bool is_upper) {
      const double a = p.i11 * f13 + p.i12 * f, b = p.i21 * f13 + p.i22 * f;
      const double c1 = a * p.first[0] + b * p.second[0], c2 = a * p.first[1] + b * p.second[1],
                   c3 = a * p.first[2] + b * p.second[2];
      const bool sorted = is_upper ? S1 - c1 <= S2 - c2 : S2 - c2 <= S3 - c3;
      choose(beyond & (a >= 0) & (b >= 0) & sorted & (S3 - c3 <= strength.tension), c1, c2, c3, 0.0);
    };
    pair(upper, f12, true);
    pair(lower, f23, false);
    return {share * out.c1, share * out.c2, share * out.c3, share * out.opening};
  }
};

}  // namespace tribo
