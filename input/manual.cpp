// SPDX-License-Identifier: MIT
#include "input/manual.hpp"

#include "base/error.hpp"
#include "base/schema.hpp"
#include "base/text.hpp"
#include "contact/contact_law.hpp"
#include "contact/joint_law.hpp"
#include "input/dialect.hpp"
#include "input/script/commands.hpp"
#include "materials/material.hpp"
#include "model/block_quantities.hpp"
#include "model/output_fields.hpp"
#include "model/quantities.hpp"

#include <algorithm>
#include <set>
#include <sstream>

namespace tribo {
namespace {

std::string type_name(ValueType type, std::string_view choices) {
  switch (type) {
    case ValueType::none:
      return "";
    case ValueType::text:
      return "text";
    case ValueType::number:
      return "number";
    case ValueType::integer:
      return "whole number";
    case ValueType::coordinate:
      return "coordinate";
    case ValueType::function:
      return "function";
    case ValueType::flag:
      return "yes or no";
    case ValueType::choice: {
      std::string out;
      for (const auto& word : words_of(choices)) out += (out.empty() ? "" : " | ") + word;
      return out;
    }
    case ValueType::version:
      return "version";
  }
  return "";
}

std::string fallback_text(double value) {
  std::ostringstream out;
  out << value;
  return out.str();
}

void add_elements(std::vector<ManualEntry>& out) {
  for (const auto& e : dialect()) {
    ManualEntry entry{"element", "<" + std::string(e.name) + ">", "", std::string(e.meaning)};
    for (const auto& parent : words_of(e.parents))
      entry.usage += (entry.usage.empty() ? "in " : ", ") + (parent == "@shape" ? "any shape" : "<" + parent + ">");
    if (e.content != ValueType::none) entry.rows.push_back({"text", type_name(e.content, e.choices), ""});
    for (const auto& a : e.attributes)
      entry.rows.push_back(
          {std::string(a.name), type_name(a.type, a.choices),
           std::string(a.meaning) + (a.required ? std::string(a.meaning.empty() ? "" : "; ") + "required" : "")});
    if (e.required) entry.meaning += "; required";
    if (!e.unless.empty()) entry.meaning += " unless there is <" + std::string(e.unless) + ">";
    out.push_back(std::move(entry));
  }
}

template <class Items>
void add_laws(std::vector<ManualEntry>& out, const char* kind, const Items& items) {
  for (const auto& item : items) {
    ManualEntry entry{
        kind, item.name,
        item.number ? "Type='" + item.name + "', or " + std::to_string(item.number) : "Type='" + item.name + "'",
        item.summary};
    for (const auto& p : item.parameters) {
      std::string meaning = p.meaning;
      if (!p.alias.empty()) meaning += "; also <" + p.alias + ">";
      if (p.fallback) meaning += "; default " + fallback_text(*p.fallback);
      if (!p.fallback && !p.optional) meaning += "; required";
      entry.rows.push_back(
          {"<" + p.name + ">", std::string(dimension_name(p.dimension)) + ", " + p.range.text(), meaning});
    }
    for (const auto& p : item.own_properties)
      if (!p.meaning.empty()) entry.rows.push_back({"<" + std::string(p.name) + ">", "", std::string(p.meaning)});
    out.push_back(std::move(entry));
  }
}

std::string_view task_meaning(std::string_view task) {
  if (task == "PeriodicXPIC") return "uses XPIC or FMPM only every few steps, FLIP in between";
  if (task == "AdjustTimeStep") return "adapts the time step to the present stiffness and velocities";
  if (task == "VTKArchive") return "files with nodal fields; the names of the parameters are fields";
  if (task == "HistoryArchive")
    return "histories of the laws in the particle files; the names of the parameters are numbers";
  if (task == "PropertyRamp") return "multiplies a property of a material by a function of time";
  if (task == "ThermalRamp") return "changes the temperature of the particles";
  if (task == "ReverseLoad") return "reverses, holds or removes the loads when a quantity reaches a value";
  if (task == "LoadControl") return "moves a rigid material so that its force follows a function of time";
  if (task == "DeleteDamaged") return "deletes damaged particles";
  return "adds particles of a material that enter the grid";
}

void add_tasks(std::vector<ManualEntry>& out) {
  for (const auto& task : task_names()) {
    ManualEntry entry{"custom task", task, "in <CustomTasks>: <Schedule name='" + task + "'>",
                      std::string(task_meaning(task))};
    for (const auto& name : parameter_names(task))
      if (task != "VTKArchive" || !find_particle_field(name))
        entry.rows.push_back({"<Parameter name='" + name + "'>", "", ""});
    out.push_back(std::move(entry));
  }
}

std::vector<ManualEntry> make() {
  std::vector<ManualEntry> out;
  add_elements(out);
  add_laws(out, "material", materials().items());
  add_laws(out, "contact law", contact_laws().items());
  add_laws(out, "joint law", joint_laws().items());
  add_tasks(out);
  for (const auto* list : {&script::commands(), &script::language()})
    for (const auto& c : *list)
      out.push_back({"command", std::string(c.name), std::string(c.arguments), std::string(c.meaning)});
  for (const auto& q : global_quantities())
    out.push_back({"history", std::string(q.name), std::string(q.unit), std::string(q.meaning)});
  for (const auto& q : block_quantities())
    out.push_back({"history of blocks", std::string(q.name), std::string(q.unit), std::string(q.meaning)});
  for (const auto& q : particle_fields())
    out.push_back({"field", std::string(q.name), std::string(q.unit), std::string(q.meaning)});
  for (const auto& q : grid_fields())
    out.push_back({"grid field", std::string(q.name), std::string(q.unit), std::string(q.meaning)});
  return out;
}

std::string plain(const std::string& name) {
  return lower(name.front() == '<' ? name.substr(1, name.size() - 2) : name);
}

const char* title(const std::string& kind) {
  if (kind == "element") return "Elements of XML command files";
  if (kind == "material") return "Materials";
  if (kind == "contact law") return "Contact laws";
  if (kind == "joint law") return "Joint laws";
  if (kind == "custom task") return "Custom tasks";
  if (kind == "command") return "Scripted commands";
  if (kind == "history") return "Quantities of history.csv";
  if (kind == "history of blocks") return "Quantities of history.csv in models of blocks";
  if (kind == "grid field") return "Fields of the grid files";
  return "Fields of the particle files";
}

// Text in a cell of a Markdown table
std::string cell(const std::string& text) {
  std::string out;
  for (const char c : text)
    if (c == '|')
      out += "\\|";
    else if (c == '<')
      out += "&lt;";
    else
      out += c;
  return out;
}

std::string bare(const std::string& name) { return name.front() == '<' ? name.substr(1, name.size() - 2) : name; }

// Attributes of elements and properties of laws with this name.
std::string rows_named(const std::string& wanted) {
  std::string out;
  for (const auto& e : manual())
    for (const auto& r : e.rows) {
      if (plain(r.name) != wanted || r.name == "text") continue;  // the text of an element is no attribute
      out += (r.name.front() == '<' ? "property " : "attribute ") + r.name + " of " + e.kind + " " + e.name + "\n";
      if (!r.kind.empty() || !r.meaning.empty())
        out += "    " + r.kind + (r.kind.empty() || r.meaning.empty() ? "" : "; ") + r.meaning + "\n";
    }
  return out;
}

}  // namespace

const std::vector<ManualEntry>& manual() {
  static const std::vector<ManualEntry> all = make();
  return all;
}

std::string manual_text(std::string_view name) {
  std::string out;
  std::vector<std::string> known;
  const std::string wanted = name.empty() ? "" : plain(std::string(name));
  for (const auto& e : manual()) {
    known.push_back(bare(e.name));
    for (const auto& r : e.rows) known.push_back(bare(r.name));
    if (!wanted.empty() && plain(e.name) != wanted) continue;
    out += e.kind + " " + e.name + (e.usage.empty() ? "" : "  " + e.usage) + "\n";
    if (!e.meaning.empty()) out += "    " + e.meaning + "\n";
    std::size_t width = 0;
    for (const auto& r : e.rows) width = std::max(width, r.name.size());
    for (const auto& r : e.rows) {
      out += "      " + r.name;
      if (!r.kind.empty() || !r.meaning.empty()) out += std::string(width - r.name.size() + 2, ' ') + r.kind;
      if (!r.meaning.empty()) out += (r.kind.empty() ? "" : "; ") + r.meaning;
      out += "\n";
    }
  }
  if (out.empty() && !wanted.empty()) out = rows_named(wanted);
  if (out.empty())
    throw UsageError(
        "there is no element, attribute, material, law, property, task, command, quantity or field named '" +
        std::string(name) + "'" + did_you_mean(std::string(name), known) + "; 'tribo list' names all");
  return out;
}

std::string manual_list() {
  std::string out, kind;
  for (const auto& e : manual()) {
    if (e.kind != kind) out += (out.empty() ? "" : "\n") + std::string(title(e.kind)) + "\n";
    kind = e.kind;
    out += "  " + e.name + std::string(e.name.size() < 24 ? 24 - e.name.size() : 1, ' ') + e.meaning + "\n";
  }
  return out;
}

std::string manual_markdown() {
  std::string out =
                  "# All keywords\n\nGenerated by `tribo doc --markdown` from the tables that the program uses to read "
                  "its input. "
                  "`tribo doc NAME` "
                  "prints one entry.\n",
              kind;
  for (const auto& e : manual()) {
    const bool table = e.kind == "command" || e.kind == "history" || e.kind == "field" || e.kind == "grid field";
    if (e.kind != kind) {
      out += "\n## " + std::string(title(e.kind)) + "\n\n";
      if (table) out += e.kind == "command" ? "| command | followed by | |\n|-|-|-|\n" : "| name | unit | |\n|-|-|-|\n";
    }
    kind = e.kind;
    if (table) {
      out += "| `" + e.name + "` | " + cell(e.usage) + " | " + cell(e.meaning) + " |\n";
      continue;
    }
    out +=
        "\n### `" + e.name + "`\n\n" + (e.usage.empty() ? "" : "*" + cell(e.usage) + "* – ") + cell(e.meaning) + "\n";
    if (e.rows.empty()) continue;
    out += "\n| | | |\n|-|-|-|\n";
    for (const auto& r : e.rows) out += "| `" + r.name + "` | " + cell(r.kind) + " | " + cell(r.meaning) + " |\n";
  }
  return out;
}

std::string manual_names() {
  std::set<std::string> names;
  for (const auto& e : manual()) names.insert(bare(e.name));
  std::string out;
  for (const auto& n : names) out += n + "\n";
  return out;
}

}  // namespace tribo
