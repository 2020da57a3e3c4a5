// SPDX-License-Identifier: MIT
#include "run/distant_bodies.hpp"

#include "base/text.hpp"
#include "materials/material.hpp"

#include <limits>
#include <map>

namespace tribo {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

// The box around the particles of a material, and their mean velocity.
struct Extent {
  Vec3 low = Vec3::Constant(infinity), high = Vec3::Constant(-infinity), momentum = Vec3::Zero();
  double mass = 0.0;

  void add(const Seed& s) {
    const Vec3 half = (s.F * s.half_axes.value_or(Mat3(s.half_size.asDiagonal()))).cwiseAbs().rowwise().sum();
    low = low.cwiseMin(s.x - half), high = high.cwiseMax(s.x + half);
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

// When two bodies meet along an axis with the velocities that they have at the start.
std::string meeting(const Extent& a, const Extent& b, const Distance& distance) {
  const double relative = (a.velocity() - b.velocity())[distance.axis];
  const double closing = a.low[distance.axis] > b.high[distance.axis] ? -relative : relative;
  return closing > 0 ? format(", closed at time %.4g", distance.size / closing) : std::string();
}

}  // namespace

std::vector<std::string> distant_bodies(const Model& model, const Seeds& seeds, const std::set<int>& near,
                                        double cell) {
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
    out[std::minmax(a, neighbour)] =
        "'" + of(std::min(a, neighbour)).name + "' and '" + of(std::max(a, neighbour)).name + "', " +
        counted(least.size / cell, "cell", "%.3g") +
        format(" (%.4g %s) along %c", least.size, model.units.name(Dimension::length).c_str(), "xyz"[least.axis]) +
        meeting(extent, extents.at(neighbour), least);
  }
  std::vector<std::string> texts;
  for (const auto& [pair, text] : out) texts.push_back(text);
  return texts;
}

}  // namespace tribo
