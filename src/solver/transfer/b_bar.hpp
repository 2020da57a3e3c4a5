// SPDX-License-Identifier: MIT
/// B-bar method: volume changes and mean stresses are averaged over cells, which avoids volumetric locking of nearly
/// incompressible bodies.
///
///   (A q)_p = sum_q V_q q_q / sum_q V_q,      over the particles q in the cell of p
///   div v <- A div v in the strain,      sigma_m <- A sigma_m in the nodal forces
///
/// The deviators do not change. There are as many independent volume changes as cells, half (in 3D a third) of the
/// number of nodal velocity components; without averaging there would be one constraint per particle. V A is
/// symmetric, so the work of the nodal forces equals the work of the stresses: energy is conserved, and a material
/// that is stable at a point is stable in the body. In plane strain the volumetric part is the mean of the two normal
/// stresses in the plane.
/// Hughes, Int. J. Numer. Meth. Engng 15 (1980) 1413-1418 for elements; Coombs, Charlton, Cortis & Augarde, CMAME 333
/// (2018) 1-21 for particles.
#pragma once

#include "solver/distribution/distribution.hpp"
#include "solver/exchange/exchange.hpp"
#include "solver/transfer/transfer.hpp"

namespace tribo {

/// Averages volume changes and volumetric stresses over cells. Without B-bar in the scheme, all functions do nothing.
template <int Dim>
class BBar {
 public:
  BBar(const Scheme& scheme, System<Dim>& system, const Transfers<Dim>& transfers, const Exchanges<Dim>& exchanges,
       Distribution<Dim>& distribution);

  bool active() const { return cells_ != nullptr; }
  /// Allocates the cell values. To be called after every change of the block maps of the fields.
  void locate();
  /// Computes the cell means of the rate of volume change from a nodal layer and selects them in `what`, the options
  /// of the next strain update.
  template <class N>
  void average_rates(Gather& what, AlignedVector<N> Field<Dim>::*layer);
  /// Computes the cell means of the volumetric stress for the next scatter of forces.
  void average_stress();

 private:
  void average(Body<Dim>& body, bool from_start);

  System<Dim>& system_;
  const Transfers<Dim>& transfers_;
  const Exchanges<Dim>& exchanges_;  ///< per field
  Distribution<Dim>& distribution_;
  std::unique_ptr<Transfers<Dim>> cells_;  ///< null: B-bar is not active
};

}  // namespace tribo
