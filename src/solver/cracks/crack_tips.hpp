// SPDX-License-Identifier: MIT
/// Tips of cracks: what drives them, and where they grow (plane analyses).
///
/// The energy release rate is the J integral over a ring of particles around the tip, in the form for domains; stress
/// intensities come from its interaction with the fields of pure modes. Shih, Moran, Nakamura, Int. J. Fracture 30
/// (1986) 79-102; Yau, Wang, Corten, J. Appl. Mech. 47 (1980) 335-341.
#pragma once

#include "materials/material.hpp"
#include "solver/cracks/cracks.hpp"

#include <functional>

namespace tribo {

template <int Dim>
class CrackTips {
 public:
  CrackTips(const Model&, const System<Dim>&, const Cracks<Dim>&, int) {}
};

template <>
class CrackTips<2> {
 public:
  /// Acceleration of matter at x with velocity v that no stress causes.
  using Force = std::function<Vec<2>(const Vec<2>& x, const Vec<2>& v)>;

  /// `width`: nodes of a stencil along an axis.
  CrackTips(const Model& model, System<2>& system, const Cracks<2>& cracks, int width);

  bool active() const { return active_; }
  /// Loads of all tips, from the particles at the start of a step and the accelerations of the nodes in it.
  void measure(const Force& force);
  /// Lets tips grow by what measure() found. True if one did.
  bool grow();

 private:
  struct Ring;
  Ring ring(const Crack<2>& crack, const CrackTip& tip) const;
  void measure(const Crack<2>& crack, CrackTip& tip, const Force& force);
  Vec<2> acceleration(const Body<2>& body, const Vec<2>& x) const;
  double kappa(const ElasticModuli& moduli) const;
  template <class F>
  void each_loaded_face(const Crack<2>& crack, const CrackTip& tip, const Ring& ring, F&& f) const;
  double work_of_faces(const Crack<2>& crack, const CrackTip& tip, const Ring& ring) const;
  std::array<double, 2> work_of_faces_in_modes(const Crack<2>& crack, const CrackTip& tip, const Ring& ring,
                                               const ElasticModuli& moduli) const;
  std::optional<double> angle_of_growth(const Crack<2>& crack, const CrackTip& tip) const;
  void extend(std::size_t crack, CrackTip& tip, double angle);

  const Model& model_;
  System<2>& system_;
  const Cracks<2>& cracks_;
  NodesAround<2> around_;
  bool active_;
  double cell_;
  int beyond_;                                        ///< cells by which a crack goes on beyond a surface
  std::vector<std::optional<ElasticModuli>> moduli_;  ///< by body
};

}  // namespace tribo
