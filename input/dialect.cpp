// SPDX-License-Identifier: MIT
#include "input/dialect.hpp"

#include "model/shape_functions.hpp"

namespace tribo {
namespace {

using T = ValueType;

constexpr std::string_view times = "ms msec s sec us microsec", lengths = "m cm mm microns in ft",
                           velocities = "m/sec mm/msec mm/sec cm/sec in/sec ft/sec", masses = "kg g mg lbs oz",
                           velocities_and_lengths = "m/sec mm/msec mm/sec cm/sec in/sec ft/sec m cm mm microns in ft";
constexpr std::string_view styles = "1 2 3 4 5 6 constant linear sine cosine silent function";

AttributeSpec number(std::string_view name, std::string_view meaning, bool required = false) {
  return {name, T::number, meaning, {}, required};
}
AttributeSpec text(std::string_view name, std::string_view meaning, bool required = false) {
  return {name, T::text, meaning, {}, required};
}
AttributeSpec function(std::string_view name, std::string_view meaning) { return {name, T::function, meaning}; }
AttributeSpec units(std::string_view known) {
  return {"units", T::choice, "unit of the value, in legacy files only", known};
}

std::vector<AttributeSpec> box(bool three) {
  std::vector<AttributeSpec> out;
  for (const auto name : {"xmin", "xmax", "ymin", "ymax"}) out.push_back({name, T::coordinate, "edge", {}, true});
  if (three)
    for (const auto name : {"zmin", "zmax"}) out.push_back({name, T::coordinate, "edge", {}, true});
  out.push_back(units(lengths));
  return out;
}

std::vector<AttributeSpec> operator+(std::vector<AttributeSpec> a, const std::vector<AttributeSpec>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

std::vector<AttributeSpec> ends() {
  std::vector<AttributeSpec> out;
  for (const auto name : {"x1", "y1", "z1", "x2", "y2", "z2", "xmin", "ymin", "zmin", "xmax", "ymax", "zmax"})
    out.push_back({name, T::coordinate, "end"});
  out.push_back({"tolerance", T::text, "distance, or *f for f cells (default *0.1)"});
  return out;
}

std::vector<AttributeSpec> body_attributes() {
  return {text("mat", "number of the material"),
          text("matname", "or its name"),
          number("angle", "material axes [degrees]"),
          number("thick", "thickness (2D)"),
          number("vx", "initial velocity"),
          number("vy", "initial velocity"),
          number("vz", "initial velocity"),
          number("temp", "initial temperature"),
          number("size", "edge of a particle's domain, instead of a number per cell")};
}

std::vector<AttributeSpec> condition_attributes() {
  return {{"style", T::choice, "how the value follows time (default constant)", styles},
          number("time", "start, slope origin, or frequency, as the style says"),
          number("ftime", "the same"),
          function("function", "value for style function"),
          {"id", T::integer, "number <= 0 that histories name"}};
}

std::vector<ElementSpec> make() {
  constexpr std::string_view shapes_in = "Body Hole BCShape LdShape Joint Platen Pressure Hold Load @shape";
  std::vector<ElementSpec> e;
  const auto add = [&](ElementSpec spec) { e.push_back(std::move(spec)); };

  add({"JANFEAInput", "", "a command file", T::none, {{"version", T::text, "of the dialect: 3"}}});

  add({"Commands", "JANFEAInput", "scripted commands, whose results are added to the sections", T::text});

  // Header
  add({"Header", "JANFEAInput", "what the file is about", T::none, {}, true, true});
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
       "all numbers are in one system; without it, legacy units",
       T::none,
       {{"length", T::choice, "", "km m dm cm mm um microns nm L"},
        {"mass", T::choice, "", "kg g mg ug M"},
        {"time", T::choice, "", "s sec ms msec us T"}},
       true});
  add({"RandSeed", "Header", "accepted; Tribo draws no random numbers", T::integer, {}, true});

