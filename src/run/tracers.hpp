// SPDX-License-Identifier: MIT
/// The particles that histories of a point follow.
#pragma once

#include "model/model.hpp"
#include "solver/measures.hpp"

#include <cstdint>
#include <optional>
#include <vector>

namespace tribo {

template <int Dim>
class Tracers {
 public:
  /// Finds for every history of a point the particle that started nearest to it; among equally near ones the one
  /// with the lowest id. A particle of a rigid body is taken if no deformable one is within a cell. Throws InputError
  /// at a history whose point has no particle within a cell.
  Tracers(const Model& model, System<Dim>& system);
  /// Measures of the particle of history `k`, which must be a history of a point. All are 0 once it was excavated.
  Measures measure(System<Dim>& system, std::size_t k, bool strain) const;
  /// Present number of the particle in its body; the number of particles in the body once it was excavated.
  std::size_t particle(const System<Dim>& system, std::size_t k) const;
  /// Number of the deformable body of the particle; none if it is rigid.
  std::optional<std::size_t> deformable_body(std::size_t k) const {
    return tracers_[k].rigid ? std::nullopt : std::optional(tracers_[k].body);
  }

 private:
  struct Tracer {
    bool rigid = false;  ///< whether `body` is a number among the rigid bodies
    std::size_t body = 0;
    std::int64_t id = -1;  ///< -1: no history of a point
  };
  // Assigns the particle of `bodies` nearest to the point of `q`; returns the squared distance in cells.
  static double search(const HistoryQuantity& q, std::vector<Body<Dim>>& bodies, double cell, Tracer& tracer);

  std::vector<Tracer> tracers_;  ///< per history
};

}  // namespace tribo
