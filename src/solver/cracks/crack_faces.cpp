// SPDX-License-Identifier: MIT
/// The two faces of cracks: contact at nodes and history variables.

#include "base/parallel.hpp"
#include "geometry/crossing.hpp"
#include "solver/cracks/cracks.hpp"

#include <algorithm>
#include <cmath>
#include <span>

namespace tribo {
namespace {

/// Barycentric coordinates of the point of a piece that is closest to x.
std::array<double, 2> nearest_share(const std::array<Vec<2>, 2>& c, const Vec<2>& x) {
  const Vec<2> along = c[1] - c[0];
  const double t = std::clamp(along.dot(x - c[0]) / along.squaredNorm(), 0.0, 1.0);
  return {1 - t, t};
}
// Ericson, Real-Time Collision Detection (2005), section 5.1.5.
std::array<double, 3> nearest_share(const std::array<Vec3, 3>& c, const Vec3& x) {
  const Vec3 ab = c[1] - c[0], ac = c[2] - c[0], ap = x - c[0], bp = x - c[1], cp = x - c[2];
  const double d1 = ab.dot(ap), d2 = ac.dot(ap), d3 = ab.dot(bp), d4 = ac.dot(bp), d5 = ab.dot(cp), d6 = ac.dot(cp);
  if (d1 <= 0 && d2 <= 0) return {1, 0, 0};
  if (d3 >= 0 && d4 <= d3) return {0, 1, 0};
  if (d6 >= 0 && d5 <= d6) return {0, 0, 1};
  const double vc = d1 * d4 - d3 * d2, vb = d5 * d2 - d1 * d6, va = d3 * d6 - d5 * d4;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return {1 - d1 / (d1 - d3), d1 / (d1 - d3), 0};
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return {1 - d2 / (d2 - d6), 0, d2 / (d2 - d6)};
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) {
    const double t = (d4 - d3) / ((d4 - d3) + (d5 - d6));
    return {0, 1 - t, t};
  }
  const double sum = va + vb + vc;
  return {va / sum, vb / sum, vc / sum};
}

// Integration points of a piece in barycentric coordinates; all have the same weight.
constexpr std::array<std::array<double, 2>, 2> gauss2{
    {{0.7886751345948129, 0.2113248654051871}, {0.2113248654051871, 0.7886751345948129}}};
constexpr std::array<std::array<double, 2>, 1> middle2{{{0.5, 0.5}}};
constexpr std::array<std::array<double, 3>, 3> gauss3{
    {{2.0 / 3, 1.0 / 6, 1.0 / 6}, {1.0 / 6, 2.0 / 3, 1.0 / 6}, {1.0 / 6, 1.0 / 6, 2.0 / 3}}};
constexpr std::array<std::array<double, 3>, 1> middle3{{{1.0 / 3, 1.0 / 3, 1.0 / 3}}};

// The mean of a shape function over a piece this short deviates from that in its middle by at most 3e-4: one
// integration point is enough [cells].
constexpr double short_piece = 1.0 / 16;

std::span<const std::array<double, 2>> integration_points(const std::array<Vec<2>, 2>& c, double cell) {
  const double short_length = short_piece * cell;
  if ((c[1] - c[0]).squaredNorm() < short_length * short_length) return middle2;
  return gauss2;
}
std::span<const std::array<double, 3>> integration_points(const std::array<Vec3, 3>& c, double cell) {
  const double longest =
      std::max({(c[1] - c[0]).squaredNorm(), (c[2] - c[0]).squaredNorm(), (c[2] - c[1]).squaredNorm()});
  const double short_length = short_piece * cell;
  if (longest < short_length * short_length) return middle3;
  return gauss3;
}

}  // namespace

