// SPDX-License-Identifier: MIT
/// <Material>: numbers, names, laws and properties.

#include "contact/contact_law.hpp"
#include "contact/joint_law.hpp"
#include "input/builder.hpp"
#include "input/common_properties.hpp"
#include "input/dialect.hpp"
#include "input/stage_edits.hpp"
#include "materials/material.hpp"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <map>
#include <set>
#include <sstream>

namespace tribo {
namespace {

std::vector<std::string> law_names(bool with_number) {
  std::vector<std::string> out;
  const auto add = [&](const auto& item) {
    out.push_back(item.name + (with_number && item.number ? " (" + std::to_string(item.number) + ")" : ""));
  };
  for (const auto& item : materials().items()) add(item);
  for (const auto& item : contact_laws().items()) add(item);
  for (const auto& item : joint_laws().items()) add(item);
  return out;
}

}  // namespace

// Materials that are referenced by name are numbered in the order of first reference, otherwise in the order of the
// file.
void Builder::check_materials() {
  const Statement* h = root_.child("Header");
  if (!h || !h->child("Analysis")) return;  // then the units are unknown too
  header();
  number_materials();
  materials();
  problems_.raise();
}

void Builder::number_materials() {
  std::vector<const Statement*> in_file;
  for (const auto& s : root_.children)
    if (s.name == "Material") in_file.push_back(&s);
  if (!order_.empty()) {  // a stage has the numbers of the whole file
    for (const std::size_t k : order_) material_statements_.push_back(in_file.at(k));
    return;
  }
  // Two materials may have the same name if nothing refers to it.
  std::set<std::string> referred;
  const std::function<void(const Statement&)> collect = [&](const Statement& s) {
    for (const char* name : {"matname", "lawname"})
      if (const Attribute* a = s.attribute(name)) referred.insert(a->text);
    for (const auto& child : s.children) collect(child);
  };
  collect(root_);
  std::map<std::string, std::vector<const Statement*>, std::less<>> named;
  for (const auto* m : in_file) {
    const std::string name = word(*m, "Name");
    auto& same = named[name];
    if (has(*m, "Name") && !same.empty()) {
      const std::string message = "two materials are named '" + name + "'; the first is at " + same[0]->origin.text();
      if (referred.count(name))
        problems_.add(m->origin, message);
      else
        problems_.warn(m->origin, message + ". Histories, pictures and messages do not tell them apart");
    }
    same.push_back(m);
  }
  for (const std::size_t k : material_order(root_)) material_statements_.push_back(in_file[k]);
}

int Builder::material(const Statement& s, std::string_view by_number, std::string_view by_name) {
  if (const Attribute* a = s.attribute(by_name)) {
    const auto found = std::find_if(material_statements_.begin(), material_statements_.end(), [&](const Statement* m) {
      const Attribute* name = m->attribute("Name");
      return name ? name->text == a->text : a->text.empty();
    });
    if (found != material_statements_.end()) return static_cast<int>(found - material_statements_.begin());
    std::vector<std::string> names;
    for (const auto* m : material_statements_) names.push_back(word(*m, "Name"));
    problems_.add(a->origin, "there is no material named '" + a->text + "'" + did_you_mean(a->text, names) +
                                 "; materials: " + join(names));
    return 0;
  }
  if (const Attribute* a = s.attribute(by_number)) {
    const auto number = to_number(a->text);
    const auto count = material_statements_.size();
    if (number && *number >= 1 && *number <= static_cast<double>(count) && *number == static_cast<int>(*number))
      return static_cast<int>(*number) - 1;
    problems_.add(a->origin, "there is no material number '" + a->text + "'; this file has " + std::to_string(count));
    return 0;
  }
  problems_.add(s.origin, "<" + s.name + "> needs the attribute 'mat' or 'matname'");
  return 0;
}

// Bodies are made of materials, not of contact laws.
void Builder::must_be_solid(const Statement& s, int material) {
  if (material >= static_cast<int>(model_.materials.size())) return;
  const auto& spec = model_.materials[static_cast<std::size_t>(material)];
  const Attribute* a = s.attribute("matname") ? s.attribute("matname") : s.attribute("mat");
  const auto must_not_be = [&](const auto* law, const char* what) {
    must(!law, a ? a->origin : s.origin,
         "'" + spec.name + "' at " + spec.origin.text() + " is a " + what + " law; a body needs a material");
  };
  must_not_be(tribo::contact_laws().find(spec.type), "contact");
  must_not_be(tribo::joint_laws().find(spec.type), "joint");
}

// Reports properties that Tribo does not have and that are not of the law, which then need not look at them.
template <class Item>
void Builder::refuse_properties(const Statement& s, const Item& law, std::vector<std::string>& elsewhere) {
  for (const Statement& child : s.children) {
    const auto reason = reason_against(refused_properties(), child.name);
    const bool own = std::any_of(law.parameters.begin(), law.parameters.end(),
                                 [&](const auto& p) { return p.name == child.name || p.alias == child.name; }) ||
                     std::any_of(law.own_properties.begin(), law.own_properties.end(),
                                 [&](const auto& p) { return p.name == child.name; });
    if (reason.empty() || own) continue;
    elsewhere.push_back(child.name);
    const bool harmless = child.name == "allowsCracks" && child.text == "1";
    must(harmless, child.origin, "<" + child.name + "> is not supported by Tribo: " + std::string(reason));
  }
}

void Builder::materials() {
  for (const auto* s : material_statements_) {
    MaterialSpec spec;
    spec.name = word(*s, "Name");
    spec.statement = *s;
    spec.origin = s->origin;
    const Attribute* type = s->attribute("Type");
    const auto* item = type ? tribo::materials().find(type->text) : nullptr;
    const auto* law = type ? tribo::contact_laws().find(type->text) : nullptr;
    const auto* joint = type ? tribo::joint_laws().find(type->text) : nullptr;
    if (law) {
      spec.type = law->name;
      auto elsewhere = quiet_properties;
      refuse_properties(*s, *law, elsewhere);
      elsewhere.insert(elsewhere.end(), {"rho", "Friction"});
      if (s->child("E"))
        problems_.add(type->origin, "'" + law->name + "' is a contact law, but this looks like a solid");
      spec.contact = law->make(*s, elsewhere, model_.units, problems_);
    } else if (joint) {
      spec.type = joint->name;
      auto elsewhere = quiet_properties;
      refuse_properties(*s, *joint, elsewhere);
      spec.joint = joint->make(*s, elsewhere, model_.units, problems_);
    } else if (!type) {
      problems_.add(s->origin, "<Material> needs the attributes Type and Name");
    } else if (const auto reason = reason_against_type(type->text); !item && !reason.empty()) {
      problems_.add(type->origin,
                    "material type '" + type->text + "' is not supported by Tribo: " + std::string(reason));
    } else if (!item) {
      problems_.add(type->origin, "there is no material type '" + type->text + "'" +
                                      did_you_mean(type->text, law_names(false)) + "; valid: " + join(law_names(true)));
    } else {
      spec.type = item->name;
      auto elsewhere = quiet_properties;
      elsewhere.insert(elsewhere.end(), common_properties.begin(), common_properties.end());
      elsewhere.insert(elsewhere.end(), growth_properties.begin(), growth_properties.end());
      refuse_properties(*s, *item, elsewhere);
      const bool has_own_density =
          std::any_of(item->parameters.begin(), item->parameters.end(), [](const auto& p) { return p.name == "rho"; });
      if (!has_own_density) elsewhere.emplace_back("rho");
      if (item->number == 11 || item->number == 35)
        elsewhere.insert(elsewhere.end(), rigid_properties.begin(), rigid_properties.end());
      // A property that is a parameter of the law is read by the law.
      std::erase_if(elsewhere, [&](const std::string& name) {
        return std::any_of(item->parameters.begin(), item->parameters.end(),
                           [&](const auto& p) { return p.name == name || p.alias == name; });
      });
      spec.law = item->make(*s, elsewhere, model_.units, problems_);
      for (const auto& child : s->children)
        if (child.name == "PDamping")
          spec.particle_damping = text_number(child, Dimension::rate);
        else if (child.name == "Cv" || child.name == "Cp")
          spec.heat_capacity = thermal_property(child, Dimension::heat_capacity);
        else if (child.name == "kCond")
          spec.conductivity = thermal_property(child, Dimension::conductivity);
        else if (child.name == "alpha")
          spec.expansion = expansion(child);
        else if (child.name == "TaylorQuinney")
          spec.taylor_quinney = taylor_quinney(child);
        else if (std::find(elsewhere.begin(), elsewhere.end(), child.name) != elsewhere.end() && of_cracks(child.name))
          fracture_property(child, spec);
      if (spec.law && spec.law->rigid()) rigid_functions(*s, spec, item->number == 35);
    }
    model_.materials.push_back(std::move(spec));
  }
}

// Laws that localise have a largest admissible cell size.
void Builder::check_cell(const MaterialSpec& spec, double size, const Origin& origin) {
  must(size > 0, origin, "'cell' must be positive");
  const double most = spec.law ? spec.law->largest_cell() : size + 1;
  std::ostringstream message;
  message << std::setprecision(4) << "bands of cells " << size << " wide are too large for '" << spec.name << "' ("
          << spec.origin.text() << "): a crack would release more energy than it dissipates. They must be below "
          << most << " " << model_.units.name(Dimension::length)
          << "; use smaller cells, a larger fracture energy or a lower strength";
  must(size < most, origin, message.str());
}

void Builder::check_cells() {
  const Kernel kernel = model_.scheme.kernel;
  const bool splines = kernel != Kernel::linear && kernel != Kernel::gimp && kernel != Kernel::cpdi;
  double size = 0;
  for (std::size_t d = 0; d < static_cast<std::size_t>(model_.dimension()); ++d)
    size = std::max(size, (model_.grid.high[d] - model_.grid.low[d]) / model_.grid.cells[d]);
  // A crack normal to the diagonal of the cells has the widest band.
  const double widest = size * std::sqrt(model_.dimension());
  for (const auto& spec : model_.materials) {
    if (!(size > 0) || !spec.law || !std::isfinite(spec.law->largest_cell())) continue;
    check_cell(spec, widest, model_.grid.origin);
    must(!splines, spec.origin,
         "'" + spec.name +
             "' assumes a crack band of one cell, but splines spread a crack over two cells: it would dissipate 1.6 "
             "times its "
             "fracture energy. Use <GIMP type='uGIMP'/>, 'lCPDI' or 'Classic'");
  }
}

double Builder::taylor_quinney(const Statement& s) {
  const double share = text_number(s, Dimension::none);
  must(share >= 0 && share <= 1, s.origin, "<TaylorQuinney> must be a fraction from 0 to 1");
  must(work_heating(), s.origin, "<TaylorQuinney> needs <EnergyCoupling/> in <Thermal>, which converts work to heat");
  return share;
}

bool Builder::work_heating() const {
  const auto* thermal = root_.child("Thermal");
  return thermal && thermal->child("EnergyCoupling");
}

// The format has parts per million in all systems of units.
double Builder::expansion(const Statement& s) {
  must(to_number(s.text).has_value(), s.text.empty() ? s.origin : s.text_origin,
       "<" + s.name + "> needs one number, not '" + s.text + "'");
  return 1e-6 * text_number(s, Dimension::none);
}

double Builder::thermal_property(const Statement& s, Dimension dimension) {
  must(to_number(s.text).has_value(), s.text.empty() ? s.origin : s.text_origin,
       "<" + s.name + "> needs one number, not '" + s.text + "'");
  const double value = text_number(s, dimension);
  must(value >= 0, s.origin, "<" + s.name + "> must not be negative");
  return value;
}

// The prescribed motion of a rigid material. RigidContact (35), and Rigid (11) with <SetDirection>8, interact by
// contact; their functions 1, 2 and 3 set the velocities along x, y and z. Otherwise function n belongs to the n-th
// direction set.
void Builder::rigid_functions(const Statement& s, MaterialSpec& spec, bool contact) {
  constexpr int by_contact = 8;  // value of <SetDirection>; other values are sums of 1 (x), 2 (y) and 4 (z)
  int directions = contact ? by_contact : 0;
  std::array<const Statement*, 3> functions{};  // of the first, second and third direction that is set
  for (const auto& child : s.children) {
    if (child.name == "SetDirection") {
      directions = static_cast<int>(to_number(child.text).value_or(-1));
      must(!contact || directions == by_contact, child.origin,
           "a RigidContact material prescribes all directions; <SetDirection> belongs to Rigid (11)");
      must(directions >= 0 && directions <= by_contact, child.origin,
           "<SetDirection> is the sum of 1 (x), 2 (y) and 4 (z), or 8 for a body that interacts by contact");
    }
    if (child.name.rfind("SettingFunction", 0) == 0) {
      // Without a number it is that of the first direction that has none yet.
      const auto place = child.name.back() == '2'   ? functions.begin() + 1
                         : child.name.back() == '3' ? functions.begin() + 2
                                                    : std::find(functions.begin(), functions.end(), nullptr);
      if (place == functions.end() || *place)
        problems_.add(child.origin, "there is another <" + child.name + ">");
      else
        *place = &child;
    }
    if (child.name == "mirrored") spec.mirrored = static_cast<int>(to_number(child.text).value_or(2));
  }
  must(std::abs(spec.mirrored) <= 1, s.origin, "<mirrored> must be 1, -1, or 0 for not mirrored");
  must(spec.mirrored == 0 || directions == 1 || directions == 2 || directions == 4, s.origin,
       "<mirrored> needs one direction in <SetDirection>: 1, 2 or 4");
  spec.rigid_contact = directions == by_contact;
  if (spec.rigid_contact) {
    const Statement* solver = root_.child("MPMHeader");
    const bool active = solver && solver->child("MultiMaterialMode");
    must(active, s.origin, "a rigid body that interacts by contact needs <MultiMaterialMode> in <MPMHeader>");
    return set_functions(spec, functions, {true, true, model_.dimension() == 3});
  }
  for (std::size_t d = 0; d < 3; ++d) spec.sets_velocity[d] = directions >> d & 1;
  if (directions == 0)
    warn(s.origin, "the Rigid material '" + spec.name +
                       "' has no effect, as <SetDirection> gives no direction in which it prescribes the velocity. Use "
                       "RigidContact for a body that others touch, or <SetDirection>, for example 3 for x and y");
  set_functions(spec, functions, spec.sets_velocity);
}

// The functions belong to the directions that are set, one after the other.
void Builder::set_functions(MaterialSpec& spec, const std::array<const Statement*, 3>& functions,
                            const std::array<bool, 3>& directions) {
  std::size_t n = 0;
  for (std::size_t d = 0; d < 3; ++d) {
    if (!directions[d]) continue;
    if (const Statement* s = functions[n++])
      spec.rigid_velocity[d] = function(s->text, s->text_origin, "<" + s->name + ">");
  }
  for (; n < 3; ++n)
    if (functions[n])
      problems_.add(functions[n]->origin, "there are more <SettingFunction>s than directions" +
                                              std::string(spec.rigid_contact ? "" : " in <SetDirection>"));
}

}  // namespace tribo
