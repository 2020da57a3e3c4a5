// SPDX-License-Identifier: MIT
/// A crack: a surface of discontinuity with two faces, which move with the velocity fields on either side.
#pragma once

#include "base/archive.hpp"
#include "base/types.hpp"
#include "contact/contact_law.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

namespace tribo {

/// Length over which the direction of a crack at a tip is determined [cells].
inline constexpr double tip_length = 0.25;

/// An end of a crack that lies within a body (two dimensions).
struct CrackTip {
  /// Numbers of the points of the last piece; the crack runs from `previous` to `point`, the tip.
  std::uint32_t point = 0, previous = 0;
  int end = 1;           ///< 0: the tip is the first point of the crack; 1: the last
  bool active = true;    ///< false: the tip has reached a free surface or another crack
  std::size_t body = 0;  ///< number of the body in which the tip lies
  double J = 0.0;        ///< energy release rate                          [energy/length^2]
  /// Stress intensity factors of modes 1 and 2; 0 if the body is not elastic, which has none [stress length^1/2].
  std::array<double, 2> K{};
  bool has_K = false;
  double earliest_growth = 0.0;               ///< the tip does not grow before this time               [time]
  Vec<2> initial_direction = Vec<2>::Zero();  ///< unit vector along the crack at the start of the run
  double released = 0.0;  ///< energy that its growth released: J times the new area, summed         [energy]
};

/// Saves and restores what changes in a run; `end` and `initial_direction` follow from the model.
inline void archive(Archive& a, CrackTip& tip) {
  auto& [point, previous, end, active, body, J, K, has_K, earliest_growth, initial_direction, released] = tip;
  a.version(3);
  a("point", point), a("behind", previous), a("lives", active), a("body", body);
  a("J", J), a("K", K), a("has_K", has_K), a("rest", earliest_growth);
  a("released", released);
}

/// A crack made of straight segments in two dimensions and of triangles in three, called pieces. The normal of a
/// segment points to its left; seen from the tip of its normal, the corners of a triangle run counter-clockwise. The
/// normal points to the upper face.
template <int Dim>
struct Crack {
  using Piece = std::array<std::uint32_t, static_cast<std::size_t>(Dim)>;

  std::shared_ptr<const ContactLaw> law;  ///< contact law between the faces; null: none acts at the nodes
  std::vector<Vec<Dim>> x;                ///< points, halfway between the faces                      [length]
  /// Positions of the points on the lower (0) and the upper (1) face [length].
  std::array<std::vector<Vec<Dim>>, 2> face;
  std::vector<Piece> pieces;
  std::vector<double> inside;  ///< fraction of the area of each piece that lay within bodies at the start
  /// Numbers of points and pieces of the crack proper; those that follow extend it beyond the surface of a body.
  std::size_t main_points = 0, main_pieces = 0;
  std::vector<double> gap;         ///< normal displacement jump between the faces                 [length]
  std::vector<double> slip;        ///< distance slid since the faces last stuck                    [length]
  std::vector<double> bond;        ///< 1 intact, -1 broken, 0 no bond
  std::vector<double> status;      ///< in the last step: 0 open, 1 stick, 2 slip
  std::vector<Vec<Dim>> traction;  ///< on the lower face in the last step                     [stress]
  /// Nonzero: joints prescribe the face velocities of the point in this step; empty: of none.
  std::vector<char> is_prescribed;
  /// Velocities that joints prescribe on the lower and the upper face [velocity].
  std::vector<std::array<Vec<Dim>, 2>> prescribed_velocity;
  std::vector<CrackTip> tips;
  double initial_bond = 0.0;  ///< value of `bond` at new points
  bool fixed = false;         ///< the points x do not move with the faces
  /// Lines with common ends form one surface: the number of its first crack, by default that of the crack itself.
  std::uint32_t surface = 0;

  /// Inserts a point with closed faces at position `at` [length] before the k-th point.
  void add_point(std::size_t k, const Vec<Dim>& at) {
    const auto insert = [&](auto& list, const auto& value) {
      list.insert(list.begin() + static_cast<std::ptrdiff_t>(k), value);
    };
    insert(x, at), insert(face[0], at), insert(face[1], at), insert(traction, Vec<Dim>(Vec<Dim>::Zero()));
    insert(gap, 0.0), insert(slip, 0.0), insert(bond, initial_bond), insert(status, 0.0);
    if (is_prescribed.empty()) return;
    const Vec<Dim> zero = Vec<Dim>::Zero();
    insert(is_prescribed, char{0}), insert(prescribed_velocity, std::array{zero, zero});
  }

