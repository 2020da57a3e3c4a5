// SPDX-License-Identifier: MIT
/// Joint laws and means over joints, for tests of joints in the grid.
#pragma once

#include "contact/joint_cases.hpp"
#include "solver/state/system.hpp"

namespace tribo::test {

inline std::shared_ptr<const JointLaw> joint(const Properties& properties, const char* type = "Mohr") {
  Problems problems;
  std::shared_ptr<const JointLaw> law =
      joint_laws().find(type)->make(joint_statement(properties), {}, Units{}, problems);
  problems.raise();
  return law;
}

inline const Properties strong{{"tension", "1e12"}, {"cohesion", "1e12"}};

/// Whole area, and means over it.
struct JointSums {
  double opening = 0, shear = 0, area = 0;
};
template <int Dim>
JointSums means(const System<Dim>& system, const Vec3& along) {
  JointSums out;
  const auto& surface = system.joints[0];
  for (std::size_t k = 0; k < surface.joints.size(); ++k) {
    const Joint& j = surface.joints[k];
    out.area += j.area, out.opening += j.area * j.opening;
    out.shear += j.area * surface.axes[k].vector(j.shear).dot(along);
  }
  out.opening /= out.area, out.shear /= out.area;
  return out;
}

}  // namespace tribo::test
