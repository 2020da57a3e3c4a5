// SPDX-License-Identifier: MIT
/// Fields of the particle files and of the grid files. One table for each serves the reader, the manual and the output:
/// a new field is one entry in output_fields.cpp.
#pragma once

#include "base/types.hpp"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace tribo {

/// What fields of particles are computed from: one particle. What a particle does not have is zero.
class ParticleState {
 public:
  virtual ~ParticleState() = default;
  virtual std::int64_t id() const = 0;
  virtual std::int64_t material_number() const = 0;  ///< in the command file, from 1
  virtual Vec3 velocity() const = 0;                 ///< [velocity]
  virtual Vec3 displacement() const = 0;             ///< since the start               [length]
  virtual double mass() const = 0;                   ///< [mass]
  virtual double volume() const = 0;                 ///< present                       [length^3]
  virtual double density() const = 0;                ///< of the undeformed material    [mass/length^3]
  virtual Mat3 stress() const = 0;                   ///< Cauchy                        [stress]
  virtual Mat3 deformation_gradient() const = 0;     ///< identity if it is not kept
  virtual double stored_energy() const = 0;          ///< [energy]
  virtual double dissipated_energy() const = 0;      ///< [energy]
  virtual double cell_crossings() const = 0;
  virtual double temperature() const = 0;
  virtual double heat_capacity() const = 0;   ///< [energy/(mass temperature)]
  virtual double contact_state() const = 0;   ///< 0 open, 1 stick, 2 slip
  virtual Vec3 contact_traction() const = 0;  ///< [stress]
  virtual Vec3 contact_normal() const = 0;    ///< out of the body
};

/// How a field is computed.
struct ParticleFieldValue {
  std::size_t components = 0;                                       ///< 0: an integer
  void (*numbers)(const ParticleState&, double* values) = nullptr;  ///< fills the components
  std::int64_t (*integer)(const ParticleState&) = nullptr;
  bool history = false;  ///< all history variables of the materials, by their names
};

struct ParticleField {
  std::string_view name;
  std::string_view unit;                     ///< generic, e.g. `velocity`
  std::string_view meaning;                  ///< one phrase
  enum class Standard { no, yes } standard;  ///< written if the command file names no fields
  /// What a model must have so that the field is written; deformation: the particles then keep F.
  enum class Needs { nothing, deformation, heat, contact } needs;
  ParticleFieldValue value;
};

const std::vector<ParticleField>& particle_fields();
/// The entry with this name, in any case, or with an alternative name of NairnMPM (`strainenergy`, `history3`); null if
/// there is none.
const ParticleField* find_particle_field(std::string_view name);
/// The fields that are written if the command file names none.
const std::vector<std::string>& standard_particle_fields();

/// What fields of the grid are computed from: a node with all velocity fields that have mass there.
struct GridNodeState {
  double mass = 0.0;             ///< sum over the fields                                     [mass]
  Vec3 velocity = Vec3::Zero();  ///< momentum of all fields over their mass; 0 without mass  [velocity]
};

struct GridField {
  std::string_view name, unit, meaning;
  std::size_t components;
  void (*value)(const GridNodeState&, double* values);
};

const std::vector<GridField>& grid_fields();
/// The entry of exactly this name, or null.
const GridField* find_grid_field(std::string_view name);

}  // namespace tribo
