// SPDX-License-Identifier: MIT
/// Materials whose particles move as prescribed and carry no stress.
#pragma once

#include "materials/material.hpp"

namespace tribo {

/// Material without stress from a parameter struct. The motion is prescribed by the model
/// (MaterialSpec::rigid_velocity).
template <class Law>
class RigidBody final : public Material {
 public:
  explicit RigidBody(const Law&) {}
  void update(const MaterialPoints<2>&) const override {}
  void update(const MaterialPoints<3>&) const override {}
  double density() const override { return 1.0; }
  double wave_modulus() const override { return 0.0; }
  const std::vector<HistoryVariable>& history() const override {
    static const std::vector<HistoryVariable> none;
    return none;
  }
  bool rigid() const override { return true; }
};

}  // namespace tribo
