// SPDX-License-Identifier: MIT
#include "run/distributed_run.hpp"

#include "base/bytes.hpp"

#include <algorithm>

namespace tribo {
namespace {

// What rank 0 asks the other ranks for.
enum class Command : std::int32_t { start, restore, distribute, advance, collect, collect_view, collect_state, end };

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

// The collective part of with_all_particles(): `what` says whether also what files show of contact is collected, or the
// whole state.
template <int Dim>
void collect(GridRun<Dim>& run, Command what) {
  Stepper<Dim>& stepper = run.stepper();
  stepper.keep_grid_kinetic();
  if (what == Command::collect_view && stepper.contact().active()) {
    stepper.distribution().refresh_ghosts();  // they have moved since the last transfer
    stepper.contact().fill_view();
  }
  if (what == Command::collect_state) stepper.contact().collect_faces();
  stepper.distribution().collect();
  if (ranks().rank() > 0) return stepper.forget_grid_kinetic();
  if (what == Command::collect_state) stepper.contact().place_collected_faces();
  stepper.contact().keep_view();
}

template <int Dim>
void release(GridRun<Dim>& run) {
  run.stepper().distribution().release();
  run.stepper().contact().release();
  run.stepper().forget_grid_kinetic();
}

}  // namespace

std::vector<std::string> not_distributed(const Model& model) {
  std::vector<std::string> out;
  const auto note = [&](bool used, const char* what) {
    if (used) out.emplace_back(what);
  };
  const auto is_load = [](const ParticleCondition& c) { return c.kind == ParticleCondition::Kind::force; };
  const auto mirrors = [](const NodeCondition& c) { return c.wall && c.wall->mirror; };
  note(std::any_of(model.node_conditions.begin(), model.node_conditions.end(), mirrors),
       "walls with mirrored velocities");
  const auto is_interface = [](const auto& law) { return law && law->interface(); };
  const auto& laws = model.contact.pair_laws;
  note(is_interface(model.contact.default_law) ||
           std::any_of(laws.begin(), laws.end(), [&](const auto& pair) { return is_interface(pair.second); }) ||
           !model.contact.joints.empty(),
       "interfaces or joints between bodies");
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
  note(model.contact.active && model.heat.conduction, "conduction of heat across contact");
  return out;
}

bool failed_alone() { return alone_in_failure; }

EndForOthers::~EndForOthers() {
  if (!failed_alone()) command(Command::end);
}

template <int Dim>
template <class F>
auto LeadingRun<Dim>::with_all_particles(bool view, bool state, F&& f) const {
  const bool collects = run_.stepper().distribution().active() && !run_.stepper().distribution().shares_all();
  const auto collect_all = [&] {
    const Command what = view ? Command::collect_view : state ? Command::collect_state : Command::collect;
    command(what);
    collect(run_, what);
  };
  if (collects) together(collect_all);
  // Gives the particles back at the end, whatever happens.
  struct Release {
    GridRun<Dim>* run;
    ~Release() {
      if (run) release(*run);
    }
  };
  const Release at_end{collects ? &run_ : nullptr};
  const AloneScope alone;
  return f();
}

// Impulses on faces depend on each other everywhere.
template <int Dim>
void refuse_faces(GridRun<Dim>& run, const Model& model) {
  if (run.system().contact_at_faces)
    throw InputError(model.grid.origin,
                     "this model runs in a single process only, because it has contact impulses on faces; in "
                     "several processes they must be on nodes (<MultiMaterialMode Impulses='nodes'>)");
}

template <int Dim>
LeadingRun<Dim>::LeadingRun(const Model& model) : run_(model), moving_(run_.moving()) {
  refuse_faces(run_, model);
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
  return with_all_particles(false, false, [&] { return run_.look(); });
}

template <int Dim>
std::vector<std::string> LeadingRun<Dim>::remarks() const {
  return with_all_particles(false, false, [&] { return run_.remarks(); });
}

template <int Dim>
std::vector<std::string> LeadingRun<Dim>::choices() const {
  return with_all_particles(false, false, [&] { return run_.choices(); });
}

template <int Dim>
void LeadingRun<Dim>::save(RunState state, CheckpointWriter& to) {
  with_all_particles(false, true, [&] { run_.save(state, to); });
}

template <int Dim>
void LeadingRun<Dim>::open_results(const std::filesystem::path& folder, std::optional<double> resume_time,
                                   OutputQueue& queue) {
  with_all_particles(false, false, [&] { run_.open_results(folder, resume_time, queue); });
}

template <int Dim>
void LeadingRun<Dim>::write_history() {
  with_all_particles(false, false, [&] { run_.write_history(); });
}

template <int Dim>
void LeadingRun<Dim>::write_files(std::int64_t number) {
  with_all_particles(true, false, [&] { run_.write_files(number); });
}

template <int Dim>
std::map<std::string, std::string> LeadingRun<Dim>::facts() const {
  auto out = with_all_particles(false, false, [&] { return run_.facts(); });
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
    case Command::collect_view:
    case Command::collect_state:
      collect(run, what);
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
    refuse_faces(*run, model);
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
