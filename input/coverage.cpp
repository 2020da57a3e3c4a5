// SPDX-License-Identifier: MIT
#include "input/coverage.hpp"

#include "base/text.hpp"
#include "contact/contact_law.hpp"
#include "contact/joint_law.hpp"
#include "input/common_properties.hpp"
#include "input/dialect.hpp"
#include "input/script/commands.hpp"
#include "materials/material.hpp"
#include "model/output_fields.hpp"
#include "model/quantities.hpp"

#include <algorithm>
#include <array>

namespace tribo {
namespace {

using Kind = DialectNames::Kind;
using State = Coverage::State;

/// Result of a look-up: known, or a reason against it, which is empty if the name is unknown.
struct Found {
  bool known = false;
  std::string_view reason{};
};

Found element(std::string_view inside, std::string_view name) {
  return {find_element(name, inside) != nullptr, reason_against(refused_names(), name)};
}

Found attribute(std::string_view inside, std::string_view name) {
  const bool known = std::any_of(dialect().begin(), dialect().end(), [&](const ElementSpec& e) {
    return e.name == inside &&
           std::any_of(e.attributes.begin(), e.attributes.end(), [&](const auto& a) { return a.name == name; });
  });
  return {known, reason_against_attribute(inside, name)};
}

Found command(std::string_view name) {
  // parts of the language that have no entry of their own
  static const std::vector<std::string> parts{"else",   "endif",     "ifstr",     "ifdef",      "ifndef",
                                              "ifnum",  "endrepeat", "break",     "breakall",   "continue",
                                              "endsub", "return",    "endheader", "endxmldata", "cut"};
  const auto named = [&](const auto& list) {
    return std::any_of(list.begin(), list.end(), [&](const auto& c) { return lower(c.name) == lower(name); });
  };
  if (named(script::commands()) || named(script::language()) ||
      std::find(parts.begin(), parts.end(), lower(name)) != parts.end())
    return {true};
  for (const auto& r : script::refused_commands())
    if (lower(r.name) == lower(name)) return {false, r.reason};
  return {};
}

template <class Items>
bool has_property(const Items& items, std::string_view name) {
  return std::any_of(items.begin(), items.end(), [&](const auto& item) {
    return std::any_of(item.parameters.begin(), item.parameters.end(),
                       [&](const auto& p) { return p.name == name || p.alias == name; }) ||
           std::any_of(item.own_properties.begin(), item.own_properties.end(),
                       [&](const auto& p) { return p.name == name && !p.meaning.empty(); });
  });
}

Found property(std::string_view name) {
  const bool known = of_no_law(std::string(name)) || find_element(name, "Material") ||
                     has_property(materials().items(), name) || has_property(contact_laws().items(), name);
  return {known, reason_against(refused_properties(), name)};
}

Found type(std::string_view name) {
  const bool known = materials().find(name) || contact_laws().find(name) || joint_laws().find(name);
  return {known, reason_against_type(name)};
}

Found task(const std::string& name) {
  const auto& known = task_names();
  return {std::find(known.begin(), known.end(), name) != known.end(), reason_against(refused_tasks(), name)};
}

Found field(std::string_view name) {
  const bool of_tips = name == "jintegral" || name == "stressintensity";
  return {of_tips || find_particle_field(name), reason_against(refused_outputs(), name)};
}

Found look_up(Kind kind, std::string_view inside, const std::string& name) {
  switch (kind) {
    case Kind::element:
      return element(inside, name);
    case Kind::attribute:
      return attribute(inside, name);
    case Kind::command:
      return command(name);
    case Kind::property:
      return property(name);
    case Kind::type:
      return type(name);
    case Kind::task:
      return task(name);
    case Kind::parameter:
      return {knows_parameter(std::string(inside), name), reason_against_parameter(name)};
    case Kind::quantity:
      return {find_global_quantity(name) != nullptr, reason_against(refused_outputs(), name)};
    case Kind::field:
      return field(name);
  }
  return {};
}

struct Title {
  Kind kind;
  std::string_view title, place;
};
constexpr std::array titles{Title{Kind::element, "Elements of XML files", "inside"},
                            Title{Kind::attribute, "Attributes of XML files", "element"},
                            Title{Kind::command, "Commands of scripts", ""},
                            Title{Kind::property, "Properties of materials", ""},
                            Title{Kind::type, "Types of materials and laws", ""},
                            Title{Kind::task, "Tasks", ""},
                            Title{Kind::parameter, "Parameters of tasks", "task"},
                            Title{Kind::quantity, "Quantities of histories", ""},
                            Title{Kind::field, "Fields of particle files", ""}};

// Known names of one element or kind in a list, each other one in a row with the reason.
std::string table(const std::vector<Coverage>& all, const Title& title) {
  std::string known, refused;
  std::string_view last;
  std::size_t counts[3] = {};
  for (const Coverage& c : all) {
    if (c.kind != title.kind) continue;
    ++counts[static_cast<std::size_t>(c.state)];
    const std::string name = "`" + c.name + "`";
    if (c.state != State::known) {
      refused += "| " + name + " | " + (c.inside.empty() ? "" : "`" + c.inside + "`") + " | " + c.reason + " |\n";
      continue;
    }
    const bool same = !known.empty() && last == c.inside;
    known +=
        same ? ", " : (known.empty() ? "" : "\n") + (c.inside.empty() ? std::string("* ") : "* `" + c.inside + "`: ");
    known += name;
    last = c.inside;
  }
  std::string out = "\n## " + std::string(title.title) + "\n\n" + std::to_string(counts[0]) + " known, " +
                    std::to_string(counts[1]) + " not built\n\n" + known + "\n";
  if (!refused.empty()) out += "\n| not built | " + std::string(title.place) + " | reason |\n|-|-|-|\n" + refused;
  return out;
}

}  // namespace

std::vector<Coverage> coverage() {
  std::vector<Coverage> out;
  const auto add = [&](Kind kind, std::string_view inside, const std::string& name) {
    const Found found = look_up(kind, inside, name);
    const State state = found.known ? State::known : found.reason.empty() ? State::unknown : State::refused;
    out.push_back({state, kind, std::string(inside), name, found.known ? std::string() : std::string(found.reason)});
  };
  for (const DialectNames& group : nairnmpm_names())
    for (const auto& name : words_of(group.names)) add(group.kind, group.inside, name);
  for (const auto& name : nairnmpm_quantities_of_words()) add(Kind::quantity, "", name);
  return out;
}

std::string coverage_markdown() {
  std::string out =
      "# The dialect of NairnMPM\n\nGenerated by `tribo doc --coverage` from the tables that the program uses to read "
      "its "
      "input: every name of the dialect, and for a name that is not built the reason that its error message gives.\n";
  const auto all = coverage();
  for (const Title& title : titles) out += table(all, title);
  return out;
}

}  // namespace tribo
