// SPDX-License-Identifier: MIT
#include "solver/velocity_filter.hpp"

#include "grid/loops.hpp"

namespace tribo {
namespace {

// Calls f(node, filter, increment) for every node of the field.
template <int Dim>
void each(Field<Dim>& field, auto&& f) {
  each_index(field.nodes.size(), [&](std::size_t i) { f(field.nodes[i], field.filter[i], field.increment[i]); });
}

}  // namespace

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
  for (auto& field : system_.fields)
    field.filter.resize(field.nodes.size()), field.increment.resize(field.nodes.size());
}

template <int Dim>
template <class F>
void VelocityFilter<Dim>::each_field(F&& f) {
  for (std::size_t k = 0; k < system_.fields.size(); ++k)
    if (!system_.fields[k].rigid_contact) f(k, system_.fields[k]);
}

template <int Dim>
void VelocityFilter<Dim>::filter(double dt, bool from_start) {
  const auto lap = watch.lap();
  const double without = scheme_.transfer == Transfer::xpic ? dt : 0.0;
  Gather value;
  value.task = GatherTask::filtered_velocity;
  value.from_start = from_start;
  each_field([&](std::size_t, Field<Dim>& field) {
    each(field, [&](const Node& node, FilterNode& filter, Node&) {
      filter.mass = node.mass;
      for (int d = 0; d < 3; ++d)
        filter.sum[d] = filter.increment[d] = node.velocity[d] - without * node.acceleration[d];
    });
  });
  for (int j = 1; j < scheme_.filter_order; ++j) {
    each_field([&](std::size_t f, Field<Dim>& field) {
      exchanges_[f]->copy_images(field.filter);
      each(field, [](const Node&, FilterNode&, Node& increment) { increment = Node{}; });
    });
    for (auto& body : system_.bodies) {
      transfers_.gather_and_scatter(body, Target<Dim>(body, system_.fields, &Field<Dim>::filter), value,
                                    Target<Dim>(body, system_.fields, &Field<Dim>::increment), Scatter::filtered,
                                    false);
    }
    each_field([&](std::size_t f, Field<Dim>& field) {
      exchanges_[f]->sum_images(field.increment);
      each(field, [](const Node& node, FilterNode& filter, const Node& scattered) {
        if (!(node.mass > 0)) return;
        for (int d = 0; d < 3; ++d) filter.increment[d] -= scattered.momentum[d] / node.mass;
      });
    });
    contact_.constrain_increments(dt > 0 ? ContactPass::corrector : contact_.start_pass());
    each_field([&](std::size_t f, Field<Dim>& field) {
      if (dt > 0)
        conditions_[f].release(field.filter, *exchanges_[f]);
      else
        conditions_[f].release(field.filter);
      each(field, [](const Node&, FilterNode& filter, const Node&) {
        for (int d = 0; d < 3; ++d) filter.sum[d] += filter.increment[d];
      });
    });
  }
  each_field([&](std::size_t f, Field<Dim>& field) {
    each(field, [](const Node&, FilterNode& filter, const Node&) {
      for (int d = 0; d < 3; ++d) filter.velocity[d] = filter.sum[d];
    });
    exchanges_[f]->copy_images(field.filter);
  });
}

template <int Dim>
void VelocityFilter<Dim>::use(double dt) {
  const auto lap = watch.lap();
  const double with = scheme_.transfer == Transfer::xpic ? dt : 0.0;
  each_field([&](std::size_t, Field<Dim>& field) {
    each(field, [&](Node& node, const FilterNode& filter, const Node&) {
      for (int d = 0; d < 3; ++d) node.velocity[d] = filter.velocity[d] + with * node.acceleration[d];
    });
  });
}

template class VelocityFilter<2>;
template class VelocityFilter<3>;

}  // namespace tribo