  // MPMHeader
  add({"MPMHeader", "JANFEAInput", "how to solve", T::none, {}, true, true});
  add({"MPMMethod",
       "MPMHeader",
       "0 stress first (USF), 2 half before and half after (USAVG), 3 stress last (USL)",
       T::choice,
       {},
       true,
       false,
       false,
       "0 2 3 USF USAVG USL"});
  add({"SkipPostExtrapolation",
       "MPMHeader",
       "strain without extrapolating the velocities again (USL-, USAVG-)",
       T::none,
       {},
       true});
  add({"GIMP",
       "MPMHeader",
       "shape functions; the empty element means uGIMP, none means linear",
       T::none,
       {{"type", T::choice, "", all_kernel_words()}},
       true});
  add({"Transfer",
       "MPMHeader",
       "how particles take their velocity from the nodes (default FLIP)",
       T::none,
       {{"type", T::choice, "", "FLIP PIC blend XPIC FMPM APIC", true},
        number("fraction", "of FLIP in a blend"),
        {"order", T::integer, "m of XPIC(m), k of FMPM(k)"}},
       true});
  add({"TimeStep", "MPMHeader", "largest time step", T::number, {units(times)}, true});
  add({"MaxTime", "MPMHeader", "end of the run", T::number, {units(times)}, true});
  add({"TimeFactor", "MPMHeader", "Courant factor, cells per step of the fastest wave", T::number, {}, true});
  add({"TransTimeFactor", "MPMHeader", "the same for conduction, of the largest stable step", T::number, {}, true});
  add({"Timing",
       "MPMHeader",
       "step, end and Courant factor in one",
       T::none,
       {number("step", "largest time step"), number("max", "end of the run"), number("CFL", "Courant factor"),
        number("TransCFL", "for transport; no effect"), units(times)},
       true});
  add({"ArchiveTime",
       "MPMHeader",
       "time between particle files",
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
       "another interval from a later time",
       T::none,
       {number("time", "interval", true),
        number("start", "from this time on"),
        {"maxProps", T::integer, "no effect"},
        units(times)}});
  add({"GlobalArchiveTime",
       "MPMHeader",
       "time between rows of history.csv (default as the particle files)",
       T::number,
       {units(times)},
       true});
  add({"GlobalArchive",
       "MPMHeader",
       "a column of history.csv",
       T::none,
       {text("type", "name of the quantity", true), text("material", "number of a material, or id of a condition"),
        text("mat", "the same"), text("matname", "name of a material"),
        text("pt", "'x,y' or 'x,y,z': of the particle that starts nearest to this point"),
        text("with", "contact quantities: number of the other material"), text("withname", "or its name"),
        text("platen", "models of blocks: name of a platen"), text("block", "or of a block or group")}});
  add({"ArchiveRoot",
       "MPMHeader",
       "accepted; results go to the run folder",
       T::text,
       {{"unique", T::flag, "no effect"}},
       true});
  add({"MPMArchiveOrder",
       "MPMHeader",
       "Y and N per field of the dialect's particle records: choose fields of the particle files",
       T::text,
       {},
       true});
  add({"MPMArchive",
       "MPMHeader",
       "one field of the particle files; jintegral or stressintensity: tips.csv",
       T::none,
       {text("result", "name", true), {"setting", T::flag, "write it (default yes)"}}});
  add({"CrackArchiveOrder",
       "MPMHeader",
       "Y and N: with cracks, Y as third or fourth letter asks for tips.csv",
       T::text,
       {},
       true});
  add({"Output",
       "MPMHeader",
       "fields of the particle files and grid files, and checkpoints",
       T::none,
       {text("fields", "names for the particle files"), text("grid", "names for the grid files: mass velocity"),
        number("checkpoint", "time between checkpoints (default: with every particle file)")},
       true});
  add({"MatlPtsPerElement",
       "MPMHeader Body",
       "particles per cell: a square in 2D, a cube in 3D",
       T::integer,
       {},
       true});
  add({"Damping",
       "MPMHeader",
       "grid damping [1/time]",
       T::number,
       {function("function", "of time, instead of the number")},
       true});
  add({"PDamping",
       "MPMHeader",
       "particle damping [1/time]",
       T::number,
       {function("function", "of time, instead of the number")},
       true});
  add({"FeedbackDamping",
       "MPMHeader",
       "gain of grid damping that follows the kinetic energy",
       T::number,
       {function("target", "kinetic energy aimed at"), number("max", "largest damping")},
       true});
  add({"PFeedbackDamping",
       "MPMHeader",
       "gain of particle damping that follows the kinetic energy",
       T::number,
       {function("target", "kinetic energy aimed at"), number("max", "largest damping")},
       true});
  add({"DefGradTerms",
       "MPMHeader",
       "1 (default): F follows the particles, 1 + L dt; 2: the exponential of L dt to second order",
       T::integer,
       {},
       true});
  add({"LeaveLimit",
       "MPMHeader",
       "how many particles that leave the grid are put back before the run stops",
       T::integer,
       {},
       true});
  add({"StrengthReduction",
       "MPMHeader",
       "where 'tribo safety' looks for the factor of safety; 'tribo run' leaves it alone",
       T::none,
       {number("low", "first factor, which should hold (default 1)"),
        number("high", "first factor that should slip (default 2)"),
        number("tolerance", "width of the bracket at the end (default 0.01)"),
        number("growth",
               "the model slips if its largest displacement grows by this share in the last quarter of the run "
               "(default 0.05)")},
       true});
  add({"BBar",
       "MPMHeader",
       "volume changes and pressures are means around each particle: no locking",
       T::none,
       {},
       true});
  add({"CPDIrcrit", "MPMHeader", "largest reach of a CPDI corner, in cells (at most 1)", T::number, {}, true});
  add({"StressFreeTemp", "MPMHeader", "temperature of bodies that give none", T::number, {}, true});

