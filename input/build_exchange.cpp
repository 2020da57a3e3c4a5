// SPDX-License-Identifier: MIT
/// Tasks that remove and add particles: DeleteDamaged and FluidSource.

#include "input/builder.hpp"

#include "materials/material.hpp"

#include <algorithm>
#include <cmath>

namespace tribo {

// The material that a parameter of a task names; -1 after an error.
int Builder::material_of_parameter(const Statement& schedule, const Statement& p) {
  Statement reference = schedule;
  reference.attributes = {{to_number(p.text) ? "mat" : "matname", p.text, p.text_origin}};
  const std::size_t before = problems_.list().size();
  const int found = material(reference);
  return problems_.list().size() > before ? -1 : found;
}

// The material that the parameters of a task name; -1 after an error.
int Builder::material_of_task(const Statement& schedule) {
  for (const auto& p : schedule.children) {
    const std::string name = word(p, "name");
    if (name == "material" || name == "matname") return material_of_parameter(schedule, p);
  }
  problems_.add(schedule.origin, word(schedule, "name") + " needs 'material' or 'matname'");
  return -1;
}

void Builder::deletion(const Statement& schedule) {
  DeletionSpec spec;
  spec.material = material_of_task(schedule);
  if (spec.material < 0) return;
  const MaterialSpec& of = model_.materials.at(static_cast<std::size_t>(spec.material));
  parameter(schedule, "minCOD", [&](const Statement& p, double v) {
    must(v >= 0, p.text_origin, "'minCOD' must not be negative");
    spec.opening = v * model_.units.factor(Dimension::length);
  });
  parameter(schedule, "direction", [&](const Statement& p, double v) {
    must(v == 1, p.text_origin,
         "'direction' must be 1: what is known of the crack in a particle is its opening (crack_opening)");
  });
  parameter(schedule, "deleteTime", [&](const Statement& p, double v) {
    must(v > 0, p.text_origin, "'deleteTime' must be positive");
    spec.time = v * model_.units.alternative_time();
  });
  for (const char* name : {"store_x", "store_y", "store_z"})
    parameter(schedule, name, [&](const Statement& p, double) {
      problems_.warn(p.origin, "particles are removed and not stored, so '" + std::string(name) + "' has no effect");
    });
  const auto knows = [&](const char* variable) {
    const auto& all = of.law->history();
    return std::any_of(all.begin(), all.end(), [&](const auto& v) { return v.name == variable; });
  };
  if (!of.law) return;
  must(spec.time >= 0 || knows("damage"), schedule.origin,
       "'" + of.name + "' has no damage, as IsoSoftening has; give 'deleteTime' to remove its particles at a time");
  must(!(spec.opening > 0) || knows("crack_opening"), schedule.origin,
       "'" + of.name + "' has no crack whose opening could be compared with 'minCOD'");
  model_.deletions.push_back(spec);
}

// Whether the model has a source, of which particles will come.
bool Builder::has_source() const {
  const Statement* tasks = root_.child("CustomTasks");
  return tasks && std::any_of(tasks->children.begin(), tasks->children.end(), [](const Statement& s) {
           const Attribute* name = s.attribute("name");
           return name && name->text == "FluidSource";
         });
}

void Builder::source(const Statement& schedule) {
  SourceSpec source;
  source.material = material_of_task(schedule);
  if (source.material < 0) return;
  const MaterialSpec& of = model_.materials.at(static_cast<std::size_t>(source.material));
  must(of.law && !of.law->rigid(), schedule.origin, "'" + of.name + "' is rigid; a source gives deformable particles");
  must(model_.analysis != Analysis::axisymmetric, schedule.origin, "FluidSource is not built for axisymmetric models");
  const Units& units = model_.units;
  const double length_unit = units.factor(Dimension::length);
  Vec3 flow = Vec3::Zero();
  double relative = 1.0;
  bool has_rate = false;
  constexpr const char *flows[] = {"flow_x", "flow_y", "flow_z"}, *centres[] = {"source_x", "source_y", "source_z"};
  for (Eigen::Index d = 0; d < model_.dimension(); ++d) {
    parameter(schedule, flows[d], [&](const Statement&, double v) { flow[d] = v; });
    parameter(schedule, centres[d], [&](const Statement&, double v) { source.centre[d] = v * length_unit; });
  }
  const auto read_positive = [&](const char* name, double factor, double& to) {
    parameter(schedule, name, [&](const Statement& p, double v) {
      must(v > 0, p.text_origin, "'" + std::string(name) + "' must be positive");
      to = v * factor;
    });
  };
  read_positive("inlet_width", length_unit, source.width), read_positive("inlet_depth", length_unit, source.depth);
  read_positive("particle_size", 1.0, relative);
  parameter(schedule, "FlowRate", [&](const Statement& p, double v) {
    must(v >= 0, p.text_origin, "'FlowRate' must not be negative");
    source.rate = Expression(v), has_rate = true;
  });
  for (const auto& p : schedule.children)
    if (word(p, "name") == "FlowFunction") {
      must(!has_rate, p.origin, "'FlowRate' and 'FlowFunction' exclude each other; give one of them");
      source.rate = function(p.text, p.text_origin, "parameter 'FlowFunction'"), has_rate = true;
    }
  source.function_time = units.alternative_time();
  must(has_rate, schedule.origin, "FluidSource needs 'FlowRate' or 'FlowFunction', a volume per time");
  must(source.width > 0, schedule.origin, "FluidSource needs 'inlet_width'");
  const bool plane = model_.dimension() == 2;
  const bool along_axis = (flow.array() != 0).count() == 1;
  must(flow.norm() > 0 && (plane || along_axis), schedule.origin,
       "FluidSource needs the direction of the flow, flow_x, flow_y" +
           std::string(plane ? "" : ", flow_z; in space it is along an axis"));
  if (!(flow.norm() > 0) || !(source.width > 0)) return;
  double extent = 0.0;
  for (std::size_t d = 0; d < static_cast<std::size_t>(model_.dimension()); ++d) {
    const double at = source.centre[static_cast<Eigen::Index>(d)];
    extent = std::max(extent, model_.grid.high[d] - model_.grid.low[d]);
    must(at >= model_.grid.low[d] && at <= model_.grid.high[d], schedule.origin,
         "the inlet of FluidSource, source_x, source_y" + std::string(plane ? "" : ", source_z") +
             ", lies outside of the grid");
    if (at < model_.grid.low[d] || at > model_.grid.high[d]) return;
  }
  must(std::max(source.width, source.depth) <= extent, schedule.origin, "the inlet is larger than the grid");
  if (std::max(source.width, source.depth) > extent) return;
  source.direction = flow.normalized();
  double cell = (model_.grid.high[0] - model_.grid.low[0]) / model_.grid.cells[0];
  for (std::size_t d = 1; d < static_cast<std::size_t>(model_.dimension()); ++d)
    cell = std::min(cell, (model_.grid.high[d] - model_.grid.low[d]) / model_.grid.cells[d]);
  const int points = model_.points_per_cell > 0 ? model_.points_per_cell : plane ? 4 : 8;
  const double per_axis = plane ? std::sqrt(points) : std::cbrt(points);
  source.size = relative * cell / std::round(per_axis);
  // the inlet is a whole number of particles wide
  const auto fit = [&](double& edge, int& count) {
    count = std::max(1, static_cast<int>(std::lround(edge / source.size)));
    edge = count * source.size;
  };
  if (!plane && source.depth == 0) source.depth = source.width;
  fit(source.width, source.count[0]);
  if (plane)
    source.depth = model_.grid.thickness;
  else
    fit(source.depth, source.count[1]);
  model_.sources.push_back(source);
  source_conditions(source, schedule.origin);
}

// The flow is prescribed on the nodes from three cells before the inlet to one behind it, so that the rows keep their
// distance while they enter.
void Builder::source_conditions(const SourceSpec& source, const Origin& origin) {
  double cell = 0.0;
  for (std::size_t d = 0; d < static_cast<std::size_t>(model_.dimension()); ++d)
    cell = std::max(cell, (model_.grid.high[d] - model_.grid.low[d]) / model_.grid.cells[d]);
  const Vec3& n = source.direction;
  const Vec3 low = source.centre - 3 * cell * n, high = source.centre + 1.25 * cell * n;
  const double beside = 0.5 * source.width + 0.25 * cell;
  RegionPtr where;
  if (model_.dimension() == 2) {
    const Vec<2> across = beside * Vec<2>(n[1], -n[0]), a = low.head<2>(), b = high.head<2>();
    where = polygon({a + across, b + across, b - across, a - across});
  } else {
    Eigen::Index axis = 0;
    n.cwiseAbs().maxCoeff(&axis);
    Vec3 half = Vec3::Zero();
    const Eigen::Index wide = axis == 0 ? 1 : 0, deep = axis == 2 ? 1 : 2;  // as the rows of particles
    half[wide] = beside, half[deep] = 0.5 * source.depth + 0.25 * cell;
    where = box(low.cwiseMin(high) - half, low.cwiseMax(high) + half);
  }
  for (Eigen::Index d = 0; d < model_.dimension(); ++d) {
    NodeCondition condition;
    condition.where = where, condition.origin = origin;
    condition.direction = Vec3::Unit(d);
    Prescribed& v = condition.velocity;
    v.style = style_of("function"), v.function = source.rate;
    v.function_time = source.function_time;
    v.function_scale = n[d] / (source.width * source.depth);
    model_.node_conditions.push_back(std::move(condition));
  }
}

}  // namespace tribo