// Several pieces may have the closest point in common: the normal is the mean of theirs, whichever way the lines run.
template <int Dim>
auto Cracks<Dim>::nearest(std::uint32_t surface, const Vec<Dim>& x) const -> Nearest {
  const double h = system_.lattice.spacing.maxCoeff(), same = 1e-9 * h;  // tolerance for a common corner
  const double farthest = (width_ + 1.0 + block_edge<Dim>)*h;  // pieces farther away are not near the block of x
  double least = std::numeric_limits<double>::infinity(), bound = farthest * farthest;
  struct Candidate {
    const PlacedPiece* piece;
    double distance;
    Vec<Dim> at;
    std::array<double, Dim> share;
  };
  thread_local std::vector<Candidate> candidates;
  candidates.clear();
  tree_.each_near(x, bound, [&](std::size_t first, std::size_t end) {
    for (std::size_t k = first; k < std::min(end, pieces_.size()); ++k) {
      const PlacedPiece& p = pieces_[k];
      if (p.surface != surface || p.box.distance_squared(x) > bound) continue;
      Candidate here{&p, 0.0, Vec<Dim>::Zero(), nearest_share(p.corners, x)};
      for (std::size_t c = 0; c < here.share.size(); ++c) here.at += here.share[c] * p.corners[c];
      here.distance = (x - here.at).norm();
      if (here.distance > least + same) continue;
      candidates.push_back(here);
      least = std::min(least, here.distance);
      bound = std::min(bound, (least + 2 * same) * (least + 2 * same));
    }
  });
  std::sort(candidates.begin(), candidates.end(),
            [](const Candidate& a, const Candidate& b) { return a.piece < b.piece; });
  Nearest out;
  for (const Candidate& here : candidates) {
    if (here.distance > least + same) continue;
    const Vec<Dim> area = here.piece->area();
    if (!out.piece)
      out = {here.piece, here.at, area.normalized(), here.share, 1};
    else
      out.normal += (area.dot(out.piece->area()) < 0 ? -1.0 : 1.0) * area.normalized();
  }
  if (!out.piece) return out;
  out.normal.normalize();
  const double ahead = out.normal.dot(x - out.at);
  out.side = std::abs(ahead) > same ? (ahead > 0 ? 1 : -1) : side_of(out.piece->corners, x);
  return out;
}

template <int Dim>
auto Cracks<Dim>::average_faces(std::uint32_t surface, const Index<Dim>& node, const Nearest& nearest) const
    -> FaceAverages {
  FaceAverages out;
  if (const auto [list, local] = place_of(node); list >= 0) {
    const auto at = static_cast<std::size_t>(list);
    const auto found = std::find(lists_[at].begin(), lists_[at].end(), surface) - lists_[at].begin();
    if (static_cast<std::size_t>(found) < lists_[at].size())
      out = block_faces_[at].integrals[static_cast<std::size_t>(found) * block_nodes<Dim> + local];
  }
  const double least = 1e-9 * std::pow(system_.lattice.spacing.maxCoeff(), Dim - 1);
  if (out.area > least) {
    out.gap /= out.area, out.slip /= out.area, out.bond /= out.area;
    return out;
  }
  out = FaceAverages{};
  const Crack<Dim>& crack = system_.cracks[nearest.piece->crack];
  for (std::size_t k = 0; k < nearest.share.size(); ++k) {
    const auto point = nearest.piece->points[k];
    const double share = nearest.share[k];
    out.gap += share * crack.gap[point];
    out.slip += share * crack.slip[point], out.bond += share * crack.bond[point];
  }
  return out;
}

// Whether a node has mass in the fields on both sides of a surface.
template <int Dim>
bool Cracks<Dim>::both_sides(std::uint32_t surface, const Index<Dim>& n) const {
  int bit = 1;
  if (system_.cracks.size() > 1) {
    const auto found = node_surfaces_.find(flat(n));
    if (found == node_surfaces_.end()) return false;
    const auto [first, second] = found->second;
    if (first != static_cast<int>(surface) && second != static_cast<int>(surface)) return false;
    bit = first == static_cast<int>(surface) ? 1 : 2;
  }
  Vec<Dim> v;
  const auto is = [&](int side) { return sum_side(n, side, v) > 0; };
  return (is(0) && is(bit)) || (is(3 - bit) && is(3));
}

// both_sides() for the nodes of all listed blocks is known once integrate_faces() has begun.
template <int Dim>
bool Cracks<Dim>::has_both_sides(std::uint32_t surface, const Index<Dim>& n) const {
  const auto [list, local] = place_of(n);
  if (list < 0) return both_sides(surface, n);
  const auto at = static_cast<std::size_t>(list);
  return (block_faces_[at].both[local] & bit_of(surface, lists_[at])) != 0;
}

