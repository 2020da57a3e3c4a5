// SPDX-License-Identifier: MIT
/// Volume ratios that kinds of matter reach in ordinary use.
#pragma once

#include "model/model.hpp"
#include "solver/particle_quality.hpp"

#include <limits>

namespace tribo {

/// The range of a material. Outside of it a solid is crushed or torn, so that the run has probably gone wrong. Gases
/// take any volume; sand, clay, liquids and cracked matter come apart without a limit.
inline VolumeRange ordinary_volume(const MaterialSpec& material) {
  constexpr double unlimited = std::numeric_limits<double>::infinity();
  if (material.type == "IdealGas") return {0.0, unlimited};
  for (const std::string_view law : {"MohrCoulomb", "DruckerPrager", "CamClay", "TaitLiquid", "IsoSoftening"})
    if (material.type == law) return {0.5, unlimited};
  return {};
}

}  // namespace tribo
