// SPDX-License-Identifier: MIT
/// Checks a tree of statements against the table of keywords.

#include "base/expression.hpp"
#include "base/schema.hpp"
#include "base/text.hpp"
#include "input/dialect.hpp"
#include "input/format_version.hpp"

#include <algorithm>
#include <cmath>
#include <map>

namespace tribo {
namespace {

constexpr double most_whole = 999'999'999;

bool lists(std::string_view list, std::string_view word) {
  for (const auto& w : words_of(list))
    if (w == word) return true;
  return false;
}

/// The elements that may stand in each element; a command file has millions of elements at most.
class Children {
 public:
  Children() {
    std::vector<std::string> shapes;
    for (const auto& e : dialect())
      if (e.shape) shapes.emplace_back(e.name);
    for (const auto& e : dialect())
      for (const auto& parent : words_of(e.parents)) {
        if (parent != "@shape") {
          add(parent, e);
          continue;
        }
        for (const auto& shape : shapes) add(shape, e);
      }
  }
  const std::vector<const ElementSpec*>& of(std::string_view parent) const {
    static const std::vector<const ElementSpec*> none;
    const auto found = of_.find(parent);
    return found == of_.end() ? none : found->second;
  }

 private:
  void add(const std::string& parent, const ElementSpec& e) {
    auto& list = of_[parent];
    if (std::find(list.begin(), list.end(), &e) == list.end()) list.push_back(&e);
  }
  std::map<std::string, std::vector<const ElementSpec*>, std::less<>> of_;
};

const std::vector<const ElementSpec*>& children_of(std::string_view parent) {
  static const Children all;
  return all.of(parent);
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

// What choices mean that are numbers only.
std::string meaning_of_numbers(const std::vector<std::string>& choices, std::string_view meaning) {
  const bool numbers =
      std::all_of(choices.begin(), choices.end(), [](const auto& c) { return to_number(c).has_value(); });
  return numbers ? " (" + std::string(meaning) + ")" : "";
}

void check_value(std::string_view what, ValueType type, std::string_view choices, std::string_view meaning,
                 const std::string& text, const Origin& origin, Problems& problems) {
  const auto wrong = [&](const std::string& wanted, const std::string& more = "") {
    problems.add(origin, std::string(what) + " needs " + wanted + ", not '" + text + "'" + more);
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
      if (!value || *value != std::trunc(*value))
        wrong("a whole number");
      else if (std::abs(*value) > most_whole)
        wrong("a whole number of at most nine digits");
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
      if (!lists(choices, text))
        wrong("one of " + join(words_of(choices)) + did_you_mean(text, words_of(choices)),
              meaning_of_numbers(words_of(choices), meaning));
      break;
    case ValueType::version:
      if (const std::string problem = problem_of_format_version(text); !problem.empty())
        problems.add(origin, std::string(what) + " " + problem);
      break;
  }
}

void check_element(const Statement& s, const ElementSpec& spec, Problems& problems, bool whole = true) {
  const std::string tag = "<" + s.name + ">";
  for (const auto& a : s.attributes) {
    const auto known = std::find_if(spec.attributes.begin(), spec.attributes.end(),
                                    [&](const AttributeSpec& k) { return k.name == a.name; });
    if (const auto reason = reason_against_attribute(s.name, a.name);
        known == spec.attributes.end() && !reason.empty()) {
      problems.add(a.origin, tag + " with '" + a.name + "' is not supported by Tribo: " + std::string(reason));
    } else if (known == spec.attributes.end()) {
      std::vector<std::string> names;
      for (const auto& valid : spec.attributes) names.emplace_back(valid.name);
      problems.add(a.origin, tag + " has no attribute '" + a.name + "'" + did_you_mean(a.name, names) +
                                 (names.empty() ? "; it takes none" : "; valid: " + join(names)));
    } else if (const auto against = reason_against_word(s.name, a.text);
               known->type == ValueType::choice && !against.empty()) {
      problems.add(a.origin, tag + " with '" + a.text + "' is not supported by Tribo: " + std::string(against));
    } else {
      check_value("attribute '" + a.name + "' of " + tag, known->type, known->choices, known->meaning, a.text, a.origin,
                  problems);
    }
  }
  for (const auto& a : spec.attributes)
    if (a.required && !s.attribute(a.name))
      problems.add(s.origin, tag + " needs the attribute '" + std::string(a.name) + "'");

  const bool said_otherwise = s.attribute("function") || s.attribute("law") || s.attribute("lawname");
  const bool optional_text = spec.content == ValueType::number && s.text.empty() && said_otherwise;
  if (!optional_text)
    check_value(tag, spec.content, spec.choices, spec.meaning, s.text, s.text.empty() ? s.origin : s.text_origin,
                problems);

  for (const auto* e : children_of(s.name))
    if (whole && e->required && !s.child(e->name) && (e->unless.empty() || !s.child(e->unless)))
      problems.add(s.origin, tag + " needs <" + std::string(e->name) + "> (" + std::string(e->meaning) + ")");
}

void check_children(const Statement& s, Problems& problems) {
  if (s.name == "Material") {  // its children are properties, which are checked by the law
    for (const auto& child : s.children)
      if (const ElementSpec* spec = find_element(child.name, s.name)) check_element(child, *spec, problems);
    return;
  }
  for (const auto& child : s.children) {
    if (problems.full()) return;
    const ElementSpec* spec = find_element(child.name, s.name);
    if (!spec) {
      const auto refused = std::find_if(refused_names().begin(), refused_names().end(),
                                        [&](const RefusedName& r) { return r.name == child.name; });
      if (refused != refused_names().end()) {
        problems.add(child.origin, "<" + child.name + "> is not supported by Tribo: " + std::string(refused->reason));
        continue;
      }
      std::vector<std::string> parents, valid;
      for (const auto* e : children_of(s.name)) valid.emplace_back(e->name);
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

bool complete(const Statement& s, const ElementSpec& spec) {
  for (const auto& a : spec.attributes)
    if (a.required && !s.attribute(a.name)) return false;
  for (const auto* e : children_of(s.name))
    if (e->required && !s.child(e->name) && (e->unless.empty() || !s.child(e->unless))) return false;
  for (const auto& child : s.children) {
    const ElementSpec* of_child = find_element(child.name, s.name);
    if (!of_child && s.name == "Material") continue;
    if (!of_child || !complete(child, *of_child)) return false;
  }
  return true;
}

Statement without_incomplete(Statement s) {
  std::vector<Statement> kept;
  for (Statement& child : s.children) {
    const ElementSpec* of_child = find_element(child.name, s.name);
    if (!of_child && s.name != "Material") continue;
    if (of_child) child = without_incomplete(std::move(child));
    const bool named = s.name == "Blocks" && child.attribute("name");  // others may refer to it
    if (!of_child || of_child->required || named || complete(child, *of_child)) kept.push_back(std::move(child));
  }
  s.children = std::move(kept);
  return s;
}

}  // namespace

Statement complete_part(const Statement& root) { return without_incomplete(root); }

bool is_complete(const Statement& root) {
  if (root.name != "JANFEAInput" || !complete(root, *find_element("JANFEAInput", ""))) return false;
  // What the numbers of all other sections refer to
  for (const char* name : {"Header", "Mesh"}) {
    Problems problems;
    if (const Statement* s = root.child(name)) check_children(*s, problems);
    if (!problems.empty()) return false;
  }
  return true;
}

const ElementSpec* find_element(std::string_view name, std::string_view parent) {
  if (!parent.empty()) {
    const auto& list = children_of(parent);
    const auto found = std::find_if(list.begin(), list.end(), [&](const auto* e) { return e->name == name; });
    return found == list.end() ? nullptr : *found;
  }
  for (const auto& e : dialect())
    if (e.name == name && e.parents.empty()) return &e;
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
