// SPDX-License-Identifier: MIT
/// Strain and rotation of a deformation gradient F = V R.
#pragma once

#include "base/types.hpp"

namespace tribo {

/// Biot strain in present axes, V - 1: the change of length per initial length of the lines that now lie along its
/// principal axes. Equals the small strain where displacements are small.
Mat3 biot_strain(const Mat3& F);

/// Axis of R times its angle [rad].
Vec3 rotation_of(const Mat3& F);

}  // namespace tribo
