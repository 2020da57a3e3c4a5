// SPDX-License-Identifier: MIT
/// CustomTasks: settings of the scheme and of the output that NairnMPM calls tasks.

#include "base/text.hpp"
#include "input/builder.hpp"
#include "input/dialect.hpp"
#include "model/output_fields.hpp"
#include "model/quantities.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace tribo {
namespace {

const std::vector<std::string> known_tasks{"PeriodicXPIC",  "AdjustTimeStep", "VTKArchive",  "HistoryArchive",
                                           "PropertyRamp",  "ThermalRamp",    "ReverseLoad", "LoadControl",
                                           "DeleteDamaged", "FluidSource"};

// The quantity of ReverseLoad may be part of the name of a parameter: 'global dispx'.
constexpr std::string_view global = "global ";

// Parameters that Tribo does not have.
const std::vector<RefusedName>& refused_parameters() {
  constexpr std::string_view heat = "a filter of the heat transfer is not implemented",
                             diffusion = "diffusion is not implemented",
                             image = "a ramp given by an image is not implemented; use scale, a function of x, y and z";
  static const std::vector<RefusedName> all{
      {"periodicCFL", "it is not implemented; use periodicSteps or periodicTime"},
      {"GridBCOption", "it is not implemented; prescribed velocities hold after the filter"},
      {"FMPMOrderConduction", heat},
      {"XPICOrderConduction", heat},
      {"periodicStepsConduction", heat},
      {"periodicTimeConduction", heat},
      {"periodicCFLConduction", heat},
      {"FMPMOrderDiffusion", diffusion},
      {"XPICOrderDiffusion", diffusion},
      {"periodicStepsDiffusion", diffusion},
      {"periodicTimeDiffusion", diffusion},
      {"periodicCFLDiffusion", diffusion},
      {"file", image},
      {"xorigin", image},
      {"yorigin", image},
      {"zlevel", image},
      {"width", image},
      {"height", image},
      {"flipped", image},
      {"DeltaTmin", image},
      {"DeltaTmax", image},
      {"DeltaMin", image},
      {"DeltaMax", image}};
  return all;
}

// Particle fields by the quantities of VTKArchive whose names differ.
std::string field_of(const std::string& quantity) {
  static const std::vector<std::pair<std::string, std::string>> all{{"totalstrain", "strain"},
                                                                    {"deltav", "volume_ratio"},
                                                                    {"equivstress", "von_mises"},
                                                                    {"contactforce", "contact_traction"}};
  for (const auto& [name, field] : all)
    if (lower(quantity) == name) return field;
  return quantity;
}

}  // namespace

const std::vector<std::string>& task_names() { return known_tasks; }

bool knows_parameter(const std::string& task, const std::string& name) {
  const auto names = parameter_names(task);
  if (std::find(names.begin(), names.end(), name) != names.end()) return true;
  if (task == "VTKArchive") return find_grid_field(name) || find_particle_field(field_of(name));
  if (task == "ReverseLoad") return name.starts_with(global);
  return task == "HistoryArchive" && to_number(name).has_value();
}

std::string_view reason_against_parameter(std::string_view name) {
  // those of diffusion end in the number of the diffusing substance
  while (!name.empty() && name.back() >= '0' && name.back() <= '9') name.remove_suffix(1);
  const auto reason = reason_against(refused_parameters(), name);
  return reason.empty() ? reason_against(refused_outputs(), name) : reason;
}

void Builder::tasks() {
  const auto* tasks = root_.child("CustomTasks");
  if (!tasks) return;
  for (const auto& schedule : tasks->children)
    if (schedule.name == "Schedule") task(schedule);
}

