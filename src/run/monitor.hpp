// SPDX-License-Identifier: MIT
/// Looks at a run from time to time for signs that its results are wrong.
#pragma once

#include "base/stopwatch.hpp"
#include "run/monitor_state.hpp"
#include "run/ordinary_volume.hpp"
#include "run/step_size.hpp"
#include "solver/measures.hpp"
#include "solver/step.hpp"

#include <string>
#include <vector>

namespace tribo {

/// It reads the state of the run and changes nothing in it. What it has seen is part of the checkpoint, so that a run
/// that is resumed does not repeat a warning and ends with the same summary.
///
/// Energy that is not accounted for is compared with what was supplied: kinetic and elastic energy at the start, work
/// of loads and boundaries, and potential energy set free. The transfers may dissipate much of it, which is a figure of
/// its own. If the energy of the bodies has grown over several looks in spite of it, the results are wrong.
template <int Dim>
class Monitor {
 public:
  /// Of a system before its first step. All arguments must outlive the monitor.
  Monitor(const Model& model, System<Dim>& system, Stepper<Dim>& stepper, StepSize<Dim>& steps);

  /// To be called after each step. `dt`: size of the steps [time]; `initial_energy`: content of energy at the start;
  /// `last`: the run ends here. Returns a warning for each sign that is seen for the first time.
  std::vector<std::string> look(double dt, double initial_energy, bool last);
  /// Lines on the energy that the transfers dissipated, that is missing, and that the growth of cracks released, where
  /// they are more than a trifle.
  std::vector<Figure> energy_figures() const;
  /// One line for each sign that was seen, with the worst it came to, and further remarks on the whole run.
  std::vector<std::string> summary() const;
  MonitorState state;
  Stopwatch watch;  ///< time spent in looks

 private:
  using Warnings = std::vector<std::string>;
  void record(Sign sign, const Finding& now, bool worse, Warnings& warnings);
  void balance(double initial_energy, Warnings& warnings);
  void particles(Warnings& warnings);
  void step(double dt, Warnings& warnings);

  std::string text(Sign sign) const;
  std::string energy_text(const Finding& f) const;
  std::string unreported_energy() const;
  std::string balance_cure() const;
  std::string particle_text(Sign sign, const Finding& f) const;
  std::string step_text(const Finding& f) const;
  std::string place(const Finding& f) const;

  const Model& model_;
  System<Dim>& system_;
  Stepper<Dim>& stepper_;
  StepSize<Dim>& steps_;
  std::vector<VolumeRange> ranges_;  // per body: the ordinary range of its law, beyond what it has from the start
};

}  // namespace tribo
