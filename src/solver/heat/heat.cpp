// SPDX-License-Identifier: MIT
#include "solver/heat/heat.hpp"

#include "base/ranks.hpp"
#include "grid/loops.hpp"
#include "grid/select.hpp"
#include "solver/loads/face_points.hpp"
#include "solver/loads/loaded.hpp"

#include <algorithm>
#include <cmath>

namespace tribo {
template <int Dim>
HeatConduction<Dim>::HeatConduction(const Model& model, System<Dim>& system, const SystemLoops<Dim>& loops,
                                    SystemTransfers<Dim>& transfers)
    : model_(model), system_(system), loops_(loops), transfers_(transfers), active_(model.heat.conduction) {
  if (!active_) return;
  Problems problems;
  for (std::size_t c = 0; c < model.temperature_conditions.size(); ++c) {
    const std::size_t before = prescribed_.size();
    each_node_in<Dim>(system.lattice, *model.temperature_conditions[c].where, [&](const Index<Dim>& node) {
      prescribed_.push_back({node, c});
    });
    if (prescribed_.size() == before)
      problems.add(model.temperature_conditions[c].origin, "this condition selects no node of the grid");
  }
  problems.raise();
}

template <int Dim>
void HeatConduction<Dim>::locate() {
  if (!active_) return;
  for (auto& field : system_.fields) {
    field.heat.resize(field.nodes.size());
    zero(field.heat);  // later only those that are reached
  }
}

template <int Dim>
void HeatConduction<Dim>::conduct(double dt, const Contact<Dim>& contact, const Exchanges<Dim>& exchanges) {
  if (!active_) return;
  if (system_.step == 0) {  // there is no previous step that computed the particle gradients
    find_rates(0.0, contact, exchanges);
    equalize_contact(contact);
    update_particles(0.0, exchanges);
  }
  find_rates(dt, contact, exchanges);
  equalize_contact(contact);
  impose_temperatures(dt, exchanges);
  update_particles(dt, exchanges);
  reduce_residual(dt, contact, exchanges);
}

// Calls f(node) for the nodes of all fields that particles may reach.
template <int Dim>
template <class F>
void HeatConduction<Dim>::each_node(F&& f) {
  loops_.each_range([&](std::size_t field, std::size_t first, std::size_t last) {
    for (std::size_t n = first; n < last; ++n) f(system_.fields[field].heat[n]);
  });
}

template <int Dim>
void HeatConduction<Dim>::scatter(Scatter what) {
  each_node([](HeatNode& node) { node = {}; });
  transfers_.scatter(&Field<Dim>::heat, what, false, false);
}

template <int Dim>
void HeatConduction<Dim>::gather(const Gather& what) {
  const auto& gathered = transfers_.gather(&Field<Dim>::heat, [&](const Body<Dim>&) { return what; });
  for (std::size_t k = 0; k < gathered.size(); ++k)
    if (any_rank(!gathered[k].valid))
      throw SimulationError("a temperature of '" + system_.bodies[k].name + "' is not a number in step " +
                            std::to_string(system_.step + 1) + " at time " + std::to_string(system_.time) +
                            ": usually the step is too large for the conductivity. Try a smaller <TimeFactor>, and "
                            "check Cv, kCond and the conditions.");
}

// Nodal temperatures and, from the gradients of the particles and the fluxes through their faces, their rates of
// change.
template <int Dim>
void HeatConduction<Dim>::find_rates(double dt, const Contact<Dim>& contact, const Exchanges<Dim>& exchanges) {
  scatter(Scatter::heat);
  add_fluxes(dt, exchanges);
  if (model_.heat.contact_heating && dt > 0) add_friction_heat(dt, contact, exchanges);
  for (std::size_t f = 0; f < system_.fields.size(); ++f)
    exchanges[f]->sum_images(system_.fields[f].heat, ImageValues::scalars);
  each_node([](HeatNode& node) {
    if (!(node.capacity > 0)) return;
    node.temperature = node.heat / node.capacity;
    node.rate = node.power / node.capacity;
  });
}

// Fluxes through the faces of particles.
template <int Dim>
void HeatConduction<Dim>::add_fluxes(double dt, const Exchanges<Dim>& exchanges) {
  constexpr auto kind = ParticleCondition::Kind::heat_flux;
  if (std::ranges::find(model_.particle_conditions, kind, &ParticleCondition::kind) == model_.particle_conditions.end())
    return;
  OrderlessSums<1> power;
  each_loaded(model_, system_, kind, [&](const ParticleCondition& condition, Body<Dim>& body, std::size_t particle) {
    const double added = add_flux(condition, body, particle, exchanges);
    if (particle < body.particles.size()) power.add(added);
  });
  supplied += dt * power.total()[0];
}

// Returns the power of the flux.
template <int Dim>
double HeatConduction<Dim>::add_flux(const ParticleCondition& condition, Body<Dim>& body, std::size_t particle,
                                     const Exchanges<Dim>& exchanges) {
  const auto face = ParticleFace<Dim>::of(system_, body, particle, condition.face);
  Vec3 x = Vec3::Zero();
  x.head<Dim>() = body.particles.position(particle);
  const double whole = face.area * condition.value.at(system_.time, x);
  auto& field = system_.fields[body.field];
  for (const auto& at : face.points) {
    const PointShares<Dim> to(model_.scheme.kernel, system_.fields, exchanges, at,
                              [&](const Index<Dim>&) { return body.field; });
    for (std::size_t k = 0; k < static_cast<std::size_t>(to.count); ++k)
      field.heat[static_cast<std::size_t>(to.node[k])].power +=
          to.share[k] * whole / static_cast<double>(face.points.size());
  }
  return whole;
}

// Frictional work becomes heat on the contact face. It is divided between the two sides in proportion to their heat
// capacities; since both have the same temperature there, the division does not affect the result. Rigid bodies
// receive no heat.
template <int Dim>
void HeatConduction<Dim>::add_friction_heat(double dt, const Contact<Dim>& contact, const Exchanges<Dim>& exchanges) {
  OrderlessSums<1> all;
  for (const ContactNode<Dim>& at_node : contact.nodes())
    contact.each_closed_pair(at_node, [&](const ContactPair& pair, const ContactMember& a, const ContactMember& b) {
      const double both = node_of(a).capacity + node_of(b).capacity;
      if (pair.friction_work == 0.0 || !(both > 0)) return;
      for (const ContactMember* side : {&a, &b}) {
        const double part = node_of(*side).capacity / both;
        if (!(part > 0)) continue;
        auto& field = system_.fields[side->field];
        const Vec<Dim> face = system_.lattice.position(field.map.node_at(side->node)) +
                              (pair.face_position * pair.state.normal + pair.foremost_offset).template head<Dim>();
        const PointShares<Dim> to(model_.scheme.kernel, system_.fields, exchanges, face,
                                  [&](const Index<Dim>&) { return side->field; });
        const double power = at_node.ownership * part * pair.friction_work / dt;
        for (std::size_t k = 0; k < static_cast<std::size_t>(to.count); ++k)
          field.heat[static_cast<std::size_t>(to.node[k])].power += to.share[k] * power;
      }
      if (at_node.own) all.add(at_node.ownership * pair.friction_work);
    });
  from_contact += all.total()[0];
}

// At closed contact pairs, both fields get the mean temperature and the mean rate, weighted by their heat capacities.
// Where three or more bodies are in contact at a node, repeated averaging of the pairs converges to the mean of all.
template <int Dim>
void HeatConduction<Dim>::equalize_contact(const Contact<Dim>& contact) {
  static constexpr int most_sweeps = 20;
  static constexpr double tolerance = 1e-13;
  for (const ContactNode<Dim>& at_node : contact.nodes())
    for (int sweep = 0; sweep < most_sweeps; ++sweep) {
      double change = 0.0;
      contact.each_closed_pair(at_node, [&](const ContactPair&, const ContactMember& a, const ContactMember& b) {
        HeatNode &at_a = node_of(a), &at_b = node_of(b);
        const double ca = at_a.capacity, cb = at_b.capacity;
        if (!(ca > 0) || !(cb > 0)) return;
        for (const auto value : {&HeatNode::temperature, &HeatNode::rate}) {
          double &va = at_a.*value, &vb = at_b.*value;
          const double mean = (ca * va + cb * vb) / (ca + cb);
          change = std::max(change, std::abs(va - vb) - tolerance * std::abs(mean));
          va = vb = mean;
        }
      });
      if (!(change > 0)) break;
    }
}

// As with velocities, the rates follow from the change of the prescribed temperature. Only in the first step, the rate
// includes the difference between the initial nodal temperature and the prescribed one.
template <int Dim>
void HeatConduction<Dim>::impose_temperatures(double dt, const Exchanges<Dim>& exchanges) {
  if (prescribed_.empty()) return;
  OrderlessSums<1> power;
  for (const PrescribedTemperature& node_condition : prescribed_) {
    const auto& condition = model_.temperature_conditions[node_condition.condition];
    Vec3 x = Vec3::Zero();
    x.head<Dim>() = system_.lattice.position(node_condition.index);
    const double wanted = condition.temperature.at(system_.time + dt, x, dt);
    for (std::size_t f = 0; f < system_.fields.size(); ++f) {
      const auto at = system_.fields[f].map.node(node_condition.index);
      if (at < 0) continue;
      HeatNode& node = system_.fields[f].heat[static_cast<std::size_t>(at)];
      if (!(node.capacity > 0)) continue;
      const double before = system_.step == 0 ? node.temperature : condition.temperature.at(system_.time, x, dt);
      const double correction = (wanted - before) / dt - node.rate;
      node.rate += correction;
      node.temperature = wanted - dt * node.rate;
      if (system_.fields[f].map.is_own(static_cast<std::size_t>(at / block_nodes<Dim>)))
        power.add(exchanges[f]->ownership(at) * node.capacity * correction);
    }
  }
  supplied += dt * power.total()[0];
}

// Interpolates the rates to the particles, and the temperature gradient at the end of the step.
template <int Dim>
void HeatConduction<Dim>::update_particles(double dt, const Exchanges<Dim>& exchanges) {
  Gather what;
  what.task = GatherTask::temperature;
  what.dt = dt;
  each_node([dt](HeatNode& node) { node.temperature += dt * node.rate; });
  for (std::size_t f = 0; f < system_.fields.size(); ++f)
    exchanges[f]->copy_images(system_.fields[f].heat, ImageValues::scalars);
  gather(what);
}

template <int Dim>
void HeatConduction<Dim>::reduce_residual(double dt, const Contact<Dim>& contact, const Exchanges<Dim>& exchanges) {
  // a larger threshold means fewer sweeps over the particles if steps are short
  static constexpr double least_share = 0.25;
  time_since_reduction += dt;
  const double h = system_.lattice.smallest_spacing();
  double most = 0.0;
  for (auto& body : system_.bodies) {
    body.residual_share =
        std::min(1.0, time_since_reduction * body.conductivity / (body.law->density() * body.heat_capacity * h * h));
    most = std::max(most, body.residual_share);
  }
  if (most < least_share) return;
  time_since_reduction = 0.0;
  scatter(Scatter::heat_residual);
  for (std::size_t f = 0; f < system_.fields.size(); ++f)
    exchanges[f]->sum_images(system_.fields[f].heat, ImageValues::scalars);
  each_node([](HeatNode& node) {
    if (node.capacity > 0) node.temperature = node.heat / node.capacity;
  });
  equalize_contact(contact);
  Gather what;
  what.task = GatherTask::temperature_residual;
  for (std::size_t f = 0; f < system_.fields.size(); ++f)
    exchanges[f]->copy_images(system_.fields[f].heat, ImageValues::scalars);
  gather(what);
}

template class HeatConduction<2>;
template class HeatConduction<3>;

}  // namespace tribo
