// SPDX-License-Identifier: MIT
#include "contact/interface_joint.hpp"

#include "contact/joint_parts.hpp"

namespace tribo {

Joint InterfaceJoint::start(const JointSite& site) const {
  Joint joint;
  joint.area = site.area;
  joint.kn = law_->bonds_normal() ? 0.0 : law_->stiffness();
  joint.ks = law_->bonds_tangential() ? 0.0 : law_->stiffness();
  return joint;
}

void InterfaceJoint::update(std::span<Joint> joints, std::span<const JointIncrement> increments,
                            std::vector<JointEvent>&) const {
  for (std::size_t k = 0; k < joints.size(); ++k) {
    Joint& joint = joints[k];
    const Joint before = joint;
    const JointIncrement& step = increments[k];
    joint.opening += step.normal, joint.shear = joint.shear + step.shear, joint.gap = joint.opening;
    const double shear = joint.shear.norm();
    const auto [normal, tangential, energy] = law_->traction(joint.opening, shear);
    joint.Fn = joint.area * normal;
    joint.Fs = (shear > 0 ? -joint.area * tangential / shear : 0.0) * joint.shear;
    joint.strain = joint.area * energy;
    add_work(joint, before, step);
  }
}

}  // namespace tribo
