// SPDX-License-Identifier: MIT
/// Energy release rate and stress intensities of crack tips.

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
      around_(model, system.lattice),
      active_(model.fracture.has_value()),
      cell_(system.lattice.spacing.maxCoeff()),
      beyond_(width + 1) {
  if (!active_) return;
  for (const auto& body : system.bodies) moduli_.push_back(elastic_moduli(*body.law));
}

/// The particles around a tip, and axes along the crack and to its left.
struct CrackTips<2>::Ring {
  struct Member {
    Body<2>* body;
    std::size_t of, particle;
  };
  Vec<2> tip;
  Mat<2> axes;
  double inner, outer;  // radii between which the weight falls from one to zero
  std::vector<Member> members;
  Mat<2> turn;  // rotation of the matter

  /// The body around the tip.
  std::size_t nearest() const {
    double least = std::numeric_limits<double>::infinity();
    std::size_t of = 0;
    for (const Member& m : members)
      if (const double d = (m.body->particles.position(m.particle) - tip).norm(); d < least) least = d, of = m.of;
    return of;
  }
  double weight(double r) const {
    const double s = std::clamp((r - inner) / (outer - inner), 0.0, 1.0);
    return 1 - s * s * (3 - 2 * s);
  }
  /// Of a point of the particle at `centre`, both from the tip: on the particle's side of the crack, which may be
  /// beyond
  /// +-pi.
  double angle(const Vec<2>& from_tip, const Vec<2>& centre) const {
    const Vec<2> base = axes.transpose() * centre;
    const double cross = centre[0] * from_tip[1] - centre[1] * from_tip[0];
    return std::atan2(base[1], base[0]) + std::atan2(cross, centre.dot(from_tip));
  }
  Vec<2> slope(const Vec<2>& from_tip) const {
    const double r = from_tip.norm(), s = (r - inner) / (outer - inner);
    if (s <= 0 || s >= 1) return Vec<2>::Zero();
    return -6 * s * (1 - s) / (outer - inner) / r * from_tip;
  }
};

