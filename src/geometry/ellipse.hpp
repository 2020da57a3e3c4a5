// SPDX-License-Identifier: MIT
/// Ellipses with semi-axes along x and y about the origin.
#pragma once

namespace tribo {

struct Ellipse {
  double a, b;  ///< semi-axes along x and y [length]

  /// Distance of (x, y) from the edge, from inside or outside. Eberly, Distance from a Point to an Ellipse (2013).
  double distance(double x, double y) const;
  /// Length of the edge: 4 a E(e) with the complete elliptic integral of the second kind.
  double perimeter() const;
  /// Smallest radius of curvature of the edge.
  double sharpest() const;
  /// Area of the sector from polar angle `start` counterclockwise over `span` [rad].
  double sector(double start, double span) const;
};

/// A range of polar angles, counterclockwise from `start`; equal ends or a full turn: all angles.
class Angles {
 public:
  Angles(double start, double end);
  bool contains(double x, double y) const;  ///< whether the direction of (x, y) is in the range; true for the origin
  bool full() const { return full_; }
  double start() const { return start_; }
  double span() const { return span_; }

 private:
  double start_, span_;
  bool full_;
};

}  // namespace tribo
