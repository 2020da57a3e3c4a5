// SPDX-License-Identifier: MIT
#include "solver/step.hpp"

#include "grid/loops.hpp"
#include "solver/boundary/periodic.hpp"
#include "solver/cell_crossings.hpp"
#include "solver/diagnose.hpp"
#include "solver/exchange/node_sums.hpp"
#include "solver/measures.hpp"
#include "solver/step_start.hpp"

namespace tribo {

namespace {

// FLIP fraction in the update of the particle velocities.
double flip_share(const Scheme& scheme, bool filtered) {
  switch (scheme.transfer) {
    case Transfer::flip:
      return 1.0;
    case Transfer::blend:
      return scheme.flip_fraction;
    case Transfer::pic:
    case Transfer::apic:
      return 0.0;
    case Transfer::xpic:
    case Transfer::fmpm:
      return filtered ? 0.0 : 1.0;
  }
  return 1.0;
}

}  // namespace

// Notation: w_Ip is the shape function of node I at particle p; S interpolates from nodes to particles; S+ scatters to
// the nodes and divides by the nodal mass.
template <int Dim>
void Stepper<Dim>::advance(double dt) {
  const UpdateOrder order = model_.scheme.order;
  const bool stress_last = order == UpdateOrder::usl;
  const bool again = model_.scheme.extrapolate_again && order != UpdateOrder::usf;
  const auto lap = watches_.all.lap();
  begin_step();
  heat_.supplied += ramps_.apply(dt);

  // 1. Transfer mass and momentum to the nodes, and the forces if the stress is updated last.
  loads_.apply(dt);
  rigid_blocks_.set_particle_velocities();
  rigid_bodies_.set_velocities(dt);
  scatter(stress_last ? Scatter::momentum_and_force : Scatter::momentum);
  if (stress_last) tractions_.apply();
  sum_images(ImageValues::vectors);
  interface_faces_.find();
  joints_.find();

  if (!stress_last) {
    // 2. Stress first, or half of the increment: strain from the transferred velocities, corrected by contact and
    // conditions.
    divide_by_mass();
    find_contact();
    contact_.apply(dt, contact_.strain_pass());
    impose(system_.time, dt);
    copy_images();
    if (filter_.active()) filter_.filter(0.0, false);
    if (order == UpdateOrder::usavg) nodal_work_.keep_start(filter_.active()), contact_.keep_start(filter_.active());
    strain(order == UpdateOrder::usf ? dt : 0.5 * dt, false);
    const double part = order == UpdateOrder::usf ? dt : 0.5 * dt;
    joints_.update_laws(part, system_.time + part, filter_.active());
    if (!contact_.keeps_start_impulses()) contact_.remove_start_impulses();
    scatter(Scatter::force);
    tractions_.apply();
    sum_images(ImageValues::forces);
    update_momentum(dt, Known::velocity);
  } else if (contact_.keeps_start_impulses()) {
    divide_by_mass();
    find_contact();
    contact_.apply(dt, ContactPass::predictor);
    update_momentum(dt, Known::velocity);
  } else {
    update_momentum(dt, Known::momentum);
  }

  // 3. The nodes now satisfy m a = f and v += dt a. Joints, contact and prescribed velocities correct both a and v.
  add_joint_forces(dt);
  if (stress_last && !contact_.keeps_start_impulses()) find_contact();
  contact_.apply(dt, ContactPass::corrector);
  impose_update(dt, !stress_last);

  // 4. XPIC and FMPM filter the velocities.
  if (filter_.active()) {
    filter_.filter(dt, false);
    filter_.use(dt);
  }

  // 5. Record works and contact, move rigid blocks under the contact forces, evaluate crack tips and conduct heat.
  record_works(dt);
  if (measures_balance_) record_balance();
  rigid_blocks_.take_contact_forces(contact_.ledger().rigid_exchanges(), dt);
  rigid_blocks_.advance(dt);
  contact_.record_block_motion(rigid_blocks_.means());
  measure_crack_tips(dt);
  heat_.conduct(dt, contact_, exchanges_);

  // 6. Update joints, cracks and particles from the nodes. The stress is updated here except in the "+" variants.
  copy_images();
  const double strain_dt = stress_last ? dt : order == UpdateOrder::usavg ? 0.5 * dt : 0.0;
  if (!again) joints_.update_laws(strain_dt, system_.time + dt, false);
  joints_.find_motion();
  if (again) keep_start_positions(system_);
  cracks_.move(dt);
  joints_.move_points(dt);
  move_particles(dt, again ? 0.0 : strain_dt);
  if (filters_update()) {
    if (order != UpdateOrder::usavg) nodal_work_.record_change_of_velocities(dt);
    tractions_.record_change_of_velocities(dt);
  }
  loads_.record(0.5 * dt);

  // 7. "+" variants: strain from the velocities of the updated particles, with the shape functions at the start of the
  // step.
  if (again) strain_again(dt, strain_dt);
  openings_.apply();
  record_joints();
  contact_.ledger().end_step(dt);

  system_.time += dt;
  ++system_.step;
  jump_ = false;
  grow_cracks();
}

template <int Dim>
Stepper<Dim>::Stepper(const Model& model, System<Dim>& system)
    : model_(model),
      system_(system),
      loops_(system),
      transfers_(make_transfers<Dim>(model.scheme)),
      sort_(model, system),
      splitting_(model, system, ledger_),
      cracks_(model, system, *transfers_),
      crack_tips_(model, system, cracks_, transfers_->stencil_width()),
      interface_faces_(model, system),
      joints_(model, system, cracks_),
      contact_(model, system, *transfers_, cracks_),
      loads_(model, system, ledger_),
      tractions_(model, system, exchanges_, cracks_, ledger_),
      body_forces_(model, system, exchanges_, ledger_),
      nodal_work_(system, exchanges_, ledger_),
      damping_(model, system, exchanges_, ledger_),
      rigid_bodies_(model, system, *transfers_, exchanges_, ledger_),
      rigid_blocks_(system),
      heat_(model, system, *transfers_),
      ramps_(model, system),
      b_bar_(model.scheme, system, *transfers_, exchanges_),
      openings_(model, system),
      filter_(model, system, *transfers_, exchanges_, conditions_, contact_) {
  for (std::size_t f = 0; f < system.fields.size(); ++f) {
    exchanges_.push_back(make_exchange<Dim>(model.grid, system.lattice));
    conditions_.emplace_back(model, system.lattice);
  }
}

template <int Dim>
void Stepper<Dim>::begin_step() {
  // Stress-first updates strain the particles with velocities of the next step: their transfers are not booked.
  if (!ledger_.started && model_.scheme.order != UpdateOrder::usf)
    ledger_.started = true, ledger_.first_kinetic = measure(system_).kinetic;
  if (sort_.is_due()) sort();
  filter_.begin_step();
  keep_start_domains(system_);
  cracks_.find();
  zero_nodes();
  for (auto& exchange : exchanges_) exchange->begin_step();
}

template <int Dim>
void Stepper<Dim>::zero_nodes() {
  const auto lap = watches_.grid.lap();
  loops_.zero_nodes();
}

template <int Dim>
void Stepper<Dim>::sort() {
  const auto lap = watches_.sort.lap();
  sort_.sort();
  if (splitting_.apply()) sort_.sort();
  locate_nodes();
}

template <int Dim>
void Stepper<Dim>::locate_nodes() {
  cracks_.locate();
  for (std::size_t f = 0; f < system_.fields.size(); ++f) {
    auto& field = system_.fields[f];
    std::vector<BlockReach<Dim>> occupied;
    for (auto* bodies : {&system_.bodies, &system_.rigids})
      for (const auto& body : *bodies)
        if (body.field == f || body.field == Body<Dim>::no_field) {
          const auto reach = body.bins.reach(system_.lattice, transfers_->stencil_width());
          occupied.insert(occupied.end(), reach.begin(), reach.end());
        }
    if (field.side != 0) cracks_.add_blocks(field, occupied);
    add_periodic_blocks(model_.grid, system_.lattice, occupied);
    field.map.rebuild(occupied);
    if (exchanges_[f]->has_images()) field.map.reach_all();
    const auto nodes = static_cast<std::size_t>(field.map.node_count());
    field.nodes.resize(nodes);
    zero(field.nodes);  // later only those that are reached
    field.rigid.resize(system_.rigids.size());
    for (std::size_t r = 0; r < system_.rigids.size(); ++r)
      if (system_.rigids[r].field == Body<Dim>::no_field) field.rigid[r].resize(nodes);
    exchanges_[f]->locate(field.map);
    conditions_[f].locate(field.map);
  }
  filter_.locate();
  contact_.locate();
  heat_.locate();
  b_bar_.locate();
  for (auto& body : system_.bodies) body.refresh();
  loops_.divide();
}

template <int Dim>
void Stepper<Dim>::scatter(Scatter what, bool from_start) {
  const auto lap = watches_.scatter.lap();
  if (what != Scatter::momentum) b_bar_.average_stress();
  loops_.each_body([&](std::size_t k) {
    auto& body = system_.bodies[k];
    transfers_->scatter(body, Target<Dim>(body, system_.fields, &Field<Dim>::nodes), what, from_start,
                        system_.analysis == Analysis::axisymmetric);
  });
  if (what == Scatter::force) return;
  for (auto& body : system_.rigids)
    if (body.field != Body<Dim>::no_field) {
      auto& field = system_.fields[body.field];
      transfers_->scatter(body, Target<Dim>(field.map, field.nodes), Scatter::momentum, from_start, false);
      rigid_blocks_.set_nodal_momentum(body);
    }
}

template <int Dim>
void Stepper<Dim>::sum_images(ImageValues values) {
  const auto lap = watches_.grid.lap();
  for (std::size_t f = 0; f < system_.fields.size(); ++f) {
    exchanges_[f]->add_plane_reactions(system_.fields[f].nodes);
    exchanges_[f]->sum_images(system_.fields[f].nodes, values);
  }
}

template <int Dim>
void Stepper<Dim>::copy_images() {
  for (std::size_t f = 0; f < system_.fields.size(); ++f) exchanges_[f]->copy_images(system_.fields[f].nodes);
}

template <int Dim>
void Stepper<Dim>::divide_by_mass() {
  const auto lap = watches_.grid.lap();
  loops_.each_range([&](std::size_t f, std::size_t first, std::size_t last) {
    for (std::size_t n = first; n < last; ++n) {
      Node& node = system_.fields[f].nodes[n];
      if (!(node.mass > 0)) continue;
      const double inverse = 1.0 / node.mass;
      for (int d = 0; d < 3; ++d) node.velocity[d] = node.momentum[d] * inverse;
    }
  });
}

template <int Dim>
void Stepper<Dim>::find_contact() {
  contact_.find(exchanges_, joints_);
}

template <int Dim>
void Stepper<Dim>::update_momentum(double dt, Known known) {
  const auto lap = watches_.grid.lap();
  const bool from_momentum = known == Known::momentum;
  const auto is_free = [&](std::size_t f) { return !system_.fields[f].rigid_contact; };
  loops_.each_range([&](std::size_t f, std::size_t first, std::size_t last) {
    const Vec3 gravity = is_free(f) ? model_.body_force.gravity : Vec3(Vec3::Zero());
    const double damping = is_free(f) ? damping_.grid : 0.0;
    for (std::size_t n = first; n < last; ++n) {
      Node& node = system_.fields[f].nodes[n];
      if (!(node.mass > 0)) continue;
      const double inverse = 1.0 / node.mass;
      for (int d = 0; d < Dim; ++d) {
        const double v = from_momentum ? node.momentum[d] * inverse : node.velocity[d];
        const double a = node.force[d] * inverse + gravity[d] - damping * v;
        node.acceleration[d] = a;
        node.velocity[d] = v + dt * a;
      }
    }
  });
  for (std::size_t f = 0; f < system_.fields.size(); ++f) {
    if (!is_free(f)) continue;
    body_forces_.apply(f, dt);
    if (damping_.grid != 0.0) damping_.record_grid(f, dt);
    exchanges_[f]->hold_planes(system_.fields[f].nodes);
  }
  for (const auto& body : system_.bodies) ledger_.impulse += dt * body.total_mass * model_.body_force.gravity;
}

// Adds the joint forces from the end of the previous step.
template <int Dim>
void Stepper<Dim>::add_joint_forces(double dt) {
  if (!joints_.active()) return;
  joints_.add_forces(dt);
  for (std::size_t f = 0; f < system_.fields.size(); ++f) exchanges_[f]->hold_planes(system_.fields[f].nodes);
}

template <int Dim>
void Stepper<Dim>::impose(double time, double dt) {
  const auto lap = watches_.grid.lap();
  for (std::size_t f = 0; f < conditions_.size(); ++f)
    if (!system_.fields[f].rigid_contact) conditions_[f].impose(system_.fields[f].nodes, time, dt);
  rigid_bodies_.impose();
}

template <int Dim>
void Stepper<Dim>::impose_update(double dt, bool after_impose) {
  const auto lap = watches_.grid.lap();
  const double replaced = 1.0 - flip_share(model_.scheme, filter_.active());
  for (std::size_t f = 0; f < conditions_.size(); ++f)
    if (!system_.fields[f].rigid_contact)
      conditions_[f].impose_update(system_.fields[f].nodes, *exchanges_[f], system_.time, dt, after_impose,
                                   system_.step == 0 || jump_, replaced);
  rigid_bodies_.impose_update(dt, after_impose);
}

template <int Dim>
Gather Stepper<Dim>::gather_options() const {
  Gather what;
  what.plane_stress = system_.analysis == Analysis::plane_stress;
  what.axisymmetric = system_.analysis == Analysis::axisymmetric;
  what.exponential = model_.scheme.exponential_deformation;
  return what;
}

template <int Dim>
void Stepper<Dim>::strain(double dt, bool from_start) {
  if (!(dt > 0)) return;
  const auto lap = watches_.gather.lap();
  Gather what = gather_options();
  what.strain_dt = dt;
  what.from_start = from_start;
  const auto strain_from = [&](auto layer) {
    b_bar_.average_rates(what, layer);
    gathered_.resize(system_.bodies.size());
    loops_.each_body([&](std::size_t k) {
      auto& body = system_.bodies[k];
      gathered_[k] = transfers_->gather(body, Target<Dim>(body, system_.fields, layer), what);
    });
    for (const GatherResult& result : gathered_)
      if (!result.valid) stop_at_bad_particle(system_);
  };
  filter_.active() ? strain_from(&Field<Dim>::filter) : strain_from(&Field<Dim>::nodes);
}

template <int Dim>
void Stepper<Dim>::strain_again(double dt, double strain_dt) {
  loops_.zero_nodes();
  scatter(Scatter::momentum, true);
  sum_images(ImageValues::vectors);
  divide_by_mass();
  contact_.apply(dt, contact_.strain_pass());
  impose(system_.time + dt, dt);
  copy_images();
  if (filter_.active()) filter_.filter(0.0, true);
  nodal_work_.record_end(dt, filters_update(), filter_.active());
  contact_.record_end(filters_update(), filter_.active());
  tractions_.record_end(dt, filters_update(), filter_.active());
  strain(strain_dt, true);
  joints_.update_laws(strain_dt, system_.time + dt, filter_.active());
}

template <int Dim>
void Stepper<Dim>::record_works(double dt) {
  body_forces_.record(dt);
  const bool again = model_.scheme.extrapolate_again && model_.scheme.order != UpdateOrder::usf;
  again ? tractions_.record_start(dt, filters_update()) : tractions_.record(dt, filters_update());
  if (model_.scheme.order != UpdateOrder::usf) {
    const auto lap = watches_.grid.lap();
    again ? nodal_work_.record_start(dt, filters_update()) : nodal_work_.record(dt, filters_update());
  }
  contact_.record(dt, flip_share(model_.scheme, filter_.active()), filters_update());
}

template <int Dim>
void Stepper<Dim>::record_balance() {
  NodeSums<Dim> sum(system_, exchanges_);
  WorkAndImpulse all = WorkAndImpulse::Zero();
  const double gravity = model_.body_force.gravity.norm();
  for (std::size_t f = 0; f < system_.fields.size(); ++f) {
    if (system_.fields[f].rigid_contact) continue;
    all += sum(f, [&](std::int64_t, const Node& node) {
      WorkAndImpulse forces = WorkAndImpulse::Zero();
      forces[0] = node.mass * Eigen::Map<const Vec<Dim>>(node.acceleration).norm();
      forces[1] = Eigen::Map<const Vec<Dim>>(node.force).norm() + node.mass * gravity;
      return forces;
    });
  }
  unbalanced_ratio_ = all[1] > 0 ? all[0] / all[1] : 0.0;
}

// Adds forces, areas and work of joints between bodies to the contact quantities of the histories.
template <int Dim>
void Stepper<Dim>::record_joints() {
  joints_.each_pair([&](std::size_t one, std::size_t two, const Vec3& force, double area, double stored) {
    const bool of_crack = one >= system_.fields.size();  // its key is that of the contact pairs of the crack
    const bool swap = one > two && !of_crack;
    PairLedger& entry = contact_.ledger().pairs[swap ? std::pair{two, one} : std::pair{one, two}];
    entry.force += swap ? Vec3(-force) : force;
    entry.area += area, entry.stored += stored;
  });
  const auto [work, impulse] = joints_.take_rigid_exchange();
  contact_.ledger().rigid_work += work, contact_.ledger().rigid_impulse += impulse;
}

template <int Dim>
void Stepper<Dim>::measure_crack_tips(double dt) {
  if constexpr (Dim == 2) {
    if (!crack_tips_.active()) return;
    crack_tips_.measure([&](const Vec<2>& x, const Vec<2>& v) {
      return Vec<2>((model_.body_force.gravity + body_forces_.at(x, dt)).template head<2>() - damping_.grid * v);
    });
  }
}

// Particles near a new tip may lie in bins that no crack cut before, so the particles must be sorted.
template <int Dim>
void Stepper<Dim>::grow_cracks() {
  if constexpr (Dim == 2) {
    if (!crack_tips_.active() || system_.load_clock.is_arrested(model_.reversal) || !crack_tips_.grow()) return;
    system_.sorted = false;
    if (model_.reversal && model_.reversal->crack &&
        crack_tips_.longest(*model_.reversal->crack) > model_.reversal->value)
      system_.load_clock.turned = system_.time;
  }
}

template <int Dim>
double Stepper<Dim>::damping_of(const Body<Dim>& body) const {
  return body.particle_damping + damping_.particle;
}

// Records particle damping, and finds the velocities that it acts on. Conditions prescribe velocities of nodes and
// their rates, so that nothing would return to the particles what damping takes from a prescribed velocity.
template <int Dim>
void Stepper<Dim>::damp_particles(double dt) {
  const auto is_damped = [&](const Body<Dim>& body) { return damping_of(body) != 0.0; };
  if (std::none_of(system_.bodies.begin(), system_.bodies.end(), is_damped)) return;
  const bool part = std::any_of(system_.bodies.begin(), system_.bodies.end(),
                                [&](const Body<Dim>& body) { return is_damped(body) && body.damped; });
  for (std::size_t f = 0; f < system_.fields.size() && part; ++f) {
    Field<Dim>& field = system_.fields[f];
    field.filter.resize(field.nodes.size());
    each_index(field.nodes.size(), [&](std::size_t n) {
      for (int d = 0; d < 3; ++d) field.filter[n].increment[d] = field.nodes[n].velocity[d];
    });
    conditions_[f].release(field.filter);
    exchanges_[f]->copy_images(field.filter);
  }
  Gather damped;
  damped.task = GatherTask::damped_velocity;
  for (auto& body : system_.bodies) {
    if (!is_damped(body)) continue;
    damping_.record_particles(body, damping_of(body), dt, part);
    if (part) transfers_->gather(body, Target<Dim>(body, system_.fields, &Field<Dim>::filter), damped);
  }
}

template <int Dim>
void Stepper<Dim>::move_particles(double dt, double strain_dt) {
  const auto lap = watches_.gather.lap();
  Gather what = gather_options();
  what.move = true;
  what.dt = dt;
  what.strain_dt = strain_dt;
  what.flip = flip_share(model_.scheme, filter_.active());
  what.record_change = filters_update();
  b_bar_.average_rates(what, &Field<Dim>::nodes);
  double travel = 0.0;
  damp_particles(dt);
  gathered_.resize(system_.bodies.size());
  loops_.each_body([&](std::size_t k) {
    auto& body = system_.bodies[k];
    Gather of_body = what;
    of_body.damping = damping_of(body);
    of_body.damps_part = of_body.damping != 0.0 && body.damped;
    gathered_[k] = transfers_->gather(body, Target<Dim>(body, system_.fields, &Field<Dim>::nodes), of_body);
  });
  for (const GatherResult& result : gathered_) {
    travel = std::max(travel, result.travel);
    if (!result.valid) stop_at_bad_particle(system_);
  }
  travel = std::max({travel, rigid_blocks_.move_particles(), rigid_bodies_.move(dt)});
  for (auto& body : system_.bodies) count_crossings(body, system_.lattice);
  system_.drift += travel;
  contact_.add_travel(travel);
  interface_faces_.add_travel(travel);
}

template class Stepper<2>;
template class Stepper<3>;

}  // namespace tribo
