// SPDX-License-Identifier: MIT
/// The motion of the two faces of cracks with the velocities of the nodes around them.

#include "base/parallel.hpp"
#include "solver/cracks/cracks.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tribo {

// Total mass at a node of the fields on one side, and their mean velocity v, both of find_side_velocities().
template <int Dim>
double Cracks<Dim>::velocity_on_side(const Index<Dim>& n, int side, Vec<Dim>& v) const {
  const auto [list, local] = place_of(n);
  if (list < 0) return sum_side(n, side, v);
  const BlockFaces& faces = block_faces_[static_cast<std::size_t>(list)];
  const double mass = faces.mass[local][static_cast<std::size_t>(side)];
  if (mass > 0) v = faces.velocity[local][static_cast<std::size_t>(side)];
  return mass;
}

// False if no side has mass at a node, so that the sides of points at it need not be found.
template <int Dim>
bool Cracks<Dim>::has_mass(const Index<Dim>& n) const {
  const auto [list, local] = place_of(n);
  if (list < 0) return true;  // not known
  const auto& masses = block_faces_[static_cast<std::size_t>(list)].mass[local];
  return std::any_of(masses.begin(), masses.begin() + sides(), [](double mass) { return mass > 0; });
}

template <int Dim>
void Cracks<Dim>::find_side_velocities() {
  if (block_faces_.size() < listed_.size()) block_faces_.resize(listed_.size());
  parallel_for(static_cast<std::ptrdiff_t>(listed_.size()), [&](std::ptrdiff_t k) {
    const auto list = static_cast<std::size_t>(k);
    each_node(list, [&](std::size_t local, const Index<Dim>& n) {
      for (int side = 0; side < sides(); ++side) {
        const auto of = static_cast<std::size_t>(side);
        block_faces_[list].mass[local][of] = sum_side(n, side, block_faces_[list].velocity[local][of]);
      }
    });
  });
}

// The nodes that lie on the same side of a crack as a point of its lower face and of its upper face. `before`: the
// result for the upper face of the point before in the same box of nodes; null: none. Between the two, the upper face
// crosses nothing.
template <int Dim>
auto Cracks<Dim>::sides_of_faces(const Crack<Dim>& crack, std::size_t k, const Vec<Dim>& normal, const NodeBox& around,
                                 const PointSides* before) const -> std::array<PointSides, 2> {
  const Vec<Dim> offset = 1e-6 * system_.lattice.spacing.minCoeff() * normal;
  PointSides lower, upper;
  if (before && !before->by_segment && around.list->size() == 1) {
    upper = *before;
    upper.x = crack.x[k] + offset;
  } else {
    upper = sides_of(around, crack.x[k] + offset);
  }
  const std::uint64_t own = bit_of(crack.surface, *around.list);
  if (upper.by_segment || !around.is_cut || own == 0) {
    lower = sides_of(around, crack.x[k] - offset);
  } else {
    lower = upper;
    lower.x = crack.x[k] - offset;
    lower.crossed ^= own;
  }
  return {lower, upper};
}

// The nodes around a point of a crack with their masses and velocities on the sides of its two faces.
template <int Dim>
struct Cracks<Dim>::FaceNodes {
  struct OfNode {
    double all, both;     // the larger and the smaller one of the shares of its two sides
    Vec<Dim> mean, jump;  // of the velocities of its sides, times `all` and `both`
  };
  bool known = false;
  Stencil nodes;
  std::array<std::uint64_t, 2> crossed{};  // PointSides::crossed of the two faces
  double heaviest = 0.0;                   // largest mass
  std::array<OfNode, Stencil::size> of;

  // The velocities of nodes with very little mass are inaccurate, so their weights are reduced.
  double share(double mass) const {
    constexpr double light = 1e-3;
    return mass > 0 ? std::min(1.0, mass / (light * heaviest)) : 0.0;
  }
};

