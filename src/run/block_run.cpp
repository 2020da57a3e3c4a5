// SPDX-License-Identifier: MIT
#include "run/block_run.hpp"

#include "base/error.hpp"
#include "base/memory.hpp"
#include "base/parallel.hpp"
#include "base/text.hpp"
#include "run/pore_pressure.hpp"

#include <algorithm>
#include <cmath>

namespace tribo {

Assembly assemble(const Model& model) {
  const auto build = [&] {
    return Assembly(model.blocks, model.dimension(), model.analysis == Analysis::plane_stress, model.body_force.gravity,
                    model.time.max_step);
  };
  return with_memory_for("the blocks", model.blocks->origin, build);
}

BlockSteps steps_of(const Model& model, const Assembly& blocks, double from) {
  BlockSteps out;
  const double time = model.time.next_end() - from, steps = time / blocks.critical_step();
  if (!(steps <= 1e12))
    throw InputError(
        model.blocks->origin,
        "the blocks would need " + std::to_string(steps) +
            " time steps; at most 1e12 are possible. Are the units of the stiffnesses and densities right?");
  out.count = static_cast<std::int64_t>(std::ceil(time / blocks.critical_step() * (1 - 1e-12)));
  out.size = time / static_cast<double>(std::max<std::int64_t>(1, out.count));
  return out;
}

int sensible_block_threads(int wanted, std::size_t contacts) {
  static constexpr std::size_t worthwhile = 2000;
  return std::max(1, std::min(wanted, static_cast<int>(1 + contacts / worthwhile)));
}

BlockRun::BlockRun(const Model& model) : model_(model), blocks_(assemble(model)), steps_(steps_of(model, blocks_)) {}

void BlockRun::choose_threads(int wanted) const {
  set_threads(sensible_block_threads(wanted, blocks_.contacts.size()));
}

double BlockRun::advance() {
  blocks_.advance(steps_.size);
  if (!blocks_.is_finite())
    throw SimulationError("the motion of the blocks grew without bound at time " + std::to_string(blocks_.time) +
                          "; damp it, or make the step smaller ('step' of <Blocks>)");
  return steps_.size;
}

std::vector<std::string> BlockRun::look() {
  if (!results_ || (!monitor_.is_due(blocks_.step, steps_.size, model_.time.end) && !at_end())) return {};
  const BlockLedger energy = blocks_.ledger();
  const auto gained = [](double x) { return std::max(0.0, x); };
  const double initial = results_->initial_energy;
  // A pore pressure does work on the faces that it separates: what contacts release then becomes negative.
  const bool has_pressure = std::any_of(blocks_.groups.begin(), blocks_.groups.end(),
                                        [](const ContactGroup& g) { return g.law->has_pore_pressure(); });
  const double of_pressure = has_pressure ? gained(-energy.released) : 0.0;
  const double supplied =
      initial + gained(energy.outer_work) + gained(energy.boundary_work) + gained(-energy.potential) + of_pressure;
  const double residual =
      energy.content() - initial - energy.outer_work - energy.boundary_work - restored_.block_stages;
  // of the sums over many steps, as in runs with a grid
  const double rounding =
      1e-9 * std::max({energy.kinetic, energy.strain, std::abs(energy.potential), energy.slip, energy.dashpot,
                       energy.damping, std::abs(energy.outer_work), std::abs(energy.boundary_work)});
  // The fictitious stress is no elastic force where bonds have broken or vibrations grow: what it releases may become
  // negative.
  const double unexplained = residual + gained(-energy.released) - of_pressure;
  if (!monitor_.record_balance({supplied, unexplained, 0.0, 0.0, rounding}, blocks_.time)) return {};
  return remarks();
}

std::vector<std::string> BlockRun::choices() const {
  const std::string torn = blocks_.step > 0 ? std::string() : torn_by_pressure(blocks_);
  return torn.empty() ? std::vector<std::string>{} : std::vector{"warning: " + torn};
}

std::vector<std::string> BlockRun::remarks() const {
  const Finding& f = monitor_.of(Sign::energy);
  if (!f.seen) return {};
  const bool fictitious =
      blocks_.ledger().released < 0 && std::any_of(blocks_.groups.begin(), blocks_.groups.end(),
                                                   [](const ContactGroup& g) { return g.law->poisson() != 0; });
  return {format("energy: %.3g %% of what was supplied came from %s until time %.4g: ", 100 * f.worst,
                 fictitious ? "the fictitious stress of Poisson's ratio" : "nowhere", f.time) +
          (fictitious ? "'damping' if blocks vibrate; after failure compare with Poisson's ratio 0"
                      : "a smaller 'step' of <Blocks>, or 'damping'")};
}

void BlockRun::check() {
  if (blocks_.step % steps_per_check != 0 && !at_end()) return;
  blocks_.check_contacts();
}

StageBalance BlockRun::end_stage() {
  StageBalance out;
  out.content = out.of_blocks = blocks_.ledger().content();
  return out;
}

StageReport BlockRun::begin_stage(const Model& former, const std::vector<StageAction>& actions,
                                  const StageBalance& before) {
  StageReport report;
  tribo::begin_stage(model_, former, actions, blocks_, report);
  report.energy = blocks_.ledger().content() - before.content;
  restored_.block_stages += report.energy;
  restored_.stage_step = blocks_.step, restored_.stage_time = blocks_.time;
  steps_ = steps_of(model_, blocks_, blocks_.time);
  return report;
}

void BlockRun::save(RunState run, CheckpointWriter& to) {
  run.monitor = monitor_;
  run.stage_step = restored_.stage_step, run.stage_time = restored_.stage_time;
  run.block_stages = restored_.block_stages;
  if (results_) run.initial_block_energy = results_->initial_energy;
  save_state(run, blocks_, to);
}

RunState BlockRun::restore(const Checkpoint& checkpoint) {
  restored_ = load_state(checkpoint, blocks_);
  monitor_ = restored_.monitor;
  steps_ = steps_of(model_, blocks_, restored_.stage_time);
  return restored_;
}

void BlockRun::open_results(const std::filesystem::path& folder, std::optional<double> resume_time,
                            OutputQueue& queue) {
  results_.emplace(model_, blocks_, folder, resume_time, queue);
  if (resume_time) results_->initial_energy = restored_.initial_block_energy;
  results_->stages = restored_.block_stages;
}

std::map<std::string, std::string> BlockRun::facts() const {
  return {{"blocks", std::to_string(blocks_.block_count())}, {"contacts", std::to_string(blocks_.contacts.size())}};
}

}  // namespace tribo
