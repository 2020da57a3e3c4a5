// SPDX-License-Identifier: MIT
/// Fields of the particle files and of the grid files. One table for each serves the reader, the manual and the output:
/// a new field is one entry in output_fields.cpp.
#pragma once

#include "base/types.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace tribo {

/// A number of each particle, or one that all particles have.
class ParticleColumn {
 public:
  ParticleColumn() = default;  ///< zero
  ParticleColumn(const double* numbers) : at_(numbers), stride_(1) {}
  double operator[](std::size_t particle) const { return at_[stride_ * particle]; }

 private:
  static constexpr double zero = 0.0;
  const double* at_ = &zero;
  std::size_t stride_ = 0;
};

/// What fields of particles are computed from: the particles of a body. What they do not have is zero.
class ParticleStates {
 public:
  virtual ~ParticleStates() = default;

  const std::int64_t* id = nullptr;
  std::int64_t material_number = 0;                              ///< in the command file, from 1
  std::array<ParticleColumn, 3> velocity;                        ///< [velocity]
  std::array<ParticleColumn, 3> position;                        ///< [length]
  std::array<ParticleColumn, 3> origin;                          ///< position at the start            [length]
  ParticleColumn mass;                                           ///< [mass]
  ParticleColumn volume;                                         ///< present                          [length^3]
  double density = 0.0;                                          ///< of the undeformed material       [mass/length^3]
  std::array<ParticleColumn, 6> stress;                          ///< Cauchy; xx yy zz xy yz xz        [stress]
  std::array<ParticleColumn, 9> deformation;                     ///< deformation gradient F, row by row
  bool has_deformation = false;                                  ///< otherwise F counts as the identity
  ParticleColumn cell_crossings;                                 ///< number of times it has moved to another cell
  ParticleColumn temperature;                                    ///< [temperature]
  double heat_capacity = 0.0;                                    ///< [energy/(mass temperature)]
  virtual double stored_energy(std::size_t particle) const = 0;  ///< [energy]
  virtual double dissipated_energy(std::size_t particle) const = 0;  ///< [energy]
  virtual double contact_state(std::size_t particle) const = 0;      ///< 0 open, 1 stick, 2 slip
  virtual Vec3 contact_traction(std::size_t particle) const = 0;     ///< [stress]
  virtual Vec3 contact_normal(std::size_t particle) const = 0;       ///< out of the body
};

/// Particles of a body in the order of a file: `order[begin]` to `order[end - 1]`, or `begin` to `end - 1` if `order`
/// is null.
struct ParticleOrder {
  const std::uint32_t* order;
  std::size_t begin, end;
  std::size_t count() const { return end - begin; }
  std::size_t particle(std::size_t i) const { return order ? order[i] : i; }
};

/// How a field is computed.
struct ParticleFieldValue {
  std::size_t components = 0;  ///< 0: an integer
  /// Fills the components of particles, one particle after the other.
  void (*numbers)(const ParticleStates&, const ParticleOrder&, double* values) = nullptr;
  void (*integers)(const ParticleStates&, const ParticleOrder&, std::int64_t* values) = nullptr;
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
