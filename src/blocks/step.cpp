// SPDX-License-Identifier: MIT
/// One step of the blocks: leapfrog, contacts in batches, forces gathered by every block in the order of its contacts,
/// so that sums do not depend on the number of threads.

#include "base/parallel.hpp"
#include "blocks/facet_increments.hpp"
#include "blocks/jumps.hpp"
#include "blocks/kinematics.hpp"

#include <algorithm>
#include <cmath>

namespace tribo {
namespace {

/// The increment of a contact whose bodies have moved; updates its axes and position.
template <ContactKind Kind, bool Plane>
void follow(BlockContact& c, const BlockMotion& a, const BlockMotion& b, const Vec3& shift, const Vec3& shift_velocity,
            double dt, Vec3& at, JointIncrement& d) {
  const Vec3 xb = b.x + shift;
  const ContactFrame before{c.axes, at};
  Vec3 n;
  if constexpr (Kind == ContactKind::ball) {
    const Vec3 apart = xb - a.x;
    const double distance = apart.norm();
    n = apart / distance;
    d.gap = distance - c.na[0] - c.nb[0];
    at = a.x + (c.na[0] + 0.5 * d.gap) * n;
  } else {
    const Vec3 pa = a.x + a.R * c.pa, pb = xb + b.R * c.pb;
    n = ((1 - c.on_a) * (a.R * c.na) + c.on_a * (b.R * c.nb)).normalized();
    d.gap = (pb - pa).dot(n);
    at = c.on_a * pa + (1 - c.on_a) * pb;
  }
  c.axes = carried<Plane>(c.axes, n, a, b, dt);
  count_increment<Plane>(a, b, shift, shift_velocity, before, {c.axes, at}, dt, d);
  d.mass = c.mass;
}

double local_damping(double alpha, double force, double velocity) {
  return velocity == 0 ? 0.0 : -alpha * std::abs(force) * (velocity > 0 ? 1.0 : -1.0);
}

}  // namespace

void Assembly::advance(double dt) {
  move_bodies(dt);
  if (skin_ > 0) refuse_jumps(*this, dt, 0.05 * skin_);
  if (!later_laws_.empty() && moved(found_at_, 0.25 * skin_)) find_pairs(dt);
  const auto batch_count = static_cast<std::ptrdiff_t>(batches_.size());
  if (iterations_ > 0 && poisson_) iterate_stress(dt);
  parallel_for(batch_count, [&](std::ptrdiff_t k) { update_contacts(batches_[static_cast<std::size_t>(k)], dt); });
  const double with_rest = dt + time_error_, later = time + with_rest;  // compensated sum
  time_error_ = with_rest - (later - time), time = later, ++step, last_step_ = dt;
  for (std::size_t k = 0; k < batches_.size(); ++k) {
    for (const JointEvent& e : batch_events_[k]) {
      const std::size_t contact = batches_[k].begin + e.contact;
      BlockEvent out{time, contact, contact_forces[contact].at, e};
      out.event.contact = contact;
      if (e.kind == JointEvent::Kind::bond_break) ++broken[e.mode == 1 ? 0 : 1], failure_mode[contact] = e.mode;
      events_.push_back(out);
    }
    batch_events_[k].clear();
  }
  apply_pressures();
  parallel_for(static_cast<std::ptrdiff_t>(bodies.size()),
               [&](std::ptrdiff_t k) { sum_forces(static_cast<std::size_t>(k), dt); });
}

// From the middle of the last step to that of this; the very first velocities are those of the start. The forces
// of a grid in this step act over the whole step.
void Assembly::move_bodies(double dt) {
  const double middle = time + 0.5 * dt, kick = 0.5 * (last_step_ + dt);
  for (std::size_t g = 0; g < prescribed_motions_.size(); ++g)
    for (std::size_t d = 0; d < 6; ++d)
      prescribed_now_[g][d] = prescribed_motions_[g].of[d] ? prescribed_motions_[g].of[d]->at(middle) : 0.0;
  parallel_for(static_cast<std::ptrdiff_t>(bodies.size()), [&](std::ptrdiff_t i) {
    const auto k = static_cast<std::size_t>(i);
    const BlockBody& body = bodies[k];
    const BlockForces& f = forces[k];
    BlockMotion& m = motion[k];
    const GridForce grid = grid_forces.empty() ? GridForce{} : grid_forces[k];
    const Vec3 old_v = m.v, old_w = m.w;
    if ((body.held & 7) != 7) m.v += (kick * (f.all + f.damping) + dt * grid.force) / body.mass;
    if ((body.held & 56) != 56) {
      const Vec3 turning = kick * (f.moment + f.damping_moment) + dt * grid.moment;
      if (plane_) {
        m.w[2] += turning[2] / body.inertia[2];
      } else if (body.sphere) {
        m.w += turning / body.inertia[0];
      } else {
        // Euler's equations, with the mean of the old and new rotation
        const Mat3 axes = m.R * body.axes;
        const Vec3 M = axes.transpose() * turning, old = axes.transpose() * m.w, inverse = body.inertia.cwiseInverse();
        Vec3 w = old;
        for (int pass = 0; pass < 3; ++pass) {
          const Vec3 mean = 0.5 * (old + w);
          w = old + (M - kick * mean.cross(body.inertia.cwiseProduct(mean))).cwiseProduct(inverse);
        }
        m.w = axes * w;
      }
    }
    if (body.hold >= 0) {
      const auto& now = prescribed_now_[static_cast<std::size_t>(body.hold)];
      for (int d = 0; d < 3; ++d) {
        if (body.held & (1 << d)) m.v[d] = now[static_cast<std::size_t>(d)];
        if (body.held & (8 << d)) m.w[d] = now[static_cast<std::size_t>(d) + 3];
      }
    }
    for (int d = 0; d < 3 && (!grid_forces.empty() || dt != last_step_); ++d) {
      const double jump = 0.25 * (last_step_ - dt);
      if (!(body.held & (1 << d))) {
        work[k].outer += 0.5 * dt * grid.force[d] * (old_v[d] + m.v[d]);
        work[k].stepping += jump * (f.all[d] + f.damping[d]) * (m.v[d] - old_v[d]);
      }
      if (!(body.held & (8 << d))) {
        work[k].outer += 0.5 * dt * grid.moment[d] * (old_w[d] + m.w[d]);
        work[k].stepping += jump * (f.moment[d] + f.damping_moment[d]) * (m.w[d] - old_w[d]);
      }
    }
    m.x += dt * m.v;
    if (m.w.isZero(0.0)) return;
    // By R_new - R_old = dt w x (R_old + R_new)/2, whose angle is 2 atan(dt |w|/2)
    const Vec3 half = 0.5 * dt * m.w;
    auto& q = orientation[k];
    const Eigen::Quaterniond next =
        (Eigen::Quaterniond(1, half[0], half[1], half[2]) * Eigen::Quaterniond(q[0], q[1], q[2], q[3])).normalized();
    q = {next.w(), next.x(), next.y(), next.z()};
    m.R = next.toRotationMatrix();
  });
  if (!box_rate.isZero(0.0))
    for (Vec3& s : shift) s += dt * box_rate * s;
}

void Assembly::increments(const Batch& batch, double dt, JointIncrement* to) {
  switch (groups[batch.group].kind) {
    case ContactKind::overlap:
      return overlap_increments(batch, dt, to);
    case ContactKind::ball_on_face:
      return ball_on_face_increments(batch, dt, to);
    case ContactKind::ball:
      return plane_ ? following_increments<ContactKind::ball, true>(batch, dt, to)
                    : following_increments<ContactKind::ball, false>(batch, dt, to);
    case ContactKind::facet:
      return plane_ ? following_increments<ContactKind::facet, true>(batch, dt, to)
                    : facet_increments(*this, batch.begin, batch.end, dt, to);
  }
}

template <ContactKind Kind, bool Plane>
void Assembly::following_increments(const Batch& batch, double dt, JointIncrement* to) {
  Vec3 by = Vec3::Zero(), speed = Vec3::Zero();
  for (std::size_t k = batch.begin; k < batch.end; ++k, ++to) {
    BlockContact& c = contacts[k];
    if (!shift.empty()) by = shift[k], speed = box_rate * by;
    follow<Kind, Plane>(c, motion[c.a], motion[c.b], by, speed, dt, contact_forces[k].at, *to);
  }
}

void Assembly::update_contacts(const Batch& batch, double dt) {
  std::array<JointIncrement, batch_size> steps;
  const ContactGroup& group = groups[batch.group];
  const std::size_t count = batch.end - batch.begin;
  JointIncrement* d = steps.data();
  if (kept_increments_.empty())
    increments(batch, dt, d);
  else
    d = kept_increments_.data() + batch.begin;
  for (std::size_t k = 0; k < count; ++k) d[k].time = time + dt;
  if (group.law->has_pore_pressure())
    for (std::size_t k = 0; k < count; ++k)
      d[k].pressure = group.law->pore_pressure(contact_forces[batch.begin + k].at, d[k].time);
  if (const double nu = group.law->poisson(); nu != 0)
    for (std::size_t k = 0; k < count; ++k) {
      const BlockContact& c = contacts[batch.begin + k];
      const PoissonForce f =
          poisson_force(mean_stress_at(c, nu), nu, group.law->off_diagonal(), joints[batch.begin + k].area, c.axes);
      d[k].poisson_normal = f.normal, d[k].poisson_shear = f.shear;
    }
  std::array<double, batch_size> normal;
  std::array<Tangent, batch_size> shear;
  for (std::size_t k = 0; k < count; ++k) {
    const Joint& j = joints[batch.begin + k];
    normal[k] = j.dashpot_normal, shear[k] = j.dashpot_shear;
  }
  group.law->update({joints.data() + batch.begin, count}, {d, count},
                    batch_events_[static_cast<std::size_t>(&batch - batches_.data())]);
  for (std::size_t k = 0; k < count; ++k) {
    // by the trapezoidal rule, as the work in leapfrog
    const Joint& j = joints[batch.begin + k];
    dashpot_work[batch.begin + k] +=
        0.5 * ((normal[k] + j.dashpot_normal) * d[k].normal - (shear[k] + j.dashpot_shear).dot(d[k].shear));
    set_force(batch.begin + k);
  }
}

void Assembly::set_force(std::size_t k) {
  const Joint& j = joints[k];
  const JointAxes& axes = contacts[k].axes;
  ContactForce& f = contact_forces[k];
  f.elastic = axes.vector(j.Fs) - j.Fn * axes.n;
  f.all = f.elastic + axes.vector(j.dashpot_shear) - j.dashpot_normal * axes.n;
  f.moment = axes.vector(j.Mb) + (j.Mt - (j.Fn + j.dashpot_normal) * contacts[k].couple) * axes.n;
}

// Uniform pressures act at the centroids of faces.
void Assembly::apply_pressures() {
  if (pressed.empty()) return;
  for (std::size_t k = 0; k < pressure_now_.size(); ++k) pressure_now_[k] = spec_->pressures[k].pressure.at(time);
  for (std::size_t k = 0; k < pressed.size(); ++k) {
    const PressedFace& p = pressed[k];
    const BlockMotion& m = motion[p.body];
    const Vec3 n = spec_->pressures[p.pressure].follows ? Vec3(m.R * p.n) : p.n;
    pressed_force_[k].at = m.x + m.R * p.p;
    pressed_force_[k].all = pressed_force_[k].elastic = -pressure_now_[p.pressure] * p.area * n;
  }
}

void Assembly::sum_forces(std::size_t k, double dt) {
  const BlockBody& body = bodies[k];
  const BlockMotion& m = motion[k];
  BlockForces now;
  for (std::uint32_t e = first_[k]; e < first_[k + 1]; ++e) {
    const std::uint32_t c = entries_[e] / 2, end = entries_[e] % 2;
    const ContactForce& f = contact_forces[c];
    const double sign = 2.0 * end - 1.0;  // without branches, as the ends come in no order
    const Vec3 at = shift.empty() ? f.at : Vec3(f.at - static_cast<double>(end) * shift[c]);
    now.all += sign * f.all;
    now.moment += sign * ((at - m.x).cross(f.all) + f.moment);
  }
  if (!first_pressed_.empty())
    for (std::uint32_t e = first_pressed_[k]; e < first_pressed_[k + 1]; ++e) {
      const ContactForce& f = pressed_force_[pressed_of_[e]];
      now.outer += f.all, now.outer_moment += (f.at - m.x).cross(f.all);
    }
  for (auto load = std::lower_bound(loaded_.begin(), loaded_.end(), std::pair(static_cast<std::uint32_t>(k), 0u));
       load != loaded_.end() && load->first == k; ++load)
    for (std::size_t d = 0; d < 3; ++d) {
      const BlockLoad& l = spec_->loads[load->second];
      const auto i = static_cast<Eigen::Index>(d);
      if (l.force[d]) now.outer[i] += l.force[d]->at(time);
      if (l.moment[d]) now.outer_moment[i] += l.moment[d]->at(time);
    }
  now.all += now.outer + body.weight * gravity_, now.moment += now.outer_moment;
  if (damping_ > 0 && body.held != 63) {
    const GridForce grid = grid_forces.empty() ? GridForce{} : grid_forces[k];
    for (int d = 0; d < 3; ++d) {
      if (!(body.held & (1 << d))) now.damping[d] = local_damping(damping_, now.all[d] + grid.force[d], m.v[d]);
      if (!(body.held & (8 << d)))
        now.damping_moment[d] = local_damping(damping_, now.moment[d] + grid.moment[d], m.w[d]);
    }
  }
  // Work of the mean of the forces before and after: which leapfrog converts to changes of m v(-1/2) v(+1/2)/2.
  BlockForces& old = forces[k];
  if (dt > 0) {
    const Vec3 dx = 0.5 * dt * m.v, dr = 0.5 * dt * m.w;
    work[k].outer += (old.outer + now.outer).dot(dx) + (old.outer_moment + now.outer_moment).dot(dr);
    work[k].damped -= (old.damping + now.damping).dot(dx) + (old.damping_moment + now.damping_moment).dot(dr);
    for (int d = 0; d < 3; ++d) {
      if (body.held & (1 << d)) work[k].boundary -= (old.all[d] + now.all[d]) * dx[d];
      if (body.held & (8 << d)) work[k].boundary -= (old.moment[d] + now.moment[d]) * dr[d];
    }
  }
  old = now;
  if (poisson_) stress[k] = stress_of(k);
}

}  // namespace tribo
