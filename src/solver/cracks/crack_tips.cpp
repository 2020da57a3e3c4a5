// SPDX-License-Identifier: MIT
/// Energy release rate and stress intensity factors of crack tips.

#include "solver/cracks/crack_tips.hpp"

#include "base/parallel.hpp"
#include "geometry/crack_tip_fields.hpp"
#include "solver/state/particle_domain.hpp"
#include "solver/transfer/material_points.hpp"

#include <cmath>
#include <numbers>

namespace tribo {

CrackTips<2>::CrackTips(const Model& model, System<2>& system, const Cracks<2>& cracks, int width)
    : model_(model),
      system_(system),
      cracks_(cracks),
      nodes_around_(model, system.lattice),
      active_(model.fracture.has_value()),
      cell_(system.lattice.spacing.maxCoeff()),
      extension_cells_(width + 1) {
  if (!active_) return;
  for (const auto& body : system.bodies) moduli_.push_back(elastic_moduli(*body.law));
}

/// The domain of integration around a tip: its particles, its axes (along the crack and to the left of it) and the
/// weight function q.
struct CrackTips<2>::TipDomain {
  struct Member {
    Body<2>* body;
    std::size_t body_number, particle;
  };
  Vec<2> tip;
  Mat<2> axes;
  double inner, outer;  // radii between which the weight falls from one to zero
  std::vector<Member> members;
  Mat<2> rotation;  // mean rotation of the material around the tip

