// SPDX-License-Identifier: MIT
/// Averages the openings of granular bodies over the particles of a cell.
#pragma once

#include "model/model.hpp"
#include "solver/distribution/distribution.hpp"
#include "solver/state/system.hpp"

#include <array>
#include <optional>
#include <vector>

namespace tribo {

/// A granular material without tension opens where it is pulled apart, and carries no pressure before its opening has
/// closed again. The grid resolves the volume of the matter in a cell, but not how it is divided among the particles of
/// the cell: strains that differ within a cell are noise. With an opening of its own for each particle, some particles
/// of sand at rest would stay open for ever while their neighbours carry all of the weight. The particles of a body in
/// one cell therefore have one opening,
///
///   o = ln(sum_p V_p / sum_p V_p exp(-o_p)),      V_p <- V_p exp(o - o_p),      F_p <- F_p exp((o - o_p) / d)
///
/// in d dimensions (not the component of F out of the plane), which keeps the volume of the matter in the cell. A
/// particle that is pressed while it is open closes at once, by the smaller of o and p / K, and loses the pressure that
/// belongs to it; the elastic energy that is released is recorded as dissipation. Bodies do not share their openings.
///
/// The result does not depend on the number of threads.
template <int Dim>
class OpeningAverage {
 public:
  OpeningAverage(const Model& model, System<Dim>& system, Distribution<Dim>& distribution);

  /// Averages the openings of all bodies whose law has any, after the stresses of a step are known.
  void apply();

 private:
  // Volumes of the particles in a cell as they are, and without their openings [length^3].
  struct CellVolume {
    double open = 0, closed = 0;
  };
  // The lowest node of a stencil is in the block of the bin or less than a cell from it, and belongs to the cell of the
  // particle or to the one before. A bin has particles in cells from one before to two behind its block.
  static constexpr int before = 1, edge = block_edge<Dim> + 3;
  static constexpr std::size_t size = Dim == 2 ? edge * edge : edge * edge * edge;
  // What the particles of a bin contribute to the cells of its block and around it.
  using CellVolumes = std::array<CellVolume, size>;

  bool any_open(Body<Dim>& body, std::size_t column);
  void sum_volumes(Body<Dim>& body, std::size_t column, std::size_t bin);
  void set_openings(Body<Dim>& body, const Material::Opening& law, std::size_t bin) const;
  static void set(Body<Dim>& body, const Material::Opening& law, std::size_t i, double opening);
  CellVolumes cell_volumes(const Bins<Dim>& all, std::size_t bin) const;
  std::size_t place_of(Body<Dim>& body, const Index<Dim>& block, std::size_t i) const;

  System<Dim>& system_;
  Distribution<Dim>& distribution_;
  bool plane_stress_;                 // the law then chooses the thickness of each particle: openings are not averaged
  std::vector<CellVolumes> volumes_;  // per bin of a body
  std::vector<char> open_;            // per bin: whether a particle is open
  std::vector<Body<Dim>*> open_bodies_;
};

}  // namespace tribo
