// SPDX-License-Identifier: MIT
/// Keywords of cracks and their growth.

#include "input/dialect/rows.hpp"

namespace tribo::keywords {

void add_cracks(Rows& add) {
  add({"Cracks", "MPMHeader", "settings of all cracks", T::none, {}, true});
  add({"Friction", "Cracks",
       "default law between the faces of cracks, or in the old form a number as in <MultiMaterialMode>. Without this "
       "element the contact is frictionless",
       T::number, contact_law(), true});
  add({"JContour", "Cracks",
       "writes the J integrals and stress intensity factors of crack tips to tips.csv, in plane strain and plane "
       "stress",
       T::none,
       std::vector<AttributeSpec>{
           {"type", T::integer, "accepted if it is 1"},
           number("size", "radius of the contour around a tip, in cells; 1 to 20 (default 4)"),
           {"terms", T::integer, "terms of the J integral: 1 without the inertia term, 2 (default) with it"},
           {"gridenergy", T::choice, "accepted without effect, since the energies are those of the particles",
            "N no 0"}},
       true});
  add({"Propagate", "Cracks Material",
       "criterion and direction of crack growth, for all cracks or for those in one material", T::none,
       std::vector<AttributeSpec>{
           {"criterion", T::integer,
            "criterion of growth: 0 none, 1 (default) maximum hoop stress, 4 strain energy density, 5 empirical, 7 "
            "energy release rate"},
           {"direction", T::integer,
            "direction of growth: 0 (default) that of the criterion, which for criterion 7 is along the crack; 1 along "
            "the crack; 2 normal to the opening displacement; 3 of the maximum hoop stress derived from the opening "
            "displacement; 4 the initial direction"},
           {"traction", T::integer, "accepted if it is 0: new parts of a crack are free of traction"}},
       true});
  add({"PropagateLength",
       "Cracks",
       "length by which a tip advances at once, in cells; in (0, 2], default 0.5",
       T::number,
       {},
       true});
  const std::vector<std::pair<const char*, const char*>> toughnesses{
      {"KIc",
       "fracture toughness in mode I, > 0, for criteria 1, 4 and 5 [stress length^0.5; MPa m^0.5 in legacy files]"},
      {"KIIc", "critical stress intensity factor in mode II, > 0, for criterion 5 [as KIc]"},
      {"JIc", "critical energy release rate, > 0, for criterion 7 [energy/area; J/m^2 in legacy files]"},
      {"KIexp", "exponent of KI/KIc in criterion 5, > 0 (default 2)"},
      {"KIIexp", "exponent of KII/KIIc in criterion 5, > 0 (default 2)"}};
  for (const auto& [name, meaning] : toughnesses) add({name, "Material", meaning, T::number, {}, true});
  const std::vector<AttributeSpec> tips{{"start_tip", T::integer,
                                         "first end of the crack: number of the material around its tip; -1: it is no "
                                         "tip; -2: it lies outside the body (default: determined by the program)"},
                                        {"end_tip", T::integer, "the same for the last end of the crack"}};
  const std::vector<AttributeSpec> tractions{
      text("mat",
           "number of the traction law, or of another joint law, of this part; 0 (default): the law of the crack"),
      text("matname", "name of this law, instead of mat")};
  add({"CrackList", "JANFEAInput",
       "a crack: points and lines in the order in which they follow each other, or surfaces in three dimensions",
       T::none,
       std::vector<AttributeSpec>{
           {"type", T::choice,
            "free (default): the line of the crack moves with the mean of its two faces; fixed: it does not move",
            "fixed free"},
           text("law", "number or name of the contact or joint law between its faces"),
           text("lawname", "name of the law, instead of law"),
           text("Tprop", "number of the traction law of the parts that have no 'mat'; 0 (default): none"),
           text("Tpropname", "name of this traction law, instead of Tprop"),
           number("friction", "old form: friction coefficient of the faces, or another number as in <Friction>"),
           number("Dn", "old form, with friction='11': the same as Dnt"),
           number("Dnt", "old form: normal stiffness of the interface in tension [stress/length]"),
           number("Dnc", "old form: normal stiffness of the interface in compression [stress/length]"),
           number("Dt", "old form: tangential stiffness of the interface [stress/length]")}});
  add({"Thickness",
       "Cracks CrackList",
       "accepted if it is the thickness of the grid, which is also that of all cracks",
       T::number,
       {units(lengths)}});
  add({"MovePlane",
       "Cracks",
       "how the line of a crack moves",
       T::none,
       {{"type", T::choice, "avg (default): with the mean of its two faces; cm is refused", "avg cm"},
        {"prevent", T::choice, "must be no (default): the contact of the faces prevents them from crossing", "no yes"}},
       true});
  add({"pt", "CrackList", "the next point of the line of the crack", T::none,
       std::vector<AttributeSpec>{number("x", "x coordinate", true),
                                  number("y", "y coordinate", true),
                                  {"tip", T::integer, "end of the crack at this point, as start_tip of <Line>"},
                                  units(lengths)} +
           tractions});
  add({"Line", "CrackList",
       "segments along a straight line. If the preceding point is not the start of the line, a further segment joins "
       "the two",
       T::none,
       std::vector<AttributeSpec>{{"xmin", T::coordinate, "x coordinate of the start", {}, true},
                                  {"ymin", T::coordinate, "y coordinate of the start", {}, true},
                                  {"xmax", T::coordinate, "x coordinate of the end", {}, true},
                                  {"ymax", T::coordinate, "y coordinate of the end", {}, true},
                                  {"resolution", T::integer, "number of segments, >= 1 (default: two per cell)"},
                                  units(lengths)} +
           tips + tractions});
  add({"Circle", "CrackList", "segments along an arc of an ellipse", T::none,
       std::vector<AttributeSpec>{
           {"xmin", T::coordinate, "lower edge along x of the box around the ellipse", {}, true},
           {"ymin", T::coordinate, "lower edge along y", {}, true},
           {"xmax", T::coordinate, "upper edge along x", {}, true},
           {"ymax", T::coordinate, "upper edge along y", {}, true},
           number("start_angle", "angle at which the arc starts, counted from the x axis [degrees] (default 0)"),
           number("end_angle", "angle at which the arc ends [degrees] (default 360)"),
           {"resolution", T::integer, "number of segments, >= 1 (default: two per cell)"},
           units(lengths)} +
           tips + tractions});
  add({"Quad",
       "CrackList",
       "a surface with the shape of a parallelogram, given by a corner and the two corners next to it",
       T::none,
       {number("x1", "x coordinate of a corner", true), number("y1", "y coordinate", true),
        number("z1", "z coordinate", true), number("x2", "x coordinate of a corner next to it", true),
        number("y2", "y coordinate", true), number("z2", "z coordinate", true),
        number("x3", "x coordinate of the other corner next to it", true), number("y3", "y coordinate", true),
        number("z3", "z coordinate", true), units(lengths)}});
  add({"Disc",
       "CrackList",
       "a surface with the shape of a circular disc",
       T::none,
       {number("x", "x coordinate of the centre", true), number("y", "y coordinate", true),
        number("z", "z coordinate", true), number("radius", "radius, > 0", true),
        number("nx", "x component of the normal, which points towards the upper face (default 0)"),
        number("ny", "y component (default 0)"), number("nz", "z component (default 1, or 0 if nx or ny is given)"),
        units(lengths)}});
}

}  // namespace tribo::keywords
