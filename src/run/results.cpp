// SPDX-License-Identifier: MIT
#include "run/results.hpp"

#include "base/parallel.hpp"
#include "model/quantities.hpp"
#include "run/energy_balance.hpp"
#include "run/grid_file.hpp"
#include "run/history_source.hpp"
#include "run/joint_columns.hpp"
#include "run/particle_fields.hpp"
#include "run/result_folder.hpp"

#include <cmath>

namespace tribo {
namespace {

std::vector<std::string> energy_columns(const Model& model) {
  const HeatSpec& heat = model.heat;
  std::vector<std::string> columns{"time",      "kinetic",   "elastic",       "plastic",       "potential",
                                   "contact",   "interface", "external_work", "boundary_work", "damping",
                                   "transfer",  "residual",  "momentum_x",    "momentum_y",    "momentum_z",
                                   "impulse_x", "impulse_y", "impulse_z"};
  if (heat.kept) columns.insert(columns.end(), {"heat", "heat_supplied", "contact_heat", "work_heat"});
  if (heat.expansion) columns.emplace_back("expansion");
  if (model.particles_change()) columns.emplace_back("stages");
  return columns;
}

// By Hooke's law. Laws that do not dissipate have no other strain than the elastic one.
Mat3 elastic_strain(const Material& law, const std::optional<ElasticModuli>& moduli, const Measures& m) {
  if (law.dissipation_index() < 0 || !moduli) return m.strain;
  return (m.stress - moduli->nu / (1 + moduli->nu) * m.stress.trace() * Mat3::Identity()) / (2 * moduli->G);
}

std::vector<std::string> event_columns() {
  std::vector<std::string> columns{"time", "joint", "point", "x", "y", "z"};
  for (const auto& name : joint_event_columns()) columns.push_back(name);
  return columns;
}

const std::vector<std::string> tip_columns{"time", "crack", "end", "x", "y", "length", "J", "K1", "K2", "released"};

}  // namespace

template <int Dim>
Results<Dim>::Results(const Model& model, System<Dim>& system, Stepper<Dim>& stepper, std::filesystem::path folder,
                      std::optional<double> resume_time, Tracers<Dim> tracers, OutputQueue& queue)
    : model_(model),
      system_(system),
      stepper_(stepper),
      tracers_(std::move(tracers)),
      folder_(std::move(folder)),
      queue_(queue),
      particles_(folder_ / "run.pvd"),
      grid_(folder_ / "grid.pvd"),
      cracks_(folder_ / "cracks.pvd"),
      joints_(folder_ / "joints.pvd"),
      all_(folder_ / "all.pvd") {
  if (model.output.wants_elastic_strain())
    for (const auto& body : system.bodies) moduli_.push_back(elastic_moduli(*body.law));
  std::vector<std::string> columns{"time"};
  for (const auto& q : model.output.history) columns.push_back(q.column);
  if (system.blocks) {
    // Blocks count their time themselves, which may differ in the last digit.
    blocks.emplace(model, *system.blocks, folder_, resume_time ? std::optional(system.blocks->time) : std::nullopt,
                   queue);
    for (const auto& column : BlockResults::columns(model)) columns.push_back(column);
  }
  if (!resume_time) {
    // Here and not with the first row of the histories, which may begin later
    const Measures all = measure(system);
    initial_energy = energy_content(all, run_energies(model, system, stepper, all));
    history_.emplace(folder_ / "history.csv", columns, &queue);
    energy_.emplace(folder_ / "energy.csv", energy_columns(model), &queue);
    if (!system.joints.empty()) events_.emplace(folder_ / "events.csv", event_columns(), &queue);
    if (model.fracture) tips_.emplace(folder_ / "tips.csv", tip_columns, &queue);
    return;
  }
  history_.emplace(History::resume(folder_ / "history.csv", columns, *resume_time, &queue));
  energy_.emplace(History::resume(folder_ / "energy.csv", energy_columns(model), *resume_time, &queue));
  particles_.resume(*resume_time);
  if (has_several_kinds(system)) all_.resume(*resume_time);
  if (!model.output.grid_fields.empty()) grid_.resume(*resume_time);
  if (!system.cracks.empty()) cracks_.resume(*resume_time);
  if (model.fracture) tips_.emplace(History::resume(folder_ / "tips.csv", tip_columns, *resume_time, &queue));
  if (system.joints.empty()) return;
  joints_.resume(*resume_time);
  events_.emplace(History::resume(folder_ / "events.csv", event_columns(), *resume_time, &queue));
}

template <int Dim>
ResultNames Results<Dim>::names(const Model& model, const System<Dim>& system) {
  ResultNames out{{"run.pvd"}, {"particles"}};
  if (!model.output.grid_fields.empty()) out.add({{"grid.pvd"}, {"grid"}});
  if (!system.cracks.empty()) out.add({{"cracks.pvd"}, {"cracks"}});
  if (!system.joints.empty()) out.add({{"joints.pvd", "events.csv"}, {"joints"}});
  if (model.fracture) out.add({{"tips.csv"}, {}});
  if (system.blocks) out.add(BlockResults::names(model));
  if (has_several_kinds(system)) out.add({{"all.pvd"}, {}});
  return out;
}

template <int Dim>
bool Results<Dim>::has_several_kinds(const System<Dim>& system) {
  return !system.cracks.empty() || !system.joints.empty() || system.blocks;
}

template <int Dim>
std::vector<Body<Dim>*> Results<Dim>::written_bodies() {
  std::vector<Body<Dim>*> out;
  for (auto* list : {&system_.bodies, &system_.rigids})
    for (auto& body : *list)
      if (body.block < 0) out.push_back(&body);
  return out;
}

template <int Dim>
std::shared_ptr<const ParticleFields<Dim>> Results<Dim>::fields(const std::vector<std::string>& names,
                                                                Precision precision) {
  stepper_.contact().fill_view();
  return std::make_shared<const ParticleFields<Dim>>(model_, written_bodies(), names, precision);
}

// Large models are written without a copy of all particles: some blocks at a time, while the run waits.
template <int Dim>
void Results<Dim>::write_particles(std::int64_t number) {
  stepper_.contact().fill_view();
  const auto& wanted = model_.output.particle_fields;
  const auto names = wanted.empty() ? standard_particle_fields() : wanted;
  const auto precision = model_.output.double_precision ? Precision::full : Precision::single;
  const auto bodies = written_bodies();
  const ParticleBlocks<Dim> in_files(model_, bodies, system_.pieces);
  std::vector<std::string> materials;
  for (std::size_t m = 0; m < model_.materials.size(); ++m)
    if (model_.contact.kind(static_cast<int>(m)) == static_cast<int>(m)) materials.push_back(model_.materials[m].name);
  const std::string file = "particles/" + numbered(number, ".vtm");

  const auto copy = [&](std::span<const ParticleRange<Dim>> ranges) {
    return ParticleFields<Dim>(model_, bodies, ranges, names, precision);
  };
  const auto job = [&](std::size_t k) {
    return [all = std::make_shared<const ParticleFields<Dim>>(copy(in_files.ranges(k))), materials,
            path = file_of_block(folder_ / file, in_files.blocks()[k]), time = system_.time] {
      tribo::write_particles(path, all->count(), all->positions(), all->fields(), time, materials);
    };
  };
  const std::size_t block_count = in_files.blocks().size();
  std::size_t count = 0, largest = 1;
  for (std::size_t k = 0; k < block_count; ++k)
    count += in_files.count(k), largest = std::max(largest, in_files.count(k));
  const std::size_t row = copy({}).bytes_of_particle();
  if (count * row <= queue_.most_copied()) {
    for (std::size_t k = 0; k < block_count; ++k) queue_.add(in_files.count(k) * row, job(k));
  } else {
    queue_.drain();
    const std::size_t at_once = std::max<std::size_t>(1, OutputQueue::most_of_parts / (largest * row));
    for (std::size_t first = 0; first < block_count; first += at_once)
      parallel_for(static_cast<std::ptrdiff_t>(std::min(at_once, block_count - first)),
                   [&](std::ptrdiff_t k) { job(first + static_cast<std::size_t>(k))(); });
  }
  queue_.add(0, [path = folder_ / file, list = in_files.blocks()] { write_block_list(path, list); });
  particles_.add(system_.time, file, &queue_);
}

template <int Dim>
void Results<Dim>::write_files(std::int64_t number) {
  queue_.begin(system_.step);
  write_particles(number);
  if (!model_.output.grid_fields.empty()) write_grid(number);
  if (!system_.cracks.empty()) write_cracks(number);
  if (!system_.joints.empty()) write_joints(number);
  if (blocks) blocks->write_files(number);
  if (!has_several_kinds(system_)) return;
  const auto part = [&](const std::string& kind, const std::string& extension) {
    return Collection::Part{kind, kind + "/" + numbered(number, extension)};
  };
  std::vector<Collection::Part> parts{part("particles", ".vtm")};
  if (!system_.cracks.empty()) parts.push_back(part("cracks", ".vtp"));
  if (!system_.joints.empty()) parts.push_back(part("joints", ".vtp"));
  if (blocks) parts.push_back(part("blocks", ".vtp")), parts.push_back(part("contacts", ".vtp"));
  all_.add(system_.time, parts, &queue_);
}

template <int Dim>
void Results<Dim>::write_grid(std::int64_t number) {
  const std::string file = "grid/" + numbered(number, ".vti");
  auto all = std::make_shared<const GridFile>(model_, system_, grid_nodes ? &*grid_nodes : nullptr);
  queue_.add(all->bytes(), [all, path = folder_ / file] { all->write(path); });
  grid_.add(system_.time, file, &queue_);
}

template <int Dim>
void Results<Dim>::write_history(double dt) {
  const bool strain = model_.output.wants_strain();
  std::vector<Measures> bodies;
  const Measures all = measure_all(system_, strain, bodies);
  const RunEnergies l = run_energies(model_, system_, stepper_, all);

  std::vector<double> row{system_.time};
  for (std::size_t k = 0; k < model_.output.history.size(); ++k) {
    const HistoryQuantity& q = model_.output.history[k];
    const QuantityInfo* info = find_global_quantity(q.name);
    if (!info) throw std::logic_error("no such quantity: " + q.name);
    Measures m = measures_of(k, all, bodies);
    if (is_elastic_strain(*info)) add_elastic_strain(k, bodies, m);
    if (q.variable >= 0) m.variable = mean_variable(k);
    row.push_back(info->value(RunHistorySource<Dim>(model_, system_, stepper_, q, m, l, dt)));
  }
  if (blocks) {
    for (const double value : blocks->values(dt)) row.push_back(value);
    blocks->write_history(dt);
  }
  history_->add(row);
  stepper_.contact().ledger().start_means();
  row_ = std::move(row);
  write_tips();

  Vec3 impulse = stepper_.ledger().impulse + stepper_.contact().ledger().rigid_impulse;
  for (std::size_t f = 0; f < system_.fields.size(); ++f) impulse += stepper_.conditions(f).impulse();
  std::vector<double> energies{system_.time,    all.kinetic, all.stored,  all.dissipated,
                               l.potential,     l.contact,   l.interface, l.external_work,
                               l.boundary_work, l.damping,   l.transfer,  energy_residual(all, l, initial_energy)};
  energies.insert(energies.end(), all.momentum.begin(), all.momentum.end());
  energies.insert(energies.end(), impulse.begin(), impulse.end());
  if (model_.heat.kept)
    energies.insert(energies.end(), {all.heat, stepper_.heat().supplied, stepper_.heat().from_contact, all.work_heat});
  if (model_.heat.expansion) energies.push_back(all.expansion);
  if (model_.particles_change()) energies.push_back(l.stages);
  energy_->add(energies);
}

template <int Dim>
Measures Results<Dim>::measures_of(std::size_t k, const Measures& all, const std::vector<Measures>& bodies) const {
  const HistoryQuantity& q = model_.output.history[k];
  if (q.point) return tracers_.measure(system_, k, model_.output.wants_strain());
  if (q.material < 0) return all;
  if (model_.materials[static_cast<std::size_t>(q.material)].separate)
    return measure(system_, model_.output.wants_strain(), q.material);
  for (std::size_t b = 0; b < system_.bodies.size(); ++b)
    if (system_.bodies[b].material == q.material) return bodies[b];
  for (auto& body : system_.rigids)
    if (body.material == q.material && body.block < 0) return measure(body);
  return {};
}

// The mean of all bodies is weighted by their volumes, as that of the strain.
template <int Dim>
void Results<Dim>::add_elastic_strain(std::size_t k, const std::vector<Measures>& bodies, Measures& m) const {
  const HistoryQuantity& q = model_.output.history[k];
  if (q.point) {
    const auto body = tracers_.deformable_body(k);
    if (body) m.elastic = elastic_strain(*system_.bodies[*body].law, moduli_[*body], m);
    return;
  }
  double volume = 0.0;
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    if (q.material >= 0 && system_.bodies[b].material != q.material) continue;
    m.elastic += bodies[b].volume * elastic_strain(*system_.bodies[b].law, moduli_[b], bodies[b]);
    volume += bodies[b].volume;
  }
  if (volume > 0) m.elastic /= volume;
}

template <int Dim>
double Results<Dim>::mean_variable(std::size_t k) const {
  const HistoryQuantity& q = model_.output.history[k];
  const auto column = static_cast<std::size_t>(q.variable);
  const auto values_of = [&](const Body<Dim>& body) { return body.particles.column(body.history + column); };
  const auto has_variable = [&](const Body<Dim>& body) {
    return body.material == q.material && column < body.law->history().size();
  };
  if (q.point) {
    const auto found = tracers_.deformable_body(k);
    if (!found || !has_variable(system_.bodies[*found])) return 0.0;
    const Body<Dim>& body = system_.bodies[*found];
    const std::size_t particle = tracers_.particle(system_, k);
    return particle < body.particles.size() ? values_of(body)[particle] : 0.0;
  }
  double sum = 0.0, volume = 0.0;
  for (auto& body : system_.bodies) {
    if (!has_variable(body)) continue;
    const double* values = values_of(body);
    const double* volumes = body.particles.volume();
    for (std::size_t i = 0; i < body.particles.size(); ++i) sum += volumes[i] * values[i], volume += volumes[i];
  }
  return volume > 0 ? sum / volume : 0.0;
}

template class Results<2>;
template class Results<3>;

}  // namespace tribo
