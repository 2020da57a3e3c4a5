// SPDX-License-Identifier: MIT
/// Which of the possible sums a transfer needs, as compile-time constants: sums that nobody uses are not computed.
#pragma once

#include "solver/transfer/transfer.hpp"

#include <type_traits>

namespace tribo {

/// The sums that a scatter adds to the nodes; the others stay zero.
struct AddedSums {
  bool first = false;   ///< the weight and the first vector of a node
  bool second = false;  ///< the second vector, from the values of the particles and from their fluxes
  bool affine = false;  ///< linear fields about the particles, to the first vector
  bool flux = false;    ///< from the fluxes of the particles, to the first vector
};

/// The values that a gather interpolates; the first vector of a node always is one of them.
struct GatheredSums {
  bool second = false;    ///< the second vector of a node
  bool gradient = false;  ///< of the first vector
  bool affine = false;    ///< moments of the first vector about the particle
};

template <auto value>
inline constexpr std::integral_constant<decltype(value), value> constant{};

/// Calls f(constant) with the sums that a scatter needs. `affine`: the body has affine velocity fields.
template <class F>
void with_added_sums(Scatter what, bool affine, F&& f) {
  switch (what) {
    case Scatter::heat:
      return f(constant<AddedSums{.first = true, .affine = true, .flux = true}>);
    case Scatter::volume:
      return f(constant<AddedSums{.first = true, .second = true}>);
    case Scatter::force:
      return f(constant<AddedSums{.second = true}>);
    case Scatter::momentum_and_force:
      if (affine) return f(constant<AddedSums{.first = true, .second = true, .affine = true}>);
      return f(constant<AddedSums{.first = true, .second = true}>);
    case Scatter::momentum:
      if (affine) return f(constant<AddedSums{.first = true, .affine = true}>);
      return f(constant<AddedSums{.first = true}>);
    case Scatter::filtered:
    case Scatter::heat_residual:
    case Scatter::volumetric:
      return f(constant<AddedSums{.first = true}>);
  }
}

/// Calls f(constant) with the values that a gather needs. `affine`: the body has affine velocity fields (APIC), which
/// replace the velocities of the particles, so that accelerations are not needed.
template <class F>
void with_gathered_sums(const Gather& what, bool affine, F&& f) {
  switch (what.task) {
    case GatherTask::filtered_velocity:
    case GatherTask::damped_velocity:
    case GatherTask::temperature_residual:
    case GatherTask::cell_mean:
      return f(constant<GatheredSums{}>);
    case GatherTask::volume_rate:
    case GatherTask::temperature:
      return f(constant<GatheredSums{.gradient = true}>);
    case GatherTask::update:
      if (!what.move) return f(constant<GatheredSums{.gradient = true}>);
      if (affine) return f(constant<GatheredSums{.gradient = true, .affine = true}>);
      if (what.strain_dt > 0) return f(constant<GatheredSums{.second = true, .gradient = true}>);
      return f(constant<GatheredSums{.second = true}>);
  }
}

/// Calls f(gathered, added) with constants for the pairs of a gather and a scatter that one pass over the particles can
/// do; returns false for all others.
template <class F>
bool with_sums_of_both(const Gather& what, Scatter sums, bool affine, F&& f) {
  const bool update = what.task == GatherTask::update;
  if (what.task == GatherTask::filtered_velocity && sums == Scatter::filtered) {
    f(constant<GatheredSums{}>, constant<AddedSums{.first = true}>);
  } else if (update && !what.move && sums == Scatter::force) {
    f(constant<GatheredSums{.gradient = true}>, constant<AddedSums{.second = true}>);
  } else if (update && what.move && !(what.strain_dt > 0) && sums == Scatter::momentum) {
    if (affine)
      f(constant<GatheredSums{.affine = true}>, constant<AddedSums{.first = true, .affine = true}>);
    else
      f(constant<GatheredSums{.second = true}>, constant<AddedSums{.first = true}>);
  } else {
    return false;
  }
  return true;
}

}  // namespace tribo
