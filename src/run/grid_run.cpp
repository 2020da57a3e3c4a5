// SPDX-License-Identifier: MIT
#include "run/grid_run.hpp"

#include "base/common_data.hpp"
#include "base/parallel.hpp"
#include "base/text.hpp"
#include "run/energy_balance.hpp"
#include "run/history_source.hpp"
#include "run/pore_pressure.hpp"
#include "solver/build.hpp"

#include <cmath>

namespace tribo {

template <int Dim>
GridRun<Dim>::GridRun(const Model& model)
    : model_(model),
      system_(build_system<Dim>(model, place_points(model))),
      stepper_(model, system_),
      exchange_(model, system_),
      step_size_(model, system_),
      monitor_(model, system_, stepper_, step_size_) {
  if (model.load_control) system_.load_controller.velocity = model.load_control->start;
  if (model.particles_change()) tracers_.emplace(model, system_);
}

template <int Dim>
void GridRun<Dim>::choose_threads(int wanted) const {
  set_threads(sensible_threads(wanted, particle_count(system_), system_.fields.size()));
}

template <int Dim>
double GridRun<Dim>::advance() {
  if (results_) results_->grid_nodes.reset();
  stepper_.forget_grid_kinetic();
  stepper_.sort_if_due();  // before sums over particles, whose ranges are the bins
  dt_ = step_size_.next(dt_);
  const double step = step_size_.up_to_end(std::min(dt_, stepper_.joints().stable_step()));
  stepper_.damping().update(step, [&] { return measure(system_).kinetic; });
  stepper_.advance(step);
  exchange_particles(step);
  if (model_.load_control) control_load(step);
  return step;
}

template <int Dim>
void GridRun<Dim>::control_load(double step) {
  const LoadControl& control = *model_.load_control;
  HistoryQuantity force;
  force.material = control.material;
  const RunEnergies none;
  const RunHistorySource<Dim> source(model_, system_, stepper_, force, {}, none, step);
  // a rigid material either prescribes velocities of nodes or is in contact
  const double load = source.reaction()[control.axis] - source.contact().last_force[control.axis];
  system_.load_controller.update(value_of_first_rank(load), system_.time, step, control);
}

template <int Dim>
StageBalance GridRun<Dim>::balance() {
  const Measures all = measure(system_);
  StageBalance out;
  out.content = energy_content(all, run_energies(model_, system_, stepper_, all));
  out.kinetic = all.kinetic, out.momentum = all.momentum;
  if (system_.blocks) out.of_blocks = system_.blocks->ledger().content();
  return out;
}

template <int Dim>
StageBalance GridRun<Dim>::end_stage() {
  stepper_.end_stage();
  return balance();
}

template <int Dim>
StageReport GridRun<Dim>::begin_stage(const Model& former, const std::vector<StageAction>& actions,
                                      const StageBalance& before) {
  StageReport report = tribo::begin_stage(model_, former, actions, system_, stepper_);
  report.energy = book_exchange(before);
  const double first = step_size_.first().size;
  dt_ = model_.time.adaptive ? std::min(dt_, first) : first;
  monitor_.state.first_step = dt_;
  restored_.stage_step = system_.step, restored_.stage_time = system_.time;
  return report;
}

// Books the energy and the momentum that particles brought or took away. Returns the energy.
template <int Dim>
double GridRun<Dim>::book_exchange(const StageBalance& before) {
  EnergyLedger& ledger = stepper_.ledger();
  ledger.first_kinetic += measure(system_).kinetic - before.kinetic;  // first, as the content follows from it
  const StageBalance after = balance();
  ledger.stages += after.content - before.content, ledger.impulse += after.momentum - before.momentum;
  restored_.initial_block_energy += after.of_blocks - before.of_blocks;
  return after.content - before.content;
}

template <int Dim>
void GridRun<Dim>::exchange_particles(double step) {
  if (!model_.particles_change() || !any_rank(exchange_.find(step))) return;
  Distribution<Dim>& distribution = stepper_.distribution();
  if (distribution.active()) {
    stepper_.keep_grid_kinetic(), collect_grid();
    distribution.unite(), exchange_.find_again();
  }
  const AloneScope with_all_particles;
  const StageBalance before = balance();
  exchange_.apply();
  book_exchange(before);
}

template <int Dim>
std::vector<std::string> GridRun<Dim>::look() {
  if (!results_) return {};
  return monitor_.look(dt_, results_->initial_energy, at_end());
}

template <int Dim>
void GridRun<Dim>::save(RunState run, CheckpointWriter& to) {
  run.dt = dt_, run.monitor = monitor_.state;
  run.stage_step = restored_.stage_step, run.stage_time = restored_.stage_time;
  if (results_) run.initial_energy = results_->initial_energy;
  if (results_ && results_->blocks) run.initial_block_energy = results_->blocks->initial_energy;
  save_state(run, system_, stepper_, to);
}

template <int Dim>
std::size_t GridRun<Dim>::particle_bytes() const {
  std::size_t sum = 0;
  for (const auto* list : {&system_.bodies, &system_.rigids})
    for (const auto& body : *list) sum += body.particles.size() * (body.particles.columns().size() + 1);
  return sum * sizeof(double);
}

// All ranks go on with the state of rank 0, which has all sums.
template <int Dim>
Checkpoint GridRun<Dim>::state_for_next_stage() {
  if (ranks().count() == 1) return Checkpoint(SteppedModel::save({}));
  std::vector<std::byte> state;
  collect(GridCollected::state);
  if (ranks().rank() == 0) {
    const AloneScope alone;
    state = SteppedModel::save({}).bytes();
  }
  release_collected();
  ranks().broadcast(state);
  return Checkpoint(std::span<const std::byte>(state));
}

template <int Dim>
void GridRun<Dim>::collect(GridCollected what) {
  if (stepper_.distribution().shares_all()) return;
  stepper_.keep_grid_kinetic();
  if (what == GridCollected::view && stepper_.contact().active()) {
    stepper_.distribution().refresh_ghosts();  // they have moved since the last transfer
    stepper_.contact().fill_view();
  }
  if (what == GridCollected::view) collect_grid();
  if (what == GridCollected::state) stepper_.contact().collect_faces();
  stepper_.distribution().collect();
  if (ranks().rank() > 0) return stepper_.forget_grid_kinetic();
  if (what == GridCollected::state) stepper_.contact().place_collected_faces();
  stepper_.contact().keep_view();
}

template <int Dim>
void GridRun<Dim>::collect_grid() {
  if (model_.output.grid_fields.empty()) return;
  auto nodes = collect_grid_nodes(system_);
  if (results_) results_->grid_nodes = std::move(nodes);
}

template <int Dim>
void GridRun<Dim>::release_collected() {
  stepper_.distribution().release();
  stepper_.contact().release();
  stepper_.forget_grid_kinetic();
}

template <int Dim>
RunState GridRun<Dim>::restore(const Checkpoint& checkpoint) {
  restored_ = load_state(checkpoint, system_, stepper_);
  dt_ = restored_.dt, monitor_.state = restored_.monitor;
  return restored_;
}

template <int Dim>
void GridRun<Dim>::open_results(const std::filesystem::path& folder, std::optional<double> resume_time,
                                OutputQueue& queue) {
  results_.emplace(model_, system_, stepper_, folder, resume_time, tracers_ ? *tracers_ : Tracers<Dim>(model_, system_),
                   queue);
  if (!resume_time) return;
  results_->initial_energy = restored_.initial_energy;
  if (results_->blocks) results_->blocks->initial_energy = restored_.initial_block_energy;
}

template <int Dim>
void GridRun<Dim>::write_history() {
  results_->write_history(dt_);
  if (model_.reversal && !model_.reversal->crack)
    system_.load_clock.look(results_->last_row().at(1 + model_.reversal->history), system_.time, *model_.reversal);
}

template <int Dim>
std::vector<Figure> GridRun<Dim>::figures() const {
  auto out = monitor_.energy_figures();
  if (!model_.reversal) return out;
  const bool length = model_.reversal->crack.has_value();
  const std::string what =
      length ? "a crack's length" : "'" + model_.output.history[model_.reversal->history].column + "'";
  const LoadClock& clock = system_.load_clock;
  const char* done[] = {"the loads went back", "the loads were held", "the run stopped", "cracks grew no further"};
  out.push_back({clock.is_turned() ? what + " passed its value at time " + format("%.6g", clock.turned) + ": " +
                                         done[static_cast<std::size_t>(model_.reversal->style)]
                                   : what + " has not passed the value of ReverseLoad"});
  return out;
}

template <int Dim>
std::vector<std::string> GridRun<Dim>::choices() const {
  std::vector<std::string> out;
  if (!system_.contact_reason.empty()) out.push_back("contact impulses: " + system_.contact_reason);
  if (system_.step > 0) return out;
  if (const std::string torn = torn_by_pressure(system_); !torn.empty()) out.push_back("warning: " + torn);
  if (!system_.blocks) return out;
  if (const std::string torn = torn_by_pressure(*system_.blocks); !torn.empty()) out.push_back("warning: " + torn);
  return out;
}

// Several bodies of one material are counted.
template <int Dim>
std::vector<RecordedBody> GridRun<Dim>::bodies() const {
  static constexpr std::size_t most = 200;
  std::map<int, int> all, counted;
  const auto material = [&](const PieceNumbers& p) {
    return model_.pieces[static_cast<std::size_t>(p.piece)].material;
  };
  for (const auto& piece : system_.pieces) ++all[material(piece)];
  if (system_.pieces.size() <= all.size() || system_.pieces.size() > most) return {};
  std::vector<RecordedBody> out;
  for (const auto& piece : system_.pieces) {
    const int k = material(piece);
    const std::string name = model_.materials[static_cast<std::size_t>(k)].name;
    out.push_back({all[k] == 1 ? name : name + " " + std::to_string(++counted[k]), piece.first, piece.last});
  }
  return out;
}

template <int Dim>
std::map<std::string, std::string> GridRun<Dim>::facts() const {
  std::map<std::string, std::string> out;
  for (const auto& body : system_.bodies) out["particles of " + body.name] = std::to_string(body.particles.size());
  if (!system_.contact_reason.empty()) out["contact impulses"] = system_.contact_reason;
  if (system_.blocks) out["blocks"] = std::to_string(system_.blocks->block_count());
  return out;
}

template <int Dim>
std::map<std::string, double> GridRun<Dim>::seconds_of(double) const {
  const StepWatches& w = stepper_.watches();
  const double contact = stepper_.contact().watch.seconds(), filter = stepper_.filter().watch.seconds();
  double named = contact + filter;
  for (const Stopwatch* watch : {&w.sort, &w.scatter, &w.grid, &w.gather}) named += watch->seconds();
  return {{"sorting", w.sort.seconds()},
          {"particles to nodes", w.scatter.seconds()},
          {"nodes", w.grid.seconds()},
          {"nodes to particles, stress", w.gather.seconds()},
          {"contact", contact},
          {"filter (XPIC, FMPM)", filter},
          {"looks at the state", monitor_.watch.seconds()},
          {"loads, heat, rest of the step", std::max(0.0, w.all.seconds() - named)}};
}

template <int Dim>
double GridRun<Dim>::largest_displacement() {
  double most = 0.0;
  for (auto& body : system_.bodies) {
    const auto x = body.particles.x(), origin = body.particles[body.origin];
    for (std::size_t i = 0; i < body.particles.size(); ++i) {
      double square = 0.0;
      for (std::size_t d = 0; d < Dim; ++d) square += (x[d][i] - origin[d][i]) * (x[d][i] - origin[d][i]);
      most = std::max(most, square);
    }
  }
  return std::sqrt(most);
}

template class GridRun<2>;
template class GridRun<3>;

}  // namespace tribo
