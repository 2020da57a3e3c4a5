// SPDX-License-Identifier: MIT
#include "solver/contact/face_constraints.hpp"

#include "base/parallel.hpp"

#include <algorithm>
#include <cmath>

namespace tribo {
namespace {

// Pairs whose node lies farther from its image in the face act on the node only [cells]
constexpr int max_image_distance = 4;
// Nodes around an image with less than this fraction of the mean mass of the nodes of a constraint have a smaller
// weight. Of values from 0.001 to 3, those from 0.03 to 0.1 make the stress next to faces most uniform (splines, uGIMP
// and CPDI, at 0 to 45 degrees to the grid).
constexpr double light_node = 0.03;

// A point within this distance of a grid line or plane counts as on it [cells]. The nodes on its other sides, whose
// weights would be at most as large, then have none. Where a face is nearly parallel to the grid, this more than halves
// the number of terms.
constexpr double on_grid_line = 0.01;

template <int Dim>
Eigen::Map<const Vec3> velocity_of(const System<Dim>& system, std::size_t field, std::int64_t node) {
  return Eigen::Map<const Vec3>(system.fields[field].nodes[static_cast<std::size_t>(node)].velocity);
}

template <int Dim>
double mass_of(const System<Dim>& system, std::uint32_t field, std::int64_t node) {
  return system.fields[field].nodes[static_cast<std::size_t>(node)].mass;
}

template <int Dim>
double mass_of(const System<Dim>& system, const FaceTerm& t) {
  return mass_of(system, t.field, t.node);
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

// A coordinate that is moved to the next grid line if it is within `on_grid_line` of one, and towards it by a smaller
// distance otherwise, so that the result is continuous. `cells`: coordinate [cells].
double towards_grid_lines(double cells) {
  const double low = std::floor(cells);
  return low + std::clamp((cells - low - on_grid_line) / (1 - 2 * on_grid_line), 0.0, 1.0);
}

}  // namespace

template <int Dim>
void FaceConstraints<Dim>::find(ContactNodes<Dim>& contacts, const Exchanges<Dim>& exchanges) {
  exchanges_ = &exchanges;
  list_constraints(contacts);
  each_constraint([&](Constraint& c) { find_terms(c, contacts.members); });
  number_velocities();
  each_constraint([&](Constraint& c) { find_masses(c); });
}

template <int Dim>
void FaceConstraints<Dim>::list_constraints(ContactNodes<Dim>& contacts) {
  // Two blocks of the same colour are so far apart that the nodes in reach of their pairs are different ones.
  constexpr int colours = (2 * max_image_distance + block_edge<Dim> - 1) / block_edge<Dim> + 1;
  const auto has_face = [](const ContactPair& pair) {
    return pair.may_touch() && pair.crack < 0 && pair.law->uses_face();
  };
  std::size_t count = 0;
  groups_.clear(), colour_ends_.clear();
  Index<Dim> last_block;
  for (ContactNode<Dim>& node : contacts.nodes) {
    const auto pairs = contacts.pairs_of(node);
    node.solved_on_faces = std::any_of(pairs.begin(), pairs.end(), has_face);
    if (!node.solved_on_faces) continue;
    Index<Dim> block;
    int colour = 0;
    for (std::size_t d = 0; d < Dim; ++d)
      block[d] = node.index[d] / block_edge<Dim>, colour = colour * colours + block[d] % colours;
    if (groups_.empty() || block != last_block) groups_.push_back({count, count, colour});
    last_block = block;
    for (ContactPair& pair : pairs) {
      if (count == constraints_.size()) constraints_.emplace_back();
      constraints_[count++].begin(pair, node, has_face(pair));
    }
    groups_.back().end = count;
  }
  constraints_.resize(count);
  std::stable_sort(groups_.begin(), groups_.end(),
                   [](const FaceGroup& a, const FaceGroup& b) { return a.colour < b.colour; });
  for (std::size_t g = 0; g < groups_.size(); ++g)
    if (g + 1 == groups_.size() || groups_[g + 1].colour != groups_[g].colour) colour_ends_.push_back(g + 1);
}

// The terms of a point: nodes of the cell that contains it.
template <int Dim>
struct FaceConstraints<Dim>::Point {
  std::span<FaceTerm> terms;
  std::array<double, 1 << Dim> distances{};  // of the nodes from the contact node, along the normal
  double mean_mass = 0.0;
  double weight = 0.0;    // sum of those of the terms
  double distance = 0.0;  // mean
};

template <int Dim>
void FaceConstraints<Dim>::find_terms(Constraint& c, std::span<const ContactMember> members) const {
  ContactPair& pair = *c.pair;
  for (const auto& [member, sign] : {std::pair{&members[pair.a], -1.0}, std::pair{&members[pair.b], 1.0}}) {
    const std::size_t first = c.term_count;
    if (c.has_face) add_face_terms(c, *member, sign);
    if (c.term_count == first)
      c.all_terms[c.term_count++] = {static_cast<std::uint32_t>(member->field), 0, member->node, sign,
                                     ComponentSigns(0, c.node->mirrored_axes)};
    if (member->inverse_mass > 0.0) continue;
    pair.rigid_velocity.setZero();
    for (std::size_t t = first; t < c.term_count; ++t)
      pair.rigid_velocity +=
          c.all_terms[t].weight *
          c.all_terms[t].signs.of(Vec3(velocity_of(system_, c.all_terms[t].field, c.all_terms[t].node)));
    c.term_count = first;
  }
}

// Adds the terms of the velocity of a body at the face, if it reaches a node around each of two points at the same
// distance from the face, on either side of it.
template <int Dim>
void FaceConstraints<Dim>::add_face_terms(Constraint& c, const ContactMember& member, double sign) const {
  const ContactPair& pair = *c.pair;
  const std::size_t first = c.term_count;
  const Vec3 across = 2 * pair.face_position * pair.state.normal;
  Point near = add_point(c, member.field, pair.foremost_offset);
  Point image = add_point(c, member.field, pair.foremost_offset + across);
  if ((near.terms.empty() || image.terms.empty()) && !pair.foremost_offset.isZero(0)) {
    c.term_count = first;
    near = add_point(c, member.field, Vec3::Zero()), image = add_point(c, member.field, across);
  }
  if (near.terms.empty() || image.terms.empty()) {
    c.term_count = first;
    return;
  }
  const double mean_mass = 0.5 * (near.mean_mass + image.mean_mass);
  scale_weights(near, mean_mass), scale_weights(image, mean_mass);
  const double share = image_share(pair.face_position - near.distance, image.distance - near.distance);
  for (const auto& [point, part] : {std::pair{&near, 1 - share}, std::pair{&image, share}})
    for (FaceTerm& t : point->terms) t.weight *= sign * part / point->weight;
}

// Replaces a node beyond symmetry planes by its mirror image, and returns the signs of its velocity.
template <int Dim>
ComponentSigns FaceConstraints<Dim>::fold(std::size_t field, Index<Dim>& node) const {
  const Exchange<Dim>& exchange = *(*exchanges_)[field];
  if (!exchange.has_images()) return {};
  const int reflected = exchange.reflect(node);
  return {reflected, exchange.mirrored_axes(node)};
}

// Adds the nodes of the cell that contains the point at `offset` from the contact node, with the weights of linear
// interpolation, so far as the body reaches them.
template <int Dim>
auto FaceConstraints<Dim>::add_point(Constraint& c, std::size_t field, const Vec3& offset) const -> Point {
  const auto& map = system_.fields[field].map;
  const auto& spacing = map.lattice().spacing;
  const std::size_t first = c.term_count;
  Point point;
  Index<Dim> low;
  Vec<Dim> fraction;
  for (int d = 0; d < Dim; ++d) {
    const double cells = towards_grid_lines(offset[d] / spacing[d]);
    if (!(std::abs(cells) < max_image_distance)) return point;
    low[static_cast<std::size_t>(d)] = c.node->index[static_cast<std::size_t>(d)] + static_cast<int>(std::floor(cells));
    fraction[d] = cells - std::floor(cells);
  }
  for (int corner = 0; corner < 1 << Dim; ++corner) {
    double w = 1.0;
    for (int d = 0; d < Dim; ++d) w *= (corner >> d & 1) != 0 ? fraction[d] : 1.0 - fraction[d];
    if (!(w > 0)) continue;
    Index<Dim> n = low;
    double along = 0.0;
    for (int d = 0; d < Dim; ++d) {
      const auto k = static_cast<std::size_t>(d);
      n[k] += corner >> d & 1;
      along += (n[k] - c.node->index[k]) * spacing[d] * c.pair->state.normal[d];
    }
    const ComponentSigns signs = fold(field, n);
    const std::int64_t at = map.node(n);
    if (at < 0) continue;
    const FaceTerm term{static_cast<std::uint32_t>(field), 0, at, w, signs};
    const double mass = mass_of(system_, term);
    if (!(mass > 0)) continue;
    point.distances[c.term_count - first] = along;
    point.mean_mass += w * mass, point.weight += w;
    c.all_terms[c.term_count++] = term;
  }
  point.terms = {&c.all_terms[first], c.term_count - first};
  if (point.weight > 0) point.mean_mass /= point.weight;
  return point;
}

// Reduces the weights of light nodes.
template <int Dim>
void FaceConstraints<Dim>::scale_weights(Point& point, double mean_mass) const {
  point.weight = point.distance = 0.0;
  for (std::size_t k = 0; k < point.terms.size(); ++k) {
    FaceTerm& t = point.terms[k];
    t.weight *= reduction(mass_of(system_, t) / (light_node * mean_mass));
    point.weight += t.weight, point.distance += t.weight * point.distances[k];
  }
  point.distance /= point.weight;
}

// Lists the nodal velocities of all terms.
template <int Dim>
void FaceConstraints<Dim>::number_velocities() {
  number_of_.resize(system_.fields.size());
  for (const FaceVelocity& p : velocities_)
    if (static_cast<std::size_t>(p.node) < number_of_[p.field].size())
      number_of_[p.field][static_cast<std::size_t>(p.node)] = -1;
  for (std::size_t f = 0; f < number_of_.size(); ++f) number_of_[f].resize(system_.fields[f].nodes.size(), -1);
  velocities_.clear();
  for (Constraint& c : constraints_)
    for (std::size_t t = 0; t < c.term_count; ++t) {
      FaceTerm& term = c.all_terms[t];
      std::int32_t& number = number_of_[term.field][static_cast<std::size_t>(term.node)];
      if (number < 0) {
        number = static_cast<std::int32_t>(velocities_.size());
        FaceVelocity& added = velocities_.emplace_back();
        added.field = term.field, added.node = term.node;
        added.inverse_mass = 1.0 / ((*exchanges_)[term.field]->ownership(term.node) * mass_of(system_, term));
      }
      term.velocity = static_cast<std::uint32_t>(number);
    }
}

template <int Dim>
void FaceConstraints<Dim>::find_masses(Constraint& c) const {
  double effective = 0.0, lumped = 0.0;  // inverse masses
  for (std::size_t t = 0; t < c.term_count; ++t) {
    const double inverse_mass = c.node->ownership * velocities_[c.all_terms[t].velocity].inverse_mass;
    lumped += std::abs(c.all_terms[t].weight) * inverse_mass;
    for (std::size_t u = 0; u < c.term_count; ++u)  // a node may be among the nodes of its own image
      if (c.all_terms[u].velocity == c.all_terms[t].velocity)
        effective += c.all_terms[t].weight * c.all_terms[u].weight * inverse_mass;
  }
  c.effective_mass = 1.0 / effective, c.lumped_mass = 1.0 / lumped;
}

// Calls f(constraint) for all constraints in parallel.
template <int Dim>
template <class F>
void FaceConstraints<Dim>::each_constraint(F&& f) {
  parallel_for(
      static_cast<std::ptrdiff_t>(constraints_.size()),
      [&](std::ptrdiff_t k) { f(constraints_[static_cast<std::size_t>(k)]); }, serial_below);
}

template class FaceConstraints<2>;
template class FaceConstraints<3>;

}  // namespace tribo
