// SPDX-License-Identifier: MIT
#include "run/particle_blocks.hpp"

#include <algorithm>

namespace tribo {

template <int Dim>
ParticleBlocks<Dim>::ParticleBlocks(const Model& model, std::span<Body<Dim>* const> bodies,
                                    std::span<const PieceNumbers> pieces, std::size_t most) {
  static constexpr std::size_t most_bodies = 20;  // a folder of thousands of small files is of no use
  orders_.reserve(bodies.size());                 // ranges point into it
  for (auto* const body : bodies) {
    const std::string& name = model.materials[static_cast<std::size_t>(body->material)].name;
    const int number = body->material + 1;
    std::vector<std::pair<std::int64_t, std::int64_t>> parts;
    for (const PieceNumbers& p : pieces)
      if (model.pieces[static_cast<std::size_t>(p.piece)].material == body->material)
        parts.emplace_back(p.first, p.last);
    const std::size_t count = body->particles.size();
    if (parts.size() < 2 || parts.size() > most_bodies) {
      add({name, number}, {body, nullptr, 0, count}, most);
      continue;
    }
    const BodyOrder& order = orders_.emplace_back(order_by_body({body->particles.id.data(), count}, parts));
    std::size_t at = 0;
    for (std::size_t k = 0; k < order.counts.size(); ++k) {
      const bool later = k == parts.size();
      const std::string own_name = name + (later ? ", came later" : " " + std::to_string(k + 1));
      if (!later || order.counts[k] > 0 || model.particles_change() || model.splitting)
        add({own_name, number, name}, {body, order.particles.data(), at, at + order.counts[k]}, most);
      at += order.counts[k];
    }
  }
}

template <int Dim>
void ParticleBlocks<Dim>::add(const OutputBlock& block, const ParticleRange<Dim>& range, std::size_t most) {
  const std::size_t parts = std::max<std::size_t>(1, (range.count() + most - 1) / most);
  for (std::size_t k = 0; k < parts; ++k) {
    OutputBlock own = block;
    if (parts > 1) {
      own.group = block.group.empty() ? block.name : block.group;
      own.name += ", part " + std::to_string(k + 1) + " of " + std::to_string(parts);
    }
    if (!own.group.empty())
      own.part = !blocks_.empty() && blocks_.back().number == own.number ? blocks_.back().part + 1 : 1;
    blocks_.push_back(own);
    const auto from = [&](std::size_t part) { return range.begin + part * range.count() / parts; };
    ranges_.push_back({range.body, range.order, from(k), from(k + 1)});
  }
}

template class ParticleBlocks<2>;
template class ParticleBlocks<3>;

}  // namespace tribo
