// SPDX-License-Identifier: MIT
#include "solver/velocity_filter.hpp"

#include "grid/loops.hpp"

namespace tribo {

template <int Dim>
void VelocityFilter<Dim>::begin_step() {
  active_ = false;
  if (scheme_.transfer != Transfer::xpic && scheme_.transfer != Transfer::fmpm) return;
  if (scheme_.filter_period <= 0) {
    active_ = system_.step % std::max(1, scheme_.filter_every) == 0;
    return;
  }
  if (system_.time < next) return;
  while (next <= system_.time) next += scheme_.filter_period;
  active_ = true;
}

template <int Dim>
void VelocityFilter<Dim>::locate() {
  if (scheme_.transfer != Transfer::xpic && scheme_.transfer != Transfer::fmpm) return;
  for (auto& field : system_.fields) {
    field.filter.resize(field.nodes.size()), field.increment.resize(field.nodes.size());
    zero(field.filter), zero(field.increment);  // later only those that are reached
  }
}

template <int Dim>
template <class F>
void VelocityFilter<Dim>::each_field(F&& f) {
  for (std::size_t k = 0; k < system_.fields.size(); ++k)
    if (!system_.fields[k].rigid_contact) f(k, system_.fields[k]);
}

// Calls f(node, filter, scattered) for the nodes that particles may reach.
template <int Dim>
template <class F>
void VelocityFilter<Dim>::each_node(F&& f) {
  loops_.each_range([&](std::size_t k, std::size_t first, std::size_t last) {
    Field<Dim>& field = system_.fields[k];
    if (field.rigid_contact) return;
    for (std::size_t n = first; n < last; ++n) f(field.nodes[n], field.filter[n], field.increment[n]);
  });
}

// Sums all terms of the series but the last, which is left in the increments.
template <int Dim>
void VelocityFilter<Dim>::sum_terms(double dt, bool from_start) {
  const double without = scheme_.transfer == Transfer::xpic ? dt : 0.0;
  each_node([&](const Node& node, FilterNode& filter, Node& scattered) {
    filter.mass = node.mass;
    for (int d = 0; d < 3; ++d)
      filter.sum[d] = 0.0, filter.increment[d] = node.velocity[d] - without * node.acceleration[d];
    scattered = {};
  });
  for (int j = 1; j < scheme_.filter_order; ++j) {
    scatter_increments(from_start);
    each_node([](const Node&, FilterNode& filter, Node& scattered) {
      if (filter.mass > 0)
        for (int d = 0; d < 3; ++d) {
          filter.sum[d] += filter.increment[d];
          filter.increment[d] -= scattered.momentum[d] / filter.mass;
        }
      scattered = {};
    });
    contact_.constrain_increments(dt > 0 ? ContactPass::corrector : contact_.start_pass());
    each_field([&](std::size_t f, Field<Dim>& field) {
      if (dt > 0)
        conditions_[f].release(field.filter, *exchanges_[f]);
      else
        conditions_[f].release(field.filter);
    });
  }
}

// Interpolates the increments to the particles and scatters the result to the nodes.
template <int Dim>
void VelocityFilter<Dim>::scatter_increments(bool from_start) {
  Gather value;
  value.task = GatherTask::filtered_velocity;
  value.from_start = from_start;
  each_field([&](std::size_t f, Field<Dim>& field) { exchanges_[f]->copy_images(field.filter); });
  transfers_.gather_and_scatter(
      &Field<Dim>::filter, [&](const Body<Dim>&) { return value; }, &Field<Dim>::increment, Scatter::filtered, false);
  each_field([&](std::size_t f, Field<Dim>& field) { exchanges_[f]->sum_images(field.increment); });
}

template <int Dim>
void VelocityFilter<Dim>::filter(bool from_start) {
  const auto lap = watch.lap();
  sum_terms(0.0, from_start);
  each_node([](const Node&, FilterNode& filter, const Node&) {
    for (int d = 0; d < 3; ++d) filter.velocity[d] = filter.sum[d] + filter.increment[d];
  });
  each_field([&](std::size_t f, Field<Dim>& field) { exchanges_[f]->copy_images(field.filter); });
}

template <int Dim>
void VelocityFilter<Dim>::filter_update(double dt) {
  const auto lap = watch.lap();
  const double with = scheme_.transfer == Transfer::xpic ? dt : 0.0;
  sum_terms(dt, false);
  each_node([&](Node& node, FilterNode& filter, const Node&) {
    for (int d = 0; d < 3; ++d) {
      filter.velocity[d] = filter.sum[d] + filter.increment[d];
      node.velocity[d] = filter.velocity[d] + with * node.acceleration[d];
    }
  });
  each_field([&](std::size_t f, Field<Dim>& field) { exchanges_[f]->copy_images(field.nodes); });
}

template class VelocityFilter<2>;
template class VelocityFilter<3>;

}  // namespace tribo