  // Mesh
  add({"Mesh", "JANFEAInput", "the grid", T::none, {text("output", "accepted")}, true, true, false, {}, "Blocks"});
  add({"Grid",
       "Mesh",
       "its box",
       T::none,
       {number("xmin", "", true),
        number("xmax", "", true),
        number("ymin", "", true),
        number("ymax", "", true),
        number("zmin", ""),
        number("zmax", ""),
        number("thickness", "of a plane model (default 1)"),
        {"type", T::integer, "accepted"},
        units(lengths)},
       true,
       true});
  for (const auto name : {"Horiz", "Vert", "Depth"})
    add({name,
         "Grid",
         name[0] == 'H'   ? "cells along x"
         : name[0] == 'V' ? "cells along y"
                          : "cells along z",
         T::none,
         {{"nx", T::integer, "number of cells (Horiz)"},
          {"ny", T::integer, "(Vert)"},
          {"nz", T::integer, "(Depth)"},
          number("cellsize", "or their size; the upper edge grows to a whole cell"),
          number("symmin", "symmetry plane at this coordinate"),
          number("symmax", "symmetry plane at this coordinate"),
          number("wallmin", "shape functions end at this wall (B-splines)"),
          number("wallmax", "shape functions end at this wall (B-splines)"),
          {"periodic", T::integer, "1: the two edges of the grid are one; what leaves comes in on the other side"},
          {"rx", T::number, "accepted for equal cells: 1"},
          {"style", T::text, "accepted for equal cells"},
          units(lengths)},
         true});

  // MaterialPoints
  add({"MaterialPoints", "JANFEAInput", "bodies and particles", T::none, {}, true, true, false, {}, "Blocks"});
  add({"Body", "MaterialPoints", "shapes filled with a material", T::none,
       body_attributes() + std::vector{units(velocities_and_lengths)}});
  add({"Hole", "MaterialPoints", "shapes left empty", T::none});
  for (const auto name : {"vel0X", "vel0Y", "vel0Z"})
    add({name, "Body", "initial velocity of the following shapes, a function of position (before Deform moves it)",
         T::function});
  for (const auto name : {"RotateX", "RotateY", "RotateZ"})
    add({name, "Body", "material axes of the following shapes [degrees]", T::function});
  add({"Unrotate", "Body", "material axes along the grid again"});
  add({"Deform",
       "Body",
       "moves and strains the following shapes before the start",
       T::none,
       {function("dX", "shift"), function("dY", "shift"), function("dZ", "shift"), function("F11", ""),
        function("F12", ""), function("F13", ""), function("F21", ""), function("F22", ""), function("F23", ""),
        function("F31", ""), function("F32", ""), function("F33", "")}});
  add({"Undeform", "Body", "no initial deformation of the following shapes"});
  add({"InitialStress",
       "Body",
       "Cauchy stress of the following shapes at the start: functions of position, values at points, with K0 the "
       "weight "
       "of what lies above, added up",
       T::none,
       {text("file", "table with columns x, y, z of points and xx, yy, zz, xy, yz, xz of the stress there"),
        number("K0", "horizontal over vertical stress at rest"), function("xx", ""), function("yy", ""),
        function("zz", ""), function("xy", ""), function("yz", ""), function("xz", "")}});
  add({"PointList", "MaterialPoints", "single particles"});
  add({"mp",
       "PointList",
       "a particle",
       T::none,
       {{"elem", T::integer, "accepted"},
        text("mat", "number of the material"),
        text("matname", "or its name"),
        number("angle", "material axes [degrees]"),
        number("thick", "thickness"),
        number("temp", "temperature"),
        number("lpx", "half width of its domain [half cells]"),
        number("lpy", ""),
        number("lpz", "")}});
  add({"pt",
       "mp Polygon Voronoi PolygonBlock",
       "coordinates",
       T::none,
       {{"x", T::coordinate, "", {}, true},
        {"y", T::coordinate, "", {}, true},
        {"z", T::coordinate, ""},
        units(lengths)}});
  add({"vel", "mp", "velocity", T::none, {number("x", ""), number("y", ""), number("z", ""), units(velocities)}, true});
  add({"mass", "mp", "mass instead of density times volume", T::none, {number("m", "", true), units(masses)}, true});

