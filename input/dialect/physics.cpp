// SPDX-License-Identifier: MIT
/// Keywords of heat, gravity and additional tasks.

#include "input/dialect/rows.hpp"

namespace tribo::keywords {

void add_heat_and_gravity(Rows& add) {
  // Heat
  add({"Thermal", "JANFEAInput", "temperature", T::none, {}, true});
  add({"EnergyCoupling", "Thermal", "the work dissipated by the materials becomes heat", T::none, {}, true});
  add({"Conduction", "Thermal", "heat conduction on the grid", T::none, {}, true});
  add({"ContactHeating", "Thermal", "the work of friction becomes heat", T::none, {}, true});

  // Gravity
  add({"Gravity", "JANFEAInput", "body forces per unit mass", T::none, {}, true});
  for (const auto name : {"BodyXForce", "BodyYForce", "BodyZForce"})
    add({name, "Gravity", "constant acceleration", T::number, {}, true});
  for (const auto name : {"GridBodyXForce", "GridBodyYForce", "GridBodyZForce"})
    add({name, "Gravity", "acceleration of the nodes as a function of x, y, z, t", T::function, {}, true});
  for (const auto name : {"ParticleBodyXForce", "ParticleBodyYForce", "ParticleBodyZForce"})
    add({name,
         "Gravity",
         "acceleration of the particles as a function of t, x, y, z and of their initial positions x0, y0, z0",
         T::function,
         {},
         true});
}

void add_tasks(Rows& add) {
  add({"CustomTasks", "JANFEAInput", "additional tasks", T::none, {}, true});
  add({"Schedule",
       "CustomTasks",
       "a task: PeriodicXPIC, AdjustTimeStep, VTKArchive, HistoryArchive, PropertyRamp (or ThermalRamp), ReverseLoad, "
       "LoadControl",
       T::none,
       {text("name", "", true)}});
  add({"Parameter", "Schedule", "a setting of the task; the text is its value", T::text, {text("name", "", true)}});
}

}  // namespace tribo::keywords