CrackTips<2>::Ring CrackTips<2>::ring(const Crack<2>& crack, const CrackTip& tip) const {
  Ring out;
  out.tip = crack.x[tip.point];
  out.axes.col(0) = (out.tip - crack.x[tip.behind]).normalized();
  out.axes.col(1) << -out.axes(1, 0), out.axes(0, 0);
  const double size = model_.fracture->size;
  out.inner = std::max(size - 1, 0.5 * size) * cell_, out.outer = (size + 1) * cell_;
  Mat<2> mean = Mat<2>::Zero();
  constexpr double drift = 4.0;  // cells between a bin's edge and its particles: stencils, and what they moved
  const Vec<2> reach = Vec<2>::Constant(out.outer) + drift * system_.lattice.spacing;
  for (std::size_t b = 0; b < system_.bodies.size(); ++b) {
    Body<2>& body = system_.bodies[b];
    const auto F = body.particles.F();
    for (const Bin& bin : body.bins.list()) {
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
  out.turn = Eigen::Rotation2Dd(angle).toRotationMatrix();
  return out;
}

// Of the nodes, with the fields that a particle at x feels.
Vec<2> CrackTips<2>::acceleration(const Body<2>& body, const Vec<2>& x) const {
  thread_local Cracks<2>::NearbyPieces nearby;
  cracks_.find_nearby(x, nearby);
  double all = 0.0;
  Vec<2> sum = Vec<2>::Zero();
  around_.each(x, [&](double w, Index<2> n) {
    const int side = cracks_.side_of_node(nearby, x, n);
    const Vec<2> mirror = around_.fold(n);
    const auto& field = system_.fields[side == 0 ? body.field : body.across[static_cast<std::size_t>(side) - 1]];
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
      if (tip.lives) measure(crack, tip, force);
}

double CrackTips<2>::kappa(const ElasticModuli& moduli) const {
  return model_.analysis == Analysis::plane_stress ? (3 - moduli.nu) / (1 + moduli.nu) : 3 - 4 * moduli.nu;
}

// Calls f(middle, traction on the lower face, change of the opening towards the tip, length) for pieces of the faces;
// lower and upper as the tip's axes have it.
template <class F>
void CrackTips<2>::each_loaded_face(const Crack<2>& crack, const CrackTip& tip, const Ring& ring, F&& f) const {
  const double of_axes = tip.end == 1 ? 1 : -1;  // at the first point the axes' lower face is the crack's upper one
  for (std::size_t p = 0; p < crack.drawn_pieces; ++p) {
    const auto [a, b] = crack.pieces[p];
    const Vec<2> traction = 0.5 * (crack.traction[a] + crack.traction[b]), middle = 0.5 * (crack.x[a] + crack.x[b]);
    if (traction.isZero() || (middle - ring.tip).norm() >= ring.outer) continue;
    f(middle, Vec<2>(of_axes * traction), Vec<2>(crack.opening(b) - crack.opening(a)),
      (crack.x[b] - crack.x[a]).norm());
  }
}

double CrackTips<2>::work_of_faces(const Crack<2>& crack, const CrackTip& tip, const Ring& ring) const {
  double sum = 0.0;
  each_loaded_face(crack, tip, ring, [&](const Vec<2>& x, const Vec<2>& traction, const Vec<2>& change, double) {
    sum += traction.dot(change) * ring.weight((x - ring.tip).norm());
  });
  return sum;
}

std::array<double, 2> CrackTips<2>::work_of_faces_in_modes(const Crack<2>& crack, const CrackTip& tip, const Ring& ring,
                                                           const ElasticModuli& moduli) const {
  constexpr double pi = std::numbers::pi;
  std::array<double, 2> sum{};
  each_loaded_face(crack, tip, ring, [&](const Vec<2>& x, const Vec<2>& traction, const Vec<2>&, double length) {
    const double r = (x - ring.tip).norm();
    for (int mode = 1; mode <= 2; ++mode) {
      const Vec<2> apart = tip_field(mode, r, pi, moduli.G, kappa(moduli)).gradient.col(0) -
                           tip_field(mode, r, -pi, moduli.G, kappa(moduli)).gradient.col(0);
      sum[static_cast<std::size_t>(mode) - 1] +=
          length * (ring.axes.transpose() * traction).dot(apart) * ring.weight(r);
    }
  });
  return sum;
}

// J is the integral over the ring of
//   u_,1 . (tau . grad q) - w (F D) . grad q + rho (a - b) . u_,1 q,   u_,1 = (F - R) D,
// per volume of the reference state, in which the crack points along D = R^T e_1. Faces add t . [u]_,1 q.
void CrackTips<2>::measure(const Crack<2>& crack, CrackTip& tip, const Force& force) {
  const Ring ring = this->ring(crack, tip);
  struct Sums {
    double J = 0.0;
    std::array<double, 2> with_mode{};
    bool elastic = true;
  };
  std::vector<Sums> parts(ring.members.size());
  const Vec<2> forward = ring.turn.transpose() * ring.axes.col(0);
  const bool inertia = model_.fracture->inertia;
  parallel_for(static_cast<std::ptrdiff_t>(parts.size()), [&](std::ptrdiff_t k) {
    const auto& member = ring.members[static_cast<std::size_t>(k)];
    Sums& sum = parts[static_cast<std::size_t>(k)];
    Body<2>& body = *member.body;
    const auto i = static_cast<int>(member.particle);
    const ParticleDomain<2> domain = DomainReader<2>(body)(static_cast<std::uint32_t>(i));
    const Mat<2> F = load_full<2>(body.particles.F(), i).topLeftCorner<2, 2>();
    const Mat<2> stress = load_symmetric<2>(body.particles.stress(), i).topLeftCorner<2, 2>();
    const double volume = body.particles.volume()[member.particle];
    const double energy = stored_energy(body, member.particle) + dissipated_energy(body, member.particle);
    Vec<2> push = Vec<2>::Zero();
    if (inertia && (domain.x - ring.tip).norm() < ring.outer)
      push = body.particles.mass()[member.particle] *
             (acceleration(body, domain.x) - force(domain.x, body.particles.velocity(member.particle)));
    const Vec<2> stretch = (F - ring.turn) * forward, along = F * forward;
    const auto& moduli = moduli_[member.of];
    const Mat<2> local_stress = ring.axes.transpose() * stress * ring.axes;
    const Mat<2> local_gradient = ring.axes.transpose() * (F * ring.turn.transpose() - Mat<2>::Identity()) * ring.axes;
    for (int g = 0; g < 4; ++g) {
      constexpr double gauss = 0.5773502691896258;
      const Vec<2> from_tip =
          domain.x + gauss * ((g & 1 ? 1 : -1) * domain.axes.col(0) + (g & 2 ? 1 : -1) * domain.axes.col(1)) - ring.tip;
      const double r = from_tip.norm(), q = 0.25 * ring.weight(r);
      if (!(q > 0)) continue;
      const Vec<2> slope = 0.25 * ring.slope(from_tip);
      sum.J += volume * stretch.dot(stress * slope) - energy * along.dot(slope) + push.dot(stretch) * q;
      if (!moduli) {
        sum.elastic = false;
        continue;
      }
      const Vec<2> local_slope = ring.axes.transpose() * slope, local_push = ring.axes.transpose() * push;
      const double angle = ring.angle(from_tip, domain.x - ring.tip);
      for (int mode = 1; mode <= 2; ++mode) {
        const TipField pure = tip_field(mode, r, angle, moduli->G, kappa(*moduli));
        sum.with_mode[static_cast<std::size_t>(mode) - 1] +=
            volume * (pure.gradient.col(0).dot(local_stress * local_slope) +
                      local_gradient.col(0).dot(pure.stress * local_slope) -
                      local_stress.cwiseProduct(pure.gradient).sum() * local_slope[0]) +
            local_push.dot(pure.gradient.col(0)) * q;
      }
    }
  });
  Sums all;
  for (const Sums& part : parts) {
    all.J += part.J, all.elastic = all.elastic && part.elastic;
    for (std::size_t m = 0; m < 2; ++m) all.with_mode[m] += part.with_mode[m];
  }
  const double thickness = model_.grid.thickness;
  tip.J = all.J / thickness + work_of_faces(crack, tip, ring);
  tip.body = ring.nearest();
  tip.K.fill(std::numeric_limits<double>::quiet_NaN());
  if (!all.elastic || ring.members.empty()) return;
  const ElasticModuli& moduli = *moduli_[tip.body];
  const double per_J = 8 * moduli.G / (kappa(moduli) + 1);  // J = (K1^2 + K2^2)/E', E' = 8 G/(kappa + 1)
  const auto faces = work_of_faces_in_modes(crack, tip, ring, moduli);
  for (std::size_t m = 0; m < 2; ++m) tip.K[m] = 0.5 * per_J * (all.with_mode[m] / thickness + faces[m]);
}

}  // namespace tribo
