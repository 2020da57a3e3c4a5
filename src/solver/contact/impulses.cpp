// SPDX-License-Identifier: MIT
/// What contact does to nodes, ledger and particles.

#include "base/parallel.hpp"
#include "blocks/assembly.hpp"
#include "solver/contact/contact.hpp"

#include <algorithm>
#include <cmath>

namespace tribo {

template <int Dim>
template <class F>
void Contact<Dim>::each_pair_near(const ParticleDomain<Dim>& p, std::size_t field, F&& f) const {
  Index<Dim> low, n;
  for (std::size_t d = 0; d < Dim; ++d) {
    const auto axis = static_cast<Eigen::Index>(d);
    low[d] =
        static_cast<int>(std::floor((p.x[axis] - system_.lattice.origin[axis]) / system_.lattice.spacing[axis])) - 1;
  }
  for (int k = 0; k < (Dim == 2 ? 16 : 64); ++k) {
    n[0] = low[0] + k % 4, n[1] = low[1] + k / 4 % 4;
    if constexpr (Dim == 3) n[2] = low[2] + k / 16;
    Index<Dim> block;
    std::size_t local = 0;
    bool inside = true;
    for (std::size_t d = Dim; d-- > 0;) {
      inside = inside && n[d] >= 0 && n[d] < system_.lattice.blocks[d] * block_edge<Dim>;
      block[d] = n[d] / block_edge<Dim>;
      local = local * block_edge<Dim> + static_cast<std::size_t>(n[d] % block_edge<Dim>);
    }
    if (!inside) continue;
    const int s = shared_at_[static_cast<std::size_t>(system_.lattice.block_index(block))];
    if (s < 0) continue;
    const int r = record_[static_cast<std::size_t>(s) * block_nodes<Dim> + local];
    if (r < 0) continue;
    const Vec<Dim> distance = p.x - system_.lattice.position(n);
    if (!(weight(distance) > 0)) continue;
    const ContactNode& node = nodes_[static_cast<std::size_t>(r)];
    for (std::size_t q = node.first_pair; q < node.end_pair; ++q) {
      const ContactPair& pair = pairs_[q];
      if (pair.apart || pair.crack >= 0) continue;
      // Nodes on both sides of a face share its tractions: only the distance along it counts.
      const Vec<Dim> normal = pair.state.normal.template head<Dim>();
      const double w = weight(distance - distance.dot(normal) * normal);
      if (members_[pair.a].field == field) f(pair, w, 1.0);
      if (members_[pair.b].field == field) f(pair, w, -1.0);
    }
  }
}

template <int Dim>
void Contact<Dim>::remember() {
  parallel_for(static_cast<std::ptrdiff_t>(cloud_.size()), [&](std::ptrdiff_t k) {
    const ParticleLabel& label = cloud_.label(static_cast<std::size_t>(k));
    auto& body = *bodies_[label.body];
    if (!body.contact_slip) return;
    double touching = 0.0, sliding = 0.0, way = 0.0, whole = 0.0, broken = 0.0;
    each_pair_near(
        cloud_.point(static_cast<std::size_t>(k)), label.field, [&](const ContactPair& pair, double w, double) {
          if (!pair.law->remembers()) return;
          if (pair.response.status != ContactStatus::open) touching += w;
          if (pair.response.status == ContactStatus::slip) {
            const Vec3 v = pair.state.velocity - pair.impulse / pair.state.mass;
            sliding += w, way += w * pair.state.dt * (v - v.dot(pair.state.normal) * pair.state.normal).norm();
          }
          if (pair.response.bond == Bond::whole) whole += w;
          if (pair.response.bond == Bond::broken) broken += w;
        });
    double& slip = body.particles[body.contact_slip][label.particle];
    slip = sliding > 0.5 * touching ? slip + way / sliding : 0.0;
    if (whole + broken > 0) body.particles[body.contact_bond][label.particle] = broken > whole ? -1.0 : 1.0;
  });
}

template <int Dim>
void Contact<Dim>::show() {
  for (auto* body : bodies_)
    if (body->contact_state) {
      const std::size_t count = body->particles.size();
      std::fill_n(body->particles[body->contact_state], count, 0.0);
      for (const auto& vector : {body->contact_traction, body->contact_normal})
        for (double* component : body->particles[vector]) std::fill_n(component, count, 0.0);
    }
  for (ContactNode& node : nodes_) node.stale = node.bodies;
  collect();
  for (std::size_t k = 0; k < cloud_.size(); ++k) {
    const ParticleLabel& label = cloud_.label(k);
    auto& body = *bodies_[label.body];
    if (!body.contact_state) continue;
    double slip = 0.0, stick = 0.0, total = 0.0;
    Vec<Dim> traction = Vec<Dim>::Zero(), normal = Vec<Dim>::Zero();
    each_pair_near(cloud_.point(k), label.field, [&](const ContactPair& pair, double w, double side) {
      if (pair.state.gap > 0.1 * h_) return;
      // Nodes on both sides of a face may leave its whole pressure to those on one side.
      total += w * pair.state.area;
      if (pair.shown == ContactStatus::open) return;
      (pair.shown == ContactStatus::slip ? slip : stick) += w;
      normal += side * w * pair.state.normal.template head<Dim>();
      traction += side * w / pair.state.dt * pair.booked.template head<Dim>();
    });
    if (slip + stick == 0.0) continue;
    body.particles[body.contact_state][label.particle] = slip > stick ? 2.0 : 1.0;
    if (total > 0) traction /= total;
    if (normal.norm() > 0) normal.normalize();
    for (std::size_t d = 0; d < Dim; ++d) {
      body.particles[body.contact_traction][d][label.particle] = traction[static_cast<Eigen::Index>(d)];
      body.particles[body.contact_normal][d][label.particle] = normal[static_cast<Eigen::Index>(d)];
    }
  }
}

template <int Dim>
void Contact<Dim>::meet(double dt, Pass pass) {
  if (!active_) return;
  const auto lap = watch.lap();
  parallel_for(static_cast<std::ptrdiff_t>(nodes_.size()), [&](std::ptrdiff_t k) {
    ContactNode& node = nodes_[static_cast<std::size_t>(k)];
    if (node.by_faces) return;
    for (std::size_t i = node.first_member; i < node.end_member; ++i) {
      ContactMember& m = members_[i];
      const Node& at = system_.fields[m.field].nodes[static_cast<std::size_t>(m.at)];
      m.trial = Eigen::Map<const Vec3>(at.velocity);
      m.start = m.trial;
      if (pass == Pass::update) m.start -= dt * Eigen::Map<const Vec3>(at.acceleration);
    }
    for (std::size_t p = node.first_pair; p < node.end_pair; ++p) pairs_[p].state.dt = dt;
    solve_node(members_, pairs_of(node), pass == Pass::update, false);
    for (std::size_t p = node.first_pair; p < node.end_pair; ++p)
      for (const auto& [i, sign] : {std::pair{pairs_[p].a, 1.0}, std::pair{pairs_[p].b, -1.0}}) {
        Node& at = system_.fields[members_[i].field].nodes[static_cast<std::size_t>(members_[i].at)];
        const Vec3 change = sign * members_[i].inverse_mass * pairs_[p].impulse;
        Eigen::Map<Vec3>(at.velocity) += change;
        if (pass == Pass::update) Eigen::Map<Vec3>(at.acceleration) += change / dt;
      }
  });
  face_solver_.meet(dt, pass == Pass::update);
}

template <int Dim>
void Contact<Dim>::part() {
  if (!active_) return;
  const auto lap = watch.lap();
  face_solver_.part();
  parallel_for(static_cast<std::ptrdiff_t>(nodes_.size()), [&](std::ptrdiff_t k) {
    const ContactNode& node = nodes_[static_cast<std::size_t>(k)];
    if (node.by_faces) return;
    for (std::size_t p = node.first_pair; p < node.end_pair; ++p)
      for (const auto& [i, sign] : {std::pair{pairs_[p].a, 1.0}, std::pair{pairs_[p].b, -1.0}}) {
        Node& at = system_.fields[members_[i].field].nodes[static_cast<std::size_t>(members_[i].at)];
        Eigen::Map<Vec3>(at.velocity) -= sign * members_[i].inverse_mass * pairs_[p].impulse;
      }
  });
}

template <int Dim>
void Contact<Dim>::refine(bool update) {
  if (!active_) return;
  parallel_for(static_cast<std::ptrdiff_t>(nodes_.size()), [&](std::ptrdiff_t k) {
    const ContactNode& node = nodes_[static_cast<std::size_t>(k)];
    if (node.by_faces) return;
    const auto pairs = pairs_of(node);
    const auto increment = [&](const ContactMember& m) {
      return Eigen::Map<Vec3>(system_.fields[m.field].filter[static_cast<std::size_t>(m.at)].increment);
    };
    // The increment becomes the change that contact makes of it: new velocity minus old.
    for (std::size_t i = node.first_member; i < node.end_member; ++i) {
      ContactMember& m = members_[i];
      if (m.inverse_mass == 0.0) continue;
      const Vec3 before = velocity_after(members_, pairs, i);
      m.trial += increment(m);
      increment(m) = -before;
    }
    solve_node(members_, pairs, update, true);
    for (std::size_t i = node.first_member; i < node.end_member; ++i)
      if (members_[i].inverse_mass > 0.0) increment(members_[i]) += velocity_after(members_, pairs, i);
  });
  face_solver_.refine(update);
}

template <int Dim>
void Contact<Dim>::book(double dt) {
  if (!active_) return;
  const auto lap = watch.lap();
  for (auto& [fields, entry] : ledger_) entry.force.setZero(), entry.stored = entry.area = 0.0;
  rigid_shares_.assign(field_count_, {});
  if (cracks_.active()) cracks_.begin_record();
  for (const auto& node : nodes_)
    for (std::size_t p = node.first_pair; p < node.end_pair; ++p) {
      ContactPair& pair = pairs_[p];
      if (pair.crack >= 0 && !pair.apart) cracks_.record(pair, node.index);
      pair.booked = pair.impulse, pair.shown = pair.response.status, pair.friction = 0.0;
      if (pair.response.status == ContactStatus::open) continue;
      const ContactMember &a = members_[pair.a], &b = members_[pair.b];
      auto& entry = ledger_[ledger_key(pair)];
      entry.force += node.share / dt * pair.impulse;
      entry.stored += node.share * pair.response.stored;
      entry.area += node.share * pair.state.area;
      // Work of the pair on the grid, at the mean of the velocities of the step's ends
      const Vec3 mean = 0.5 * node.share *
                        (node.by_faces ? Vec3(pair.state.start + pair.after)
                                       : Vec3(b.start - a.start + velocity_after(members_, pairs_of(node), pair.b) -
                                              velocity_after(members_, pairs_of(node), pair.a)));
      const double all = pair.impulse.dot(mean);
      const double normal = pair.impulse.dot(pair.state.normal) * mean.dot(pair.state.normal);
      if (pair.law->interface())
        entry.interface += all;
      else
        entry.impact += normal, entry.friction += all - normal, pair.friction = (all - normal) / node.share;
      book_rigid(node, pair);
    }
  if (cracks_.active()) cracks_.end_record();
  if (remembers_) remember();
}

// An impulse between nodes acts at the common face.
template <int Dim>
void Contact<Dim>::book_rigid(const ContactNode& node, const ContactPair& pair) {
  for (const auto& [side, other, sign] : {std::tuple{pair.a, pair.b, -1.0}, std::tuple{pair.b, pair.a, 1.0}}) {
    const ContactMember& rigid = members_[side];
    if (rigid.inverse_mass > 0.0) continue;
    const Node& at = system_.fields[rigid.field].nodes[static_cast<std::size_t>(rigid.at)];
    const Vec3 impulse = sign * node.share * pair.impulse;  // on the other
    rigid_work += impulse.dot(Eigen::Map<const Vec3>(at.velocity));
    rigid_impulse += impulse;
    Vec3 x = Vec3::Zero();
    x.head<Dim>() = system_.lattice.position(node.index);
    if (node.by_faces) x += pair.face * pair.state.normal;
    RigidShare& share = rigid_shares_[rigid.field];
    const double mass = node.share * members_[other].mass;
    share.impulse -= impulse, share.moment -= x.cross(impulse);
    if (const auto k = system_.fields[rigid.field].block; k >= 0)
      share.spread -= impulse * system_.blocks->nearest_on(static_cast<std::size_t>(k), x).transpose();
    share.mass += mass, share.first += mass * x, share.second += mass * x.squaredNorm();
  }
}

template <int Dim>
PairLedger Contact<Dim>::total() const {
  PairLedger sum;
  for (const auto& [fields, entry] : ledger_) {
    sum.friction += entry.friction, sum.impact += entry.impact, sum.interface += entry.interface;
    sum.stored += entry.stored, sum.area += entry.area;
  }
  return sum;
}

template void Contact<2>::show();
template void Contact<2>::meet(double, Pass);
template void Contact<2>::part();
template void Contact<2>::refine(bool);
template void Contact<2>::book(double);
template PairLedger Contact<2>::total() const;
template void Contact<3>::show();
template void Contact<3>::meet(double, Pass);
template void Contact<3>::part();
template void Contact<3>::refine(bool);
template void Contact<3>::book(double);
template PairLedger Contact<3>::total() const;

}  // namespace tribo
