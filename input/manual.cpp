// SPDX-License-Identifier: MIT
#include "input/manual.hpp"

#include "base/schema.hpp"
#include "base/text.hpp"
#include "contact/contact_law.hpp"
#include "contact/joint_law.hpp"
#include "input/common_properties.hpp"
#include "input/dialect.hpp"
#include "input/examples.hpp"
#include "input/script/commands.hpp"
#include "input/xml.hpp"
#include "materials/material.hpp"
#include "model/block_quantities.hpp"
#include "model/output_fields.hpp"
#include "model/quantities.hpp"

#include <algorithm>
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

// The key of the example of an element: its name, with its first parent if several elements have it.
std::string key_of(const ElementSpec& element) {
  const auto& all = dialect();
  const auto same = std::count_if(all.begin(), all.end(), [&](const ElementSpec& e) { return e.name == element.name; });
  const auto parents = words_of(element.parents);
  return (same > 1 ? parents.front() + "/" : "") + std::string(element.name);
}

// Whether the text of an element may be absent: check_statements() demands that it is a number, a word and so on.
std::string need_of_text(const ElementSpec& element) {
  if (element.content == ValueType::text) return "";
  const auto has = [&](std::string_view name) {
    return std::any_of(element.attributes.begin(), element.attributes.end(),
                       [&](const AttributeSpec& a) { return a.name == name; });
  };
  if (element.content == ValueType::number && has("function")) return "required without 'function'";
  if (element.content == ValueType::number && has("lawname")) return "required without 'law' or 'lawname'";
  return "required";
}

void add_elements(std::vector<ManualEntry>& out) {
  for (const auto& e : dialect()) {
    ManualEntry entry{"element", "<" + std::string(e.name) + ">", "", std::string(e.meaning)};
    for (const auto& parent : words_of(e.parents))
      entry.usage += (entry.usage.empty() ? "in " : ", ") + (parent == "@shape" ? "any shape" : "<" + parent + ">");
    if (e.content != ValueType::none) entry.rows.push_back({"text", type_name(e.content, e.choices), need_of_text(e)});
    for (const auto& a : e.attributes)
      entry.rows.push_back(
          {std::string(a.name), type_name(a.type, a.choices),
           std::string(a.meaning) + (a.required ? std::string(a.meaning.empty() ? "" : "; ") + "required" : "")});
    entry.example = example_of(key_of(e), false);
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
    entry.needs = item.needs;
    entry.example = without_indentation(item.example);
    if (!entry.example.empty()) entry.script = material_in_script(entry.example);
    out.push_back(std::move(entry));
  }
}

// Adds the names of the history variables to the materials, from those of their examples.
void add_history_variables(std::vector<ManualEntry>& out) {
  for (ManualEntry& entry : out) {
    if (entry.kind != "material" || entry.example.empty()) continue;
    Problems none;
    const auto law =
        materials().find(entry.name)->make(read_xml(entry.example, nullptr), common_properties, Units{}, none);
    std::vector<std::string> names;
    for (std::size_t k = 0; law && k < law->history().size(); ++k) names.push_back(law->history()[k].name);
    if (!names.empty()) entry.meaning += " Variables of the history, numbered from 1: " + join(names) + ".";
  }
}

std::string_view task_meaning(std::string_view task) {
  if (task == "PeriodicXPIC") return "uses XPIC or FMPM only every few steps, and FLIP in between";
  if (task == "AdjustTimeStep") return "adapts the time step to the present stiffness and velocities";
  if (task == "VTKArchive")
    return "adds the fields that its parameters name to the particle files, and the fields of nodes, mass and "
           "velocity, to the grid files";
  if (task == "HistoryArchive")
    return "adds the history variables of the laws to the particle files if the name of a parameter is a number";
  if (task == "PropertyRamp")
    return "changes the temperature of the particles, as ThermalRamp; ramps of other properties are refused";
  if (task == "ThermalRamp")
    return "changes the temperature of the particles over a time. With exponential c > 0 the share of the change is "
           "1 - exp(-(c x)^s) while x goes from 0 to 1, with s given by stretch";
  if (task == "ReverseLoad")
    return "changes the loads and the motion of rigid materials when a quantity passes maxValue, or when a crack "
           "reaches the length maxLength";
  if (task == "LoadControl")
    return "moves a rigid material so that its force follows a function of time. It moves first with velocity until "
           "its force is felt; then a controller with the gains Kp, Ki and Kd determines its velocity";
  if (task == "DeleteDamaged") return "deletes the completely damaged particles of a material";
  return "adds particles of a material that enter the grid at an inlet";
}

void add_tasks(std::vector<ManualEntry>& out) {
  for (const auto& task : task_names()) {
    ManualEntry entry{"custom task", task, "in <CustomTasks>: <Schedule name='" + task + "'>",
                      std::string(task_meaning(task))};
    entry.needs = needs_of_task(task);
    entry.example = example_of(task, false);
    for (const auto& name : parameter_names(task))
      if (task != "VTKArchive" || !find_particle_field(name))
        entry.rows.push_back({"<Parameter name='" + name + "'>", "", std::string(meaning_of_parameter(task, name))});
    out.push_back(std::move(entry));
  }
}

void add_commands(std::vector<ManualEntry>& out) {
  for (const auto* list : {&script::commands(), &script::language()})
    for (const auto& c : *list) {
      ManualEntry entry{"command", std::string(c.name), std::string(c.arguments), std::string(c.meaning)};
      entry.example = example_of(c.name, true);
      out.push_back(std::move(entry));
    }
}

// Histories and fields are words of an attribute, so the tables have all that their examples need.
void add_outputs(std::vector<ManualEntry>& out) {
  const auto add = [&](const char* kind, const auto& q, const std::string& example) {
    ManualEntry entry{kind, std::string(q.name), std::string(q.unit), std::string(q.meaning)};
    entry.example = example + "\n";
    out.push_back(std::move(entry));
  };
  const auto history = [](std::string_view name, const std::string& of) {
    return "<GlobalArchive type='" + std::string(name) + "'" + of + "/>";
  };
  for (const auto& q : global_quantities()) {
    const std::string of = q.name.starts_with("reaction")  ? " material='-1'"
                           : q.name.starts_with("contact") ? " matname='tool'"
                                                           : "";
    add("history", q, history(q.name == "history" ? "history 1" : q.name, of));
  }
  using Of = BlockQuantityInfo::Of;
  for (const auto& q : block_quantities())
    add("history of blocks", q,
        history(q.name, q.of == Of::platen  ? " platen='top'"
                        : q.of == Of::block ? " block='rock'"
                                            : ""));
  for (const auto& q : particle_fields()) add("field", q, "<Output fields='" + std::string(q.name) + "'/>");
  for (const auto& q : grid_fields()) add("grid field", q, "<Output grid='" + std::string(q.name) + "'/>");
}

std::vector<ManualEntry> make() {
  std::vector<ManualEntry> out;
  add_elements(out);
  add_laws(out, "material", materials().items());
  add_history_variables(out);
  add_laws(out, "contact law", contact_laws().items());
  add_laws(out, "joint law", joint_laws().items());
  add_tasks(out);
  add_commands(out);
  add_outputs(out);
  return out;
}

}  // namespace

const std::vector<ManualEntry>& manual() {
  static const std::vector<ManualEntry> all = make();
  return all;
}

}  // namespace tribo
