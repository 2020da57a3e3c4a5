// SPDX-License-Identifier: MIT
/// Cracks and their growth.

#include "base/schema.hpp"
#include "base/text.hpp"
#include "input/script/translator.hpp"

#include <array>

namespace tribo::script {
namespace {

// The number of a name, or the number itself.
std::string code(const Command& c, std::size_t k, const std::vector<std::pair<std::string, std::string>>& all) {
  const std::string given = c.text(k);
  std::vector<std::string> names;
  for (const auto& [name, number] : all) {
    if (lower(name) == lower(given) || number == given) return number;
    names.push_back(name);
  }
  throw InputError(c.origin(k),
                   "'" + given + "' is not known here" + did_you_mean(given, names) + "; valid: " + join(names));
}

}  // namespace

// The end of a crack: exterior, free, or the material around the tip.
void Translator::crack_end(Statement& s, const char* name, const Command& c, std::size_t k) {
  if (!c.given(k)) return;
  const std::string end = c.text(k), word = lower(end);
  if (word == "exterior")
    attribute(s, name, "-2", c.origin(k));
  else if (word == "free")
    attribute(s, name, "-1", c.origin(k));
  else
    Document::refer(s, name, end, c.origin(k));
}

Statement& Translator::crack_part(const Command& c, const char* element) {
  if (document_.cracks().empty())
    throw InputError(c.origin(), "'" + c.node.word + "' belongs to a crack; start one with 'NewCrack'");
  Statement s;
  s.name = element, s.origin = c.origin();
  auto& parts = document_.cracks().back().children;
  parts.push_back(std::move(s));
  return parts.back();
}

// The traction law of a part of a crack: the id of a material, or a number.
void Translator::traction_of_part(Statement& s, const Command& c, std::size_t k) {
  if (!c.given(k) || lower(c.text(k)) == "none") return;
  if (to_number(c.text(k)))
    attribute(s, "mat", c.text(k), c.origin(k));
  else
    Document::refer(s, "mat", c.text(k), c.origin(k));
}

void Translator::new_crack(const Command& c) {
  Statement& crack = document_.cracks().emplace_back();
  crack.name = "CrackList", crack.origin = c.origin();
  const bool fixed = c.given(2) && lower(c.text(2)) == "fixed";
  if (fixed) attribute(crack, "type", "fixed", c.origin(2));
  if (c.given(3)) {
    const std::string law = c.text(3);
    if (to_number(law))
      attribute(crack, "friction", law, c.origin(3));
    else if (lower(law) != "traction")
      Document::refer(crack, "law", law, c.origin(3));
  }
  Statement& point = crack_part(c, "pt");
  attribute(point, "x", c.text(0), c.origin(0)), attribute(point, "y", c.text(1), c.origin(1));
  if (!fixed) crack_end(point, "tip", c, 2);
  traction_of_part(point, c, 4);
  crack_x_ = c.text(0), crack_y_ = c.text(1);
}

void Translator::grow_crack(const Command& c) {
  Statement& point = crack_part(c, "pt");
  attribute(point, "x", c.text(0), c.origin(0)), attribute(point, "y", c.text(1), c.origin(1));
  crack_end(point, "tip", c, 2);
  traction_of_part(point, c, 3);
  crack_x_ = c.text(0), crack_y_ = c.text(1);
}

void Translator::grow_crack_line(const Command& c) {
  Statement& line = crack_part(c, "Line");
  attribute(line, "xmin", crack_x_, c.origin()), attribute(line, "ymin", crack_y_, c.origin());
  attribute(line, "xmax", c.text(0), c.origin(0)), attribute(line, "ymax", c.text(1), c.origin(1));
  if (c.given(2)) attribute(line, "resolution", c.text(2), c.origin(2));
  crack_end(line, "end_tip", c, 3);
  traction_of_part(line, c, 4);
  crack_x_ = c.text(0), crack_y_ = c.text(1);
}

// Arguments: bounding box of the ellipse, number of segments, angles.
void Translator::grow_crack_arc(const Command& c) {
  Statement& arc = crack_part(c, "Circle");
  constexpr std::array names{"xmin", "ymin", "xmax", "ymax", "resolution", "start_angle", "end_angle"};
  for (std::size_t k = 0; k < names.size(); ++k) attribute(arc, names[k], c.text(k), c.origin(k));
  crack_end(arc, "end_tip", c, 7);
  traction_of_part(arc, c, 8);
}

Statement& Translator::crack_settings(const Command& c) {
  for (auto& s : document_.section("MPMHeader", c.origin()).children)
    if (s.name == "Cracks") return s;
  return document_.add("MPMHeader", "Cracks", c.origin());
}

// Sets the only element of its name.
Statement& Translator::crack_setting(const Command& c, const char* element) {
  Statement s;
  s.name = element, s.origin = c.origin();
  auto& all = crack_settings(c).children;
  std::erase_if(all, [&](const Statement& old) { return old.name == s.name; });
  all.push_back(std::move(s));
  return all.back();
}

void Translator::contact_of_cracks(const Command& c) {
  Document::refer(crack_setting(c, "Friction"), "law", c.text(0), c.origin(0));
}

void Translator::crack_interface(const Command& c) {
  if (document_.cracks().empty())
    throw InputError(c.origin(), "'" + c.node.word + "' belongs to a crack; start one with 'NewCrack'");
  Statement& crack = document_.cracks().back();
  std::erase_if(crack.attributes, [](const Attribute& a) { return a.name == "friction" || a.name == "law"; });
  attribute(crack, "friction", "11", c.origin());
  for (const Attribute& a : number_law(c).attributes) crack.attributes.push_back(a);
}

void Translator::crack_traction(const Command& c) {
  if (document_.cracks().empty())
    throw InputError(c.origin(), "'" + c.node.word + "' belongs to a crack; start one with 'NewCrack'");
  Statement& crack = document_.cracks().back();
  std::erase_if(crack.attributes, [](const Attribute& a) { return a.name == "Tprop"; });
  if (to_number(c.text(0)))
    attribute(crack, "Tprop", c.text(0), c.origin(0));
  else
    Document::refer(crack, "Tprop", c.text(0), c.origin(0));
}

void Translator::crack_thickness(const Command& c) {
  Statement& s = document_.cracks().empty() ? crack_setting(c, "Thickness") : crack_part(c, "Thickness");
  s.text = c.text(0), s.text_origin = c.origin(0);
}

void Translator::move_plane(const Command& c) {
  Statement& s = crack_setting(c, "MovePlane");
  attribute(s, "type", lower(c.text(0)), c.origin(0));
  if (c.given(1)) attribute(s, "prevent", lower(c.text(1)), c.origin(1));
}

void Translator::propagate(const Command& c) {
  static const std::vector<std::pair<std::string, std::string>> criteria{
      {"none", "0"},           {"max energy release", "1"}, {"steady state", "2"}, {"energy balance", "3"},
      {"energy density", "4"}, {"elliptical", "5"},         {"max ctod", "6"},     {"critical err", "7"}},
      ways{{"default", "0"}, {"self similar", "1"}, {"cod normal", "2"}, {"cod hoop", "3"}, {"initial", "4"}};
  // inside a material it applies to that material
  Statement s;
  s.name = "Propagate", s.origin = c.origin();
  attribute(s, "criterion", code(c, 0, criteria), c.origin(0));
  if (c.given(1)) attribute(s, "direction", code(c, 1, ways), c.origin(1));
  if (c.given(2)) Document::refer(s, "traction", c.text(2), c.origin(2));
  if (open_ == Open::material)
    document_.materials().back().children.push_back(std::move(s));
  else
    crack_setting(c, "Propagate") = std::move(s);
}

void Translator::propagate_length(const Command& c) {
  Statement& s = crack_setting(c, "PropagateLength");
  s.text = c.text(0), s.text_origin = c.origin(0);
}

void Translator::j_contour(const Command& c) {
  Statement& s = crack_setting(c, "JContour");
  attribute(s, "type", "1", c.origin());
  attribute(s, "size", c.text(0), c.origin(0));
  if (c.given(1)) attribute(s, "terms", c.text(1), c.origin(1));
}

}  // namespace tribo::script
