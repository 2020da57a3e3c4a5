// SPDX-License-Identifier: MIT
/// Crack tips in plane analyses: energy release rate, stress intensity factors and growth.
///
/// The energy release rate is the J integral in its domain form over the particles around the tip. The stress
/// intensity factors follow from interaction integrals with the fields of the pure modes. Shih, Moran, Nakamura, Int.
/// J. Fracture 30
/// (1986) 79-102; Yau, Wang, Corten, J. Appl. Mech. 47 (1980) 335-341.
#pragma once

#include "materials/material.hpp"
#include "solver/cracks/cracks.hpp"

#include <functional>

namespace tribo {

/// In three dimensions there are no crack tips.
template <int Dim>
class CrackTips {
 public:
  CrackTips(const Model&, const System<Dim>&, const Cracks<Dim>&, int) {}
};

template <>
class CrackTips<2> {
 public:
  /// Acceleration by body forces and damping at the position x [length] for the velocity v [velocity].
  using Force = std::function<Vec<2>(const Vec<2>& x, const Vec<2>& v)>;

  /// `width`: number of nodes of a stencil along an axis.
  CrackTips(const Model& model, System<2>& system, const Cracks<2>& cracks, int width);

  bool active() const { return active_; }
  /// Computes J and the stress intensity factors of all tips from the particles at the start of a step and the nodal
  /// accelerations of the step.
  void measure(const Force& force);
  /// Extends the tips for which the last measure() satisfies the growth criterion. Returns true if any tip has grown.
  bool grow();
  /// Length of a crack; if there is none of this number, of the longest one [length].
  double longest(std::size_t crack) const;

 private:
  struct TipDomain;
  TipDomain tip_domain(const Crack<2>& crack, const CrackTip& tip) const;
  void measure(const Crack<2>& crack, CrackTip& tip, const Force& force);
  Vec<2> acceleration(const Body<2>& body, const Vec<2>& x) const;
  double kappa(const ElasticModuli& moduli) const;
  template <class F>
  void each_loaded_face(const Crack<2>& crack, const CrackTip& tip, const TipDomain& tip_domain, F&& f) const;
  double work_of_faces(const Crack<2>& crack, const CrackTip& tip, const TipDomain& tip_domain) const;
  std::array<double, 2> work_of_faces_in_modes(const Crack<2>& crack, const CrackTip& tip, const TipDomain& tip_domain,
                                               const ElasticModuli& moduli) const;
  std::optional<double> angle_of_growth(const Crack<2>& crack, const CrackTip& tip) const;
  void extend(std::size_t crack, CrackTip& tip, double angle);

  const Model& model_;
  System<2>& system_;
  const Cracks<2>& cracks_;
  NodesAround<2> nodes_around_;
  bool active_;
  double cell_;
  int extension_cells_;  ///< number of cells by which a crack is extended beyond the surface of a body
  std::vector<std::optional<ElasticModuli>> moduli_;  ///< by body
};

}  // namespace tribo
