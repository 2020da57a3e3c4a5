// SPDX-License-Identifier: MIT
/// What a run contains when a stage ends.
#pragma once

#include "base/types.hpp"

namespace tribo {

/// Compared with the same after the next stage has begun: the difference is what this stage has brought.
struct StageBalance {
  double content = 0.0;          ///< of energy                                         [energy]
  double kinetic = 0.0;          ///< kinetic energy of particles                       [energy]
  double of_blocks = 0.0;        ///< content of energy of rigid blocks                 [energy]
  Vec3 momentum = Vec3::Zero();  ///< of particles                                      [mass velocity]
};

}  // namespace tribo
