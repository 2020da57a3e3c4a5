// SPDX-License-Identifier: MIT
#include "run/travel_report.hpp"

#include "base/text.hpp"
#include "materials/material.hpp"

#include <Eigen/Cholesky>

#include <cmath>
#include <limits>

namespace tribo {
namespace {

struct Motion {
  Vec3 centre = Vec3::Zero(), spin = Vec3::Zero();
};

// Centre of mass and angular velocity of the particles of a material, from their angular momentum.
Motion mean_motion(const Seeds& seeds, int material, bool flat) {
  Motion out;
  Vec3 velocity = Vec3::Zero(), momentum = Vec3::Zero();
  Mat3 inertia = Mat3::Zero();
  double mass = 0.0;
  const auto each = [&](auto&& f) {
    for (const Seed& s : seeds)
      if (s.material == material) f(s);
  };
  each([&](const Seed& s) { mass += s.mass, out.centre += s.mass * s.x, velocity += s.mass * s.v; });
  if (!(mass > 0)) return out;
  out.centre /= mass, velocity /= mass;
  each([&](const Seed& s) {
    const Vec3 r = s.x - out.centre;
    momentum += s.mass * r.cross(s.v - velocity);
    inertia += s.mass * (r.squaredNorm() * Mat3::Identity() - r * r.transpose());
  });
  if (flat)
    out.spin[2] = inertia(2, 2) > 0 ? momentum[2] / inertia(2, 2) : 0.0;
  else
    out.spin = inertia.ldlt().solve(momentum);
  return out;
}

// When the first particle of a material leaves the grid; infinite if none does.
double leaves(const Model& model, const Seeds& seeds, int material) {
  const Motion motion = mean_motion(seeds, material, model.dimension() == 2);
  double first = std::numeric_limits<double>::infinity();
  for (const Seed& s : seeds) {
    if (s.material != material) continue;
    const Vec3 v = s.v - motion.spin.cross(s.x - motion.centre);
    for (int d = 0; d < model.dimension(); ++d) {
      const auto k = static_cast<std::size_t>(d);
      if (std::abs(v[d]) <= 1e-9 * s.v.norm() || model.grid.periodic[k] || model.grid.symmetry[k][v[d] > 0 ? 1 : 0])
        continue;
      const double room = v[d] > 0 ? model.grid.high[k] - s.x[d] : s.x[d] - model.grid.low[k];
      first = std::min(first, room / std::abs(v[d]));
    }
  }
  return first;
}

}  // namespace

Remarks describe_travel(const Model& model, const Seeds& seeds) {
  Remarks out;
  for (std::size_t m = 0; m < model.materials.size(); ++m) {
    const MaterialSpec& material = model.materials[m];
    if (!material.law || material.law->rigid()) continue;
    if (const double time = leaves(model, seeds, static_cast<int>(m)); time < model.time.end)
      out.advice.push_back(
          format("'%s' leaves the grid at time %.4g unless something stops it", material.name.c_str(), time));
  }
  return out;
}

}  // namespace tribo
