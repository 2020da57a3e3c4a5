// SPDX-License-Identifier: MIT
/// Units of the results of a run.
#pragma once

#include "model/model.hpp"

#include <map>
#include <string>

namespace tribo {

/// A generic unit of the tables of fields and quantities, such as `mass velocity`, `length^2` or `energy`, in the units
/// of a model; empty for `-`. Words that are no dimension stay as they are.
std::string unit_in(const Units& units, std::string_view generic);

/// The units of the fields of particle files and of the columns of history.csv and energy.csv, by their names. What has
/// no unit is left out.
std::map<std::string, std::string> units_of_results(const Model& model);

}  // namespace tribo
