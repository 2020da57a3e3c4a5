// SPDX-License-Identifier: MIT
/// What a run writes.
#pragma once

#include "base/statement.hpp"
#include "base/types.hpp"

#include <algorithm>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace tribo {

/// One column of history.csv.
struct HistoryQuantity {
  std::string name;           ///< as in the input, e.g. `velx`, `Kinetic Energy`
  std::string column;         ///< column head, e.g. `velx:Disk 1`
  int material = -1;          ///< -1: all materials
  int condition_id = 0;       ///< reactions: id of a node condition, 0: none
  int other = -1;             ///< contact: only contact with this material; -1: with all
  int variable = -1;          ///< histories of a history variable: its index in the law
  std::optional<Vec3> point;  ///< value of the particle whose initial position is nearest to this point
  Origin origin;
};

/// Id of a symmetry plane in reaction histories: -10 and -11 at the low and high end of x, -20 and -21 of y, ...
constexpr int symmetry_plane_id(int axis, int side) { return -10 * (axis + 1) - side; }

struct OutputSpec {
  /// Output times: `start`, then every `interval` until the start of the next group.
  struct Group {
    double start = 0.0, interval = 0.0;
    int max_contact_steps = 0;
  };
  std::vector<Group> archive;
  double history_interval = 0.0;  ///< 0: as for the particle files
  std::vector<HistoryQuantity> history;
  std::vector<std::string> particle_fields;  ///< empty: the standard set
  bool double_precision = false;             ///< of the fields of particle files; positions always have it
  std::vector<std::string> grid_fields;      ///< for the .vti files; empty: none are written
  double checkpoint_interval = 0.0;          ///< simulated time; 0: only when the run is stopped

  bool has_field(std::string_view name) const {
    return std::find(particle_fields.begin(), particle_fields.end(), name) != particle_fields.end();
  }
  /// Whether a history is an average strain.
  bool wants_strain() const;
  /// Whether a history is an elastic or plastic share of a strain.
  bool wants_elastic_strain() const;
  /// Whether a field or a history needs the deformation gradient.
  bool wants_deformation() const;
};

}  // namespace tribo
