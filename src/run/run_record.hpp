// SPDX-License-Identifier: MIT
/// What provenance.json tells of a model.
#pragma once

#include "output/provenance.hpp"
#include "run/run_loop.hpp"

namespace tribo {

/// Units, title and numbers of particles. `changed`: what has changed on resumption.
std::map<std::string, std::string> facts_of(const Model& model, const SteppedModel& stepped,
                                            const std::string& changed);

/// Units of fields and columns, and the names of materials, bodies and groups of blocks.
RecordedLegend legend_of(const Model& model, const SteppedModel& stepped);

}  // namespace tribo
