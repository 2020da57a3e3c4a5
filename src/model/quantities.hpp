// SPDX-License-Identifier: MIT
/// Output quantities: columns of history.csv and fields of the particle files. The reader, the manual and the output
/// use the same list.
#pragma once

#include "base/units.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace tribo {

/// What a quantity can refer to.
enum class Scope {
  run,       ///< the whole model only
  material,  ///< the whole model or one material
  particle   ///< the whole model, one material or one particle
};

struct QuantityInfo {
  std::string_view name;
  std::string_view unit;     ///< generic, e.g. `velocity`
  std::string_view meaning;  ///< one phrase
  Scope scope;               ///< fields of the particle files: Scope::particle
};

/// Quantities of history.csv, with the names of NairnMPM and additional ones.
const std::vector<QuantityInfo>& global_quantities();
/// The entry with this name, in any case, or with an alternative name of NairnMPM (`temp`, `sRR`); null if there is
/// none.
const QuantityInfo* find_global_quantity(std::string_view name);

/// Quantities of history.csv in models of rigid blocks.
struct BlockQuantityInfo {
  std::string_view name, unit, meaning;
  enum class Of { run, platen, block } of;
};
const std::vector<BlockQuantityInfo>& block_quantities();
/// The entry with this name, in any case, for a run, platen or block; null if there is none.
const BlockQuantityInfo* find_block_quantity(std::string_view name, BlockQuantityInfo::Of of);

/// Fields of the particle files.
const std::vector<QuantityInfo>& particle_fields();
/// The entry with this name, in any case, or with an alternative name of NairnMPM (`strainenergy`, `history3`); null if
/// there is none.
const QuantityInfo* find_particle_field(std::string_view name);

}  // namespace tribo
