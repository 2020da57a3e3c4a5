/// Tractions on the faces of particles, where they act: on the face, not at the particle's centre.

#include "grid/kernels.hpp"
#include "solver/step.hpp"

#include <cmath>

namespace tribo {
namespace {

// Outward normal of the dialect's face numbers: 2D 1 bottom 2 right 3 top 4 left; 3D 1-4 likewise, 5 bottom 6 top in z.
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

// The nodes around a point and their weights; nodes without mass give their share to the others.
template <class K, int Dim>
class PointStencil {
 public:
  PointStencil(const BlockMap<Dim>& map, const NodeLayer& nodes, const Conditions<Dim>& conditions, const Vec<Dim>& x) {
    const auto& lattice = map.lattice();
    Index<Dim> base;
    double w[Dim][K::width], g[K::width];
    for (int d = 0; d < Dim; ++d) {
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
      node[k] = map.node(n);
      const bool there = node[k] >= 0 && (nodes[static_cast<std::size_t>(node[k])].mass > 0 || conditions.folds(n));
      share[k] = there ? weight : 0.0;
      sum += share[k];
    }
    for (double& s : share) s = sum > 0 ? s / sum : 0.0;
  }
  static constexpr int size = Dim == 2 ? K::width * K::width : K::width * K::width * K::width;
  std::int64_t node[size];
  double share[size];
};

}  // namespace

// Force per face point, with two Gauss points along every tangent.
template <int Dim>
template <class K>
void Stepper<Dim>::apply_traction(const ParticleCondition& condition, Body<Dim>& body, std::size_t i) {
  auto& particles = body.particles;
  const Vec3 normal3 = face_normal(condition.face);
  int axis = 0;
  while (normal3[axis] == 0.0) ++axis;
  Vec<Dim> half = body.uniform_half_size;
  if (body.half_size)
    for (int d = 0; d < Dim; ++d) half[d] = particles.column(*body.half_size + static_cast<std::size_t>(d))[i];
  // Area before deformation, times the traction: a nominal load.
  const double density = body.law->density();
  double area = particles.mass()[i] / density / (2 * half[axis]);
  if (system_.analysis == Analysis::axisymmetric && axis == 0) {  // a face at another radius than the particle
    const double r = particles.column(*body.origin)[i];
    area *= (r + normal3[0] * half[0]) / r;
  }
  const Vec3 direction = condition.direction == 10   ? normal3
                         : condition.direction == 11 ? Vec3(normal3.cross(Vec3::UnitZ()) * -1.0)
                                                     : Vec3(Mat3::Identity().col(condition.direction));
  Vec3 x = Vec3::Zero(), v = Vec3::Zero();
  x.head<Dim>() = particles.position(i);
  v.head<Dim>() = particles.velocity(i);
  const double traction = condition.value.style == Style::silent  // absorbs plane waves, Lysmer & Kuhlemeyer (1969)
                              ? -std::sqrt(density * body.law->wave_modulus()) * v.dot(direction)
                              : condition.value.at(system_.time, x);

  Field<Dim>& field = system_.fields[body.field];
  constexpr int points = Dim == 2 ? 2 : 4;
  const Vec3 force = area * traction / points * direction;
  for (int point = 0; point < points; ++point) {
    Vec<Dim> at = Vec<Dim>::Zero();
    for (int d = 0, tangent = 0; d < Dim; ++d)
      at[d] = d == axis ? normal3[d] * half[d] : (point >> tangent++ & 1 ? 1.0 : -1.0) * half[d] / std::sqrt(3.0);
    if (body.domain) {  // CPDI: the face has deformed with the particle
      const auto F = particles.F();
      at = (load_full<Dim>(F, static_cast<int>(i)).template topLeftCorner<Dim, Dim>() * at).eval();
    }
    at += particles.position(i);
    const PointStencil<K, Dim> stencil(field.map, field.nodes, conditions_[body.field], at);
    for (int k = 0; k < stencil.size; ++k) {
      if (stencil.share[k] == 0.0) continue;
      Node& node = field.nodes[static_cast<std::size_t>(stencil.node[k])];
      for (int d = 0; d < Dim; ++d) node.acceleration[d] += stencil.share[k] * force[d];
      pushes_.push_back({body.field, stencil.node[k], stencil.share[k] * force.head<Dim>()});
    }
  }
}

template <int Dim>
void Stepper<Dim>::apply_tractions() {
  pushes_.clear();
  const auto& conditions = model_.particle_conditions;
  for (auto& body : system_.bodies) {
    if (!body.load_set) continue;
    const double* set = body.particles.column(*body.load_set);
    for (std::size_t i = 0; i < body.particles.size(); ++i) {
      if (set[i] == 0.0) continue;
      for (std::size_t c = 0; c < conditions.size(); ++c) {
        if (conditions[c].kind != ParticleCondition::Kind::traction) continue;
        if (!(static_cast<std::uint64_t>(set[i]) >> c & 1U)) continue;
        if (model_.scheme.kernel == Kernel::quadratic_spline)
          apply_traction<QuadraticKernel>(conditions[c], body, i);
        else if (model_.scheme.kernel == Kernel::cubic_spline)
          apply_traction<CubicKernel>(conditions[c], body, i);
        else  // GIMP and CPDI interpolate with hats too
          apply_traction<LinearKernel>(conditions[c], body, i);
      }
    }
  }
}

// With the velocities at mid step.
template <int Dim>
void Stepper<Dim>::account_tractions(double dt) {
  for (const auto& push : pushes_) {
    const Node& node = system_.fields[push.field].nodes[static_cast<std::size_t>(push.node)];
    for (int d = 0; d < Dim; ++d)
      ledger_.external_work += dt * push.force[d] * (node.velocity[d] - 0.5 * dt * node.acceleration[d]);
  }
}

template void Stepper<2>::apply_tractions();
template void Stepper<3>::apply_tractions();
template void Stepper<2>::account_tractions(double);
template void Stepper<3>::account_tractions(double);

}  // namespace tribo
