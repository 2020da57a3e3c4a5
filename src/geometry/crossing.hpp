// SPDX-License-Identifier: MIT
/// Does the straight way between two points cross a piece of a surface, and from which side? Exact for any doubles.
///
/// Degenerate places (a point on the surface, a way through a corner, ways along an edge) do not exist: the answers are
/// those for points moved by (e, e^2, e^3), e positive and smaller than any number. So neighbouring pieces never both
/// miss a way or both claim it, and turning the way or the piece round turns the sign and nothing else.
/// Edelsbrunner & Mucke, ACM Trans. Graphics 9 (1990) 66-104.
#pragma once

#include "base/types.hpp"

namespace tribo {

/// Which side of the line from a to b (of the plane through a, b, c) `p` lies on: 1 left (where (b - a) x (c - a)
/// points to), -1 right. The corners must not lie on one point (line).
int side_of(const std::array<Vec<2>, 2>& piece, const Vec<2>& p);
int side_of(const std::array<Vec<3>, 3>& piece, const Vec<3>& p);

/// The side on which the way from `from` to `to` starts if it crosses the piece, else 0.
int crossing(const std::array<Vec<2>, 2>& piece, const Vec<2>& from, const Vec<2>& to);
int crossing(const std::array<Vec<3>, 3>& piece, const Vec<3>& from, const Vec<3>& to);

}  // namespace tribo
