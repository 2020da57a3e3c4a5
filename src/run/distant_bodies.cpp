// SPDX-License-Identifier: MIT
#include "run/distant_bodies.hpp"

#include "base/text.hpp"
#include "materials/material.hpp"

#include <algorithm>
#include <limits>
#include <map>
#include <optional>
#include <set>

namespace tribo {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

// The box around a particle.
struct ParticleBox {
  Vec3 low, high;
};

ParticleBox particle_box(const Seed& s) {
  const Vec3 half = (s.F * s.half_axes.value_or(Mat3(s.half_size.asDiagonal()))).cwiseAbs().rowwise().sum();
  return {s.x - half, s.x + half};
}

// The box around the particles of a material, and their mean velocity.
struct Extent {
  Vec3 low = Vec3::Constant(infinity), high = Vec3::Constant(-infinity), momentum = Vec3::Zero();
  double mass = 0.0;

  void add(const Seed& s) {
    const ParticleBox box = particle_box(s);
    low = low.cwiseMin(box.low), high = high.cwiseMax(box.high);
    mass += s.mass, momentum += s.mass * s.v;
  }
  Vec3 velocity() const { return mass > 0 ? Vec3(momentum / mass) : Vec3(Vec3::Zero()); }
};

// The distance of two boxes that lie beside each other along one axis, and this axis.
struct Distance {
  double size = infinity;
  Eigen::Index axis = 0;
};

Distance between(const Extent& a, const Extent& b, Eigen::Index dimension) {
  Distance out;
  for (Eigen::Index d = 0; d < dimension; ++d) {
    const double gap = std::max(a.low[d] - b.high[d], b.low[d] - a.high[d]);
    if (!(gap > 0)) continue;
    if (out.size < infinity) return {};
    out = {gap, d};
  }
  return out;
}

// The particles of a material that reach into a layer along an axis.
std::vector<ParticleBox> layer(const Seeds& seeds, int material, Eigen::Index axis, double low, double high) {
  std::vector<ParticleBox> out;
  for (const Seed& s : seeds)
    if (s.material == material)
      if (const ParticleBox box = particle_box(s); box.high[axis] > low && box.low[axis] < high) out.push_back(box);
  return out;
}

// The distance along an axis of the particles that lie opposite each other in the layers, of the thickness of a cell,
// at the faces of two boxes: a round or divided body may have none there. None if there are too many to compare.
std::optional<double> opposite(const Seeds& seeds, std::pair<int, double> below, std::pair<int, double> above,
                               Eigen::Index axis, Eigen::Index dimension, double cell) {
  constexpr std::size_t most = 20'000'000;
  const auto low = layer(seeds, below.first, axis, below.second - cell, below.second);
  const auto high = layer(seeds, above.first, axis, above.second, above.second + cell);
  if (low.size() * high.size() > most) return std::nullopt;
  double least = infinity;
  for (const ParticleBox& a : low)
    for (const ParticleBox& b : high) {
      bool meet = true;
      for (Eigen::Index d = 0; d < dimension; ++d)
        meet = meet && (d == axis || (a.low[d] < b.high[d] && b.low[d] < a.high[d]));
      if (meet) least = std::min(least, b.low[axis] - a.high[axis]);
    }
  return least < infinity ? std::optional(least) : std::nullopt;
}

// Whether bodies keep the velocities that they have at the start until they meet others.
bool fly_freely(const Model& model) {
  const BodyForce& force = model.body_force;
  const auto any = [](const auto& functions) { return functions[0] || functions[1] || functions[2]; };
  return force.gravity.isZero() && !any(force.function) && !force.acts_on_particles() &&
         std::none_of(model.materials.begin(), model.materials.end(),
                      [&](const MaterialSpec& m) { return any(m.rigid_velocity); });
}

// When two bodies meet along an axis with the velocities that they have at the start.
std::string meeting(const Extent& a, const Extent& b, const Distance& distance) {
  const double relative = (a.velocity() - b.velocity())[distance.axis];
  const double closing = a.low[distance.axis] > b.high[distance.axis] ? -relative : relative;
  return closing > 0 ? format(", closed at time %.4g", distance.size / closing) : std::string();
}

}  // namespace

std::vector<std::string> distant_bodies(const Model& model, const Seeds& seeds, const Gaps& gaps, double cell) {
  std::set<int> near;
  for (const auto& [pair, gap] : gaps)
    if (gap < 1) near.insert({pair.first, pair.second});
  std::map<int, Extent> extents;
  const auto of = [&](int k) -> const MaterialSpec& { return model.materials[static_cast<std::size_t>(k)]; };
  for (const Seed& s : seeds)
    if (!of(s.material).law->rigid() || of(s.material).touches()) extents[s.material].add(s);
  std::map<std::pair<int, int>, std::string> out;
  for (const auto& [a, extent] : extents) {
    if (near.count(a)) continue;
    Distance least;
    int neighbour = -1;
    for (const auto& [b, other] : extents) {
      const Distance found = between(extent, other, model.dimension());
      if (b != a && found.size < least.size) least = found, neighbour = b;
    }
    if (neighbour < 0) continue;
    const std::pair<int, int> pair = std::minmax(a, neighbour);
    const Extent& other = extents.at(neighbour);
    const bool below = extent.high[least.axis] < other.low[least.axis];
    const std::pair<int, double> lower{below ? a : neighbour, (below ? extent : other).high[least.axis]},
        upper{below ? neighbour : a, (below ? other : extent).low[least.axis]};
    const auto found = opposite(seeds, lower, upper, least.axis, model.dimension(), cell);
    if (!found) continue;
    least.size = *found;
    out[pair] =
        "'" + of(std::min(a, neighbour)).name + "' and '" + of(std::max(a, neighbour)).name + "', " +
        counted(least.size / cell, "cell", "%.3g") +
        format(" (%.4g %s) along %c", least.size, model.units.name(Dimension::length).c_str(), "xyz"[least.axis]) +
        (fly_freely(model) ? meeting(extent, other, least) : std::string());
  }
  std::vector<std::string> texts;
  for (const auto& [pair, text] : out) texts.push_back(text);
  return texts;
}

}  // namespace tribo
