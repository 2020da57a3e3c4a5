// SPDX-License-Identifier: MIT
#include "run/particle_blocks.hpp"

#include <algorithm>

namespace tribo {

template <int Dim>
ParticleBlocks<Dim>::ParticleBlocks(const Model& model, std::span<Body<Dim>* const> bodies,
                                    std::span<const PieceNumbers> pieces, std::size_t most) {
  orders_.reserve(bodies.size());  // ranges point into it
  for (std::size_t k = 0; k < bodies.size();) {
    std::size_t end = k + 1;
    while (end < bodies.size() && bodies[end]->material == bodies[k]->material) ++end;
    if (model.materials[static_cast<std::size_t>(bodies[k]->material)].separate)
      add_bodies(model, bodies.subspan(k, end - k), most);
    else
      for (std::size_t i = k; i < end; ++i) add_material(model, *bodies[i], pieces, most);
    k = end;
  }
}

// Adds a material whose bodies are stored together.
template <int Dim>
void ParticleBlocks<Dim>::add_material(const Model& model, Body<Dim>& body, std::span<const PieceNumbers> pieces,
                                       std::size_t most) {
  const std::string& name = model.materials[static_cast<std::size_t>(body.material)].name;
  const int number = body.material + 1;
  std::vector<std::pair<std::int64_t, std::int64_t>> parts;
  for (const PieceNumbers& p : pieces)
    if (model.pieces[static_cast<std::size_t>(p.piece)].material == body.material) parts.emplace_back(p.first, p.last);
  const std::size_t count = body.particles.size();
  if (parts.size() < 2 || parts.size() > most_bodies) return add({name, number}, {{nullptr, 0, count}, &body}, most);
  const BodyOrder& order = orders_.emplace_back(order_by_body({body.particles.id.data(), count}, parts));
  std::size_t at = 0;
  for (std::size_t k = 0; k < order.counts.size(); ++k) {
    const bool later = k == parts.size();
    const std::string own_name = name + (later ? ", came later" : " " + std::to_string(k + 1));
    if (!later || order.counts[k] > 0 || model.particles_change() || model.splitting)
      add({own_name, number, name}, {{order.particles.data(), at, at + order.counts[k]}, &body}, most);
    at += order.counts[k];
  }
}

// Adds the bodies of a material that touch each other and are stored one by one.
template <int Dim>
void ParticleBlocks<Dim>::add_bodies(const Model& model, std::span<Body<Dim>* const> bodies, std::size_t most) {
  const auto all_of = [](Body<Dim>* body) { return ParticleRange<Dim>{{nullptr, 0, body->particles.size()}, body}; };
  const auto name = [&](int material) { return model.materials[static_cast<std::size_t>(material)].name; };
  const int material = bodies.front()->material;
  if (bodies.size() <= most_bodies) {
    for (Body<Dim>* body : bodies) add({name(body->own_material), material + 1, name(material)}, all_of(body), most);
    return;
  }
  std::vector<Ranges> parts(1);
  std::size_t count = 0;
  for (Body<Dim>* body : bodies) {
    count += body->particles.size();
    if (count > most && !parts.back().empty()) parts.emplace_back(), count = body->particles.size();
    parts.back().push_back(all_of(body));
  }
  add_parts({name(material), material + 1}, parts);
}

template <int Dim>
void ParticleBlocks<Dim>::add(const OutputBlock& block, const ParticleRange<Dim>& range, std::size_t most) {
  const std::size_t count = std::max<std::size_t>(1, (range.count() + most - 1) / most);
  const auto from = [&](std::size_t part) { return range.begin + part * range.count() / count; };
  std::vector<Ranges> parts;
  for (std::size_t k = 0; k < count; ++k) parts.push_back({{{range.order, from(k), from(k + 1)}, range.body}});
  add_parts(block, parts);
}

template <int Dim>
void ParticleBlocks<Dim>::add_parts(const OutputBlock& block, const std::vector<Ranges>& parts) {
  for (std::size_t k = 0; k < parts.size(); ++k) {
    OutputBlock own = block;
    if (parts.size() > 1) {
      own.group = block.group.empty() ? block.name : block.group;
      own.name += ", part " + std::to_string(k + 1) + " of " + std::to_string(parts.size());
    }
    if (!own.group.empty())
      own.part = !blocks_.empty() && blocks_.back().number == own.number ? blocks_.back().part + 1 : 1;
    blocks_.push_back(own);
    first_.push_back(ranges_.size());
    ranges_.insert(ranges_.end(), parts[k].begin(), parts[k].end());
  }
}

template class ParticleBlocks<2>;
template class ParticleBlocks<3>;

}  // namespace tribo
