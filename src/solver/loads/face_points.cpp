// SPDX-License-Identifier: MIT
#include "solver/loads/face_points.hpp"

#include "grid/kernels.hpp"

#include <cmath>
#include <utility>

namespace tribo {
namespace {

Vec3 face_normal(DomainFace face) {
  switch (face) {
    case DomainFace::low_y:
      return -Vec3::UnitY();
    case DomainFace::high_x:
      return Vec3::UnitX();
    case DomainFace::high_y:
      return Vec3::UnitY();
    case DomainFace::low_x:
      return -Vec3::UnitX();
    case DomainFace::low_z:
      return -Vec3::UnitZ();
    case DomainFace::high_z:
      break;
  }
  return Vec3::UnitZ();
}

}  // namespace

// The side of a parallelepiped whose normal is nearest to that of the face.
template <int Dim>
ParticleFace<Dim> ParticleFace<Dim>::of_half_axes(const System<Dim>& system, Body<Dim>& body, std::size_t i,
                                                  DomainFace face) {
  auto& particles = body.particles;
  Mat<Dim> axes;
  for (int k = 0; k < Dim * Dim; ++k)
    axes(k / Dim, k % Dim) = particles[body.half_axes][static_cast<std::size_t>(k)][i];
  const Mat<Dim> normals = axes.inverse().transpose().colwise().normalized();
  const Vec<Dim> wanted = face_normal(face).head<Dim>();
  Eigen::Index side;
  (normals.transpose() * wanted).cwiseAbs().maxCoeff(&side);
  const double sign = normals.col(side).dot(wanted) < 0 ? -1.0 : 1.0;
  ParticleFace out;
  out.normal = Vec3::Zero();
  out.normal.template head<Dim>() = sign * normals.col(side);
  const double height = std::abs(axes.col(side).dot(normals.col(side)));
  out.area = std::ldexp(std::abs(axes.determinant()), Dim) / (2 * height);  // in two dimensions the length
  if constexpr (Dim == 2)
    out.area *= system.analysis == Analysis::axisymmetric ? particles[body.origin][0][i] + sign * axes(0, side)
                                                          : body.thickness;
  for (std::size_t point = 0; point < count; ++point) {
    Vec<Dim> at = sign * axes.col(side);
    for (int d = 0, tangent = 0; d < Dim; ++d)
      if (d != side) at += (point >> tangent++ & 1 ? 1.0 : -1.0) / std::sqrt(3.0) * axes.col(d);
    if (body.domain)
      at = (load_full<Dim>(particles.F(), static_cast<int>(i)).template topLeftCorner<Dim, Dim>() * at).eval();
    out.points[point] = at + particles.position(i);
  }
  return out;
}

template <int Dim>
ParticleFace<Dim> ParticleFace<Dim>::of(const System<Dim>& system, Body<Dim>& body, std::size_t i, DomainFace face) {
  if (body.half_axes) return of_half_axes(system, body, i, face);
  auto& particles = body.particles;
  ParticleFace out;
  out.normal = face_normal(face);
  int axis = 0;
  while (out.normal[axis] == 0.0) ++axis;
  Vec<Dim> half = body.uniform_half_size;
  if (body.half_size)
    for (int d = 0; d < Dim; ++d) half[d] = particles[body.half_size][static_cast<std::size_t>(d)][i];
  out.area = particles.mass()[i] / body.law->density() / (2 * half[axis]);
  // the radius of the face differs from that of the particle
  if (system.analysis == Analysis::axisymmetric && axis == 0) {
    const double r = particles[body.origin][0][i];
    out.area *= (r + out.normal[0] * half[0]) / r;
  }
  for (std::size_t point = 0; point < count; ++point) {
    Vec<Dim> at = Vec<Dim>::Zero();
    for (int d = 0, tangent = 0; d < Dim; ++d)
      at[d] = d == axis ? out.normal[d] * half[d] : (point >> tangent++ & 1 ? 1.0 : -1.0) * half[d] / std::sqrt(3.0);
    if (body.domain) {  // CPDI: the face deforms with the particle
      const auto F = particles.F();
      at = (load_full<Dim>(F, static_cast<int>(i)).template topLeftCorner<Dim, Dim>() * at).eval();
    }
    out.points[point] = at + particles.position(i);
  }
  return out;
}

template <int Dim>
void PointShares<Dim>::spread(Kernel kernel, const Lattice<Dim>& lattice, const Vec<Dim>& x) {
  with_kernel(kernel, [&](auto k) { spread<typename decltype(k)::Point>(lattice, x); });
}

template <int Dim>
template <class K>
void PointShares<Dim>::spread(const Lattice<Dim>& lattice, const Vec<Dim>& x) {
  Index<Dim> base;
  double w[Dim][K::width], g[K::width];
  count = 1;
  for (int d = 0; d < Dim; ++d, count *= K::width) {
    const double s = (x[d] - lattice.origin[d]) / lattice.spacing[d], from = std::floor(s - K::shift);
    base[static_cast<std::size_t>(d)] = static_cast<int>(from);
    K::at(s - from, 0.0, w[d], g);
  }
  for (int k = 0; k < count; ++k) {
    Index<Dim>& n = index_[static_cast<std::size_t>(k)] = base;
    double& weight = share[static_cast<std::size_t>(k)] = 1.0;
    for (int d = 0, rest = k; d < Dim; ++d, rest /= K::width) {
      n[static_cast<std::size_t>(d)] += rest % K::width;
      weight *= w[d][rest % K::width];
    }
  }
}

// The fraction of the mean mass below which nodes are light.
//
// A point of a surface may have nodes at which the shape functions of the particles are very small. With uGIMP and CPDI
// its shape functions are the mean gradients of those of the particles over their domains, so that the exact share
// balances a uniform stress. Any other share strains the particles at the surface until their stress fits it.
//
// With splines the two differ. A force on a light node strains the particles in proportion to share/mass times the
// shape function, which is proportional to the square root of the mass. So the strain stays bounded if the share is
// proportional to that root. The bound is low enough to leave nodes unchanged if the surface lies on a grid line, where
// the exact share balances a uniform stress, too.
template <int Dim>
double PointShares<Dim>::light_fraction(Kernel kernel) {
  return kernel == Kernel::gimp || kernel == Kernel::cpdi ? 0.0 : 1e-3;
}

template <int Dim>
void PointShares<Dim>::normalise(const std::vector<Field<Dim>>& fields, const Exchanges<Dim>& exchanges, double light) {
  const int around = std::exchange(count, 0);
  std::array<double, most> masses;
  std::array<bool, most> folds;
  double sum = 0.0, mass = 0.0;
  for (std::size_t k = 0; k < static_cast<std::size_t>(around); ++k) {
    const Field<Dim>& of = fields[field[k]];
    const auto at = of.map.node(index_[k]);
    if (at < 0) continue;
    const double here = of.nodes[static_cast<std::size_t>(at)].mass;
    const bool folded = exchanges[field[k]]->is_image(index_[k]);
    if (!(here > 0 || folded)) continue;
    const auto kept = static_cast<std::size_t>(count++);
    field[kept] = field[k], node[kept] = at, share[kept] = share[k], masses[kept] = here, folds[kept] = folded;
    sum += share[kept], mass += share[kept] * here;
  }
  const double bound = sum > 0 ? light * mass / sum : 0.0;
  sum = 0.0;
  for (std::size_t k = 0; k < static_cast<std::size_t>(count); ++k) {
    if (masses[k] < bound && !folds[k]) share[k] *= std::sqrt(masses[k] / bound);
    sum += share[k];
  }
  for (std::size_t k = 0; k < static_cast<std::size_t>(count); ++k) share[k] = sum > 0 ? share[k] / sum : 0.0;
}

template struct ParticleFace<2>;
template struct ParticleFace<3>;
template struct PointShares<2>;
template struct PointShares<3>;

}  // namespace tribo
