/// One explicit step. The algorithm is in step.cpp, on one screen.
#pragma once

#include "solver/conditions.hpp"
#include "solver/transfer.hpp"

namespace tribo {

/// Energy and momentum that entered or left during the run.
struct Ledger {
  double external_work = 0.0;  ///< body forces and loads
  double damping_work = 0.0;   ///< taken out by grid damping, >= 0
  Vec3 external_impulse = Vec3::Zero();
};

template <int Dim>
class Stepper {
 public:
  Stepper(const Model& model, System<Dim>& system);

  /// Advances by dt: sorts if some particle may have left its bin's reach, then one step of the chosen order.
  /// Throws SimulationError if a particle left the grid or something is not a number.
  void advance(double dt);

  Conditions<Dim>& conditions(std::size_t field) { return conditions_[field]; }
  Ledger& ledger() { return ledger_; }
  const Transfers<Dim>& transfers() const { return *transfers_; }
  /// Rebuilds blocks and nodes for the present bins; needed after a restart.
  void allocate();
  /// Coefficient of grid and particle damping with feedback, kept for restart.
  double grid_damping = 0.0, particle_damping = 0.0;

 private:
  void sort();
  void clear();
  void scatter(Scatter what, bool from_start = false);
  void divide_by_mass();
  void accelerate(double dt, bool from_momentum);
  void filter(double dt);
  void strain(double dt, bool from_start);
  void move(double dt, double strain_dt);
  void remember_positions();
  void load(double dt);
  Gather gather_options() const;
  [[noreturn]] void stop_at_bad_particle() const;
  bool filter_now() const;

  const Model& model_;
  System<Dim>& system_;
  std::unique_ptr<Transfers<Dim>> transfers_;
  std::vector<Conditions<Dim>> conditions_;
  Ledger ledger_;
  double next_filter_ = 0.0;
};

}  // namespace tribo
