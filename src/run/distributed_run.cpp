// SPDX-License-Identifier: MIT
#include "run/distributed_run.hpp"

#include "base/bytes.hpp"

#include <algorithm>

namespace tribo {
namespace {

// What rank 0 asks the other ranks for.
enum class Command : std::int32_t { start, restore, distribute, advance, collect, end };

void command(Command what) {
  ByteWriter message;
  message.value(what);
  ranks().broadcast(message.data);
}

Command next_command() {
  std::vector<std::byte> message;
  ranks().broadcast(message);
  return ByteReader(message).value<Command>();
}

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

// The collective part of with_all_particles().
template <int Dim>
void collect(GridRun<Dim>& run) {
  run.stepper().keep_grid_kinetic();
  run.stepper().distribution().collect();
}

}  // namespace

std::vector<std::string> not_distributed(const Model& model) {
  std::vector<std::string> out;
  const auto note = [&](bool used, const char* what) {
    if (used) out.emplace_back(what);
  };
  const auto is_load = [](const ParticleCondition& c) { return c.kind == ParticleCondition::Kind::force; };
  const auto touches = [](const MaterialSpec& m) { return m.separate; };
  const auto is_rigid = [](const MaterialSpec& m) { return m.law && m.law->rigid(); };
  note(model.contact.active || std::any_of(model.materials.begin(), model.materials.end(), touches),
       "contact between bodies");
  note(!model.cracks.empty(), "cracks");
  note(model.blocks != nullptr, "rigid blocks");
  note(!model.stages.empty() || !model.reactions.empty(), "stages");
  note(model.particles_change(), "particles that enter or are removed");
  note(model.splitting.has_value(), "splitting of particles");
  note(std::any_of(model.grid.periodic.begin(), model.grid.periodic.end(), [](bool p) { return p; }), "periodic edges");
  note(model.load_control.has_value(), "control of a load");
  note(model.reversal.has_value(), "reversal of loads");
  note(model.fracture.has_value(), "growth of cracks");
  note(!std::all_of(model.particle_conditions.begin(), model.particle_conditions.end(), is_load),
       "tractions and fluxes on faces");
  note(!model.output.grid_fields.empty(), "files of the grid");
  note(std::any_of(model.materials.begin(), model.materials.end(), is_rigid), "rigid bodies");
  return out;
}

bool failed_alone() { return alone_in_failure; }

EndForOthers::~EndForOthers() {
  if (!failed_alone()) command(Command::end);
}

template <int Dim>
template <class F>
auto LeadingRun<Dim>::with_all_particles(F&& f) const {
  const bool collects = run_.stepper().distribution().active() && !run_.stepper().distribution().shares_all();
  if (collects) command(Command::collect), together([&] { collect(run_); });
  const auto release = [&] {
    if (collects) run_.stepper().distribution().release();
    run_.stepper().forget_grid_kinetic();
  };
  try {
    const AloneScope alone;
    if constexpr (std::is_void_v<decltype(f())>) {
      f();
      release();
    } else {
      auto result = f();
      release();
      return result;
    }
  } catch (...) {
    release();
    throw;
  }
}

template <int Dim>
void LeadingRun<Dim>::start() {
  command(Command::start);
  const AloneScope alone;
  run_.start();
}

template <int Dim>
RunState LeadingRun<Dim>::restore(const Checkpoint& checkpoint) {
  command(Command::restore);
  const AloneScope alone;
  const RunState state = run_.restore(checkpoint);
  moving_ = run_.moving();
  return state;
}

template <int Dim>
double LeadingRun<Dim>::advance() {
  if (run_.stepper().distribution().shares_all())
    command(Command::distribute), together([&] { run_.stepper().distribute(); });
  command(Command::advance);
  return together([&] { return run_.advance(); });
}

template <int Dim>
std::vector<std::string> LeadingRun<Dim>::look() {
  if (!run_.is_look_due()) return {};
  return with_all_particles([&] { return run_.look(); });
}

template <int Dim>
std::vector<std::string> LeadingRun<Dim>::remarks() const {
  return with_all_particles([&] { return run_.remarks(); });
}

template <int Dim>
std::vector<std::string> LeadingRun<Dim>::choices() const {
  return with_all_particles([&] { return run_.choices(); });
}

template <int Dim>
void LeadingRun<Dim>::save(RunState state, CheckpointWriter& to) {
  with_all_particles([&] { run_.save(state, to); });
}

template <int Dim>
void LeadingRun<Dim>::open_results(const std::filesystem::path& folder, std::optional<double> resume_time,
                                   OutputQueue& queue) {
  with_all_particles([&] { run_.open_results(folder, resume_time, queue); });
}

template <int Dim>
void LeadingRun<Dim>::write_history() {
  with_all_particles([&] { run_.write_history(); });
}

template <int Dim>
void LeadingRun<Dim>::write_files(std::int64_t number) {
  with_all_particles([&] { run_.write_files(number); });
}

template <int Dim>
std::map<std::string, std::string> LeadingRun<Dim>::facts() const {
  auto out = with_all_particles([&] { return run_.facts(); });
  out["processes"] = std::to_string(ranks().count());
  return out;
}

namespace {

// Carries out a command; false if the run has ended.
template <int Dim>
bool carry_out(Command what, GridRun<Dim>& run, const std::filesystem::path& checkpoint) {
  switch (what) {
    case Command::start: {
      const AloneScope alone;
      run.start();
      return true;
    }
    case Command::restore: {
      const AloneScope alone;
      run.restore(Checkpoint(checkpoint));
      return true;
    }
    case Command::distribute:
      run.stepper().distribute();
      return true;
    case Command::advance:
      run.advance();
      return true;
    case Command::collect:
      collect(run);
      run.stepper().forget_grid_kinetic();
      return true;
    case Command::end:
      break;
  }
  return false;
}

}  // namespace

template <int Dim>
void follow(const Model& model, int threads, const std::filesystem::path& checkpoint) {
  std::optional<GridRun<Dim>> run;
  try {
    run.emplace(model);
  } catch (...) {
    while (next_command() != Command::end) continue;
    throw;  // what rank 0 has found, too
  }
  run->choose_threads(threads);
  bool goes_on = true;
  while (goes_on) {
    try {
      together([&] { goes_on = carry_out(next_command(), *run, checkpoint); });
    } catch (const CommonError&) {
      continue;  // rank 0 has thrown it, too, and ends the run
    }
  }
}

template class LeadingRun<2>;
template class LeadingRun<3>;
template void follow<2>(const Model&, int, const std::filesystem::path&);
template void follow<3>(const Model&, int, const std::filesystem::path&);

}  // namespace tribo