void Builder::task(const Statement& schedule) {
  const std::string name = word(schedule, "name");
  if (const auto reason = reason_against(refused_tasks(), name); !reason.empty()) {
    problems_.add(schedule.attribute("name")->origin,
                  "the task '" + name + "' is not supported by Tribo: " + std::string(reason));
    return;
  }
  if (std::find(known_tasks.begin(), known_tasks.end(), name) == known_tasks.end()) {
    problems_.add(
        schedule.attribute("name")->origin,
        "there is no task '" + name + "'" + did_you_mean(name, known_tasks) + "; valid: " + join(known_tasks));
    return;
  }
  check_parameters(schedule, name);
  if (name == "PeriodicXPIC") periodic_filter(schedule);
  if (name == "AdjustTimeStep") adjust_step(schedule);
  if (name == "ReverseLoad") reverse_load(schedule);
  if (name == "LoadControl") load_control(schedule);
  if (name == "DeleteDamaged") deletion(schedule);
  if (name == "FluidSource") source(schedule);
  if (name == "PropertyRamp" || name == "ThermalRamp") property_ramp(schedule);
  if (name == "VTKArchive" || name == "HistoryArchive") archive_task(schedule);
}

void Builder::check_parameters(const Statement& schedule, const std::string& task) {
  const bool archives = task.ends_with("Archive");
  for (const auto& p : schedule.children) {
    const std::string name = word(p, "name");
    if (knows_parameter(task, name)) continue;
    const auto reason = reason_against_parameter(name);
    if (!reason.empty() && archives) {
      problems_.warn(p.origin, "'" + name + "' of " + task + " is not written: " + std::string(reason));
      continue;
    }
    problems_.add(p.origin, "task " + task + " has no parameter '" + name + "' in Tribo" +
                                (reason.empty() ? did_you_mean(name, parameter_names(task)) +
                                                      "; valid: " + join(parameter_names(task))
                                                : ": " + std::string(reason)));
  }
}

// Calls set(value) if the task has a parameter with this name.
void Builder::parameter(const Statement& schedule, const char* wanted,
                        const std::function<void(const Statement&, double)>& set) {
  for (const auto& p : schedule.children) {
    if (word(p, "name") != wanted) continue;
    const auto value = to_number(p.text);
    must(value.has_value(), p.text.empty() ? p.origin : p.text_origin,
         "parameter '" + std::string(wanted) + "' needs a number");
    set(p, value.value_or(1.0));
  }
}

void Builder::periodic_filter(const Statement& schedule) {
  Scheme& scheme = model_.scheme;
  parameter(schedule, "FMPMOrder", [&](const Statement&, double v) {
    scheme.transfer = Transfer::fmpm, scheme.filter_order = static_cast<int>(v);
  });
  parameter(schedule, "XPICOrder", [&](const Statement&, double v) {
    scheme.transfer = Transfer::xpic, scheme.filter_order = static_cast<int>(v);
  });
  parameter(schedule, "periodicSteps", [&](const Statement& p, double v) {
    must(v >= 1, p.text_origin, "periodicSteps must be at least 1");
    scheme.filter_every = static_cast<int>(v);
  });
  parameter(schedule, "periodicTime",
            [&](const Statement&, double v) { scheme.filter_period = v * model_.units.alternative_time(); });
  must(scheme.filter_order >= 1 && scheme.filter_order <= 100, schedule.origin, "the order must be in 1 ... 100");
}

void Builder::adjust_step(const Statement& schedule) {
  model_.time.adaptive = true;
  parameter(schedule, "velocityCFL", [&](const Statement& p, double v) {
    must(v > 0, p.text_origin, "velocityCFL must be positive");
    model_.time.velocity_courant = v;
  });
  parameter(schedule, "maxIncrease", [&](const Statement& p, double v) {
    must(v > 0, p.text_origin, "maxIncrease must be positive");
    model_.time.max_increase = v > 1 ? v : 1 + v;
  });
}

