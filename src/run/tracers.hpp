// SPDX-License-Identifier: MIT
/// The particles that histories of a point follow.
#pragma once

#include "model/model.hpp"
#include "solver/measures.hpp"

#include <cstdint>
#include <vector>

namespace tribo {

template <int Dim>
class Tracers {
 public:
  /// Finds for every history of a point the particle that started nearest to it; among equally near ones the one
  /// with the lowest id. Throws InputError at a history whose point has no particle within a cell.
  Tracers(const Model& model, System<Dim>& system);
  /// Measures of the particle of history `k`, which must be a history of a point.
  Measures measure(System<Dim>& system, std::size_t k, bool strain) const;

 private:
  struct Tracer {
    std::size_t body = 0;
    std::int64_t id = -1;  ///< -1: no history of a point
  };
  std::vector<Tracer> tracers_;  ///< per history
};

}  // namespace tribo
