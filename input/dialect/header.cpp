// SPDX-License-Identifier: MIT
/// Keywords of the header, the scheme and the times of a run.

#include "input/dialect/rows.hpp"
#include "model/shape_functions.hpp"

namespace tribo::keywords {

void add_header(Rows& add) {
  add({"JANFEAInput",
       "",
       "a command file",
       T::none,
       {{"version", T::version,
         "version of the format that the file needs, such as 3 or 3.2; a newer one than the program reads is an "
         "error"}}});

  add({"Commands", "JANFEAInput",
       "commands of the script language; the elements that they produce are added to the file", T::text});

  // Header
  add({"Header", "JANFEAInput", "description and type of the analysis", T::none, {}, true, true});
  add({"Description", "Header", "free text", T::text, {}, true});
  add({"Analysis",
       "Header",
       "10 plane strain, 11 plane stress, 12 three-dimensional, 13 axisymmetric",
       T::choice,
       {},
       true,
       true,
       false,
       "10 11 12 13"});
  add({"ConsistentUnits",
       "Header",
       "all numbers are in one consistent system of units; if absent, legacy units",
       T::none,
       {{"length", T::choice, "unit of length; L is one without a name", "km m dm cm mm um microns nm L"},
        {"mass", T::choice, "unit of mass; t is the tonne, 1000 kg, and M one without a name", "t kg g mg ug M"},
        {"time", T::choice, "unit of time; T is one without a name", "s sec ms msec us T"}},
       true});
  add({"RandSeed", "Header", "accepted without effect: Tribo uses no random numbers here", T::integer, {}, true});

  // MPMHeader
  add({"MPMHeader", "JANFEAInput", "settings of the solver and of the output", T::none, {}, true, true});
  add({"MPMMethod",
       "MPMHeader",
       "stress update: 0 first (USF), 2 half at the start and half at the end of the step (USAVG, default), 3 last "
       "(USL); strains are found again after the update of the particles unless <SkipPostExtrapolation/> is given",
       T::choice,
       {},
       true,
       false,
       false,
       "0 2 3 USF USAVG USL"});
  add({"SkipPostExtrapolation",
       "MPMHeader",
       "strain update without a second extrapolation of the velocities to the grid (USL-, USAVG-)",
       T::none,
       {},
       true});
  add({"GIMP",
       "MPMHeader",
       "shape functions; an empty element means uGIMP, an absent one means linear",
       T::none,
       {{"type", T::choice, "", all_kernel_words()}},
       true});
  add({"Transfer",
       "MPMHeader",
       "how the particle velocities are updated from the nodes (default FLIP)",
       T::none,
       {{"type", T::choice, "", "FLIP PIC blend XPIC FMPM APIC", true},
        number("fraction", "fraction of FLIP in a blend with PIC"),
        {"order", T::integer, "order m of XPIC(m), k of FMPM(k)"}},
       true});
  add({"TimeStep", "MPMHeader Stage", "largest time step", T::number, {units(times)}, true});
  add({"MaxTime", "MPMHeader", "end of the run", T::number, {units(times)}, true});
  add({"TimeFactor",
       "MPMHeader Stage",
       "Courant number of the fastest wave, in cells per step (default 0.5)",
       T::number,
       {},
       true});
  add({"TransTimeFactor", "MPMHeader", "fraction of the largest stable time step of conduction", T::number, {}, true});
  add({"Timing",
       "MPMHeader",
       "time step, end of the run and Courant number in one element",
       T::none,
       {number("step", "largest time step"), number("max", "end of the run"), number("CFL", "Courant number"),
        number("TransCFL", "fraction of the largest stable time step of conduction"), units(times)},
       true});
}

}  // namespace tribo::keywords
