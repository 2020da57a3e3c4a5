// SPDX-License-Identifier: MIT
/// How far particles moved in a step.
#pragma once

#include "base/ranks.hpp"
#include "solver/state/system.hpp"

#include <algorithm>
#include <vector>

namespace tribo {

/// The largest displacements of particles along an axis in a step [cells].
struct Travel {
  double largest = 0.0;           ///< of all particles
  std::vector<double> of_fields;  ///< of the particles of each velocity field, by the fields of the bodies

  /// Begins a step of a system with so many velocity fields.
  void begin(std::size_t fields) { largest = 0.0, of_fields.assign(fields, 0.0); }
  /// Includes the largest displacement of a particle of a body [cells].
  template <int Dim>
  void include(const Body<Dim>& body, double cells) {
    largest = std::max(largest, cells);
    if (body.field < of_fields.size()) of_fields[body.field] = std::max(of_fields[body.field], cells);
  }
  /// Includes the particles of other processes; all must call it together.
  void include_ranks() {
    of_fields.push_back(largest);
    ranks().largest(of_fields);
    largest = of_fields.back();
    of_fields.pop_back();
  }
};

}  // namespace tribo
