// SPDX-License-Identifier: MIT
/// B-bar: volume changes, and the stresses that answer them, are means over cells, so that bodies that hardly change
/// volume do not lock.
///
///   (A q)_p = sum_q V_q q_q / sum_q V_q,      over the particles q in the cell of p
///   div v <- A div v in the strain,      sigma_m <- A sigma_m in the nodal forces
///
/// The deviators stay. There are as many volume changes as cells, half (in 3D a third) of the number of velocities; one
/// of its own for each particle would be a constraint for each particle. V A is symmetric, so what forces do to the
/// nodes is what stresses do to the strains: energy is kept, and a law that is stable at a point is stable in the
/// body. In plane strain the volumetric part is the mean of the two stresses in the plane.
/// Hughes, Int. J. Numer. Meth. Engng 15 (1980) 1413-1418 for elements; Coombs, Charlton, Cortis & Augarde, CMAME 333
/// (2018) 1-21 for particles.
#pragma once

#include "solver/exchange/exchange.hpp"
#include "solver/transfer/transfer.hpp"

namespace tribo {

template <int Dim>
class BBar {
 public:
  BBar(const Scheme& scheme, System<Dim>& system, const Transfers<Dim>& transfers, const Exchanges<Dim>& exchanges);

  /// Makes room on the present nodes; after every change of the fields' maps.
  void locate();
  /// Lets the strain that `what` is about to gather from a layer of the nodes use mean rates of volume change.
  template <class N>
  void average_rates(Gather& what, AlignedVector<N> Field<Dim>::*layer);
  /// Lets the forces that are about to be scattered use mean volumetric stresses.
  void average_stress();

 private:
  void average(Body<Dim>& body, bool from_start);

  System<Dim>& system_;
  const Transfers<Dim>& transfers_;
  const Exchanges<Dim>& exchanges_;        ///< per field
  std::unique_ptr<Transfers<Dim>> cells_;  ///< null: not asked for
};

}  // namespace tribo
