// SPDX-License-Identifier: MIT
/// Keywords of the output.

#include "input/dialect/rows.hpp"

namespace tribo::keywords {

void add_output(Rows& add) {
  add({"ArchiveTime",
       "MPMHeader",
       "time between particle files; this or <ArchiveGroup> is required",
       T::number,
       {units(times), {"maxProps", T::integer, "accepted without effect"}},
       false});
  add({"FirstArchiveTime",
       "MPMHeader",
       "time of the first particle file after the start",
       T::number,
       {units(times)},
       true});
  add({"ArchiveGroup",
       "MPMHeader",
       "a further interval between particle files, which holds from a later time on",
       T::none,
       {number("time", "time between particle files", true),
        number("start", "time from which on this interval holds; required if another interval precedes it"),
        {"maxProps", T::integer, "accepted without effect"},
        units(times)}});
  add({"GlobalArchiveTime",
       "MPMHeader",
       "time between rows of history.csv (default: the time between particle files)",
       T::number,
       {units(times)},
       true});
  add({"GlobalArchive",
       "MPMHeader",
       "a column of history.csv; 'tribo list' names all quantities",
       T::none,
       {text("type", "name of the quantity", true),
        text("material",
             "number of the material, or id (0 or negative) of a condition, to which the quantity belongs; this, mat "
             "or matname is required with 'with'"),
        text("mat", "the same as material; this, material or matname is required with 'with'"),
        text("matname", "name of the material; this, material or mat is required with 'with'"),
        text("pt", "'x,y' or 'x,y,z': the value is that of the particle that is nearest to this point at the start"),
        text("with", "quantities of contact: number of the other material of the pair"),
        text("withname", "quantities of contact: name of the other material"),
        text("platen", "models of blocks: name of the platen"),
        text("block", "models of blocks: name of the block, or of a group of blocks")}});
  add({"ArchiveRoot",
       "MPMHeader",
       "accepted without effect, since results are written to the folder of the run",
       T::text,
       {{"unique", T::flag, "accepted without effect"}},
       true});
  add({"MPMArchiveOrder",
       "MPMHeader",
       "letters Y and N, one for each field of the particle records of NairnMPM in their order; Y selects the field "
       "for the particle files",
       T::text,
       {},
       true});
  add({"MPMArchive",
       "MPMHeader",
       "selects a field of the particle files; jintegral and stressintensity select the table tips.csv",
       T::none,
       {text("result", "name of the field", true),
        {"setting", T::flag, "whether the field is written (default yes)"}}});
  add({"CrackArchiveOrder",
       "MPMHeader",
       "letters Y and N; in models with cracks, a Y as the third or fourth letter selects the table tips.csv",
       T::text,
       {},
       true});
  add({"Output",
       "MPMHeader",
       "fields of the particle files and of the grid files, and the time between checkpoints",
       T::none,
       {text("fields", "names of the fields of the particle files, separated by blanks"),
        text("grid", "names of the fields of the grid files, separated by blanks: mass, velocity"),
        number("checkpoint", "time between checkpoints (default: with every particle file)")},
       true});
}

}  // namespace tribo::keywords
