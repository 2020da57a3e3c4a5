// SPDX-License-Identifier: MIT
/// Numbers of a model that look as if they were in other units.
#pragma once

#include "model/model.hpp"
#include "particles/seeds.hpp"

#include <string>
#include <vector>

namespace tribo {

/// The units of the model, and those of the numbers in its file if these are the legacy ones.
std::string line_of_units(const Model& model);

/// "down 9.81 (along -y)"; in three dimensions there is no word for the direction.
std::string words_of_gravity(const Model& model);

/// Remarks on a gravity that has the digits of 9.81 m/s^2 but another size, and on one that acts upwards.
std::vector<std::string> remarks_on_gravity(const Model& model);

/// Remarks on gravity, on densities, wave speeds and friction angles that are unusual for a solid, and on bodies that
/// are too soft for their own weight.
std::vector<std::string> remarks_on_units(const Model& model, const Seeds& seeds);

}  // namespace tribo
