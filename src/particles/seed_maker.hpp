// SPDX-License-Identifier: MIT
/// The quantities of a particle at its site.
#pragma once

#include "materials/material.hpp"
#include "model/model.hpp"
#include "particles/cut_cell.hpp"
#include "particles/seed.hpp"
#include "particles/sites.hpp"

namespace tribo {

/// Makes the initial particles of a model. Throws InputError, at the place of the body, for values that are not
/// possible.
class SeedMaker {
 public:
  SeedMaker(const Model& model, const GridBox& grid) : model_(model), grid_(grid) {}

  /// The material law of a body. Throws if `material` is none, or a contact law.
  const Material& law(int material, const Origin& origin) const;
  /// Throws if the piece has an initial stress that its material law does not keep.
  void check_stress(const Piece& piece) const;
  /// Common data of all particles of the piece with number `p`. `volume` lacks the factor radius; `mass` is the density
  /// at this stage.
  Seed pattern(std::size_t p, const Vec3& spacing) const;
  /// The pattern for a cut cell. `whole`: volume of a whole cell, in two dimensions for the thickness 1.
  Seed cut(const Seed& pattern, const CutCell& cell, double whole) const;
  /// The particle of a piece at x: its functions are evaluated there.
  Seed at(const Piece& piece, const Seed& pattern, const Vec3& x) const;
  /// A single particle. `per_axis`: particles per cell along an axis, for the size of its domain.
  Seed at(const PointSpec& point, int per_axis) const;
  /// The particle in a row of the table with this number.
  Seed of_table(std::size_t table, std::size_t row) const;

 private:
  double thickness(const std::optional<double>& own) const;
  void deform(const Piece& piece, const Variables& at, Seed& seed) const;
  void weigh(Seed& seed, double r, const Origin& origin) const;

  const Model& model_;
  const GridBox& grid_;
};

}  // namespace tribo
