// SPDX-License-Identifier: MIT
/// Materials, and the bodies that consist of them.
#pragma once

#include "base/expression.hpp"
#include "base/statement.hpp"
#include "geometry/region.hpp"
#include "model/cracks.hpp"
#include "model/initial_stress.hpp"

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace tribo {

class Material;
class ContactLaw;
class JointLaw;

/// A named law of the input: a material law, a contact law or a joint law.
struct MaterialSpec {
  std::string name;
  std::string type;  ///< name in the catalogue
  std::shared_ptr<const Material> law;
  std::optional<double> particle_damping;                   ///< [1/time]
  std::array<std::optional<Expression>, 3> rigid_velocity;  ///< rigid materials: prescribed velocity components
  std::array<bool, 3> sets_velocity{};  ///< Rigid: the components of the grid velocity that it prescribes
  bool rigid_contact = false;           ///< rigid material that interacts by contact laws
  int mirrored = 0;  ///< Rigid: velocities are mirrored beyond the face at the low (-1) or high (1) end of its bodies
  bool touches() const { return rigid_contact; }
  Statement statement{};  ///< the input, for provenance and for errors that are found later
  Origin origin{};
  std::shared_ptr<ContactLaw> contact{};  ///< not null: this is a contact law, `law` is null
  std::shared_ptr<JointLaw> joint{};      ///< not null: this is a joint law, `law` and `contact` are null
  double heat_capacity = 0.0;             ///< [energy/(mass temperature)]
  double conductivity = 0.0;              ///< [power/(length temperature)]
  double taylor_quinney = 1.0;            ///< fraction of the dissipated work that becomes heat
  double expansion = 0.0;                 ///< coefficient of linear thermal expansion [1/temperature]
  int share_field_with = -1;              ///< index of the material whose velocity field is shared; -1: none
  bool separate = false;  ///< a contact law acts between its bodies, so that each has a velocity field of its own
  Toughness toughness{};
  Growth growth{};  ///< of cracks in this material
};

/// Initial deformation of a body: x -> x + shift(x), with deformation gradient F. Particles are placed in the
/// undeformed shape.
struct InitialDeformation {
  std::array<std::optional<Expression>, 3> shift;
  std::array<std::array<std::optional<Expression>, 3>, 3> F;
};

/// A shape of a body, or a hole. A particle site belongs to the first piece that contains it.
struct Piece {
  RegionPtr region;
  int material = -1;  ///< index into Model::materials; -1: hole
  Vec3 velocity = Vec3::Zero();
  std::array<std::optional<Expression>, 3> velocity_function;
  std::optional<double> temperature;
  std::optional<double> thickness;
  std::array<int, 3> points_per_axis{0, 0, 0};  ///< particles per cell; 0: default of the model
  std::optional<double> point_size;             ///< edge length of a particle domain, instead of points_per_axis
  std::optional<InitialDeformation> deformation;
  StressField stress;        ///< initial Cauchy stress
  std::optional<double> K0;  ///< adds the geostatic stress under gravity with this ratio of horizontal to vertical
  double angle = 0.0;        ///< rotation of the material axes about z
  Origin origin;

  /// Whether its surface is curved: its region is, or its initial deformation is not the same everywhere, so that it
  /// may bend flat faces.
  bool curved() const;
};

/// A body that is given by its particles. Lists have an entry for each particle, or none where it says so.
struct ParticleTable {
  struct History {
    std::string name;  ///< of a history variable of the material
    std::vector<double> values;
  };
  int material = 0;
  std::vector<Vec3> position, velocity;
  std::vector<Vec3> half_size;       ///< half edge lengths of the domains; in the plane the third is half the thickness
  std::vector<double> volume;        ///< in the plane times the thickness; axisymmetric: times the radius, per radian
  std::vector<double> mass;          ///< empty: density times volume
  std::vector<double> temperatures;  ///< empty: `temperature`
  std::vector<std::array<double, 6>> stress;  ///< initial, xx yy zz xy yz xz; empty: none
  std::vector<History> histories;
  std::optional<double> temperature;  ///< of all; unset: the reference temperature
  double angle = 0.0;                 ///< rotation of the material axes about z
  Origin origin, file;
  std::vector<int> lines;  ///< of the file; empty if it has none

  /// `file:line` of a particle, or the file if it has no lines.
  Origin place(std::size_t particle) const { return lines.empty() ? file : Origin{file.file, lines[particle], 1}; }
};

/// A single particle of the input.
struct PointSpec {
  Vec3 position = Vec3::Zero(), velocity = Vec3::Zero();
  int material = 0;
  std::optional<double> mass;
  std::optional<Vec3> half_size;    ///< half edge lengths of its domain
  std::optional<double> thickness;  ///< of its domain, in plane models; unset: that of the grid
  std::optional<double> temperature;
  double angle = 0.0;
  Origin origin;
};

}  // namespace tribo
