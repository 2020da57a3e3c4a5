// SPDX-License-Identifier: MIT
#include "solver/contact/nodal_volumes.hpp"

#include "base/parallel.hpp"

#include <algorithm>

namespace tribo {

// Marks the blocks whose bins hold particles with a node in their stencil whose faces must be found, and the blocks
// whose nodes these particles reach.
template <int Dim>
void NodalVolumes<Dim>::mark_blocks(const ContactNodes<Dim>& contacts) {
  const auto each_node = [&](auto&& f) {
    for (const auto& node : contacts.nodes) {
      if (!node.needs_faces) continue;
      // A stencil that contains the node begins at most three nodes below it. One more cell is added for the drift of
      // the particles since the last sort.
      Index<Dim> low, high;
      for (std::size_t d = 0; d < Dim; ++d) {
        low[d] = std::max(0, (node.index[d] - 5) / block_edge<Dim>);
        high[d] = std::min(system_.lattice.blocks[d] - 1, (node.index[d] + 1) / block_edge<Dim>);
      }
      // Particles reach nodes of the next blocks, too.
      Index<Dim> reached_low, reached_high;
      for (std::size_t d = 0; d < Dim; ++d)
        reached_low[d] = std::max(0, low[d] - 1),
        reached_high[d] = std::min(system_.lattice.blocks[d] - 1, high[d] + 1);
      f(low, high, reached_low, reached_high);
    }
  };
  using Corner = const Index<Dim>&;
  BlockBox<Dim> box, reached_box;
  each_node([&](Corner low, Corner high, Corner reached_low, Corner reached_high) {
    box.include(low), box.include(high), reached_box.include(reached_low), reached_box.include(reached_high);
  });
  near_.reset(box), reached_.reset(reached_box);
  each_node([&](Corner low, Corner high, Corner reached_low, Corner reached_high) {
    each_in_box<Dim>(low, high, [&](Corner block) { near_.at(block) = 1; });
    each_in_box<Dim>(reached_low, reached_high, [&](Corner block) { reached_.at(block) = 1; });
  });
}

// Gives the members of contact nodes places for their values, and lists them by fields.
template <int Dim>
void NodalVolumes<Dim>::list_members(ContactNodes<Dim>& contacts) {
  members_of_.resize(system_.fields.size());
  for (auto& list : members_of_) list.clear();
  std::size_t count = 0;
  for (const auto& node : contacts.nodes) count += node.needs_faces ? node.end_member - node.first_member : 0;
  values_.resize(count);
  std::size_t value = 0;
  for (const auto& node : contacts.nodes) {
    if (!node.needs_faces) continue;
    for (std::size_t m = node.first_member; m < node.end_member; ++m, ++value) {
      ContactMember& member = contacts.members[m];
      member.volumes = &values_[value];
      members_of_[member.field].push_back({static_cast<std::size_t>(member.node), value});
    }
  }
}

// Finds the values of the members in a field and in the fields of the same bodies on other sides of cracks.
template <int Dim>
void NodalVolumes<Dim>::scatter_field(std::size_t field, Layers& layers, const Exchanges<Dim>& exchanges) {
  const auto& bodies = bodies_of_[field];
  if (bodies.empty()) return;
  std::array<std::size_t, 4> numbers{field};
  std::ranges::copy(bodies.front()->across_fields, numbers.begin() + 1);
  Target<Dim> target(system_.fields[field].map, layers[0]);
  for (std::size_t k = 0; k < numbers.size(); ++k) {
    if (numbers[k] >= system_.fields.size()) continue;
    const auto& map = system_.fields[numbers[k]].map;
    const bool has_images = exchanges[numbers[k]]->has_images();
    layers[k].resize(static_cast<std::size_t>(map.node_count()));
    for (std::size_t slot = 0; slot < map.active().size(); ++slot)
      if (has_images || reached_[system_.lattice.block_at(map.active()[slot])] != 0)
        std::fill_n(&layers[k][slot * block_nodes<Dim>], block_nodes<Dim>, VolumeNode{});
    target.map[k] = &map, target.nodes[k] = layers[k];
  }
  for (auto* body : bodies)
    transfers_.scatter(*body, target, Scatter::volume, false, system_.analysis == Analysis::axisymmetric, &near_);
  for (std::size_t k = 0; k < numbers.size(); ++k) {
    if (numbers[k] >= system_.fields.size()) continue;
    exchanges[numbers[k]]->sum_images(layers[k]);
    for (const auto& [node, value] : members_of_[numbers[k]]) values_[value] = layers[k][node];
  }
}

template <int Dim>
void NodalVolumes<Dim>::scatter(ContactNodes<Dim>& contacts, const std::vector<Body<Dim>*>& bodies,
                                const Exchanges<Dim>& exchanges) {
  mark_blocks(contacts);
  list_members(contacts);
  bodies_of_.resize(system_.fields.size());
  for (auto& list : bodies_of_) list.clear();
  for (auto* body : bodies) bodies_of_[body->field].push_back(body);
  // Where there are many fields, each thread takes whole fields, else the threads share the particles of each body.
  constexpr std::ptrdiff_t fields_per_thread = 4;
  layers_.resize(static_cast<std::size_t>(threads()));
  parallel_for(
      static_cast<std::ptrdiff_t>(system_.fields.size()),
      [&](std::ptrdiff_t f) {
        scatter_field(static_cast<std::size_t>(f), layers_[static_cast<std::size_t>(thread_index())], exchanges);
      },
      fields_per_thread * threads());
}

template class NodalVolumes<2>;
template class NodalVolumes<3>;

}  // namespace tribo
