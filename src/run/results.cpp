// SPDX-License-Identifier: MIT
#include "run/results.hpp"

#include "base/text.hpp"
#include "run/particle_fields.hpp"

#include <cmath>
#include <cstdio>

namespace tribo {
namespace {

std::vector<std::string> energy_columns(bool heat) {
  std::vector<std::string> columns{"time",      "kinetic",    "elastic",       "plastic",       "potential",
                                   "contact",   "interface",  "external_work", "boundary_work", "damping",
                                   "residual",  "momentum_x", "momentum_y",    "momentum_z",    "impulse_x",
                                   "impulse_y", "impulse_z"};
  if (heat) columns.insert(columns.end(), {"heat", "heat_supplied", "contact_heat", "work_heat"});
  return columns;
}

const std::vector<std::string> event_columns{"time", "joint", "point", "x",        "y",
                                             "z",    "event", "mode",  "strength", "energy"};
const std::vector<std::string> tip_columns{"time", "crack", "end", "x", "y", "length", "J", "K1", "K2"};

}  // namespace

std::string numbered(std::int64_t number, const std::string& extension) {
  char digits[32];
  std::snprintf(digits, sizeof digits, "run_%06lld", static_cast<long long>(number));
  return digits + extension;
}

template <int Dim>
Results<Dim>::Results(const Model& model, System<Dim>& system, Stepper<Dim>& stepper, std::filesystem::path folder,
                      std::optional<double> resume_time)
    : model_(model),
      system_(system),
      stepper_(stepper),
      tracers_(model, system),
      folder_(std::move(folder)),
      particles_(folder_ / "run.pvd"),
      grid_(folder_ / "grid.pvd"),
      cracks_(folder_ / "cracks.pvd"),
      joints_(folder_ / "joints.pvd") {
  std::vector<std::string> columns{"time"};
  for (const auto& q : model.output.history) columns.push_back(q.column);
  if (system.blocks) {
    blocks.emplace(model, *system.blocks, folder_, resume_time);
    for (const auto& column : BlockResults::columns(model)) columns.push_back(column);
  }
  if (!resume_time) {
    history_.emplace(folder_ / "history.csv", columns);
    energy_.emplace(folder_ / "energy.csv", energy_columns(model.heat.kept));
    if (!system.joints.empty()) events_.emplace(folder_ / "events.csv", event_columns);
    if (model.fracture) tips_.emplace(folder_ / "tips.csv", tip_columns);
    return;
  }
  history_.emplace(History::resume(folder_ / "history.csv", columns, *resume_time));
  energy_.emplace(History::resume(folder_ / "energy.csv", energy_columns(model.heat.kept), *resume_time));
  particles_.resume(*resume_time);
  if (!model.output.grid_fields.empty()) grid_.resume(*resume_time);
  if (!system.cracks.empty()) cracks_.resume(*resume_time);
  if (model.fracture) tips_.emplace(History::resume(folder_ / "tips.csv", tip_columns, *resume_time));
  if (system.joints.empty()) return;
  joints_.resume(*resume_time);
  events_.emplace(History::resume(folder_ / "events.csv", event_columns, *resume_time));
}

template <int Dim>
void Results<Dim>::write_particles(std::int64_t number) {
  stepper_.contact().fill_view();
  std::vector<Body<Dim>*> bodies;
  for (auto* list : {&system_.bodies, &system_.rigids})
    for (auto& body : *list)
      if (body.block < 0) bodies.push_back(&body);
  const auto& wanted = model_.output.particle_fields;
  const ParticleFields<Dim> all(model_, bodies, wanted.empty() ? ParticleFields<Dim>::standard() : wanted);
  const std::string file = "particles/" + numbered(number, ".vtp");
  tribo::write_particles(folder_ / file, all.count(), all.positions(), all.fields(), system_.time);
  particles_.add(system_.time, file);
  if (!model_.output.grid_fields.empty()) write_grid(number);
  if (!system_.cracks.empty()) write_cracks(number);
  if (!system_.joints.empty()) write_joints(number);
  if (blocks) blocks->write_pictures(number);
}

template <int Dim>
void Results<Dim>::write_grid(std::int64_t number) {
  const auto& lattice = system_.lattice;
  const auto& field = system_.fields[0];
  std::array<double, 3> origin{}, spacing{1, 1, 1};
  std::array<int, 3> nodes{1, 1, 1};
  std::size_t count = 1;
  for (std::size_t d = 0; d < Dim; ++d) {
    origin[d] = model_.grid.low[d];
    spacing[d] = lattice.spacing[static_cast<Eigen::Index>(d)];
    nodes[d] = model_.grid.cells[d] + 1;
    count *= static_cast<std::size_t>(nodes[d]);
  }
  std::vector<double> mass(count, 0.0);
  std::array<std::vector<double>, 3> velocity{mass, mass, mass};
  std::size_t at = 0;
  for (int k = 0; k < nodes[2]; ++k)
    for (int j = 0; j < nodes[1]; ++j)
      for (int i = 0; i < nodes[0]; ++i, ++at) {
        Index<Dim> n{};
        n[0] = i + Lattice<Dim>::padding, n[1] = j + Lattice<Dim>::padding;
        if constexpr (Dim == 3) n[2] = k + Lattice<Dim>::padding;
        const auto position = field.map.node(n);
        if (position < 0 || field.nodes.empty()) continue;
        const Node& node = field.nodes[static_cast<std::size_t>(position)];
        mass[at] = node.mass;
        if (node.mass > 0)
          for (std::size_t d = 0; d < Dim; ++d) velocity[d][at] = node.velocity[d];
      }
  std::vector<OutputField> fields;
  for (const auto& name : model_.output.grid_fields) {
    if (name == "mass") fields.push_back({name, {mass.data()}, nullptr});
    if (name == "velocity")
      fields.push_back({name, {velocity[0].data(), velocity[1].data(), velocity[2].data()}, nullptr});
  }
  const std::string file = "grid/" + numbered(number, ".vti");
  tribo::write_grid(folder_ / file, origin, spacing, nodes, fields, system_.time);
  grid_.add(system_.time, file);
}

template <int Dim>
Ledgers Results<Dim>::ledgers(const Measures& all) const {
  Ledgers l;
  // Mass times the displacement of the centre of mass
  l.potential = -all.mass * model_.body_force.gravity.dot(all.displacement);
  l.external_work = stepper_.ledger().external_work;
  l.damping = stepper_.ledger().damping_work;
  l.boundary_work = stepper_.ledger().rigid_work;
  const PairLedger contact = stepper_.contact().ledger().total();
  l.interface = contact.stored;
  l.contact = contact.friction + contact.impact + contact.interface - contact.stored;
  const auto joints = stepper_.joints().energies();
  l.interface += joints.stored, l.contact += joints.lost;
  l.boundary_work += stepper_.contact().ledger().rigid_work;
  for (std::size_t f = 0; f < system_.fields.size(); ++f) l.boundary_work += stepper_.conditions(f).work();
  return l;
}

template <int Dim>
void Results<Dim>::write_history(double dt) {
  const bool strain = model_.output.wants_strain();
  const Measures all = measure(system_, strain);
  std::vector<Measures> bodies;
  for (auto& body : system_.bodies) bodies.push_back(measure(body, strain));
  const Ledgers l = ledgers(all);

  std::vector<double> row{system_.time};
  for (std::size_t k = 0; k < model_.output.history.size(); ++k)
    row.push_back(quantity(model_.output.history[k], measures_of(k, all, bodies), l, dt));
  if (blocks) {
    for (const double value : blocks->values(dt)) row.push_back(value);
    blocks->write_history(dt);
  }
  history_->add(row);
  write_tips();

  const double content = all.kinetic + all.stored + all.dissipated + l.potential + l.damping + l.contact + l.interface;
  if (system_.step == 0) initial_energy = content;
  Vec3 impulse = stepper_.ledger().impulse + stepper_.contact().ledger().rigid_impulse;
  for (std::size_t f = 0; f < system_.fields.size(); ++f) impulse += stepper_.conditions(f).impulse();
  std::vector<double> energies{system_.time,
                               all.kinetic,
                               all.stored,
                               all.dissipated,
                               l.potential,
                               l.contact,
                               l.interface,
                               l.external_work,
                               l.boundary_work,
                               l.damping,
                               content - initial_energy - l.external_work - l.boundary_work};
  energies.insert(energies.end(), all.momentum.begin(), all.momentum.end());
  energies.insert(energies.end(), impulse.begin(), impulse.end());
  if (model_.heat.kept)
    energies.insert(energies.end(), {all.heat, stepper_.heat().supplied, stepper_.heat().from_contact, all.work_heat});
  energy_->add(energies);
}

template <int Dim>
Measures Results<Dim>::measures_of(std::size_t k, const Measures& all, const std::vector<Measures>& bodies) const {
  const HistoryQuantity& q = model_.output.history[k];
  if (q.point) return tracers_.measure(system_, k, model_.output.wants_strain());
  if (q.material < 0) return all;
  for (std::size_t b = 0; b < system_.bodies.size(); ++b)
    if (system_.bodies[b].material == q.material) return bodies[b];
  return {};
}

template <int Dim>
double Results<Dim>::quantity(const HistoryQuantity& q, const Measures& m, const Ledgers& ledgers, double dt) const {
  const std::string name = lower(q.name);
  const auto axis = [&](const std::string& stem) {
    return name.size() == stem.size() + 1 && name.rfind(stem, 0) == 0 ? name.back() - 'x' : -1;
  };
  const Vec3 velocity = m.mass > 0 ? Vec3(m.momentum / m.mass) : Vec3(Vec3::Zero());
  if (const int d = axis("vel"); d >= 0) return velocity[d];
  if (const int d = axis("disp"); d >= 0) return m.displacement[d];
  if (const int d = axis("pos"); d >= 0) return m.centre[d];
  if (const int d = axis("min"); d >= 0) return m.low[d];
  if (const int d = axis("max"); d >= 0) return m.high[d];
  if (const int d = axis("lp"); d >= 0) return m.angular_momentum[d];
  if (const int d = axis("reaction"); d >= 0) return reaction(q)[d];
  if (const int d = axis("contact"); d >= 0) return contact_of(q).force[d];
  if (name == "friction work") return contact_of(q).friction;
  if (name == "impact work") return contact_of(q).impact;
  if (name == "interface energy") return contact_of(q).stored;
  if (name == "contact area") return contact_of(q).area;
  if (name == "temperature") return m.temperature;
  if (name == "heat energy") return m.heat;
  if (name == "heat supplied") return stepper_.heat().supplied;
  if (name == "contact heat") return stepper_.heat().from_contact;
  if (name == "work heat") return m.work_heat;
  if (const int d = axis("p"); d >= 0) return m.momentum[d];
  if (name.size() == 3 && name[0] == 'e') return m.strain(name[1] - 'x', name[2] - 'x');
  if (name.size() == 3 && name[0] == 's') return m.stress(name[1] - 'x', name[2] - 'x');
  if (name == "pressure") return -m.stress.trace() / 3.0;
  if (name == "kinetic energy") return m.kinetic;
  if (name == "strain energy") return m.stored;
  if (name == "plastic energy") return m.dissipated;
  if (name == "internal energy") return m.stored + m.heat;
  if (name == "potential energy") return ledgers.potential;
  if (name == "external work") return ledgers.external_work;
  if (name == "boundary work") return ledgers.boundary_work;
  if (name == "damping energy") return ledgers.damping;
  if (name == "mass") return m.mass;
  if (name == "volume") return m.volume;
  if (name == "particles") return static_cast<double>(m.particles);
  if (name == "alpha") return stepper_.damping().grid;
  if (name == "palpha") return stepper_.damping().particle;
  if (name == "step number") return static_cast<double>(system_.step);
  if (name == "time step") return dt;
  throw std::logic_error("no such quantity: " + q.name);
}

// Force on the material: of a rigid body, of the conditions or the symmetry plane with an id, or of all but the planes.
template <int Dim>
Vec3 Results<Dim>::reaction(const HistoryQuantity& q) const {
  Vec3 sum = Vec3::Zero();
  const auto& rigid = stepper_.rigid_bodies().reactions();
  for (std::size_t r = 0; r < rigid.size(); ++r)
    if (q.material >= 0 ? system_.rigids[r].material == q.material : q.condition_id == 0) sum += rigid[r];
  if (q.material >= 0) return sum;
  for (std::size_t f = 0; f < system_.fields.size(); ++f) {
    const auto& conditions = stepper_.conditions(f);
    for (std::size_t c = 0; c < model_.node_conditions.size(); ++c)
      if (q.condition_id == 0 || model_.node_conditions[c].id == q.condition_id) sum += conditions.reactions()[c];
    for (int axis = 0; axis < Dim; ++axis)
      for (int side = 0; side < 2; ++side)
        if (q.condition_id == symmetry_plane_id(axis, side))
          sum[axis] += stepper_.exchange(f).plane_reaction(axis, side);
  }
  return sum;
}

// Sum over the pairs that a quantity asks for; force on its material, or on the first of each pair.
template <int Dim>
PairLedger Results<Dim>::contact_of(const HistoryQuantity& q) const {
  const auto is_of = [&](std::size_t field, int material) {
    for (auto* list : {&system_.bodies, &system_.rigids})
      for (const auto& body : *list)
        if (body.field == field && body.material == material) return true;
    return false;
  };
  PairLedger sum;
  for (const auto& [pair, entry] : stepper_.contact().ledger().pairs) {
    double sign = 1.0;
    if (q.material >= 0) {
      const bool first = is_of(pair.first, q.material);
      if (!first && !is_of(pair.second, q.material)) continue;
      if (q.other >= 0 && !is_of(first ? pair.second : pair.first, q.other)) continue;
      sign = first ? 1.0 : -1.0;
    }
    sum.force += sign * entry.force;
    sum.friction += entry.friction, sum.impact += entry.impact, sum.stored += entry.stored, sum.area += entry.area;
  }
  return sum;
}

template class Results<2>;
template class Results<3>;

}  // namespace tribo