void Builder::reverse_load(const Statement& schedule) {
  must(!model_.reversal, schedule.origin, "a model has one ReverseLoad");
  LoadReversal reversal;
  const bool length = std::any_of(schedule.children.begin(), schedule.children.end(), [&](const Statement& p) {
    return word(p, "name") == "maxLength" || word(p, "name") == "crackNumber";
  });
  parameter(schedule, "style", [&](const Statement& p, double v) {
    using Style = LoadReversal::Style;
    const std::map<double, Style> styles{{0, Style::reverse}, {1, Style::hold}, {2, Style::none}, {3, Style::stop}};
    const auto found = styles.find(v);
    must(found != styles.end() && (length || v != 2), p.text_origin,
         length ? "'style' must be 0 (the loads go back), 1 (they are held), 2 (they go on, and only the growth of "
                  "cracks ends) or 3 (the run ends)"
                : "'style' must be 0 (the loads go back), 1 (they are held) or 3 (the run ends)");
    if (found != styles.end()) reversal.style = found->second;
  });
  parameter(schedule, "hold", [&](const Statement& p, double v) {
    must(v >= 0, p.text_origin, "'hold' is the time for which the loads are held before they go back");
    must(reversal.style == LoadReversal::Style::reverse, p.text_origin,
         "'hold' belongs to style 0, in which the loads go back");
    reversal.hold = v * model_.units.alternative_time();
  });
  if (length ? reversal_by_length(schedule, reversal) : reversal_by_history(schedule, reversal))
    model_.reversal = reversal;
}

// A crack reaches a length.
bool Builder::reversal_by_length(const Statement& schedule, LoadReversal& reversal) {
  double crack = 0, most = 0;
  for (const auto& p : schedule.children) {
    const std::string name = word(p, "name");
    must(name == "maxLength" || name == "crackNumber" || name == "style" || name == "hold", p.origin,
         "'" + name + "' belongs to a reversal by a quantity; this one is by the length of a crack");
  }
  parameter(schedule, "crackNumber", [&](const Statement& p, double v) {
    must(v >= 0 && v == std::floor(v), p.text_origin, "'crackNumber' is the number of a crack, or 0 for any");
    crack = v;
  });
  parameter(schedule, "maxLength", [&](const Statement& p, double v) {
    must(v > 0, p.text_origin, "'maxLength' must be positive");
    most = v * model_.units.factor(Dimension::length);
  });
  must(std::any_of(schedule.children.begin(), schedule.children.end(),
                   [&](const Statement& p) { return word(p, "name") == "maxLength"; }),
       schedule.origin, "ReverseLoad by the length of a crack needs 'maxLength'");
  must(crack <= static_cast<double>(model_.cracks.size()), schedule.origin,
       "there is no crack number " + std::to_string(static_cast<long>(crack)) + "; the model has " +
           std::to_string(model_.cracks.size()));
  must(std::any_of(model_.materials.begin(), model_.materials.end(),
                   [](const MaterialSpec& m) { return m.growth.when != Growth::When::never; }),
       schedule.origin, "no crack of this model grows: its materials have no criterion for it (<Propagate>)");
  reversal.value = most;
  reversal.crack = crack > 0 ? static_cast<std::size_t>(crack) - 1 : std::numeric_limits<std::size_t>::max();
  return most > 0;
}

// The quantity is a column of the histories, which is added if it is missing.
bool Builder::reversal_by_history(const Statement& schedule, LoadReversal& reversal) {
  Statement column;
  column.name = "GlobalArchive", column.origin = schedule.origin;
  const Statement* value = nullptr;
  for (const auto& p : schedule.children) {
    const std::string name = word(p, "name");
    if (name == "quantity") column.attributes.push_back({"type", p.text, p.text_origin});
    if (name.starts_with(global))
      column.attributes.push_back({"type", name.substr(global.size()), p.attribute("name")->origin});
    if (name == "material" || name == "mat")
      column.attributes.push_back({to_number(p.text) ? "material" : "matname", p.text, p.text_origin});
    if (name == "maxValue") value = &p;
  }
  if (!column.attribute("type") || !value) {
    problems_.add(schedule.origin,
                  "ReverseLoad needs a quantity, such as <Parameter name='global dispx'/>, and maxValue; or maxLength, "
                  "the length of a crack");
    return false;
  }
  Statement all;
  all.children.push_back(column);
  auto& columns = model_.output.history;
  const std::size_t before = columns.size();
  history(all);
  if (columns.size() == before) return false;
  reversal.history = static_cast<std::size_t>(
      std::find_if(columns.begin(), columns.end(), [&](const auto& q) { return q.column == columns.back().column; }) -
      columns.begin());
  if (reversal.history < before) columns.pop_back();
  const double unit = factor_of_history(columns[reversal.history], *value);
  parameter(schedule, "maxValue", [&](const Statement&, double v) { reversal.value = v * unit; });
  parameter(schedule, "minValue", [&](const Statement& p, double v) {
    must(reversal.style == LoadReversal::Style::reverse, p.text_origin,
         "'minValue' belongs to style 0, in which the loads go back");
    reversal.least = v * unit;
  });
  return true;
}