  /// Positions of the corners of a piece [length].
  std::array<Vec<Dim>, static_cast<std::size_t>(Dim)> corners(std::size_t piece) const {
    std::array<Vec<Dim>, static_cast<std::size_t>(Dim)> out;
    for (std::size_t k = 0; k < out.size(); ++k) out[k] = x[pieces[piece][k]];
    return out;
  }
  /// Displacement jump at a point: position on the upper minus position on the lower face [length].
  Vec<Dim> opening(std::size_t point) const { return face[1][point] - face[0][point]; }
  /// Unit normals at all points: means over the adjacent pieces, weighted by their areas.
  std::vector<Vec<Dim>> normals() const {
    std::vector<Vec<Dim>> out(x.size(), Vec<Dim>::Zero());
    for (std::size_t p = 0; p < pieces.size(); ++p)
      for (const auto point : pieces[p]) out[point] += area(corners(p));
    for (auto& n : out) n.normalize();
    return out;
  }
  /// Unit vector along the crack at a tip: to the tip from the first point behind it that is at least `length` away
  /// [length], or from the last point there is. Shorter pieces may have any direction.
  Vec<Dim> direction_at(const CrackTip& tip, double length) const {
    std::uint32_t behind = tip.previous;
    for (const int step = tip.end == 1 ? -1 : 1; (x[tip.point] - x[behind]).norm() < length * (1 - 1e-9);) {
      const std::uint32_t first = step < 0 ? behind - 1 : behind;  // number of the next piece and of its first point
      if (first >= main_pieces || pieces[first][0] != first || pieces[first][1] != first + 1) break;
      behind = step < 0 ? first : first + 1;
    }
    return (x[tip.point] - x[behind]).normalized();
  }
  /// Area of a piece (length in two dimensions) times the unit normal to its upper side, for the corners `c` [length^2
  /// or length].
  static Vec<Dim> area(const std::array<Vec<Dim>, static_cast<std::size_t>(Dim)>& c) {
    if constexpr (Dim == 2)
      return {c[0][1] - c[1][1], c[1][0] - c[0][0]};
    else
      return 0.5 * (c[1] - c[0]).cross(c[2] - c[0]);
  }
};

/// Saves and restores a crack. A saved crack may have grown, so the missing points are added first: all lists of
/// points then have the size that was saved. The velocities that joints prescribe are computed in every step and are
/// not saved.
template <int Dim>
void archive(Archive& a, Crack<Dim>& crack) {
  auto& [law, x, face, pieces, inside, main_points, main_pieces, gap, slip, bond, status, traction, is_prescribed,
         prescribed_velocity, tips, initial_bond, fixed, surface] = crack;
  a.version(1);
  std::size_t points = x.size();
  a("points", points);
  while (x.size() < points) crack.add_point(x.size(), Vec<Dim>::Zero());
  a("x", x), a("lower", face[0]), a("upper", face[1]);
  a("drawn_points", main_points), a("drawn_pieces", main_pieces);
  a.resizable("inside", inside);
  pieces.resize(inside.size());
  std::vector<std::uint32_t> corners;
  for (const auto& piece : pieces) corners.insert(corners.end(), piece.begin(), piece.end());
  a("pieces", corners);
  for (std::size_t k = 0; k < corners.size(); ++k) pieces[k / Dim][k % Dim] = corners[k];
  if (std::any_of(corners.begin(), corners.end(), [count = x.size()](auto corner) { return corner >= count; }) ||
      main_points > x.size() || main_pieces > pieces.size())
    refuse_checkpoint("a crack has a corner that does not exist");
  a("gap", gap), a("slip", slip), a("bond", bond), a("status", status), a("traction", traction);
  a("tips", tips);
  for (const CrackTip& tip : tips)
    if (tip.point >= x.size() || tip.previous >= x.size()) refuse_checkpoint("a crack tip has no point");
}

}  // namespace tribo
