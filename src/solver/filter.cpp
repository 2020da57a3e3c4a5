/// XPIC and FMPM: velocities sharper than the lumped mass gives.
///
///   v(k) = sum over j < k of (1 - S+ S)^j v
///
/// FMPM filters the updated velocities, XPIC the velocities before the forces. Strains follow filtered velocities, too.
/// Hammerquist & Nairn, CMAME 318 (2017) 724-753; Nairn & Hammerquist, CMAME 377 (2021) 113686.

#include "base/parallel.hpp"
#include "solver/step.hpp"

namespace tribo {
namespace {

// Calls f(node, filter, increment) for every node of the field.
template <int Dim>
void each(Field<Dim>& field, auto&& f) {
  static constexpr std::ptrdiff_t piece = 1024;
  const auto n = static_cast<std::ptrdiff_t>(field.nodes.size());
  parallel_for((n + piece - 1) / piece, [&](std::ptrdiff_t k) {
    for (auto i = static_cast<std::size_t>(k * piece); i < static_cast<std::size_t>(std::min(n, (k + 1) * piece)); ++i)
      f(field.nodes[i], field.filter[i], field.increment[i]);
  });
}

}  // namespace

template <int Dim>
bool Stepper<Dim>::filter_now() {
  const Scheme& s = model_.scheme;
  if (s.transfer != Transfer::xpic && s.transfer != Transfer::fmpm) return false;
  if (s.filter_period <= 0) return system_.step % std::max(1, s.filter_every) == 0;
  if (system_.time < next_filter) return false;
  while (next_filter <= system_.time) next_filter += s.filter_period;
  return true;
}

// Leaves v(k) in the velocities of the layer `filter`. dt > 0: after the forces, which XPIC takes out first.
template <int Dim>
void Stepper<Dim>::filter(double dt, bool from_start) {
  const auto lap = watches_.filter.lap();
  const double without = model_.scheme.transfer == Transfer::xpic ? dt : 0.0;
  Gather value;
  value.filtered = true;
  value.from_start = from_start;
  const auto each_field = [&](auto&& f) {
    for (std::size_t k = 0; k < system_.fields.size(); ++k)
      if (!system_.fields[k].rigid_contact) f(k, system_.fields[k]);
  };
  each_field([&](std::size_t, Field<Dim>& field) {
    // velocity: the present increment, acceleration: the sum so far
    each(field, [&](const Node& node, Node& filtered, Node&) {
      filtered.mass = node.mass;
      for (int d = 0; d < 3; ++d)
        filtered.acceleration[d] = filtered.velocity[d] = node.velocity[d] - without * node.acceleration[d];
    });
  });
  for (int j = 1; j < model_.scheme.filter_order; ++j) {
    each_field([&](std::size_t f, Field<Dim>& field) {
      conditions_[f].extend(field.filter);
      each(field, [](const Node&, Node&, Node& increment) { increment = Node{}; });
    });
    for (auto& body : system_.bodies) {
      transfers_->gather(body, Target<Dim>(body, system_.fields, &Field<Dim>::filter), value);
      transfers_->scatter(body, Target<Dim>(body, system_.fields, &Field<Dim>::increment), Scatter::filtered,
                          from_start, false);
    }
    each_field([&](std::size_t f, Field<Dim>& field) {
      conditions_[f].fold(field.increment);
      each(field, [](const Node& node, Node& filtered, const Node& increment) {
        if (!(node.mass > 0)) return;
        for (int d = 0; d < 3; ++d) filtered.velocity[d] -= increment.velocity[d] / node.mass;
      });
    });
    contact_.refine(dt > 0);
    each_field([&](std::size_t f, Field<Dim>& field) {
      conditions_[f].release(field.filter);
      each(field, [](const Node&, Node& filtered, const Node&) {
        for (int d = 0; d < 3; ++d) filtered.acceleration[d] += filtered.velocity[d];
      });
    });
  }
  each_field([&](std::size_t f, Field<Dim>& field) {
    each(field, [](const Node&, Node& filtered, const Node&) {
      for (int d = 0; d < 3; ++d) filtered.velocity[d] = filtered.acceleration[d];
    });
    conditions_[f].extend(field.filter);
  });
}

template <int Dim>
void Stepper<Dim>::use_filtered(double dt) {
  const auto lap = watches_.filter.lap();
  const double with = model_.scheme.transfer == Transfer::xpic ? dt : 0.0;
  for (auto& field : system_.fields) {
    if (field.rigid_contact) continue;
    each(field, [&](Node& node, const Node& filtered, const Node&) {
      for (int d = 0; d < 3; ++d) node.velocity[d] = filtered.velocity[d] + with * node.acceleration[d];
    });
  }
}

template bool Stepper<2>::filter_now();
template bool Stepper<3>::filter_now();
template void Stepper<2>::filter(double, bool);
template void Stepper<3>::filter(double, bool);
template void Stepper<2>::use_filtered(double);
template void Stepper<3>::use_filtered(double);

}  // namespace tribo
