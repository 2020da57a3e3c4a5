// SPDX-License-Identifier: MIT
/// Keywords of further settings of the solver, and of the grid.

#include "input/dialect/rows.hpp"

namespace tribo::keywords {

void add_settings(Rows& add) {
  add({"MatlPtsPerElement",
       "MPMHeader Body",
       "number of particles per cell, a square number in 2D (default 4), a cube number in 3D (default 8)",
       T::integer,
       {},
       true});
  add({"Damping",
       "MPMHeader Stage",
       "grid damping [1/time]: a force on the nodes, minus this times their momentum",
       T::number,
       {function("function", "of time; required without the number")},
       true});
  add({"PDamping",
       "MPMHeader Stage",
       "particle damping [1/time]: particles lose this times the velocity of the grid; prescribed components of the "
       "velocity "
       "are not damped",
       T::number,
       {function("function", "of time; required without the number")},
       true});
  add({"FeedbackDamping",
       "MPMHeader Stage",
       "gain of grid damping controlled by the kinetic energy",
       T::number,
       {function("target", "kinetic energy aimed at"), number("max", "largest damping")},
       true});
  add({"PFeedbackDamping",
       "MPMHeader Stage",
       "gain of particle damping controlled by the kinetic energy",
       T::number,
       {function("target", "kinetic energy aimed at"), number("max", "largest damping")},
       true});
  add({"DefGradTerms",
       "MPMHeader",
       "update of the deformation gradient: 1 (default) by 1 + L dt, 2 by the exponential of L dt to second order",
       T::integer,
       {},
       true});
  add({"LeaveLimit",
       "MPMHeader",
       "number of particles that may leave the grid, and are put back, before the run stops; negative: this many may "
       "leave and are removed",
       T::integer,
       {},
       true});
  add({"StrengthReduction",
       "MPMHeader",
       "bracket of the search for the factor of safety by 'tribo safety'; ignored by 'tribo run'",
       T::none,
       {number("low", "lower end of the bracket: a factor at which the model is stable (default 1)"),
        number("high", "upper end of the bracket: a factor at which it fails (default 2)"),
        number("tolerance", "width of the final bracket (default 0.01)"),
        number("growth",
               "the model fails if its largest displacement grows by this fraction in the last quarter of the run "
               "(default 0.05)"),
        number("displacement",
               "the model also fails if its largest displacement exceeds this length (default: no limit); for models "
               "that collapse and come to rest again")},
       true});
  add({"WholeParticles",
       "MPMHeader",
       "places whole particles only: faces that are not on the lines of the particles become steps, as in NairnMPM. "
       "Without it, the surfaces of shapes cut the cells of the outermost particles",
       T::none,
       {},
       true});
  add({"SinglePrecision",
       "MPMHeader",
       "writes the fields of particle files with the seven digits of single precision, positions excepted. This is the "
       "default; the run itself, its checkpoints and tables always keep double precision",
       T::none,
       {},
       true});
  add({"DoublePrecision",
       "MPMHeader",
       "writes the fields of particle files with all sixteen digits, which makes the files twice as large; for "
       "comparisons that need more than seven digits of a field",
       T::none,
       {},
       true});
  add({"SplitParticles",
       "MPMHeader",
       "particles that stretch beyond a length split in two, and small neighbours merge, so that flowing matter does "
       "not "
       "separate numerically",
       T::none,
       {number("longest", "length above which the domain of a particle splits, in cells (default 1)"),
        number("generations", "how often a particle and its halves may split (default 6)"),
        {"merge", T::flag, "neighbours that are small again merge (default yes)"}},
       true});
  add({"BBar",
       "MPMHeader",
       "B-bar: volumetric strain and pressure are averaged around each particle, which avoids locking",
       T::none,
       {},
       true});
  add({"ExtrapolateRigid",
       "MPMHeader",
       "accepted without effect: rigid particles always act through extrapolated velocities",
       T::none,
       {},
       true});
  add({"CPDIrcrit",
       "MPMHeader",
       "largest distance of a CPDI corner from the particle, in cells (at most 1)",
       T::number,
       {},
       true});
  add({"StressFreeTemp",
       "MPMHeader",
       "initial temperature of bodies without a temperature of their own",
       T::number,
       {},
       true});
}

void add_grid(Rows& add) {
  add({"Mesh", "JANFEAInput", "the grid", T::none, {text("output", "accepted")}, true, true, false, {}, "Blocks"});
  add({"Grid",
       "Mesh",
       "extent of the grid",
       T::none,
       {number("xmin", "", true),
        number("xmax", "", true),
        number("ymin", "", true),
        number("ymax", "", true),
        number("zmin", "required in three dimensions"),
        number("zmax", "required in three dimensions"),
        number("thickness", "thickness of a plane model (default 1)"),
        {"type", T::integer, "accepted"},
        units(lengths)},
       true,
       true});
  for (const auto name : {"Horiz", "Vert", "Depth"})
    add({name,
         "Grid",
         name[0] == 'H'   ? "cells along x; required"
         : name[0] == 'V' ? "cells along y; required"
                          : "cells along z; required in three dimensions",
         T::none,
         {{"nx", T::integer, "number of cells (Horiz); this or cellsize is required"},
          {"ny", T::integer, "number of cells (Vert); this or cellsize is required"},
          {"nz", T::integer, "number of cells (Depth); this or cellsize is required"},
          number("cellsize",
                 "cell size, required without a number of cells; the upper edge is moved outward to a whole number of "
                 "cells"),
          number("symmin", "symmetry plane at this coordinate"),
          number("symmax", "symmetry plane at this coordinate"),
          number("wallmin", "wall at this coordinate with boundary-modified shape functions (B-splines)"),
          number("wallmax", "wall at this coordinate with boundary-modified shape functions (B-splines)"),
          {"periodic", T::integer, "1: periodic; particles that leave at one edge enter at the opposite edge"},
          {"rx", T::number, "ratio of neighbouring cells (Horiz); must be 1, since all cells are equal"},
          {"ry", T::number, "the same (Vert)"},
          {"rz", T::number, "the same (Depth)"},
          {"style", T::text, "how cells grow; without effect, since all cells are equal"},
          units(lengths)},
         true});
}

}  // namespace tribo::keywords
