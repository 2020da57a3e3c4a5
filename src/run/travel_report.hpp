// SPDX-License-Identifier: MIT
/// The part of the pre-flight report on where bodies go.
#pragma once

#include "model/model.hpp"
#include "particles/seeds.hpp"
#include "run/remarks.hpp"

namespace tribo {

/// Deformable bodies that leave the grid on straight paths; the rotation of each as a rigid body does not count.
Remarks describe_travel(const Model& model, const Seeds& seeds);

}  // namespace tribo
