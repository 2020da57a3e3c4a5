// SPDX-License-Identifier: MIT
/// Keywords of the output.

#include "input/dialect/rows.hpp"

namespace tribo::keywords {

void add_output(Rows& add) {
  add({"ArchiveTime",
       "MPMHeader",
       "time between particle files; this or ArchiveGroup is required",
       T::number,
       {units(times), {"maxProps", T::integer, "no effect"}},
       false});
  add({"FirstArchiveTime",
       "MPMHeader",
       "time of the first particle file after the start",
       T::number,
       {units(times)},
       true});
  add({"ArchiveGroup",
       "MPMHeader",
       "a further interval between particle files, from a later time on",
       T::none,
       {number("time", "interval", true),
        number("start", "time from which on it applies; required where an interval precedes"),
        {"maxProps", T::integer, "no effect"},
        units(times)}});
  add({"GlobalArchiveTime",
       "MPMHeader",
       "time between rows of history.csv (default: that of the particle files)",
       T::number,
       {units(times)},
       true});
  add({"GlobalArchive",
       "MPMHeader",
       "a column of history.csv; 'tribo list' names all quantities",
       T::none,
       {text("type", "name of the quantity", true),
        text("material", "number of a material, or id of a condition; this, mat or matname is required with 'with'"),
        text("mat", "the same as material; this, material or matname is required with 'with'"),
        text("matname", "name of a material; this, material or mat is required with 'with'"),
        text("pt", "'x,y' or 'x,y,z': value of the particle initially nearest to this point"),
        text("with", "contact quantities: number of the other material"),
        text("withname", "name of the other material"), text("platen", "models of blocks: name of a platen"),
        text("block", "models of blocks: name of a block or group")}});
  add({"ArchiveRoot",
       "MPMHeader",
       "accepted without effect; results are written to the run folder",
       T::text,
       {{"unique", T::flag, "no effect"}},
       true});
  add({"MPMArchiveOrder",
       "MPMHeader",
       "letters Y and N that select fields of the particle files, in the order of NairnMPM's particle records",
       T::text,
       {},
       true});
  add({"MPMArchive",
       "MPMHeader",
       "a field of the particle files; jintegral and stressintensity select tips.csv",
       T::none,
       {text("result", "name", true), {"setting", T::flag, "whether it is written (default yes)"}}});
  add({"CrackArchiveOrder",
       "MPMHeader",
       "letters Y and N; with cracks, a Y as third or fourth letter selects tips.csv",
       T::text,
       {},
       true});
  add({"Output",
       "MPMHeader",
       "fields of the particle files and grid files, and checkpoints",
       T::none,
       {text("fields", "names of fields of the particle files"),
        text("grid", "names of fields of the grid files: mass velocity"),
        number("checkpoint", "time between checkpoints (default: with every particle file)")},
       true});
}

}  // namespace tribo::keywords
