// SPDX-License-Identifier: MIT
#include "run/staged_run.hpp"

#include "base/error.hpp"
#include "base/memory.hpp"
#include "base/ranks.hpp"
#include "base/read_file.hpp"
#include "base/text.hpp"
#include "output/atomic_file.hpp"
#include "output/number.hpp"
#include "run/block_run.hpp"
#include "run/grid_run.hpp"
#include "run/stage_report.hpp"

#include <algorithm>
#include <sstream>

namespace tribo {
namespace {

constexpr const char* columns_of_stages = "time,stage,name,excavated,placed,stressed,bonded,unbonded,energy\n";

// A text as a field of a table.
std::string quoted(std::string text) {
  for (std::size_t at = 0; (at = text.find('"', at)) != std::string::npos; at += 2) text.insert(at, 1, '"');
  return '"' + text + '"';
}

}  // namespace

void keep_stages(const std::filesystem::path& file, int stages) {
  std::string kept = columns_of_stages;
  if (std::filesystem::exists(file)) {
    std::istringstream lines(read_file(file));
    std::string line;
    std::getline(lines, line);
    for (int k = 0; k < stages && std::getline(lines, line); ++k) kept += line + "\n";
  }
  write_atomically(file, kept);
}

template <class Stepped>
void StagedRun<Stepped>::choose_threads(int wanted) const {
  threads_ = wanted;
  if (now_) now_->choose_threads(wanted);
}

template <class Stepped>
void StagedRun<Stepped>::build(int stage) {
  now_.reset();  // first, as both need memory
  stage_ = stage;
  now_ = std::make_unique<Stepped>(model_of(stage));
  if (threads_ > 0) now_->choose_threads(threads_);
  const auto& reactions = model_of(stage).reactions;
  if (std::any_of(reactions.begin(), reactions.end(), [](const auto& r) { return r.what == Reaction::What::ratio; }))
    now_->measure_balance();
}

template <class Stepped>
void StagedRun<Stepped>::start() {
  for (int k = 1; k <= last_stage(); ++k) build(k);
  build(0);
  now_->start();
}

template <class Stepped>
double StagedRun<Stepped>::advance() {
  if (is_next_stage_due()) begin_next_stage();
  return now_->advance();
}

template <class Stepped>
void StagedRun<Stepped>::begin_next_stage() {
  const Model& former = model_of(stage_);
  const StageSpec& stage = first_.stages[static_cast<std::size_t>(stage_)];
  const StageBalance before = now_->end_stage();
  {
    const Checkpoint state = now_->state_for_next_stage();
    build(stage_ + 1);
    now_->restore(state);
  }
  const AloneScope with_all_particles;
  ends_ = false, reacted_ = calm_ = 0;
  const StageReport report = now_->begin_stage(former, stage.actions, before);
  if (threads_ > 0) now_->choose_threads(threads_);
  if (queue_) {
    queue_->drain();  // the files are read and continued
    now_->open_results(folder_, now_->time(), *queue_);
  }
  record(stage, report);
}

template <class Stepped>
void StagedRun<Stepped>::record(const StageSpec& stage, const StageReport& report) {
  std::string did;
  const auto tell = [&](std::int64_t count, const char* what) {
    if (count > 0) did += ", " + std::to_string(count) + " " + what;
  };
  tell(report.excavated, "particles excavated"), tell(report.placed, "particles placed");
  tell(report.stressed, "particles with another stress");
  tell(report.bonded, "contacts bonded"), tell(report.unbonded, "bonds broken");
  news_.push_back(title_of(stage, stage_) + " begins at time " + format("%.6g", now_->time()) + ": " +
                  join(stage.changes) + did);
  for (const std::string& warning : report.warnings) warnings_.push_back(title_of(stage, stage_) + ": " + warning);
  if (folder_.empty()) return;
  const std::filesystem::path file = folder_ / "stages.csv";
  keep_stages(file, stage_ - 1);
  write_atomically(file, read_file(file) + number_text(now_->time()) + "," + std::to_string(stage_) + "," +
                             quoted(stage.name) + "," + std::to_string(report.excavated) + "," +
                             std::to_string(report.placed) + "," + std::to_string(report.stressed) + "," +
                             std::to_string(report.bonded) + "," + std::to_string(report.unbonded) + "," +
                             number_text(report.energy) + "\n");
}

template <class Stepped>
std::vector<std::string> StagedRun<Stepped>::look() {
  std::vector<std::string> out = std::exchange(warnings_, {});
  for (std::string& warning : now_->look()) out.push_back(std::move(warning));
  return out;
}

template <class Stepped>
template <class F>
void StagedRun<Stepped>::react(F&& happens) {
  const auto& reactions = model_of(stage_).reactions;
  for (std::size_t k = 0; k < reactions.size(); ++k) {
    const Reaction& reaction = reactions[k];
    if ((reacted_ >> k & 1) != 0 || !happens(reaction)) continue;
    reacted_ |= std::int64_t{1} << k;
    const char* words[] = {"the run stops", "files are written", "a checkpoint is written", "the stage ends"};
    news_.push_back(reaction.text + format(" at time %.6g: ", now_->time()) +
                    words[static_cast<std::size_t>(reaction.effect)]);
    using Effect = Reaction::Effect;
    if (reaction.effect == Effect::frame) write_frame();
    if (reaction.effect == Effect::checkpoint) checkpoint_ = true;
    const bool last = stage_ == last_stage();
    if (reaction.effect == Effect::next_stage && !last) ends_ = true;
    if (reaction.effect == Effect::stop || (reaction.effect == Effect::next_stage && last))
      end_reason_ = reaction.text + format(" at time %.6g", now_->time());
  }
}

template <class Stepped>
void StagedRun<Stepped>::write_frame() {
  const std::int64_t number = first_frame + frames_++;
  defers_frames_ ? deferred_frames_.push_back(number) : now_->write_files(number);
}

template <class Stepped>
void StagedRun<Stepped>::write_history() {
  now_->write_history();
  react([&](const Reaction& r) {
    if (r.what == Reaction::What::above) return now_->last_value(r.history) > r.value;
    return r.what == Reaction::What::below && now_->last_value(r.history) < r.value;
  });
}

template <class Stepped>
void StagedRun<Stepped>::write_events() {
  const std::int64_t breaks = now_->breaks();
  now_->write_events();
  double largest = -1.0;  // the largest value of the reactions to balanced forces
  for (const Reaction& r : model_of(stage_).reactions)
    if (r.what == Reaction::What::ratio) largest = std::max(largest, r.value);
  const double ratio = largest < 0 ? 0.0 : now_->unbalanced_ratio();
  calm_ = largest >= 0 && ratio < largest ? calm_ + 1 : 0;
  react([&](const Reaction& r) {
    if (r.what == Reaction::What::bond_break) return now_->breaks() > breaks;
    return r.what == Reaction::What::ratio && calm_ >= lasting && ratio < r.value;
  });
}

template <class Stepped>
void StagedRun<Stepped>::save(RunState run, CheckpointWriter& to) {
  run.stage = stage_, run.stage_ends = ends_;
  run.reacted = reacted_, run.calm = calm_, run.frames = frames_;
  now_->save(run, to);
}

template <class Stepped>
RunState StagedRun<Stepped>::restore(const Checkpoint& checkpoint) {
  const std::int64_t stage = checkpoint.integer("run.stage");
  if (stage < 0 || stage > last_stage())
    refuse_checkpoint("it is of stage " + std::to_string(stage) + ", and there are " + std::to_string(last_stage()));
  with_memory_for("this model", first_.grid.origin, [&] { build(static_cast<int>(stage)); });
  const RunState state = now_->restore(checkpoint);
  now_->forget_placed();
  ends_ = state.stage_ends, reacted_ = state.reacted, calm_ = state.calm, frames_ = state.frames;
  if (threads_ > 0) now_->choose_threads(threads_);
  return state;
}

template <class Stepped>
ResultNames StagedRun<Stepped>::result_names() const {
  ResultNames out = now_->result_names();
  out.add({{"stages.csv"}, {}});
  return out;
}

template <class Stepped>
void StagedRun<Stepped>::open_results(const std::filesystem::path& folder, std::optional<double> resume_time,
                                      OutputQueue& queue) {
  folder_ = folder, queue_ = &queue;
  keep_stages(folder / "stages.csv", stage_);
  now_->open_results(folder, resume_time, queue);
}

template <class Stepped>
std::map<std::string, std::string> StagedRun<Stepped>::facts() const {
  std::map<std::string, std::string> out = now_->facts();
  std::string all;
  for (int k = 1; k <= last_stage(); ++k) {
    const StageSpec& stage = first_.stages[static_cast<std::size_t>(k) - 1];
    all += (k > 1 ? "; " : "") + title_of(stage, k) + " from time " + format("%.6g", stage.at) + ": " +
           join(stage.changes);
  }
  if (!all.empty()) out["stages"] = all;
  return out;
}

template class StagedRun<GridRun<2>>;
template class StagedRun<GridRun<3>>;
template class StagedRun<BlockRun>;

}  // namespace tribo
