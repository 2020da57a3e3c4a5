// SPDX-License-Identifier: MIT
/// Which particles and blocks of a state the live page draws.
#pragma once

#include "view/scene_cache.hpp"

#include <array>
#include <set>

namespace tribo {

/// A section plane normal to an axis: what lies on its far side is left out.
struct Section {
  std::size_t axis = 0;  ///< 0 to 2
  double place = 0.0;    ///< [length]
  bool above = false;    ///< whether what lies above the plane is left out, else what lies below
  bool operator==(const Section& other) const = default;
  bool leaves_out(const std::array<double, 3>& x) const { return above ? x[axis] > place : x[axis] < place; }
};

/// What the page asks for.
struct Wanted {
  std::set<int> hidden;         ///< numbers of materials
  std::set<int> hidden_bodies;  ///< numbers of bodies
  std::set<int> hidden_groups;  ///< numbers of groups of blocks
  std::vector<Section> sections;
  std::size_t most = 250000;  ///< particles at most
  bool operator==(const Wanted& other) const = default;
};

/// The particles to draw, by their index in the file.
struct Drawn {
  std::vector<std::uint32_t> particles;
  std::size_t visible = 0;  ///< particles that are neither hidden nor cut away
  std::size_t inside = 0;   ///< of these, those that others hide from all sides
  /// Factor of the sizes of the domains, so that thinned particles fill the same space.
  double growth = 1.0;
};

/// In space, particles with neighbours on all sides are left out, since nobody sees them; if more than `most` remain,
/// they are thinned evenly in space.
Drawn drawn(const KnownScene& known, const Wanted& wanted);

/// At most `most` of the places, by their index: one of each box of a lattice. `size`: the edge of the boxes, at first
/// at least.
std::vector<std::uint32_t> thinned(const std::vector<std::array<double, 3>>& places,
                                   const std::vector<std::uint32_t>& list, std::size_t most, double& size);

/// The blocks without those that are hidden or whose centres are cut away.
CellFrame visible_cells(const CellFrame& cells, const Wanted& wanted);

}  // namespace tribo