  // Shapes
  const auto shape = [&](std::string_view name, std::string_view meaning, std::vector<AttributeSpec> attributes) {
    add({name, shapes_in, meaning, T::none, std::move(attributes), false, false, true});
  };
  shape("Rect", "rectangle", box(false));
  shape("Oval", "ellipse in a box; with <arc>, a sector", box(false));
  add({"arc", "Oval", "sector [degrees]", T::none, {number("start", "", true), number("end", "", true)}, true});
  shape("Polygon", "polygon through <pt>s", {});
  shape("Line", "strip around a line", ends());
  shape("Arc", "strip around the edge of an ellipse",
        box(false) + std::vector{number("start", "[degrees]"), number("end", "[degrees]"),
                                 AttributeSpec{"tolerance", T::text, "distance, or *f cells"}});
  shape("Box", "box", box(true));
  shape("Sphere", "ellipsoid in a box", box(true));
  shape("Cylinder", "elliptic cylinder or cone in a box",
        box(true) + std::vector{AttributeSpec{"axis", T::choice, "", "1 2 3 x y z", true},
                                number("radius", "-1..1: ratio of end radii, 0 a cone")});
  shape("Torus", "ring in a box",
        box(true) + std::vector{AttributeSpec{"axis", T::choice, "", "1 2 3 x y z", true},
                                number("radius", "half width of the ring's section; 0 a circle")});
  shape("STL", "closed surface from a file",
        {text("file", "", true), number("scale", "factor (default 1)"), number("x", "shift"), number("y", "shift"),
         number("z", "shift")});
  add({"BMP",
       "MaterialPoints",
       "grey picture (PNG or BMP) laid over a rectangle",
       T::none,
       {text("name", "file", true), number("width", "(default: one unit per pixel)"), number("height", ""),
        units(lengths)}});
  add({"Origin", "BMP", "lower left corner", T::none, {number("x", ""), number("y", ""), units(lengths)}, true});
  add({"Intensity",
       "BMP",
       "material of a range of grey",
       T::none,
       {text("mat", "number of the material"),
        text("matname", "or its name"),
        {"imin", T::integer, "0 black", {}, true},
        {"imax", T::integer, "255 white", {}, true},
        number("vx", ""),
        number("vy", ""),
        number("vz", ""),
        number("thick", ""),
        number("angle", "")}});

  // Material
  // Drive
  add({"Drive",
       "JANFEAInput",
       "drives one law at a point along a path, for 'tribo drive'; 'tribo run' leaves it alone",
       T::none,
       {text("material", "name of the material to drive"),
        text("contact", "or of the contact law"),
        text("joint", "or of the joint law"),
        {"test", T::choice, "a standard test in place of <Path>",
         "simple_shear uniaxial_stress oedometer triaxial_compression triaxial_extension isotropic"},
        number("strain", "where the test ends: of the shear, the axis or, isotropic, the volume"),
        number("rate", "of that strain (default 1)"),
        {"steps", T::integer, "of the test (default 100)"},
        number("pressure", "that confines a triaxial test"),
        number("angle", "of the material axes about z [degrees]"),
        number("temp", "temperature at the start (default that of StressFreeTemp)"),
        number("mass",
               "reduced mass per area of the faces of a contact law (default 1); of a joint law: mass that its "
               "dashpots see (default: of the block)"),
        number("gap", "between the faces at the start (default 0)"),
        number("cell", "size of the cells that a contact law is told (default 1)"),
        number("area", "of the joint (default 1)"),
        number("thickness", "of a joint in two dimensions; without it: three"),
        number("distance", "between the centres of the bodies that a joint joins"),
        number("block", "mass that the joint holds; it moves by the forces on it"),
        number("spring-normal", "stiffness [force/length] of the machine, whose far end the path moves"),
        number("spring-shear", "the same along the joint"),
        number("vn", "velocity of the block at the start"),
        number("vss", "the same along s"),
        number("vst", "the same along t")},
       true});
  add({"InitialStress",
       "Drive",
       "stress before the path",
       T::none,
       {number("xx", "normal stress"), number("yy", "normal stress"), number("zz", "normal stress"),
        number("xy", "shear stress"), number("yz", "shear stress"), number("xz", "shear stress")},
       true});
  add({"Path",
       "Drive",
       "rows of numbers with commas between; the first line names the columns: dt, steps, and for a material Lxx .. "
       "Lzz "
       "(velocity gradient) and sxx .. sxz (prescribed stress), for a contact law vn, vt1, vt2 and N, St1, St2, for a "
       "joint law, each step, dn, dss, dst, dtwist, dbs, dbt, or prescribed Fn, Fss, Fst, loads Pn, Pss, Pst, and the "
       "force of the fictitious stress Ffn, Ffss, Ffst",
       T::text,
       {text("file", "the rows are in this file")},
       true});

  add({"Material",
       "JANFEAInput",
       "a material; its properties are elements, see the list of materials",
       T::none,
       {text("Type", "number or name", true), text("Name", "", true)},
       false,
       true});

