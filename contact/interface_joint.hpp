// SPDX-License-Identifier: MIT
/// Imperfect interfaces as joints: the elastic directions of an interface law at points that keep their own jump.
#pragma once

#include "contact/interface.hpp"
#include "contact/joint_law.hpp"

namespace tribo {

/// The elastic directions of an interface law as a joint law. The displacement jump of a joint is the sum of its
/// increments, and the force is the derivative of the stored energy A phi(jump). Since a host interpolates the jump and
/// distributes the force with the same weights, the energy that the interface returns is the energy it stored.
class InterfaceJoint final : public JointLaw {
 public:
  explicit InterfaceJoint(std::shared_ptr<const InterfaceLaw> law) : law_(std::move(law)) {}

  Joint start(const JointSite& site) const override;
  void update(std::span<Joint> joints, std::span<const JointIncrement> increments,
              std::vector<JointEvent>& events) const override;
  std::string state_text(const Joint&) const override { return "elastic"; }
  std::vector<std::string_view> own_names() const override { return {}; }
  std::vector<double> own_values(const Joint&) const override { return {}; }
  double stiffness() const override { return law_->stiffness(); }

 private:
  std::shared_ptr<const InterfaceLaw> law_;
};

}  // namespace tribo
