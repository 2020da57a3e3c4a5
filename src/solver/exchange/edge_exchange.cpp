// SPDX-License-Identifier: MIT
#include "solver/exchange/edge_exchange.hpp"

#include "base/simd.hpp"

#include <algorithm>

namespace tribo {

template <int Dim>
std::unique_ptr<Exchange<Dim>> make_exchange(const GridSpec& grid, const Lattice<Dim>& lattice) {
  auto edges = std::make_unique<EdgeExchange<Dim>>(grid, lattice);
  if (edges->any()) return edges;
  return std::make_unique<OpenExchange<Dim>>();
}

template <int Dim>
EdgeExchange<Dim>::EdgeExchange(const GridSpec& grid, const Lattice<Dim>& lattice) {
  Problems problems;
  for (int axis = 0; axis < Dim; ++axis) {
    const auto k = static_cast<std::size_t>(axis);
    for (std::size_t side = 0; side < 2; ++side)
      for (const Edge kind : {Edge::symmetry, Edge::wall}) {
        const auto& at = (kind == Edge::symmetry ? grid.symmetry : grid.wall)[k][side];
        if (!at) continue;
        const int node = lattice.line(axis, *at);
        if (node < 0)
          problems.add(grid.origin, "the plane at " + std::to_string(*at) + " is not on a grid line; put it on one");
        else
          planes_.push_back({axis, node, side == 0 ? 1 : -1, kind});
      }
    if (grid.periodic[k]) planes_.push_back({axis, Lattice<Dim>::padding, grid.cells[k], Edge::period});
  }
  problems.raise();
  reactions_.start(planes_.size());
}

template <int Dim>
void EdgeExchange<Dim>::locate(const BlockMap<Dim>& map) {
  images_.assign(planes_.size(), {});
  own_.clear();
  for (std::size_t slot = 0; slot < map.active().size(); ++slot) own_.push_back(map.is_own(slot) ? 1 : 0);
  for (auto& list : mirror_nodes_) list.clear();
  const bool symmetry =
      std::any_of(planes_.begin(), planes_.end(), [](const Plane& p) { return p.kind == Edge::symmetry; });
  ownership_.assign(symmetry ? static_cast<std::size_t>(map.node_count()) : 0, 1.0);
  for (std::size_t p = 0; p < planes_.size(); ++p) {
    const Plane& plane = planes_[p];
    const auto axis = static_cast<std::size_t>(plane.axis);
    for (std::int64_t at = 0; at < map.node_count(); ++at) {
      const auto node = map.node_at(at);
      if (plane.kind == Edge::symmetry && node[axis] == plane.node)
        mirror_nodes_[axis].push_back({at, p}), ownership_[static_cast<std::size_t>(at)] *= 0.5;
      const auto image = image_of(plane, at, node, map);
      if (image && image->plane >= 0 && image->inside >= 0) images_[p].push_back(*image);
    }
  }
}

// The stencils of particles extend up to two nodes beyond a plane, and up to three beyond a periodic edge, which
// particles may cross between two sorts.
template <int Dim>
auto EdgeExchange<Dim>::image_of(const Plane& plane, std::int64_t at, Index<Dim> node, const BlockMap<Dim>& map) const
    -> std::optional<Image> {
  int& n = node[static_cast<std::size_t>(plane.axis)];
  Image image{at, -1, -1, 0};
  if (plane.kind == Edge::period) {
    const int period = plane.inward, from_low = n - plane.node;
    if (from_low < -3 || (from_low >= 0 && from_low < period) || from_low > period + 3) return std::nullopt;
    n = plane.node + (from_low % period + period) % period;
    image.plane = image.inside = map.node(node);
    return image;
  }
  image.depth = (plane.node - n) * plane.inward;
  if (image.depth < 1 || image.depth > 2) return std::nullopt;
  n = plane.node;
  image.plane = map.node(node);
  n += plane.inward * (plane.kind == Edge::symmetry ? image.depth : 1);
  image.inside = map.node(node);
  return image;
}

template <int Dim>
void EdgeExchange<Dim>::sum_images(NodeNumbers nodes, ImageValues values) const {
  constexpr int first = NodeNumbers::first_vector, second = NodeNumbers::second_vector;
  const auto scattered = [&](const double* node) {
    const Wide all = Wide::load(node);
    return values != ImageValues::forces ? all : Wide::join(Vec4{}, all.high());
  };
  const auto add = [](double* to, const Wide& w) { (Wide::load(to) + w).store(to); };
  for (std::size_t p = 0; p < planes_.size(); ++p) {
    const Plane& plane = planes_[p];
    if (values == ImageValues::cells && plane.kind != Edge::period) continue;
    for (const Image& i : images_[p]) {
      double* image = nodes[static_cast<std::size_t>(i.image)];
      double* inside = nodes[static_cast<std::size_t>(i.inside)];
      alignas(64) double beyond[NodeNumbers::per_node];
      scattered(image).store(beyond);
      if (plane.kind != Edge::wall) {
        if (plane.kind == Edge::symmetry && values != ImageValues::scalars) {
          beyond[first + plane.axis] = -beyond[first + plane.axis];
          beyond[second + plane.axis] = -beyond[second + plane.axis];
        }
        add(inside, scattered(beyond));
      } else {
        add(nodes[static_cast<std::size_t>(i.plane)], (i.depth + 1.0) * scattered(beyond));
        add(inside, -static_cast<double>(i.depth) * scattered(beyond));
      }
      if (values != ImageValues::forces)
        Wide::zero().store(image);
      else
        store4(image + 4, Vec4{});
    }
    // Nodes on planes are their own mirror images. They are doubled once all images of their axis have been added.
    if (p + 1 < planes_.size() && planes_[p + 1].axis == plane.axis) continue;
    for (const OnPlane& on : mirror_nodes_[plane.axis]) {
      double* node = nodes[static_cast<std::size_t>(on.node)];
      add(node, scattered(node));
      if (values != ImageValues::scalars) node[first + plane.axis] = node[second + plane.axis] = 0.0;
    }
  }
}

template <int Dim>
void EdgeExchange<Dim>::copy_images(NodeNumbers nodes, ImageValues values) const {
  constexpr int first = NodeNumbers::first_vector, second = NodeNumbers::second_vector;
  for (std::size_t p = planes_.size(); p-- > 0;) {
    const Plane& plane = planes_[p];
    if (values == ImageValues::cells && plane.kind != Edge::period) continue;
    for (const Image& i : images_[p]) {
      double* image = nodes[static_cast<std::size_t>(i.image)];
      const double* inside = nodes[static_cast<std::size_t>(i.inside)];
      const double weight = image[0];
      if (plane.kind != Edge::wall) {
        Wide::load(inside).store(image);
        if (plane.kind == Edge::symmetry && values != ImageValues::scalars) {
          image[first + plane.axis] = -image[first + plane.axis];
          image[second + plane.axis] = -image[second + plane.axis];
        }
      } else {
        const double* on = nodes[static_cast<std::size_t>(i.plane)];
        ((i.depth + 1.0) * Wide::load(on) + -static_cast<double>(i.depth) * Wide::load(inside)).store(image);
      }
      image[0] = weight;
    }
  }
}

template <int Dim>
bool EdgeExchange<Dim>::is_image(const Index<Dim>& node) const {
  return std::any_of(planes_.begin(), planes_.end(), [&](const Plane& plane) {
    const int beyond = plane.node - node[static_cast<std::size_t>(plane.axis)];
    return plane.kind == Edge::period ? beyond > 0 || -beyond >= plane.inward : beyond * plane.inward > 0;
  });
}

template <int Dim>
int EdgeExchange<Dim>::mirrored_axes(const Index<Dim>& node) const {
  int axes = 0;
  for (const Plane& plane : planes_)
    if (plane.kind == Edge::symmetry && node[static_cast<std::size_t>(plane.axis)] == plane.node)
      axes |= 1 << plane.axis;
  return axes;
}

template <int Dim>
int EdgeExchange<Dim>::reflect(Index<Dim>& node) const {
  int axes = 0;
  for (const Plane& plane : planes_) {
    int& n = node[static_cast<std::size_t>(plane.axis)];
    if (plane.kind != Edge::symmetry || (n - plane.node) * plane.inward >= 0) continue;
    n = 2 * plane.node - n;
    axes |= 1 << plane.axis;
  }
  return axes;
}

template <int Dim>
void EdgeExchange<Dim>::begin_step() {
  reactions_.start(planes_.size());
}

template <int Dim>
void EdgeExchange<Dim>::add_plane_reactions(const NodeLayer& nodes) {
  // In the normal direction, a node inside receives its own force minus that of its image, and a node on the plane
  // receives no force.
  for (std::size_t p = 0; p < planes_.size(); ++p)
    if (planes_[p].kind == Edge::symmetry)
      for (const Image& i : images_[p])
        if (is_own(i.image)) reactions_.add(p, -2 * nodes[static_cast<std::size_t>(i.image)].force[planes_[p].axis]);
  for (int axis = 0; axis < Dim; ++axis)
    for (const OnPlane& on : mirror_nodes_[axis])
      if (is_own(on.node)) reactions_.add(on.plane, -nodes[static_cast<std::size_t>(on.node)].force[axis]);
}

template <int Dim>
void EdgeExchange<Dim>::hold_planes(NodeLayer& nodes) {
  for (int axis = 0; axis < Dim; ++axis)
    for (const OnPlane& on : mirror_nodes_[axis]) {
      Node& node = nodes[static_cast<std::size_t>(on.node)];
      if (is_own(on.node)) reactions_.add(on.plane, -ownership(on.node) * node.mass * node.acceleration[axis]);
      node.velocity[axis] = node.acceleration[axis] = 0.0;
    }
}

template <int Dim>
void EdgeExchange<Dim>::end_step() {
  reactions_.finish();
}

template <int Dim>
double EdgeExchange<Dim>::plane_reaction(int axis, int side) const {
  for (std::size_t p = 0; p < planes_.size(); ++p)
    if (planes_[p].kind == Edge::symmetry && planes_[p].axis == axis && planes_[p].inward == 1 - 2 * side)
      return reactions_[p];
  return 0.0;
}

template class OpenExchange<2>;
template class OpenExchange<3>;
template class EdgeExchange<2>;
template class EdgeExchange<3>;
template std::unique_ptr<Exchange<2>> make_exchange(const GridSpec&, const Lattice<2>&);
template std::unique_ptr<Exchange<3>> make_exchange(const GridSpec&, const Lattice<3>&);

}  // namespace tribo
