// SPDX-License-Identifier: MIT
/// A crack: a surface with two faces that the bodies around it move.
#pragma once

#include "base/archive.hpp"
#include "base/types.hpp"
#include "contact/contact_law.hpp"

#include <array>
#include <cstdint>
#include <vector>

namespace tribo {

/// An end of a crack that lies in a body (two dimensions).
struct CrackTip {
  std::uint32_t point = 0, behind = 0;  ///< of the crack; the crack runs from `behind` to `point`
  int end = 1;                          ///< 0: of the first point, 1: of the last
  bool lives = true;                    ///< false: it came out of the body or met another crack
  std::size_t body = 0;                 ///< around it
  double J = 0.0;                       ///< energy release rate                          [energy/length^2]
  std::array<double, 2> K{};            ///< stress intensities, NaN if there are none    [stress length^1/2]
  double rest = 0.0;                    ///< it does not grow again before               [time]
  Vec<2> start = Vec<2>::Zero();        ///< its direction in the beginning
};

/// The end and the first direction of a tip belong to the model.
inline void archive(Archive& a, CrackTip& tip) {
  auto& [point, behind, end, lives, body, J, K, rest, start] = tip;
  a.version(1);
  a("point", point), a("behind", behind), a("lives", lives), a("body", body);
  a("J", J), a("K", K), a("rest", rest);
}

/// Straight pieces in two dimensions, triangles in three. Seen along a line, or with the corners of a triangle
/// counter-clockwise, the normal points to the left (up): to the upper face.
template <int Dim>
struct Crack {
  using Piece = std::array<std::uint32_t, static_cast<std::size_t>(Dim)>;

  const ContactLaw* law = nullptr;            ///< between the faces; null: they do not see each other
  std::vector<Vec<Dim>> x;                    ///< points: halfway between the faces                      [length]
  std::array<std::vector<Vec<Dim>>, 2> face;  ///< the same points on the lower (0) and upper (1) face    [length]
  std::vector<Piece> pieces;
  std::vector<double> inside;                      ///< part of each piece that lay in bodies at the start
  std::size_t drawn_points = 0, drawn_pieces = 0;  ///< the others go on from where the crack leaves a body
  std::vector<double> gap;         ///< sum of what they parted along the normal                 [length]
  std::vector<double> slip;        ///< way slid since the faces last stuck                    [length]
  std::vector<double> bond;        ///< 1 whole, -1 broken, 0 none
  std::vector<double> status;      ///< in the last step: 0 open, 1 stick, 2 slip
  std::vector<Vec<Dim>> traction;  ///< on the lower face in the last step                     [stress]
  std::vector<char> is_led;        ///< points whose faces joints lead in this step; empty: none
  std::vector<std::array<Vec<Dim>, 2>> led_velocity;  ///< their velocities
  std::vector<CrackTip> tips;
  double whole_bond = 0.0;  ///< `bond` of new points
  bool fixed = false;       ///< x stays where it is

  /// Puts a point with closed faces before the k-th.
  void add_point(std::size_t k, const Vec<Dim>& at) {
    const auto insert = [&](auto& list, const auto& value) {
      list.insert(list.begin() + static_cast<std::ptrdiff_t>(k), value);
    };
    insert(x, at), insert(face[0], at), insert(face[1], at), insert(traction, Vec<Dim>(Vec<Dim>::Zero()));
    insert(gap, 0.0), insert(slip, 0.0), insert(bond, whole_bond), insert(status, 0.0);
    if (is_led.empty()) return;
    const Vec<Dim> still = Vec<Dim>::Zero();
    insert(is_led, char{0}), insert(led_velocity, std::array{still, still});
  }

  std::array<Vec<Dim>, static_cast<std::size_t>(Dim)> corners(std::size_t piece) const {
    std::array<Vec<Dim>, static_cast<std::size_t>(Dim)> out;
    for (std::size_t k = 0; k < out.size(); ++k) out[k] = x[pieces[piece][k]];
    return out;
  }
  /// Upper minus lower face.
  Vec<Dim> opening(std::size_t point) const { return face[1][point] - face[0][point]; }
  /// Of all points: mean of the pieces around them.
  std::vector<Vec<Dim>> normals() const {
    std::vector<Vec<Dim>> out(x.size(), Vec<Dim>::Zero());
    for (std::size_t p = 0; p < pieces.size(); ++p)
      for (const auto point : pieces[p]) out[point] += area(corners(p));
    for (auto& n : out) n.normalize();
    return out;
  }
  /// Normal times area of a piece, to the upper side (length in two dimensions).
  static Vec<Dim> area(const std::array<Vec<Dim>, static_cast<std::size_t>(Dim)>& c) {
    if constexpr (Dim == 2)
      return {c[0][1] - c[1][1], c[1][0] - c[0][0]};
    else
      return 0.5 * (c[1] - c[0]).cross(c[2] - c[0]);
  }
};

/// A crack may have grown: its points are added first, so that all lists of points have the size that was saved. The
/// velocities that joints prescribe are set anew in every step.
template <int Dim>
void archive(Archive& a, Crack<Dim>& crack) {
  auto& [law, x, face, pieces, inside, drawn_points, drawn_pieces, gap, slip, bond, status, traction, is_led,
         led_velocity, tips, whole_bond, fixed] = crack;
  a.version(1);
  std::size_t points = x.size();
  a("points", points);
  while (x.size() < points) crack.add_point(x.size(), Vec<Dim>::Zero());
  a("x", x), a("lower", face[0]), a("upper", face[1]);
  a("drawn_points", drawn_points), a("drawn_pieces", drawn_pieces);
  a.resizable("inside", inside);
  pieces.resize(inside.size());
  std::vector<std::uint32_t> corners;
  for (const auto& piece : pieces) corners.insert(corners.end(), piece.begin(), piece.end());
  a("pieces", corners);
  for (std::size_t k = 0; k < corners.size(); ++k) pieces[k / Dim][k % Dim] = corners[k];
  a("gap", gap), a("slip", slip), a("bond", bond), a("status", status), a("traction", traction);
  a("tips", tips);
}

}  // namespace tribo