// The integrals over successive points of a crack that have the same nodes around them. A finely divided crack has many
// such points, and what belongs to the nodes is found once for all of them.
template <int Dim>
struct Cracks<Dim>::FaceSums {
  std::vector<NodeIntegral>* out;  // where the sums go in the end
  bool begun = false;
  Stencil nodes;
  std::array<bool, Stencil::size> both;         // whether a node has mass on both sides
  std::array<FaceAverages, Stencil::size> sum;  // per node
};

template <int Dim>
void Cracks<Dim>::begin_sums(const Crack<Dim>& crack, const Stencil& nodes, FaceSums& sums) const {
  sums.begun = true, sums.nodes = nodes;
  nodes.each([&](std::size_t k, double, const Index<Dim>& n) {
    sums.both[k] = has_both_sides(crack.surface, n), sums.sum[k] = {};
  });
}

template <int Dim>
void Cracks<Dim>::end_sums(const Crack<Dim>& crack, FaceSums& sums) const {
  if (!sums.begun) return;
  sums.nodes.each([&](std::size_t k, double, Index<Dim> n) {
    if (!(sums.sum[k].area > 0)) return;
    nodes_around_.fold(n);
    const auto [list, local] = place_of(n);
    if (list < 0) return;
    const List& surfaces = lists_[static_cast<std::size_t>(list)];
    const auto found = std::find(surfaces.begin(), surfaces.end(), crack.surface);
    if (found == surfaces.end()) return;
    const auto position = static_cast<std::size_t>(found - surfaces.begin());
    sums.out->push_back({static_cast<std::size_t>(list), position * block_nodes<Dim> + local, sums.sum[k]});
  });
}

// The fraction of the tractions at nodes with mass on one side only is transferred to the other nodes, so that the
// resultant of the tractions is exact.
template <int Dim>
void Cracks<Dim>::add_to_sums(const Crack<Dim>& crack, std::size_t piece, FaceSums& sums) const {
  const auto corners = crack.corners(piece);
  const auto points = integration_points(corners, system_.lattice.spacing.minCoeff());
  const double part = crack.inside[piece] * Crack<Dim>::area(corners).norm() / static_cast<double>(points.size());
  if (!(part > 0)) return;
  for (const auto& shares : points) {
    FaceAverages here;
    Vec<Dim> x = Vec<Dim>::Zero();
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const double share = shares[k];
      const auto point = crack.pieces[piece][k];
      x += share * corners[k];
      here.gap += share * crack.gap[point], here.slip += share * crack.slip[point];
      here.bond += share * crack.bond[point];
    }
    Stencil nodes;
    if (!nodes_around_.find(x, nodes)) continue;
    if (!sums.begun || !nodes.has_nodes_of(sums.nodes)) end_sums(crack, sums), begin_sums(crack, nodes, sums);
    double all = 0.0, both = 0.0;
    nodes.each([&](std::size_t k, double w, const Index<Dim>&) { all += w, both += sums.both[k] ? w : 0.0; });
    // otherwise the point lies at an end or outside of the bodies, or the crack is wide open
    constexpr double enough = 0.25;
    if (!(both > enough * all)) continue;
    double whole = part * all / both;
    if (system_.analysis == Analysis::axisymmetric)
      whole *= x[0];
    else if constexpr (Dim == 2)
      whole *= model_.grid.thickness;
    nodes.each([&](std::size_t k, double w, const Index<Dim>&) {
      FaceAverages& sum = sums.sum[k];
      w *= whole;
      sum.area += w, sum.gap += w * here.gap, sum.slip += w * here.slip, sum.bond += w * here.bond;
    });
  }
}

