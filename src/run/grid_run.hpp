// SPDX-License-Identifier: MIT
/// Runs of particles on a grid.
#pragma once

#include "run/monitor.hpp"
#include "run/results.hpp"
#include "run/run_loop.hpp"
#include "run/step_size.hpp"

namespace tribo {

template <int Dim>
class GridRun final : public SteppedModel {
 public:
  /// Throws InputError.
  explicit GridRun(const Model& model);

  double time() const override { return system_.time; }
  std::int64_t step() const override { return system_.step; }
  double step_size() const override { return dt_; }
  bool at_end() const override { return has_reached(system_.load_clock.end_of_run(model_.time.end, model_.reversal)); }
  /// True once the time is `end`, up to round-off.
  bool has_reached(double end) const { return !(system_.time < end * (1 - 1e-12)); }

  void choose_threads(int wanted) const override;
  void start() override { dt_ = step_size_.first().size; }
  double advance() override;
  std::vector<std::string> look() override;
  std::vector<std::string> remarks() const override { return monitor_.summary(); }
  std::vector<std::string> figures() const override;
  CheckpointWriter save(RunState run) override;
  RunState restore(const Checkpoint& checkpoint) override;

  ResultNames result_names() const override { return Results<Dim>::names(model_, system_); }
  void open_results(const std::filesystem::path& folder, std::optional<double> resume_time) override;
  void write_history() override;
  void write_files(std::int64_t number) override { results_->write_files(number); }
  void write_events() override { results_->write_events(); }
  bool history_of_last_step() const override { return false; }

  std::pair<std::int64_t, std::string> moving() const override { return {particle_count(system_), "particle"}; }
  std::vector<std::string> choices() const override;
  std::map<std::string, std::string> facts() const override;
  std::map<std::string, double> seconds_of(double steps) const override;

  /// Distance of the particle that moved farthest from its start [length].
  double largest_displacement();

 private:
  void control_load(double step);
  const Model& model_;
  System<Dim> system_;
  Stepper<Dim> stepper_;
  StepSize<Dim> step_size_;
  Monitor<Dim> monitor_;
  std::optional<Results<Dim>> results_;
  RunState restored_;
  double dt_ = 0.0;
};

}  // namespace tribo