  // Contact
  add({"MultiMaterialMode",
       "MPMHeader",
       "materials have velocity fields of their own and touch by contact laws",
       T::none,
       {{"Normals", T::choice,
         "how normals are found (default margin): 0 larger gradient, 1 larger volume, 2 average gradient, 3 own "
         "gradient, 4 specified, 5 linear regression, 6 logistic regression, 7 largest margin",
         "0 1 2 3 4 5 6 7 maxgrad maxvol avggrad owngrad specify linreg logreg margin"},
        {"Separation", T::choice,
         "how gaps are found (default edges of the particle domains; with gradients positions if ContactPosition is "
         "given, else displacements)",
         "edges positions displacements"},
        {"Impulses", T::choice,
         "where impulses act (default nodes): nodes is robust in any motion; faces gives the right stress in the cells "
         "next to contact, without numerical damping, at a higher cost",
         "nodes faces"},
        number("RigidBias", "weight of a rigid body's gradient (default 1)"),
        number("Azimuth", "of a specified normal, from x [degrees]"),
        number("Polar", "of a specified normal, from z [degrees]"),
        text("Lumping", "obsolete: all pairs are solved together"),
        text("Vmin", "obsolete"),
        text("Dcheck", "obsolete")},
       true});
  const std::vector<AttributeSpec> law{text("law", "number of the contact law"),
                                       text("lawname", "or its name"),
                                       number("Dn", "old style: normal stiffness of an interface"),
                                       number("Dnt", "the same"),
                                       number("Dnc", "in compression"),
                                       number("Dt", "tangential")};
  add({"Friction", "MultiMaterialMode",
       "the default law; or old style, a number: below -10 none, negative stick, below 10 friction coefficient, else "
       "an "
       "interface (absent: frictionless)",
       T::number, law, true});
  add({"Friction", "Material",
       "the law between this material and another: a contact law, or a joint law, which acts where their faces touch "
       "at "
       "the start",
       T::number,
       law + std::vector<AttributeSpec>{text("mat", "number of the other material"), text("matname", "or its name")}});
  add({"ContactPosition",
       "MultiMaterialMode",
       "gaps from positions, for normals from gradients: cells between touching bodies, or minus an exponent",
       T::number,
       {},
       true});
  add({"Cracks", "MPMHeader", "what holds for all cracks", T::none, {}, true});
  add({"Friction", "Cracks",
       "law between the faces of cracks that have none of their own; a number as in MultiMaterialMode (absent: "
       "frictionless)",
       T::number, law, true});
  add({"JContour", "Cracks",
       "J integrals and stress intensities at the tips of cracks go to tips.csv (plane strain and plane stress)",
       T::none,
       std::vector<AttributeSpec>{{"type", T::integer, "1"},
                                  number("size", "radius of the ring around a tip, in cells (default 4)"),
                                  {"terms", T::integer, "1: without accelerations; 2 (default): with them"},
                                  {"gridenergy", T::choice, "energies are those of the particles", "N no 0"}},
       true});
  add({"Propagate", "Cracks Material", "cracks grow (the same within a material)", T::none,
       std::vector<AttributeSpec>{
           {"criterion", T::integer,
            "0 none, 1 (default) largest hoop stress, 4 strain energy density, 5 empirical, 7 release rate"},
           {"direction", T::integer,
            "0 (default) of the criterion (7: straight on), 1 straight on, 2 normal to the opening, 3 largest hoop "
            "stress by the opening, 4 as at the start"},
           {"traction", T::integer, "0: new parts carry no traction"}},
       true});
  add({"PropagateLength", "Cracks", "by which a tip grows at a time, in cells (default 0.5)", T::number, {}, true});
  const std::vector<std::pair<const char*, const char*>> toughnesses{
      {"KIc", "stress intensity of the largest hoop stress at which a crack grows [MPa m^0.5 in legacy files]"},
      {"KIIc", "critical stress intensity of sliding, for criterion 5"},
      {"JIc", "release rate at which a crack grows, for criterion 7 [J/m^2 in legacy files]"},
      {"KIexp", "exponent of KI/KIc in criterion 5 (default 2)"},
      {"KIIexp", "exponent of KII/KIIc in criterion 5 (default 2)"}};
  for (const auto& [name, meaning] : toughnesses) add({name, "Material", meaning, T::number, {}, true});
  const std::vector<AttributeSpec> tips{
      {"start_tip", T::integer, "tip at the start: number of the material there, -1 none, -2 outside of the body"},
      {"end_tip", T::integer, "the same at the end"}};
  add({"CrackList", "JANFEAInput",
       "a crack: a line of points and lines in their order, or surfaces in three dimensions", T::none,
       std::vector<AttributeSpec>{{"type", T::choice, "accepted", "fixed free"},
                                  text("law", "number of the contact or joint law between its faces"),
                                  text("lawname", "or its name"),
                                  number("friction", "old style: friction coefficient of the faces")}});
  add({"pt",
       "CrackList",
       "the next point of the line",
       T::none,
       {number("x", "", true), number("y", "", true), {"tip", T::integer, "as start_tip of Line"}, units(lengths)}});
  add({"Line", "CrackList", "points along a line, from the last point if that lies elsewhere", T::none,
       std::vector<AttributeSpec>{{"xmin", T::coordinate, "start", {}, true},
                                  {"ymin", T::coordinate, "start", {}, true},
                                  {"xmax", T::coordinate, "end", {}, true},
                                  {"ymax", T::coordinate, "end", {}, true},
                                  {"resolution", T::integer, "number of pieces (default: two per cell)"},
                                  units(lengths)} +
           tips});
  add({"Circle", "CrackList", "points along an arc of an ellipse", T::none,
       std::vector<AttributeSpec>{{"xmin", T::coordinate, "edge of the ellipse's box", {}, true},
                                  {"ymin", T::coordinate, "edge", {}, true},
                                  {"xmax", T::coordinate, "edge", {}, true},
                                  {"ymax", T::coordinate, "edge", {}, true},
                                  number("start_angle", "from x [degrees] (default 0)"),
                                  number("end_angle", "[degrees] (default 360)"),
                                  {"resolution", T::integer, "number of pieces (default: two per cell)"},
                                  units(lengths)} +
           tips});
  add({"Quad",
       "CrackList",
       "a parallelogram of triangles in three dimensions: a corner and its two neighbours",
       T::none,
       {number("x1", "corner", true), number("y1", "", true), number("z1", "", true), number("x2", "neighbour", true),
        number("y2", "", true), number("z2", "", true), number("x3", "other neighbour", true), number("y3", "", true),
        number("z3", "", true), units(lengths)}});
  add({"Disc",
       "CrackList",
       "a circle of triangles in three dimensions",
       T::none,
       {number("x", "centre", true), number("y", "", true), number("z", "", true), number("radius", "", true),
        number("nx", "normal, to the upper face (default 0)"), number("ny", "(default 0)"), number("nz", "(default 1)"),
        units(lengths)}});
  add({"shareMatField", "Material", "number of a material whose velocity field this one shares", T::integer, {}, true});

