// SPDX-License-Identifier: MIT
/// Keywords of conditions on nodes and particles.

#include "input/dialect/rows.hpp"
#include "model/prescribed.hpp"

namespace tribo::keywords {
namespace {

std::vector<AttributeSpec> condition_attributes() {
  return {{"style", T::choice, "how the value depends on time or on motion (default constant)", all_style_words()},
          number("time", "start time, or angular frequency of sine and cosine"),
          number("ftime", "the same as time"),
          function("function", "value; required with style function"),
          {"id", T::integer, "number <= 0 that identifies the condition in reaction histories"}};
}

}  // namespace

void add_conditions(Rows& add) {
  // Conditions on the grid
  add({"GridBCs", "JANFEAInput", "conditions on grid nodes", T::none, {}, true});
  add({"BCShape", "GridBCs ParticleBCs", "nodes or particles in a shape"});
  add({"LdShape", "ParticleBCs", "particles in a shape; the same as BCShape"});
  add({"BCLine", "GridBCs ParticleBCs", "nodes or particles near a line", T::none, ends()});
  add({"BCArc", "GridBCs ParticleBCs",
       "nodes or particles near the edge of an ellipse, given by its box: xmin to ymax, or two corners x1, y1, x2, y2",
       T::none, ends() + std::vector{number("start", "[degrees]"), number("end", "[degrees]"), units(lengths)}});
  add({"LdRect", "GridBCs ParticleBCs", "nodes or particles in a rectangle", T::none, box(false)});
  add({"BCBox", "GridBCs ParticleBCs", "nodes or particles in a box, or with axis in the inscribed cylinder", T::none,
       box(true) + std::vector{AttributeSpec{"axis", T::choice, "axis of the cylinder", "1 2 3 x y z"}}});
  add({"DisBC", "BCShape BCLine BCArc LdRect BCBox", "prescribed velocity", T::none,
       std::vector{AttributeSpec{"dir", T::choice, "direction: 1 x, 2 y, 3 z, or inclined", "1 2 3 12 13 23 123", true},
                   number("vel", "velocity"),
                   number("disp", "the same as vel"),
                   number("angle", "angle of an inclined direction, clockwise [degrees]"),
                   number("angle2", "second angle of an inclined direction [degrees]"),
                   units(velocities),
                   number("depth",
                          "makes a moving wall of the condition, which starts at the nodes of the shape: nodes within "
                          "this number of cells on the side of the material are governed, too. Positive: the material "
                          "lies at smaller coordinates; negative: at larger ones"),
                   {"gradfxn", T::text,
                    "moving wall: velocity gradient along its normal as a function of t, x, y, z, or 'mirror': that of "
                    "the last two free nodes (default 0)"},
                   function("dispfxn", "moving wall: its displacement along the normal")} +
           condition_attributes()});

  add({"TempBC", "BCShape BCLine BCArc LdRect BCBox", "prescribed temperature", T::none,
       std::vector{number("value", "temperature")} + condition_attributes()});

  // Conditions on particles
  add({"ParticleBCs", "JANFEAInput", "loads on particles", T::none, {}, true});
  add({"net", "BCShape LdShape BCLine BCArc LdRect BCBox",
       "the following loads are totals, divided among the particles found"});
  add({"perParticle", "BCShape LdShape BCLine BCArc LdRect BCBox", "the following loads act on each particle"});
  add({"LoadBC", "BCShape LdShape BCLine BCArc LdRect BCBox",
       "force on each particle in the region, or their sum after <net/>", T::none,
       std::vector{AttributeSpec{"dir", T::choice, "1 x, 2 y, 3 z", "1 2 3", true}, number("load", "force"),
                   number("value", "the same as load")} +
           condition_attributes()});
  add({"TractionBC", "BCShape LdShape BCLine BCArc LdRect BCBox", "traction on a face of the particle domains", T::none,
       std::vector{
           AttributeSpec{"dir", T::choice,
                         "1 x, 2 y, 3 z, 11 outward normal, 12 tangential: the normal rotated by 90 degrees "
                         "counterclockwise (2D)",
                         "1 2 3 11 12", true},
           AttributeSpec{"face", T::choice, "2D: 1 bottom 2 right 3 top 4 left; 3D also 5, 6: low and high z",
                         "1 2 3 4 5 6", true},
           number("stress",
                  "traction; along the normal it is positive in tension. Style elastic: stiffness k of a support, "
                  "traction = -k times displacement. Style silent: without effect, the boundary absorbs waves")} +
           condition_attributes()});

  add({"HeatFluxBC", "BCShape LdShape BCLine BCArc LdRect BCBox",
       "heat flux into the particles through a face, positive if it heats them", T::none,
       std::vector{AttributeSpec{"dir", T::choice,
                                 "1: the flux is given; 2, a flux that depends on the temperature, is refused", "1 2"},
                   AttributeSpec{"face", T::choice, "2D: 1 bottom 2 right 3 top 4 left; 3D also 5, 6: low and high z",
                                 "1 2 3 4 5 6", true},
                   number("value", "power per area")} +
           condition_attributes()});
}

}  // namespace tribo::keywords
