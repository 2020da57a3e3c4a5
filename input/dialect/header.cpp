// SPDX-License-Identifier: MIT
/// Keywords of the header, the scheme and the times of a run.

#include "input/dialect/rows.hpp"
#include "model/shape_functions.hpp"

namespace tribo::keywords {

void add_header(Rows& add) {
  add({"JANFEAInput",
       "",
       "the root element of a command file",
       T::none,
       {{"version", T::version,
         "version of the format that the file needs, such as 3 or 3.2; a version newer than the program supports is an "
         "error"}}});

  add({"Commands", "JANFEAInput",
       "commands of the script language; the elements that they produce are added to the file", T::text});

  // Header
  add({"Header", "JANFEAInput", "description and type of the analysis", T::none, {}, true, true});
  add({"Description", "Header", "free text that describes the model", T::text, {}, true});
  add({"Analysis",
       "Header",
       "type of the analysis: 10 plane strain, 11 plane stress, 12 three-dimensional, 13 axisymmetric",
       T::choice,
       {},
       true,
       true,
       false,
       "10 11 12 13"});
  add({"ConsistentUnits",
       "Header",
       "base units of one consistent system, in which all numbers of the file are given. Without this element the "
       "numbers are in the legacy units of NairnMPM",
       T::none,
       {{"length", T::choice, "unit of length (default L, a unit without a name)", "km m dm cm mm um microns nm L"},
        {"mass", T::choice, "unit of mass; t is the tonne, 1000 kg (default M, a unit without a name)",
         "t kg g mg ug M"},
        {"time", T::choice, "unit of time (default T, a unit without a name)", "s sec ms msec us T"}},
       true});
  add({"RandSeed", "Header", "accepted without effect, since Tribo uses no random numbers here", T::integer, {}, true});

  // MPMHeader
  add({"MPMHeader", "JANFEAInput", "settings of the solver and of the output", T::none, {}, true, true});
  add({"MPMMethod",
       "MPMHeader",
       "when stresses are updated: 0 or USF at the start of the step, 3 or USL at its end, 2 or USAVG (default) half "
       "at the start and half at the end. An update at the end uses velocities that are extrapolated again from the "
       "updated particles, unless <SkipPostExtrapolation/> is given. USL- and USAVG- do without it, too; USL+ and "
       "USAVG+ "
       "are the same as USL and USAVG",
       T::choice,
       {},
       true,
       false,
       false,
       "0 2 3 USF USAVG USL USAVG- USL- USAVG+ USL+"});
  add({"SkipPostExtrapolation",
       "MPMHeader",
       "the update at the end of a step uses the nodal velocities without a second extrapolation of the particle "
       "velocities to the grid; the methods are then called USL- and USAVG-",
       T::none,
       {},
       true});
  add({"GIMP",
       "MPMHeader",
       "shape functions of the grid. Without 'type' they are those of uGIMP; without this element they are linear",
       T::none,
       {{"type", T::choice,
         "name or number of the shape functions: Classic, Dirac, linear and 0 are the same, so are uGIMP, GIMP and 1, "
         "lCPDI, CPDI and 2, B2SPLINE, quadratic and 6, B3SPLINE and cubic",
         all_kernel_words()}},
       true});
  add({"Transfer",
       "MPMHeader",
       "how the velocities of the particles are updated from those of the nodes; without this element by FLIP",
       T::none,
       {{"type", T::choice, "method of the update", "FLIP PIC blend XPIC FMPM APIC", true},
        number("fraction", "type blend: fraction of FLIP in the blend with PIC, 0 to 1 (default 0.99)"),
        {"order", T::integer, "types XPIC and FMPM: the order m of XPIC(m) or k of FMPM(k), 1 to 100 (default 2)"}},
       true});
  add({"TimeStep",
       "MPMHeader Stage",
       "largest time step, > 0; the Courant number may demand a smaller one",
       T::number,
       {units(times)},
       true});
  add({"MaxTime", "MPMHeader", "time at which the run ends, > 0", T::number, {units(times)}, true});
  add({"TimeFactor",
       "MPMHeader Stage",
       "Courant number: number of cells that the fastest wave may travel in a time step; in (0, 1], default 0.5. Some "
       "schemes need smaller steps, and the summary says what determines the step",
       T::number,
       {},
       true});
  add({"TransTimeFactor",
       "MPMHeader",
       "time step as a fraction of the largest stable one of heat conduction; in (0, 1], default 0.5",
       T::number,
       {},
       true});
  add({"Timing",
       "MPMHeader",
       "time step, end of the run and Courant number in one element",
       T::none,
       {number("step", "largest time step, > 0 (default 1)"),
        number("max", "time at which the run ends, > 0 (default 1)"),
        number("CFL", "Courant number, as in <TimeFactor>; in (0, 1], default 0.5"),
        number("TransCFL",
               "time step as a fraction of the largest stable one of heat conduction; in (0, 1], default 0.5"),
        units(times)},
       true});
}

}  // namespace tribo::keywords
