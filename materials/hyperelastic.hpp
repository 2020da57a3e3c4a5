// SPDX-License-Identifier: MIT
/// Common parts of isotropic hyperelastic laws: volumetric energies and the batch implementation.
#pragma once

#include "materials/elastic_constants.hpp"
#include "materials/principal.hpp"

#include <algorithm>
#include <cmath>

namespace tribo {

/// Volumetric energies U(J) with modulus k, selected by UJOption as in NairnMPM:
///   0: k/2 ((J^2 - 1)/2 - ln J)    1: k/2 (J - 1)^2    2: k/2 (ln J)^2
template <int Option>
struct Volumetric {
  double modulus;
  double energy(double J) const {
    if constexpr (Option == 0) return 0.5 * modulus * (0.5 * (J * J - 1) - std::log(J));
    if constexpr (Option == 1) return 0.5 * modulus * (J - 1) * (J - 1);
    return 0.5 * modulus * std::log(J) * std::log(J);
  }
  /// U'(J)
  double slope(double J) const {
    if constexpr (Option == 0) return 0.5 * modulus * (J - 1 / J);
    if constexpr (Option == 1) return modulus * (J - 1);
    return modulus * std::log(J) / J;
  }
  /// J^2 U''(J)
  double stiffness(double J) const {
    if constexpr (Option == 0) return 0.5 * modulus * (J * J + 1);
    if constexpr (Option == 1) return modulus * J * J;
    return modulus * (1 - std::log(J));
  }
};

/// UJOption as a whole number. Any value other than 0, 1 or 2 is a problem.
inline int volumetric_choice(double value, const Statement& statement, Problems& problems) {
  if (value == 0 || value == 1 || value == 2) return static_cast<int>(value);
  const Statement* child = statement.child("UJOption");
  problems.add(child ? child->text_origin : statement.origin, "<UJOption> must be 0, 1 or 2");
  return 0;
}

/// Coefficients of sigma = c0 1 + c1 b + c2 b^2, with b = F F^T the left Cauchy-Green tensor.
struct Coefficients {
  double c0, c1, c2;
};

/// Invariants of b: trace, (trace^2 - trace b^2)/2, and J = det F.
struct Invariants {
  double I1, I2, J;
};

/// Components xx yy zz xy yz xz of the left Cauchy-Green tensor.
struct LeftCauchyGreen {
  double xx, yy, zz, xy, yz, xz, J;
  /// No principal value is larger (Gershgorin).
  double bound() const {
    const double x = std::abs(xy), y = std::abs(yz), z = std::abs(xz);
    return std::max({xx + x + z, yy + x + y, zz + y + z});
  }
  Invariants invariants() const { return {xx + yy + zz, xx * yy + yy * zz + zz * xx - xy * xy - yz * yz - xz * xz, J}; }
};

inline LeftCauchyGreen left_cauchy_green(const MaterialPoints<2>& p, int i, double Fzz) {
  const double xx = p.F[0][i], xy = p.F[1][i], yx = p.F[2][i], yy = p.F[3][i];
  return {xx * xx + xy * xy, yx * yx + yy * yy, Fzz * Fzz, xx * yx + xy * yy, 0, 0, (xx * yy - xy * yx) * Fzz};
}
inline LeftCauchyGreen left_cauchy_green(const MaterialPoints<2>& p, int i) {
  return left_cauchy_green(p, i, p.F[4][i]);
}
inline LeftCauchyGreen left_cauchy_green(const MaterialPoints<3>& p, int i) {
  const double a = p.F[0][i], b = p.F[1][i], c = p.F[2][i], d = p.F[3][i], e = p.F[4][i], f = p.F[5][i], g = p.F[6][i],
               h = p.F[7][i], k = p.F[8][i];
  return {a * a + b * b + c * c,
          d * d + e * e + f * f,
          g * g + h * h + k * k,
          a * d + b * e + c * f,
          d * g + e * h + f * k,
          a * g + b * h + c * k,
          a * (e * k - f * h) - b * (d * k - f * g) + c * (d * h - e * g)};
}

/// Batch implementation for a law with energy W(b). `Law` is a parameter struct as for PointwiseMaterial, with
///   double density; int option;                                         // UJOption
///   double wave_modulus() const;                                        // in the reference state
///   template <int Option> Coefficients coefficients(const Invariants&) const;
///   template <int Option> double energy(const Invariants&) const;       // per initial volume
///   template <int Option> double stiffness(const Invariants&, const Triple& b) const;   // upper bound of rho_0 c^2,
///                                                                       // b: ascending principal values of b
/// and, if the stiffness depends on the largest principal value of b only and increases with it,
///   static constexpr bool largest_stretch_decides = true;
template <class Law>
class HyperelasticMaterial final : public Material {
 public:
  explicit HyperelasticMaterial(Law law) : law_(std::move(law)) {}
  void update(const MaterialPoints<2>& points) const override {
    choose([&](auto option) { points.plane_stress ? free_faces<option>(points) : advance<2, option>(points); });
  }
  void update(const MaterialPoints<3>& points) const override {
    choose([&](auto option) { advance<3, option>(points); });
  }
  double density() const override { return law_.density; }
  double wave_modulus() const override { return law_.wave_modulus(); }
  double wave_modulus(const MaterialPoints<2>& points) const override { return stiffest<2>(points); }
  double wave_modulus(const MaterialPoints<3>& points) const override { return stiffest<3>(points); }
  double stored_energy(const MaterialPoints<2>& points) const override { return stored<2>(points); }
  double stored_energy(const MaterialPoints<3>& points) const override { return stored<3>(points); }
  const std::vector<HistoryVariable>& history() const override {
    static const std::vector<HistoryVariable> none;
    return none;
  }

