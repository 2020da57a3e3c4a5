// SPDX-License-Identifier: MIT
/// Cracks, and criteria of their growth.
#pragma once

#include "base/statement.hpp"
#include "base/types.hpp"

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace tribo {

class ContactLaw;
class JointLaw;

/// A crack of the input: straight segments in two dimensions, triangles in three.
struct CrackSpec {
  std::vector<Vec3> points;
  std::vector<std::array<std::uint32_t, 3>> pieces;  ///< indices of corners; only the first two in two dimensions
  std::shared_ptr<const ContactLaw> law;             ///< between the faces; null: no interaction
  std::shared_ptr<const JointLaw> joint;             ///< used instead of `law` if not null
  /// Type of an end of the line. found: it is a tip if it lies in a body; none: no tip; exterior: it continues to a
  /// free surface.
  enum class End { found, tip, none, exterior };
  std::array<End, 2> ends{};  ///< first and last point
  bool fixed = false;         ///< the crack does not move with the bodies
  Origin origin;
};

/// Criterion and direction of crack growth.
struct Growth {
  enum class When {
    never,
    hoop_stress,     ///< maximum hoop stress: its stress intensity reaches KIc
    energy_density,  ///< minimum strain energy density around the tip reaches the value that belongs to KIc
    empirical,       ///< (K1/KIc)^KIexp + (K2/KIIc)^KIIexp reaches one
    release_rate,    ///< the energy release rate reaches JIc
  };
  /// Direction of growth: that of the criterion, along the crack, normal to the opening displacement, of maximum hoop
  /// stress derived from the opening displacement, or the initial direction of the crack.
  enum class Way { of_criterion, straight_on, normal_to_opening, hoop_of_opening, as_at_start };
  When when = When::never;
  Way way = Way::of_criterion;
};

/// Fracture toughness of a material.
struct Toughness {
  std::optional<double> KIc, KIIc;  ///< [stress length^1/2]
  std::optional<double> JIc;        ///< [energy/length^2]
  double KIexp = 2.0, KIIexp = 2.0;
};

/// Quantities computed at crack tips.
struct FractureSpec {
  double size = 4.0;    ///< radius of the contour of the J integral [cells]
  bool inertia = true;  ///< J includes the inertia term within the contour
  double hop = 0.5;     ///< length by which a tip grows at once [cells]
};

}  // namespace tribo
