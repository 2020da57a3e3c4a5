// SPDX-License-Identifier: MIT
/// Parameters of custom tasks and their meaning.

#include "input/dialect.hpp"
#include "model/output_fields.hpp"

#include <algorithm>
#include <array>

namespace tribo {
namespace {

struct TaskParameter {
  std::string_view task, name, meaning;
};

// In the order in which the manual lists them.
constexpr std::array parameters = {
    TaskParameter{"PeriodicXPIC", "FMPMOrder", "order of FMPM"},
    TaskParameter{"PeriodicXPIC", "XPICOrder", "order of XPIC"},
    TaskParameter{"PeriodicXPIC", "periodicSteps", "the number of steps from one use to the next (default 1)"},
    TaskParameter{"PeriodicXPIC", "periodicTime", "the time from one use to the next, instead of periodicSteps"},
    TaskParameter{"PeriodicXPIC", "verbose", "accepted without effect"},
    TaskParameter{"AdjustTimeStep", "adjustTime", "accepted without effect: the step is adapted every tenth step"},
    TaskParameter{"AdjustTimeStep", "velocityCFL",
                  "largest distance that a particle moves in a step [cells], > 0 (default 0.5)"},
    TaskParameter{
        "AdjustTimeStep", "maxIncrease",
        "largest ratio of a step to the one before it, if above 1; otherwise this ratio minus 1 (default: ratio 1.1)"},
    TaskParameter{"AdjustTimeStep", "verbose", "accepted without effect"},
    TaskParameter{"PropertyRamp", "property", "1 or temperature; no other property is implemented"},
    TaskParameter{"PropertyRamp", "time", "duration of the ramp (default 0: a step)"},
    TaskParameter{"PropertyRamp", "start", "time at which it begins (default 0)"},
    TaskParameter{"PropertyRamp", "Delta", "change of the temperature"},
    TaskParameter{"PropertyRamp", "DeltaT", "the same as Delta"},
    TaskParameter{"PropertyRamp", "sigmoidal", "1: the ramp is a smooth curve; 0: a straight line (default 0)"},
    TaskParameter{"PropertyRamp", "exponential",
                  "the ramp is exponential with this number of lifetimes in its duration (default 0: it is not)"},
    TaskParameter{"PropertyRamp", "stretch", "exponent of the stretched exponential (default 1)"},
    TaskParameter{"PropertyRamp", "scale", "share of the change as a function of x, y, z and t"},
    TaskParameter{"ThermalRamp", "property", "1 or temperature; no other property is implemented"},
    TaskParameter{"ThermalRamp", "time", "duration of the ramp (default 0: a step)"},
    TaskParameter{"ThermalRamp", "start", "time at which it begins (default 0)"},
    TaskParameter{"ThermalRamp", "Delta", "change of the temperature"},
    TaskParameter{"ThermalRamp", "DeltaT", "the same as Delta"},
    TaskParameter{"ThermalRamp", "sigmoidal", "1: the ramp is a smooth curve; 0: a straight line (default 0)"},
    TaskParameter{"ThermalRamp", "exponential",
                  "the ramp is exponential with this number of lifetimes in its duration (default 0: it is not)"},
    TaskParameter{"ThermalRamp", "stretch", "exponent of the stretched exponential (default 1)"},
    TaskParameter{"ThermalRamp", "scale", "share of the change as a function of x, y, z and t"},
    TaskParameter{"LoadControl", "material", "number or name of the rigid material"},
    TaskParameter{"LoadControl", "mat", "the same as material"},
    TaskParameter{"LoadControl", "direction", "1 (x, default), 2 (y) or 3 (z)"},
    TaskParameter{"LoadControl", "velocity", "velocity with which the material moves until its force is felt"},
    TaskParameter{"LoadControl", "MaxVelocity", "largest velocity, in either direction"},
    TaskParameter{"LoadControl", "Load_Function", "the wanted force as a function of t"},
    TaskParameter{"LoadControl", "Kp", "velocity per error of the position [1/time], > 0"},
    TaskParameter{"LoadControl", "Ki", "velocity per integral of this error over time [1/time^2] (default 0)"},
    TaskParameter{"LoadControl", "Kd", "velocity per rate of this error (default 0)"},
    TaskParameter{"LoadControl", "smooth", "weight of former values in the smoothed force, in [0, 1) (default 0.9)"},
    TaskParameter{"ReverseLoad", "quantity",
                  "a quantity of the histories; or a parameter named after it, such as global dispx"},
    TaskParameter{"ReverseLoad", "material", "number or name of the material of the quantity"},
    TaskParameter{"ReverseLoad", "mat", "the same as material"},
    TaskParameter{"ReverseLoad", "maxValue", "value at which the loads are reversed, held or end"},
    TaskParameter{"ReverseLoad", "minValue", "style 0: value at which the run ends on the way back"},
    TaskParameter{"ReverseLoad", "maxLength", "length of a crack at which this happens, instead of a quantity"},
    TaskParameter{"ReverseLoad", "crackNumber", "number of this crack; 0: any (default 0)"},
    TaskParameter{"ReverseLoad", "hold", "style 0: time for which the loads are held before they go back (default 0)"},
    TaskParameter{"ReverseLoad", "style",
                  "0 (the loads go back), 1 (they are held), 2 (only the growth of cracks ends) or 3 (the run ends)"},
    TaskParameter{"DeleteDamaged", "material", "number or name of the material"},
    TaskParameter{"DeleteDamaged", "matname", "the same as material"},
    TaskParameter{"DeleteDamaged", "minCOD",
                  "a failed particle is removed if its crack is open by at least this length, >= 0 (default 0)"},
    TaskParameter{"DeleteDamaged", "direction", "must be 1: the opening is normal to the crack"},
    TaskParameter{"DeleteDamaged", "deleteTime",
                  "time at which the particles of the material are removed, instead of those that have failed"},
    TaskParameter{"DeleteDamaged", "store_x", "accepted without effect: particles are removed and not stored"},
    TaskParameter{"DeleteDamaged", "store_y", "accepted without effect"},
    TaskParameter{"DeleteDamaged", "store_z", "accepted without effect"},
    TaskParameter{"FluidSource", "material", "number or name of the material"},
    TaskParameter{"FluidSource", "matname", "the same as material"},
    TaskParameter{"FluidSource", "FlowRate", "volume per time; this or FlowFunction is required"},
    TaskParameter{"FluidSource", "FlowFunction", "volume per time as a function of t"},
    TaskParameter{"FluidSource", "flow_x", "direction of the flow, along x"},
    TaskParameter{"FluidSource", "flow_y", "direction of the flow, along y"},
    TaskParameter{"FluidSource", "flow_z", "direction of the flow, along z; in space it is along one axis"},
    TaskParameter{"FluidSource", "source_x", "centre of the inlet, x (default 0)"},
    TaskParameter{"FluidSource", "source_y", "centre of the inlet, y (default 0)"},
    TaskParameter{"FluidSource", "source_z", "centre of the inlet, z (default 0)"},
    TaskParameter{"FluidSource", "inlet_width", "width of the inlet"},
    TaskParameter{"FluidSource", "inlet_depth", "in space: its other edge (default inlet_width)"},
    TaskParameter{"FluidSource", "particle_size",
                  "edge of its particles over that of the particles of bodies (default 1)"},
    TaskParameter{"VTKArchive", "archiveTime",
                  "without effect, unless it is that of <ArchiveTime>: files are written at those times"},
    TaskParameter{"VTKArchive", "firstArchiveTime", "the same"},
    TaskParameter{"HistoryArchive", "archiveTime",
                  "without effect, unless it is that of <ArchiveTime>: files are written at those times"},
    TaskParameter{"HistoryArchive", "firstArchiveTime", "the same"},
    TaskParameter{"VTKArchive", "selectMaterial", "without effect: files contain all materials"},
};

}  // namespace

std::vector<std::string> parameter_names(const std::string& task) {
  std::vector<std::string> names;
  for (const TaskParameter& p : parameters)
    if (p.task == task) names.emplace_back(p.name);
  if (task == "VTKArchive")
    for (const auto& field : particle_fields()) names.emplace_back(field.name);
  return names;
}

std::string_view meaning_of_parameter(std::string_view task, std::string_view name) {
  const auto found = std::find_if(parameters.begin(), parameters.end(),
                                  [&](const TaskParameter& p) { return p.task == task && p.name == name; });
  return found == parameters.end() ? std::string_view() : found->meaning;
}

std::string_view needs_of_task(std::string_view task) {
  if (task == "PropertyRamp" || task == "ThermalRamp") return "Delta or DeltaT";
  if (task == "LoadControl") return "material or mat, Load_Function, velocity and Kp";
  if (task == "ReverseLoad")
    return "either a quantity and maxValue, or maxLength (length of a crack). The quantity is given by the parameter "
           "'quantity', or by a parameter whose name is 'global' and the quantity, such as 'global dispx'";
  if (task == "DeleteDamaged") return "material or matname";
  if (task == "FluidSource")
    return "material or matname; FlowRate or FlowFunction; at least one of flow_x, flow_y and flow_z; inlet_width";
  return {};
}

}  // namespace tribo