template <int Dim>
void Cracks<Dim>::integrate_faces() {
  if (block_faces_.size() < listed_.size()) block_faces_.resize(listed_.size());
  parallel_for(static_cast<std::ptrdiff_t>(listed_.size()), [&](std::ptrdiff_t k) {
    const auto list = static_cast<std::size_t>(k);
    block_faces_[list].integrals.assign(lists_[list].size() * block_nodes<Dim>, FaceAverages{});
    each_node(list, [&](std::size_t local, const Index<Dim>& n) {
      std::uint64_t& both = block_faces_[list].both[local];
      both = 0;
      for (std::size_t s = 0; s < lists_[list].size(); ++s)
        both |= static_cast<std::uint64_t>(both_sides(lists_[list][s], n)) << s;
    });
  });
  for (const Crack<Dim>& crack : system_.cracks) {
    const std::size_t count = crack.pieces.size(), parts = (count + part_of_crack - 1) / part_of_crack;
    if (integrals_of_parts_.size() < parts) integrals_of_parts_.resize(parts);
    parallel_for(static_cast<std::ptrdiff_t>(parts), [&](std::ptrdiff_t part) {
      const auto p = static_cast<std::size_t>(part);
      FaceSums sums;
      sums.out = &integrals_of_parts_[p];
      sums.out->clear();
      for (std::size_t k = p * part_of_crack; k < std::min(count, (p + 1) * part_of_crack); ++k)
        add_to_sums(crack, k, sums);
      end_sums(crack, sums);
    });
    for (std::size_t p = 0; p < parts; ++p)
      for (const auto& [list, at, sum] : integrals_of_parts_[p]) {
        FaceAverages& all = block_faces_[list].integrals[at];
        all.area += sum.area, all.gap += sum.gap, all.slip += sum.slip, all.bond += sum.bond;
      }
  }
}

template <int Dim>
bool Cracks<Dim>::find_faces(ContactPair& pair, const Index<Dim>& node, int side_a, int side_b) const {
  const int between = side_a ^ side_b;
  std::uint32_t surface = 0;
  if (system_.cracks.size() > 1) {
    const auto found = node_surfaces_.find(flat(node));
    if (found == node_surfaces_.end()) return false;
    const int number = found->second[between == 1 ? 0 : 1];
    if (number < 0) return false;
    surface = static_cast<std::uint32_t>(number);
  }
  const Vec<Dim> x = system_.lattice.position(node);
  const Nearest here = nearest(surface, x);
  if (!here.piece) return false;
  pair.law = system_.cracks[here.piece->crack].law.get(), pair.crack = static_cast<int>(here.piece->crack);
  if (!pair.law) return false;
  // field a is on the side of the node unless it is the additional field of this crack
  const int side_of_a = side_a & between ? -here.side : here.side;
  const FaceAverages faces = average_faces(surface, node, here);
  ContactState& m = pair.state;
  m.normal.setZero();
  m.normal.template head<Dim>() = -side_of_a * here.normal;
  m.gap = faces.gap;
  m.area = faces.area;
  m.slip = faces.slip;
  m.cell = system_.lattice.spacing.maxCoeff();
  m.bond = faces.bond > 0.5 ? Bond::whole : faces.bond < -0.5 ? Bond::broken : Bond::none;
  return true;
}

// Total mass at a node of the fields on one side, and their mean velocity v.
template <int Dim>
double Cracks<Dim>::sum_side(Index<Dim> n, int side, Vec<Dim>& v) const {
  const Vec<Dim> mirror = nodes_around_.fold(n);
  for (std::size_t d = 0; d < Dim; ++d)
    if (n[d] < 0 || n[d] >= system_.lattice.blocks[d] * block_edge<Dim>) return 0.0;
  double mass = 0.0;
  Vec<Dim> momentum = Vec<Dim>::Zero();
  for (const auto& field : system_.fields) {
    if (field.side != side || field.rigid_contact) continue;
    const auto at = field.map.node(n);
    if (at < 0) continue;
    const Node& node = field.nodes[static_cast<std::size_t>(at)];
    if (!(node.mass > 0)) continue;
    mass += node.mass;
    momentum += node.mass * Eigen::Map<const Vec<Dim>>(node.velocity);
  }
  if (mass > 0) v = mirror.cwiseProduct(momentum) / mass;
  return mass;
}

template <int Dim>
void Cracks<Dim>::begin_record() {
  records_.clear();
  for (std::size_t list = 0; list < listed_.size(); ++list) block_faces_[list].record.fill(-1);
}

