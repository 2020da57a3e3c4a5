// SPDX-License-Identifier: MIT
/// The two faces of cracks: contact at nodes, history variables and motion.

#include "base/parallel.hpp"
#include "geometry/crossing.hpp"
#include "solver/cracks/cracks.hpp"

#include <algorithm>
#include <cmath>

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

// Quadrature points of a piece in barycentric coordinates; all have the same weight.
constexpr std::array<std::array<double, 2>, 2> gauss2{
    {{0.7886751345948129, 0.2113248654051871}, {0.2113248654051871, 0.7886751345948129}}};
constexpr std::array<std::array<double, 3>, 3> gauss3{
    {{2.0 / 3, 1.0 / 6, 1.0 / 6}, {1.0 / 6, 2.0 / 3, 1.0 / 6}, {1.0 / 6, 1.0 / 6, 2.0 / 3}}};
template <int Dim>
constexpr const auto& gauss() {
  if constexpr (Dim == 2)
    return gauss2;
  else
    return gauss3;
}

}  // namespace

// Several pieces may have the closest point in common: the normal is the mean of theirs, whichever way the lines run.
template <int Dim>
auto Cracks<Dim>::nearest(std::uint32_t surface, const Vec<Dim>& x) const -> Nearest {
  const double h = system_.lattice.spacing.maxCoeff(), same = 1e-9 * h;  // tolerance for a common corner
  double bound = (width_ + 1.0 + block_edge<Dim>)*h;  // pieces farther away are not near the block of x
  const auto point_of = [&](const PlacedPiece& p, auto& share) {
    share = nearest_share(p.corners, x);
    Vec<Dim> at = Vec<Dim>::Zero();
    for (std::size_t k = 0; k < share.size(); ++k) at += share[k] * p.corners[k];
    return at;
  };
  const auto each_within_bound = [&](auto&& f) {
    const auto each_of = [&](std::size_t first, std::size_t end) {
      for (std::size_t k = first; k < std::min(end, pieces_.size()); ++k)
        if (pieces_[k].surface == surface && pieces_[k].box.distance_squared(x) <= bound * bound) f(pieces_[k]);
    };
    tree_.each([&](const Box<Dim>& box) { return box.distance_squared(x) <= bound * bound; }, each_of);
  };
  Nearest out;
  double least = std::numeric_limits<double>::infinity();
  const auto measure = [&](const PlacedPiece& p) {
    least = std::min(least, (x - point_of(p, out.share)).norm());
    bound = std::min(bound, least + 2 * same);
  };
  const std::size_t guess = tree_.near(x);
  for (std::size_t k = guess; k < std::min(guess + BoxTree<Dim>::children, pieces_.size()); ++k)
    if (pieces_[k].surface == surface) measure(pieces_[k]);
  each_within_bound(measure);
  each_within_bound([&](const PlacedPiece& p) {
    std::array<double, Dim> share;
    const Vec<Dim> at = point_of(p, share);
    if ((x - at).norm() > least + same) return;
    const Vec<Dim> area = p.area();
    if (!out.piece)
      out = {&p, at, area.normalized(), share, 1};
    else
      out.normal += (area.dot(out.piece->area()) < 0 ? -1.0 : 1.0) * area.normalized();
  });
  if (!out.piece) return out;
  out.normal.normalize();
  const double ahead = out.normal.dot(x - out.at);
  out.side = std::abs(ahead) > same ? (ahead > 0 ? 1 : -1) : side_of(out.piece->corners, x);
  return out;
}

