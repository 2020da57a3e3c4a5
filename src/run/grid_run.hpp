// SPDX-License-Identifier: MIT
/// Runs of particles on a grid.
#pragma once

#include "run/monitor.hpp"
#include "run/particle_fields.hpp"
#include "run/results.hpp"
#include "run/run_loop.hpp"
#include "run/stage_balance.hpp"
#include "run/step_size.hpp"
#include "solver/particle_exchange.hpp"
#include "solver/stage.hpp"

namespace tribo {

/// What rank 0 of a run in several processes receives for a time.
enum class GridCollected {
  particles,
  view,  ///< and what files show of contact and of the nodes
  state  ///< and all that a checkpoint holds
};

template <int Dim>
class GridRun final : public SteppedModel {
 public:
  /// Throws InputError.
  explicit GridRun(const Model& model);

  double time() const override { return system_.time; }
  std::int64_t step() const override { return system_.step; }
  double step_size() const override { return dt_; }
  bool at_end() const override { return has_reached(system_.load_clock.end_of_run(model_.time.end, model_.reversal)); }
  bool at_stage_end() const override { return has_reached(model_.time.next_end()); }
  /// Ends the stage of the model, after which the state is saved for the model of the next one.
  StageBalance end_stage();
  /// Begins the stage of the model, after the state has been restored from the end of the stage of `former`.
  StageReport begin_stage(const Model& former, const std::vector<StageAction>& actions, const StageBalance& before);
  /// For reactions: bonds that broke since the results were opened, the value of a history in the last row, and the
  /// ratio of unbalanced to applied forces in the last step.
  std::int64_t breaks() const {
    return !results_ ? 0 : results_->breaks + (results_->blocks ? results_->blocks->breaks : 0);
  }
  double last_value(std::size_t history) const { return results_->last_row().at(1 + history); }
  double unbalanced_ratio() const { return stepper_.unbalanced_ratio(); }
  void measure_balance() { stepper_.measure_balance(); }
  /// After a restart within the stage of the model, whose particles were placed when it began.
  void forget_placed() { system_.placed.clear(); }
  /// True once the time is `end`, up to round-off.
  bool has_reached(double end) const { return !(system_.time < end * (1 - 1e-12)); }

  void choose_threads(int wanted) const override;
  void start() override { dt_ = step_size_.first().size; }
  double advance() override;
  std::vector<std::string> look() override;
  std::vector<std::string> remarks() const override { return monitor_.summary(); }
  std::vector<Figure> figures() const override;
  using SteppedModel::save;
  void save(RunState run, CheckpointWriter& to) override;
  std::size_t particle_bytes() const override;
  RunState restore(const Checkpoint& checkpoint) override;

  ResultNames result_names() const override { return Results<Dim>::names(model_, system_); }
  void open_results(const std::filesystem::path& folder, std::optional<double> resume_time,
                    OutputQueue& queue) override;
  void write_history() override;
  void write_files(std::int64_t number) override { results_->write_files(number); }
  void write_events() override { results_->write_events(); }
  bool history_of_last_step() const override { return false; }

  std::pair<std::int64_t, std::string> moving() const override { return {particle_count(system_), "particle"}; }
  std::vector<std::string> choices() const override;
  std::vector<RecordedBody> bodies() const override;
  std::map<std::string, std::string> facts() const override;
  std::map<std::string, double> seconds_of(double steps) const override;

  /// Whether look() does more than nothing after this step.
  bool is_look_due() { return results_ && (monitor_.state.is_due(system_.step, dt_, model_.time.end) || at_end()); }
  Stepper<Dim>& stepper() { return stepper_; }

  const System<Dim>& system() const { return system_; }
  System<Dim>& system() { return system_; }
  /// Fields of all particles at present, as in the particle files but in double precision; the results must be open.
  std::shared_ptr<const ParticleFields<Dim>> particle_fields(const std::vector<std::string>& names) {
    return results_->fields(names, Precision::full);
  }
  /// In a run of several processes: gives rank 0 all particles and what else is asked for, until release_collected().
  /// All ranks must call both functions together.
  void collect(GridCollected what);
  void release_collected();
  /// The state from which the model of the next stage goes on, on every rank; all of them must call it together.
  Checkpoint state_for_next_stage();

  /// Distance of the particle that moved farthest from its start [length].
  double largest_displacement();

 private:
  void control_load(double step);
  void exchange_particles(double step);
  void collect_grid();
  double book_exchange(const StageBalance& before);
  StageBalance balance();

  const Model& model_;
  System<Dim> system_;
  Stepper<Dim> stepper_;
  ParticleExchange<Dim> exchange_;
  StepSize<Dim> step_size_;
  Monitor<Dim> monitor_;
  std::optional<Tracers<Dim>> tracers_;  // where particles come and go: those of the start
  std::optional<Results<Dim>> results_;
  RunState restored_;
  double dt_ = 0.0;
};

}  // namespace tribo
