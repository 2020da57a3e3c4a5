// SPDX-License-Identifier: MIT
/// Imperfect interfaces in a grid of given cell size.
#pragma once

#include "contact/interface.hpp"
#include "grid/lattice.hpp"
#include "materials/material.hpp"
#include "model/model.hpp"

#include <algorithm>
#include <limits>
#include <span>

namespace tribo {

/// An interface law between two materials, with directions bonded that are stiffer than 30 M/h, where M is the wave
/// modulus of the softer deformable material and h the cell size. The opening of such an interface is below a thirtieth
/// of the elongation of a cell, and its oscillation would need a time step below a fifth of that of the material.
/// `materials`: numbers of the materials on both sides; for a crack, of all deformable bodies.
template <int Dim>
std::shared_ptr<const InterfaceLaw> limited_interface(const Model& model, const Lattice<Dim>& lattice,
                                                      const InterfaceLaw& law, std::span<const int> materials) {
  constexpr double stiffest = 30.0;  // M/h
  double modulus = std::numeric_limits<double>::infinity();
  for (const int m : materials) {
    const auto& material = *model.materials[static_cast<std::size_t>(m)].law;
    if (!material.rigid() && material.wave_modulus() > 0) modulus = std::min(modulus, material.wave_modulus());
  }
  return law.limited(stiffest * modulus / lattice.spacing.maxCoeff());
}

}  // namespace tribo