template <int Dim>
auto Cracks<Dim>::average_faces(std::uint32_t surface, const Vec<Dim>& node, const Nearest& nearest) const
    -> FaceAverages {
  FaceAverages out;
  const auto add = [&](const PlacedPiece& piece, const auto& share, double w) {
    const Crack<Dim>& crack = system_.cracks[piece.crack];
    for (std::size_t k = 0; k < share.size(); ++k) {
      const auto point = piece.points[k];
      out.opening += w * share[k] * piece.opening(crack, point), out.gap += w * share[k] * crack.gap[point];
      out.slip += w * share[k] * crack.slip[point], out.bond += w * share[k] * crack.bond[point];
    }
  };
  const Vec<Dim> reach = 2 * system_.lattice.spacing;
  each_piece({node - reach, node + reach}, [&](const PlacedPiece& p) {
    if (p.surface != surface) return;
    const auto& corners = p.corners;
    const Crack<Dim>& crack = system_.cracks[p.crack];
    const double whole = crack.inside[p.piece] * p.area().norm() / static_cast<double>(gauss<Dim>().size());
    for (std::size_t g = 0; g < gauss<Dim>().size(); ++g) {
      // the corners of images are in a different order
      auto share = gauss<Dim>()[g];
      if (p.points != crack.pieces[p.piece]) std::swap(share[0], share[1]);
      Vec<Dim> x = Vec<Dim>::Zero();
      for (std::size_t k = 0; k < share.size(); ++k) x += share[k] * corners[k];
      double w = nodes_around_.weight(x - node) * whole * weight_factor_[p.crack][p.piece * gauss<Dim>().size() + g];
      if (!(w > 0)) continue;
      if (system_.analysis == Analysis::axisymmetric)
        w *= x[0];
      else if constexpr (Dim == 2)
        w *= model_.grid.thickness;
      out.area += w;
      add(p, share, w);
    }
  });
  const double least = 1e-9 * std::pow(system_.lattice.spacing.maxCoeff(), Dim - 1);
  if (out.area > least) {
    out.opening /= out.area, out.gap /= out.area, out.slip /= out.area, out.bond /= out.area;
  } else {
    out = FaceAverages{};
    add(*nearest.piece, nearest.share, 1.0);
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
  const auto is = [&](int side) { return velocity_on_side(n, side, v) > 0; };
  return (is(0) && is(bit)) || (is(3 - bit) && is(3));
}

// The fraction of the tractions at nodes with mass on one side only is transferred to the other nodes, so that the
// resultant of the tractions is exact.
template <int Dim>
void Cracks<Dim>::find_face_weights() {
  weight_factor_.resize(system_.cracks.size());
  constexpr std::size_t points = gauss<Dim>().size();
  for (std::uint32_t c = 0; c < system_.cracks.size(); ++c) {
    const Crack<Dim>& crack = system_.cracks[c];
    weight_factor_[c].assign(crack.pieces.size() * points, 0.0);
    parallel_for(static_cast<std::ptrdiff_t>(crack.pieces.size()), [&](std::ptrdiff_t piece) {
      const auto p = static_cast<std::size_t>(piece);
      const auto corners = crack.corners(p);
      for (std::size_t g = 0; g < points; ++g) {
        Vec<Dim> x = Vec<Dim>::Zero();
        for (std::size_t k = 0; k < corners.size(); ++k) x += gauss<Dim>()[g][k] * corners[k];
        double all = 0.0, both = 0.0;
        nodes_around_.each(x, [&](double w, const Index<Dim>& n) {
          all += w;
          if (both_sides(crack.surface, n)) both += w;
        });
        // otherwise the point lies at an end or outside of the bodies, or the crack is wide open
        constexpr double enough = 0.25;
        if (both > enough * all) weight_factor_[c][p * points + g] = all / both;
      }
    });
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
  const FaceAverages faces = average_faces(surface, x, here);
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
double Cracks<Dim>::velocity_on_side(Index<Dim> n, int side, Vec<Dim>& v) const {
  const Vec<Dim> mirror = nodes_around_.fold(n);
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

// Velocities of the two faces at a point. While the faces are close, their velocity jump is interpolated from the
// nodes with mass on both sides, where contact acts as well. Their mean velocity is interpolated from all nodes, which
// is exact for linear velocities. Once the faces are farther apart, the velocity of each face is interpolated from the
// nodes around it.
template <int Dim>
bool Cracks<Dim>::face_velocities(const Crack<Dim>& crack, std::size_t k, const Vec<Dim>& normal,
                                  std::array<Vec<Dim>, 2>& v) const {
  const Vec<Dim> offset = 1e-6 * system_.lattice.spacing.minCoeff() * normal;
  const std::array<Vec<Dim>, 2> side_points{crack.x[k] - offset, crack.x[k] + offset};
  thread_local NearbyPieces nearby;
  find_nearby(crack.x[k], nearby);
  struct OfNode {
    double weight;
    std::array<double, 2> mass;
    std::array<Vec<Dim>, 2> velocity;
  };
  thread_local std::vector<OfNode> nodes;
  nodes.clear();
  double heaviest = 0.0;
  nodes_around_.each(crack.x[k], [&](double w, const Index<Dim>& n) {
    OfNode& of = nodes.emplace_back();
    of.weight = w;
    for (std::size_t f = 0; f < 2; ++f) {
      of.velocity[f].setZero();
      of.mass[f] = velocity_on_side(n, side_of_node(nearby, side_points[f], n), of.velocity[f]);
      heaviest = std::max(heaviest, of.mass[f]);
    }
  });
  // the velocities of nodes with very little mass are inaccurate, so their weights are reduced
  constexpr double light = 1e-3;
  const auto share = [&](double mass) { return mass > 0 ? std::min(1.0, mass / (light * heaviest)) : 0.0; };
  double all = 0.0, both = 0.0;
  Vec<Dim> mean = Vec<Dim>::Zero(), jump = mean;
  for (const auto& [w, mass, of] : nodes) {
    const std::array<double, 2> part{share(mass[0]), share(mass[1])};
    const auto [less, more] = std::minmax(part[0], part[1]);
    if (!(more > 0)) continue;
    all += w * more, mean += w * more * (part[0] * of[0] + part[1] * of[1]) / (part[0] + part[1]);
    both += w * less, jump += w * less * (of[1] - of[0]);
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
    find_nearby(crack.face[f][k], nearby);
    nodes_around_.each(crack.face[f][k], [&](double w, const Index<Dim>& n) {
      if (const double part = share(velocity_on_side(n, side_of_node(nearby, side_points[f], n), here)); part > 0)
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

}  // namespace

// Points outside of all bodies move with the nearest point within a body.
template <int Dim>
void Cracks<Dim>::move(double dt) {
  for (auto& crack : system_.cracks) {
    const auto normals = crack.normals();
    const std::size_t count = crack.x.size();
    std::vector<std::array<Vec<Dim>, 2>> v(count);
    std::vector<char> carried(count, 0);
    parallel_for(static_cast<std::ptrdiff_t>(count), [&](std::ptrdiff_t point) {
      const auto k = static_cast<std::size_t>(point);
      if (!crack.is_prescribed.empty() && crack.is_prescribed[k])
        carried[k] = 1, v[k] = crack.prescribed_velocity[k];
      else
        carried[k] = face_velocities(crack, k, normals[k], v[k]);
    });
    const bool any = std::find(carried.begin(), carried.end(), char{1}) != carried.end();
    for (std::size_t k = 0; k < count; ++k) {
      if (carried[k]) continue;
      double least = std::numeric_limits<double>::infinity();
      v[k].fill(Vec<Dim>::Zero());
      for (std::size_t other = 0; any && other < count; ++other)
        if (const double d = (crack.x[other] - crack.x[k]).squaredNorm(); carried[other] && d < least)
          least = d, v[k].fill(0.5 * (v[other][0] + v[other][1]));
    }
    for (std::size_t k = 0; k < count; ++k) {
      for (std::size_t f = 0; f < 2; ++f) crack.face[f][k] += dt * v[k][f];
      crack.gap[k] += dt * (v[k][1] - v[k][0]).dot(normals[k]);
      if (!crack.fixed) crack.x[k] = 0.5 * (crack.face[0][k] + crack.face[1][k]);
    }
    if (!crack.fixed) straighten_extensions(crack, system_.lattice.spacing.maxCoeff());
  }
}

template <int Dim>
void Cracks<Dim>::begin_record() {
  records_.resize(system_.cracks.size());
  for (std::size_t c = 0; c < records_.size(); ++c) records_[c].assign(system_.cracks[c].x.size(), {});
}

template <int Dim>
void Cracks<Dim>::record(const ContactPair& pair, const Index<Dim>& node) {
  const Vec<Dim> x = system_.lattice.position(node);
  const Vec3 v = pair.state.velocity - pair.impulse / pair.state.mass;
  const Vec3 along = v - v.dot(pair.state.normal) * pair.state.normal;
  const Vec<Dim> reach = reach_of(model_.scheme.kernel) * system_.lattice.spacing;
  each_piece({x - reach, x + reach}, [&](const PlacedPiece& p) {
    if (static_cast<int>(p.crack) != pair.crack) return;
    const double face_sign = pair.state.normal.template head<Dim>().dot(p.area()) > 0 ? 1.0 : -1.0;
    for (std::size_t k = 0; k < p.points.size(); ++k) {
      const double w = nodes_around_.weight(p.corners[k] - x);
      if (!(w > 0)) continue;
      PointRecord& m = records_[p.crack][p.points[k]];
      m.area += w * pair.state.area;
      m.force += w * face_sign / pair.state.dt * p.mirror.cwiseProduct(pair.impulse.template head<Dim>());
      (pair.response.status == ContactStatus::open   ? m.open_weight
       : pair.response.status == ContactStatus::slip ? m.slip_weight
                                                     : m.stick_weight) += w;
      if (pair.response.status == ContactStatus::slip) m.slip_length += w * pair.state.dt * along.norm();
      if (pair.response.bond == Bond::whole) m.bonded += w;
      if (pair.response.bond == Bond::broken) m.broken += w;
    }
  });
}

template <int Dim>
void Cracks<Dim>::end_record() {
  for (std::size_t c = 0; c < records_.size(); ++c) {
    Crack<Dim>& crack = system_.cracks[c];
    for (std::size_t k = 0; k < crack.x.size(); ++k) {
      const PointRecord& m = records_[c][k];
      const bool touches = m.slip_weight + m.stick_weight > m.open_weight,
                 slides = touches && m.slip_weight > m.stick_weight;
      crack.status[k] = slides ? 2.0 : touches ? 1.0 : 0.0;
      crack.slip[k] = slides ? crack.slip[k] + m.slip_length / m.slip_weight : 0.0;
      if (m.bonded + m.broken > 0) crack.bond[k] = m.broken > m.bonded ? -1.0 : 1.0;
      crack.traction[k] = m.area > 0 ? Vec<Dim>(m.force / m.area) : Vec<Dim>(Vec<Dim>::Zero());
    }
  }
}

template class Cracks<2>;
template class Cracks<3>;

}  // namespace tribo
