// SPDX-License-Identifier: MIT
/// One law at one point along a prescribed path, as in a laboratory test.
#pragma once

#include "contact/contact_law.hpp"
#include "contact/joint_law.hpp"
#include "drive/path.hpp"
#include "materials/material.hpp"

#include <memory>
#include <string>
#include <vector>

namespace tribo {

/// A bulk law along a path of velocity gradients and stresses.
struct MaterialDrive {
  std::shared_ptr<const Material> law;
  Mat3 initial_stress = Mat3::Zero();  ///< [stress]
  Origin initial_stress_origin;        ///< place of the stress in the command file
  double angle = 0.0;                  ///< of the material axes about z [rad]
  double cell = 1.0;                   ///< cell size for the law [length]
  /// Initial temperature, for which the properties hold; a column of the table if the law depends on it or work heats
  /// the material [temperature]
  double temperature = 0.0, reference_temperature = 0.0;
  /// Of the dissipated work, Taylor-Quinney share over density and heat capacity; 0: none heats [temperature/stress]
  double warmed_by_work = 0.0;
  std::vector<PathRow> path;  ///< of the columns below
};
/// Lxx .. Lzz row by row [1/time], then prescribed stresses sxx syy szz sxy syz sxz [stress].
std::vector<PathColumn> material_columns(double rate_factor = 1.0, double stress_factor = 1.0);

/// A contact law between two faces of unit area. Normal and the two tangents are axes of their own; velocities are
/// those of face b relative to face a at the end of a step, vn > 0 opens; N > 0 presses, and St is the traction on a,
/// along vt where faces slide.
struct ContactDrive {
  std::shared_ptr<const ContactLaw> law;
  double mass = 1.0;          ///< reduced mass per area of the faces             [mass/length^2]
  double gap = 0.0;           ///< at the start                                   [length]
  double cell = 1.0;          ///< cell size for the law                          [length]
  std::vector<PathRow> path;  ///< of the columns below
};
/// vn vt1 vt2 [velocity], N St1 St2 [stress].
std::vector<PathColumn> contact_columns(double velocity_factor = 1.0, double stress_factor = 1.0);

/// A joint law at one contact between a fixed body 1 and a body 2.
///
/// Without springs and mass the path is the motion of body 2. With springs the path moves their far ends, and body 2
/// is in equilibrium between spring and joint: a testing machine of finite stiffness. With a mass body 2 has inertia.
struct JointDrive {
  std::shared_ptr<const JointLaw> law;
  JointSite site;
  double dashpot_mass = 0.0;         ///< effective mass for dashpots                    [mass]
  double mass = 0.0;                 ///< of body 2; 0: none                              [mass]
  double spring_normal = 0.0;        ///< of the machine; initially it carries the force of the joint [force/length]
  double spring_shear = 0.0;         ///<                                                 [force/length]
  std::array<double, 3> velocity{};  ///< of body 2 at the start: n, s, t                 [velocity]
  Origin origin;                     ///< of the element, for messages
  std::vector<PathRow> path;         ///< of the columns below
};
/// Per step: dn dss dst [length], dtwist dbs dbt [rad]; prescribed at the end of the row: Fn Fss Fst [force]; loads on
/// body 2: Pn Pss Pst [force]; force of the fictitious stress: Ffn Ffss Ffst [force]. Of the end of the row, reached
/// linearly: pressure [stress], the pore pressure in addition to that of the law.
std::vector<PathColumn> joint_columns(double length_factor = 1.0, double force_factor = 1.0,
                                      double stress_factor = 1.0);

/// The results: one row per step; the first row is the initial state.
struct Table {
  std::vector<std::string> names;
  std::vector<std::vector<double>> rows;
  /// Comma-separated, numbers in the shortest form that reads back to the same bits. Throws SimulationError with row
  /// and column if one of them is not finite.
  std::string text() const;
};

/// Runs a path. Where a row prescribes a stress (or, of a joint, a force), the rate of that component is found so that
/// the stress at the end of every step lies on the straight line from the row's start to the prescribed value, to 1e-10
/// of the stresses there. Rates without a number in the row are 0; those of a prescribed shear stress are equal
/// unless the row has one. Throws InputError for rows that contradict themselves, SimulationError if no rate leads to
/// a prescribed stress.
Table drive(const MaterialDrive& what);
Table drive(const ContactDrive& what);
Table drive(const JointDrive& what);

}  // namespace tribo
