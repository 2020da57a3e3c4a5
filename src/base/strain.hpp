// SPDX-License-Identifier: MIT
/// Strain and rotation of a deformation gradient F = V R.
#pragma once

#include "base/types.hpp"

namespace tribo {

/// Biot strain V - 1 in the current configuration. Its principal values are the changes of length per initial length of
/// material lines along its principal axes. For small displacements it equals the small strain tensor.
Mat3 biot_strain(const Mat3& F);

/// Rotation vector of R: axis times angle [rad].
Vec3 rotation_of(const Mat3& F);

}  // namespace tribo
