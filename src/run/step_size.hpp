// SPDX-License-Identifier: MIT
/// Size of the time step and the reason for it.
#pragma once

#include "model/model.hpp"
#include "solver/state/system.hpp"

#include <algorithm>

namespace tribo {

/// What limits the time step.
struct StepLimit {
  enum class Cause { time_step, waves, viscosity, conduction, supports, speed, joints, faces };
  Cause cause = Cause::time_step;
  std::int64_t body = -1;  ///< index into System::bodies; -1: none in particular
};

template <int Dim>
class StepSize {
 public:
  StepSize(const Model& model, System<Dim>& system) : model_(model), system_(system) {}

  struct First {
    double size = 0.0;
    double wave_speed = 0.0;  ///< the largest
    StepLimit limit;
    std::string set_by;  ///< the same in words
  };
  /// Of the initial state. Throws SimulationError if no material has a wave speed.
  First first();
  /// What limits the step in the present state.
  StepLimit limit();
  /// A limit in words: "<TimeStep>", "the waves in 'steel'".
  std::string words(const StepLimit& limit) const;
  /// The step after one of this size [time]: the same, or every tenth step adapted to wave speeds and the fastest
  /// particle.
  double next(double size);
  /// This size, or the time left to the next stage or the end of the run [time].
  double up_to_end(double size) const {
    const double left = model_.time.next_end() - system_.time;
    return left < size * (1 + 1e-9) ? left : size;
  }

 private:
  // Calls f(size, limit) for what depends on each body.
  template <class F>
  void each_limit(F&& f);
  double viscous_limit(const Body<Dim>& body) const;
  double conduction_limit(const Body<Dim>& body) const;

  const Model& model_;
  System<Dim>& system_;
};

/// Number of threads, at most `wanted`, that so many particles can use. With many velocity fields a particle-step costs
/// several times as much, most of it in contact. Results do not depend on the number.
inline int sensible_threads(int wanted, std::int64_t particles, std::size_t fields) {
  constexpr std::size_t many_fields = 16;
  const std::int64_t worthwhile = fields > many_fields ? 2048 : 8192;
  return static_cast<int>(std::min<std::int64_t>(wanted, 1 + particles / worthwhile));
}

template <int Dim>
std::int64_t particle_count(const System<Dim>& system) {
  std::int64_t n = 0;
  for (const auto& body : system.bodies) n += static_cast<std::int64_t>(body.particles.size());
  return n;
}

}  // namespace tribo
