// SPDX-License-Identifier: MIT
/// Damping of velocities on the grid and on the particles.
#pragma once

#include "solver/exchange/node_sums.hpp"

namespace tribo {

/// The damping coefficients, with feedback control by the kinetic energy, and the work and impulse of damping.
template <int Dim>
class VelocityDamping {
 public:
  VelocityDamping(const Model& model, System<Dim>& system, const Exchanges<Dim>& exchanges, EnergyLedger& ledger)
      : damping_(model.damping), system_(system), sum_(system, exchanges), ledger_(ledger) {}

  /// Updates the coefficients from their functions of time, and the feedback if there is any, before a step dt.
  /// `kinetic_energy()` [energy] is called only with feedback.
  template <class Kinetic>
  void update(double dt, Kinetic&& kinetic_energy) {
    Variables at;
    at.t = system_.time / damping_.function_time, at.dt = dt / damping_.function_time;
    const auto follow = [&](const std::optional<Expression>& constant, const std::optional<double>& gain, double& alpha,
                            double& feedback) {
      if (gain) {
        const double target = damping_.target_energy ? (*damping_.target_energy)(at) : 0.0;
        feedback = std::max(0.0, feedback + dt * *gain * (kinetic_energy() - target));
        if (damping_.max_alpha > 0) feedback = std::min(feedback, damping_.max_alpha);
      }
      alpha = (constant ? (*constant)(at) : 0.0) + feedback;
    };
    follow(damping_.grid, damping_.grid_gain, grid, grid_feedback);
    follow(damping_.particle, damping_.particle_gain, particle, particle_feedback);
  }

  /// Adds the work and impulse of grid damping on field f in the momentum update to the ledger.
  void record_grid(std::size_t f, double dt);
  /// Adds the work and impulse of particle damping with the coefficient `rate` [1/time] on a body to the ledger. It is
  /// computed as the mass fraction of the body in those on its field, which is exact if all bodies of the field have
  /// the same coefficient. The work is at most that on the velocities of the particles, whose energy is `kinetic`
  /// [energy]. `part`: the damped velocities are the increments of the filter layer, not all velocities.
  void record_particles(const Body<Dim>& body, double kinetic, double rate, double dt, bool part);

  double grid = 0.0, particle = 0.0;                    ///< current coefficients                     [1/time]
  double grid_feedback = 0.0, particle_feedback = 0.0;  ///< contributions of the feedback    [1/time]

  friend void archive(Archive& a, VelocityDamping& damping) {
    auto& [of_grid, of_particle, of_grid_feedback, of_particle_feedback, model, system, sum, ledger] = damping;
    a.version(1);
    a("grid", of_grid), a("particle", of_particle);
    a("grid_feedback", of_grid_feedback), a("particle_feedback", of_particle_feedback);
  }

 private:
  const Damping& damping_;
  System<Dim>& system_;
  NodeSums<Dim> sum_;
  EnergyLedger& ledger_;
};

}  // namespace tribo