 private:
  // Calls f with the volumetric option as a compile-time constant.
  template <class F>
  void choose(F&& f) const {
    if (law_.option == 0) return f(std::integral_constant<int, 0>{});
    if (law_.option == 1) return f(std::integral_constant<int, 1>{});
    f(std::integral_constant<int, 2>{});
  }

  template <int Dim, int Option>
  void advance(const MaterialPoints<Dim>& points) const {
    std::array<double*, Layout<Dim>::symmetric> s = points.stress;
    const Law law = law_;
    double least = 1;
#pragma omp simd reduction(min : least)
    for (int i = 0; i < points.count; ++i) {
      const LeftCauchyGreen b = left_cauchy_green(points, i);
      const Coefficients c = law.template coefficients<Option>(b.invariants());
      least = std::min(least, b.J);
      s[0][i] = c.c0 + c.c1 * b.xx + c.c2 * (b.xx * b.xx + b.xy * b.xy + b.xz * b.xz);
      s[1][i] = c.c0 + c.c1 * b.yy + c.c2 * (b.xy * b.xy + b.yy * b.yy + b.yz * b.yz);
      s[2][i] = c.c0 + c.c1 * b.zz + c.c2 * (b.xz * b.xz + b.yz * b.yz + b.zz * b.zz);
      s[3][i] = c.c1 * b.xy + c.c2 * (b.xx * b.xy + b.xy * b.yy + b.xz * b.yz);
      if constexpr (Dim == 3) {
        s[4][i] = c.c1 * b.yz + c.c2 * (b.xy * b.xz + b.yy * b.yz + b.yz * b.zz);
        s[5][i] = c.c1 * b.xz + c.c2 * (b.xx * b.xz + b.xy * b.yz + b.xz * b.zz);
      }
    }
    if (!(least > 0))
      throw SimulationError(std::string(Law::name) +
                            ": the deformation gradient of a particle is singular or inverted (det F <= 0)");
  }

  // Plane stress: finds the out-of-plane stretch F_zz for which sigma_zz vanishes.
  template <int Option>
  void free_faces(const MaterialPoints<2>& points) const {
    for (int i = 0; i < points.count; ++i) {
      const double start = points.F[4][i];
      double rate = 0;
      const auto normal_stress = [&](double r) {
        const LeftCauchyGreen b = left_cauchy_green(points, i, start * std::exp(r * points.dt));
        const Coefficients c = law_.template coefficients<Option>(b.invariants());
        return c.c0 + c.c1 * b.zz + c.c2 * b.zz * b.zz;
      };
      rate = out_of_plane_rate(normal_stress, law_.wave_modulus(), points.dt);
      const double stretch = std::exp(rate * points.dt);
      points.L[4][i] = rate;
      points.F[4][i] = start * stretch;
      points.volume[i] *= stretch;
    }
    advance<2, Option>(points);
    for (int i = 0; i < points.count; ++i) points.stress[2][i] = 0;
  }

  template <int Dim>
  double stiffest(const MaterialPoints<Dim>& points) const {
    double most = 0;
    choose([&](auto option) {
      for (int i = 0; i < points.count; ++i) {
        const LeftCauchyGreen b = left_cauchy_green(points, i);
        if constexpr (requires { Law::largest_stretch_decides; }) {
          const double bound = b.bound();
          if (law_.template stiffness<option>(b.invariants(), {bound, bound, bound}) <= most) continue;
        }
        const Triple values = principal(b.xx, b.yy, b.zz, b.xy, b.yz, b.xz).value;
        most = std::max(most, law_.template stiffness<option>(b.invariants(), values));
      }
    });
    return most;
  }

  template <int Dim>
  double stored(const MaterialPoints<Dim>& points) const {
    double sum = 0;
    choose([&](auto option) {
      for (int i = 0; i < points.count; ++i) {
        const LeftCauchyGreen b = left_cauchy_green(points, i);
        sum += points.volume[i] / b.J * law_.template energy<option>(b.invariants());
      }
    });
    return sum;
  }

  Law law_;
};

}  // namespace tribo
