// SPDX-License-Identifier: MIT
/// Return of trial stresses to the Mohr-Coulomb pyramid with a tension cut-off, in principal stress space.
///
/// Tension positive, S1 <= S2 <= S3. Yield planes and their plastic potentials (non-associated, dilation angle psi: the
/// flow uses psi in place of phi, so psi > 0 gives a positive plastic volume strain):
///   F_ij = (1 + sin phi)/2 S_j - (1 - sin phi)/2 S_i - c cos phi <= 0      for ij = 13, 12, 23
///   T_i  = S_i - sigma_t <= 0, associated,           sigma_t = min(tension, c cot phi)
/// The returned stress is S = S_trial - D sum(Lam_a r_a), with Lam >= 0 and the active planes at yield: Koiter (1953);
/// Clausen, Damkilde & Andersen, Int. J. Numer. Meth. Engng 66 (2006) 1795; de Souza Neto, Peric & Owen (2008), ch. 8.
#pragma once

#include "materials/elastic.hpp"
#include "materials/principal.hpp"

namespace tribo {

/// Strength of a point in its present state.
struct Strength {
  double cohesion = 0;  ///< [stress]
  double sin_friction = 0, cos_friction = 1;
  double sin_dilation = 0;
  double tension = 0;  ///< cut-off, at most the apex c cot phi [stress]; infinite if there is neither
};

/// Result of a return: a stress on or inside the pyramid.
struct Returned {
  Triple stress;
  /// Plastic volume strain of the tension planes, the sum of their multipliers. It is unique even at the
  /// intersection of four planes.
  double opening = 0;
};

class Pyramid {
 public:
  Pyramid(const Elasticity& elastic, const Strength& strength)
      : lambda_(elastic.lambda),
        mu_(elastic.mu),
        s_(strength),
        high_(0.5 * (1 + strength.sin_friction)),
        low_(0.5 * (1 - strength.sin_friction)),
        resistance_(strength.cohesion * strength.cos_friction) {}

  const Strength& strength() const { return s_; }
  /// F_13 [stress]; positive: beyond yield.
  double shear_excess(double S1, double S3) const { return high_ * S3 - low_ * S1 - resistance_; }
  double tension_excess(double S3) const { return S3 - s_.tension; }
  bool yields(double S1, double S3) const { return shear_excess(S1, S3) > 0 || tension_excess(S3) > 0; }

  /// The admissible stress that belongs to a sorted trial stress, which is returned unchanged if it is admissible.
  /// `drag` > 0 (Perzyna viscosity over time step [stress]) leaves an overstress on each active plane:
  /// (M + drag I) Lam = f_trial for the planes that are active without viscosity.
  Returned nearest(const Triple& trial, double drag = 0) const {
    const double f = shear_excess(trial[0], trial[2]);
    if (f <= 0 && !(tension_excess(trial[2]) > 0)) return {trial, 0};
    // the face F_13 is by far the most frequent case
    const double sp = s_.sin_dilation, a = mu_ + (lambda_ + mu_) * s_.sin_friction * sp;
    const auto slide = [&](double multiplier) {
      const double spread = lambda_ * sp * multiplier;
      return Triple{trial[0] - spread + mu_ * (1 - sp) * multiplier, trial[1] - spread,
                    trial[2] - spread - mu_ * (1 + sp) * multiplier};
    };
    const Triple S = slide(f / a);
    if (f > 0 && S[0] <= S[1] && S[1] <= S[2] && S[2] <= s_.tension) return {drag > 0 ? slide(f / (a + drag)) : S, 0};
    return corner(trial, drag);
  }

 private:
  // Tries faces, edges and corners. Exactly one admissible stress exists, so the order does not matter.
  Returned corner(const Triple& trial, double drag) const;

  double lambda_, mu_;
  Strength s_;
  double high_, low_, resistance_;  // factors of S3 and S1, and c cos phi
};

}  // namespace tribo