  // Blocks
  const std::vector<AttributeSpec> of_blocks{
      text("name", "that histories and messages use"),
      text("matname", "beside a grid: the RigidContact material others touch it by"),
      text("mat", "or its number"),
      number("rho", "density", true),
      number("vx", "velocity at the start"),
      number("vy", ""),
      number("vz", ""),
      number("spinx", "rotation at the start [rad/time]"),
      number("spiny", ""),
      number("spinz", "")};
  const std::vector<AttributeSpec> block_box{number("xmin", "edge", true), number("xmax", "", true),
                                             number("ymin", "", true),     number("ymax", "", true),
                                             number("zmin", ""),           number("zmax", "")};
  const AttributeSpec points{"points", T::choice,
                             "a contact at the middle of a common face (default), or at each of its corners with its "
                             "share of the area, so that laws without moments resist turning",
                             "face corners"};
  add({"Blocks", "JANFEAInput", "rigid blocks whose contacts follow joint laws, alone or beside the matter in a grid",
       T::none,
       std::vector<AttributeSpec>{
           text("lawname", "name of the joint law of contacts that no <Joint> names, and of the platens' stiffness"),
           text("law", "or its number"),
           text("touchname", "name of the joint law of blocks that meet later; without it they must not"),
           points,
           number("thickness", "of a plane model (default 1)"),
           number("damping",
                  "share of the unbalanced force that acts against the motion of each block: 0 (default) dynamic, 0.7 "
                  "for a state of rest"),
           {"quasistatic", T::flag,
            "masses are chosen so that <TimeStep> is stable: time has no meaning but for prescribed motions"},
           {"iterations", T::integer, "substitutions of the fictitious stress within a step (default 0)"},
           number("step", "share of the critical time step (default 0.8)")},
       true});
  add({"Voronoi", "Blocks", "blocks that fill a box: cells of the <pt>s in it, of a file, of a lattice, or random",
       T::none,
       block_box +
           std::vector{
               text("file", "table with columns x, y, z of the nuclei"),
               number("hexagons", "distance between the flat tops of regular hexagons, instead"),
               number("cubes", "edge of cubes, in two dimensions squares, instead"),
               number("octahedra", "distance between opposite squares of truncated octahedra, in space, instead"),
               {"random", T::integer, "number of nuclei strewn at random, instead"},
               {"seed", T::integer, "of them: another number, another specimen (default 1)"},
               number("apart",
                      "least distance between two of them, of the edge of the square or cube that is one's "
                      "due: 0 to 0.8 (default 0.6)")} +
           of_blocks});
  add({"BoxBlock", "Blocks", "a rectangle or box as one block", T::none,
       block_box + std::vector{number("angle", "turned about z around the origin [degrees]")} + of_blocks});
  add({"PolygonBlock", "Blocks", "a convex polygon through <pt>s as one block", T::none,
       std::vector<AttributeSpec>{number("angle", "turned about z around the origin [degrees]")} + of_blocks});
  add({"Ball", "Blocks", "a ball, in two dimensions a disc, as one block", T::none,
       std::vector<AttributeSpec>{number("x", "centre", true), number("y", "", true), number("z", ""),
                                  number("radius", "", true)} +
           of_blocks});
  add({"Joint", "Blocks", "law of contacts whose middles lie in its shapes; the first that fits is taken", T::none,
       std::vector<AttributeSpec>{text("lawname", "name of the joint law"), text("law", "or its number"), points}});
  const std::vector<AttributeSpec> motion{function("vx", "velocity, may be a function of t"), function("vy", ""),
                                          function("vz", "")};
  add({"Platen", "Blocks",
       "a stiff plate that holds the free faces whose middles lie in its shapes, also in tension; it stands still "
       "where no velocity is given",
       T::none,
       std::vector<AttributeSpec>{
           text("name", "that histories use"),
           {"rough", T::flag, "it holds the faces along the plate, too"},
           number("E", "modulus of its springs E A/d, d from block to face (default: as the common law)")} +
           motion});
  add({"Pressure", "Blocks", "pressure on the free faces whose middles lie in its shapes", T::none,
       std::vector<AttributeSpec>{{"value", T::function, "pressure, may be a function of t", {}, true},
                                  {"follows", T::flag, "the faces as they turn (default yes)"}}});
  add({"Hold", "Blocks", "prescribed motion of blocks whose centres lie in its shapes; what is not given is free",
       T::none,
       motion + std::vector<AttributeSpec>{function("spinx", "rotation [rad/time], may be a function of t"),
                                           function("spiny", ""), function("spinz", "")}});
  add({"Load", "Blocks", "force and moment on each block whose centre lies in its shapes", T::none,
       std::vector<AttributeSpec>{function("Fx", "force, may be a function of t"), function("Fy", ""),
                                  function("Fz", ""), function("Mx", "moment, may be a function of t"),
                                  function("My", ""), function("Mz", "")}});

