// SPDX-License-Identifier: MIT
/// Intersection test of a segment with a facet of a surface, with the side from which it crosses. Exact for any
/// doubles.
///
/// Degenerate cases (a point on the surface, a segment through a corner or along an edge) are resolved by simulation of
/// simplicity: the result is that for points moved by (e, e^2, e^3) with an infinitesimal positive e. Therefore a
/// segment through the common edge of two facets crosses exactly one of them, and reversing the segment or the facet
/// changes only the sign. Edelsbrunner & Mucke, ACM Trans. Graphics 9 (1990) 66-104.
#pragma once

#include "base/types.hpp"

namespace tribo {

/// Side of the line from a to b (of the plane through a, b, c) on which `p` lies: 1 left (the side to which
/// (b - a) x (c - a) points), -1 right. The corners must be distinct (not collinear).
int side_of(const std::array<Vec<2>, 2>& piece, const Vec<2>& p);
int side_of(const std::array<Vec<3>, 3>& piece, const Vec<3>& p);

/// The side on which the segment from `from` to `to` starts if it crosses the facet; 0 if it does not cross it.
int crossing(const std::array<Vec<2>, 2>& piece, const Vec<2>& from, const Vec<2>& to);
int crossing(const std::array<Vec<3>, 3>& piece, const Vec<3>& from, const Vec<3>& to);

}  // namespace tribo
