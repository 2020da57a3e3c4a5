// SPDX-License-Identifier: MIT
#include "input/script/document.hpp"

#include "base/schema.hpp"
#include "base/text.hpp"
#include "input/dialect.hpp"

#include <array>
#include <utility>

namespace tribo::script {
namespace {

constexpr char reference = '\x01';  // marks a text as an id until finish()

// Order of the sections in a file.
constexpr std::array order{"Header",   "MPMHeader", "Mesh",        "MaterialPoints", "Blocks",  "CrackList",
                           "Material", "GridBCs",   "ParticleBCs", "Thermal",        "Gravity", "CustomTasks"};

Statement statement(const std::string& name, const Origin& origin, const std::string& text = {}) {
  Statement s;
  s.name = name, s.origin = s.text_origin = origin, s.text = text;
  return s;
}

}  // namespace

Statement& Document::section(const std::string& name, const Origin& origin) {
  // Not the place of an argument: what is missing in the section is not a problem of a value
  return sections_.try_emplace(name, statement(name, {origin.file, origin.line, 1})).first->second;
}

Statement& Document::add(const std::string& to, const std::string& element, const Origin& origin,
                         const std::string& text) {
  auto& children = section(to, origin).children;
  children.push_back(statement(element, origin, text));
  return children.back();
}

Statement& Document::set(const std::string& to, const std::string& element, const Origin& origin,
                         const std::string& text) {
  for (auto& child : section(to, origin).children)
    if (child.name == element) return child = statement(element, origin, text);
  return add(to, element, origin, text);
}

const Statement* Document::find(const std::string& in, const std::string& element) const {
  const auto found = sections_.find(in);
  return found == sections_.end() ? nullptr : found->second.child(element);
}

Statement& Document::material(const Origin& origin) {
  materials_.push_back(statement("Material", origin));
  return materials_.back();
}

void Document::set_version(const std::string& text, const Origin& origin) {
  if (inside_) throw InputError(origin, "in an XML file the version is that of <JANFEAInput>");
  if (version_) throw InputError(origin, "'Version' is given twice; first at " + version_->origin.text());
  version_ = Attribute{"version", text, origin};
}

void Document::name_material(const std::string& id, const Origin& origin) {
  if (!ids_.emplace(id, surrounding_ + materials_.size()).second)
    throw InputError(origin, "the material '" + id + "' already exists");
}

void Document::refer(Statement& s, const std::string& name, const std::string& id, const Origin& origin) {
  attribute(s, name, reference + id, origin);
}

void Document::refer_text(Statement& s, const std::string& id, const Origin& origin) {
  s.text = reference + id, s.text_origin = origin;
}

std::string Document::number_of(const std::string& id, const Origin& origin, Problems& problems) const {
  if (const auto found = ids_.find(id); found != ids_.end()) return std::to_string(found->second);
  std::vector<std::string> known;
  for (const auto& [name, n] : ids_) known.push_back(name);
  const bool number = !id.empty() && id.find_first_not_of("0123456789.+-eE") == std::string::npos;
  problems.add(origin,
               "there is no material '" + id + "'" + did_you_mean(id, known) +
                   (known.empty() ? "" : "; materials: " + join(known)) +
                   (number ? "; a material is named by its id, the first argument of Material (a coefficient of "
                             "friction without a Material is given by FrictionMM, or Friction for cracks)"
                           : ""));
  return "1";
}

void Document::begin_stage(Statement stage) {
  stage_ = std::move(stage);
  sections_before_ = std::exchange(sections_, {}), materials_before_ = std::exchange(materials_, {});
}

// Bodies and settings are children of the stage itself.
void Document::end_stage() {
  Statement stage = std::move(*stage_);
  stage_.reset();
  auto sections = std::exchange(sections_, std::move(sections_before_));
  for (Statement& m : std::exchange(materials_, std::move(materials_before_))) stage.children.push_back(std::move(m));
  std::optional<InputError> wrong;
  for (auto& [name, section] : sections) {
    if (name == "GridBCs" || name == "ParticleBCs" || name == "Gravity") {
      stage.children.push_back(std::move(section));
      continue;
    }
    for (Statement& child : section.children) {
      const Statement* law = child.name == "MultiMaterialMode" ? child.child("Friction") : nullptr;
      const bool known = law || find_element(child.name, "Stage") != nullptr;
      if (!known && !wrong)
        wrong.emplace(child.origin,
                      "this cannot change in a stage; there can be Material, Region, Hole, Blocks, Excavate, Stress, "
                      "Bond, Unbond, When, GridBC, ParticleBC, Gravity, ContactMM, Damping, PDamping, "
                      "FeedbackDamping, PFeedbackDamping, TimeStep and CFLFactor");
      if (law)
        stage.children.push_back(*law);
      else if (known)
        stage.children.push_back(std::move(child));
    }
  }
  stages_.push_back(std::move(stage));
  if (wrong) throw InputError(*wrong);
}

const Statement& Document::material_before(const std::string& id, const Origin& origin) const {
  Problems problems;
  const auto number = static_cast<std::size_t>(std::stoul(number_of(id, origin, problems)));
  problems.raise();
  if (number <= surrounding_ || number > surrounding_ + materials_before_.size())
    throw InputError(origin, "the material '" + id + "' is not one of the script; change it in a <Stage> of the file");
  return materials_before_[number - surrounding_ - 1];
}

std::string Document::name_of(const std::string& id) const {
  const std::size_t k = ids_.at(id);
  const bool own = k > surrounding_ && k <= surrounding_ + materials_.size();
  const Attribute* name = own ? materials_[k - surrounding_ - 1].attribute("Name") : nullptr;
  return name ? name->text : id;
}

// In an XML file the numbers of materials may depend on the order of references, so references are made by name, as in
// attributes that take a name only.
void Document::resolve(Attribute& a, Problems& problems) const {
  if (a.text.empty() || a.text[0] != reference) return;
  const std::string id = a.text.substr(1), number = number_of(id, a.origin, problems);
  a.text = number;
  const bool by_name = a.name.ends_with("name");
  if (!inside_ && !by_name) return;
  if (a.name == "tip" || a.name == "end_tip") return;  // a tip only states that it lies in a material
  static const std::map<std::string, std::string> names{
      {"law", "lawname"}, {"Tprop", "Tpropname"}, {"with", "withname"}};
  if (!by_name) {
    const auto found = names.find(a.name);
    a.name = found == names.end() ? "matname" : found->second;
  }
  a.text = ids_.contains(id) ? name_of(id) : id;
}

// What a reaction takes in place of a material.
std::string Document::hint_of_reaction(const Statement& s) {
  const Attribute* type = s.name == "GlobalArchive" ? s.attribute("type") : nullptr;
  return type && lower(type->text).starts_with("reaction")
             ? "; the reaction of a condition is chosen by its id, which 'BoundaryID' sets and which is at most 0"
             : "";
}

// A parameter of a task also takes the name of a material: that of an id in an XML file, or one that is written.
bool Document::named_by_parameter(Statement& s) const {
  if (s.name != "Parameter" || s.text.empty() || s.text[0] != reference) return false;
  const std::string id = s.text.substr(1);
  const Attribute* parameter = s.attribute("name");
  const bool known = ids_.contains(id), by_name = parameter && lower(parameter->text) == "matname";
  if (!(known ? inside_ : by_name)) return false;
  s.text = known ? name_of(id) : id;
  return true;
}

void Document::resolve(Statement& s, Problems& problems) const {
  Problems of_attributes;
  for (auto& a : s.attributes) resolve(a, of_attributes);
  for (const Problem& p : of_attributes.list()) problems.add(p.origin, p.message + hint_of_reaction(s));
  if (named_by_parameter(s)) return;
  if (s.text.size() > 1 && s.text[0] == reference && !ids_.contains(s.text.substr(1)) && to_number(s.text.substr(1))) {
    s.text.erase(0, 1);  // the number of a material
  } else if (!s.text.empty() && s.text[0] == reference) {
    s.text = number_of(s.text.substr(1), s.text_origin, problems);
    if (inside_)
      problems.add(s.text_origin,
                   "<" + s.name + "> takes a number, which is not known in <Commands>; write it in the XML file");
  }
  for (auto& child : s.children) resolve(child, problems);
}

void Document::surround(const std::vector<std::string>& names) {
  inside_ = true;
  for (const auto& name : names) ids_.emplace(name, ++surrounding_);
}

void Document::resolve_references(Problems& problems) {
  for (auto& [name, section] : sections_) resolve(section, problems);
  for (auto& m : materials_) resolve(m, problems);
  for (auto& crack : cracks_) resolve(crack, problems);
  for (auto& stage : stages_) resolve(stage, problems);
}

std::vector<Statement> Document::finish_sections(bool legacy) {
  std::vector<Statement> out;
  if (!description_.empty()) set("Header", "Description", origin_, description_);
  for (const char* name : order) {
    if (name == std::string_view("CrackList"))
      for (auto& crack : cracks_) out.push_back(std::move(crack));
    if (name == std::string_view("Material"))
      for (auto& m : materials_) out.push_back(std::move(m));
    else if (const auto found = sections_.find(name); found != sections_.end())
      out.push_back(std::move(found->second)), sections_.erase(found);
  }
  for (auto& [name, rest] : sections_) out.push_back(std::move(rest));
  for (auto& stage : stages_) out.push_back(std::move(stage));
  std::vector<Statement> reactions;
  for (auto& section : out)
    if (section.name == "MPMHeader")
      std::erase_if(section.children, [&](Statement& s) {
        if (s.name == "When") reactions.push_back(s);
        return s.name == "When";
      });
  for (auto& reaction : reactions) out.push_back(std::move(reaction));
  // Times of a legacy script are milliseconds.
  if (!legacy) return out;
  for (auto& section : out) {
    if (section.name == "Stage") attribute(section, "units", "ms", section.origin);
    if (section.name == "MPMHeader" || section.name == "Stage")
      for (auto& s : section.children)
        for (const char* timed :
             {"TimeStep", "MaxTime", "ArchiveTime", "FirstArchiveTime", "ArchiveGroup", "GlobalArchiveTime"})
          if (s.name == timed) attribute(s, "units", "ms", s.origin);
  }
  return out;
}

Statement Document::finish(bool legacy) {
  Statement root = statement("JANFEAInput", origin_);
  root.attributes.push_back(version_.value_or(Attribute{"version", "3", origin_}));
  section("MPMHeader", origin_);
  if (!sections_.contains("Blocks")) section("Mesh", origin_), section("MaterialPoints", origin_);
  root.children = finish_sections(legacy);
  return root;
}

}  // namespace tribo::script
