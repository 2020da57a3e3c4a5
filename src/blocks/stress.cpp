// SPDX-License-Identifier: MIT
/// Stresses of blocks, the fictitious stress that follows from them, and measures of an assembly.

#include "base/parallel.hpp"
#include "blocks/assembly.hpp"

#include <algorithm>
#include <cmath>

namespace tribo {

// sigma = 1/V sum f (x - x_ref), forces of springs, pressures and the grid, without dashpots.
Mat3 Assembly::stress_of(std::size_t k) const {
  const BlockBody& body = bodies[k];
  if (!(body.volume > 0)) return Mat3::Zero();
  const Vec3 centre = motion[k].x + motion[k].R * body.reference;
  Mat3 sum = Mat3::Zero();
  for (std::uint32_t e = first_[k]; e < first_[k + 1]; ++e) {
    const std::uint32_t c = entries_[e] / 2, end = entries_[e] % 2;
    const Vec3 at = end && !shift.empty() ? Vec3(contact_forces[c].at - shift[c]) : contact_forces[c].at;
    sum += (end ? 1.0 : -1.0) * contact_forces[c].elastic * (at - centre).transpose();
  }
  if (!first_pressed_.empty())
    for (std::uint32_t e = first_pressed_[k]; e < first_pressed_[k + 1]; ++e) {
      const ContactForce& f = pressed_force_[pressed_of_[e]];
      sum += f.all * (f.at - centre).transpose();
    }
  if (!grid_forces.empty()) sum += grid_forces[k].spread - grid_forces[k].force * (centre - motion[k].x).transpose();
  return (0.5 / body.volume) * (sum + sum.transpose());
}

// Mean of the two bodies by volume; in plane strain with the out-of-plane stress.
Mat3 Assembly::mean_stress_at(const BlockContact& c, double nu) const {
  const double a = bodies[c.a].stress_weight, b = bodies[c.b].stress_weight;
  if (!(a + b > 0)) return Mat3::Zero();
  Mat3 s = (a * stress[c.a] + b * stress[c.b]) / (a + b);
  if (plane_) s(2, 2) = plane_stress_ ? 0.0 : nu * (s(0, 0) + s(1, 1));
  return s;
}

// The fictitious stress belongs to the stress at the end of the step, which follows from it: a few fixed-point
// iterations with the final increments of the springs. Whole bonds only; others keep their force.
void Assembly::iterate_stress(double dt) {
  const auto batch_count = static_cast<std::ptrdiff_t>(batches_.size());
  parallel_for(batch_count, [&](std::ptrdiff_t i) {
    const Batch& batch = batches_[static_cast<std::size_t>(i)];
    const JointLaw& law = *groups[batch.group].law;
    JointIncrement* d = kept_increments_.data() + batch.begin;
    increments(batch, dt, d);
    for (std::size_t k = batch.begin; k < batch.end; ++k, ++d) {
      const Joint& j = joints[k];
      const JointAxes& axes = contacts[k].axes;
      predicted_[k] = axes.vector(j.Fs) - j.Fn * axes.n;
      if (law.is_bonded(j))
        predicted_[k] += axes.vector((-1.0) * j.poisson_shear - (j.ks * j.area) * d->shear) -
                         (j.kn * j.area * d->normal - j.poisson_normal) * axes.n;
    }
  });
  for (int pass = 0; pass < iterations_; ++pass) {
    parallel_for(batch_count, [&](std::ptrdiff_t i) {
      const Batch& batch = batches_[static_cast<std::size_t>(i)];
      const JointLaw& law = *groups[batch.group].law;
      const double nu = law.poisson();
      for (std::size_t k = batch.begin; k < batch.end; ++k) {
        contact_forces[k].elastic = predicted_[k];
        if (nu == 0 || !law.is_bonded(joints[k])) continue;
        const BlockContact& c = contacts[k];
        const PoissonForce f = poisson_force(mean_stress_at(c, nu), nu, law.off_diagonal(), joints[k].area, c.axes);
        contact_forces[k].elastic += c.axes.vector(f.shear) - f.normal * c.axes.n;
      }
    });
    apply_pressures();
    parallel_for(static_cast<std::ptrdiff_t>(bodies.size()), [&](std::ptrdiff_t k) {
      stress[static_cast<std::size_t>(k)] = stress_of(static_cast<std::size_t>(k));
    });
  }
}

BlockLedger Assembly::ledger() const {
  BlockLedger out = removed_;
  for (std::size_t k = 0; k < bodies.size(); ++k) {
    const BlockBody& body = bodies[k];
    const BlockMotion& m = motion[k];
    const BlockForces& f = forces[k];
    const Mat3 axes = m.R * body.axes;
    const Vec3 spin = axes.transpose() * m.w;
    const bool whole = body.sphere || plane_;  // then every component separately
    for (int d = 0; d < 3; ++d) {
      if (!(body.held & (1 << d)))
        out.kinetic += 0.5 * m.v[d] * (body.mass * m.v[d] + last_step_ * (f.all[d] + f.damping[d]));
      if (body.held & (8 << d)) continue;
      const double inertia = body.inertia[plane_ ? 2 : d];
      out.kinetic += 0.5 * inertia * (whole ? m.w[d] * m.w[d] : spin[d] * spin[d]) +
                     0.5 * last_step_ * m.w[d] * (f.moment[d] + f.damping_moment[d]);
    }
    out.potential -= body.weight * gravity_.dot(m.x - body.start);
    out.outer_work += work[k].outer, out.boundary_work += work[k].boundary, out.damping += work[k].damped;
    out.stepping += work[k].stepping;
  }
  for (std::size_t k = 0; k < joints.size(); ++k) {
    const Joint& j = joints[k];
    out.strain += j.strain, out.slip -= j.slid, out.released += j.released(), out.dashpot += dashpot_work[k];
  }
  return out;
}

Mat3 Assembly::mean_stress() const {
  Mat3 sum = Mat3::Zero();
  double volume = 0;
  for (std::size_t k = 0; k < blocks_; ++k) sum += bodies[k].volume * stress_of(k), volume += bodies[k].volume;
  return volume > 0 ? Mat3(sum / volume) : sum;
}

// Least squares of u - u_mean = G (X - X_mean), by volume; of the reference points, which move uniformly in a uniform
// strain.
Mat3 Assembly::mean_strain() const {
  double volume = 0;
  Vec3 mean_x = Vec3::Zero(), mean_u = Vec3::Zero();
  std::vector<Vec3> x(blocks_), u(blocks_);
  for (std::size_t k = 0; k < blocks_; ++k) {
    x[k] = bodies[k].start + bodies[k].reference;
    u[k] = motion[k].x - bodies[k].start + (motion[k].R * bodies[k].reference - bodies[k].reference);
    volume += bodies[k].volume, mean_x += bodies[k].volume * x[k], mean_u += bodies[k].volume * u[k];
  }
  mean_x /= volume, mean_u /= volume;
  Mat3 xx = Mat3::Zero(), ux = Mat3::Zero();
  for (std::size_t k = 0; k < blocks_; ++k) {
    xx += bodies[k].volume * (x[k] - mean_x) * (x[k] - mean_x).transpose();
    ux += bodies[k].volume * (u[k] - mean_u) * (x[k] - mean_x).transpose();
  }
  // directions without extent have no strain
  const double size = xx.trace();
  if (!(size > 0)) return Mat3::Zero();
  Mat3 inverse = Mat3::Zero();
  if (plane_) xx(2, 2) = size;
  if (std::abs(xx.determinant()) > 1e-12 * size * size * size)
    inverse = xx.inverse();
  else
    for (int d = 0; d < 3; ++d) inverse(d, d) = xx(d, d) > 1e-12 * size ? 1 / xx(d, d) : 0.0;
  const Mat3 G = ux * inverse;
  return 0.5 * (G + G.transpose());
}

Vec3 Assembly::rotation(std::size_t k) const {
  const auto& q = orientation[k];
  const Vec3 v = q[0] < 0 ? Vec3(-q[1], -q[2], -q[3]) : Vec3(q[1], q[2], q[3]);
  const double sine = v.norm();
  return sine > 0 ? Vec3(2 * std::atan2(sine, std::abs(q[0])) / sine * v) : v;
}

Vec3 Assembly::platen_force(std::size_t platen) const { return forces[blocks_ + platen].all; }
Vec3 Assembly::platen_displacement(std::size_t platen) const {
  return motion[blocks_ + platen].x - bodies[blocks_ + platen].start;
}

double Assembly::unbalanced() const {
  double most = 0, sum = 0;
  for (std::size_t k = 0; k < blocks_; ++k)
    for (int d = 0; d < 3; ++d)
      if (!(bodies[k].held & (1 << d))) most = std::max(most, std::abs(forces[k].all[d]));
  for (const auto& f : contact_forces) sum += f.all.norm();
  if (sum > 0) return most / sum * static_cast<double>(contact_forces.size());
  return most > 0 ? 1.0 : 0.0;
}

std::size_t Assembly::bonds() const {
  std::size_t count = 0;
  for (const ContactGroup& g : groups)
    for (std::size_t k = g.begin; !g.platen && k < g.end; ++k) count += g.law->is_bonded(joints[k]) ? 1 : 0;
  return count;
}

bool Assembly::is_finite() const {
  return std::all_of(motion.begin(), motion.end(), [](const BlockMotion& m) {
    return std::isfinite(m.x.sum() + m.v.sum() + m.w.sum()) && m.v.cwiseAbs().maxCoeff() < 1e100;
  });
}

std::size_t Assembly::active() const {
  return static_cast<std::size_t>(std::count_if(contact_forces.begin(), contact_forces.end(),
                                                [](const ContactForce& f) { return !f.all.isZero(0.0); }));
}

std::vector<BlockEvent> Assembly::take_events() {
  std::vector<BlockEvent> out;
  out.swap(events_);
  return out;
}

double Assembly::bytes() const {
  const auto of = [](const auto& v) { return static_cast<double>(v.capacity() * sizeof(v[0])); };
  double sum = of(motion) + of(orientation) + of(bodies) + of(forces) + of(work) + of(contacts) + of(joints) +
               of(contact_forces) + of(dashpot_work) + of(shift) + of(stress) + of(kept_increments_) + of(predicted_) +
               of(entries_);
  for (const auto& o : outlines) sum += of(o.corners);
  for (const auto& s : shapes) {
    sum += of(s.corners);
    for (const auto& f : s.faces) sum += of(f);
  }
  return sum;
}

}  // namespace tribo
