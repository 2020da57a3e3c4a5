#include "solver/conditions.hpp"

#include "base/simd.hpp"
#include "grid/select.hpp"

#include <algorithm>
#include <map>

namespace tribo {
template <int Dim>
Conditions<Dim>::Conditions(const Model& model, const Lattice<Dim>& lattice)
    : model_(model), lattice_(lattice), reactions_(model.node_conditions.size(), Vec3::Zero()) {
  Problems problems;
  for (int axis = 0; axis < Dim; ++axis) {
    const auto k = static_cast<std::size_t>(axis);
    for (std::size_t side = 0; side < 2; ++side)
      for (const Edge kind : {Edge::symmetry, Edge::wall}) {
        const auto& at = (kind == Edge::symmetry ? model.grid.symmetry : model.grid.wall)[k][side];
        if (!at) continue;
        const int node = lattice.line(axis, *at);
        if (node < 0)
          problems.add(model.grid.origin,
                       "the plane at " + std::to_string(*at) + " is not on a grid line; put it on one");
        else
          planes_.push_back({axis, node, side == 0 ? 1 : -1, kind});
      }
    if (model.grid.periodic[k]) planes_.push_back({axis, Lattice<Dim>::padding, model.grid.cells[k], Edge::period});
  }

  plane_reactions_.assign(planes_.size(), 0.0);
  // Of the user's grid and one layer around it; farther out is nothing
  const auto near_grid = [&](const Index<Dim>& node) {
    for (std::size_t d = 0; d < Dim; ++d)
      if (const int n = node[d] - Lattice<Dim>::padding; n < -1 || n > model.grid.cells[d] + 1) return false;
    return true;
  };
  // Conditions on the same node in the same direction add.
  std::map<std::pair<std::int64_t, std::array<double, 3>>, std::size_t> known;
  for (std::size_t c = 0; c < model.node_conditions.size(); ++c) {
    const auto& condition = model.node_conditions[c];
    bool any = false;
    each_node_in<Dim>(lattice, *condition.where, [&](const Index<Dim>& node) {
      any = any || near_grid(node);
      std::int64_t flat = 0;
      for (std::size_t d = Dim; d-- > 0;) flat = flat * lattice.blocks[d] * block_edge<Dim> + node[d];
      const auto& n = condition.direction;
      const auto [entry, fresh] = known.try_emplace({flat, {n[0], n[1], n[2]}}, chosen_.size());
      if (fresh) chosen_.push_back({node, n.template head<Dim>(), {}});
      chosen_[entry->second].conditions.push_back(c);
    });
    if (!any) problems.add(condition.origin, "this condition selects no node of the grid");
  }
  problems.raise();
}

template <int Dim>
void Conditions<Dim>::locate(const BlockMap<Dim>& map) {
  located_.clear();
  for (std::size_t c = 0; c < chosen_.size(); ++c) {
    const auto node = map.node(chosen_[c].node);
    if (node >= 0) located_.push_back({node, c});
  }
  ghosts_.assign(planes_.size(), {});
  for (auto& list : mirror_nodes_) list.clear();
  const bool symmetry =
      std::any_of(planes_.begin(), planes_.end(), [](const Plane& p) { return p.kind == Edge::symmetry; });
  share_.assign(symmetry ? static_cast<std::size_t>(map.node_count()) : 0, 1.0);
  for (std::size_t p = 0; p < planes_.size(); ++p) {
    const Plane& plane = planes_[p];
    const auto axis = static_cast<std::size_t>(plane.axis);
    for (std::int64_t at = 0; at < map.node_count(); ++at) {
      const auto node = map.node_at(at);
      if (plane.kind == Edge::symmetry && node[axis] == plane.node)
        mirror_nodes_[axis].push_back({at, p}), share_[static_cast<std::size_t>(at)] *= 0.5;
      const auto ghost = ghost_of(plane, at, node, map);
      if (ghost && ghost->plane >= 0 && ghost->inside >= 0) ghosts_[p].push_back(*ghost);
    }
  }
}

// Particles reach two nodes beyond a plane, and as they may cross a periodic edge between two sorts, three there.
template <int Dim>
auto Conditions<Dim>::ghost_of(const Plane& plane, std::int64_t at, Index<Dim> node, const BlockMap<Dim>& map) const
    -> std::optional<Ghost> {
  int& n = node[static_cast<std::size_t>(plane.axis)];
  Ghost ghost{at, -1, -1, 0};
  if (plane.kind == Edge::period) {
    const int period = plane.inward, from_low = n - plane.node;
    if (from_low < -3 || (from_low >= 0 && from_low < period) || from_low > period + 3) return std::nullopt;
    n = plane.node + (from_low % period + period) % period;
    ghost.plane = ghost.inside = map.node(node);
    return ghost;
  }
  ghost.depth = (plane.node - n) * plane.inward;
  if (ghost.depth < 1 || ghost.depth > 2) return std::nullopt;
  n = plane.node;
  ghost.plane = map.node(node);
  n += plane.inward * (plane.kind == Edge::symmetry ? ghost.depth : 1);
  ghost.inside = map.node(node);
  return ghost;
}

template <int Dim>
void Conditions<Dim>::fold(NodeLayer& nodes, Fold what) const {
  // Velocities that are already divided by the mass stay; only the forces scattered since are brought back.
  const auto part = [&](const Node& node) {
    const Wide all = Wide::load(node.data());
    return what != Fold::forces ? all : Wide::join(Vec4{}, all.high());
  };
  const auto add = [](Node& to, const Wide& w) { (Wide::load(to.data()) + w).store(to.data()); };
  for (std::size_t p = 0; p < planes_.size(); ++p) {
    const Plane& plane = planes_[p];
    if (what == Fold::cells && plane.kind != Edge::period) continue;
    for (const Ghost& g : ghosts_[p]) {
      Node& ghost = nodes[static_cast<std::size_t>(g.ghost)];
      Node& inside = nodes[static_cast<std::size_t>(g.inside)];
      Node beyond{};
      part(ghost).store(beyond.data());
      if (plane.kind != Edge::wall) {
        if (plane.kind == Edge::symmetry && what != Fold::scalars) {
          beyond.velocity[plane.axis] = -beyond.velocity[plane.axis];
          beyond.acceleration[plane.axis] = -beyond.acceleration[plane.axis];
        }
        add(inside, part(beyond));
      } else {
        add(nodes[static_cast<std::size_t>(g.plane)], (g.depth + 1.0) * part(beyond));
        add(inside, -static_cast<double>(g.depth) * part(beyond));
      }
      if (what != Fold::forces)
        Wide::zero().store(ghost.data());
      else
        store4(ghost.data() + 4, Vec4{});
    }
    // Nodes on planes are their own mirror images, after all ghosts of their axis have come home.
    if (p + 1 < planes_.size() && planes_[p + 1].axis == plane.axis) continue;
    for (const OnPlane& on : mirror_nodes_[plane.axis]) {
      Node& node = nodes[static_cast<std::size_t>(on.node)];
      add(node, part(node));
      if (what != Fold::scalars) node.velocity[plane.axis] = node.acceleration[plane.axis] = 0.0;
    }
  }
}

template <int Dim>
void Conditions<Dim>::count_plane_forces(const NodeLayer& nodes) {
  // Inside, a node gets the difference of its own force and the ghost's; a node on the plane keeps nothing.
  for (std::size_t p = 0; p < planes_.size(); ++p)
    if (planes_[p].kind == Edge::symmetry)
      for (const Ghost& g : ghosts_[p])
        plane_reactions_[p] -= 2 * nodes[static_cast<std::size_t>(g.ghost)].acceleration[planes_[p].axis];
  for (int axis = 0; axis < Dim; ++axis)
    for (const OnPlane& on : mirror_nodes_[axis])
      plane_reactions_[on.plane] -= nodes[static_cast<std::size_t>(on.node)].acceleration[axis];
}

template <int Dim>
double Conditions<Dim>::plane_reaction(int axis, int side) const {
  for (std::size_t p = 0; p < planes_.size(); ++p)
    if (planes_[p].kind == Edge::symmetry && planes_[p].axis == axis && planes_[p].inward == 1 - 2 * side)
      return plane_reactions_[p];
  return 0.0;
}

template <int Dim>
void Conditions<Dim>::stay_on_planes(NodeLayer& nodes) {
  for (int axis = 0; axis < Dim; ++axis)
    for (const OnPlane& on : mirror_nodes_[axis]) {
      Node& node = nodes[static_cast<std::size_t>(on.node)];
      plane_reactions_[on.plane] -= share(on.node) * node.mass * node.acceleration[axis];
      node.velocity[axis] = node.acceleration[axis] = 0.0;
    }
}

template <int Dim>
bool Conditions<Dim>::folds(const Index<Dim>& node) const {
  return std::any_of(planes_.begin(), planes_.end(), [&](const Plane& plane) {
    const int beyond = plane.node - node[static_cast<std::size_t>(plane.axis)];
    return plane.kind == Edge::period ? beyond > 0 || -beyond >= plane.inward : beyond * plane.inward > 0;
  });
}

template <int Dim>
int Conditions<Dim>::mirrored(const Index<Dim>& node) const {
  int axes = 0;
  for (const Plane& plane : planes_)
    if (plane.kind == Edge::symmetry && node[static_cast<std::size_t>(plane.axis)] == plane.node)
      axes |= 1 << plane.axis;
  return axes;
}

template <int Dim>
void Conditions<Dim>::extend(NodeLayer& nodes, Fold what) const {
  for (std::size_t p = planes_.size(); p-- > 0;) {
    const Plane& plane = planes_[p];
    if (what == Fold::cells && plane.kind != Edge::period) continue;
    for (const Ghost& g : ghosts_[p]) {
      Node& ghost = nodes[static_cast<std::size_t>(g.ghost)];
      const Node& inside = nodes[static_cast<std::size_t>(g.inside)];
      const double mass = ghost.mass;
      if (plane.kind != Edge::wall) {
        Wide::load(inside.data()).store(ghost.data());
        if (plane.kind == Edge::symmetry && what != Fold::scalars) {
          ghost.velocity[plane.axis] = -ghost.velocity[plane.axis];
          ghost.acceleration[plane.axis] = -ghost.acceleration[plane.axis];
        }
      } else {
        const Node& on = nodes[static_cast<std::size_t>(g.plane)];
        ((g.depth + 1.0) * Wide::load(on.data()) + -static_cast<double>(g.depth) * Wide::load(inside.data()))
            .store(ghost.data());
      }
      ghost.mass = mass;
    }
  }
}

template <int Dim>
double Conditions<Dim>::prescribed(const Chosen& chosen, const Vec<Dim>& x, double time, double dt) const {
  Vec3 at = Vec3::Zero();
  at.head<Dim>() = x;
  double sum = 0.0;
  for (const auto c : chosen.conditions) sum += model_.node_conditions[c].velocity.at(time, at, dt);
  return sum;
}

template <int Dim>
void Conditions<Dim>::impose(NodeLayer& nodes, double time, double dt) {
  for (Located& l : located_) {
    const Chosen& chosen = chosen_[l.chosen];
    Node& node = nodes[static_cast<std::size_t>(l.node)];
    l.pending = 0.0;
    if (!(node.mass > 0)) continue;
    Eigen::Map<Vec<Dim>> v(node.velocity);
    const double change = prescribed(chosen, lattice_.position(chosen.node), time, dt) - v.dot(chosen.direction);
    v += change * chosen.direction;
    l.pending = change;
  }
}

template <int Dim>
void Conditions<Dim>::impose_update(NodeLayer& nodes, double time, double dt, bool after_impose, bool first) {
  for (auto& r : reactions_) r.setZero();
  for (Located& l : located_) {
    const Chosen& chosen = chosen_[l.chosen];
    Node& node = nodes[static_cast<std::size_t>(l.node)];
    if (!(node.mass > 0)) continue;
    Eigen::Map<Vec<Dim>> v(node.velocity), a(node.acceleration);
    const Vec<Dim> x = lattice_.position(chosen.node);
    const double wanted = prescribed(chosen, x, time + dt, dt), before = prescribed(chosen, x, time, dt);
    const double now = v.dot(chosen.direction), free = a.dot(chosen.direction);
    const double start = !first ? before : after_impose ? before - l.pending : now - dt * free;
    const double correction = (wanted - start) / dt - free;
    v += (wanted - now) * chosen.direction;
    a += correction * chosen.direction;

    Vec3 force = Vec3::Zero();
    const double mass = share(l.node) * node.mass;
    force.head<Dim>() = mass * correction * chosen.direction;
    for (const auto c : chosen.conditions) reactions_[c] += force / static_cast<double>(chosen.conditions.size());
    work_ += dt * mass * correction * (wanted - 0.5 * dt * a.dot(chosen.direction));  // force times mid-step velocity
    impulse_ += dt * force;
  }
}

template <int Dim>
void Conditions<Dim>::release(NodeLayer& nodes) const {
  for (const Located& l : located_) {
    const auto& direction = chosen_[l.chosen].direction;
    Eigen::Map<Vec<Dim>> v(nodes[static_cast<std::size_t>(l.node)].velocity);
    v -= v.dot(direction) * direction;
  }
}

template class Conditions<2>;
template class Conditions<3>;

}  // namespace tribo