// The gains are those of Tribo's controller; NairnMPM has its own.
void Builder::load_control(const Statement& schedule) {
  must(!model_.load_control, schedule.origin, "a model has one LoadControl");
  LoadControl control;
  const Units& units = model_.units;
  control.function_time = units.alternative_time(), control.load_unit = units.factor(Dimension::force);
  control.fastest = 5e3 * (units.legacy ? 1.0 : std::numeric_limits<double>::infinity());
  bool has_load = false, has_material = false;
  for (const auto& p : schedule.children) {
    const std::string name = word(p, "name");
    if (name == "Load_Function")
      control.load = function(p.text, p.text_origin, "parameter 'Load_Function'"), has_load = true;
    if (name != "material" && name != "mat") continue;
    control.material = material_of_parameter(schedule, p), has_material = true;
  }
  must(has_material && has_load, schedule.origin,
       "LoadControl needs 'material', the number or name of a rigid material, and 'Load_Function'");
  if (control.material < 0 || !has_load) return;
  const auto& spec = model_.materials.at(static_cast<std::size_t>(control.material));
  must(spec.law && spec.law->rigid(), schedule.origin,
       "LoadControl moves a rigid material; '" + spec.name + "' is none");
  parameter(schedule, "direction", [&](const Statement& p, double v) {
    must(v >= 1 && v <= model_.dimension() && v == std::floor(v), p.text_origin,
         "'direction' must be 1 (x), 2 (y) or 3 (z)");
    control.axis = static_cast<int>(v) - 1;
  });
  must(!spec.rigid_velocity[static_cast<std::size_t>(control.axis)], schedule.origin,
       "'" + spec.name + "' has a function for its velocity in this direction, which LoadControl sets");
  parameter(schedule, "velocity",
            [&](const Statement&, double v) { control.start = units.factor(Dimension::velocity) * v; });
  parameter(schedule, "MaxVelocity", [&](const Statement& p, double v) {
    must(v > 0, p.text_origin, "'MaxVelocity' must be positive");
    control.fastest = units.factor(Dimension::velocity) * v;
  });
  const double second = units.factor(Dimension::time);
  parameter(schedule, "Kp", [&](const Statement&, double v) { control.Kp = v / second; });
  parameter(schedule, "Ki", [&](const Statement&, double v) { control.Ki = v / second / second; });
  parameter(schedule, "Kd", [&](const Statement&, double v) { control.Kd = v; });
  parameter(schedule, "smooth", [&](const Statement& p, double v) {
    must(v >= 0 && v < 1, p.text_origin, "'smooth' must be at least 0 and below 1");
    control.smooth = v;
  });
  must(control.start != 0, schedule.origin,
       "LoadControl needs 'velocity', with which the material moves until its force has been felt");
  must(control.Kp > 0, schedule.origin,
       "LoadControl needs 'Kp' > 0: the velocity is Kp times the error of the position [1/time]");
  model_.load_control = control;
}

// Factor from the units of the file to those of history.csv.
double Builder::factor_of_history(const HistoryQuantity& q, const Statement& value) {
  if (!model_.units.legacy) return 1.0;
  const std::string_view unit = find_global_quantity(q.name)->unit;
  for (const auto d :
       {Dimension::stress, Dimension::force, Dimension::length, Dimension::velocity, Dimension::temperature})
    if (unit == dimension_name(d)) return model_.units.factor(d);
  problems_.add(value.origin,
                "a value of '" + q.column + "' needs <ConsistentUnits>: its unit in legacy files is not known");
  return 1.0;
}