// Does nothing if they are known already, from a point that crosses the same surfaces to the same nodes.
template <int Dim>
void Cracks<Dim>::find_face_nodes(const std::array<PointSides, 2>& sides, const Stencil& nodes,
                                  FaceNodes& of_faces) const {
  const bool by_segment = sides[0].by_segment || sides[1].by_segment;
  const std::array<std::uint64_t, 2> crossed{sides[0].crossed, sides[1].crossed};
  if (of_faces.known && !by_segment && nodes.has_nodes_of(of_faces.nodes) && crossed == of_faces.crossed) return;
  of_faces.known = !by_segment, of_faces.nodes = nodes, of_faces.crossed = crossed;
  of_faces.heaviest = 0.0;
  std::array<std::array<double, 2>, Stencil::size> masses;
  std::array<std::array<Vec<Dim>, 2>, Stencil::size> velocities;
  nodes.each([&](std::size_t k, double w, const Index<Dim>& n) {
    masses[k] = {}, velocities[k].fill(Vec<Dim>::Zero());
    if (!(w > 0) || !has_mass(n)) return;
    for (std::size_t f = 0; f < 2; ++f) {
      masses[k][f] = velocity_on_side(n, side_of_node(sides[f], n), velocities[k][f]);
      of_faces.heaviest = std::max(of_faces.heaviest, masses[k][f]);
    }
  });
  nodes.each([&](std::size_t k, double, const Index<Dim>&) {
    const double lower = of_faces.share(masses[k][0]), upper = of_faces.share(masses[k][1]);
    const auto& v = velocities[k];
    auto& [all, both, mean, jump] = of_faces.of[k];
    all = std::max(lower, upper), both = std::min(lower, upper);
    mean.setZero();
    if (all > 0) mean = all * (lower * v[0] + upper * v[1]) / (lower + upper);
    jump = both * (v[1] - v[0]);
  });
}

// Velocities of the two faces at a point. While the faces are close, their velocity jump is interpolated from the
// nodes with mass on both sides, where contact acts as well. Their mean velocity is interpolated from all nodes, which
// is exact for linear velocities. Once the faces are farther apart, the velocity of each face is interpolated from the
// nodes around it.
template <int Dim>
bool Cracks<Dim>::face_velocities(const Crack<Dim>& crack, std::size_t k, const std::array<PointSides, 2>& sides,
                                  FaceNodes& of_faces, std::array<Vec<Dim>, 2>& v) const {
  Stencil nodes;
  double all = 0.0, both = 0.0;
  Vec<Dim> mean = Vec<Dim>::Zero(), jump = mean;
  if (nodes_around_.find(crack.x[k], nodes)) {
    find_face_nodes(sides, nodes, of_faces);
    nodes.each([&](std::size_t at, double w, const Index<Dim>&) {
      const auto& of = of_faces.of[at];
      all += w * of.all, both += w * of.both;
      mean += w * of.mean, jump += w * of.jump;
    });
  } else {
    of_faces.known = false, of_faces.heaviest = 0.0;
  }
  constexpr double enough = 0.25;
  if (both > enough * all) {
    v = {mean / all - 0.5 * jump / both, mean / all + 0.5 * jump / both};
    return true;
  }
  std::array<bool, 2> found{};
  Vec<Dim> here;
  for (std::size_t f = 0; f < 2; ++f) {
    double sum = 0.0;
    v[f].setZero();
    thread_local NodeBox around_face;
    find_nodes(crack.face[f][k], around_face);
    const PointSides of_face = sides_of(around_face, sides[f].x);
    nodes_around_.each(crack.face[f][k], [&](double w, const Index<Dim>& n) {
      if (!has_mass(n)) return;
      if (const double part = of_faces.share(velocity_on_side(n, side_of_node(of_face, n), here)); part > 0)
        sum += w * part, v[f] += w * part * here;
    });
    found[f] = sum > 0;
    if (found[f]) v[f] /= sum;
  }
  if (found[0] != found[1]) v[found[0] ? 1 : 0] = v[found[0] ? 0 : 1];
  return found[0] || found[1];
}

