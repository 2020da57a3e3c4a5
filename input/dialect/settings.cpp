// SPDX-License-Identifier: MIT
/// Keywords of further settings of the solver, and of the grid.

#include "input/dialect/rows.hpp"

namespace tribo::keywords {

void add_settings(Rows& add) {
  add({"MatlPtsPerElement",
       "MPMHeader Body",
       "number of particles per cell: in 2D a square number up to 25 (default 4), in 3D a cube number up to 125 "
       "(default 8)",
       T::integer,
       {},
       true});
  add({"Damping",
       "MPMHeader Stage",
       "rate of grid damping [1/time]: on each node acts a force of minus this rate times its momentum",
       T::number,
       {function("function", "rate as a function of the time t; required without the number")},
       true});
  add({"PDamping",
       "MPMHeader Stage",
       "rate of particle damping [1/time]: each particle is decelerated by this rate times the velocity of the grid at "
       "its place. Prescribed components of the velocity are not damped",
       T::number,
       {function("function", "rate as a function of the time t; required without the number")},
       true});
  add({"FeedbackDamping",
       "MPMHeader Stage",
       "gain, >= 0, of grid damping that is controlled by the kinetic energy: the damping rate changes per time by "
       "this gain times the excess of the kinetic energy over the target [1/(energy time^2)]",
       T::number,
       {function("target", "target of the kinetic energy, a number or a function of the time t (default 0)"),
        number("max", "largest damping rate [1/time] (default 0: no limit)")},
       true});
  add({"PFeedbackDamping",
       "MPMHeader Stage",
       "gain, >= 0, of particle damping that is controlled by the kinetic energy, as in <FeedbackDamping> [1/(energy "
       "time^2)]",
       T::number,
       {function("target", "target of the kinetic energy, a number or a function of the time t (default 0)"),
        number("max", "largest damping rate [1/time] (default 0: no limit)")},
       true});
  add({"DefGradTerms",
       "MPMHeader",
       "order of the update of the deformation gradient over a step dt: 1 (default) multiplies it by 1 + L dt, with "
       "the velocity gradient L; 2 multiplies it by the exponential of L dt to second order",
       T::integer,
       {},
       true});
  add({"LeaveLimit",
       "MPMHeader",
       "particles that leave the grid are put back at its edge; the run stops when this has happened more often than "
       "this number (0: 100000). If the number is negative, they are removed instead, and the run stops when more than "
       "its magnitude have left. Without this element the run stops when a particle leaves",
       T::integer,
       {},
       true});
  add({"StrengthReduction",
       "MPMHeader",
       "settings of the search for the factor of safety by 'tribo safety'; ignored by 'tribo run'",
       T::none,
       {number("low",
               "lower end of the interval that is searched: a factor > 0 at which the model is stable (default 1)"),
        number("high", "upper end of the interval: a factor above 'low' at which the model fails (default 2)"),
        number("tolerance", "width of the interval, > 0, at which the search ends (default 0.01)"),
        number("growth",
               "the model counts as failed if its largest displacement grows by this fraction, > 0, in the last "
               "quarter of the run (default 0.05)"),
        number("displacement",
               "the model also counts as failed if its largest displacement exceeds this length, > 0; for models that "
               "collapse and come to rest again (default: no limit)")},
       true});
  add({"WholeParticles",
       "MPMHeader",
       "shapes are filled with whole particles only, as in NairnMPM, so that faces that do not follow the rows of "
       "particles become steps. Without this element the surfaces of shapes cut the domains of the outermost particles",
       T::none,
       {},
       true});
  add({"SinglePrecision",
       "MPMHeader",
       "the fields of particle files, except the positions, are written with the seven digits of single precision. "
       "This is the default; the run itself, its checkpoints and its tables always have double precision",
       T::none,
       {},
       true});
  add({"DoublePrecision",
       "MPMHeader",
       "the fields of particle files are written with all sixteen digits, which makes the files twice as large; for "
       "comparisons that need more than seven digits",
       T::none,
       {},
       true});
  add({"SplitParticles",
       "MPMHeader",
       "particles that stretch beyond a length split in two, and small neighbouring particles merge again, so that "
       "flowing material does not separate numerically",
       T::none,
       {number("longest", "length of the domain above which a particle splits, in cells; 0.25 to 4 (default 1)"),
        number("generations", "how often a particle and its halves may split, 1 to 30 (default 6)"),
        {"merge", T::flag, "whether neighbouring particles that have become small again merge (default yes)"}},
       true});
  add({"BBar",
       "MPMHeader",
       "B-bar method against volumetric locking: the volumetric strain and the pressure are averaged around each "
       "particle. It needs linear or lCPDI shape functions",
       T::none,
       {},
       true});
  add({"ExtrapolateRigid",
       "MPMHeader",
       "accepted without effect, since rigid particles always act through extrapolated velocities",
       T::none,
       {},
       true});
  add({"CPDIrcrit",
       "MPMHeader",
       "largest distance of a corner of a CPDI domain from its particle, in cells; in (0, 1], default 1",
       T::number,
       {},
       true});
  add({"StressFreeTemp",
       "MPMHeader",
       "initial temperature of bodies whose temperature is not given (default 0)",
       T::number,
       {},
       true});
}

void add_grid(Rows& add) {
  add({"Mesh",
       "JANFEAInput",
       "the grid",
       T::none,
       {text("output", "accepted without effect")},
       true,
       true,
       false,
       {},
       "Blocks"});
  add({"Grid",
       "Mesh",
       "extent of the grid, given by the coordinates of its edges",
       T::none,
       {number("xmin", "lower edge along x", true),
        number("xmax", "upper edge along x", true),
        number("ymin", "lower edge along y", true),
        number("ymax", "upper edge along y", true),
        number("zmin", "lower edge along z; required in three dimensions"),
        number("zmax", "upper edge along z; required in three dimensions"),
        number("thickness", "thickness of a plane model, > 0 (default 1)"),
        {"type", T::integer, "accepted without effect"},
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
         {{"nx", T::integer, "number of cells along x, in <Horiz>; this or cellsize is required"},
          {"ny", T::integer, "number of cells along y, in <Vert>; this or cellsize is required"},
          {"nz", T::integer, "number of cells along z, in <Depth>; this or cellsize is required"},
          number("cellsize",
                 "cell size, > 0; required without a number of cells. The upper edge of the grid moves outward to a "
                 "whole number of cells"),
          number("symmin", "coordinate of a plane of symmetry at the lower side of the model; it must be a grid line"),
          number("symmax", "coordinate of a plane of symmetry at the upper side of the model; it must be a grid line"),
          number("wallmin",
                 "coordinate of a wall at the lower side of the model, on a grid line. The wall modifies the B-spline "
                 "shape functions next to it; the velocity of its nodes must be prescribed in addition"),
          number("wallmax", "the same at the upper side of the model"),
          {"periodic", T::integer,
           "1: the axis is periodic, so that particles that leave at one edge enter at the opposite edge (default 0)"},
          {"rx", T::number,
           "ratio of the sizes of neighbouring cells, in <Horiz>; must be 1, since all cells are equal"},
          {"ry", T::number, "the same in <Vert>"},
          {"rz", T::number, "the same in <Depth>"},
          {"style", T::text,
           "how the size of the cells changes along the axis; without effect, since all cells are equal"},
          units(lengths)},
         true});
}

}  // namespace tribo::keywords
