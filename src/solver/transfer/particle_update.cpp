// SPDX-License-Identifier: MIT
#include "solver/transfer/particle_update.hpp"

#include "solver/transfer/material_points.hpp"

#include <cmath>

namespace tribo {
namespace {

// Stores the first `left` lanes.
void store_some(double* to, Lanes v, int left) {
  if (left >= lane_count)
    store_lanes(to, v);
  else
    for (int k = 0; k < left; ++k) to[k] = v[k];
}

template <int Dim>
void move(Body<Dim>& body, const Lattice<Dim>& lattice, std::uint32_t first, int count, const Gather& what,
          const GatherSums<Dim>& sums, GatherResult& result) {
  const auto xs = body.particles.x();
  const auto vs = body.particles.v();
  const double dt = what.dt, flip = what.flip, pic = 1.0 - what.flip, damping = what.damping * what.dt;
  double travel = result.travel, not_finite = 0.0;
  for (int d = 0; d < Dim; ++d) {
    double* __restrict x = xs[static_cast<std::size_t>(d)] + first;
    double* __restrict v = vs[static_cast<std::size_t>(d)] + first;
    const double* __restrict sv = sums.velocity[d];
    const double* __restrict sa = sums.acceleration[d];
    const double* __restrict sd =
        what.damps_part ? body.particles[body.damped][static_cast<std::size_t>(d)] + first : sv;
    const double inverse = 1.0 / lattice.spacing[d];
    double far = 0.0;
#pragma omp simd reduction(max : far) reduction(+ : not_finite)
    for (int i = 0; i < count; ++i) {
      const double old = v[i];
      const double now = flip * (old + dt * sa[i]) + pic * sv[i] - damping * sd[i];
      const double dx = dt * sv[i];
      v[i] = now;
      x[i] += dx;
      const double cells = std::fabs(dx) * inverse;
      far = cells > far ? cells : far;
      not_finite += 0.0 * (now + dx);  // NaN if any value is not finite
    }
    travel = far > travel ? far : travel;
  }
  result.travel = travel;
  if (!(not_finite == 0.0)) result.valid = false;
}

// Moves particles and stores the power of their accelerations over the change of their velocities.
template <int Dim>
void move_and_record_change(Body<Dim>& body, const Lattice<Dim>& lattice, std::uint32_t first, int count,
                            const Gather& what, const GatherSums<Dim>& sums, GatherResult& result) {
  const auto vs = body.particles.v(), changes = body.particles[body.filtered];
  for (std::size_t d = 0; d < Dim; ++d) std::copy_n(vs[d] + first, count, changes[d] + first);
  move(body, lattice, first, count, what, sums, result);
  for (std::size_t d = 0; d < Dim; ++d) {
    const double *v = vs[d] + first, *acceleration = sums.acceleration[d];
    double* change = changes[d] + first;
    for (int i = 0; i < count; ++i) change[i] = acceleration[i] * (v[i] - change[i]);
  }
}

template <int Dim>
void update_temperature(Body<Dim>& body, std::uint32_t first, int count, double dt, const GatherSums<Dim>& sums,
                        GatherResult& result) {
  double* temperature = body.particles[body.temperature] + first;
  double* residual = body.particles[body.temperature_residual] + first;
  double not_finite = 0.0;
  for (int i = 0; i < count; ++i) {
    temperature[i] += dt * sums.velocity[1][i];
    residual[i] = temperature[i] - sums.velocity[0][i];
    not_finite += 0.0 * temperature[i];
  }
  const auto gradient = body.particles[body.temperature_gradient];
  for (std::size_t d = 0; d < Dim; ++d) std::copy_n(sums.L[d], count, gradient[d] + first);
  if (!(not_finite == 0.0)) result.valid = false;
}

// Converts the energy that the law has dissipated since the last step into heat of the particle.
template <int Dim>
void heat_by_dissipation(Body<Dim>& body, std::uint32_t first, int count) {
  const double* work = body.history_columns[static_cast<std::size_t>(body.law->dissipation_index())] + first;
  double* heated = body.particles[body.heated] + first;
  double* temperature = body.particles[body.temperature] + first;
  const double per_work = body.taylor_quinney / (body.law->density() * body.heat_capacity);
  for (int i = 0; i < count; ++i) {
    temperature[i] += per_work * (work[i] - heated[i]);
    heated[i] = work[i];
  }
}

/// Thermal expansion of a batch during an update of the stress: the law gets the rate of strain without it.
template <int Dim>
class Expansion {
 public:
  Expansion(Body<Dim>& body, std::uint32_t first, int count, const Gather& what, GatherSums<Dim>& sums)
      : body_(body), first_(first), count_(count), dt_(what.strain_dt), plane_stress_(what.plane_stress) {
    const double* temperature = body.particles[body.temperature] + first;
    double* before = body.particles[body.expanded] + first;
    for (int i = 0; i < count; ++i) {
      rate_[i] = body.expansion * (temperature[i] - before[i]) / dt_;
      before[i] = temperature[i];
      trace_[i] = trace(i);
    }
    for (const int diagonal : {0, Dim + 1, Layout<Dim>::full - 1})
      for (int i = 0; i < count; ++i) sums.L[diagonal][i] -= rate_[i];
  }

