// SPDX-License-Identifier: MIT
/// Joint laws of contacts between rigid blocks: <Joint> of <Blocks>, and the laws of all other contacts.

#include "base/text.hpp"
#include "contact/joint_law.hpp"
#include "input/builder.hpp"

#include <algorithm>
#include <numbers>

namespace tribo {

// The laws of <Blocks> apply to contacts that no <Joint> fits.
void Builder::block_joints(const Statement& s, BlocksSpec& spec) {
  spec.corners = word(s, "points") == "corners";
  for (const auto& part : s.children)
    if (part.name == "Joint") spec.joints.push_back(block_joint(part, spec));
  const bool named = has(s, "lawname") || has(s, "law");
  if (named) spec.laws = block_laws(s, spec);
  must(named || !has(s, "inherit"), s.origin, "'inherit' needs 'lawname'");
  if (!has(s, "touchname")) {
    if (!named && !spec.joints.empty()) spec.laws.later = spec.joints.front().laws.later;
    return;
  }
  if (word(s, "touchname") == "none") {
    spec.laws.later = nullptr;
    for (auto& [groups, laws] : spec.laws.by_groups) laws[1] = nullptr;
    return;
  }
  spec.laws.later = named_later_law(s);
  for (auto& [groups, laws] : spec.laws.by_groups) {
    const SurfaceProperties surface = SurfaceProperties::between(surfaces_[static_cast<std::size_t>(groups[0])],
                                                                 surfaces_[static_cast<std::size_t>(groups[1])]);
    laws[1] = spec.laws.later ? spec.laws.later->with_surface(surface) : nullptr;
  }
}

std::shared_ptr<const JointLaw> Builder::named_later_law(const Statement& s) {
  const Attribute* a = s.attribute("touchname");
  Statement by_name = s;
  by_name.attributes = {*a};
  by_name.attributes.front().name = "lawname";
  const auto law = joint_of(by_name);
  if (!law) return nullptr;
  JointSite site;
  site.area = site.distance = site.radius = 1.0, site.gap = -1e-3, site.plane = model_.dimension() == 2;
  must(!law->is_bonded(law->start(site)), a->origin,
       "'" + a->text + "' creates bonds, but contacts formed during the run have none; name a law without <bond>");
  site.gap = 1.0 + law->proximity();
  if (law->start(site).away) return law;
  const auto without_bonds = law->for_new_contacts();
  must(without_bonds != nullptr, a->origin,
       "'" + a->text +
           "' does not compute its force from the gap, so it cannot serve contacts formed during the run; use "
           "SpringNetwork or Mohr");
  return without_bonds;
}

// With `inherit` also the laws of every pair of blocks that both have properties of their surface.
BlockLaws Builder::block_laws(const Statement& s, const BlocksSpec& spec) {
  BlockLaws out;
  out.initial = joint_of(s);
  if (!out.initial) return out;
  out.later = out.initial->for_new_contacts();
  if (!yes(word(s, "inherit"))) return out;
  for (std::size_t a = 0; a < spec.groups.size(); ++a)
    for (std::size_t b = a; b < spec.groups.size(); ++b) {
      const SurfaceProperties surface = SurfaceProperties::between(surfaces_[a], surfaces_[b]);
      if (!surface.given()) continue;
      const auto law = out.initial->with_surface(surface);
      must(law != nullptr, s.origin, "this joint law has no surface properties that it could inherit");
      if (!law) return out;
      out.by_groups[{static_cast<std::int32_t>(a), static_cast<std::int32_t>(b)}] = {law, law->for_new_contacts()};
    }
  must(!out.by_groups.empty(), s.origin, "'inherit' has no effect: no two blocks have 'kn', 'ks' or 'fric' in common");
  return out;
}

// Criteria that are not shapes. `spec`: null in a model without blocks.
BlockJoint Builder::joint_criteria(const Statement& s, const BlocksSpec* spec) {
  BlockJoint out;
  out.origin = s.origin;
  for (const char* of_blocks : {"blocks", "with", "kind"})
    must(spec || !has(s, of_blocks), s.origin, std::string("'") + of_blocks + "' is a criterion for rigid blocks");
  if (spec) {
    out.groups[0] = block_groups(s, "blocks", *spec);
    out.groups[1] = !has(s, "with") ? out.groups[0] : block_groups(s, "with", *spec);
  }
  must(has(s, "blocks") || !has(s, "with"), s.origin, "'with' needs 'blocks'");
  out.dip = angle_range(s, "dip", 90), out.dip_direction = angle_range(s, "dipdirection", 360);
  must(!out.dip || (*out.dip)[0] <= (*out.dip)[1], s.origin, "the first angle of 'dip' must not exceed the second");
  if (const std::string kind = word(s, "kind"); !kind.empty())
    out.kind = kind == "balls"   ? BlockPairing::Kind::balls
               : kind == "faces" ? BlockPairing::Kind::faces
                                 : BlockPairing::Kind::ball_on_face;
  return out;
}

BlockJoint Builder::block_joint(const Statement& s, const BlocksSpec& spec) {
  BlockJoint out = joint_criteria(s, &spec);
  out.corners = has(s, "points") ? word(s, "points") == "corners" : spec.corners;
  const std::string when = word(s, "contacts");
  out.at_start = when != "later", out.later = when == "later" || when == "all";
  const bool chooses = has(s, "blocks") || has(s, "with") || out.dip || out.dip_direction || out.kind || out.later;
  if (!s.children.empty() || !chooses) out.where = shapes_of(s);
  out.laws = block_laws(s, spec);
  must(!out.later || !out.laws.initial || out.laws.later, s.origin,
       "this law cannot serve contacts formed during the run; use SpringNetwork or Mohr");
  return out;
}

// Indices of the blocks with the names in an attribute; empty: any.
std::vector<std::int32_t> Builder::block_groups(const Statement& s, const char* attribute, const BlocksSpec& spec) {
  std::vector<std::int32_t> out;
  const Attribute* a = s.attribute(attribute);
  if (!a || a->text == "any") return out;
  for (const std::string& name : words_of(a->text)) {
    const std::size_t before = out.size();
    std::vector<std::string> names;
    for (std::size_t g = 0; g < spec.groups.size(); ++g) {
      if (spec.groups[g].name == name) out.push_back(static_cast<std::int32_t>(g));
      const std::string& known = spec.groups[g].name;
      if (!known.empty() && std::find(names.begin(), names.end(), known) == names.end()) names.push_back(known);
    }
    if (out.size() == before)
      problems_.add(a->origin, "there is no block '" + name + "'" + did_you_mean(name, names) +
                                   (names.empty() ? "; none of them has a name" : "; valid: " + join(names)));
  }
  return out;
}

std::optional<std::array<double, 2>> Builder::angle_range(const Statement& s, const char* attribute, double largest) {
  const Attribute* a = s.attribute(attribute);
  if (!a) return std::nullopt;
  std::vector<double> values;
  for (const std::string& text : words_of(a->text)) values.push_back(to_number(text).value_or(-1));
  const auto valid = [&](double angle) { return angle >= 0 && angle <= largest; };
  if (values.size() != 2 || !valid(values[0]) || !valid(values[1])) {
    problems_.add(a->origin, "'" + std::string(attribute) + "' needs two angles from 0 to " +
                                 std::to_string(static_cast<int>(largest)) + " degrees, not '" + a->text + "'");
    return std::nullopt;
  }
  constexpr double degree = std::numbers::pi / 180;
  return std::array{values[0] * degree, values[1] * degree};
}

}  // namespace tribo
