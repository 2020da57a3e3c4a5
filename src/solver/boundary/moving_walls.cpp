// SPDX-License-Identifier: MIT
#include "solver/boundary/moving_walls.hpp"

#include "base/text.hpp"
#include "grid/select.hpp"

#include <algorithm>
#include <cmath>
#include <set>

namespace tribo {
namespace {

constexpr int beyond = 3;  // nodes with mass that a wall governs on its far side

// The variables of a function of a wall: the time, and the node where it starts.
Variables variables(const MovingWall& wall, const Vec3& start, double time) {
  return Variables::at(start, time / wall.function_time);
}

}  // namespace

template <int Dim>
MovingWalls<Dim>::MovingWalls(const Model& model, const Lattice<Dim>& lattice, Problems& problems)
    : model_(model), lattice_(lattice) {
  const auto starts = std::make_shared<Starts>();
  for (std::size_t c = 0; c < model.node_conditions.size(); ++c) {
    const NodeCondition& condition = model.node_conditions[c];
    if (!condition.wall) continue;
    Eigen::Index axis = 0;
    condition.direction.cwiseAbs().maxCoeff(&axis);
    const auto d = static_cast<std::size_t>(axis);
    std::set<int> planes;
    each_node_in<Dim>(lattice, *condition.where, [&](const Index<Dim>& node) {
      planes.insert(node[d]);
      if (starts->list.empty() || starts->list.back().condition != c)
        starts->first_of_walls.push_back(starts->list.size());
      Index<Dim> block;
      for (std::size_t k = 0; k < Dim; ++k) block[k] = node[k] / block_edge<Dim>;
      starts->by_column[d].emplace_back(column(block, d), starts->list.size());
      starts->list.push_back({node, c, d});
    });
    if (planes.empty()) problems.add(condition.origin, "this moving wall starts at no node of the grid");
    if (planes.size() > 1)
      problems.add(condition.origin, "this moving wall starts in " + std::to_string(planes.size()) +
                                         " planes of nodes; its shape must hold one of them only");
  }
  for (auto& lines : starts->by_column) std::sort(lines.begin(), lines.end());
  starts_ = starts;
}

// Lines that meet no block of the field govern no node. The first line of each wall tells whether it leaves the grid.
template <int Dim>
void MovingWalls<Dim>::locate(const BlockMap<Dim>& map) {
  map_ = &map;
  governed_.clear(), lines_.clear();
  std::vector<std::size_t> numbers = starts_->first_of_walls;
  for (std::size_t axis = 0; axis < Dim; ++axis) {
    const auto& lines = starts_->by_column[axis];
    if (lines.empty()) continue;
    std::set<std::int64_t> columns;
    for (const std::int64_t block : map.active()) columns.insert(column(lattice_.block_at(block), axis));
    for (const std::int64_t at : columns)
      for (auto line = std::lower_bound(lines.begin(), lines.end(), std::pair(at, std::size_t{0}));
           line != lines.end() && line->first == at; ++line)
        numbers.push_back(line->second);
  }
  std::ranges::sort(numbers);
  numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
  for (const std::size_t number : numbers) lines_.push_back({starts_->list[number]});
  axes_.assign(lines_.empty() ? 0 : static_cast<std::size_t>(map.node_count()), 0);
}

// The coordinate of a wall along its normal.
template <int Dim>
double MovingWalls<Dim>::place(const Line& line, double time) const {
  const NodeCondition& condition = model_.node_conditions[line.condition];
  const MovingWall& wall = *condition.wall;
  Vec3 start = Vec3::Zero();
  start.head<Dim>() = lattice_.position(line.start);
  const auto axis = static_cast<Eigen::Index>(line.axis);
  const double at = start[axis] + wall.length_unit * wall.displacement(variables(wall, start, time));
  const double tolerance = 1e-9 * lattice_.spacing[axis];
  if (at < lattice_.low[axis] - tolerance || at > lattice_.high[axis] + tolerance)
    throw SimulationError(condition.origin.text() + ": the moving wall has left the grid" + format(" at %.6g", at) +
                          format(" at time %.6g", time));
  return at;
}

// The velocity gradient at a wall. Where it mirrors, the line through the velocity of the wall that fits the velocities
// of the last two free nodes, those before the first governed one; 0 if one of them has no mass.
template <int Dim>
double MovingWalls<Dim>::gradient(const Line& line, const NodeLayer& nodes, double speed, double time) const {
  const MovingWall& wall = *model_.node_conditions[line.condition].wall;
  const auto axis = static_cast<Eigen::Index>(line.axis);
  if (!wall.mirror) {
    Vec3 x = Vec3::Zero();
    x.head<Dim>() = lattice_.position(line.start);
    x[axis] = line.at;
    return wall.gradient_unit * wall.gradient(variables(wall, x, time));
  }
  double product = 0.0, square = 0.0;
  for (int k = line.first - 2; k < line.first; ++k) {
    Index<Dim> index = line.start;
    index[line.axis] += k * wall.side;
    const auto node = map_->node(index);
    if (node < 0 || !(nodes[static_cast<std::size_t>(node)].mass > 0)) return 0.0;
    const double distance = lattice_.position(index)[axis] - line.at;
    product += distance * (nodes[static_cast<std::size_t>(node)].velocity[line.axis] - speed);
    square += distance * distance;
  }
  return product / square;
}

template <int Dim>
void MovingWalls<Dim>::find(const NodeLayer& nodes, double time) {
  if (lines_.empty()) return;
  for (const Governed& g : governed_) axes_[static_cast<std::size_t>(g.node)] = 0;
  before_.swap(governed_);
  governed_.clear();
  for (std::size_t l = 0; l < lines_.size(); ++l) {
    Line& line = lines_[l];
    const MovingWall& wall = *model_.node_conditions[line.condition].wall;
    const auto axis = static_cast<Eigen::Index>(line.axis);
    line.at = place(line, time);
    // place of the node where the wall starts, in cells beyond the wall
    const double origin = wall.side * (lattice_.position(line.start)[axis] - line.at) / lattice_.spacing[axis];
    line.first = static_cast<int>(std::ceil(-wall.depth - origin - 1e-9));
    int past = 0;
    for (int k = line.first; past < beyond; ++k) {
      Index<Dim> index = line.start;
      index[line.axis] += k * wall.side;
      const bool outside = origin + k > 1e-9;
      const auto node = map_->node(index);
      if (node >= 0 && nodes[static_cast<std::size_t>(node)].mass > 0) {
        governed_.push_back({node, l, lattice_.position(index)[axis] - line.at});
        axes_[static_cast<std::size_t>(node)] |= static_cast<std::uint8_t>(1U << line.axis);
      } else if (outside) {
        break;
      }
      past += outside;
    }
  }
  auto old = before_.begin();  // both lists are in the order of the lines
  for (Governed& g : governed_) {
    while (old != before_.end() && old->line < g.line) ++old;
    for (auto same = old; same != before_.end() && same->line == g.line; ++same)
      if (same->node == g.node) g.pending = same->pending;
  }
}

// The velocities at a time on the nodes that were found.
template <int Dim>
void MovingWalls<Dim>::prescribe(const NodeLayer& nodes, double time, double dt) {
  std::size_t known = lines_.size();
  double speed = 0.0, slope = 0.0;
  for (Governed& g : governed_) {
    if (g.line != known) {  // the nodes of a line are consecutive
      const Line& line = lines_[g.line];
      Vec3 start = Vec3::Zero();
      start.head<Dim>() = lattice_.position(line.start);
      known = g.line;
      speed = model_.node_conditions[line.condition].velocity.at(time, start, dt);
      slope = gradient(line, nodes, speed, time);
    }
    g.wanted = speed + slope * g.distance;
  }
}

template <int Dim>
void MovingWalls<Dim>::impose(NodeLayer& nodes, double time, double dt) {
  prescribe(nodes, time, dt);
  for (Governed& g : governed_) {
    double& v = nodes[static_cast<std::size_t>(g.node)].velocity[lines_[g.line].axis];
    g.pending = g.wanted - v;
    v = g.wanted;
  }
}

template <int Dim>
void MovingWalls<Dim>::release(AlignedVector<FilterNode>& nodes) const {
  for (const Governed& g : governed_) nodes[static_cast<std::size_t>(g.node)].increment[lines_[g.line].axis] = 0.0;
}

template class MovingWalls<2>;
template class MovingWalls<3>;

}  // namespace tribo
