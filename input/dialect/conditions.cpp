// SPDX-License-Identifier: MIT
/// Keywords of conditions on nodes and particles.

#include "input/dialect/rows.hpp"
#include "model/prescribed.hpp"

namespace tribo::keywords {
namespace {

std::vector<AttributeSpec> condition_attributes() {
  return {
      {"style", T::choice,
       "how the value depends on the time or on the motion. constant (default); linear: value times the time since the "
       "start; sine, cosine; function. For tractions also silent and elastic",
       all_style_words()},
      number("time",
             "time at which the condition starts (default 0); for sine and cosine the angular frequency [rad/time]"),
      number("ftime", "the same as time"),
      function("function",
               "the value as a function of x, y, z and of the time t since the start; required with style function"),
      {"id", T::integer, "0 or a negative number, by which histories of reactions refer to the condition (default 0)"}};
}

}  // namespace

void add_conditions(Rows& add) {
  // Conditions on the grid
  add({"GridBCs", "JANFEAInput", "conditions on grid nodes", T::none, {}, true});
  add({"BCShape", "GridBCs ParticleBCs", "conditions on the nodes or particles in its shapes"});
  add({"LdShape", "ParticleBCs", "conditions on the particles in its shapes; the same as <BCShape>"});
  add({"BCLine", "GridBCs ParticleBCs", "conditions on the nodes or particles near a line", T::none, ends()});
  add({"BCArc", "GridBCs ParticleBCs",
       "conditions on the nodes or particles near an arc of an ellipse. The box around the ellipse is given by xmin to "
       "ymax, or by two corners x1, y1 and x2, y2",
       T::none,
       ends() +
           std::vector{
               number("start",
                      "polar angle at which the arc begins, counterclockwise from the x axis [degrees] (default 0)"),
               number("end", "polar angle at which the arc ends [degrees] (default 360)"), units(lengths)}});
  add({"LdRect", "GridBCs ParticleBCs", "conditions on the nodes or particles in a rectangle", T::none, box(false)});
  add({"BCBox", "GridBCs ParticleBCs",
       "conditions on the nodes or particles in a box, or with 'axis' in the elliptic cylinder that touches the faces "
       "of the box",
       T::none,
       box(true) +
           std::vector{AttributeSpec{"axis", T::choice, "direction of the axis of the cylinder: 1 or x, 2 or y, 3 or z",
                                     "1 2 3 x y z"}}});
  add({"DisBC", "BCShape BCLine BCArc LdRect BCBox", "prescribed velocity", T::none,
       std::vector{
           AttributeSpec{"dir", T::choice,
                         "direction: 1 x, 2 y, 3 z; 12, 13, 23 and 123: inclined in these axes by 'angle' and 'angle2'",
                         "1 2 3 12 13 23 123", true},
           number("vel", "velocity along the direction (default 0)"),
           number("disp", "the same as vel"),
           number("angle", "angle by which an inclined direction is rotated clockwise from its first axis [degrees]"),
           number("angle2", "direction 123: angle between the direction and the z axis [degrees]"),
           units(velocities),
           number("depth",
                  "makes the condition a moving wall, which starts at the nodes of the shape. The wall also governs "
                  "the nodes within this number of cells (at most 1000) on the side of the material, which lies at "
                  "smaller coordinates if the number is positive and at larger ones if it is negative"),
           {"gradfxn", T::text,
            "moving wall: gradient of the velocity along the normal of the wall, as a function of t, x, y, z (default "
            "0), or 'mirror' for the gradient between the last two free nodes"},
           function("dispfxn", "moving wall: displacement of the wall along its normal, as a function of the time t")} +
           condition_attributes()});

  add({"TempBC", "BCShape BCLine BCArc LdRect BCBox", "prescribed temperature", T::none,
       std::vector{number("value", "temperature")} + condition_attributes()});

  // Conditions on particles
  add({"ParticleBCs", "JANFEAInput", "loads on particles", T::none, {}, true});
  add({"net", "BCShape LdShape BCLine BCArc LdRect BCBox",
       "the loads after it are total forces, which are divided among the selected particles"});
  add({"perParticle", "BCShape LdShape BCLine BCArc LdRect BCBox",
       "the loads after it act on each selected particle (default)"});
  add({"LoadBC", "BCShape LdShape BCLine BCArc LdRect BCBox",
       "force on each selected particle; after <net/> the sum of these forces", T::none,
       std::vector{AttributeSpec{"dir", T::choice, "direction: 1 x, 2 y, 3 z", "1 2 3", true}, number("load", "force"),
                   number("value", "the same as load")} +
           condition_attributes()});
  add({"TractionBC", "BCShape LdShape BCLine BCArc LdRect BCBox",
       "traction on a face of the domains of the selected particles", T::none,
       std::vector{
           AttributeSpec{"dir", T::choice,
                         "direction: 1 x, 2 y, 3 z; 11 outward normal; 12 tangential (2D), the normal rotated by 90 "
                         "degrees counterclockwise",
                         "1 2 3 11 12", true},
           AttributeSpec{
               "face", T::choice,
               "face of the particle domains. 2D: 1 bottom, 2 right, 3 top, 4 left; 3D also 5 at low z and 6 at high z",
               "1 2 3 4 5 6", true},
           number("stress",
                  "traction; along the normal it is positive in tension. Style elastic: stiffness k of a support "
                  "[stress/length], whose traction is -k times the displacement. Style silent: without effect, since "
                  "the boundary absorbs waves")} +
           condition_attributes()});

  add({"HeatFluxBC", "BCShape LdShape BCLine BCArc LdRect BCBox",
       "heat flux into the selected particles through a face of their domains, positive if it heats them", T::none,
       std::vector{
           AttributeSpec{"dir", T::choice,
                         "1 (default): the flux is given. 2: the flux depends on the temperature, which is refused",
                         "1 2"},
           AttributeSpec{
               "face", T::choice,
               "face of the particle domains. 2D: 1 bottom, 2 right, 3 top, 4 left; 3D also 5 at low z and 6 at high z",
               "1 2 3 4 5 6", true},
           number("value", "heat flux [power/area]")} +
           condition_attributes()});
}

}  // namespace tribo::keywords