namespace {

// The extension of a line beyond the surface of a body continues its last piece. It reaches only nodes with little
// mass, whose velocities would turn it, and with it the normal at the end of the line.
void straighten_extensions(Crack<2>& crack, double cell) {
  for (std::size_t p = crack.main_pieces; p < crack.pieces.size(); ++p) {
    const auto from = std::min(crack.pieces[p][0], crack.pieces[p][1]);
    const auto next = std::max(crack.pieces[p][0], crack.pieces[p][1]);
    const bool first = next == crack.pieces[p][0];  // beyond the first point of the line
    const auto& end = crack.pieces[first ? 0 : crack.main_pieces - 1];
    const Vec<2> ahead = (first ? 1.0 : -1.0) * (crack.x[end[0]] - crack.x[end[1]]).normalized();
    const Vec<2> motion = crack.x[from] + cell * ahead - crack.x[next];
    crack.x[next] += motion;
    for (auto& face : crack.face) face[next] += motion;
  }
}
void straighten_extensions(Crack<3>&, double) {}

// Points outside of all bodies move with the nearest point within a body.
template <int Dim>
void follow_nearest(const Crack<Dim>& crack, const std::vector<char>& carried,
                    std::vector<std::array<Vec<Dim>, 2>>& v) {
  std::vector<std::size_t> inside;
  for (std::size_t k = 0; k < carried.size(); ++k)
    if (carried[k]) inside.push_back(k);
  if (inside.size() == carried.size()) return;
  BoxTree<Dim> tree;
  tree.build(inside.size(), [&](std::size_t i) { return Box<Dim>{crack.x[inside[i]], crack.x[inside[i]]}; });
  for (std::size_t k = 0; k < carried.size(); ++k) {
    if (carried[k]) continue;
    v[k].fill(Vec<Dim>::Zero());
    double least = std::numeric_limits<double>::infinity();
    std::size_t nearest = carried.size();
    tree.each_near(crack.x[k], least, [&](std::size_t first, std::size_t end) {
      for (std::size_t i = first; i < std::min(end, inside.size()); ++i) {
        const double d = (crack.x[inside[i]] - crack.x[k]).squaredNorm();
        if (d < least || (d == least && inside[i] < nearest)) least = d, nearest = inside[i];
      }
    });
    if (nearest < carried.size()) v[k].fill(0.5 * (v[nearest][0] + v[nearest][1]));
  }
}

}  // namespace

template <int Dim>
void Cracks<Dim>::move(double dt) {
  if (active()) find_side_velocities();
  for (auto& crack : system_.cracks) {
    const auto normals = crack.normals();
    const std::size_t count = crack.x.size();
    std::vector<std::array<Vec<Dim>, 2>> v(count);
    std::vector<char> carried(count, 0);
    parallel_for(static_cast<std::ptrdiff_t>((count + part_of_crack - 1) / part_of_crack), [&](std::ptrdiff_t part) {
      const std::size_t first = part_of_crack * static_cast<std::size_t>(part);
      const std::size_t end = std::min(count, first + part_of_crack);
      thread_local NodeBox around;
      FaceNodes of_faces;
      PointSides before;
      bool follows = false;
      for (std::size_t k = first; k < end; ++k) {
        if (!crack.is_prescribed.empty() && crack.is_prescribed[k]) {
          carried[k] = 1, v[k] = crack.prescribed_velocity[k], follows = false;
          continue;
        }
        const bool same = find_nodes(crack.x[k], around);
        of_faces.known = of_faces.known && same;
        const bool connected = Dim == 2 && k > 0 && k < crack.main_points;
        const auto sides =
            sides_of_faces(crack, k, normals[k], around, same && follows && connected ? &before : nullptr);
        carried[k] = face_velocities(crack, k, sides, of_faces, v[k]);
        before = sides[1], follows = true;
      }
    });
    follow_nearest(crack, carried, v);
    for (std::size_t k = 0; k < count; ++k) {
      for (std::size_t f = 0; f < 2; ++f) crack.face[f][k] += dt * v[k][f];
      crack.gap[k] += dt * (v[k][1] - v[k][0]).dot(normals[k]);
      if (!crack.fixed) crack.x[k] = 0.5 * (crack.face[0][k] + crack.face[1][k]);
    }
    if (!crack.fixed) straighten_extensions(crack, system_.lattice.spacing.maxCoeff());
  }
}

template class Cracks<2>;
template class Cracks<3>;

}  // namespace tribo
