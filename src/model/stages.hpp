// SPDX-License-Identifier: MIT
/// Stages within a run.
#pragma once

#include "geometry/region.hpp"
#include "model/blocks.hpp"
#include "model/bodies.hpp"

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace tribo {

struct Model;

/// What a stage does to the present state when it begins.
struct StageAction {
  enum class Kind {
    excavate,  ///< removes particles
    stress,    ///< sets the stress of particles
    bond,      ///< bonds joints that touch
    unbond     ///< breaks the bonds of joints
  } kind = Kind::excavate;
  RegionPtr where;    ///< excavate, stress: the shape
  int material = -1;  ///< excavate, stress: only particles of this material; -1: of all
  StressField stress;
  bool adds = false;  ///< the stress is added to the present one
  /// bond, unbond: criteria of the joints: shape, groups of blocks, orientation and kind of contact.
  std::optional<BlockJoint> joints;
  int law = -1;  ///< bond, unbond: only joints that follow this material, or a law derived from it; -1: all
  Origin origin;
};

/// Particles that a stage places.
struct Placement {
  int stage = 0;  ///< from 1
  std::vector<Piece> pieces;
};

/// An event at which a stage begins before its time, a file is written or the run stops.
struct Reaction {
  enum class What { bond_break, above, below, ratio } what = What::bond_break;
  enum class Effect { stop, frame, checkpoint, next_stage } effect = Effect::stop;
  std::size_t history = 0;  ///< above, below: index into the columns of history.csv without the time
  double value = 0.0;       ///< above, below: in the unit of the history; ratio: of unbalanced to applied forces
  std::string text;         ///< the condition in words
  Origin origin;
};

/// A stage of a run: from its time on the run continues with another model, after actions on the present state.
struct StageSpec {
  double at = 0.0;  ///< latest time of its begin
  std::string name;
  std::shared_ptr<const Model> model;
  std::vector<StageAction> actions;
  std::vector<std::string> changes;  ///< a phrase for each, for `tribo check` and stages.csv
  Origin origin;
};

/// What the models of a run with stages have in common, and the place of a model among them.
struct StagePlace {
  int number = 0;                 ///< 0: the model at the start
  int count = 0;                  ///< number of stages after the first model
  bool loads = false;             ///< a model of the run has forces, tractions or heat fluxes on particles
  bool damps_prescribed = false;  ///< models of the run have particle damping and prescribed velocities
  std::size_t kept = 0;           ///< number of particle conditions at the begin of the list that were there before
  bool conditions = false;        ///< conditions on nodes are other ones than before
};

}  // namespace tribo
