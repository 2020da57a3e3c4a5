// SPDX-License-Identifier: MIT
#include "run/bare_edges.hpp"

#include "base/text.hpp"

#include <algorithm>
#include <cmath>

namespace tribo {
namespace {

constexpr std::array axis_names{"x", "y", "z"};
constexpr std::array grid_elements{"Horiz", "Vert", "Depth"};

class Edge {
 public:
  Edge(const Model& model, std::size_t axis, bool high) : model_(model), grid_(model.grid), axis_(axis), high_(high) {}

  // With the nodes before the edge held as well, bodies stop there and do not reach the edge.
  bool bare() const {
    const std::size_t side = high_ ? 1 : 0;
    return !grid_.periodic[axis_] && !grid_.symmetry[axis_][side] && !grid_.wall[axis_][side] && !closed_axis() &&
           share_held(0) >= 0.5 && share_held(1) < 0.5 && share_held(-1) < 0.5;
  }
  double place() const { return high_ ? grid_.high[axis_] : grid_.low[axis_]; }

 private:
  // The axis of rotation is a plane of symmetry without being declared as one.
  bool closed_axis() const {
    return model_.analysis == Analysis::axisymmetric && axis_ == 0 && !high_ && grid_.low[0] == 0;
  }
  double spacing(std::size_t k) const { return (grid_.high[k] - grid_.low[k]) / grid_.cells[k]; }

  bool held(const Vec3& node) const {
    return std::any_of(model_.node_conditions.begin(), model_.node_conditions.end(), [&](const NodeCondition& c) {
      return !c.wall && std::abs(c.direction[static_cast<Eigen::Index>(axis_)]) > 0.5 && c.where->contains(node) &&
             c.velocity.at(0.0, node, 0.0) == 0 && c.velocity.at(model_.time.end, node, 0.0) == 0;
    });
  }
  // Share of the nodes in a layer beyond (positive) or before the edge, of up to 41 nodes along each other axis, whose
  // normal velocity is prescribed as zero.
  double share_held(int beyond) const {
    constexpr int most = 40;
    Vec3 node = Vec3::Zero();
    node[static_cast<Eigen::Index>(axis_)] = place() + (high_ ? beyond : -beyond) * spacing(axis_);
    const std::size_t a = (axis_ + 1) % 3, b = (axis_ + 2) % 3;
    const auto count = [&](std::size_t k) {
      return k == 2 && model_.analysis != Analysis::solid ? 0 : std::min(most, grid_.cells[k]);
    };
    const auto at = [&](std::size_t k, int i) {
      const int n = count(k), cell = n == 0 ? 0 : static_cast<int>(std::lround(double(i) * grid_.cells[k] / n));
      return n == 0 ? 0.0 : grid_.low[k] + cell * spacing(k);
    };
    int held_nodes = 0, nodes = 0;
    for (int i = 0; i <= count(a); ++i)
      for (int j = 0; j <= count(b); ++j) {
        node[static_cast<Eigen::Index>(a)] = at(a, i), node[static_cast<Eigen::Index>(b)] = at(b, j);
        ++nodes, held_nodes += held(node);
      }
    return double(held_nodes) / nodes;
  }

  const Model& model_;
  const GridSpec& grid_;
  std::size_t axis_;
  bool high_;
};

}  // namespace

std::vector<std::string> bare_edges(const Model& model) {
  std::vector<std::string> out;
  const std::size_t begin = model.source.find_first_not_of(" \t\r\n");
  const bool script = begin != std::string::npos && model.source[begin] != '<';
  if (model.scheme.kernel != Kernel::quadratic_spline && model.scheme.kernel != Kernel::cubic_spline) return out;
  for (std::size_t axis = 0; axis < (model.analysis == Analysis::solid ? 3U : 2U); ++axis)
    for (const bool high : {false, true}) {
      const Edge edge(model, axis, high);
      if (!edge.bare()) continue;
      const std::string at = format("%.6g", edge.place());
      const std::string end = high ? "max" : "min", edge_name = axis_names[axis] + end;
      out.push_back("the velocity along " + std::string(axis_names[axis]) + " is prescribed at the edge of the grid, " +
                    axis_names[axis] + " = " + at +
                    ", but B-splines extend beyond it: bodies stop up to half a cell away from it, or pass it. Make it "
                    "a wall, " +
                    (script ? "'GridEdge " + edge_name + ",wall," + at + "'"
                            : "<" + std::string(grid_elements[axis]) + " ... wall" + end + "='" + at + "'>") +
                    ", or a plane of symmetry, " +
                    (script ? "'GridEdge " + edge_name + ",symmetry," + at + "'" : "sym" + end + "='" + at + "'"));
    }
  return out;
}

}  // namespace tribo
