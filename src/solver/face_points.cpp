#include "solver/face_points.hpp"

#include "grid/kernels.hpp"

#include <cmath>

namespace tribo {
namespace {

Vec3 face_normal(int face) {
  switch (face) {
    case 1:
      return -Vec3::UnitY();
    case 2:
      return Vec3::UnitX();
    case 3:
      return Vec3::UnitY();
    case 4:
      return -Vec3::UnitX();
    case 5:
      return -Vec3::UnitZ();
    default:
      return Vec3::UnitZ();
  }
}

}  // namespace

template <int Dim>
ParticleFace<Dim> ParticleFace<Dim>::of(const System<Dim>& system, Body<Dim>& body, std::size_t i, int face) {
  auto& particles = body.particles;
  ParticleFace out;
  out.normal = face_normal(face);
  int axis = 0;
  while (out.normal[axis] == 0.0) ++axis;
  Vec<Dim> half = body.uniform_half_size;
  if (body.half_size)
    for (int d = 0; d < Dim; ++d) half[d] = particles.column(*body.half_size + static_cast<std::size_t>(d))[i];
  out.area = particles.mass()[i] / body.law->density() / (2 * half[axis]);
  if (system.analysis == Analysis::axisymmetric && axis == 0) {  // a face at another radius than the particle
    const double r = particles.column(*body.origin)[i];
    out.area *= (r + out.normal[0] * half[0]) / r;
  }
  for (std::size_t point = 0; point < count; ++point) {
    Vec<Dim> at = Vec<Dim>::Zero();
    for (int d = 0, tangent = 0; d < Dim; ++d)
      at[d] = d == axis ? out.normal[d] * half[d] : (point >> tangent++ & 1 ? 1.0 : -1.0) * half[d] / std::sqrt(3.0);
    if (body.domain) {  // CPDI: the face has deformed with the particle
      const auto F = particles.F();
      at = (load_full<Dim>(F, static_cast<int>(i)).template topLeftCorner<Dim, Dim>() * at).eval();
    }
    out.points[point] = at + particles.position(i);
  }
  return out;
}

template <int Dim>
PointShares<Dim>::PointShares(Kernel kernel, const Field<Dim>& field, const Conditions<Dim>& conditions,
                              const Vec<Dim>& x) {
  if (kernel == Kernel::quadratic_spline)
    fill<QuadraticKernel>(field, conditions, x);
  else if (kernel == Kernel::cubic_spline)
    fill<CubicKernel>(field, conditions, x);
  else
    fill<LinearKernel>(field, conditions, x);
}

template <int Dim>
template <class K>
void PointShares<Dim>::fill(const Field<Dim>& field, const Conditions<Dim>& conditions, const Vec<Dim>& x) {
  const auto& lattice = field.map.lattice();
  Index<Dim> base;
  double w[Dim][K::width], g[K::width];
  int size = 1;
  for (int d = 0; d < Dim; ++d, size *= K::width) {
    const double s = (x[d] - lattice.origin[d]) / lattice.spacing[d], from = std::floor(s - K::shift);
    base[static_cast<std::size_t>(d)] = static_cast<int>(from);
    K::at(s - from, 0.0, w[d], g);
  }
  double sum = 0.0;
  for (int k = 0; k < size; ++k) {
    Index<Dim> n = base;
    double weight = 1.0;
    for (int d = 0, rest = k; d < Dim; ++d, rest /= K::width) {
      n[static_cast<std::size_t>(d)] += rest % K::width;
      weight *= w[d][rest % K::width];
    }
    const auto at = field.map.node(n);
    if (at < 0 || !(field.nodes[static_cast<std::size_t>(at)].mass > 0 || conditions.folds(n))) continue;
    const auto here = static_cast<std::size_t>(count++);
    node[here] = at, share[here] = weight;
    sum += weight;
  }
  for (int k = 0; k < count; ++k)
    share[static_cast<std::size_t>(k)] = sum > 0 ? share[static_cast<std::size_t>(k)] / sum : 0.0;
}

template struct ParticleFace<2>;
template struct ParticleFace<3>;
template struct PointShares<2>;
template struct PointShares<3>;

}  // namespace tribo
