// SPDX-License-Identifier: MIT
#include "model/blocks.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace tribo {
namespace {

constexpr double turn = 2 * std::numbers::pi;

bool lists(const std::vector<std::int32_t>& groups, std::int32_t group) {
  return groups.empty() || std::find(groups.begin(), groups.end(), group) != groups.end();
}

// An angle in a range of directions, which may contain north.
bool within_directions(const std::array<double, 2>& range, double angle) {
  constexpr double round_off = 1e-9;
  const double x = std::fmod(angle + turn, turn);
  const auto inside = [&](double value) { return value >= range[0] - round_off && value <= range[1] + round_off; };
  if (range[0] > range[1]) return x >= range[0] - round_off || x <= range[1] + round_off;
  return inside(x) || inside(x - turn) || inside(x + turn);
}

}  // namespace

bool BlockJoint::fits(const BlockPairing& contact, bool plane) const {
  constexpr double level = 1e-9;  // rad
  if (!(contact.later ? later : at_start)) return false;
  if (kind && *kind != contact.kind) return false;
  const auto [a, b] = contact.groups;
  if (!(lists(groups[0], a) && lists(groups[1], b)) && !(lists(groups[0], b) && lists(groups[1], a))) return false;
  if (dip || dip_direction) {
    const Eigen::Index up = plane ? 1 : 2;
    const Vec3 n = contact.normal[up] < 0 ? Vec3(-contact.normal) : contact.normal;
    const Vec3 across = n - n[up] * Vec3::Unit(up);  // points where the face descends
    const double angle = std::atan2(across.norm(), n[up]);
    if (dip && !(angle >= (*dip)[0] - level && angle <= (*dip)[1] + level)) return false;
    if (dip_direction && angle > level) {
      const double direction = std::atan2(across[0], plane ? 0.0 : across[1]);
      const bool upright = n[up] < level;  // then it descends to both sides
      if (!within_directions(*dip_direction, direction) &&
          !(upright && within_directions(*dip_direction, direction + std::numbers::pi)))
        return false;
    }
  }
  return !where || where->contains(contact.place);
}

std::size_t BlocksSpec::rule(const BlockPairing& contact, bool plane) const {
  const auto found =
      std::find_if(joints.begin(), joints.end(), [&](const BlockJoint& j) { return j.fits(contact, plane); });
  return static_cast<std::size_t>(found - joints.begin());
}

}  // namespace tribo
