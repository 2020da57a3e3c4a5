// SPDX-License-Identifier: MIT
/// Joint laws: contact laws with history, for rock joints and for bonds between blocks. The same code serves every
/// host: cracks and material interfaces in the grid, faces of rigid blocks, and a single point driven along a path.
///
/// Sign conventions. A contact lies between body 1 and body 2. n is the unit normal from 1 to 2; n, s, t with n x s = t
/// are the contact axes. Relative motion is that of 2 minus that of 1, so opening is positive. Normal forces are
/// positive in tension. The force vector on body 2 is -Fn n + Fs, the moment Mt n + Mb; body 1 receives the opposite.
/// Shear forces are therefore restoring forces: a shear displacement of body 2 along +t gives a negative Fs.t.
/// Pore pressure is positive and pushes the faces apart: the effective normal force is Fn + A P. In two dimensions s
/// points out of the plane, so shear has only a t component and bending only an s component.
#pragma once

#include "base/catalogue.hpp"
#include "base/types.hpp"
#include "contact/tangent.hpp"

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace tribo {

/// Relative motion of the two faces in one step, in the contact axes, which move with the contact.
struct JointIncrement {
  double normal = 0.0;      ///< opening                                               [length]
  Tangent shear;            ///< along s and t                                         [length]
  double twist = 0.0;       ///< relative rotation about n                             [rad]
  Tangent bend;             ///< about s and t                                         [rad]
  double gap = 0.0;         ///< between the faces at the end of the step              [length]
  double dt = 1.0;          ///< time step                                                  [time]
  double time = 0.0;        ///< at the end of the step                                     [time]
  double mass = 0.0;        ///< m1 m2/(m1 + m2), for dashpots                         [mass]
  double pressure = 0.0;    ///< at the end of the step, of pore fluid: JointLaw::pore_pressure  [stress]
  double poisson_normal{};  ///< force of the fictitious stress that belongs to the end of the step [force]
  Tangent poisson_shear;
};

/// One contact: geometry and stiffness, forces, history and energies. A law updates it; the host stores it, moves it
/// with the bodies and saves it. All members are plain numbers, so a contact can be copied and saved as it is.
struct Joint {
  // Geometry and stiffness, set by JointLaw::start
  double area = 0.0;                                ///< A                                         [length^2]
  double kn = 0.0, ks = 0.0;                        ///< stiffness per area                        [stress/length]
  double twist_stiffness = 0.0;                     ///< about n                                   [force length]
  std::array<double, 3> bend_stiffness{};           ///< K_ss, K_tt, K_st                          [force length]
  double radius = 0.0, inertia = 0.0, polar = 0.0;  ///< R, I, J of the equivalent disc (2D: strip) of the strength
                                                    ///< criteria

  // Forces
  double Fn = 0.0;  ///< elastic, positive in tension                                   [force]
  Tangent Fs;       ///< elastic, on body 2                                             [force]
  double Mt = 0.0;  ///< twist, on body 2                                               [force length]
  Tangent Mb;       ///< bending, on body 2                                             [force length]
  double dashpot_normal = 0.0;
  Tangent dashpot_shear;
  double poisson_normal = 0.0;  ///< share of Fn and Fs due to the fictitious stress
  Tangent poisson_shear;

  // History
  double opening = 0.0;     ///< sum of the normal increments                           [length]
  Tangent shear;            ///< sum of the shear increments                            [length]
  double gap = 0.0;         ///< at the end of the last step                            [length]
  double pressure = 0.0;    ///< JointIncrement::pressure of the last step              [stress]
  double rest_gap = 0.0;    ///< gap at zero normal force after failure, shifted by dilation [length]
  double slip = 0.0;        ///< slip path since sliding began, or since the bond broke in shear [length]
  double elongation = 0.0;  ///< largest elongation beyond the tensile peak             [length]
  double onset = 0.0;       ///< strain energy when the strength was first exceeded     [energy]
  int state = 0;            ///< state number, defined by the law
  bool slips = false, bends = false, twists = false;  ///< shear, bending or twist is at its frictional limit
  bool shear_weak = false;                            ///< cohesion and friction have residual values
  bool torn = false;                                  ///< the joint has failed in tension
  bool away = false;                                  ///< the faces are separated and exert no force

  // History of a cohesive zone: opening, sliding
  std::array<double, 2> largest{};     ///< largest displacement; one damage for both: shares of the modes [length]
  std::array<double, 2> damage{};      ///< loss of stiffness, 0 to 1
  std::array<double, 2> decohesion{};  ///< dissipated by the modes                            [energy/area]

  // Energies
  double strain = 0.0;  ///< stored energy, >= 0
  double slid = 0.0;    ///< cumulative work of friction, <= 0
  double damped = 0.0;  ///< cumulative work of the dashpots, <= 0
  double work = 0.0;    ///< cumulative work done on the joint by the motion of its faces
  double start = 0.0;   ///< stored energy before the first step
  /// Remainder of the energy balance: brittle drops of strength, dilation and changes of pressure.
  double released() const { return work - (strain - start) + slid + damped; }
};

/// A change of state of a contact within a step.
struct JointEvent {
  enum class Kind { slip_change, bond_break, activated } kind = Kind::slip_change;
  std::size_t contact = 0;  ///< index within the batch
  int mode = 0;             ///< bond_break: 1 tension, 2 shear; slip_change: the modes that changed, 1 shear, 2 bend,
                            ///< 3 twist, 4 shear and bend, 5 shear and twist, 6 bend and twist, 7 all
  bool shear = false, twist = false, bend = false;  ///< slip_change: the modes that slide now
  double strength = 0.0;  ///< bond_break: the strength that was exceeded, of this step [stress]
  double energy = 0.0;    ///< bond_break: strain energy when the strength was first exceeded [energy]
  double force = 0.0;     ///< bond_break: force at failure, Fn in tension, |Fs| in shear    [force]
  /// Name in `events.csv`, for example `slip_change`.
  std::string_view name() const;
};

/// A contact before its first step, as described by its host.
struct JointSite {
  double area = 0.0;                ///<                                                   [length^2]
  double gap = 0.0;                 ///<                                                   [length]
  double distance = 0.0;            ///< between the reference points of the bodies; 0: not known [length]
  bool plane = true;                ///< two dimensions
  double thickness = 1.0;           ///< out of plane, in two dimensions                   [length]
  double radius = 0.0;              ///< of a ball, which determines the area; 0: from the area [length]
  std::size_t number = 0;           ///< of the contact on its surface
  bool part_of_face = false;        ///< one of several contacts of a face, which resist its rotation together
  std::array<double, 3> moments{};  ///< I_s, I_t, I_st of the face; ignored if `radius` > 0 [length^4]
  bool has_moments = false;         ///< false: the moments are those of the disc or strip of the same area
  double poisson_normal = 0.0;      ///< initial force of the fictitious stress            [force]
  Tangent poisson_shear;
  double pressure = 0.0;  ///< of pore fluid: JointLaw::pore_pressure            [stress]
};

/// Properties of the surfaces of two bodies, which a contact between them takes over; each if it is given.
struct SurfaceProperties {
  std::optional<double> kn, ks;    ///< stiffness per area       [stress/length]
  std::optional<double> friction;  ///< coefficient
  bool given() const { return kn || ks || friction; }
  /// Those of a contact: the springs of both sides in series, and the smaller friction. What one side lacks is not
  /// given.
  static SurfaceProperties between(const SurfaceProperties& a, const SurfaceProperties& b);
};

/// Interface of all joint laws. A law holds parameters only; the state of each contact is in `Joint`.
class JointLaw {
 public:
  virtual ~JointLaw() = default;

  /// The initial state of a contact.
  virtual Joint start(const JointSite& site) const = 0;
  /// Advances every contact by one step and appends changes of state to `events`. `joints` and `increments` have the
  /// same size. The result depends on the arguments only.
  virtual void update(std::span<Joint> joints, std::span<const JointIncrement> increments,
                      std::vector<JointEvent>& events) const = 0;
  /// Whether the faces are bonded.
  virtual bool is_bonded(const Joint&) const { return false; }
  /// Takes over a contact that obeyed `former`, a law of the same type with other properties: its stiffnesses become
  /// those of this law, and its area the one that this law may give, while its forces stay as they are. The change of
  /// the stored energy is not counted as released. Of `site` only the number, the distance (0: not known), the kind of
  /// model and `part_of_face` are used.
  virtual void adopt(Joint&, const JointLaw& former, const JointSite& site) const { (void)former, (void)site; }
  /// Bonds a contact whose faces touch, or breaks its bond, without a change of its compressive force. False if the
  /// contact does not change: it is open or bonded already, or the law has no bonds.
  virtual bool bond(Joint&) const { return false; }
  virtual bool unbond(Joint&) const { return false; }
  /// The state in words, for output.
  virtual std::string state_text(const Joint& joint) const = 0;
  /// Names and values of output quantities that only this law has.
  virtual std::vector<std::string_view> own_names() const = 0;
  virtual std::vector<double> own_values(const Joint& joint) const = 0;

  /// Pore pressure at a place and a time, in addition to a constant one that the law has by itself [stress]; a host
  /// puts it into JointSite::pressure and JointIncrement::pressure.
  virtual double pore_pressure(const Vec3& at, double time) const { return (void)at, (void)time, 0.0; }

  /// Whether a pore pressure acts in its contacts.
  virtual bool has_pore_pressure() const { return false; }

  /// Largest stiffness per area [stress/length], used to check the time step; 0 if it depends on the contact.
  virtual double stiffness() const = 0;
  /// The larger one of the two damping ratios of its dashpots, for the time step; 0 without dashpots.
  virtual double damping_ratio() const { return 0.0; }
  /// Whether the law needs JointSite::distance.
  virtual bool needs_distance() const { return false; }
  /// Fictitious stress: Poisson's ratio nu, and the factor `off_diagonal` of its shear components (poisson_force).
  virtual double poisson() const { return 0.0; }
  virtual double off_diagonal() const { return 0.0; }
  /// Areas that replace those found by the host [length^2]: one for all contacts, or one for each contact of a surface
  /// in the order of JointSite::number; empty: none.
  virtual std::span<const double> user_areas() const { return {}; }
  /// The largest gap at which a contact is bonded at the start, or at which its faces count as closed [length].
  virtual double proximity() const { return 0.0; }
  /// This law with given surface properties in place of its own; null: it has no such properties.
  virtual std::shared_ptr<const JointLaw> with_surface(const SurfaceProperties&) const { return nullptr; }
  /// The law of a contact that forms during the run between faces that follow this law: it has no bond, and its force
  /// follows from the gap alone. Null: there is none.
  virtual std::shared_ptr<const JointLaw> for_new_contacts() const { return nullptr; }
};

/// The state of a joint; the version covers its tangents, too.
void archive(Archive& a, Joint& joint);

/// All joint laws; generated from contact/CMakeLists.txt.
const Catalogue<JointLaw>& joint_laws();
/// The same list, to which a program may add laws of its own.
Catalogue<JointLaw>& extensible_joint_laws();

}  // namespace tribo
