// SPDX-License-Identifier: MIT
/// Output: particle and grid files, columns of the histories.

#include "base/text.hpp"
#include "input/builder.hpp"
#include "input/dialect.hpp"
#include "materials/material.hpp"
#include "model/output_fields.hpp"
#include "model/quantities.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>

namespace tribo {
namespace {

// Whether a condition of a stage has this id.
bool has_condition(const Statement& s, int id) {
  const Attribute* a = s.name == "DisBC" ? s.attribute("id") : nullptr;
  return (a && to_number(a->text) == id) ||
         std::any_of(s.children.begin(), s.children.end(), [&](const Statement& c) { return has_condition(c, id); });
}

template <class Table>
std::vector<std::string> names_of(const Table& list) {
  std::vector<std::string> out;
  for (const auto& q : list) out.emplace_back(q.name);
  return out;
}

// Fields by their position in NairnMPM's archive order; empty: always written, or obsolete.
constexpr std::array<std::string_view, 27> archive_order{"",
                                                         "",
                                                         "velocity",
                                                         "stress",
                                                         "strain",
                                                         "history",
                                                         "",
                                                         "work_energy",
                                                         "temperature",
                                                         "plastic_energy",
                                                         "",
                                                         "shear components",
                                                         "strain_energy",
                                                         "history",
                                                         "concentration",
                                                         "heat_energy",
                                                         "cell_crossings",
                                                         "rotation",
                                                         "damage normal",
                                                         "spin momentum",
                                                         "spin velocity",
                                                         "history",
                                                         "history",
                                                         "history",
                                                         "particle size",
                                                         "",
                                                         ""};

}  // namespace

void Builder::check_outputs(const Origin& origin, double time, double interval, double most, const char* what) {
  if (!(interval > 0)) return;
  must(time / interval <= most, origin,
       format("the run would write %.3g %s; at most %.0e are possible. Is the unit of this time right?",
              time / interval, what, most));
}

void Builder::archive(const Statement& h) {
  OutputSpec& out = model_.output;
  double start = 0.0;
  if (const auto* first = h.child("FirstArchiveTime")) {
    start = text_number(*first, Dimension::time);
    must(start >= 0, first->origin, "<FirstArchiveTime> must not be negative");
  }
  std::vector<Origin> places;
  for (const auto& s : h.children) {
    if (s.name != "ArchiveTime" && s.name != "ArchiveGroup") continue;
    const bool group = s.name == "ArchiveGroup";
    const double interval = group ? number(s, "time", Dimension::time) : text_number(s, Dimension::time);
    must(interval > 0, s.origin, "the time between archives must be positive");
    const double from = group                 ? number(s, "start", Dimension::time)
                        : out.archive.empty() ? 0.0
                                              : out.archive.back().start + 1e-300;
    if (!group && !out.archive.empty()) {
      problems_.add(s.origin, "<ArchiveTime> is given twice; use <ArchiveGroup time= start=> for further intervals");
      continue;
    }
    must(out.archive.empty() || from > out.archive.back().start, s.origin,
         "each archive group must start later than the preceding one");
    out.archive.push_back({from, interval, 0});
    places.push_back(s.origin);
  }
  for (std::size_t k = 0; k < out.archive.size(); ++k) {
    const double until = k + 1 < out.archive.size() ? out.archive[k + 1].start : model_.time.end;
    check_outputs(places[k], std::min(until, model_.time.end) - out.archive[k].start, out.archive[k].interval, 1e6,
                  "particle files");
  }
  if (out.archive.empty()) {
    problems_.add(h.origin, "<MPMHeader> needs <ArchiveTime>, the time between particle files");
    return;
  }
  if (start > 0) {
    // The first file after the start comes at `start`, then at every interval.
    const double interval = out.archive.front().interval;
    must(out.archive.size() < 2 || start < out.archive[1].start, h.child("FirstArchiveTime")->origin,
         "the first file must come before the start of the next archive group");
    out.archive.front() = {0.0, 0.0, 0};
    out.archive.insert(out.archive.begin() + 1, {start, interval, 0});
  }
  if (const auto* g = h.child("GlobalArchiveTime")) {
    out.history_interval = text_number(*g, Dimension::time);
    must(out.history_interval > 0, g->origin, "<GlobalArchiveTime> must be positive");
    check_outputs(g->origin, model_.time.end, out.history_interval, 1e8, "rows of history.csv");
  }

  const auto add_field = [&](const std::string& name, const Origin& origin) {
    const auto* field = find_particle_field(name);
    if (const auto reason = reason_against(refused_outputs(), name); !field && !reason.empty())
      problems_.warn(origin, "the field '" + name + "' is not written: " + std::string(reason));
    else if (!field)
      unknown_fields_.emplace_back(name, origin);
    else if (std::find(out.particle_fields.begin(), out.particle_fields.end(), field->name) ==
             out.particle_fields.end())
      out.particle_fields.emplace_back(field->name);
  };
  if (const auto* order = h.child("MPMArchiveOrder"); order && !h.child("Output")) {
    for (const auto name : {"id", "material", "displacement", "volume_ratio"}) add_field(name, order->origin);
    for (std::size_t k = 2; k < archive_order.size() && k < order->text.size(); ++k) {
      const std::string field(archive_order[k]);
      if (order->text[k] == 'N' || field.empty()) continue;
      if (find_particle_field(field))
        add_field(field, order->text_origin);
      else
        warn(order->text_origin, "letter " + std::to_string(k + 1) + " selects the field " + field +
                                     ", which Tribo does not have; it is not written");
    }
    for (const auto name : {"velocity", "stress", "pressure", "von_mises"}) add_field(name, order->origin);
  }
  for (const auto& s : h.children) {
    if (s.name != "MPMArchive" || word(s, "setting", "yes") == "no") continue;
    const std::string name = word(s, "result");
    if (lower(name) == "jintegral" || lower(name) == "stressintensity")
      wants_tip_loads_ = s.origin;
    else
      add_field(name, s.origin);
  }
  // the third and fourth letters select J and the stress intensity factors
  if (const auto* order = h.child("CrackArchiveOrder"); order && root_.child("CrackList"))
    if (order->text.find_first_not_of('N', 2) < 4) wants_tip_loads_ = order->text_origin;
  if (const auto* o = h.child("Output")) {
    std::istringstream fields(word(*o, "fields")), grid(word(*o, "grid"));
    for (std::string name; fields >> name;) add_field(name, o->attribute("fields")->origin);
    for (std::string name; grid >> name;) {
      if (find_grid_field(name))
        out.grid_fields.push_back(name);
      else
        problems_.add(o->attribute("grid")->origin,
                      "'" + name + "' is no field of the grid files; valid: " + join(names_of(grid_fields())));
    }
    out.checkpoint_interval = number(*o, "checkpoint", Dimension::time);
    must(out.checkpoint_interval >= 0, o->origin, "the time between checkpoints must not be negative");
    if (out.checkpoint_interval > 0)
      check_outputs(o->origin, model_.time.end, out.checkpoint_interval, 1e6, "checkpoints");
  }
}

// Fields that do not exist may be variables of a law, which are known only with the materials.
void Builder::report_unknown_fields() {
  for (const auto& [name, origin] : unknown_fields_) {
    const auto has_variable = [&wanted = name](const MaterialSpec& m) {
      return m.law && std::any_of(m.law->history().begin(), m.law->history().end(),
                                  [&](const auto& variable) { return variable.name == wanted; });
    };
    const auto of = std::find_if(model_.materials.begin(), model_.materials.end(), has_variable);
    problems_.add(origin, "'" + name + "' is no field of the particle files" +
                              (of != model_.materials.end() ? ", but a variable of the history of '" + of->name +
                                                                  "'; the field 'history' writes all of them"
                                                            : did_you_mean(name, names_of(particle_fields()))) +
                              "; valid: " + join(names_of(particle_fields())));
  }
}

void Builder::history(const Statement& h) {
  for (const auto& s : h.children) {
    if (s.name != "GlobalArchive" || archives_blocks(s)) continue;
    HistoryQuantity q;
    q.name = q.column = word(s, "type");
    q.origin = s.origin;
    const auto* info = find_global_quantity(q.name);
    if (const auto reason = reason_against(refused_outputs(), q.name); !info && !reason.empty()) {
      problems_.add(s.attribute("type")->origin,
                    "the quantity '" + q.name + "' is not supported by Tribo: " + std::string(reason));
      continue;
    }
    if (!info) {
      const auto names = names_of(global_quantities());
      const std::string meant = did_you_mean(q.name, names);
      problems_.add(s.attribute("type")->origin,
                    "'" + q.name + "' is no quantity of the histories" + meant +
                        (meant.empty() ? "; valid: " + join(names) : "; 'tribo list' names all"));
      continue;
    }
    q.name = info->name;
    const Attribute* of = s.attribute("material") ? s.attribute("material") : s.attribute("mat");
    const bool reaction = info->name.rfind("reaction", 0) == 0;
    if (of && !s.attribute("matname") && !to_number(of->text)) {
      problems_.add(of->origin, "'" + of->name + "' needs the number of a material or the id of a condition, not '" +
                                    of->text + "'; 'matname' takes the name of a material");
    } else if (of && !s.attribute("matname") && to_number(of->text).value_or(1) <= 0) {
      q.condition_id = static_cast<int>(to_number(of->text).value_or(0));
      must(reaction, of->origin,
           "a number <= 0 is the id of a condition and belongs to reactionx, reactiony or reactionz");
      q.column += ":" + of->text;
    } else if (of || s.attribute("matname")) {
      must(info->scope != Scope::run, s.origin, "'" + q.name + "' is not a quantity of one material");
      q.material = material(s, s.attribute("material") ? "material" : "mat");
      if (q.material >= 0 && q.material < static_cast<int>(material_statements_.size()))
        q.column += ":" + word(*material_statements_[static_cast<std::size_t>(q.material)], "Name");
    }
    if (s.attribute("with") || s.attribute("withname")) {
      must(info->name.rfind("contact", 0) == 0 || info->name.rfind("Contact", 0) == 0 ||
               info->name == "Friction Work" || info->name == "Impact Work" || info->name == "Interface Energy",
           s.origin,
           "'with' names the other material of a contact quantity, but '" + q.name + "' is not a contact quantity");
      must(q.material >= 0, s.origin, "'with' also needs 'matname' or 'material'");
      q.other = material(s, "with", "withname");
      if (q.other < static_cast<int>(material_statements_.size()))
        q.column += ":" + word(*material_statements_[static_cast<std::size_t>(q.other)], "Name");
    }
    if (const auto* at = s.attribute("pt")) {
      must(info->scope == Scope::particle, s.origin, "'" + q.name + "' is not a quantity of one particle");
      q.point = history_point(*at);
      q.column += ":" + at->text;
    }
    model_.output.history.push_back(q);
  }
}

// 'x,y' or 'x,y,z' in the grid
Vec3 Builder::history_point(const Attribute& at) {
  std::vector<double> x;
  std::istringstream list(at.text);
  for (std::string item; std::getline(list, item, ',');) x.push_back(to_number(item).value_or(std::nan("")));
  const auto dim = static_cast<std::size_t>(model_.dimension());
  const bool readable = x.size() == dim && std::none_of(x.begin(), x.end(), [](double v) { return std::isnan(v); });
  must(readable, at.origin, dim == 2 ? "'pt' must be a point 'x,y'" : "'pt' must be a point 'x,y,z'");
  return readable ? Vec3(x[0], x[1], dim == 3 ? x[2] : 0.0) : Vec3(Vec3::Zero());
}

// Elastic strains follow from the stress by Hooke's law, or are the total strains of laws that do not dissipate.
void Builder::check_elastic_strain(const HistoryQuantity& q) {
  for (std::size_t k = 0; k < model_.materials.size(); ++k) {
    const auto& spec = model_.materials[k];
    const bool asked = q.material < 0 || q.material == static_cast<int>(k);
    if (!asked || !spec.law || spec.law->rigid()) continue;
    const bool constant = spec.type != "Viscoelastic" && spec.type != "CamClay";
    must(spec.law->dissipation_index() < 0 || (constant && elastic_moduli(*spec.law)), q.origin,
         "'" + q.column + "': '" + spec.name +
             "' dissipates and has no constant isotropic moduli, so that its elastic strain is not known; use '" +
             q.name.substr(0, 3) + "'");
  }
}

// The history variable that a history names by its number in the law, from 1, or by its name.
void Builder::find_variable(HistoryQuantity& q) {
  const std::string wanted(history_variable_of(q.column.substr(0, q.column.find(':'))));
  must(!wanted.empty(), q.origin, "'history' is followed by a blank and the number or name of a history variable");
  int solids = 0;
  for (std::size_t k = 0; k < model_.materials.size() && q.material < 0; ++k)
    if (model_.materials[k].law && !model_.materials[k].law->rigid()) ++solids;
  for (std::size_t k = 0; k < model_.materials.size() && q.material < 0 && solids == 1; ++k)
    if (model_.materials[k].law && !model_.materials[k].law->rigid()) q.material = static_cast<int>(k);
  if (q.material < 0) {
    problems_.add(q.origin, "'" + q.column + "' is a variable of one material; name it by 'matname' or 'material'");
    return;
  }
  const auto& spec = model_.materials[static_cast<std::size_t>(q.material)];
  if (!spec.law || wanted.empty()) return;
  std::vector<std::string> names;
  for (const auto& variable : spec.law->history()) names.push_back(variable.name);
  const auto found = std::find(names.begin(), names.end(), wanted);
  const double number = to_number(wanted).value_or(0);
  if (found != names.end())
    q.variable = static_cast<int>(found - names.begin());
  else if (number >= 1 && number <= static_cast<double>(names.size()) && number == std::floor(number))
    q.variable = static_cast<int>(number) - 1;
  else
    problems_.add(q.origin, "'" + spec.name + "' has no history variable '" + wanted + "'" +
                                (names.empty() ? "; it has none" : "; it has, from 1 on: " + join(names)));
}

// Checks that need all materials and conditions.
void Builder::check_histories() {
  for (auto& q : model_.output.history) {
    if (is_elastic_strain(*find_global_quantity(q.name))) check_elastic_strain(q);
    if (q.name == "history") find_variable(q);
    if (q.name.rfind("reaction", 0) != 0) continue;
    if (q.material >= 0) {
      const auto& spec = model_.materials[static_cast<std::size_t>(q.material)];
      must(spec.law && spec.law->rigid() && !spec.touches(), q.origin,
           "'" + q.name + "' of a material is the reaction of a Rigid material; '" + spec.name +
               "' is not a Rigid material (for RigidContact materials use 'contactx'; a condition is named by its id, "
               "which is at most 0)");
    } else if (q.condition_id < 0) {
      bool known = std::any_of(model_.node_conditions.begin(), model_.node_conditions.end(),
                               [&](const NodeCondition& c) { return c.id == q.condition_id; });
      for (int axis = 0; axis < 3; ++axis)
        for (int side = 0; side < 2; ++side)
          known = known || (symmetry_plane_id(axis, side) == q.condition_id &&
                            model_.grid.symmetry[static_cast<std::size_t>(axis)][static_cast<std::size_t>(side)]);
      // Conditions may come and go with stages.
      known = known || !order_.empty() || has_condition(root_, q.condition_id);
      must(known, q.origin,
           "no condition has the id " + std::to_string(q.condition_id) +
               " (symmetry planes: -10 and -11 for x, -20 and -21 for y, -30 and -31 for z)");
    }
  }
}

}  // namespace tribo
