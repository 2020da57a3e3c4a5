// SPDX-License-Identifier: MIT
/// Bond of a spring network: normal, shear, twist and bending springs whose strengths may soften, then friction.
///
///   bonded     F_n += k_n A d_n + dF^f_n,  F_s += dF^f_s - k_s A d_s,  M -= K theta
///              dF^f: the increment of the force of the fictitious stress (see poisson_force in joint_geometry.hpp)
///   failure    sigma = F_n/A + beta |M_b| R/I + P > sigma_c  in tension, or in shear
///              tau = |F_s|/A + beta |M_t| R/J > c - (F_n/A + P) tan phi
///   unbonded   N = min(F_n + A P, 0),  |F_s| <= mu |N|,
///              |M_b| <= 2.1 lambda_b |N| R/4,  |M_t| <= 0.65 lambda_t mu |N| R
///
/// Dilation (`sn_dil` > 0) opens an unbonded contact while it slips. If the faces cannot move apart, F_n becomes more
/// compressive by k_n A tan psi |d_s|.
///
/// docs/joints.md gives the reasons for each branch, and the differences from the published description.
#pragma once

#include "contact/joint_parts.hpp"

#include <limits>
#include <optional>

namespace tribo {

struct SpringNetwork final : JointLaw {
  static constexpr std::string_view name = "SpringNetwork";
  static constexpr std::string_view summary =
      "Contact of a spring network, bonded or not, with moments, softening, friction and a correction for Poisson's "
      "ratio.";
  static constexpr int number = 0;
  static constexpr std::string_view example = R"(
<Material Type='SpringNetwork' Name='bond'>
  <kn>1e9</kn>
  <ks>5e8</ks>
  <sn_ten>1e6</sn_ten>
  <sn_coh>3e6</sn_coh>
  <sn_fa>35</sn_fa>
  <fric>0.6</fric>
  <bond>gap 1e-6</bond>
</Material>)";

  double kn = 0, ks = 0, krot_n = 0, krot_s = 0, krot_t = 0;
  bool turns_with_area = false;  ///< the rotational stiffnesses are kn and ks times the moments of the contact area
  UserAreas own_areas;
  double mu = 0, gap_shift = 0, bend_factor = 1, twist_factor = 1, mode = 0, moment_share = 1;
  double tension = 0, tension_length = 0, c = 0, shear_length = 0, c_residual = 0, phi = 0;
  double psi = 0, dilation_zero = std::numeric_limits<double>::infinity(), heals = 0;
  double non_diagonal = 0, nu = 0, constant_pressure = 0, in_equilibrium = 0, radius_factor = 1;
  PressureFunction pressure_function;
  double dashpot_normal = 0, dashpot_shear = 0, dashpot_mode = 0;
  Dashpots dashpots;
  MultiplierTable tension_table, shear_table;
  /// Methods given in the input, which are applied once before the first step.
  struct Methods {
    struct Gaps {
      double low = -std::numeric_limits<double>::infinity(), high = 0.0;
      bool contains(double gap) const { return gap >= low && gap <= high; }
    };
    std::optional<double> modulus;  ///< compute-stiffness; its Poisson's ratio is the law's
    std::optional<Gaps> bond, unbond;
  };
  Methods methods;
  std::vector<double> force, moment;  // at the start: -F_n, F_ss, F_st; M_t, M_bs, M_bt
  double tan_phi = 0, tan_psi = 0;

  static auto parameters();
  static std::vector<OwnProperty> own_properties();
  void prepare(const Statement& s, const Units& units, Problems& problems);

  Joint start(const JointSite& site) const override;
  void update(std::span<Joint> joints, std::span<const JointIncrement> increments,
              std::vector<JointEvent>& events) const override;
  double damping_ratio() const override { return dashpots.largest_ratio(); }
  bool is_bonded(const Joint& j) const override { return j.state >= bonded; }
  void adopt(Joint& joint, const JointLaw& former, const JointSite& site) const override;
  bool bond(Joint& joint) const override;
  bool unbond(Joint& joint) const override;
  std::string state_text(const Joint& j) const override;
  std::vector<std::string_view> own_names() const override;
  std::vector<double> own_values(const Joint& j) const override;
  double pore_pressure(const Vec3& at, double time) const override { return pressure_function.at(at, time); }
  double stiffness() const override { return std::max(kn, ks); }
  bool needs_distance() const override { return methods.modulus.has_value(); }
  double poisson() const override { return nu; }
  double off_diagonal() const override { return non_diagonal; }
  std::span<const double> user_areas() const override { return own_areas.all(); }
  double proximity() const override;
  std::shared_ptr<const JointLaw> with_surface(const SurfaceProperties& surface) const override;
  std::shared_ptr<const JointLaw> for_new_contacts() const override;

 private:
  bool has_pore_pressure() const override { return constant_pressure != 0 || pressure_function.given(); }
  double pressure_in(const Joint& j) const { return constant_pressure + j.pressure; }
  enum State : int { loose = 0, torn = 1, sheared = 2, bonded = 3, softening = 4, unloaded = 5, healed = 6 };
  struct Break {
    int mode = 0;  // 0: none, 1: in tension, 2: in shear
    double strength = 0.0, force = 0.0;
  };

  void read_stiffness(const Statement& s, const Units& units, Problems& problems);

  /// Effective normal stress at the rim of the contact [stress], tension positive.
  double rim_stress(const Joint& j) const;
  /// Shear stress at the rim [stress].
  double rim_shear(const Joint& j) const;
  double shear_strength(const Joint& j) const;
  /// Scales a softening bond back to its strength envelope. Returns true if no tensile strength remains.
  bool soften(Joint& j) const;
  /// Step of a bonded contact: elastic increments, then the strength criteria. Returns the mode of failure, if any.
  Break update_bonded(Joint& j, const JointIncrement& d, double energy_before) const;
  /// Changes a bond that failed in `mode_of_break` to an unbonded contact. The gap without force is chosen so that the
  /// normal force is continuous.
  static void break_bond(Joint& j, int mode_of_break, double overlap_gap);
  /// Step of an unbonded contact. `fresh`: the bond failed in this step, so the forces already include the increments.
  void update_unbonded(Joint& j, const JointIncrement& d, bool fresh, bool slid, double overlap_gap) const;
  void step(Joint& j, const JointIncrement& d, std::size_t contact, std::vector<JointEvent>& events) const;
};

}  // namespace tribo
