// SPDX-License-Identifier: MIT
#include "input/stage_edits.hpp"

#include "base/schema.hpp"
#include "base/text.hpp"
#include "input/builder.hpp"

#include <algorithm>
#include <functional>
#include <map>
#include <set>

namespace tribo {
namespace {

std::string text_of(const Statement& s, std::string_view name) {
  const Attribute* a = s.attribute(name);
  return a ? a->text : std::string();
}

std::vector<const Statement*> materials_of(const Statement& root) {
  std::vector<const Statement*> out;
  for (const auto& s : root.children)
    if (s.name == "Material") out.push_back(&s);
  return out;
}

Statement& material_at(Statement& root, std::size_t position) {
  const auto wanted = [&](const Statement& s) { return s.name == "Material" && position-- == 0; };
  return *std::find_if(root.children.begin(), root.children.end(), wanted);
}

Statement& child_of(Statement& parent, const std::string& name, const Origin& origin) {
  for (Statement& s : parent.children)
    if (s.name == name) return s;
  Statement& added = parent.children.emplace_back();
  added.name = name, added.origin = origin;
  return added;
}

void replace(Statement& parent, Statement by) {
  std::erase_if(parent.children, [&](const Statement& s) { return s.name == by.name; });
  parent.children.push_back(std::move(by));
}

// Sets the attributes of `by`, apart from `except`.
void set_attributes(Statement& s, const Statement& by, std::string_view except = {}) {
  for (const Attribute& a : by.attributes) {
    if (a.name == except) continue;
    std::erase_if(s.attributes, [&](const Attribute& old) { return old.name == a.name; });
    s.attributes.push_back(a);
  }
}

// What describes a joint or a body at the start, or cannot change for other reasons.
std::string_view refusal_of(const std::string& property) {
  struct Refusal {
    std::string_view names, why;
  };
  static constexpr Refusal all[] = {
      {"rho", "the particles keep their mass; take <Excavate> and a <Body> of another material"},
      {"shareMatField", "velocity fields are chosen at the start"},
      {"bond unbond", "these methods act once at the start; in a stage write <Bond> or <Unbond> with a shape"},
      {"stress-normal force-normal stress-shear force-shear disp-normal disp-shear state force moment",
       "it describes joints at the start"},
      {"alpha", "thermal expansion is chosen at the start"},
      {"LiquidPhase", "it is chosen at the start"}};
  for (const auto& r : all)
    for (const auto& name : words_of(r.names))
      if (name == property) return r.why;
  return {};
}

// Whether a property gives all stiffnesses of a joint, and another one some of them in another way.
bool takes_the_place(const std::string& property, const std::string& of) {
  static const std::set<std::string> all{"compute-stiffness", "assign-stiffness"}, some{"kn", "ks", "krot"};
  return all.count(property) != 0 && property != of && (all.count(of) != 0 || some.count(of) != 0);
}

// The properties of `by` replace those of the same name; a law with another material replaces that with this material.
void change_material(Statement& material, const Statement& by, Problems& problems) {
  const Attribute* type = by.attribute("Type");
  if (type && type->text != text_of(material, "Type"))
    problems.add(type->origin, "a stage cannot change the type of '" + text_of(material, "Name") + "', which is '" +
                                   text_of(material, "Type") + "'");
  const auto other = [](const Statement& s) { return text_of(s, "mat") + "\n" + text_of(s, "matname"); };
  for (const Statement& property : by.children) {
    if (const auto why = refusal_of(property.name); !why.empty())
      problems.add(property.origin, "<" + property.name + "> cannot change in a stage: " + std::string(why));
    std::erase_if(material.children, [&](const Statement& old) {
      return takes_the_place(property.name, old.name) ||
             (old.name == property.name && (old.name != "Friction" || other(old) == other(property)));
    });
  }
  material.children.insert(material.children.end(), by.children.begin(), by.children.end());
}

void change_section(Statement& root, const Statement& by) {
  const bool add = yes(text_of(by, "add"));
  Statement section = by;
  section.attributes.clear();
  if (!add) return replace(root, std::move(section));
  Statement& old = child_of(root, by.name, by.origin);
  old.children.insert(old.children.end(), section.children.begin(), section.children.end());
}

void change_platen(Statement& root, const Statement& by, Problems& problems) {
  std::vector<std::string> names;
  for (Statement& blocks : root.children)
    if (blocks.name == "Blocks")
      for (Statement& platen : blocks.children) {
        if (platen.name != "Platen") continue;
        if (text_of(platen, "name") == text_of(by, "name")) return set_attributes(platen, by, "name");
        names.push_back(text_of(platen, "name"));
      }
  problems.add(by.attribute("name")->origin, "there is no platen '" + text_of(by, "name") + "'" +
                                                 did_you_mean(text_of(by, "name"), names) +
                                                 (names.empty() ? "" : "; platens: " + join(names)));
}

}  // namespace

std::vector<std::size_t> material_order(const Statement& root) {
  const auto in_file = materials_of(root);
  std::vector<std::size_t> order;
  const auto number = [&](std::size_t k) {
    if (std::find(order.begin(), order.end(), k) == order.end()) order.push_back(k);
  };
  const std::function<void(const Statement&)> visit = [&](const Statement& s) {
    if (const Attribute* a = s.attribute("matname"))
      for (std::size_t k = 0; k < in_file.size(); ++k)
        if (text_of(*in_file[k], "Name") == a->text) number(k);
    for (const auto& child : s.children)
      if (child.name != "Stage") visit(child);  // a stage does not change the numbers of the file
  };
  visit(root);
  for (std::size_t k = 0; k < in_file.size(); ++k) number(k);
  return order;
}

std::optional<std::size_t> material_of_stage(const Statement& root, const Statement& change,
                                             const std::vector<std::size_t>& order, Problems& problems) {
  const auto all = materials_of(root);
  if (const Attribute* a = change.attribute("mat")) {
    const auto number = to_number(a->text);
    if (number && *number >= 1 && *number <= static_cast<double>(order.size()))
      return order[static_cast<std::size_t>(*number) - 1];
    problems.add(a->origin,
                 "there is no material number '" + a->text + "'; this file has " + std::to_string(order.size()));
    return std::nullopt;
  }
  const Attribute* a = change.attribute("Name") ? change.attribute("Name") : change.attribute("matname");
  if (!a) {
    problems.add(change.origin, "<Material> of a stage needs 'Name', the name of a material of the file");
    return std::nullopt;
  }
  std::vector<std::string> names;
  for (std::size_t k = 0; k < all.size(); ++k) {
    if (text_of(*all[k], "Name") == a->text) return k;
    names.push_back(text_of(*all[k], "Name"));
  }
  problems.add(
      a->origin,
      "there is no material named '" + a->text + "'" + did_you_mean(a->text, names) +
          "; a stage changes materials of the file, so define a new one outside of it; materials: " + join(names));
  return std::nullopt;
}

namespace {

// Reactions are in force until the next stage begins.
void change_reactions(Statement& root, const Statement& stage, Problems& problems) {
  std::erase_if(root.children, [](const Statement& s) { return s.name == "When"; });
  for (const Statement& s : stage.children)
    if (s.name == "When") root.children.push_back(s);
  const Attribute* until = stage.attribute("until");
  if (!until) return;
  const auto words = words_of(until->text);
  if (words.size() != 2 || words[0] != "ratio" || !to_number(words[1])) {
    problems.add(until->origin, "'until' is the word ratio and a number, such as 'ratio 1e-4'");
    return;
  }
  Statement when, next;
  when.name = "When", when.origin = until->origin, next.name = "NextStage", next.origin = until->origin;
  when.attributes.push_back({"ratio", words[1], until->origin});
  when.children.push_back(next);
  root.children.push_back(when);
}

}  // namespace

void apply_stage(Statement& root, const Statement& stage, const std::vector<std::size_t>& order, Problems& problems) {
  static const std::set<std::string> settings{"Damping",          "PDamping", "FeedbackDamping",
                                              "PFeedbackDamping", "TimeStep", "TimeFactor"},
      sections{"Gravity", "GridBCs", "ParticleBCs"};
  change_reactions(root, stage, problems);
  for (const Statement& s : stage.children) {
    if (s.name == "Material") {
      if (const auto found = material_of_stage(root, s, order, problems))
        change_material(material_at(root, *found), s, problems);
    } else if (sections.count(s.name)) {
      change_section(root, s);
    } else if (settings.count(s.name)) {
      replace(child_of(root, "MPMHeader", s.origin), s);
    } else if (s.name == "Friction") {
      Statement& header = child_of(root, "MPMHeader", s.origin);
      if (!header.child("MultiMaterialMode"))
        problems.add(s.origin, "<Friction> needs <MultiMaterialMode> in <MPMHeader>, which a stage cannot add");
      else
        replace(child_of(header, "MultiMaterialMode", s.origin), s);
    } else if (s.name == "Blocks") {
      if (!root.child("Blocks"))
        problems.add(s.origin, "the file has no <Blocks> whose settings could change");
      else
        set_attributes(child_of(root, "Blocks", s.origin), s);
    } else if (s.name == "Platen") {
      change_platen(root, s, problems);
    }
  }
}

std::vector<std::string> phrases_of(const Statement& stage, const Statement& root,
                                    const std::vector<std::size_t>& order) {
  std::vector<std::string> out;
  for (const Statement& s : stage.children) {
    const bool add = yes(text_of(s, "add"));
    if (s.name == "Material") {
      Problems none;
      const auto found = material_of_stage(root, s, order, none);
      std::vector<std::string> names;
      for (const Statement& p : s.children) names.push_back(p.name + (p.text.empty() ? "" : " " + p.text));
      out.push_back("'" + (found ? text_of(*materials_of(root)[*found], "Name") : "") + "' with " +
                    join(names, " and "));
    } else if (s.name == "Gravity") {
      std::vector<std::string> forces;
      for (const Statement& f : s.children) forces.push_back(f.name + " " + f.text);
      out.push_back("gravity " + (forces.empty() ? "0" : join(forces, " and ")));
    } else if (s.name == "GridBCs") {
      out.emplace_back(add ? "further conditions on nodes" : "other conditions on nodes");
    } else if (s.name == "ParticleBCs") {
      out.emplace_back(add ? "further loads" : "other loads");
    } else if (s.name == "Friction") {
      out.emplace_back("another default law of contact");
    } else if (s.name == "Platen") {
      out.push_back("other velocity or stiffness of platen '" + text_of(s, "name") + "'");
    } else if (s.name == "Blocks") {
      out.emplace_back("other settings of blocks");
    } else if (s.name == "Stress") {
      out.emplace_back(add ? "further stress of particles" : "another stress of particles");
    } else if (s.name == "Excavate") {
      out.emplace_back("excavation");
    } else if (s.name == "Body" || s.name == "BMP") {
      out.emplace_back("placement");
    } else if (s.name == "Bond" || s.name == "Unbond") {
      out.emplace_back(s.name == "Bond" ? "bonds" : "broken bonds");
    } else if (s.name == "When") {
      out.emplace_back("reactions");
    } else if (s.name != "Hole") {
      out.push_back(s.name + " " + (s.text.empty() ? text_of(s, "function") : s.text));
    }
  }
  return out;
}

}  // namespace tribo
