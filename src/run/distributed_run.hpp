// SPDX-License-Identifier: MIT
/// Runs in several processes: rank 0 has the loop and writes all files; the others take part in what it asks for.
#pragma once

#include "run/grid_run.hpp"
#include "run/staged_run.hpp"

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace tribo {

/// Whether this rank has failed in the middle of what all ranks do together, so that the others wait for it in vain.
bool failed_alone();

/// What a model needs that a run in several processes cannot do yet; a phrase each.
std::vector<std::string> not_distributed(const Model& model);

/// A run as rank 0 sees it. Every call in which the other ranks take part begins with a command to them. `Run`:
/// GridRun, or StagedRun of it.
template <class Run>
class LeadingRun final : public SteppedModel {
 public:
  /// Throws InputError.
  explicit LeadingRun(const Model& model);

  double time() const override { return run_->time(); }
  std::int64_t step() const override { return run_->step(); }
  double step_size() const override { return run_->step_size(); }
  bool at_end() const override { return run_->at_end(); }
  bool at_stage_end() const override { return run_->at_stage_end(); }
  void choose_threads(int wanted) const override { run_->choose_threads(wanted); }
  void start() override;
  double advance() override;
  std::vector<std::string> look() override;
  std::vector<std::string> take_news() override { return run_->take_news(); }
  bool take_checkpoint() override { return run_->take_checkpoint(); }
  std::string end_reason() const override { return run_->end_reason(); }
  std::vector<std::string> remarks() const override;
  std::vector<Figure> figures() const override;
  std::vector<std::string> choices() const override;
  void check() override { run_->check(); }
  using SteppedModel::save;
  void save(RunState run, CheckpointWriter& to) override;
  std::size_t particle_bytes() const override { return run_->particle_bytes(); }
  RunState restore(const Checkpoint& checkpoint) override;

  ResultNames result_names() const override { return run_->result_names(); }
  void open_results(const std::filesystem::path& folder, std::optional<double> resume_time,
                    OutputQueue& queue) override;
  void write_history() override;
  void write_files(std::int64_t number) override;
  void write_events() override;
  bool history_of_last_step() const override { return run_->history_of_last_step(); }

  std::pair<std::int64_t, std::string> moving() const override { return moving_; }
  std::vector<RecordedBody> bodies() const override { return run_->bodies(); }
  std::map<std::string, std::string> facts() const override;
  std::map<std::string, double> seconds_of(double steps) const override { return run_->seconds_of(steps); }

 private:
  template <class F>
  auto with_all_particles(GridCollected what, F&& f) const;
  void write_frames();

  mutable std::optional<Run> run_;
  std::pair<std::int64_t, std::string> moving_{0, "particle"};
};

/// Ends the run for the other ranks when it is destroyed; to be constructed by rank 0 before all else.
class EndForOthers {
 public:
  EndForOthers() = default;
  ~EndForOthers();
  EndForOthers(const EndForOthers&) = delete;
  EndForOthers& operator=(const EndForOthers&) = delete;
};

/// Takes part in a run as a rank other than 0, until rank 0 ends it. `checkpoint`: where the run continues from.
template <class Run>
void follow(const Model& model, int threads, const std::filesystem::path& checkpoint);

}  // namespace tribo
