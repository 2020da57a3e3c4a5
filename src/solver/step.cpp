// SPDX-License-Identifier: MIT
/// The algorithm of a time step.
#include "solver/step.hpp"

#include "solver/measures.hpp"
#include "solver/step_start.hpp"

namespace tribo {

namespace {

// Blocks around those of a process whose particles it must know: the stencils of all that reach the nodes of its own
// particles. With contact, those within the distance in which faces are searched; with loads on faces, those that
// determine how a force is shared among the nodes around, and with walls those that determine the velocities they
// mirror.
template <int Dim>
int ghost_layers(const Model& model, const Transfers<Dim>& transfers, const System<Dim>& system) {
  if (Dim == 2) return 1;
  const auto acts_on_faces = [](const ParticleCondition& c) { return c.kind != ParticleCondition::Kind::force; };
  const auto mirrors = [](const NodeCondition& c) { return c.wall && c.wall->mirror; };
  const bool reads_masses = system.fields.size() > 1 || std::ranges::any_of(model.particle_conditions, acts_on_faces) ||
                            std::ranges::any_of(model.node_conditions, mirrors);
  return 1 + (transfers.colours_per_axis() > 2 ? 1 : 0) + (reads_masses ? 1 : 0);
}

}  // namespace

// Notation: w_Ip is the shape function of node I at particle p; S interpolates from nodes to particles; S+ scatters to
// the nodes and divides by the nodal mass.
template <int Dim>
void Stepper<Dim>::advance(double dt) {
  const auto lap = watches_.all.lap();
  begin_step();
  heat_.supplied += ramps_.apply(dt);

  // 1. Transfer mass and momentum to the nodes, and the forces if the stress is updated last.
  transfer_to_nodes(dt);

  // 2. Update the momentum: m a = f and v += dt a. Before this the stress is updated, or half of it, if it comes first.
  if (!stress_last()) {
    update_stress_first(dt);
    update_momentum(dt, Known::velocity);
  } else if (contact_.keeps_start_impulses()) {
    divide_by_mass();
    find_contact();
    contact_.apply(dt, Contact<Dim>::Pass::predictor);
    update_momentum(dt, Known::velocity);
  } else {
    update_momentum(dt, Known::momentum);
  }

  // 3. Joints, contact and prescribed velocities correct both a and v.
  add_joint_forces(dt);
  if (stress_last() && !contact_.keeps_start_impulses()) find_contact();
  contact_.apply(dt, ContactPass::corrector);
  impose_update(dt, !stress_last());

  // 4. XPIC and FMPM filter the velocities.
  if (filter_.active()) filter_.filter_update(dt);

  // 5. Record works and contact, move rigid blocks under the contact forces, evaluate crack tips and conduct heat.
  record_update(dt);
  move_rigid_blocks(dt);
  measure_crack_tips(dt);
  heat_.conduct(dt, contact_, exchanges_);

  // 6. Update joints, cracks and particles from the nodes. The stress is updated here except in the "+" variants.
  copy_images();
  update_from_nodes(dt);

  // 7. "+" variants: strain from the velocities of the updated particles, with the shape functions at the start of the
  // step.
  if (extrapolates_again()) strain_again(dt, strain_time(dt));
  openings_.apply();
  end_step(dt);
}

template <int Dim>
Stepper<Dim>::Stepper(const Model& model, System<Dim>& system)
    : model_(model),
      system_(system),
      loops_(system),
      transfers_(make_transfers<Dim>(model.scheme)),
      distribution_(model, system, ghost_layers<Dim>(model, *transfers_, system), transfers_->stencil_width()),
      of_all_(system, loops_, *transfers_, distribution_),
      sort_(model, system, distribution_),
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
      rigid_bodies_(model, system, *transfers_, exchanges_, distribution_, ledger_),
      rigid_blocks_(system),
      heat_(model, system, loops_, of_all_),
      ramps_(model, system),
      affine_at_walls_(model, system.lattice),
      b_bar_(model.scheme, system, *transfers_, exchanges_, distribution_),
      openings_(model, system, distribution_),
      filter_(model, system, loops_, of_all_, exchanges_, conditions_, contact_) {
  conditions_.reserve(system.fields.size());
  for (std::size_t f = 0; f < system.fields.size(); ++f) {
    exchanges_.push_back(make_exchange<Dim>(model.grid, system.lattice));
    if (f == 0)
      conditions_.emplace_back(model, system.lattice);
    else
      conditions_.push_back(conditions_.front());
  }
}

template <int Dim>
void Stepper<Dim>::begin_step() {
  sort_if_due();
  // Stress-first updates strain the particles with velocities of the next step: their transfers are not booked.
  if (!ledger_.started && model_.scheme.order != UpdateOrder::usf)
    ledger_.started = true, ledger_.first_kinetic = measure(system_).kinetic;
  filter_.begin_step();
  keep_start_domains(system_);
  if (cracks_.active()) distribution_.refresh_ghosts();  // they have moved since the last transfer
  cracks_.find();
  zero_nodes();
  for (auto& exchange : exchanges_) exchange->begin_step();
}

template <int Dim>
void Stepper<Dim>::distribute() {
  if (sort_.is_due()) return sort();
  contact_.pack_faces();
  distribution_.share_out();
  locate_nodes();
  contact_.unpack_faces();
}

template <int Dim>
void Stepper<Dim>::transfer_to_nodes(double dt) {
  loads_.apply(dt);
  rigid_blocks_.set_particle_velocities();
  rigid_bodies_.set_velocities(dt);
  scatter(stress_last() ? Scatter::momentum_and_force : Scatter::momentum);
  if (stress_last()) tractions_.apply();
  sum_images(ImageValues::vectors);
  interface_faces_.find();
  joints_.find();
}

// Strain from the transferred velocities, corrected by contact and conditions, and the forces of the new stress.
template <int Dim>
void Stepper<Dim>::update_stress_first(double dt) {
  const bool half = model_.scheme.order == UpdateOrder::usavg;
  const double part = half ? 0.5 * dt : dt;
  divide_by_mass();
  find_contact();
  contact_.apply(dt, contact_.start_pass());
  impose(system_.time, dt);
  copy_images();
  if (filter_.active()) filter_.filter(false);
  if (half) nodal_work_.keep_start(filter_.active()), contact_.keep_start(filter_.active());
  const bool with_forces = !b_bar_.active();  // otherwise they depend on the stress of all particles of a cell
  strain(part, false, with_forces);
  joints_.find_motion(filter_.active());
  joints_.update_laws(part, system_.time + part);
  if (!contact_.keeps_start_impulses()) contact_.remove_start_impulses();
  if (!with_forces) scatter(Scatter::force);
  tractions_.apply();
  sum_images(ImageValues::forces);
}

template <int Dim>
void Stepper<Dim>::update_from_nodes(double dt) {
  const bool again = extrapolates_again();
  joints_.find_motion(false);
  if (!again) joints_.update_laws(strain_time(dt), system_.time + dt);
  if (again) keep_start_positions(system_);
  cracks_.move(dt);
  joints_.move_points(dt);
  move_particles(dt, again ? 0.0 : strain_time(dt), again);
  record_changes(dt);
  loads_.record(0.5 * dt);
}

// How much of the step strains the particles after the momentum update.
template <int Dim>
double Stepper<Dim>::strain_time(double dt) const {
  if (stress_last()) return dt;
  return model_.scheme.order == UpdateOrder::usavg ? 0.5 * dt : 0.0;
}

template <int Dim>
void Stepper<Dim>::strain_again(double dt, double strain_dt) {
  for (auto& field : system_.fields) std::swap(field.nodes, field.nodes_again);
  if (!system_.rigids.empty()) distribution_.refresh_ghosts();  // they have moved since the last scatter
  scatter_rest(true);
  sum_images(ImageValues::vectors);
  divide_by_mass();
  contact_.apply(dt, contact_.start_pass());
  impose(system_.time + dt, dt);
  copy_images();
  if (filter_.active()) filter_.filter(true);
  nodal_work_.record_end(dt, filters_update(), filter_.active());
  contact_.record_end(filters_update(), filter_.active());
  tractions_.record_end(dt, filters_update(), filter_.active());
  strain(strain_dt, true);
  joints_.find_motion(filter_.active());
  joints_.update_laws(strain_dt, system_.time + dt);
}

template <int Dim>
void Stepper<Dim>::move_rigid_blocks(double dt) {
  rigid_blocks_.take_contact_forces(contact_.ledger().rigid_exchanges(), dt);
  rigid_blocks_.advance(dt);
  contact_.record_block_motion(rigid_blocks_.means());
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

template <int Dim>
void Stepper<Dim>::grow_cracks() {
  if constexpr (Dim == 2) {
    if (!crack_tips_.active() || system_.load_clock.is_arrested(model_.reversal)) return;
    distribution_.refresh_ghosts();  // they have moved, and tell whether a tip has reached a surface
    if (!crack_tips_.grow()) return;
    system_.sorted = false;
    if (model_.reversal && model_.reversal->crack &&
        crack_tips_.longest(*model_.reversal->crack) > model_.reversal->value)
      system_.load_clock.turned = system_.time;
  }
}

template <int Dim>
void Stepper<Dim>::end_step(double dt) {
  record_joints();
  contact_.ledger().end_step(dt);
  for (auto& exchange : exchanges_) exchange->end_step();
  system_.time += dt;
  ++system_.step;
  jump_ = false;
  grow_cracks();
}

template class Stepper<2>;
template class Stepper<3>;

}  // namespace tribo
