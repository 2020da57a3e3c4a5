#include "solver/motion.hpp"

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
          const Gathered<Dim>& got, GatherResult& result) {
  const auto xs = body.particles.x();
  const auto vs = body.particles.v();
  const double dt = what.dt, flip = what.flip, pic = 1.0 - what.flip, damping = what.damping * what.dt;
  const double half = what.trapezoidal ? 0.5 : 0.0;
  double travel = result.travel, poison = 0.0;
  for (int d = 0; d < Dim; ++d) {
    double* __restrict x = xs[static_cast<std::size_t>(d)] + first;
    double* __restrict v = vs[static_cast<std::size_t>(d)] + first;
    const double* __restrict sv = got.velocity[d];
    const double* __restrict sa = got.acceleration[d];
    const double inverse = 1.0 / lattice.spacing[d];
    double far = 0.0;
#pragma omp simd reduction(max : far) reduction(+ : poison)
    for (int i = 0; i < count; ++i) {
      const double old = v[i];
      const double now = flip * (old + dt * sa[i]) + pic * sv[i] - damping * sv[i];
      const double dx = dt * (sv[i] + half * (old + now - 2 * sv[i]));
      v[i] = now;
      x[i] += dx;
      const double cells = std::fabs(dx) * inverse;
      far = cells > far ? cells : far;
      poison += 0.0 * (now + dx);  // NaN if anything is
    }
    travel = far > travel ? far : travel;
  }
  result.travel = travel;
  if (!(poison == 0.0)) result.valid = false;
}

// F <- exp(L dt) F and V <- det(exp(L dt)) V with a truncated series.
void deform(Particles<2>& particles, std::uint32_t first, int count, double dt, int terms, const Gathered<2>& got) {
  const auto F = particles.F();
  double* __restrict volume = particles.volume() + first;
  const bool keep = particles.has_deformation();
  const auto at_first = [&](std::size_t k) { return keep ? F[k] + first : nullptr; };
  double* __restrict xx = at_first(0);
  double* __restrict xy = at_first(1);
  double* __restrict yx = at_first(2);
  double* __restrict yy = at_first(3);
  double* __restrict zz = at_first(4);
  const auto& L = got.L;
  const auto apply = [&](int i, double a, double b, double c, double d, double e) {
    volume[i] *= (a * d - b * c) * e;
    if (!keep) return;
    const double f0 = xx[i], f1 = xy[i], f2 = yx[i], f3 = yy[i];
    xx[i] = a * f0 + b * f2, xy[i] = a * f1 + b * f3;
    yx[i] = c * f0 + d * f2, yy[i] = c * f1 + d * f3;
    zz[i] *= e;
  };
  const double second = terms >= 2 ? 0.5 : 0.0;
  if (terms <= 2) {
#pragma omp simd
    for (int i = 0; i < count; ++i) {
      const double a = dt * L[0][i], b = dt * L[1][i], c = dt * L[2][i], d = dt * L[3][i], e = dt * L[4][i];
      apply(i, 1 + a + second * (a * a + b * c), b + second * b * (a + d), c + second * c * (a + d),
            1 + d + second * (d * d + b * c), 1 + e + second * e * e);
    }
    return;
  }
  for (int i = 0; i < count; ++i) {
    const double a = dt * L[0][i], b = dt * L[1][i], c = dt * L[2][i], d = dt * L[3][i], e = dt * L[4][i];
    double m0 = 1, m1 = 0, m2 = 0, m3 = 1, m4 = 1;
    for (int k = terms; k >= 1; --k) {  // Horner
      const double n0 = 1 + (a * m0 + b * m2) / k, n1 = (a * m1 + b * m3) / k;
      const double n2 = (c * m0 + d * m2) / k, n3 = 1 + (c * m1 + d * m3) / k;
      m0 = n0, m1 = n1, m2 = n2, m3 = n3, m4 = 1 + e * m4 / k;
    }
    apply(i, m0, m1, m2, m3, m4);
  }
}

