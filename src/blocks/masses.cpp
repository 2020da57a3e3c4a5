// SPDX-License-Identifier: MIT
/// Stiffness around blocks, masses of quasi-static runs, and the largest stable step.

#include "blocks/assembly.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace tribo {

// Sums over the contacts of every body.
std::vector<Assembly::Stiffness> Assembly::stiffness_around() const {
  std::vector<Stiffness> out(bodies.size());
  for (std::size_t k = 0; k < contacts.size(); ++k) {
    const Joint& j = joints[k];
    const BlockContact& c = contacts[k];
    const double stiff = std::max(j.kn, j.ks) * j.area;
    const double turning =
        std::max({j.twist_stiffness, j.bend_stiffness[0], j.bend_stiffness[1]}) + std::abs(j.bend_stiffness[2]);
    for (const auto& [body, arm] : {std::pair{c.a, c.pa}, std::pair{c.b, c.pb}}) {
      out[body].straight += stiff;
      out[body].turning += stiff * arm.squaredNorm() + turning;
    }
  }
  return out;
}

// Contacts that may form later, with the stiffest of their laws: around a ball as many balls of its size as fit, some
// of the stiffest balls on a block with faces, other blocks on half of its surface.
void Assembly::expect_neighbours(std::vector<Stiffness>& around) const {
  const auto at_least = [&](std::size_t k, double stiff, double turning = 0.0) {
    around[k].straight = std::max(around[k].straight, stiff);
    around[k].turning = std::max(around[k].turning, stiff * reach_[k] * reach_[k] + turning);
  };
  double stiffest_ball = 0;
  for (const auto k : balls_) {
    JointSite twin = ball_contact(k, k).second;
    twin.distance = 2 * shapes[k].radius, twin.gap = 0;
    for (const JointLaw* law : later_laws_) {
      const Joint j = law->start(twin);
      const double stiff = std::max(j.kn, j.ks) * j.area;
      const double count = plane_ ? 6 : 12;
      at_least(k, count * stiff, count * std::max({j.twist_stiffness, j.bend_stiffness[0], j.bend_stiffness[1]}));
      stiffest_ball = std::max(stiffest_ball, stiff);
    }
  }
  for (std::size_t k = 0; k < blocks_; ++k) {
    if (shapes[k].ball()) continue;
    JointSite site;
    for (std::size_t f = 0; f < shapes[k].faces.size(); ++f)
      site.area += 0.5 * face_geometry(shapes[k].face(f), plane_, thickness_).area;
    site.plane = plane_, site.thickness = thickness_;
    site.distance = plane_ ? std::sqrt(bodies[k].volume / thickness_) : std::cbrt(bodies[k].volume);
    for (const JointLaw* law : later_laws_) {
      const Joint j = law->start(site);
      at_least(k, std::max({std::max(j.kn, j.ks) * site.area, (plane_ ? 3 : 6) * stiffest_ball}));
    }
  }
}

// Masses for which max_step is 1/2 sqrt(m (1 - 2 nu)/k) of every block.
void Assembly::choose_masses(const std::vector<Stiffness>& around, double max_step, double nu) {
  const double per_stiffness = 4 * max_step * max_step / (1 - 2 * nu);
  for (std::size_t k = 0; k < blocks_; ++k) {
    if (!(around[k].straight > 0)) continue;
    BlockBody& body = bodies[k];
    body.mass = per_stiffness * around[k].straight;
    body.inertia = Vec3::Constant(per_stiffness * around[k].turning);
    body.axes = Mat3::Identity(), body.sphere = true;
  }
}

// Contacts that may form later are as many as those of a ball that is surrounded by others.
std::vector<Assembly::Stiffness> Assembly::viscosity_around(const std::vector<Stiffness>& stiffness) const {
  std::vector<Stiffness> out(bodies.size());
  for (const ContactGroup& group : groups) {
    const double ratio = group.law->damping_ratio();
    for (std::size_t k = group.begin; ratio > 0 && k < group.end; ++k) {
      const Joint& j = joints[k];
      const BlockContact& c = contacts[k];
      const double viscous = 2 * ratio * std::sqrt(mass_between(c.a, c.b) * std::max(j.kn, j.ks) * j.area);
      for (const auto& [body, arm] : {std::pair{c.a, c.pa}, std::pair{c.b, c.pb}})
        out[body].straight += viscous, out[body].turning += viscous * arm.squaredNorm();
    }
  }
  double later = 0;
  for (const JointLaw* law : later_laws_) later = std::max(later, law->damping_ratio());
  const double count = plane_ ? 6 : 12;
  for (std::size_t k = 0; later > 0 && k < blocks_; ++k) {
    const double viscous = 2 * later * std::sqrt(0.5 * count * bodies[k].mass * stiffness[k].straight);
    const double arms = stiffness[k].straight > 0 ? stiffness[k].turning / stiffness[k].straight : 0.0;
    out[k].straight = std::max(out[k].straight, viscous), out[k].turning = std::max(out[k].turning, viscous * arms);
  }
  return out;
}

void Assembly::set_step(const std::vector<Stiffness>& around, double max_step, double nu) {
  // The row sums of a block with springs k and dashpots c are 2 k/m and 2 c/m. The scheme is stable if
  // k dt^2/(2 m) + c dt/m <= 1; without dashpots this is half the square of sqrt(m/k).
  const auto stable = [](double mass, double stiffness, double viscosity) {
    const double lag = viscosity / stiffness;
    return (std::sqrt(lag * lag + 2 * mass / stiffness) - lag) / std::numbers::sqrt2;
  };
  const std::vector<Stiffness> viscosity = viscosity_around(around);
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < blocks_; ++k) {
    const BlockBody& body = bodies[k];
    const Stiffness& sum = around[k];
    double own = std::numeric_limits<double>::infinity();
    if (sum.straight > 0 && (body.held & 7) != 7) own = stable(body.mass, sum.straight, viscosity[k].straight);
    if (sum.turning > 0 && (body.held & 56) != 56)
      own = std::min(own, stable(body.inertia.minCoeff(), sum.turning, viscosity[k].turning));
    if (own < least) least = own, step_block_ = k;
  }
  // The fictitious stress makes the assembly stiffer than its springs
  const double stiffer = !poisson_       ? 1.0
                         : plane_stress_ ? std::sqrt(1 - nu * nu)
                                         : std::sqrt((1 + nu) * (1 - 2 * nu) / (1 - nu));
  critical_step_ = spec_->quasi_static ? max_step : std::min(max_step, spec_->step_share * stiffer * least);
}

// m_a m_b/(m_a + m_b); a body with prescribed motion has infinite mass.
double Assembly::mass_between(std::uint32_t a, std::uint32_t b) const {
  const bool free_a = (bodies[a].held & 7) != 7, free_b = (bodies[b].held & 7) != 7;
  const double ma = bodies[a].mass, mb = bodies[b].mass;
  return free_a && free_b ? ma * mb / (ma + mb) : free_a ? ma : free_b ? mb : 0.0;
}

}  // namespace tribo
