// SPDX-License-Identifier: MIT
#include "solver/contact/face_solver.hpp"

#include "base/parallel.hpp"

#include <algorithm>
#include <cmath>

namespace tribo {
namespace {

// In Jacobi sweeps the laws of all pairs read the same velocities, so that pairs that share nodes also share the
// pressure evenly. Gauss-Seidel sweeps alone would load the first ones most.
constexpr int jacobi_sweeps = 5;
constexpr int max_sweeps_from_rest = 50;  // Gauss-Seidel sweeps if no impulses of the last step are known
constexpr int max_sweeps = 10;            // if they are
constexpr double tolerance = 1e-8;        // of the impulses, relative
// Pairs whose node lies farther from its image in the face act on the node only [cells]
constexpr int max_image_distance = 4;
// Nodes around an image with less than this fraction of the mean mass of the nodes of a constraint have a smaller
// weight. Of values from 0.001 to 3, those from 0.03 to 0.1 make the stress next to faces most uniform (splines, uGIMP
// and CPDI, at 0 to 45 degrees to the grid).
constexpr double light_node = 0.03;
// At the start of the step contact changes nodes with less than this fraction of the mean mass in part only
constexpr double light_at_start = 0.3;
constexpr std::ptrdiff_t serial_below = 200;  // constraints

template <int Dim>
Eigen::Map<const Vec3> velocity_of(const System<Dim>& system, std::size_t field, std::int64_t node) {
  return Eigen::Map<const Vec3>(system.fields[field].nodes[static_cast<std::size_t>(node)].velocity);
}

// Reduction of the weight of a light node. A body that reaches over a node by d has there a mass of the order d^3 and
// an internal force of the order d^2, if its stress is uniform, with splines of second order. `ratio`: mass of the node
// over the one from which on the weight is full.
double reduction(double ratio) { return ratio < 1 ? std::cbrt(ratio * ratio) : 1.0; }

// Weight of the velocity at the image of a node in the face so that the weighted mean position lies on the face: then
// the velocity at the face is exact where it is linear. `face`, `image`: distances from the node along the normal.
double image_share(double face, double image) {
  const bool between = image != 0.0 && face / image > 0.0 && face / image < 1.0;  // the face is between node and image
  return between ? face / image : 0.5;
}

}  // namespace

template <int Dim>
void FaceSolver<Dim>::set_up(ContactNodes<Dim>& contacts) {
  list_constraints(contacts);
  each_constraint([&](Constraint& c) { find_terms(c, contacts.members); });
  number_velocities();
  each_constraint([&](Constraint& c) { find_masses(c); });
}

template <int Dim>
void FaceSolver<Dim>::list_constraints(ContactNodes<Dim>& contacts) {
  // Two blocks of the same colour are so far apart that the nodes in reach of their pairs are different ones.
  constexpr int colours = (2 * max_image_distance + block_edge<Dim> - 1) / block_edge<Dim> + 1;
  const auto has_face = [](const ContactPair& pair) {
    return !pair.has_no_face && !pair.replaced_by_joint && pair.crack < 0 && pair.law->uses_face();
  };
  constraints_.clear(), groups_.clear(), colour_ends_.clear();
  Index<Dim> last_block;
  for (ContactNode<Dim>& node : contacts.nodes) {
    const auto pairs = contacts.pairs_of(node);
    node.solved_on_faces = std::any_of(pairs.begin(), pairs.end(), has_face);
    if (!node.solved_on_faces) continue;
    Index<Dim> block;
    int colour = 0;
    for (std::size_t d = 0; d < Dim; ++d)
      block[d] = node.index[d] / block_edge<Dim>, colour = colour * colours + block[d] % colours;
    if (groups_.empty() || block != last_block) groups_.push_back({constraints_.size(), constraints_.size(), colour});
    last_block = block;
    for (ContactPair& pair : pairs) {
      Constraint& c = constraints_.emplace_back();
      c.pair = &pair, c.node = &node, c.has_face = has_face(pair);
    }
    groups_.back().end = constraints_.size();
  }
  std::stable_sort(groups_.begin(), groups_.end(), [](const Group& a, const Group& b) { return a.colour < b.colour; });
  for (std::size_t g = 0; g < groups_.size(); ++g)
    if (g + 1 == groups_.size() || groups_[g + 1].colour != groups_[g].colour) colour_ends_.push_back(g + 1);
}

template <int Dim>
void FaceSolver<Dim>::find_terms(Constraint& c, std::span<const ContactMember> members) const {
  ContactPair& pair = *c.pair;
  for (const auto& [member, sign] : {std::pair{&members[pair.a], -1.0}, std::pair{&members[pair.b], 1.0}}) {
    const std::size_t first = c.term_count;
    c.terms[c.term_count++] = {static_cast<std::uint32_t>(member->field), 0, member->node, sign};
    double& mean_mass = c.mean_mass[sign < 0 ? 0 : 1];
    mean_mass = c.has_face ? add_face_terms(c, *member, sign) : member->mass;
    if (member->inverse_mass > 0.0) continue;
    pair.rigid_velocity.setZero();
    for (std::size_t t = first; t < c.term_count; ++t)
      pair.rigid_velocity += c.terms[t].weight * velocity_of(system_, c.terms[t].field, c.terms[t].node);
    c.term_count = first;
  }
}

// Moves a part of the weight of the last term to the mirror image of its node in the face. The velocity at the image is
// that of the nodes of the cell that contains it, which the body may reach in part only. Returns the mean mass of the
// nodes.
template <int Dim>
double FaceSolver<Dim>::add_face_terms(Constraint& c, const ContactMember& member, double sign) const {
  const std::size_t own = c.term_count - 1;
  const Term first = c.terms[own];
  std::array<double, 1 << Dim> distances;  // of the nodes around the image from the node, along the normal
  if (!add_image_terms(c, first, distances)) return member.mass;
  const std::span<Term> image(&c.terms[own + 1], c.term_count - own - 1);
  const auto mass = [&](const Term& t) { return system_.fields[t.field].nodes[static_cast<std::size_t>(t.node)].mass; };

  double mean_mass = 0.0, total = 0.0, distance = 0.0;
  for (const Term& t : image) mean_mass += t.weight * mass(t), total += t.weight;
  mean_mass = 0.5 * (mass(first) + mean_mass / total);
  total = 0.0;
  for (std::size_t k = 0; k < image.size(); ++k) {
    image[k].weight *= reduction(mass(image[k]) / (light_node * mean_mass));
    total += image[k].weight, distance += image[k].weight * distances[k];
  }
  const double share = image_share(c.pair->face_position, distance / total);
  c.terms[own].weight = (1 - share) * sign;
  mean_mass = (1 - share) * mass(first);
  for (Term& t : image) {
    t.weight *= share / total;
    mean_mass += t.weight * mass(t);
    t.weight *= sign;
  }
  return mean_mass;
}

// Adds the nodes of the cell that contains the image of a node in the face, with the weights of linear interpolation,
// so far as the body reaches them. Returns whether there are any.
template <int Dim>
bool FaceSolver<Dim>::add_image_terms(Constraint& c, const Term& of, std::span<double> distances) const {
  const auto& field = system_.fields[of.field];
  const auto& spacing = field.map.lattice().spacing;
  const Vec3& normal = c.pair->state.normal;
  Index<Dim> low;
  Vec<Dim> fraction;
  for (int d = 0; d < Dim; ++d) {
    double offset = 2 * c.pair->face_position * normal[d] / spacing[d];
    if (!(std::abs(offset) < max_image_distance)) return false;
    if (std::abs(offset - std::round(offset)) < 1e-9) offset = std::round(offset);  // on a grid line, but for round-off
    low[static_cast<std::size_t>(d)] =
        c.node->index[static_cast<std::size_t>(d)] + static_cast<int>(std::floor(offset));
    fraction[d] = offset - std::floor(offset);
  }
  std::size_t count = 0;
  for (int corner = 0; corner < 1 << Dim; ++corner) {
    Index<Dim> n = low;
    double w = 1.0, along = 0.0;
    for (int d = 0; d < Dim; ++d) {
      const auto k = static_cast<std::size_t>(d);
      const int up = corner >> d & 1;
      n[k] += up;
      w *= up != 0 ? fraction[d] : 1.0 - fraction[d];
      along += (n[k] - c.node->index[k]) * spacing[d] * normal[d];
    }
    const std::int64_t at = w > 0 ? field.map.node(n) : -1;
    if (at < 0 || !(field.nodes[static_cast<std::size_t>(at)].mass > 0)) continue;
    distances[count++] = along;
    c.terms[c.term_count++] = {of.field, 0, at, w};
  }
  return count > 0;
}

// Lists the nodal velocities of all terms.
template <int Dim>
void FaceSolver<Dim>::number_velocities() {
  dof_of_.resize(system_.fields.size());
  for (const NodalVelocity& p : dofs_)
    if (static_cast<std::size_t>(p.node) < dof_of_[p.field].size())
      dof_of_[p.field][static_cast<std::size_t>(p.node)] = -1;
  for (std::size_t f = 0; f < dof_of_.size(); ++f) dof_of_[f].resize(system_.fields[f].nodes.size(), -1);
  dofs_.clear();
  for (Constraint& c : constraints_)
    for (std::size_t t = 0; t < c.term_count; ++t) {
      Term& term = c.terms[t];
      std::int32_t& number = dof_of_[term.field][static_cast<std::size_t>(term.node)];
      if (number < 0) {
        number = static_cast<std::int32_t>(dofs_.size());
        const double mass = system_.fields[term.field].nodes[static_cast<std::size_t>(term.node)].mass;
        NodalVelocity& added = dofs_.emplace_back();
        added.field = term.field, added.node = term.node, added.inverse_mass = 1.0 / mass;
      }
      term.dof = static_cast<std::uint32_t>(number);
      NodalVelocity& p = dofs_[term.dof];
      p.mean_mass = std::max(p.mean_mass, c.mean_mass[term.weight < 0 ? 0 : 1]);
    }
  each_velocity(
      [](NodalVelocity& p) { p.start_share = std::min(1.0, 1 / (p.inverse_mass * light_at_start * p.mean_mass)); });
}

template <int Dim>
void FaceSolver<Dim>::find_masses(Constraint& c) const {
  double effective = 0.0, lumped = 0.0;  // inverse masses
  for (std::size_t t = 0; t < c.term_count; ++t) {
    const double inverse_mass = dofs_[c.terms[t].dof].inverse_mass;
    lumped += std::abs(c.terms[t].weight) * inverse_mass;
    for (std::size_t u = 0; u < c.term_count; ++u)  // a node may be among the nodes of its own image
      if (c.terms[u].dof == c.terms[t].dof) effective += c.terms[t].weight * c.terms[u].weight * inverse_mass;
  }
  c.effective_mass = 1.0 / effective, c.lumped_mass = 1.0 / lumped;
}

template <int Dim>
template <class Value>
Vec3 FaceSolver<Dim>::weighted_sum(const Constraint& c, Value&& value) const {
  Vec3 out = Vec3::Zero();
  for (std::size_t t = 0; t < c.term_count; ++t) out += c.terms[t].weight * value(dofs_[c.terms[t].dof]);
  return out;
}

// Calls f(group) for all groups, colour by colour; those of a colour in parallel. `backward`: in reverse order.
template <int Dim>
template <class F>
void FaceSolver<Dim>::each_group(bool backward, F&& f) {
  const bool in_parallel = static_cast<std::ptrdiff_t>(constraints_.size()) >= serial_below;
  for (std::size_t k = 0; k < colour_ends_.size(); ++k) {
    const std::size_t colour = backward ? colour_ends_.size() - 1 - k : k;
    const std::size_t first = colour == 0 ? 0 : colour_ends_[colour - 1];
    const auto count = static_cast<std::ptrdiff_t>(colour_ends_[colour] - first);
    parallel_for(
        count, [&](std::ptrdiff_t g) { f(groups_[first + static_cast<std::size_t>(g)]); }, in_parallel ? 2 : count + 1);
  }
}

// Calls f(constraint) for all constraints in parallel.
template <int Dim>
template <class F>
void FaceSolver<Dim>::each_constraint(F&& f) {
  parallel_for(
      static_cast<std::ptrdiff_t>(constraints_.size()),
      [&](std::ptrdiff_t k) { f(constraints_[static_cast<std::size_t>(k)]); }, serial_below);
}

// Calls f(nodal velocity) for all of them in parallel.
template <int Dim>
template <class F>
void FaceSolver<Dim>::each_velocity(F&& f) {
  parallel_for(
      static_cast<std::ptrdiff_t>(dofs_.size()), [&](std::ptrdiff_t k) { f(dofs_[static_cast<std::size_t>(k)]); },
      serial_below);
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
  for (std::size_t t = 0; t < c.term_count; ++t) {
    NodalVelocity& p = dofs_[c.terms[t].dof];
    p.change -= c.terms[t].weight * p.inverse_mass * impulse;
  }
}

// Applies an impulse at the start of the step. Light nodes take a share of it, see NodalVelocity::start_share, and so
// do the others of the side whose nodes are heavier, so that both sides receive equally much: momentum is conserved.
template <int Dim>
void FaceSolver<Dim>::distribute_at_start(const Constraint& c, const Vec3& impulse) {
  std::array<double, 2> taken{};  // by each side
  std::array<bool, 2> moves{};    // false: a rigid body
  const auto side_of = [](const Term& t) -> std::size_t { return t.weight < 0 ? 0 : 1; };
  for (std::size_t t = 0; t < c.term_count; ++t) {
    const Term& term = c.terms[t];
    moves[side_of(term)] = true;
    taken[side_of(term)] += std::abs(term.weight) * dofs_[term.dof].start_share;
  }
  const double both = moves[0] && moves[1] ? std::min(taken[0], taken[1]) : std::max(taken[0], taken[1]);
  for (std::size_t t = 0; t < c.term_count; ++t) {
    const Term& term = c.terms[t];
    NodalVelocity& p = dofs_[term.dof];
    p.change -= term.weight * p.inverse_mass * p.start_share * (both / taken[side_of(term)]) * impulse;
  }
}

template <int Dim>
bool FaceSolver<Dim>::is_inactive(const Constraint& c) {
  return c.pair->has_no_face || c.pair->replaced_by_joint;
}

// Projected Jacobi sweeps, then projected Gauss-Seidel sweeps, forward and backward in turn.
template <int Dim>
void FaceSolver<Dim>::solve(ContactPass pass) {
  const auto each_active = [&](Group& group, bool backward, auto&& f) {
    for (std::size_t k = group.first; k < group.end; ++k) {
      Constraint& c = constraints_[backward ? group.end - 1 - (k - group.first) : k];
      if (!is_inactive(c)) f(c);
    }
  };
  for (int sweep = 0; sweep < jacobi_sweeps; ++sweep) {
    each_group(false, [&](Group& group) {
      each_active(group, false, [&](Constraint& c) { update_impulse(c, c.lumped_mass, pass); });
    });
    each_group(false, [&](Group& group) {
      each_active(group, false, [&](Constraint& c) { distribute(c, c.impulse_change); });
    });
  }
  const bool from_rest = std::all_of(constraints_.begin(), constraints_.end(),
                                     [](const Constraint& c) { return c.pair->update_impulse.isZero(0); });
  for (int sweep = 0; sweep < (from_rest ? max_sweeps_from_rest : max_sweeps); ++sweep) {
    const bool backward = sweep % 2 != 0;
    each_group(backward, [&](Group& group) {
      group.change = group.size = 0.0;
      each_active(group, backward, [&](Constraint& c) {
        update_impulse(c, c.effective_mass, pass);
        distribute(c, c.impulse_change);
        group.change += c.impulse_change.squaredNorm(),
            group.size += std::max(c.pair->impulse.squaredNorm(), c.pair->update_impulse.squaredNorm());
      });
    });
    double change = 0.0, size = 0.0;
    for (const Group& group : groups_) change += group.change, size += group.size;
    if (change <= tolerance * tolerance * size) break;
  }
  each_constraint([&](Constraint& c) {
    c.pair->final_velocity = c.trial_velocity + weighted_sum(c, [](const NodalVelocity& p) { return p.change; });
  });
}

template <int Dim>
void FaceSolver<Dim>::apply(double dt, ContactPass pass) {
  const auto node = [&](const NodalVelocity& p) -> Node& {
    return system_.fields[p.field].nodes[static_cast<std::size_t>(p.node)];
  };
  each_velocity([&](NodalVelocity& p) { p.change.setZero(); });
  each_constraint([&](Constraint& c) {
    ContactPair& pair = *c.pair;
    c.trial_velocity = pair.rigid_velocity + weighted_sum(c, [&](const NodalVelocity& p) {
                         return Vec3(Eigen::Map<const Vec3>(node(p).velocity));
                       });
    pair.state.dt = dt;
    pair.state.start = c.trial_velocity;
    if (pass == ContactPass::corrector)
      pair.state.start -= dt * weighted_sum(c, [&](const NodalVelocity& p) {
                            return Vec3(Eigen::Map<const Vec3>(node(p).acceleration));
                          });
    pair.response = {};
    pair.impulse.setZero();
    if (pass == ContactPass::corrector && !is_inactive(c)) pair.impulse = pair.update_impulse;
  });
  each_group(false, [&](Group& group) {
    for (std::size_t k = group.first; k < group.end; ++k) distribute(constraints_[k], constraints_[k].pair->impulse);
  });
  solve(pass);
  if (pass == ContactPass::corrector) each_constraint([](Constraint& c) { c.pair->applied = c.pair->impulse; });
  if (pass == ContactPass::predictor) {
    each_velocity([](NodalVelocity& p) { p.change.setZero(); });
    each_group(false, [&](Group& group) {
      for (std::size_t k = group.first; k < group.end; ++k)
        distribute_at_start(constraints_[k], constraints_[k].pair->impulse);
    });
  }
  each_velocity([&](NodalVelocity& p) {
    Eigen::Map<Vec3>(node(p).velocity) += p.change;
    if (pass == ContactPass::corrector) Eigen::Map<Vec3>(node(p).acceleration) += p.change / dt;
  });
}

template <int Dim>
void FaceSolver<Dim>::remove() {
  each_velocity([&](const NodalVelocity& p) {
    Eigen::Map<Vec3>(system_.fields[p.field].nodes[static_cast<std::size_t>(p.node)].velocity) -= p.change;
  });
}

template <int Dim>
void FaceSolver<Dim>::constrain_increments(ContactPass pass) {
  const auto increment = [&](const NodalVelocity& p) {
    return Eigen::Map<Vec3>(system_.fields[p.field].filter[static_cast<std::size_t>(p.node)].increment);
  };
  each_constraint([&](Constraint& c) {
    c.trial_velocity += weighted_sum(c, [&](const NodalVelocity& p) { return Vec3(increment(p)); });
  });
  each_velocity([&](NodalVelocity& p) { increment(p) -= p.change; });
  solve(pass);
  each_velocity([&](NodalVelocity& p) { increment(p) += p.change; });
}

template class FaceSolver<2>;
template class FaceSolver<3>;

}  // namespace tribo