template <int Dim>
void Cracks<Dim>::record(const ContactPair& pair, const Index<Dim>& node) {
  const auto [list, local] = place_of(node);
  if (list < 0) return;
  const Vec3 v = pair.state.velocity - pair.impulse / pair.state.mass;
  const Vec3 along = v - v.dot(pair.state.normal) * pair.state.normal;
  int& last = block_faces_[static_cast<std::size_t>(list)].record[local];
  records_.push_back({pair.crack, last, pair.state.area, pair.state.dt * along.norm(), pair.response.status,
                      pair.response.bond, pair.state.normal.template head<Dim>(),
                      pair.impulse.template head<Dim>() / pair.state.dt});
  last = static_cast<int>(records_.size()) - 1;
}

namespace {

// The record of a node around a point, as seen from that node, which may be an image.
template <int Dim, class Record>
struct RecordAround {
  std::size_t position;  // of the node in the stencil
  const Record* of;
  Vec<Dim> mirror;
};

}  // namespace

// The state of a point follows from the records of the nodes around it, weighted by their shape functions.
template <int Dim>
void Cracks<Dim>::end_record() {
  for (std::size_t c = 0; c < system_.cracks.size(); ++c) {
    Crack<Dim>& crack = system_.cracks[c];
    const auto normals = crack.normals();
    const std::size_t count = crack.x.size(), parts = (count + part_of_crack - 1) / part_of_crack;
    parallel_for(static_cast<std::ptrdiff_t>(parts), [&](std::ptrdiff_t part) {
      const auto p = static_cast<std::size_t>(part);
      thread_local std::vector<RecordAround<Dim, NodeRecord>> records;
      Stencil last;
      bool found = false;
      for (std::size_t k = p * part_of_crack; k < std::min(count, (p + 1) * part_of_crack); ++k) {
        Stencil nodes;
        const bool inside = nodes_around_.find(crack.x[k], nodes);
        if (!inside) records.clear();
        if (inside && !(found && nodes.has_nodes_of(last))) {
          records.clear();
          nodes.each([&](std::size_t position, double, Index<Dim> n) {
            const Vec<Dim> mirror = nodes_around_.fold(n);
            const auto [list, local] = place_of(n);
            if (list < 0) return;
            for (int r = block_faces_[static_cast<std::size_t>(list)].record[local]; r >= 0;) {
              const NodeRecord& of = records_[static_cast<std::size_t>(r)];
              r = of.next;
              if (of.crack == static_cast<int>(c)) records.push_back({position, &of, mirror});
            }
          });
          last = nodes;
        }
        found = inside;
        std::array<double, Stencil::size> weight;
        if (!records.empty()) nodes.each([&](std::size_t at, double w, const Index<Dim>&) { weight[at] = w; });
        double area = 0.0, open = 0.0, slip = 0.0, stick = 0.0, length = 0.0, bonded = 0.0, broken = 0.0;
        Vec<Dim> force = Vec<Dim>::Zero();
        for (const auto& [position, of, mirror] : records) {
          const double w = weight[position];
          const double face_sign = mirror.cwiseProduct(of->normal).dot(normals[k]) > 0 ? 1.0 : -1.0;
          area += w * of->area, force += w * face_sign * mirror.cwiseProduct(of->force);
          const bool slides = of->status == ContactStatus::slip;
          (of->status == ContactStatus::open ? open : slides ? slip : stick) += w;
          if (slides) length += w * of->slip;
          if (of->bond == Bond::whole) bonded += w;
          if (of->bond == Bond::broken) broken += w;
        }
        const bool touches = slip + stick > open, slides = touches && slip > stick;
        crack.status[k] = slides ? 2.0 : touches ? 1.0 : 0.0;
        crack.slip[k] = slides ? crack.slip[k] + length / slip : 0.0;
        if (bonded + broken > 0) crack.bond[k] = broken > bonded ? -1.0 : 1.0;
        crack.traction[k] = area > 0 ? Vec<Dim>(force / area) : Vec<Dim>(Vec<Dim>::Zero());
      }
    });
  }
}

template class Cracks<2>;
template class Cracks<3>;

}  // namespace tribo
