// SPDX-License-Identifier: MIT
/// Walls normal to an axis that move through the grid.
#pragma once

#include "solver/exchange/exchange.hpp"

#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

namespace tribo {

/// The moving walls of the model, for the nodes of one velocity field. Copies, for other fields, share the places where
/// the walls start. A wall governs a line of nodes for each node
/// where it starts: those within its depth on the side of the material, and up to three with mass beyond it. With a
/// prescribed gradient the strain of particles next to the wall does not depend on where it lies between two nodes.
template <int Dim>
class MovingWalls {
 public:
  /// Force of a wall on a node.
  struct Force {
    std::size_t condition = 0;  ///< index into Model::node_conditions
    double mass = 0.0;          ///< of the node, as far as it belongs to this field
    double acceleration = 0.0;  ///< that the wall adds, along the normal       [acceleration]
    double speed = 0.0;         ///< along the normal in the middle of the step [velocity]
  };

  /// Reports to `problems` walls that start at no node or in more than one plane of nodes.
  MovingWalls(const Model& model, const Lattice<Dim>& lattice, Problems& problems);

  /// To be called after every change of the map.
  void locate(const BlockMap<Dim>& map);
  /// Finds the nodes that the walls govern at `time`. Throws SimulationError if a wall has left the grid.
  void find(const NodeLayer& nodes, double time);
  /// Whether a wall governs the velocity of a node along a direction; no other condition then acts on it.
  bool governs(std::int64_t node, const Vec<Dim>& direction) const {
    if (lines_.empty() || axes_[static_cast<std::size_t>(node)] == 0) return false;
    for (int d = 0; d < Dim; ++d)
      if ((axes_[static_cast<std::size_t>(node)] >> d & 1) != 0 && std::abs(direction[d]) > 1 - 1e-12) return true;
    return false;
  }
  /// Sets the velocities prescribed at `time` on these nodes, before a strain update.
  void impose(NodeLayer& nodes, double time, double dt);
  /// Sets the velocities prescribed at `time` on these nodes, after the momentum update over dt; the acceleration is
  /// the whole change of velocity in this step. `after_impose`: impose() was called before. Calls book(const Force&)
  /// for each node.
  template <class Book>
  void impose_update(NodeLayer& nodes, const Exchange<Dim>& exchange, double time, double dt, bool after_impose,
                     Book&& book) {
    prescribe(nodes, time, dt);
    for (const Governed& g : governed_) {
      Node& node = nodes[static_cast<std::size_t>(g.node)];
      const auto axis = lines_[g.line].axis;
      double &v = node.velocity[axis], &a = node.acceleration[axis];
      const double correction = (g.wanted - v + (after_impose ? g.pending : 0.0)) / dt;
      v = g.wanted, a += correction;
      if (!map_->is_own(static_cast<std::size_t>(g.node / block_nodes<Dim>))) continue;
      book(Force{lines_[g.line].condition, exchange.ownership(g.node) * node.mass, correction, v - 0.5 * dt * a});
    }
  }
  /// Removes the prescribed components from the increments of a velocity filter.
  void release(AlignedVector<FilterNode>& nodes) const;

 private:
  // The node where a line of nodes normal to a wall starts.
  struct Start {
    Index<Dim> start;
    std::size_t condition, axis;
  };
  // All lines of the walls.
  struct Starts {
    std::vector<Start> list;
    std::vector<std::size_t> first_of_walls;
    // Per axis: by the column of blocks along it that contains the line, in ascending order, its number.
    std::array<std::vector<std::pair<std::int64_t, std::size_t>>, Dim> by_column;
  };
  // A line that meets blocks of the field, or the first one of a wall.
  struct Line : Start {
    double at = 0.0;  // present place of the wall [length]
    int first = 0;    // first governed node, counted from the start towards the far side
  };
  struct Governed {
    std::int64_t node;
    std::size_t line;
    double distance;  // from the wall, along the axis [length]
    double wanted = 0.0;
    double pending = 0.0;  // change of the velocity component in impose()
  };

  std::int64_t column(Index<Dim> block, std::size_t axis) const {
    block[axis] = 0;
    return lattice_.block_index(block);
  }
  void prescribe(const NodeLayer& nodes, double time, double dt);
  double place(const Line& line, double time) const;
  double gradient(const Line& line, const NodeLayer& nodes, double speed, double time) const;

  const Model& model_;
  Lattice<Dim> lattice_;
  const BlockMap<Dim>* map_ = nullptr;
  std::shared_ptr<const Starts> starts_;
  std::vector<Line> lines_;
  std::vector<Governed> governed_, before_;
  std::vector<std::uint8_t> axes_;  // per node: bit k is set if a wall governs its velocity along axis k
};

}  // namespace tribo