  // Conditions on the grid
  add({"GridBCs", "JANFEAInput", "conditions on grid nodes", T::none, {}, true});
  for (const auto* parent : {"GridBCs", "ParticleBCs"}) {
    const std::string_view in = parent;
    const bool grid = in == "GridBCs";
    add({grid ? "BCShape" : "LdShape", in, "nodes or particles in a shape"});
  }
  add({"BCLine", "GridBCs ParticleBCs", "nodes or particles near a line", T::none, ends()});
  add({"BCArc", "GridBCs ParticleBCs", "nodes or particles near the edge of an ellipse", T::none,
       box(false) + std::vector{number("start", "[degrees]"), number("end", "[degrees]"),
                                AttributeSpec{"tolerance", T::text, "distance, or *f cells"}}});
  add({"LdRect", "GridBCs ParticleBCs", "nodes or particles in a rectangle", T::none, box(false)});
  add({"BCBox", "GridBCs ParticleBCs", "nodes or particles in a box, or a cylinder in it", T::none,
       box(true) + std::vector{AttributeSpec{"axis", T::choice, "of the cylinder", "1 2 3 x y z"}}});
  add({"DisBC", "BCShape BCLine BCArc LdRect BCBox", "prescribed velocity", T::none,
       std::vector{AttributeSpec{"dir", T::choice, "1 x, 2 y, 3 z, or skewed", "1 2 3 12 13 23 123", true},
                   number("vel", "velocity"), number("disp", "the same"),
                   number("angle", "of a skewed direction, clockwise [degrees]"),
                   number("angle2", "second angle [degrees]"), units(velocities)} +
           condition_attributes()});

  add({"TempBC", "BCShape BCLine BCArc LdRect BCBox", "prescribed temperature", T::none,
       std::vector{number("value", "temperature")} + condition_attributes()});

  // Conditions on particles
  add({"ParticleBCs", "JANFEAInput", "loads on particles", T::none, {}, true});
  add({"net", "LdShape BCLine BCArc LdRect BCBox", "following loads are totals, divided among the particles found"});
  add({"perParticle", "LdShape BCLine BCArc LdRect BCBox", "following loads act on each particle"});
  add({"LoadBC", "LdShape BCLine BCArc LdRect BCBox", "force", T::none,
       std::vector{AttributeSpec{"dir", T::choice, "1 x, 2 y, 3 z", "1 2 3", true}, number("load", "force"),
                   number("value", "the same")} +
           condition_attributes()});
  add({"TractionBC", "LdShape BCLine BCArc LdRect BCBox", "traction on a face of the particles", T::none,
       std::vector{AttributeSpec{"dir", T::choice, "1 x, 2 y, 3 z, 11 normal, 12 shear (2D)", "1 2 3 11 12", true},
                   AttributeSpec{"face", T::choice, "2D: 1 bottom 2 right 3 top 4 left; 3D also 5, 6: low and high z",
                                 "1 2 3 4 5 6", true},
                   number("stress", "traction")} +
           condition_attributes()});

