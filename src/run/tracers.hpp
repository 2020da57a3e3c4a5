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
  /// Finds for every history of a point the particle that started nearest to it; of equally near ones that with the
  /// lowest id. Throws InputError at a history whose point has no particle within a cell.
  Tracers(const Model& model, System<Dim>& system);
  /// Of the particle of history `k`; of no use if that has no point.
  Measures measure(System<Dim>& system, std::size_t k, bool strain) const;

 private:
  struct Tracer {
    std::size_t body = 0;
    std::int64_t id = -1;  ///< -1: no history of a point
  };
  std::vector<Tracer> tracers_;  ///< per history
};

}  // namespace tribo