void deform(Particles<3>& particles, std::uint32_t first, int count, double dt, int terms, const Gathered<3>& got) {
  const auto F = particles.F();
  double* volume = particles.volume() + first;
  const double second = terms >= 2 ? 0.5 : 0.0;
  if (terms <= 2) {
    for (int i = 0; i < count; i += lane_count) {
      Lanes l[9], m[9];
      for (int k = 0; k < 9; ++k) l[k] = dt * load_lanes(got.L[k] + i);
      for (int r = 0; r < 9; r += 3)
        for (int c = 0; c < 3; ++c)
          m[r + c] = l[r + c] + second * (l[r] * l[c] + l[r + 1] * l[3 + c] + l[r + 2] * l[6 + c]);
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
    return;
  }
  for (int i = 0; i < count; ++i) {
    Mat3 l;
    for (int k = 0; k < 9; ++k) l(k / 3, k % 3) = dt * got.L[k][i];
    Mat3 sum = Mat3::Identity();
    for (int k = terms; k >= 1; --k) sum = Mat3::Identity() + l * sum / k;
    const auto at = static_cast<int>(first) + i;
    if (F[0]) store_full<3>(sum * load_full<3>(F, at), F, at);
    volume[i] *= sum.determinant();
  }
}

}  // namespace

template <int Dim>
MaterialPoints<Dim> points_of(Body<Dim>& body, std::uint32_t first, int count, std::array<double*, 64>& history) {
  MaterialPoints<Dim> points;
  points.count = count;
  const auto F = body.particles.F();
  const auto stress = body.particles.stress();
  for (std::size_t k = 0; k < F.size(); ++k) points.F[k] = F[k] ? F[k] + first : nullptr;
  for (std::size_t k = 0; k < stress.size(); ++k) points.stress[k] = stress[k] + first;
  points.mass = body.particles.mass() + first;
  points.volume = body.particles.volume() + first;
  for (std::size_t k = 0; k < body.history_columns.size(); ++k) history[k] = body.history_columns[k] + first;
  points.history = {history.data(), body.history_columns.size()};
  return points;
}

template <int Dim>
void update_particles(Body<Dim>& body, const Lattice<Dim>& lattice, std::uint32_t first, int count, const Gather& what,
                      Gathered<Dim>& got, GatherResult& result) {
  if (what.filtered) {
    const auto to = body.particles.vector(*body.filtered);
    for (int d = 0; d < Dim; ++d) std::copy_n(got.velocity[d], count, to[static_cast<std::size_t>(d)] + first);
    return;
  }
  if (what.strain_dt > 0) {
    if constexpr (Dim == 2) {
      if (what.axisymmetric) {
        const double* r = (what.from_start ? body.particles.vector(*body.start) : body.particles.x())[0] + first;
        for (int i = 0; i < count; ++i) got.L[4][i] = got.velocity[0][i] / r[i];
      } else {
        std::fill_n(got.L[4], count, 0.0);
      }
    }
    deform(body.particles, first, count, what.strain_dt, what.terms, got);
    std::array<double*, 64> history{};
    auto points = points_of(body, first, count, history);
    points.dt = what.strain_dt;
    points.plane_stress = what.plane_stress;
    for (std::size_t k = 0; k < points.L.size(); ++k) points.L[k] = got.L[k];
    body.law->update(points);
    double least = 1.0;
    for (int i = 0; i < count; ++i)
      least = points.volume[i] < least || !(points.volume[i] == points.volume[i]) ? points.volume[i] : least;
    if (!(least > 0)) result.valid = false;
  }
  if (what.move) {
    move(body, lattice, first, count, what, got, result);
    if (body.affine)
      for (std::size_t k = 0; k < Dim * Dim; ++k)
        std::copy_n(got.affine[k], count, body.particles.column(*body.affine + k) + first);
  }
}

template MaterialPoints<2> points_of<2>(Body<2>&, std::uint32_t, int, std::array<double*, 64>&);
template MaterialPoints<3> points_of<3>(Body<3>&, std::uint32_t, int, std::array<double*, 64>&);
template void update_particles<2>(Body<2>&, const Lattice<2>&, std::uint32_t, int, const Gather&, Gathered<2>&,
                                  GatherResult&);
template void update_particles<3>(Body<3>&, const Lattice<3>&, std::uint32_t, int, const Gather&, Gathered<3>&,
                                  GatherResult&);

}  // namespace tribo