  add({"HeatFluxBC", "LdShape BCLine BCArc LdRect BCBox", "heat flux into the particles through a face", T::none,
       std::vector{AttributeSpec{"dir", T::choice, "1: the flux is given", "1"},
                   AttributeSpec{"face", T::choice, "2D: 1 bottom 2 right 3 top 4 left; 3D also 5, 6: low and high z",
                                 "1 2 3 4 5 6", true},
                   number("value", "power per area")} +
           condition_attributes()});

  // Heat
  add({"Thermal", "JANFEAInput", "temperature", T::none, {}, true});
  add({"EnergyCoupling", "Thermal", "what materials dissipate becomes heat", T::none, {}, true});
  add({"Conduction", "Thermal", "temperatures follow from conduction", T::none, {}, true});
  add({"ContactHeating", "Thermal", "the work of sliding contact becomes heat", T::none, {}, true});

  // Gravity
  add({"Gravity", "JANFEAInput", "body forces per mass", T::none, {}, true});
  for (const auto name : {"BodyXForce", "BodyYForce", "BodyZForce"})
    add({name, "Gravity", "constant acceleration", T::number, {}, true});
  for (const auto name : {"GridBodyXForce", "GridBodyYForce", "GridBodyZForce"})
    add({name, "Gravity", "acceleration of the nodes as a function of x, y, z, t", T::function, {}, true});
  for (const auto name : {"ParticleBodyXForce", "ParticleBodyYForce", "ParticleBodyZForce"})
    add({name,
         "Gravity",
         "acceleration of the particles as a function of t, x, y, z and of their places at the start x0, y0, z0",
         T::function,
         {},
         true});

  // Tasks
  add({"CustomTasks", "JANFEAInput", "further tasks", T::none, {}, true});
  add({"Schedule",
       "CustomTasks",
       "a task: PeriodicXPIC, AdjustTimeStep, VTKArchive",
       T::none,
       {text("name", "", true)}});
  add({"Parameter", "Schedule", "a setting of the task; the text is its value", T::text, {text("name", "", true)}});
  return e;
}

}  // namespace

const std::vector<ElementSpec>& dialect() {
  static const std::vector<ElementSpec> all = make();
  return all;
}

const std::vector<RefusedName>& refused_names() {
  static const std::vector<RefusedName> all{
      {"CrackContactHeating", "heat of cracks is not built"},
      {"CrackTipHeating", "heat of cracks is not built"},
      {"AltPropagate", "a second criterion for the growth of cracks is not built"},
      {"MovePlane", "cracks always move with the mean of their two faces"},
      {"ConcBC", "diffusion is not built"},
      {"Diffusion", "diffusion is not built"},
      {"Poroelasticity", "pore pressure is not built"},
      {"ConcFluxBC", "diffusion is not built"},
      {"Damage", "damage is not built"},
      {"DisplacementBCs", "conditions by node number depend on the numbering of another program; use BCShape"},
      {"LoadBCs", "loads by particle number depend on the numbering of another program; use LdShape"},
      {"AreaOfInterest", "grids with unequal cells are not built"},
      {"Border", "grids with unequal cells are not built"},
      {"Fill", "particle reservoirs are not built"},
      {"Shell", "its meaning in the dialect is not documented well enough; use a Cylinder with a Cylinder cut out"},
      {"Polyhedron", "use STL"},
      {"RestartScaling", "runs are resumed with 'tribo resume'"},
      {"DeleteLimit", "particles are never deleted; use LeaveLimit"},
      {"ExtrapolateRigid", "rigid particles always act through extrapolated velocities"},
      {"ExactTractions", "tractions act at the particles"},
      {"PatchGrid", "threads share blocks by themselves"},
      {"NodeList", "unstructured grids are not built"},
      {"ElementList", "unstructured grids are not built"},
      {"DevelFlag", "it switches experiments of another program"},
      {"XPIC", "use <Transfer> or the task PeriodicXPIC"},
      {"Isothermal", "it was withdrawn from the dialect"},
      {"ContactHeatFlow", "it was withdrawn from the dialect"},
      {"TrackParticleSpin", "it was withdrawn from the dialect"},
      {"TrackGradV", "it was withdrawn from the dialect"},
      {"TransportOnly", "it was withdrawn from the dialect"},
      {"ShiftCracks", "it was withdrawn from the dialect"},
      {"CrackParticleSize", "it was withdrawn from the dialect"},
      {"Lp0X", "it was withdrawn from the dialect"},
      {"Lp0Y", "it was withdrawn from the dialect"},
      {"Lp0Z", "it was withdrawn from the dialect"},
  };
  return all;
}

}  // namespace tribo
