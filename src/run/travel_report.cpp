// SPDX-License-Identifier: MIT
#include "run/travel_report.hpp"

#include "base/text.hpp"
#include "materials/material.hpp"

#include <Eigen/Cholesky>

#include <cmath>
#include <limits>
#include <optional>
#include <vector>

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

// The particles of a material that lie farthest out along each axis.
std::vector<Seed> outermost(const Model& model, const Seeds& seeds, int material) {
  std::vector<Seed> out;
  for (int d = 0; d < model.dimension(); ++d)
    for (const double side : {-1.0, 1.0}) {
      std::optional<Seed> most;
      for (const Seed& s : seeds)
        if (s.material == material && (!most || side * s.x[d] > side * most->x[d])) most = s;
      if (most) out.push_back(*most);
    }
  return out;
}

// When a rigid body leaves the grid: its outermost particles are moved along by steps of the midpoint rule. Infinite if
// they stay inside.
double rigid_leaves(const Model& model, const Seeds& seeds, int number) {
  constexpr int steps = 500;
  const MaterialSpec& material = model.materials[static_cast<std::size_t>(number)];
  const double dt = model.time.end / steps, unit = model.units.alternative_time();
  double first = std::numeric_limits<double>::infinity();
  for (const Seed& seed : outermost(model, seeds, number)) {
    const auto velocity = [&](const Vec3& x, double time) {
      Vec3 v = seed.v;
      for (std::size_t d = 0; d < 3; ++d)
        if (material.rigid_velocity[d])
          v[static_cast<Eigen::Index>(d)] = (*material.rigid_velocity[d])(Variables::at(x, time / unit));
      return v;
    };
    Vec3 x = seed.x;
    for (int k = 0; k < steps && k * dt < first; ++k) {
      const double time = k * dt;
      x += dt * velocity(x + 0.5 * dt * velocity(x, time), time + 0.5 * dt);
      for (int d = 0; d < model.dimension(); ++d) {
        const auto axis = static_cast<std::size_t>(d);
        if (!model.grid.periodic[axis] && (x[d] < model.grid.low[axis] || x[d] > model.grid.high[axis]))
          first = std::min(first, time + dt);
      }
    }
  }
  return first;
}

// Whether the model prescribes the motion of a rigid body from its start to its end.
bool is_known(const Model& model, int material) {
  return model.stages.empty() && !model.reversal && !(model.load_control && model.load_control->material == material);
}

}  // namespace

Remarks describe_travel(const Model& model, const Seeds& seeds) {
  Remarks out;
  for (std::size_t m = 0; m < model.materials.size(); ++m) {
    const MaterialSpec& material = model.materials[m];
    if (!material.law) continue;
    const auto number = static_cast<int>(m);
    if (material.law->rigid()) {
      if (!is_known(model, number)) continue;
      if (const double time = rigid_leaves(model, seeds, number); time < model.time.end)
        out.advice.push_back(
            format("the rigid body '%s' leaves the grid at time %.3g, at which the run will stop: a larger grid, or an "
                   "earlier end",
                   material.name.c_str(), time));
      continue;
    }
    if (const double time = leaves(model, seeds, number); time < model.time.end)
      out.advice.push_back(
          format("'%s' leaves the grid at time %.4g unless something stops it", material.name.c_str(), time));
  }
  return out;
}

}  // namespace tribo