  // In plane stress the law has set the elastic part of the strain out of the plane.
  void finish() {
    const auto F = body_.particles.F();
    double* volume = body_.particles.volume() + first_;
    const double* mass = body_.particles.mass() + first_;
    double* work = body_.particles[body_.expansion_work] + first_;
    constexpr auto zz = static_cast<std::size_t>(Layout<Dim>::full - 1);
    for (int i = 0; i < count_; ++i) {
      if (plane_stress_) {
        const double stretch = std::exp(rate_[i] * dt_);
        volume[i] *= stretch;
        if (F[zz]) F[zz][first_ + static_cast<std::size_t>(i)] *= stretch;
      }
      const double ratio = volume[i] * body_.law->density() / mass[i];
      work[i] += 0.5 * (trace_[i] + trace(i)) * rate_[i] * dt_ * ratio;
    }
  }

 private:
  double trace(int i) const {
    const auto stress = body_.particles.stress();
    const std::size_t k = first_ + static_cast<std::size_t>(i);
    return stress[0][k] + stress[1][k] + stress[2][k];
  }

  Body<Dim>& body_;
  std::uint32_t first_;
  int count_;
  double dt_;
  bool plane_stress_;
  alignas(64) double rate_[batch_lanes];   ///< of linear expansion [1/time]
  alignas(64) double trace_[batch_lanes];  ///< of the stress before the update
};

template <int Dim>
void reduce_temperature_residual(Body<Dim>& body, std::uint32_t first, int count, const GatherSums<Dim>& sums) {
  double* temperature = body.particles[body.temperature] + first;
  const double* residual = body.particles[body.temperature_residual] + first;
  for (int i = 0; i < count; ++i) temperature[i] -= body.residual_share * residual[i] - sums.velocity[0][i];
}

template <int Dim>
void out_of_plane(Body<Dim>& body, std::uint32_t first, int count, const Gather& what, GatherSums<Dim>& sums) {
  if constexpr (Dim == 2) {
    if (what.axisymmetric) {
      const double* r = (what.from_start ? body.particles[body.start] : body.particles.x())[0] + first;
      for (int i = 0; i < count; ++i) sums.L[4][i] = sums.velocity[0][i] / r[i];
    } else {
      std::fill_n(sums.L[4], count, 0.0);
    }
  }
}

// The normal components of the velocity gradient along the axes that contribute to the volume change.
template <int Dim>
struct Diagonal {
  std::array<double*, 3> rate;
  int count;

