// SPDX-License-Identifier: MIT
#include "solver/contact/face_solver.hpp"

#include <cmath>

namespace tribo {
namespace {

// In Jacobi sweeps the laws of all pairs read the same velocities, so that pairs that share nodes also share the
// pressure evenly. Gauss-Seidel sweeps alone would load the first ones most.
constexpr int jacobi_sweeps = 5;
constexpr int max_gauss_seidel_sweeps = 10;
constexpr double tolerance = 1e-8;  // of the impulses, relative

}  // namespace

template <int Dim>
void FaceSolver<Dim>::clear() {
  dof_of_.resize(system_.fields.size());
  for (const NodalVelocity& p : dofs_)
    if (static_cast<std::size_t>(p.node) < dof_of_[p.field].size())
      dof_of_[p.field][static_cast<std::size_t>(p.node)] = -1;
  for (std::size_t f = 0; f < dof_of_.size(); ++f) dof_of_[f].resize(system_.fields[f].nodes.size(), -1);
  constraints_.clear(), terms_.clear(), dofs_.clear();
}

template <int Dim>
std::size_t FaceSolver<Dim>::dof(std::size_t field, std::int64_t at) {
  int& number = dof_of_[field][static_cast<std::size_t>(at)];
  if (number < 0) {
    number = static_cast<int>(dofs_.size());
    dofs_.push_back({field, at, 1.0 / system_.fields[field].nodes[static_cast<std::size_t>(at)].mass});
  }
  return static_cast<std::size_t>(number);
}

template <int Dim>
void FaceSolver<Dim>::add(ContactPair& pair, std::span<const ContactMember> members, const Index<Dim>& index,
                          bool has_face) {
  Constraint c{&pair, terms_.size(), 0};
  const ContactMember &a = members[pair.a], &b = members[pair.b];
  for (const auto* m : {&a, &b}) {
    const double sign = m == &a ? -1.0 : 1.0;
    if (m->inverse_mass == 0.0) {
      const Node& node = system_.fields[m->field].nodes[static_cast<std::size_t>(m->node)];
      c.rigid_velocity += sign * Eigen::Map<const Vec3>(node.velocity);
      continue;
    }
    terms_.push_back({dof(m->field, m->node), sign});
    if (has_face) add_image(pair, *m, index);
  }
  c.end_term = terms_.size();
  double effective = 0.0, lumped = 0.0;  // inverse masses
  for (std::size_t t = c.first_term; t < c.end_term; ++t) {
    const double inverse_mass = dofs_[terms_[t].dof].inverse_mass;
    lumped += std::abs(terms_[t].weight) * inverse_mass;
    for (std::size_t u = c.first_term; u < c.end_term; ++u)  // a node may be among the nodes of its own image
      if (terms_[u].dof == terms_[t].dof) effective += terms_[t].weight * terms_[u].weight * inverse_mass;
  }
  c.effective_mass = 1.0 / effective, c.lumped_mass = 1.0 / lumped;
  constraints_.push_back(c);
}

// Moves half of the weight of the last term to the mirror image of its node in the face. The velocity at the image is
// interpolated linearly between the nodes of the cell that contains it.
template <int Dim>
void FaceSolver<Dim>::add_image(const ContactPair& pair, const ContactMember& member, const Index<Dim>& index) {
  const auto& field = system_.fields[member.field];
  Index<Dim> low;
  Vec<Dim> fraction;
  for (int d = 0; d < Dim; ++d) {
    const auto k = static_cast<std::size_t>(d);
    double at = index[k] + 2 * pair.face_position * pair.state.normal[d] / field.map.lattice().spacing[d];
    if (std::abs(at - std::round(at)) < 1e-9) at = std::round(at);  // an image on a grid line, but for round-off
    low[k] = static_cast<int>(std::floor(at));
    fraction[d] = at - std::floor(at);
  }
  const std::size_t first = terms_.size();
  const double half = 0.5 * terms_[first - 1].weight;
  double total = 0.0;
  for (int corner = 0; corner < 1 << Dim; ++corner) {
    Index<Dim> n = low;
    double w = 1.0;
    for (int d = 0; d < Dim; ++d) {
      const int up = corner >> d & 1;
      n[static_cast<std::size_t>(d)] += up;
      w *= up != 0 ? fraction[d] : 1.0 - fraction[d];
    }
    const std::int64_t at = w > 0 ? field.map.node(n) : -1;
    if (at < 0 || !(field.nodes[static_cast<std::size_t>(at)].mass > 0)) continue;
    terms_.push_back({dof(member.field, at), w});
    total += w;
  }
  if (total == 0.0) return;
  terms_[first - 1].weight = half;
  for (std::size_t t = first; t < terms_.size(); ++t) terms_[t].weight *= half / total;
}

template <int Dim>
template <class Value>
Vec3 FaceSolver<Dim>::weighted_sum(const Constraint& c, Value&& value) const {
  Vec3 out = Vec3::Zero();
  for (std::size_t t = c.first_term; t < c.end_term; ++t) out += terms_[t].weight * value(dofs_[terms_[t].dof]);
  return out;
}

// Computes the impulse of a pair by its law from the velocity without that impulse. `mass`: impulse over the change of
// relative velocity that the law shall assume.
template <int Dim>
void FaceSolver<Dim>::update_impulse(Constraint& c, double mass, ContactPass pass) {
  ContactPair& pair = *c.pair;
  ContactState& m = pair.state;
  m.mass = mass;
  pair.final_velocity = c.trial_velocity + weighted_sum(c, [](const NodalVelocity& p) { return p.change; });
  m.velocity = pair.final_velocity + pair.impulse / mass;
  pair.response = response_of(pair, pass);
  c.impulse_change = pair.response.impulse - pair.impulse;
  pair.impulse = pair.response.impulse;
}

// Applies an impulse of a pair to the nodes, with the weights that their velocities have in its relative velocity. As
// the weights of one side sum to one, momentum is conserved.
template <int Dim>
void FaceSolver<Dim>::distribute(const Constraint& c, const Vec3& impulse) {
  for (std::size_t t = c.first_term; t < c.end_term; ++t) {
    NodalVelocity& p = dofs_[terms_[t].dof];
    p.change -= terms_[t].weight * p.inverse_mass * impulse;
  }
}

template <int Dim>
bool FaceSolver<Dim>::is_inactive(const Constraint& c, ContactPass pass) {
  return c.pair->has_no_face || c.pair->replaced_by_joint ||
         (pass == ContactPass::predictor && c.pair->law->is_interface());
}

// Projected Jacobi sweeps, then projected Gauss-Seidel sweeps, forward and backward in turn.
template <int Dim>
void FaceSolver<Dim>::solve(ContactPass pass) {
  for (int sweep = 0; sweep < jacobi_sweeps; ++sweep) {
    for (Constraint& c : constraints_)
      if (!is_inactive(c, pass)) update_impulse(c, c.lumped_mass, pass);
    for (Constraint& c : constraints_)
      if (!is_inactive(c, pass)) distribute(c, c.impulse_change);
  }
  for (int sweep = 0; sweep < max_gauss_seidel_sweeps; ++sweep) {
    double change = 0.0, size = 0.0;
    for (std::size_t k = 0; k < constraints_.size(); ++k) {
      Constraint& c = constraints_[sweep % 2 == 0 ? k : constraints_.size() - 1 - k];
      if (is_inactive(c, pass)) continue;
      update_impulse(c, c.effective_mass, pass);
      distribute(c, c.impulse_change);
      change += c.impulse_change.squaredNorm(), size += c.pair->impulse.squaredNorm();
    }
    if (change <= tolerance * tolerance * size) break;
  }
  for (Constraint& c : constraints_)
    c.pair->final_velocity = c.trial_velocity + weighted_sum(c, [](const NodalVelocity& p) { return p.change; });
}

template <int Dim>
void FaceSolver<Dim>::apply(double dt, ContactPass pass) {
  const auto node = [&](const NodalVelocity& p) -> Node& {
    return system_.fields[p.field].nodes[static_cast<std::size_t>(p.node)];
  };
  for (NodalVelocity& p : dofs_) p.change.setZero();
  for (Constraint& c : constraints_) {
    c.trial_velocity = c.rigid_velocity + weighted_sum(c, [&](const NodalVelocity& p) {
                         return Vec3(Eigen::Map<const Vec3>(node(p).velocity));
                       });
    ContactState& m = c.pair->state;
    m.dt = dt;
    m.start = c.trial_velocity;
    if (pass == ContactPass::corrector)
      m.start -= dt * weighted_sum(c, [&](const NodalVelocity& p) {
                   return Vec3(Eigen::Map<const Vec3>(node(p).acceleration));
                 });
    c.pair->impulse.setZero(), c.pair->response = {};
    if (pass == ContactPass::corrector && !is_inactive(c, pass)) c.pair->impulse = c.pair->update_impulse;
  }
  for (const Constraint& c : constraints_) distribute(c, c.pair->impulse);
  solve(pass);
  for (const NodalVelocity& p : dofs_) {
    Eigen::Map<Vec3>(node(p).velocity) += p.change;
    if (pass == ContactPass::corrector) Eigen::Map<Vec3>(node(p).acceleration) += p.change / dt;
  }
}

template <int Dim>
void FaceSolver<Dim>::remove() {
  for (const NodalVelocity& p : dofs_)
    Eigen::Map<Vec3>(system_.fields[p.field].nodes[static_cast<std::size_t>(p.node)].velocity) -= p.change;
}

template <int Dim>
void FaceSolver<Dim>::constrain_increments(ContactPass pass) {
  const auto increment = [&](const NodalVelocity& p) {
    return Eigen::Map<Vec3>(system_.fields[p.field].filter[static_cast<std::size_t>(p.node)].increment);
  };
  for (Constraint& c : constraints_)
    c.trial_velocity += weighted_sum(c, [&](const NodalVelocity& p) { return Vec3(increment(p)); });
  for (NodalVelocity& p : dofs_) increment(p) -= p.change;
  solve(pass);
  for (NodalVelocity& p : dofs_) increment(p) += p.change;
}

template class FaceSolver<2>;
template class FaceSolver<3>;

}  // namespace tribo
