// SPDX-License-Identifier: MIT
/// The model: complete description of a run in consistent units. The readers in input/ fill it, the solver uses it.
///
/// Angles are in radians. Vectors always have three components; those without a meaning are 0. Coordinates are global.
#pragma once

#include "base/statement.hpp"
#include "base/units.hpp"
#include "model/blocks.hpp"
#include "model/bodies.hpp"
#include "model/conditions.hpp"
#include "model/contact_spec.hpp"
#include "model/cracks.hpp"
#include "model/heat.hpp"
#include "model/output_spec.hpp"
#include "model/scheme.hpp"
#include "model/stages.hpp"
#include "model/tasks.hpp"

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace tribo {

struct Model {
  std::string file;                             ///< the command file
  std::string source;                           ///< its text
  std::string meaning;                          ///< the statements that it means, as a command file in XML
  std::vector<std::string> data_files;          ///< further files that it reads, from the folder of the command file
  std::map<std::string, std::string> settings;  ///< variables of a script that were set on the command line
  std::string title;
  Analysis analysis = Analysis::plane_strain;
  Units units;
  unsigned random_seed = 1;

  Scheme scheme;
  TimeControl time;
  GridSpec grid;
  int points_per_cell = 0;       ///< particles per cell; 0: the default, 4 in two dimensions and 8 in three
  bool whole_particles = false;  ///< the surfaces of shapes do not cut the cells of particles
  std::optional<SplittingSpec> splitting;
  std::vector<MaterialSpec> materials;
  std::vector<Piece> pieces;
  std::vector<PointSpec> points;
  std::vector<ParticleTable> tables;
  std::vector<NodeCondition> node_conditions;
  std::vector<ParticleCondition> particle_conditions;
  std::vector<TemperatureCondition> temperature_conditions;
  BodyForce body_force;
  StrengthReduction strength_reduction;
  Damping damping;
  ContactSpec contact;
  std::vector<CrackSpec> cracks;
  std::shared_ptr<const BlocksSpec> blocks;  ///< rigid blocks, with or without a grid; null: none
  std::optional<FractureSpec> fracture;
  HeatSpec heat;
  OutputSpec output;
  std::optional<LoadReversal> reversal;
  std::optional<LoadControl> load_control;
  StagePlace stage;
  std::vector<StageSpec> stages;      ///< of the model at the start, in the order of time
  std::vector<Placement> placements;  ///< particles placed by stages; the same in all models of a run
  std::vector<Reaction> reactions;    ///< in force until the next stage
  /// Number of particles that may be put back into the grid after leaving it before the run stops; unset: the first
  /// particle that leaves stops the run.
  std::optional<long> leave_limit;
  bool delete_leaving = false;  ///< particles that leave are removed, up to this number
  std::vector<DeletionSpec> deletions;
  std::vector<SourceSpec> sources;
  /// Whether particles may come or go during the run.
  bool particles_change() const { return stage.count > 0 || delete_leaving || !deletions.empty() || !sources.empty(); }
  /// Whether the velocities of particles are damped, by a constant or a feedback of the model or of a material.
  bool damps_particles() const;
  /// Whether the bodies shall come to rest: with damping of the whole model, or in stages.
  bool seeks_equilibrium() const;
  /// Whether the model consists of rigid blocks only, without grid and particles.
  bool only_blocks() const { return blocks && !blocks->in_grid; }
  std::vector<std::string> warnings;  ///< each `file:line:col: warning: ...`

  int dimension() const { return analysis == Analysis::solid ? 3 : 2; }
};

}  // namespace tribo