  Diagonal(GatherSums<Dim>& sums, bool axisymmetric) : rate{sums.L[0], sums.L[Dim + 1], nullptr}, count(2) {
    if (Dim == 3 || axisymmetric) rate[2] = sums.L[Layout<Dim>::full - 1], count = 3;
  }
  double sum(int i) const {
    double s = 0.0;
    for (int d = 0; d < count; ++d) s += rate[static_cast<std::size_t>(d)][i];
    return s;
  }
};

template <int Dim>
void use_mean_rate(Body<Dim>& body, std::uint32_t first, int count, const Gather& what, GatherSums<Dim>& sums) {
  const Diagonal<Dim> rate(sums, what.axisymmetric);
  const double* mean = body.particles[body.volumetric] + first;
  for (int i = 0; i < count; ++i) {
    const double change = (mean[i] - rate.sum(i)) / rate.count;
    for (int d = 0; d < rate.count; ++d) rate.rate[static_cast<std::size_t>(d)][i] += change;
  }
}

// F <- f F and V <- det(f) V over a time step. With `second` = 0, f = 1 + L dt is the motion x += dt v(x) itself; with
// 1 it is the inverse of 1 - L dt to second order, for L at the positions after the motion; 1/2 gives exp(L dt). The
// material law receives the constant rate that leads to f, log(f)/dt to second order, so that a rotation causes no
// strain.
void deform(Particles<2>& particles, std::uint32_t first, int count, double dt, double second, GatherSums<2>& sums) {
  const auto F = particles.F();
  double* __restrict volume = particles.volume() + first;
  const bool keep = particles.has_deformation();
  const auto at_first = [&](std::size_t k) { return keep ? F[k] + first : nullptr; };
  double* __restrict xx = at_first(0);
  double* __restrict xy = at_first(1);
  double* __restrict yx = at_first(2);
  double* __restrict yy = at_first(3);
  double* __restrict zz = at_first(4);
  auto& L = sums.L;
  const auto apply = [&](int i, double a, double b, double c, double d, double e) {
    volume[i] *= (a * d - b * c) * e;
    if (!keep) return;
    const double f0 = xx[i], f1 = xy[i], f2 = yx[i], f3 = yy[i];
    xx[i] = a * f0 + b * f2, xy[i] = a * f1 + b * f3;
    yx[i] = c * f0 + d * f2, yy[i] = c * f1 + d * f3;
    zz[i] *= e;
  };
  const double rate = (second - 0.5) / dt;
#pragma omp simd
  for (int i = 0; i < count; ++i) {
    const double a = dt * L[0][i], b = dt * L[1][i], c = dt * L[2][i], d = dt * L[3][i], e = dt * L[4][i];
    const double aa = a * a + b * c, bb = b * (a + d), cc = c * (a + d), dd = d * d + b * c, ee = e * e;
    apply(i, 1 + a + second * aa, b + second * bb, c + second * cc, 1 + d + second * dd, 1 + e + second * ee);
    L[0][i] += rate * aa, L[1][i] += rate * bb, L[2][i] += rate * cc, L[3][i] += rate * dd, L[4][i] += rate * ee;
  }
}

void deform(Particles<3>& particles, std::uint32_t first, int count, double dt, double second, GatherSums<3>& sums) {
  const auto F = particles.F();
  double* volume = particles.volume() + first;
  const double rate = (second - 0.5) / dt;
  for (int i = 0; i < count; i += lane_count) {
    Lanes l[9], m[9];
    for (int k = 0; k < 9; ++k) l[k] = dt * load_lanes(sums.L[k] + i);
    for (int r = 0; r < 9; r += 3)
      for (int c = 0; c < 3; ++c) {
        const Lanes square = l[r] * l[c] + l[r + 1] * l[3 + c] + l[r + 2] * l[6 + c];
        m[r + c] = l[r + c] + second * square;
        store_lanes(sums.L[r + c] + i, load_lanes(sums.L[r + c] + i) + rate * square);
      }
    m[0] += 1.0, m[4] += 1.0, m[8] += 1.0;
    const Lanes det =
        m[0] * (m[4] * m[8] - m[5] * m[7]) - m[1] * (m[3] * m[8] - m[5] * m[6]) + m[2] * (m[3] * m[7] - m[4] * m[6]);
    store_some(volume + i, load_lanes(volume + i) * det, count - i);
    for (std::size_t c = 0; c < 3 && F[0]; ++c) {
      double *x = F[c] + first + i, *y = F[3 + c] + first + i, *z = F[6 + c] + first + i;
      const Lanes a = load_lanes(x), b = load_lanes(y), e = load_lanes(z);
      store_some(x, m[0] * a + m[1] * b + m[2] * e, count - i);
      store_some(y, m[3] * a + m[4] * b + m[5] * e, count - i);
      store_some(z, m[6] * a + m[7] * b + m[8] * e, count - i);
    }
  }
}

}  // namespace

template <int Dim>
void update_particles(Body<Dim>& body, const Lattice<Dim>& lattice, std::uint32_t first, int count, const Gather& what,
                      GatherSums<Dim>& sums, GatherResult& result) {
  switch (what.task) {
    case GatherTask::filtered_velocity:
    case GatherTask::damped_velocity: {
      const auto to = body.particles[what.task == GatherTask::damped_velocity ? body.damped : body.filtered];
      for (int d = 0; d < Dim; ++d) std::copy_n(sums.velocity[d], count, to[static_cast<std::size_t>(d)] + first);
      return;
    }
    case GatherTask::temperature:
      update_temperature(body, first, count, what.dt, sums, result);
      return;
    case GatherTask::temperature_residual:
      reduce_temperature_residual(body, first, count, sums);
      return;
    case GatherTask::cell_mean:
      std::copy_n(sums.velocity[0], count, body.particles[body.volumetric] + first);
      return;
    case GatherTask::volume_rate: {
      out_of_plane(body, first, count, what, sums);
      const Diagonal<Dim> rate(sums, what.axisymmetric);
      double* to = body.particles[body.volumetric] + first;
      for (int i = 0; i < count; ++i) to[i] = rate.sum(i);
      return;
    }
    case GatherTask::update:
      break;
  }
  if (what.strain_dt > 0) out_of_plane(body, first, count, what, sums);
  if (what.strain_dt > 0) {
    if (what.b_bar) use_mean_rate(body, first, count, what, sums);
    // Velocities at the end of the step move the particles from their current positions. Velocities at the start of
    // the step belong to positions after the motion of the previous step.
    const double second = what.exponential ? 0.5 : what.move || what.from_start ? 0.0 : 1.0;
    deform(body.particles, first, count, what.strain_dt, second, sums);
    const double* volume = body.particles.volume() + first;
    double bad = 0.0;
#pragma omp simd reduction(+ : bad)
    for (int i = 0; i < count; ++i) bad += volume[i] > 0 ? 0.0 : 1.0;
    if (bad > 0) {  // the caller reports the particle; material laws never receive such volumes
      result.valid = false;
      return;
    }
    HistoryPointers history{};
    auto points = points_of(body, first, count, history);
    points.dt = what.strain_dt;
    points.plane_stress = what.plane_stress;
    for (std::size_t k = 0; k < points.L.size(); ++k) points.L[k] = sums.L[k];
    if (body.expanded) {
      Expansion<Dim> expansion(body, first, count, what, sums);
      body.law->update(points);
      expansion.finish();
    } else {
      body.law->update(points);
    }
    if (body.heated) heat_by_dissipation(body, first, count);
  }
  if (what.move) {
    if (what.record_change)
      move_and_record_change(body, lattice, first, count, what, sums, result);
    else
      move(body, lattice, first, count, what, sums, result);
    if (body.affine)
      for (std::size_t k = 0; k < Dim * Dim; ++k)
        std::copy_n(sums.affine[k], count, body.particles[body.affine][k] + first);
  }
}

template void update_particles<2>(Body<2>&, const Lattice<2>&, std::uint32_t, int, const Gather&, GatherSums<2>&,
                                  GatherResult&);
template void update_particles<3>(Body<3>&, const Lattice<3>&, std::uint32_t, int, const Gather&, GatherSums<3>&,
                                  GatherResult&);

}  // namespace tribo
