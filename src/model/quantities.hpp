// SPDX-License-Identifier: MIT
/// Names of what can be asked for: columns of history.csv and fields of the particle files. The one list that the
/// reader, the manual and the output share.
#pragma once

#include "base/units.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace tribo {

/// What a quantity may be asked of.
enum class Scope {
  run,       ///< only of all
  material,  ///< of one material, too
  particle   ///< of one particle, too
};

struct QuantityInfo {
  std::string_view name;
  std::string_view unit;     ///< generic, e.g. `velocity`
  std::string_view meaning;  ///< one phrase
  Scope scope;               ///< of a field of the particle files: particle
};

/// Global quantities, by the dialect's names and Tribo's own.
const std::vector<QuantityInfo>& global_quantities();
/// The entry of this name in any case, or of what the dialect calls it (`temp`, `sRR`), or null.
const QuantityInfo* find_global_quantity(std::string_view name);

/// Quantities of models of blocks.
struct BlockQuantityInfo {
  std::string_view name, unit, meaning;
  enum class Of { run, platen, block } of;
};
const std::vector<BlockQuantityInfo>& block_quantities();
/// The entry of this name in any case for what it is asked of, or null.
const BlockQuantityInfo* find_block_quantity(std::string_view name, BlockQuantityInfo::Of of);

/// Fields of the particle files.
const std::vector<QuantityInfo>& particle_fields();
/// The entry of this name in any case, or of what the dialect calls it (`strainenergy`, `history3`), or null.
const QuantityInfo* find_particle_field(std::string_view name);

}  // namespace tribo
