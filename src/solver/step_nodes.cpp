// SPDX-License-Identifier: MIT
/// The parts of a time step that act on nodes.
#include "solver/step.hpp"

#include "grid/loops.hpp"
#include "solver/boundary/periodic.hpp"

namespace tribo {

template <int Dim>
void Stepper<Dim>::zero_nodes() {
  const auto lap = watches_.grid.lap();
  loops_.zero_nodes();
}

template <int Dim>
void Stepper<Dim>::sort() {
  const auto lap = watches_.sort.lap();
  const auto sort_and_split = [&] {
    sort_.sort();
    if (splitting_.apply()) sort_.sort();
  };
  if (distribution_.active() && splitting_.is_active()) {
    distribution_.unite();
    {
      const AloneScope with_all_particles;
      sort_and_split();
    }
    distribution_.share_out();
  } else {
    sort_and_split();
  }
  locate_nodes();
}

template <int Dim>
void Stepper<Dim>::locate_nodes() {
  cracks_.locate();
  std::vector<std::vector<BlockReach<Dim>>> reached(system_.fields.size());
  const auto around = around_own_particles();
  for (auto* bodies : {&system_.bodies, &system_.rigids})
    for (const auto& body : *bodies) {
      if (body.field == Body<Dim>::no_field) continue;
      const auto reach = body.bins.reach(system_.lattice, transfers_->stencil_width());
      reached[body.field].insert(reached[body.field].end(), reach.begin(), reach.end());
    }
  for (std::size_t f = 0; f < system_.fields.size(); ++f) {
    auto& field = system_.fields[f];
    auto& occupied = reached[f];
    if (field.side != 0) cracks_.add_blocks(field, occupied);
    add_periodic_blocks(model_.grid, system_.lattice, occupied);
    field.map.rebuild(occupied);
    if (distribution_.active())
      field.map.mark_own(
          [&](const Index<Dim>& block) { return system_.partition->is_own(block); },
          [&](const Index<Dim>& block) { return distribution_.is_common(block) ? ~std::uint64_t{0} : around[block]; });
    if (exchanges_[f]->has_images()) field.map.reach_all();
    const auto nodes = static_cast<std::size_t>(field.map.node_count());
    field.nodes.resize(nodes);
    zero(field.nodes);  // later only those that are reached
    if (extrapolates_again()) field.nodes_again.resize(nodes), zero(field.nodes_again);
    exchanges_[f]->locate(field.map);
    conditions_[f].locate(field.map);
  }
  rigid_bodies_.locate();
  filter_.locate();
  contact_.locate();
  heat_.locate();
  b_bar_.locate();
  for (auto& body : system_.bodies) body.refresh();
  loops_.divide();
}

// In a run of several processes, bits of the nodes around the particles of this one, per block: contact is found there.
// The contributions of all particles to these nodes are known. The stencils of particles beyond the ghosts, which may
// have moved by a cell, end behind the nodes that are this many nodes beyond the stencils of the own ones.
template <int Dim>
BlockTable<Dim, std::uint64_t> Stepper<Dim>::around_own_particles() const {
  BlockTable<Dim, std::uint64_t> around(0);
  if (!distribution_.active()) return around;
  constexpr int edge = block_edge<Dim>, farthest = 4;  // the latter as far as the state of contact is shown [nodes]
  const int width = transfers_->stencil_width();
  const int more = std::min(farthest, distribution_.layers() * edge - 1 - width);
  // Calls f(block, bits of its nodes).
  const auto each_block = [&](auto&& f) {
    for (const auto* bodies : {&system_.bodies, &system_.rigids})
      for (const auto& body : *bodies) {
        auto reach = body.bins.reach(system_.lattice, width);
        reach.resize(body.bins.list().size());  // without ghosts
        for (BlockReach<Dim>& nodes : reach) {
          const Index<Dim> middle = system_.lattice.block_at(nodes.block);
          Index<Dim> first, last;
          for (std::size_t d = 0; d < Dim; ++d) {
            nodes.low[d] -= more, nodes.high[d] += more;
            first[d] = std::max(middle[d] - (edge - 1 - nodes.low[d]) / edge, 0);
            last[d] = std::min(middle[d] + nodes.high[d] / edge, system_.lattice.blocks[d] - 1);
          }
          each_in_box<Dim>(first, last, [&](const Index<Dim>& block) {
            Index<Dim> low = nodes.low, high = nodes.high;
            for (std::size_t d = 0; d < Dim; ++d)
              low[d] -= (block[d] - middle[d]) * edge, high[d] -= (block[d] - middle[d]) * edge;
            f(block, nodes_in_box<Dim>(low, high));
          });
        }
      }
  };
  BlockBox<Dim> box;
  each_block([&](const Index<Dim>& block, std::uint64_t) { box.include(block); });
  around.reset(box);
  each_block([&](const Index<Dim>& block, std::uint64_t nodes) { around.at(block) |= nodes; });
  return around;
}

template <int Dim>
void Stepper<Dim>::scatter(Scatter what) {
  const auto lap = watches_.scatter.lap();
  if (what != Scatter::momentum) b_bar_.average_stress();
  of_all_.scatter(&Field<Dim>::nodes, what, false, system_.analysis == Analysis::axisymmetric);
  if (what != Scatter::force) scatter_rest(false);
}

template <int Dim>
void Stepper<Dim>::scatter_rest(bool from_start) {
  for (auto& body : system_.bodies) {
    auto& field = system_.fields[body.field];
    affine_at_walls_.add(body, field.map, field.nodes, from_start);
  }
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
  const double replaced = 1.0 - flip_share();
  for (std::size_t f = 0; f < conditions_.size(); ++f)
    if (!system_.fields[f].rigid_contact)
      conditions_[f].impose_update(system_.fields[f].nodes, *exchanges_[f], system_.time, dt, after_impose,
                                   system_.step == 0 || jump_, replaced);
  rigid_bodies_.impose_update(dt, after_impose);
}

template class Stepper<2>;
template class Stepper<3>;

}  // namespace tribo
