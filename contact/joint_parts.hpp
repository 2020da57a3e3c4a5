// SPDX-License-Identifier: MIT
/// Helpers shared by the joint laws: strength multiplier tables, dashpots, areas and the reading of their properties.
#pragma once

#include "base/expression.hpp"
#include "contact/joint_law.hpp"

#include <optional>
#include <utility>

namespace tribo {

/// Fraction of a strength that remains as a function of displacement. It is linear between the given points and 0 from
/// the last point on.
class MultiplierTable {
 public:
  MultiplierTable() = default;
  /// Reads all children <`name`> of a material. Each holds pairs `multiplier displacement`, sorted by displacement.
  MultiplierTable(const Statement& material, const std::string& name, const Units& units, Problems& problems);
  bool empty() const { return points_.empty(); }
  /// Multiplier at a displacement [length]; 0 beyond the last point.
  double at(double displacement) const;

 private:
  struct Point {
    double multiplier, displacement;
  };
  std::vector<Point> points_;  // the first at displacement 0
};

/// Fraction that remains at `displacement`: linear from 1 at 0 to 0 at `length`, or the table if there is one.
inline double remaining(const MultiplierTable& table, double length, double displacement) {
  return table.empty() ? std::max(0.0, 1 - displacement / length) : table.at(displacement);
}

/// Pore pressure as a function of x, y, z and t, which a law has in addition to a constant one.
class PressureFunction {
 public:
  PressureFunction() = default;
  /// Reads the child <`name`> of a material.
  PressureFunction(const Statement& material, const char* name, const Units& units, Problems& problems);
  /// Value at a place and a time [stress]; 0 if there is no function.
  double at(const Vec3& x, double time) const {
    return unit_ > 0 ? unit_ * function_(Variables::at(x, time / time_unit_)) : 0.0;
  }
  bool given() const { return unit_ > 0; }

 private:
  Expression function_;
  double unit_ = 0.0;       // stress of a value 1; 0: no function
  double time_unit_ = 1.0;  // time that is 1 in the function
};

/// Viscous forces c v on both faces, c = 2 beta sqrt(m k A), with m the effective mass m1 m2/(m1 + m2).
struct Dashpots {
  double normal = 0.0, shear = 0.0;  ///< beta, fractions of critical damping
  double mode = 0.0;  ///< bit 0: the normal dashpot exerts no net tension; bit 1: no shear dashpot while sliding
  double largest_ratio() const { return normal > shear ? normal : shear; }
  /// Sets the dashpot forces of `joint` for this step and adds their work.
  void act(Joint& joint, const JointIncrement& step) const;
};

/// Areas given by a user, which replace those of the host.
class UserAreas {
 public:
  UserAreas() = default;
  /// Reads the children <`names`> of a material, of which at most one may hold numbers: positive, one or one for each
  /// contact. An empty <area/> is the method that keeps the initial area, which is always kept.
  UserAreas(const Statement& material, std::initializer_list<const char*> names, Problems& problems);
  std::span<const double> all() const { return areas_; }
  /// The area of a contact [length^2]; 0: none given.
  double of(std::size_t contact) const {
    return areas_.size() > 1 ? areas_.at(contact) : areas_.empty() ? 0.0 : areas_[0];
  }

 private:
  std::vector<double> areas_;
};

/// Sets the area, and the radius R and moments I, J used by the strength criteria, from the site. The area of a ball
/// follows from its radius. `user_area` > 0 replaces the area of the site.
void set_area(Joint& joint, const JointSite& site, double user_area);
/// Second moments I_s, I_t, I_st for the bending stiffness, and the polar moment J for the twist stiffness [length^4].
std::array<double, 4> stiffness_moments(const Joint& joint, const JointSite& site);

/// Energy 1/2 F F_e/k of a spring with total force F and elastic force F_e; 0 if it has no stiffness.
inline double spring_energy(double force, double elastic, double stiffness) {
  return stiffness > 0 ? 0.5 * force * elastic / stiffness : 0.0;
}
/// Gives a contact whose forces stay as they are the area and the stiffnesses of `like`: the gap at zero force follows,
/// and the change of the stored energy, which `energy(joint)` computes, is not counted as released. `overlap_gap`: the
/// gap less that at which faces count as closed [length].
template <class Energy>
void restiffen(Joint& j, const Joint& like, double overlap_gap, Energy&& energy) {
  const double before = j.strain, then = j.kn * j.area, now = like.kn * like.area;
  if (then > 0 && now > 0 && then != now) j.rest_gap = overlap_gap - (overlap_gap - j.rest_gap) * (then / now);
  j.area = like.area, j.radius = like.radius, j.inertia = like.inertia, j.polar = like.polar;
  j.kn = like.kn, j.ks = like.ks, j.twist_stiffness = like.twist_stiffness, j.bend_stiffness = like.bend_stiffness;
  if (j.away) return;
  j.strain = energy(j);
  j.start += j.strain - before;
}
/// Adds the work of the springs in this step by the trapezoidal rule; `before` is the state at the start of the step.
void add_work(Joint& joint, const Joint& before, const JointIncrement& step);

/// The numbers in the child <`name`>, empty if it is absent. A count outside `least` to `most` is reported as a
/// problem.
std::vector<double> numbers_of(const Statement& material, const std::string& name, std::size_t least, std::size_t most,
                               Problems& problems);

/// A property name that cannot be set in the input, and the reason.
struct RefusedProperty {
  std::string_view name, why;
};
/// Reports a problem for each child of `material` that is listed in `refused`.
void refuse(const Statement& material, std::span<const RefusedProperty> refused, Problems& problems);

/// Reports a problem for each of the named properties whose value is not a whole number.
void must_be_whole(const Statement& material, std::initializer_list<const char*> names, Problems& problems);

}  // namespace tribo
