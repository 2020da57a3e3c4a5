// SPDX-License-Identifier: MIT
/// Keywords of cracks and their growth.

#include "input/dialect/rows.hpp"

namespace tribo::keywords {

void add_cracks(Rows& add) {
  add({"Cracks", "MPMHeader", "settings of all cracks", T::none, {}, true});
  add({"Friction", "Cracks",
       "default law between the faces of cracks, or a number as in MultiMaterialMode (absent: frictionless)", T::number,
       contact_law(), true});
  add({"JContour", "Cracks",
       "writes J integrals and stress intensity factors of crack tips to tips.csv (plane strain and plane stress)",
       T::none,
       std::vector<AttributeSpec>{{"type", T::integer, "1"},
                                  number("size", "radius of the contour around a tip, in cells (default 4)"),
                                  {"terms", T::integer, "1: without the inertia term; 2 (default): with it"},
                                  {"gridenergy", T::choice, "accepted: energies are those of the particles", "N no 0"}},
       true});
  add({"Propagate", "Cracks Material",
       "criterion and direction of crack growth, for all cracks or for those in one material", T::none,
       std::vector<AttributeSpec>{
           {"criterion", T::integer,
            "0 none, 1 (default) maximum hoop stress, 4 strain energy density, 5 empirical, 7 energy release rate"},
           {"direction", T::integer,
            "0 (default) that of the criterion (7: along the crack), 1 along the crack, 2 normal to the opening "
            "displacement, "
            "3 maximum hoop stress derived from the opening displacement, 4 initial direction"},
           {"traction", T::integer, "0: new parts of a crack are free of traction"}},
       true});
  add({"PropagateLength",
       "Cracks",
       "length by which a tip grows at once, in cells (default 0.5)",
       T::number,
       {},
       true});
  const std::vector<std::pair<const char*, const char*>> toughnesses{
      {"KIc",
       "fracture toughness: stress intensity factor of the maximum hoop stress at which a crack grows [MPa m^0.5 in "
       "legacy files]"},
      {"KIIc", "critical stress intensity factor in mode II, for criterion 5"},
      {"JIc", "critical energy release rate, for criterion 7 [J/m^2 in legacy files]"},
      {"KIexp", "exponent of KI/KIc in criterion 5 (default 2)"},
      {"KIIexp", "exponent of KII/KIIc in criterion 5 (default 2)"}};
  for (const auto& [name, meaning] : toughnesses) add({name, "Material", meaning, T::number, {}, true});
  const std::vector<AttributeSpec> tips{
      {"start_tip", T::integer, "first end: number of the material around the tip, -1 no tip, -2 outside the body"},
      {"end_tip", T::integer, "the same for the last end"}};
  const std::vector<AttributeSpec> tractions{
      text("mat", "number of the traction law (or another joint law) of this part; 0: that of the crack"),
      text("matname", "name of this law, instead of mat")};
  add({"CrackList", "JANFEAInput", "a crack: points and lines in this order, or surfaces in three dimensions", T::none,
       std::vector<AttributeSpec>{{"type", T::choice, "accepted", "fixed free"},
                                  text("law", "number or name of the contact or joint law between its faces"),
                                  text("lawname", "name of the law, instead of law"),
                                  text("Tprop", "number of the traction law of the parts without mat (0: none)"),
                                  text("Tpropname", "name of this traction law, instead of Tprop"),
                                  number("friction", "old form: friction coefficient of the faces"),
                                  number("Dn", "old form, with friction='11': normal stiffness of an interface"),
                                  number("Dnt", "normal stiffness in tension"),
                                  number("Dnc", "normal stiffness in compression"),
                                  number("Dt", "tangential stiffness")}});
  add({"Thickness",
       "Cracks CrackList",
       "accepted if it is the thickness of the grid, which cracks have",
       T::number,
       {units(lengths)}});
  add({"MovePlane",
       "Cracks",
       "how the line of a crack moves",
       T::none,
       {{"type", T::choice, "avg: with the mean of its two faces; cm is refused", "avg cm"},
        {"prevent", T::choice, "no; the contact of the faces prevents that they cross", "no yes"}},
       true});
  add({"pt", "CrackList", "the next point of the line", T::none,
       std::vector<AttributeSpec>{
           number("x", "", true), number("y", "", true), {"tip", T::integer, "as start_tip of Line"}, units(lengths)} +
           tractions});
  add({"Line", "CrackList", "segments along a line; joined to the preceding point if that differs from the start",
       T::none,
       std::vector<AttributeSpec>{{"xmin", T::coordinate, "start", {}, true},
                                  {"ymin", T::coordinate, "start", {}, true},
                                  {"xmax", T::coordinate, "end", {}, true},
                                  {"ymax", T::coordinate, "end", {}, true},
                                  {"resolution", T::integer, "number of pieces (default: two per cell)"},
                                  units(lengths)} +
           tips + tractions});
  add({"Circle", "CrackList", "segments along an arc of an ellipse", T::none,
       std::vector<AttributeSpec>{{"xmin", T::coordinate, "edge of the ellipse's box", {}, true},
                                  {"ymin", T::coordinate, "edge", {}, true},
                                  {"xmax", T::coordinate, "edge", {}, true},
                                  {"ymax", T::coordinate, "edge", {}, true},
                                  number("start_angle", "start of the arc, from x [degrees] (default 0)"),
                                  number("end_angle", "end of the arc [degrees] (default 360)"),
                                  {"resolution", T::integer, "number of pieces (default: two per cell)"},
                                  units(lengths)} +
           tips + tractions});
  add({"Quad",
       "CrackList",
       "a parallelogram in three dimensions, given by a corner and the two adjacent corners",
       T::none,
       {number("x1", "corner", true), number("y1", "", true), number("z1", "", true),
        number("x2", "adjacent corner", true), number("y2", "", true), number("z2", "", true),
        number("x3", "other adjacent corner", true), number("y3", "", true), number("z3", "", true), units(lengths)}});
  add({"Disc",
       "CrackList",
       "a circular disc in three dimensions",
       T::none,
       {number("x", "centre", true), number("y", "", true), number("z", "", true), number("radius", "", true),
        number("nx", "normal, towards the upper face (default 0)"), number("ny", "(default 0)"),
        number("nz", "(default 1)"), units(lengths)}});
}

}  // namespace tribo::keywords
