// SPDX-License-Identifier: MIT
/// Checks a tree of statements against the table of keywords.

#include "base/expression.hpp"
#include "base/schema.hpp"
#include "base/text.hpp"
#include "input/dialect.hpp"

#include <algorithm>

namespace tribo {
namespace {

bool lists(std::string_view list, std::string_view word) {
  for (const auto& w : words_of(list))
    if (w == word) return true;
  return false;
}

bool is_shape(std::string_view name) {
  return std::any_of(dialect().begin(), dialect().end(),
                     [&](const ElementSpec& e) { return e.shape && e.name == name; });
}

bool belongs(const ElementSpec& e, std::string_view parent) {
  return lists(e.parents, parent) || (lists(e.parents, "@shape") && is_shape(parent));
}

std::vector<std::string> children_of(std::string_view parent) {
  std::vector<std::string> out;
  for (const auto& e : dialect())
    if (belongs(e, parent)) out.emplace_back(e.name);
  return out;
}

// A number, or min or max followed by a signed number of cells.
bool is_coordinate(std::string_view text) {
  if (text.rfind("min", 0) == 0 || text.rfind("max", 0) == 0) {
    const auto rest = text.substr(3);
    return rest.empty() || rest == "+" || rest == "-" ||
           ((rest[0] == '+' || rest[0] == '-') && to_number(rest).has_value());
  }
  return to_number(text).has_value();
}

void check_value(std::string_view what, ValueType type, std::string_view choices, const std::string& text,
                 const Origin& origin, Problems& problems) {
  const auto wrong = [&](const std::string& wanted) {
    problems.add(origin, std::string(what) + " needs " + wanted + ", not '" + text + "'");
  };
  switch (type) {
    case ValueType::none:
      if (!text.empty())
        problems.add(origin, std::string(what) + " takes no text, but has '" + text.substr(0, 40) + "'");
      break;
    case ValueType::text:
      break;
    case ValueType::number:
      if (!to_number(text)) wrong("one number without a unit");
      break;
    case ValueType::integer: {
      const auto value = to_number(text);
      if (!value || *value != static_cast<double>(static_cast<long long>(*value))) wrong("a whole number");
      break;
    }
    case ValueType::coordinate:
      if (!is_coordinate(text)) wrong("a coordinate: a number, or min, max, min+2, max-1.5 (cells from the edge)");
      break;
    case ValueType::function:
      try {
        Expression expression(text, origin);
      } catch (const InputError& error) {
        problems.add(error);
      }
      break;
    case ValueType::flag:
      if (!lists("yes no 1 0 true false", text)) wrong("yes or no");
      break;
    case ValueType::choice:
      if (!lists(choices, text)) wrong("one of " + join(words_of(choices)) + did_you_mean(text, words_of(choices)));
      break;
  }
}

void check_element(const Statement& s, const ElementSpec& spec, Problems& problems, bool whole = true) {
  const std::string tag = "<" + s.name + ">";
  std::vector<std::string> names;
  for (const auto& a : spec.attributes) names.emplace_back(a.name);
  for (const auto& a : s.attributes) {
    const auto known = std::find_if(spec.attributes.begin(), spec.attributes.end(),
                                    [&](const AttributeSpec& k) { return k.name == a.name; });
    if (known == spec.attributes.end())
      problems.add(a.origin, tag + " has no attribute '" + a.name + "'" + did_you_mean(a.name, names) +
                                 (names.empty() ? "; it takes none" : "; valid: " + join(names)));
    else
      check_value("attribute '" + a.name + "' of " + tag, known->type, known->choices, a.text, a.origin, problems);
  }
  for (const auto& a : spec.attributes)
    if (a.required && !s.attribute(a.name))
      problems.add(s.origin, tag + " needs the attribute '" + std::string(a.name) + "'");

  const bool said_otherwise = s.attribute("function") || s.attribute("law") || s.attribute("lawname");
  const bool optional_text = spec.content == ValueType::number && s.text.empty() && said_otherwise;
  if (!optional_text)
    check_value(tag, spec.content, spec.choices, s.text, s.text.empty() ? s.origin : s.text_origin, problems);

  for (const auto& e : dialect())
    if (whole && e.required && belongs(e, s.name) && !s.child(e.name) && (e.unless.empty() || !s.child(e.unless)))
      problems.add(s.origin, tag + " needs <" + std::string(e.name) + "> (" + std::string(e.meaning) + ")");
}

void check_children(const Statement& s, Problems& problems) {
  if (s.name == "Material") {  // its children are properties, which are checked by the law
    for (const auto& child : s.children)
      if (const ElementSpec* spec = find_element(child.name, s.name)) check_element(child, *spec, problems);
    return;
  }
  const auto valid = children_of(s.name);
  for (const auto& child : s.children) {
    const ElementSpec* spec = find_element(child.name, s.name);
    if (!spec) {
      const auto refused = std::find_if(refused_names().begin(), refused_names().end(),
                                        [&](const RefusedName& r) { return r.name == child.name; });
      if (refused != refused_names().end()) {
        problems.add(child.origin, "<" + child.name + "> is not supported by Tribo: " + std::string(refused->reason));
        continue;
      }
      std::vector<std::string> parents;
      for (const auto& e : dialect())
        if (e.name == child.name)
          for (const auto& parent : words_of(e.parents)) parents.push_back(parent == "@shape" ? "a shape" : parent);
      const std::string elsewhere = parents.empty() ? "" : "; it belongs into " + join(parents, " or ");
      problems.add(child.origin, "<" + child.name + "> is not known inside <" + s.name + ">" +
                                     did_you_mean(child.name, valid) + elsewhere +
                                     (valid.empty() ? "" : "; valid: " + join(valid)));
      continue;
    }
    const Statement* first = s.child(child.name);
    if (spec->once && first != &child)
      problems.add(child.origin, "<" + child.name + "> is given twice; first at " + first->origin.text());
    check_element(child, *spec, problems);
    check_children(child, problems);
  }
}

}  // namespace

const ElementSpec* find_element(std::string_view name, std::string_view parent) {
  for (const auto& e : dialect())
    if (e.name == name && (parent.empty() ? e.parents.empty() : belongs(e, parent))) return &e;
  return nullptr;
}

void check_statements(const Statement& root, Problems& problems, bool only_drive) {
  if (root.name != "JANFEAInput") {
    problems.add(root.origin,
                 "the root element is <" + root.name + ">, but a command file starts with <JANFEAInput version='3'>");
    return;
  }
  check_element(root, *find_element("JANFEAInput", ""), problems, !only_drive);
  check_children(root, problems);
}

}  // namespace tribo
