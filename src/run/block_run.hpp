// SPDX-License-Identifier: MIT
/// Runs of rigid blocks without a grid.
#pragma once

#include "run/block_results.hpp"
#include "run/run_loop.hpp"
#include "run/stage_balance.hpp"
#include "solver/stage.hpp"

namespace tribo {

/// Blocks and contacts of a model. Throws InputError.
Assembly assemble(const Model& model);

/// Size and number of the steps of a run.
struct BlockSteps {
  double size = 0.0;
  std::int64_t count = 0;
};
/// `from`: time at which the stage of the model begins.
BlockSteps steps_of(const Model& model, const Assembly& blocks, double from = 0.0);

/// Number of threads, at most `wanted`, that so many contacts can use. Results do not depend on it.
int sensible_block_threads(int wanted, std::size_t contacts);

class BlockRun final : public SteppedModel {
 public:
  /// Throws InputError.
  explicit BlockRun(const Model& model);

  double time() const override { return blocks_.time; }
  std::int64_t step() const override { return blocks_.step; }
  double step_size() const override { return steps_.size; }
  bool at_end() const override { return at_stage_end() && model_.stage.number == model_.stage.count; }
  bool at_stage_end() const override { return blocks_.step >= restored_.stage_step + steps_.count; }
  /// As those of GridRun.
  std::int64_t breaks() const { return results_ ? results_->breaks : 0; }
  double last_value(std::size_t history) const { return results_->last_row().at(1 + history); }
  double unbalanced_ratio() const { return blocks_.unbalanced(); }
  void measure_balance() {}
  void forget_placed() {}
  StageBalance end_stage();
  Checkpoint state_for_next_stage() { return Checkpoint(SteppedModel::save({})); }
  StageReport begin_stage(const Model& former, const std::vector<StageAction>& actions, const StageBalance& before);

  /// Number of contacts that are bonded.
  std::size_t bonds() const { return blocks_.bonds(); }

  void choose_threads(int wanted) const override;
  void start() override {}
  double advance() override;
  std::vector<std::string> look() override;
  std::vector<std::string> choices() const override;
  std::vector<std::string> remarks() const override;
  std::vector<Figure> figures() const override { return monitor_.energy_figures(); }
  void check() override;
  using SteppedModel::save;
  void save(RunState run, CheckpointWriter& to) override;
  RunState restore(const Checkpoint& checkpoint) override;

  ResultNames result_names() const override { return BlockResults::names(model_); }
  void open_results(const std::filesystem::path& folder, std::optional<double> resume_time,
                    OutputQueue& queue) override;
  void write_history() override { results_->write_history(steps_.size); }
  void write_files(std::int64_t number) override { results_->write_files(number); }
  void write_events() override { results_->write_events(); }
  bool history_of_last_step() const override { return true; }

  std::pair<std::int64_t, std::string> moving() const override {
    return {static_cast<std::int64_t>(blocks_.block_count()), "block"};
  }
  std::map<std::string, std::string> facts() const override;
  std::map<std::string, double> seconds_of(double steps) const override { return {{"steps", steps}}; }

 private:
  static constexpr std::int64_t steps_per_check = 64;

  const Model& model_;
  Assembly blocks_;
  BlockSteps steps_;
  std::optional<BlockResults> results_;
  MonitorState monitor_;
  RunState restored_;
};

/// The pre-flight report of a model of blocks. Throws InputError.
std::string describe_blocks(const Model& model, int threads);

}  // namespace tribo
