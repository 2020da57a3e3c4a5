// SPDX-License-Identifier: MIT
/// Joints: surfaces that remember. Laws of rock joints and of bonds between blocks, one code for every host: cracks and
/// interfaces in the grid, faces of rigid blocks, a point that is driven along a path.
///
/// Conventions. A contact has the ends 1 and 2; n is the unit normal from 1 to 2, and n, s, t with n x s = t are its
/// axes. "Relative" is always 2 minus 1: an opening is positive. Normal forces are positive in tension. The vector
/// force on body 2 is -Fn n + Fs, the moment Mt n + Mb; body 1 gets the opposite. A pressure of pore fluid is positive
/// and pushes the faces apart: the effective normal force is Fn + A P. In two dimensions s points out of the plane, so
/// that shear has its t component only and rotation its s component.
#pragma once

#include "base/catalogue.hpp"
#include "contact/tangent.hpp"

#include <array>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace tribo {

/// What two faces did in one step, in the axes of the contact, which move with it.
struct JointIncrement {
  double normal = 0.0;      ///< opening                                               [length]
  Tangent shear;            ///< along s and t                                         [length]
  double twist = 0.0;       ///< relative rotation about n                             [rad]
  Tangent bend;             ///< about s and t                                         [rad]
  double gap = 0.0;         ///< between the faces at the end of the step              [length]
  double dt = 1.0;          ///< step                                                  [time]
  double mass = 0.0;        ///< m1 m2/(m1 + m2), for dashpots                         [mass]
  double poisson_normal{};  ///< force of the fictitious stress that belongs to the end of the step [force]
  Tangent poisson_shear;
};

/// One contact: what it is, what it carries, what it remembers. A law writes it, a host stores, moves and archives it.
/// Plain numbers throughout, so that it is copied and saved as it is.
struct Joint {
  // What it is; set by JointLaw::start
  double area = 0.0;                                ///< A                                         [length^2]
  double kn = 0.0, ks = 0.0;                        ///< stiffness per area                        [stress/length]
  double twist_stiffness = 0.0;                     ///< about n                                   [force length]
  std::array<double, 3> bend_stiffness{};           ///< K_ss, K_tt, K_st                          [force length]
  double radius = 0.0, inertia = 0.0, polar = 0.0;  ///< R, I, J of the disc or strip that strengths are taken on

  // What it carries
  double Fn = 0.0;  ///< elastic, positive in tension                                   [force]
  Tangent Fs;       ///< elastic, on body 2                                             [force]
  double Mt = 0.0;  ///< twist, on body 2                                               [force length]
  Tangent Mb;       ///< bending, on body 2                                             [force length]
  double dashpot_normal = 0.0;
  Tangent dashpot_shear;
  double poisson_normal = 0.0;  ///< the part of Fn and Fs that is the fictitious stress
  Tangent poisson_shear;

  // What it remembers
  double opening = 0.0;     ///< all normal increments                                  [length]
  Tangent shear;            ///< all shear increments                                   [length]
  double gap = 0.0;         ///< at the end of the last step                            [length]
  double rest_gap = 0.0;    ///< gap without force: of a joint that failed, and moved by dilation
  double slip = 0.0;        ///< way slid since sliding began, or since the bond broke in shear [length]
  double elongation = 0.0;  ///< largest one after the peak                             [length]
  double onset = 0.0;       ///< strain energy when the strength was first exceeded     [energy]
  int state = 0;            ///< as the law numbers its states
  bool slips = false, bends = false, twists = false;  ///< now
  bool shear_weak = false;                            ///< cohesion and friction are residual
  bool torn = false;                                  ///< shear strength was lost by tension
  bool away = false;                                  ///< the faces are apart, no force acts

  // Energies
  double strain = 0.0;  ///< stored, >= 0
  double slid = 0.0;    ///< by friction, sum, <= 0
  double damped = 0.0;  ///< by dashpots, sum, <= 0
  double work = 0.0;    ///< done on the joint by the motion of its faces, sum
  double start = 0.0;   ///< stored before the first step
  /// What neither storage, friction nor dashpots account for: brittle drops of strength, dilation, changes of pressure.
  double released() const { return work - (strain - start) + slid + damped; }
};

/// Something that happened to a contact in a step.
struct JointEvent {
  enum class Kind { slip_change, bond_break, activated } kind = Kind::slip_change;
  std::size_t contact = 0;  ///< which of the batch
  int mode = 0;             ///< bond_break: 1 tension, 2 shear; slip_change: 1 shear, 2 bend, 3 twist, 4 s+b, 5 s+t,
                            ///< 6 b+t, 7 all of which changed
  bool shear = false, twist = false, bend = false;  ///< slip_change: what slides now
  double strength = 0.0;                            ///< bond_break                     [stress]
  double energy = 0.0;                              ///< bond_break: stored when the strength was first exceeded
  /// `slip_change`, ...
  std::string_view name() const;
};

/// A contact before its first step, as its host knows it.
struct JointSite {
  double area = 0.0;                ///<                                                   [length^2]
  double gap = 0.0;                 ///<                                                   [length]
  double distance = 0.0;            ///< between the reference points of the bodies; 0: the host has none [length]
  bool plane = true;                ///< two dimensions
  double thickness = 1.0;           ///< of two dimensions                                 [length]
  double radius = 0.0;              ///< of a ball; 0: from the area                       [length]
  std::array<double, 3> moments{};  ///< I_s, I_t, I_st of a face; ignored with `radius`   [length^4]
  bool has_moments = false;         ///< else they are those of the disc or strip
  double poisson_normal = 0.0;      ///< force of the fictitious stress there already      [force]
  Tangent poisson_shear;
};

class JointLaw {
 public:
  virtual ~JointLaw() = default;

  /// A contact as it is before the first step.
  virtual Joint start(const JointSite& site) const = 0;
  /// One step of every contact; what happened is appended to `events`. A function of its arguments only.
  virtual void update(std::span<Joint> joints, std::span<const JointIncrement> increments,
                      std::vector<JointEvent>& events) const = 0;
  /// Whether a bond holds the faces together.
  virtual bool is_bonded(const Joint&) const { return false; }
  /// The state in words.
  virtual std::string state_text(const Joint& joint) const = 0;
  /// Numbers that only this law has, for output.
  virtual std::vector<std::string_view> own_names() const = 0;
  virtual std::vector<double> own_values(const Joint& joint) const = 0;

  /// Largest stiffness per area, for checks of the step; 0 if it depends on the contact.
  virtual double stiffness() const = 0;
  /// The law needs JointSite::distance.
  virtual bool needs_distance() const { return false; }
  /// Fictitious stress: Poisson's ratio, and the factor of its off-diagonal part.
  virtual double poisson() const { return 0.0; }
  virtual double off_diagonal() const { return 0.0; }
  /// Area instead of the host's; 0: none.
  virtual double user_area() const = 0;
};

/// The state of a joint; the version covers its tangents, too.
void archive(Archive& a, Joint& joint);

/// All joint laws; generated from contact/CMakeLists.txt.
const Catalogue<JointLaw>& joint_laws();

}  // namespace tribo
