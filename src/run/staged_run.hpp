// SPDX-License-Identifier: MIT
/// A run in stages: a chain of models that pass their state on.
#pragma once

#include "run/run_loop.hpp"
#include "solver/stage.hpp"

#include <memory>

namespace tribo {

/// A run of `Stepped` models, GridRun or BlockRun, one for each stage. When the time of a stage has come, the state of
/// the present model is restored into the next one, as from a checkpoint, and the actions of the stage are carried out
/// before its first step. What is written at this time, a checkpoint too, is the state before. A run that is resumed
/// therefore ends with the same bits wherever it was stopped.
template <class Stepped>
class StagedRun final : public SteppedModel {
 public:
  /// Of a model with stages. Its first model is built by start() or restore(). The model must outlive the run.
  explicit StagedRun(const Model& model) : first_(model) {}

  double time() const override { return now_->time(); }
  std::int64_t step() const override { return now_->step(); }
  double step_size() const override { return now_->step_size(); }
  bool at_end() const override { return !end_reason_.empty() || now_->at_end(); }
  bool at_stage_end() const override { return ends_ || now_->at_stage_end(); }

  void choose_threads(int wanted) const override;
  /// Builds the models of all stages, so that what is wrong in one of them is told before the run.
  void start() override;
  double advance() override;
  /// Whether the next stage begins before the next step.
  bool is_next_stage_due() const { return stage_ < last_stage() && at_stage_end(); }
  /// What advance() does then. In a run of several processes, all of them call it together, and each has all particles
  /// afterwards.
  void begin_next_stage();
  std::vector<std::string> look() override;
  std::vector<std::string> take_news() override { return std::exchange(news_, {}); }
  bool take_checkpoint() override { return std::exchange(checkpoint_, false); }
  std::string end_reason() const override { return end_reason_; }
  std::vector<std::string> choices() const override { return now_->choices(); }
  std::vector<std::string> remarks() const override { return now_->remarks(); }
  std::vector<Figure> figures() const override { return now_->figures(); }
  void check() override { now_->check(); }

  using SteppedModel::save;
  void save(RunState run, CheckpointWriter& to) override;
  std::size_t particle_bytes() const override { return now_->particle_bytes(); }
  RunState restore(const Checkpoint& checkpoint) override;

  ResultNames result_names() const override;
  void open_results(const std::filesystem::path& folder, std::optional<double> resume_time,
                    OutputQueue& queue) override;
  void write_history() override;
  void write_files(std::int64_t number) override { now_->write_files(number); }
  void write_events() override;
  bool history_of_last_step() const override { return now_->history_of_last_step(); }
  /// Files for which reactions ask are not written at once; take_frames() returns their numbers.
  void defer_frames() { defers_frames_ = true; }
  std::vector<std::int64_t> take_frames() { return std::exchange(deferred_frames_, {}); }

  std::pair<std::int64_t, std::string> moving() const override { return now_->moving(); }
  std::vector<RecordedBody> bodies() const override { return now_->bodies(); }
  std::map<std::string, std::string> facts() const override;
  std::map<std::string, double> seconds_of(double steps) const override { return now_->seconds_of(steps); }

  /// Number of the present stage; 0: the model at the start.
  int stage() const { return stage_; }
  Stepped& present() { return *now_; }

 private:
  int last_stage() const { return static_cast<int>(first_.stages.size()); }
  const Model& model_of(int stage) const {
    return stage == 0 ? first_ : *first_.stages[static_cast<std::size_t>(stage) - 1].model;
  }
  void build(int stage);
  void record(const StageSpec& stage, const StageReport& report);
  template <class F>
  void react(F&& happens);
  void write_frame();

  /// Files that reactions ask for have numbers from here on.
  static constexpr std::int64_t first_frame = 900000;
  /// Forces count as balanced once their ratio has been small in so many steps in a row.
  static constexpr std::int64_t lasting = 20;

  const Model& first_;
  int stage_ = 0;
  std::unique_ptr<Stepped> now_;
  mutable int threads_ = 0;  // wanted; 0: not said yet
  std::filesystem::path folder_;
  OutputQueue* queue_ = nullptr;
  std::vector<std::string> news_, warnings_;
  bool ends_ = false;         // the stage ends before its time
  std::int64_t reacted_ = 0;  // bit k: reaction k of the stage has happened
  std::int64_t calm_ = 0;     // steps in a row with balanced forces
  std::int64_t frames_ = 0;   // files that reactions asked for
  bool defers_frames_ = false;
  std::vector<std::int64_t> deferred_frames_;
  bool checkpoint_ = false;  // a reaction asks for a checkpoint
  std::string end_reason_;   // a reaction ends the run
};

/// The begins of the stages that a file stages.csv tells of are kept up to this number, later ones removed.
void keep_stages(const std::filesystem::path& file, int stages);

}  // namespace tribo
