// SPDX-License-Identifier: MIT
/// Keywords of heat, gravity and additional tasks.

#include "input/dialect/rows.hpp"

namespace tribo::keywords {

void add_heat_and_gravity(Rows& add) {
  // Heat
  add({"Thermal", "JANFEAInput", "heat in the model", T::none, {}, true});
  add({"EnergyCoupling", "Thermal", "the work that the materials dissipate becomes heat", T::none, {}, true});
  add({"Conduction", "Thermal", "heat is conducted on the grid", T::none, {}, true});
  add({"ContactHeating",
       "Thermal",
       "the work of friction between materials becomes heat; this needs <Conduction/>",
       T::none,
       {},
       true});
  const std::vector<std::pair<const char*, const char*>> of_materials{
      {"Cv",
       "heat capacity per unit mass, > 0; required with <Conduction/> and <EnergyCoupling/> [energy/(mass "
       "temperature); J/(kg K) in legacy files]"},
      {"Cp", "the same as Cv"},
      {"kCond", "thermal conductivity, >= 0 (default 0) [power/(length temperature); W/(m K) in legacy files]"},
      {"alpha",
       "coefficient of linear thermal expansion, in parts per million per unit of temperature: 12 for steel, in every "
       "system of units (default 0)"},
      {"TaylorQuinney",
       "fraction of the dissipated work that becomes heat with <EnergyCoupling/>; in [0, 1] (default 1)"}};
  for (const auto& [name, meaning] : of_materials) add({name, "Material", meaning, T::number, {}, true});

  // Gravity
  add({"Gravity", "JANFEAInput", "body forces per unit mass", T::none, {}, true});
  for (const auto name : {"BodyXForce", "BodyYForce", "BodyZForce"})
    add({name,
         "Gravity",
         "constant acceleration along the axis that the name contains [length/time^2] (default 0)",
         T::number,
         {},
         true});
  for (const auto name : {"GridBodyXForce", "GridBodyYForce", "GridBodyZForce"})
    add({name,
         "Gravity",
         "acceleration of the nodes along the axis that the name contains, as a function of x, y, z, t [length/time^2]",
         T::function,
         {},
         true});
  for (const auto name : {"ParticleBodyXForce", "ParticleBodyYForce", "ParticleBodyZForce"})
    add({name,
         "Gravity",
         "acceleration of the particles along the axis that the name contains, as a function of t, x, y, z and of "
         "their initial positions x0, y0, z0 [length/time^2]",
         T::function,
         {},
         true});
}

void add_tasks(Rows& add) {
  add({"CustomTasks", "JANFEAInput", "additional tasks of the run", T::none, {}, true});
  add({"Schedule",
       "CustomTasks",
       "a task, whose settings are given by <Parameter> elements; 'tribo list' names all tasks",
       T::none,
       {text("name", "name of the task, such as PeriodicXPIC", true)}});
  add({"Parameter",
       "Schedule",
       "a setting of the task; the text of the element is its value",
       T::text,
       {text("name", "name of the setting", true)}});
}

}  // namespace tribo::keywords
