// SPDX-License-Identifier: MIT
/// What the joint laws share: tables, dashpots, areas, words of the input.
#pragma once

#include "contact/joint_law.hpp"

#include <optional>
#include <utility>

namespace tribo {

/// The part of a strength that is left, over a displacement: straight lines between points, 0 from the last on.
class MultiplierTable {
 public:
  MultiplierTable() = default;
  /// Reads all <`name`> of a material, `multiplier displacement` pairs in the order of the displacements.
  MultiplierTable(const Statement& material, const std::string& name, const Units& units, Problems& problems);
  bool empty() const { return points_.empty(); }
  double at(double displacement) const;

 private:
  struct Point {
    double multiplier, displacement;
  };
  std::vector<Point> points_;  // the first at displacement 0
};

/// Linear falloff from 1 at 0 to 0 at `length`, or the table if there is one.
inline double remaining(const MultiplierTable& table, double length, double displacement) {
  return table.empty() ? std::max(0.0, 1 - displacement / length) : table.at(displacement);
}

/// Forces c v with c = 2 beta sqrt(m k A).
struct Dashpots {
  double normal = 0.0, shear = 0.0;  ///< shares of critical damping
  double mode = 0.0;                 ///< bit 0: no tension from the normal one; bit 1: none in shear while sliding
  void act(Joint& joint, const JointIncrement& step) const;
};

/// Sets area, radius and moments for strengths; keeps the site's area unless `user_area` > 0.
void set_area(Joint& joint, const JointSite& site, double user_area);
/// I_s, I_t, I_st of a face for its bending stiffness, and J.
std::array<double, 4> stiffness_moments(const Joint& joint, const JointSite& site);

/// 1/2 F^2/k of two forces, 0 without stiffness.
inline double spring_energy(double force, double elastic, double stiffness) {
  return stiffness > 0 ? 0.5 * force * elastic / stiffness : 0.0;
}
/// Adds the trapezoidal work of the step on the springs, from the state before it.
void add_work(Joint& joint, const Joint& before, const JointIncrement& step);

/// The numbers of <`name`>, or none; problems unless there are `least` to `most` of them.
std::vector<double> numbers_of(const Statement& material, const std::string& name, std::size_t least, std::size_t most,
                               Problems& problems);

/// Complains about results and methods that cannot be given as properties. True if `child` was such.
struct RefusedProperty {
  std::string_view name, why;
};
void refuse(const Statement& material, std::span<const RefusedProperty> refused, Problems& problems);

/// `dp_...` and `dashpot-...` values must be whole numbers; likewise for switches.
void must_be_whole(const Statement& material, std::initializer_list<const char*> names, Problems& problems);

}  // namespace tribo
