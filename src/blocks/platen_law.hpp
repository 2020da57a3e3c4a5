// SPDX-License-Identifier: MIT
/// Law of the contacts between a platen and blocks: springs without strength limit.
#pragma once

#include "contact/joint_parts.hpp"

#include <memory>

namespace tribo {

/// Normal springs E A/d, d from the reference point of the block to its face, with the fictitious stress of that block,
/// so that the layer next to the platen has the strain of the blocks; `rough`: also along the face.
class PlatenLaw final : public JointLaw {
 public:
  /// `modulus` E; 0: as stiff as `like`, whose Poisson's ratio is used in any case. `like` may be null with a modulus.
  PlatenLaw(std::shared_ptr<const JointLaw> like, double modulus, bool rough)
      : like_(std::move(like)), modulus_(modulus), rough_(rough) {}

  Joint start(const JointSite& site) const override {
    Joint j;
    set_area(j, site, 0.0);
    j.kn = modulus_ > 0 ? modulus_ / site.distance : like_->start(site).kn;
    j.ks = rough_ ? j.kn : 0.0;
    j.gap = site.gap;
    return j;
  }

  void adopt(Joint& j, const JointLaw& former, const JointSite& site) const override {
    const auto* before = dynamic_cast<const PlatenLaw*>(&former);
    if (!before) return;
    Joint like = j;
    if (modulus_ > 0 && before->modulus_ > 0)
      like.kn *= modulus_ / before->modulus_;
    else if (modulus_ > 0)
      like.kn = modulus_ / site.distance;
    else if (before->modulus_ > 0)
      like.kn = like_->start(site).kn;
    else
      like_->adopt(like, *before->like_, site);
    if (like.kn == j.kn) return;
    const double kn = like.kn;
    like = j, like.kn = kn, like.ks = rough_ ? kn : 0.0;
    restiffen(j, like, j.gap, [this](const Joint& now) { return energy_of(now); });
  }

  void update(std::span<Joint> joints, std::span<const JointIncrement> increments,
              std::vector<JointEvent>&) const override {
    for (std::size_t k = 0; k < joints.size(); ++k) {
      Joint& j = joints[k];
      const JointIncrement& d = increments[k];
      const double fn = j.Fn;
      const Tangent fs = j.Fs;
      j.Fn += j.kn * j.area * d.normal + d.poisson_normal - j.poisson_normal;
      j.poisson_normal = d.poisson_normal;
      if (rough_) {
        j.Fs += d.poisson_shear - j.poisson_shear - (j.ks * j.area) * d.shear;
        j.poisson_shear = d.poisson_shear;
      }
      j.opening += d.normal, j.shear += d.shear, j.gap = d.gap;
      j.strain = energy_of(j);
      j.work += 0.5 * ((fn + j.Fn) * d.normal - (fs + j.Fs).dot(d.shear));
    }
  }

  bool is_bonded(const Joint&) const override { return true; }
  std::string state_text(const Joint&) const override { return "held"; }
  std::vector<std::string_view> own_names() const override { return {}; }
  std::vector<double> own_values(const Joint&) const override { return {}; }
  double stiffness() const override { return 0.0; }
  bool needs_distance() const override { return true; }
  double poisson() const override { return like_ ? like_->poisson() : 0.0; }
  double off_diagonal() const override { return like_ ? like_->off_diagonal() : 0.0; }

 private:
  double energy_of(const Joint& j) const {
    return spring_energy(j.Fn, j.Fn - j.poisson_normal, j.kn * j.area) +
           (rough_ ? 0.5 * j.Fs.dot(j.Fs - j.poisson_shear) / (j.ks * j.area) : 0.0);
  }

  std::shared_ptr<const JointLaw> like_;
  double modulus_;
  bool rough_;
};

}  // namespace tribo
