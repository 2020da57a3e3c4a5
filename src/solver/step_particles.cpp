// SPDX-License-Identifier: MIT
/// The parts of a time step that act on particles.
#include "solver/step.hpp"

#include "grid/loops.hpp"
#include "solver/cell_crossings.hpp"
#include "solver/diagnose.hpp"
#include "solver/measures.hpp"

namespace tribo {

// FLIP fraction in the update of the particle velocities.
template <int Dim>
double Stepper<Dim>::flip_share() const {
  const bool filtered = filter_.active();
  switch (model_.scheme.transfer) {
    case Transfer::flip:
      return 1.0;
    case Transfer::blend:
      return model_.scheme.flip_fraction;
    case Transfer::pic:
    case Transfer::apic:
      return 0.0;
    case Transfer::xpic:
    case Transfer::fmpm:
      return filtered ? 0.0 : 1.0;
  }
  return 1.0;
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
void Stepper<Dim>::strain(double dt, bool from_start, bool with_forces) {
  if (!(dt > 0)) return;
  const auto lap = watches_.gather.lap();
  Gather what = gather_options();
  what.strain_dt = dt;
  what.from_start = from_start;
  const auto strain_from = [&](auto layer) {
    b_bar_.average_rates(what, layer);
    const auto of_body = [&](const Body<Dim>&) { return what; };
    stop_if_invalid(
        with_forces ? of_all_.gather_and_scatter(layer, of_body, &Field<Dim>::nodes, Scatter::force, what.axisymmetric)
                    : of_all_.gather(layer, of_body));
  };
  filter_.active() ? strain_from(&Field<Dim>::filter) : strain_from(&Field<Dim>::nodes);
}

template <int Dim>
void Stepper<Dim>::stop_if_invalid(const std::vector<GatherResult>& gathered) {
  const auto is_invalid = [](const GatherResult& result) { return !result.valid; };
  if (any_rank(std::any_of(gathered.begin(), gathered.end(), is_invalid))) stop_at_bad_particle(system_);
}

template <int Dim>
double Stepper<Dim>::damping_of(const Body<Dim>& body) const {
  return body.particle_damping + damping_.particle;
}

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
    damping_.record_particles(body, measure(body).kinetic, damping_of(body), dt, part);
    if (part) transfers_->gather(body, Target<Dim>(body, system_.fields, &Field<Dim>::filter), damped);
  }
}

template <int Dim>
void Stepper<Dim>::move_particles(double dt, double strain_dt, bool with_momentum) {
  const auto lap = watches_.gather.lap();
  Gather what = gather_options();
  what.move = true;
  what.dt = dt;
  what.strain_dt = strain_dt;
  what.flip = flip_share();
  what.record_change = filters_update();
  b_bar_.average_rates(what, &Field<Dim>::nodes);
  damp_particles(dt);
  const auto options = [&](const Body<Dim>& body) {
    Gather of_body = what;
    of_body.damping = damping_of(body);
    of_body.damps_part = of_body.damping != 0.0 && body.damped;
    return of_body;
  };
  const auto& gathered = with_momentum
                             ? of_all_.gather_and_scatter(&Field<Dim>::nodes, options, &Field<Dim>::nodes_again,
                                                          Scatter::momentum, what.axisymmetric)
                             : of_all_.gather(&Field<Dim>::nodes, options);
  travel_.begin(system_.fields.size());
  for (std::size_t k = 0; k < gathered.size(); ++k) travel_.include(system_.bodies[k], gathered[k].travel);
  stop_if_invalid(gathered);
  rigid_blocks_.move_particles(travel_);
  rigid_bodies_.move(dt, travel_);
  travel_.include_ranks();
  for (auto& body : system_.bodies) count_crossings(body, system_.lattice);
  system_.drift += travel_.largest;
  contact_.add_travel(travel_.of_fields);
  interface_faces_.add_travel(travel_.largest);
}

template class Stepper<2>;
template class Stepper<3>;

}  // namespace tribo