  /// Number of the body whose particle is closest to the tip.
  std::size_t nearest() const {
    double least = std::numeric_limits<double>::infinity();
    std::size_t body_number = 0;
    for (const Member& m : members)
      if (const double d = (m.body->particles.position(m.particle) - tip).norm(); d < least)
        least = d, body_number = m.body_number;
    return body_number;
  }
  /// Weight q at the distance r from the tip.
  double weight(double r) const {
    const double s = std::clamp((r - inner) / (outer - inner), 0.0, 1.0);
    return 1 - s * s * (3 - 2 * s);
  }
  /// Polar angle of a point of the particle domain with the given centre; both are relative to the tip. The angle is
  /// continuous within the domain, so it may exceed +-pi on the side of the crack on which the particle lies.
  double angle(const Vec<2>& from_tip, const Vec<2>& centre) const {
    const Vec<2> base = axes.transpose() * centre;
    const double cross = centre[0] * from_tip[1] - centre[1] * from_tip[0];
    return std::atan2(base[1], base[0]) + std::atan2(cross, centre.dot(from_tip));
  }
  /// Gradient of the weight q.
  Vec<2> weight_gradient(const Vec<2>& from_tip) const {
    const double r = from_tip.norm(), s = (r - inner) / (outer - inner);
    if (s <= 0 || s >= 1) return Vec<2>::Zero();
    return -6 * s * (1 - s) / (outer - inner) / r * from_tip;
  }
};

CrackTips<2>::TipDomain CrackTips<2>::tip_domain(const Crack<2>& crack, const CrackTip& tip) const {
  TipDomain out;
  out.tip = crack.x[tip.point];
  out.axes.col(0) = crack.direction_at(tip, tip_length * cell_);
  out.axes.col(1) << -out.axes(1, 0), out.axes(0, 0);
  const double size = model_.fracture->size;
  out.inner = std::max(size - 1, 0.5 * size) * cell_, out.outer = (size + 1) * cell_;
  Mat<2> mean = Mat<2>::Zero();
  // [cells] largest distance of particles from their block: drift since the last sort and width of the stencil
  constexpr double bin_margin = 4.0;
  const Vec<2> reach = Vec<2>::Constant(out.outer) + bin_margin * system_.lattice.spacing;
  for (std::size_t b = 0; b < system_.bodies.size(); ++b) {
    Body<2>& body = system_.bodies[b];
    const auto F = body.particles.F();
    for (const std::uint32_t k : body.bins.by_block()) {
      const Bin& bin = body.bins.with_ghosts()[k];
      const Index<2> block = system_.lattice.block_at(bin.block);
      const Vec<2> low = system_.lattice.position({block[0] * block_edge<2>, block[1] * block_edge<2>});
      const Vec<2> high = low + block_edge<2> * system_.lattice.spacing;
      if (((low - reach).array() > out.tip.array()).any() || ((high + reach).array() < out.tip.array()).any()) continue;
      for (std::size_t i = bin.begin; i < bin.end; ++i) {
        if ((body.particles.position(i) - out.tip).norm() > out.outer + cell_) continue;
        out.members.push_back({&body, b, i});
        mean += body.particles.volume()[i] * load_full<2>(F, static_cast<int>(i)).topLeftCorner<2, 2>();
      }
    }
  }
  const double angle = std::atan2(mean(1, 0) - mean(0, 1), mean(0, 0) + mean(1, 1));
  out.rotation = Eigen::Rotation2Dd(angle).toRotationMatrix();
  return out;
}

// Acceleration at x, interpolated from the nodal fields on the same side of all cracks as x.
Vec<2> CrackTips<2>::acceleration(const Body<2>& body, const Vec<2>& x) const {
  thread_local Cracks<2>::NodeBox nodes;
  cracks_.find_nodes(x, nodes);
  const Cracks<2>::PointSides sides = cracks_.sides_of(nodes, x);
  double all = 0.0;
  Vec<2> sum = Vec<2>::Zero();
  nodes_around_.each(x, [&](double w, Index<2> n) {
    const int side = cracks_.side_of_node(sides, n);
    const Vec<2> mirror = nodes_around_.fold(n);
    const auto& field = system_.fields[side == 0 ? body.field : body.across_fields[static_cast<std::size_t>(side) - 1]];
    const auto at = field.map.node(n);
    if (at < 0) return;
    const Node& node = field.nodes[static_cast<std::size_t>(at)];
    if (!(node.mass > 0)) return;
    all += w, sum += w * mirror.cwiseProduct(Vec<2>(node.acceleration[0], node.acceleration[1]));
  });
  return all > 0 ? Vec<2>(sum / all) : sum;
}

void CrackTips<2>::measure(const Force& force) {
  for (auto& crack : system_.cracks)
    for (auto& tip : crack.tips)
      if (tip.active) measure(crack, tip, force);
}

double CrackTips<2>::kappa(const ElasticModuli& moduli) const {
  return model_.analysis == Analysis::plane_stress ? (3 - moduli.nu) / (1 + moduli.nu) : 3 - 4 * moduli.nu;
}

// Calls f(middle, traction on the lower face, change of the opening towards the tip, length) for the pieces with
// tractions. Lower and upper refer to the axes of the tip.
template <class F>
void CrackTips<2>::each_loaded_face(const Crack<2>& crack, const CrackTip& tip, const TipDomain& tip_domain,
                                    F&& f) const {
  // at the first point, the lower face with respect to the axes is the upper face of the crack
  const double face_sign = tip.end == 1 ? 1 : -1;
  for (std::size_t p = 0; p < crack.main_pieces; ++p) {
    const auto [a, b] = crack.pieces[p];
    const Vec<2> traction = 0.5 * (crack.traction[a] + crack.traction[b]), middle = 0.5 * (crack.x[a] + crack.x[b]);
    if (traction.isZero() || (middle - tip_domain.tip).norm() >= tip_domain.outer) continue;
    f(middle, Vec<2>(face_sign * traction), Vec<2>(crack.opening(b) - crack.opening(a)),
      (crack.x[b] - crack.x[a]).norm());
  }
}

double CrackTips<2>::work_of_faces(const Crack<2>& crack, const CrackTip& tip, const TipDomain& tip_domain) const {
  double sum = 0.0;
  each_loaded_face(crack, tip, tip_domain, [&](const Vec<2>& x, const Vec<2>& traction, const Vec<2>& change, double) {
    sum += traction.dot(change) * tip_domain.weight((x - tip_domain.tip).norm());
  });
  return sum;
}

std::array<double, 2> CrackTips<2>::work_of_faces_in_modes(const Crack<2>& crack, const CrackTip& tip,
                                                           const TipDomain& tip_domain,
                                                           const ElasticModuli& moduli) const {
  constexpr double pi = std::numbers::pi;
  std::array<double, 2> sum{};
  each_loaded_face(crack, tip, tip_domain, [&](const Vec<2>& x, const Vec<2>& traction, const Vec<2>&, double length) {
    const double r = (x - tip_domain.tip).norm();
    for (int mode = 1; mode <= 2; ++mode) {
      const Vec<2> jump = tip_field(mode, r, pi, moduli.G, kappa(moduli)).gradient.col(0) -
                          tip_field(mode, r, -pi, moduli.G, kappa(moduli)).gradient.col(0);
      sum[static_cast<std::size_t>(mode) - 1] +=
          length * (tip_domain.axes.transpose() * traction).dot(jump) * tip_domain.weight(r);
    }
  });
  return sum;
}

// J is the integral over the domain of
//   u_,1 . (tau . grad q) - w (F D) . grad q + rho (a - b) . u_,1 q,   u_,1 = (F - R) D,
// per volume of the reference state, in which the crack points along D = R^T e_1. Tractions t on the crack faces add t
// . [u]_,1 q.
void CrackTips<2>::measure(const Crack<2>& crack, CrackTip& tip, const Force& force) {
  const TipDomain tip_domain = this->tip_domain(crack, tip);
  struct Sums {
    double J = 0.0;
    std::array<double, 2> with_mode{};
    bool elastic = true;
  };
  std::vector<Sums> parts(tip_domain.members.size());
  const Vec<2> forward = tip_domain.rotation.transpose() * tip_domain.axes.col(0);
  const bool inertia = model_.fracture->inertia;
  parallel_for(static_cast<std::ptrdiff_t>(parts.size()), [&](std::ptrdiff_t k) {
    const auto& member = tip_domain.members[static_cast<std::size_t>(k)];
    Sums& sum = parts[static_cast<std::size_t>(k)];
    Body<2>& body = *member.body;
    const auto i = static_cast<int>(member.particle);
    const ParticleDomain<2> domain = DomainReader<2>(body)(static_cast<std::uint32_t>(i));
    const Mat<2> F = load_full<2>(body.particles.F(), i).topLeftCorner<2, 2>();
    const Mat<2> stress = load_symmetric<2>(body.particles.stress(), i).topLeftCorner<2, 2>();
    const double volume = body.particles.volume()[member.particle];
    const double energy = stored_energy(body, member.particle) + dissipated_energy(body, member.particle);
    Vec<2> inertia_force = Vec<2>::Zero();
    if (inertia && (domain.x - tip_domain.tip).norm() < tip_domain.outer)
      inertia_force = body.particles.mass()[member.particle] *
                      (acceleration(body, domain.x) - force(domain.x, body.particles.velocity(member.particle)));
    const Vec<2> forward_gradient = (F - tip_domain.rotation) * forward, along = F * forward;
    const auto& moduli = moduli_[member.body_number];
    const Mat<2> local_stress = tip_domain.axes.transpose() * stress * tip_domain.axes;
    const Mat<2> local_gradient =
        tip_domain.axes.transpose() * (F * tip_domain.rotation.transpose() - Mat<2>::Identity()) * tip_domain.axes;
    for (int g = 0; g < 4; ++g) {
      constexpr double gauss = 0.5773502691896258;
      const Vec<2> from_tip = domain.x +
                              gauss * ((g & 1 ? 1 : -1) * domain.axes.col(0) + (g & 2 ? 1 : -1) * domain.axes.col(1)) -
                              tip_domain.tip;
      const double r = from_tip.norm(), q = 0.25 * tip_domain.weight(r);
      if (!(q > 0)) continue;
      const Vec<2> weight_gradient = 0.25 * tip_domain.weight_gradient(from_tip);
      sum.J += volume * forward_gradient.dot(stress * weight_gradient) - energy * along.dot(weight_gradient) +
               inertia_force.dot(forward_gradient) * q;
      if (!moduli) {
        sum.elastic = false;
        continue;
      }
      const Vec<2> local_weight_gradient = tip_domain.axes.transpose() * weight_gradient,
                   local_inertia_force = tip_domain.axes.transpose() * inertia_force;
      const double angle = tip_domain.angle(from_tip, domain.x - tip_domain.tip);
      for (int mode = 1; mode <= 2; ++mode) {
        const TipField mode_field = tip_field(mode, r, angle, moduli->G, kappa(*moduli));
        sum.with_mode[static_cast<std::size_t>(mode) - 1] +=
            volume * (mode_field.gradient.col(0).dot(local_stress * local_weight_gradient) +
                      local_gradient.col(0).dot(mode_field.stress * local_weight_gradient) -
                      local_stress.cwiseProduct(mode_field.gradient).sum() * local_weight_gradient[0]) +
            local_inertia_force.dot(mode_field.gradient.col(0)) * q;
      }
    }
  });
  Sums all;
  for (const Sums& part : parts) {
    all.J += part.J, all.elastic = all.elastic && part.elastic;
    for (std::size_t m = 0; m < 2; ++m) all.with_mode[m] += part.with_mode[m];
  }
  const double thickness = model_.grid.thickness;
  tip.J = all.J / thickness + work_of_faces(crack, tip, tip_domain);
  tip.body = tip_domain.nearest();
  tip.K = {}, tip.has_K = all.elastic && !tip_domain.members.empty();
  if (!tip.has_K) return;
  const ElasticModuli& moduli = *moduli_[tip.body];
  const double per_J = 8 * moduli.G / (kappa(moduli) + 1);  // J = (K1^2 + K2^2)/E', E' = 8 G/(kappa + 1)
  const auto faces = work_of_faces_in_modes(crack, tip, tip_domain, moduli);
  for (std::size_t m = 0; m < 2; ++m) tip.K[m] = 0.5 * per_J * (all.with_mode[m] / thickness + faces[m]);
}

}  // namespace tribo
