// SPDX-License-Identifier: MIT
#include "run/distributed_run.hpp"

#include "base/common_data.hpp"
#include "base/text.hpp"

#include <algorithm>
#include <exception>

namespace tribo {
namespace {

// What rank 0 asks the other ranks for.
enum class Command : std::int32_t {
  build,
  start,
  restore,
  distribute,
  next_stage,
  advance,
  collect,
  collect_view,
  collect_state,
  end
};

void command(Command what) { value_of_first_rank(what); }
Command next_command() { return value_of_first_rank(Command::end); }

bool alone_in_failure = false;

// Does something that all ranks do together.
template <class F>
auto together(F&& f) {
  try {
    return f();
  } catch (const CommonError&) {
    throw;
  } catch (...) {
    alone_in_failure = true;
    throw;
  }
}

// Does something that each rank does for itself with the whole model. If it fails on rank 0, only rank 0 throws, since
// it speaks for all.
template <class F>
void each_alone(F&& f) {
  std::exception_ptr error;
  try {
    const AloneScope alone;
    f();
  } catch (...) {
    error = std::current_exception();
  }
  const bool failed = error != nullptr, first_failed = value_of_first_rank(failed);
  if (!any_rank(failed)) return;
  if (ranks().rank() == 0 && !failed) throw CommonError("another process of the run has failed");
  if (ranks().rank() > 0 && (first_failed || !failed)) return;
  alone_in_failure = ranks().rank() > 0;
  std::rethrow_exception(error);
}

template <int Dim>
GridRun<Dim>& grid_of(GridRun<Dim>& run) {
  return run;
}
template <int Dim>
GridRun<Dim>& grid_of(StagedRun<GridRun<Dim>>& run) {
  return run.present();
}

Command command_for(GridCollected what) {
  return what == GridCollected::view    ? Command::collect_view
         : what == GridCollected::state ? Command::collect_state
                                        : Command::collect;
}

}  // namespace

std::vector<std::string> not_distributed(const Model& model) {
  std::vector<std::string> out;
  // The nodes whose velocities a wall mirrors must be near those that it governs.
  const auto mirrors_deeply = [](const NodeCondition& c) { return c.wall && c.wall->mirror && c.wall->depth > 1; };
  if (std::any_of(model.node_conditions.begin(), model.node_conditions.end(), mirrors_deeply))
    out.emplace_back("walls with mirrored velocities and a <depth> of more than a cell");
  return out;
}

bool failed_alone() { return alone_in_failure; }

EndForOthers::~EndForOthers() {
  if (failed_alone()) return;
  try {
    command(Command::end);
  } catch (const std::exception&) {
    alone_in_failure = true;  // the others wait for a command that does not come, and must be stopped
  }
}

// Calls f() with all particles on this rank, and with what else is collected.
template <class Run>
template <class F>
auto LeadingRun<Run>::with_all_particles(GridCollected what, F&& f) const {
  auto& grid = grid_of(*run_);
  const auto& distribution = grid.stepper().distribution();
  const bool collects = distribution.active() && !distribution.shares_all();
  if (collects) {
    command(command_for(what));
    together([&] { grid.collect(what); });
  }
  // Gives the particles back at the end, whatever happens.
  struct Release {
    std::remove_reference_t<decltype(grid)>* run;
    ~Release() {
      if (run) run->release_collected();
    }
  };
  const Release at_end{collects ? &grid : nullptr};
  const AloneScope alone;
  return f();
}

template <class Run>
LeadingRun<Run>::LeadingRun(const Model& model) {
  command(Command::build);
  each_alone([&] { run_.emplace(model); });
  if constexpr (requires { run_->defer_frames(); }) run_->defer_frames();
}

template <class Run>
void LeadingRun<Run>::start() {
  command(Command::start);
  each_alone([&] { run_->start(); });
  moving_ = run_->moving();
}

template <class Run>
RunState LeadingRun<Run>::restore(const Checkpoint& checkpoint) {
  command(Command::restore);
  RunState state;
  each_alone([&] { state = run_->restore(checkpoint); });
  moving_ = run_->moving();
  return state;
}

template <class Run>
double LeadingRun<Run>::advance() {
  if constexpr (requires { run_->begin_next_stage(); })
    if (run_->is_next_stage_due()) {
      command(Command::next_stage);
      together([&] { run_->begin_next_stage(); });
      moving_ = run_->moving();
    }
  if (grid_of(*run_).stepper().distribution().shares_all()) {
    moving_ = run_->moving();
    command(Command::distribute);
    together([&] { grid_of(*run_).stepper().distribute(); });
  }
  command(Command::advance);
  return together([&] {
    value_of_first_rank(grid_of(*run_).system().load_clock);
    return grid_of(*run_).advance();
  });
}

template <class Run>
std::vector<std::string> LeadingRun<Run>::look() {
  if (!grid_of(*run_).is_look_due()) return {};
  return with_all_particles(GridCollected::particles, [&] { return run_->look(); });
}

template <class Run>
std::vector<std::string> LeadingRun<Run>::remarks() const {
  return with_all_particles(GridCollected::particles, [&] { return run_->remarks(); });
}

template <class Run>
std::vector<std::string> LeadingRun<Run>::choices() const {
  return with_all_particles(GridCollected::particles, [&] { return run_->choices(); });
}

template <class Run>
void LeadingRun<Run>::save(RunState state, CheckpointWriter& to) {
  with_all_particles(GridCollected::state, [&] { run_->save(state, to); });
}

template <class Run>
void LeadingRun<Run>::open_results(const std::filesystem::path& folder, std::optional<double> resume_time,
                                   OutputQueue& queue) {
  with_all_particles(GridCollected::particles, [&] { run_->open_results(folder, resume_time, queue); });
}

template <class Run>
void LeadingRun<Run>::write_history() {
  with_all_particles(GridCollected::particles, [&] { run_->write_history(); });
  write_frames();
}

template <class Run>
void LeadingRun<Run>::write_files(std::int64_t number) {
  with_all_particles(GridCollected::view, [&] { grid_of(*run_).write_files(number); });
}

template <class Run>
void LeadingRun<Run>::write_events() {
  {
    const AloneScope alone;
    run_->write_events();
  }
  write_frames();
}

// The files for which reactions have asked.
template <class Run>
void LeadingRun<Run>::write_frames() {
  if constexpr (requires { run_->take_frames(); })
    for (const std::int64_t number : run_->take_frames()) write_files(number);
}

template <class Run>
std::map<std::string, std::string> LeadingRun<Run>::facts() const {
  auto out = with_all_particles(GridCollected::particles, [&] { return run_->facts(); });
  out["processes"] = std::to_string(ranks().count());
  return out;
}

template <class Run>
std::vector<Figure> LeadingRun<Run>::figures() const {
  auto out = run_->figures();
  const auto& counts = grid_of(*run_).stepper().distribution().counts();
  std::size_t particles = 0, fullest = 0, ghosts = 0, bytes = 0, transfers = 0, divisions = 0;
  for (const auto& rank : counts) {
    particles += rank.particles, bytes += rank.bytes;
    fullest = std::max(fullest, rank.particles), ghosts = std::max(ghosts, rank.ghosts);
    transfers = std::max(transfers, rank.refreshes), divisions = std::max(divisions, rank.divisions);
  }
  if (particles == 0 || transfers == 0) return out;
  const auto all = static_cast<double>(particles);
  out.push_back(
      {format("%d processes: imbalance %.4f, at most %zu copies of particles, %.3g bytes sent per particle and "
              "transfer, the blocks divided %s",
              ranks().count(), static_cast<double>(fullest * counts.size()) / all, ghosts,
              static_cast<double>(bytes) / all / static_cast<double>(transfers), counted(divisions, "time").c_str())});
  return out;
}

namespace {

// Carries out a command; false if the run has ended.
template <class Run>
bool carry_out(Command what, const Model& model, int threads, std::optional<Run>& run,
               const std::filesystem::path& checkpoint) {
  switch (what) {
    case Command::build:
      each_alone([&] { run.emplace(model), run->choose_threads(threads); });
      return true;
    case Command::start:
      each_alone([&] { run->start(); });
      return true;
    case Command::restore:
      each_alone([&] { run->restore(Checkpoint(checkpoint)); });
      return true;
    case Command::distribute:
      grid_of(*run).stepper().distribute();
      return true;
    case Command::next_stage:
      if constexpr (requires { run->begin_next_stage(); }) run->begin_next_stage();
      return true;
    case Command::advance:
      grid_of(*run).system().load_clock = value_of_first_rank(LoadClock{});
      grid_of(*run).advance();
      return true;
    case Command::collect:
      grid_of(*run).collect(GridCollected::particles);
      return true;
    case Command::collect_view:
      grid_of(*run).collect(GridCollected::view);
      return true;
    case Command::collect_state:
      grid_of(*run).collect(GridCollected::state);
      return true;
    case Command::end:
      break;
  }
  return false;
}

}  // namespace

template <class Run>
void follow(const Model& model, int threads, const std::filesystem::path& checkpoint) {
  std::optional<Run> run;
  bool goes_on = true;
  while (goes_on) {
    try {
      together([&] { goes_on = carry_out(next_command(), model, threads, run, checkpoint); });
    } catch (const CommonError&) {
      continue;  // rank 0 has thrown it, too, and ends the run
    }
  }
}

template class LeadingRun<GridRun<2>>;
template class LeadingRun<GridRun<3>>;
template class LeadingRun<StagedRun<GridRun<2>>>;
template class LeadingRun<StagedRun<GridRun<3>>>;
template void follow<GridRun<2>>(const Model&, int, const std::filesystem::path&);
template void follow<GridRun<3>>(const Model&, int, const std::filesystem::path&);
template void follow<StagedRun<GridRun<2>>>(const Model&, int, const std::filesystem::path&);
template void follow<StagedRun<GridRun<3>>>(const Model&, int, const std::filesystem::path&);

}  // namespace tribo