void Builder::property_ramp(const Statement& schedule) {
  TemperatureRamp ramp;
  ramp.function_time = model_.units.alternative_time();
  for (const auto& p : schedule.children) {
    const std::string name = word(p, "name");
    if (name == "property")
      must(p.text == "1" || lower(p.text) == "temperature", p.text_origin,
           "a ramp of another property than the temperature (1) is not implemented");
    if (name == "scale") ramp.share = function(p.text, p.text_origin, "parameter 'scale'");
  }
  const auto time = [&](const char* name, double& to) {
    parameter(schedule, name, [&](const Statement& p, double v) {
      must(v >= 0, p.text_origin, "'" + std::string(name) + "' must not be negative");
      to = v * ramp.function_time;
    });
  };
  time("time", ramp.duration), time("start", ramp.start);
  for (const char* name : {"Delta", "DeltaT"})
    parameter(schedule, name, [&](const Statement&, double v) { ramp.change = v; });
  parameter(schedule, "sigmoidal", [&](const Statement&, double v) { ramp.sigmoidal = v != 0; });
  parameter(schedule, "exponential", [&](const Statement&, double v) { ramp.lifetimes = v; });
  parameter(schedule, "stretch", [&](const Statement& p, double v) {
    must(v > 0, p.text_origin, "'stretch' must be positive");
    ramp.stretch = v;
  });
  must(ramp.change != 0, schedule.origin, "a ramp needs 'Delta', the change of the temperature");
  model_.heat.ramps.push_back(std::move(ramp));
}

// The fields that VTKArchive extrapolates to the grid are written with the particles, which they belong to; mass and
// velocity of the nodes with the grid.
void Builder::archive_task(const Statement& schedule) {
  const bool history = word(schedule, "name") == "HistoryArchive";
  OutputSpec& out = model_.output;
  const auto also_write = [&](const std::string& field) {
    auto& fields = out.particle_fields;
    const auto& standard = standard_particle_fields();
    if (fields.empty() && std::find(standard.begin(), standard.end(), field) != standard.end()) return;
    if (fields.empty()) fields = standard;
    if (std::find(fields.begin(), fields.end(), field) == fields.end()) fields.push_back(field);
  };
  for (const auto& p : schedule.children) {
    const std::string name = word(p, "name");
    if (name == "archiveTime" || name == "firstArchiveTime") {
      archive_task_time(p, name == "archiveTime");
    } else if (name == "selectMaterial") {
      problems_.warn(p.origin,
                     "'selectMaterial' has no effect: the files contain all materials; select one in ParaView");
    } else if (history) {
      if (to_number(name)) also_write("history");
    } else if (find_grid_field(name)) {
      auto& fields = out.grid_fields;
      if (std::find(fields.begin(), fields.end(), name) == fields.end()) fields.push_back(name);
    } else if (const auto* field = find_particle_field(field_of(name))) {
      also_write(std::string(field->name));
    }
  }
}

void Builder::archive_task_time(const Statement& p, bool interval) {
  const auto number = to_number(p.text);
  must(number && *number >= 0, p.text.empty() ? p.origin : p.text_origin,
       "parameter '" + word(p, "name") + "' needs a time");
  const double time = number.value_or(0) * model_.units.alternative_time();
  const auto& groups = model_.output.archive;
  const bool same = interval ? !groups.empty() && std::abs(groups.back().interval - time) <= 1e-9 * time
                             : time == 0 || (groups.size() > 1 && std::abs(groups[1].start - time) <= 1e-9 * time);
  if (!same)
    problems_.warn(p.origin, "'" + word(p, "name") +
                                 "' of a task has no effect: its fields are in the particle and grid "
                                 "files, which are written at the times of <ArchiveTime>");
}

}  // namespace tribo
