// SPDX-License-Identifier: MIT
/// Cohesive zones: the part of the traction laws that does not depend on the shape of their curves.
///
/// A zone keeps the damage of opening (mode I) and of sliding (mode II). T = (1 - D) k d in each mode, so that it
/// unloads to the origin and reloads along the same line. Closed faces press on each other with a constant stiffness.
///
///   separate modes   D_I and D_II follow from the largest opening and the largest sliding. The zone fails once
///                    (G_I/J_Ic)^n + (G_II/J_IIc)^n = 1, where G is the area under the curve up to this largest
///                    displacement; without n, once one of the modes has lost its traction
///   one damage D     grows while (d_n/d_I(D))^2 + (d_t/d_II(D))^2 > 1, where d_I(D), d_II(D) are the displacements
///                    at which the curves have the damage D; fails at D = 1
///
/// With the same curve in both modes the second form is a curve of the effective displacement sqrt(d_n^2 + d_t^2).
#pragma once

#include "contact/joint_law.hpp"
#include "contact/traction_curve.hpp"

namespace tribo {

/// A cohesive zone with a curve for each mode.
class CohesiveLaw : public JointLaw {
 public:
  /// States of a zone.
  enum State { intact = 0, softening = 1, broken = 2 };

  Joint start(const JointSite& site) const override;
  void update(std::span<Joint> joints, std::span<const JointIncrement> increments,
              std::vector<JointEvent>& events) const override;
  bool is_bonded(const Joint& joint) const override { return joint.state != broken; }
  std::string state_text(const Joint& joint) const override;
  std::vector<std::string_view> own_names() const override { return {"damage_normal", "damage_shear", "GI", "GII"}; }
  std::vector<double> own_values(const Joint& joint) const override;
  double stiffness() const override;

  /// The curve of opening (0) or sliding (1).
  const TractionCurve& curve(std::size_t mode) const { return *curves_[mode]; }

 protected:
  SharedCurve curves_[2];
  bool one_damage_ = false;
  double exponent_ = 1.0;  ///< n; not positive: the modes fail one by one
  double closed_ = 0.0;    ///< stiffness of closed faces [stress/length]

 private:
  struct Jump;
  void grow_separately(Joint& joint, const Jump& from, const Jump& to) const;
  void grow_together(Joint& joint, const Jump& to) const;
  double failure(const std::array<double, 2>& largest) const;
};

}  // namespace tribo
