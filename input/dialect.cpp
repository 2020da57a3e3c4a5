// SPDX-License-Identifier: MIT
#include "input/dialect.hpp"

#include "model/prescribed.hpp"
#include "model/shape_functions.hpp"

namespace tribo {
namespace {

using T = ValueType;

constexpr std::string_view times = "ms msec s sec us microsec", lengths = "m cm mm microns in ft",
                           velocities = "m/sec mm/msec mm/sec cm/sec in/sec ft/sec", masses = "kg g mg lbs oz",
                           velocities_and_lengths = "m/sec mm/msec mm/sec cm/sec in/sec ft/sec m cm mm microns in ft";

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
          text("matname", "name of the material, instead of mat"),
          number("angle", "rotation of the material axes about z [degrees]"),
          number("thick", "thickness (2D)"),
          number("vx", "initial velocity"),
          number("vy", "initial velocity"),
          number("vz", "initial velocity"),
          number("temp", "initial temperature"),
          number("size", "edge length of a particle domain, instead of a number of particles per cell")};
}

std::vector<AttributeSpec> condition_attributes() {
  return {{"style", T::choice, "how the value depends on time or on motion (default constant)", all_style_words()},
          number("time", "start time, or angular frequency of sine and cosine"),
          number("ftime", "the same as time"),
          function("function", "value for style function"),
          {"id", T::integer, "number <= 0 that identifies the condition in reaction histories"}};
}

std::vector<ElementSpec> make() {
  constexpr std::string_view shapes_in = "Body Hole BCShape LdShape Joint Platen Pressure Hold Load @shape";
  std::vector<ElementSpec> e;
  const auto add = [&](ElementSpec spec) { e.push_back(std::move(spec)); };

  add({"JANFEAInput", "", "a command file", T::none, {{"version", T::choice, "version of the format", "3"}}});

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
       {{"length", T::choice, "", "km m dm cm mm um microns nm L"},
        {"mass", T::choice, "", "kg g mg ug M"},
        {"time", T::choice, "", "s sec ms msec us T"}},
       true});
  add({"RandSeed", "Header", "accepted without effect: Tribo uses no random numbers here", T::integer, {}, true});

  // MPMHeader
  add({"MPMHeader", "JANFEAInput", "settings of the solver and of the output", T::none, {}, true, true});
  add({"MPMMethod",
       "MPMHeader",
       "stress update: 0 first (USF), 2 half at the start and half at the end of the step (USAVG), 3 last (USL)",
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
  add({"TimeStep", "MPMHeader", "largest time step", T::number, {units(times)}, true});
  add({"MaxTime", "MPMHeader", "end of the run", T::number, {units(times)}, true});
  add({"TimeFactor", "MPMHeader", "Courant number of the fastest wave, in cells per step", T::number, {}, true});
  add({"TransTimeFactor", "MPMHeader", "fraction of the largest stable time step of conduction", T::number, {}, true});
  add({"Timing",
       "MPMHeader",
       "time step, end of the run and Courant number in one element",
       T::none,
       {number("step", "largest time step"), number("max", "end of the run"), number("CFL", "Courant number"),
        number("TransCFL", "accepted without effect"), units(times)},
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
       "a further interval between particle files, from a later time on",
       T::none,
       {number("time", "interval", true),
        number("start", "time from which on it applies"),
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
       "a column of history.csv",
       T::none,
       {text("type", "name of the quantity", true), text("material", "number of a material, or id of a condition"),
        text("mat", "the same as material"), text("matname", "name of a material"),
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
  add({"MatlPtsPerElement",
       "MPMHeader Body",
       "number of particles per cell, a square number in 2D, a cube number in 3D",
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
       "gain of grid damping controlled by the kinetic energy",
       T::number,
       {function("target", "kinetic energy aimed at"), number("max", "largest damping")},
       true});
  add({"PFeedbackDamping",
       "MPMHeader",
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
       "number of particles that may leave the grid, and are put back, before the run stops",
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

  // Mesh
  add({"Mesh", "JANFEAInput", "the grid", T::none, {text("output", "accepted")}, true, true, false, {}, "Blocks"});
  add({"Grid",
       "Mesh",
       "extent of the grid",
       T::none,
       {number("xmin", "", true),
        number("xmax", "", true),
        number("ymin", "", true),
        number("ymax", "", true),
        number("zmin", ""),
        number("zmax", ""),
        number("thickness", "thickness of a plane model (default 1)"),
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
          {"ny", T::integer, "number of cells (Vert)"},
          {"nz", T::integer, "number of cells (Depth)"},
          number("cellsize",
                 "cell size, instead of a number; the upper edge is moved outward to a whole number of cells"),
          number("symmin", "symmetry plane at this coordinate"),
          number("symmax", "symmetry plane at this coordinate"),
          number("wallmin", "wall at this coordinate with boundary-modified shape functions (B-splines)"),
          number("wallmax", "wall at this coordinate with boundary-modified shape functions (B-splines)"),
          {"periodic", T::integer, "1: periodic; particles that leave at one edge enter at the opposite edge"},
          {"rx", T::number, "accepted for equal cells: 1"},
          {"style", T::text, "accepted for equal cells"},
          units(lengths)},
         true});

  // MaterialPoints
  add({"MaterialPoints", "JANFEAInput", "bodies and particles", T::none, {}, true, true, false, {}, "Blocks"});
  add({"Body", "MaterialPoints", "shapes filled with a material", T::none,
       body_attributes() + std::vector{units(velocities_and_lengths)}});
  add({"Hole", "MaterialPoints", "shapes without particles", T::none});
  for (const auto name : {"vel0X", "vel0Y", "vel0Z"})
    add({name, "Body", "initial velocity of the following shapes, a function of position (before Deform moves it)",
         T::function});
  for (const auto name : {"RotateX", "RotateY", "RotateZ"})
    add({name, "Body", "rotation of the material axes of the following shapes [degrees]", T::function});
  add({"Unrotate", "Body", "the material axes of the following shapes are those of the grid"});
  add({"Deform",
       "Body",
       "displaces and strains the following shapes before the start",
       T::none,
       {function("dX", "shift"), function("dY", "shift"), function("dZ", "shift"), function("F11", ""),
        function("F12", ""), function("F13", ""), function("F21", ""), function("F22", ""), function("F23", ""),
        function("F31", ""), function("F32", ""), function("F33", "")}});
  add({"Undeform", "Body", "no initial deformation of the following shapes"});
  add({"InitialStress",
       "Body",
       "initial Cauchy stress of the following shapes: the sum of functions of position, of values at points, and with "
       "K0 of the geostatic stress",
       T::none,
       {text("file", "table with columns x, y, z of points and xx, yy, zz, xy, yz, xz of the stress there"),
        number("K0", "adds the geostatic stress with this ratio of horizontal to vertical stress"), function("xx", ""),
        function("yy", ""), function("zz", ""), function("xy", ""), function("yz", ""), function("xz", "")}});
  add({"PointList", "MaterialPoints", "single particles"});
  add({"mp",
       "PointList",
       "a particle",
       T::none,
       {{"elem", T::integer, "accepted"},
        text("mat", "number of the material"),
        text("matname", "name of the material, instead of mat"),
        number("angle", "rotation of the material axes about z [degrees]"),
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
                                number("radius", "ratio of the end radii, -1 to 1; 0: a cone")});
  shape("Torus", "ring in a box",
        box(true) +
            std::vector{AttributeSpec{"axis", T::choice, "", "1 2 3 x y z", true},
                        number("radius", "half width of the cross-section of the ring; 0: circular cross-section")});
  shape("STL", "closed surface from a file",
        {text("file", "", true), number("scale", "factor (default 1)"), number("x", "shift"), number("y", "shift"),
         number("z", "shift")});
  add({"BMP",
       "MaterialPoints",
       "greyscale image (PNG or BMP) that assigns materials in a rectangle",
       T::none,
       {text("name", "file", true), number("width", "(default: one unit per pixel)"), number("height", ""),
        units(lengths)}});
  add({"Origin", "BMP", "lower left corner", T::none, {number("x", ""), number("y", ""), units(lengths)}, true});
  add({"Intensity",
       "BMP",
       "material of a range of grey values",
       T::none,
       {text("mat", "number of the material"),
        text("matname", "name of the material, instead of mat"),
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
       "drives a single law along a prescribed path, for 'tribo drive'; ignored by 'tribo run'",
       T::none,
       {text("material", "name of the material to drive"),
        text("contact", "name of the contact law to drive"),
        text("joint", "name of the joint law to drive"),
        {"test", T::choice, "a standard test, instead of <Path>",
         "simple_shear uniaxial_stress oedometer triaxial_compression triaxial_extension isotropic"},
        number("strain", "strain at the end of the test: shear, axial or, if isotropic, volumetric strain"),
        number("rate", "rate of that strain (default 1)"),
        {"steps", T::integer, "number of steps of the test (default 100)"},
        number("pressure", "confining pressure of a triaxial test"),
        number("angle", "rotation of the material axes about z [degrees]"),
        number("temp", "initial temperature (default that of StressFreeTemp)"),
        number("mass",
               "contact law: reduced mass per area of the faces (default 1); joint law: effective mass of its dashpots "
               "(default: mass of the block)"),
        number("gap", "initial gap between the faces (default 0)"),
        number("cell", "cell size passed to the contact law (default 1)"),
        number("area", "area of the joint (default 1)"),
        number("thickness", "thickness of a joint in two dimensions; if absent, the joint is three-dimensional"),
        number("distance", "distance between the centres of the two bodies of a joint"),
        number("block", "mass of body 2, which then moves by the forces on it"),
        number("spring-normal",
               "normal stiffness [force/length] of a loading machine; the path then moves the far end of its spring"),
        number("spring-shear", "shear stiffness [force/length] of the loading machine"),
        number("vn", "initial velocity of the block along n"),
        number("vss", "initial velocity of the block along s"),
        number("vst", "initial velocity of the block along t")},
       true});
  add({"InitialStress",
       "Drive",
       "stress at the start of the path",
       T::none,
       {number("xx", "normal stress"), number("yy", "normal stress"), number("zz", "normal stress"),
        number("xy", "shear stress"), number("yz", "shear stress"), number("xz", "shear stress")},
       true});
  add({"Path",
       "Drive",
       "rows of numbers separated by commas; the first line names the columns: dt, steps, and for a material Lxx .. "
       "Lzz "
       "(velocity gradient) and sxx .. sxz (prescribed stress); for a contact law vn, vt1, vt2 and N, St1, St2; for a "
       "joint law the increments per step dn, dss, dst, dtwist, dbs, dbt, or prescribed forces Fn, Fss, Fst, loads on "
       "a "
       "block Pn, Pss, Pst, and the force of the fictitious stress Ffn, Ffss, Ffst",
       T::text,
       {text("file", "file that contains the rows")},
       true});

  add({"Material",
       "JANFEAInput",
       "a material, contact law or joint law; its properties are child elements, see the lists of laws",
       T::none,
       {text("Type", "number or name", true), text("Name", "", true)},
       false,
       true});

  // Contact
  add({"MultiMaterialMode",
       "MPMHeader",
       "each material has its own velocity field; materials interact by contact laws",
       T::none,
       {{"Normals", T::choice,
         "method for contact normals (default margin): 0 larger gradient, 1 larger volume, 2 average gradient, 3 own "
         "gradient, 4 specified, 5 linear regression, 6 logistic regression, 7 largest margin",
         "0 1 2 3 4 5 6 7 maxgrad maxvol avggrad owngrad specify linreg logreg margin"},
        {"Separation", T::choice,
         "method for gaps (default: edges of the particle domains; with gradient normals: positions if ContactPosition "
         "is "
         "given, else displacements)",
         "edges positions displacements"},
        {"Impulses", T::choice,
         "where the contact conditions hold: at nodes is robust in any motion; at faces gives the correct stress in "
         "the cells next to the contact, without numerical damping, at a higher cost. Default: faces if a deformable "
         "body that touches another one at the start is at most three cells thick there or lies between rigid faces on "
         "opposite sides, else nodes",
         "nodes faces"},
        number("RigidBias", "weight of the volume gradient of a rigid body (default 1)"),
        number("Azimuth", "azimuth of a specified normal, from x [degrees]"),
        number("Polar", "polar angle of a specified normal, from z [degrees]"),
        text("Lumping", "obsolete, without effect: all pairs at a node are solved together"),
        text("Vmin", "obsolete, without effect"),
        text("Dcheck", "obsolete, without effect")},
       true});
  const std::vector<AttributeSpec> law{text("law", "number of the contact law"),
                                       text("lawname", "name of the contact law, instead of law"),
                                       number("Dn", "old form: normal stiffness of an interface"),
                                       number("Dnt", "normal stiffness in tension"),
                                       number("Dnc", "normal stiffness in compression"),
                                       number("Dt", "tangential stiffness")};
  add({"Friction", "MultiMaterialMode",
       "the default contact law; or in the old form a number: -10 or less IgnoreContact, negative stick, below 10 "
       "friction coefficient, else an interface (absent: frictionless)",
       T::number, law, true});
  add({"Friction", "Material",
       "law between this material and another: a contact law, or a joint law, which acts where their faces touch at "
       "the "
       "start",
       T::number,
       law + std::vector<AttributeSpec>{text("mat", "number of the other material"),
                                        text("matname", "name of the other material, instead of mat")}});
  add({"ContactPosition",
       "MultiMaterialMode",
       "for gaps from positions and normals from gradients: distance in cells at which bodies touch, or minus an "
       "exponent",
       T::number,
       {},
       true});
  add({"Cracks", "MPMHeader", "settings of all cracks", T::none, {}, true});
  add({"Friction", "Cracks",
       "default law between the faces of cracks, or a number as in MultiMaterialMode (absent: frictionless)", T::number,
       law, true});
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
  add({"CrackList", "JANFEAInput", "a crack: points and lines in this order, or surfaces in three dimensions", T::none,
       std::vector<AttributeSpec>{{"type", T::choice, "accepted", "fixed free"},
                                  text("law", "number of the contact or joint law between its faces"),
                                  text("lawname", "name of the law, instead of law"),
                                  number("friction", "old form: friction coefficient of the faces")}});
  add({"pt",
       "CrackList",
       "the next point of the line",
       T::none,
       {number("x", "", true), number("y", "", true), {"tip", T::integer, "as start_tip of Line"}, units(lengths)}});
  add({"Line", "CrackList", "segments along a line; joined to the preceding point if that differs from the start",
       T::none,
       std::vector<AttributeSpec>{{"xmin", T::coordinate, "start", {}, true},
                                  {"ymin", T::coordinate, "start", {}, true},
                                  {"xmax", T::coordinate, "end", {}, true},
                                  {"ymax", T::coordinate, "end", {}, true},
                                  {"resolution", T::integer, "number of pieces (default: two per cell)"},
                                  units(lengths)} +
           tips});
  add({"Circle", "CrackList", "segments along an arc of an ellipse", T::none,
       std::vector<AttributeSpec>{{"xmin", T::coordinate, "edge of the ellipse's box", {}, true},
                                  {"ymin", T::coordinate, "edge", {}, true},
                                  {"xmax", T::coordinate, "edge", {}, true},
                                  {"ymax", T::coordinate, "edge", {}, true},
                                  number("start_angle", "start of the arc, from x [degrees] (default 0)"),
                                  number("end_angle", "end of the arc [degrees] (default 360)"),
                                  {"resolution", T::integer, "number of pieces (default: two per cell)"},
                                  units(lengths)} +
           tips});
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
  add({"shareMatField",
       "Material",
       "number of the material whose velocity field this one shares",
       T::integer,
       {},
       true});

  // Blocks
  const std::vector<AttributeSpec> of_blocks{
      text("name", "name used by histories and messages"),
      text("matname", "with a grid: RigidContact material of the block, for contact with other materials"),
      text("mat", "number of that material, instead of matname"),
      number("rho", "density", true),
      number("vx", "initial velocity"),
      number("vy", ""),
      number("vz", ""),
      number("spinx", "initial angular velocity [rad/time]"),
      number("spiny", ""),
      number("spinz", "")};
  const std::vector<AttributeSpec> block_box{number("xmin", "edge", true), number("xmax", "", true),
                                             number("ymin", "", true),     number("ymax", "", true),
                                             number("zmin", ""),           number("zmax", "")};
  const AttributeSpec points{
      "points", T::choice,
      "one contact at the centre of a common face (default), or one at each of its corners with its "
      "share of the area, so that laws without moments resist relative rotation",
      "face corners"};
  add({"Blocks", "JANFEAInput",
       "rigid blocks with joint laws at their contacts, alone or together with bodies in a grid", T::none,
       std::vector<AttributeSpec>{
           text("lawname", "name of the joint law of contacts outside every <Joint>, and of the stiffness of platens"),
           text("law", "number of that joint law, instead of lawname"),
           text("touchname",
                "name of the joint law of contacts formed during the run; if absent, such a contact is an error"),
           points,
           number("thickness", "thickness of a plane model (default 1)"),
           number("damping",
                  "local damping: fraction of the unbalanced force that acts against the motion of each block; 0 "
                  "(default) "
                  "for dynamics, 0.7 for static equilibrium"),
           {"quasistatic", T::flag,
            "masses are scaled so that <TimeStep> is stable; time then has a meaning for prescribed motions only"},
           {"iterations", T::integer, "fixed-point iterations of the fictitious stress within a step (default 0)"},
           number("step", "fraction of the critical time step (default 0.8)")},
       true});
  add({"Voronoi", "Blocks",
       "blocks that fill a box: the Voronoi cells of nuclei given by <pt>s or a file, on a lattice, or at random",
       T::none,
       block_box +
           std::vector{
               text("file", "table with columns x, y, z of the nuclei"),
               number("hexagons", "nuclei of regular hexagons: distance between opposite sides (2D)"),
               number("cubes", "nuclei of cubes, in two dimensions squares: edge length"),
               number("octahedra", "nuclei of truncated octahedra: distance between opposite squares (3D)"),
               {"random", T::integer, "number of randomly placed nuclei"},
               {"seed", T::integer, "seed of the random numbers; each value gives another specimen (default 1)"},
               number("apart",
                      "smallest distance between two random nuclei, as a fraction of the edge length of the square or "
                      "cube "
                      "with the mean area or volume per nucleus: 0 to 0.8 (default 0.6)")} +
           of_blocks});
  add({"BoxBlock", "Blocks", "a rectangle or box as one block", T::none,
       block_box + std::vector{number("angle", "rotation about the z axis through the origin [degrees]")} + of_blocks});
  add({"PolygonBlock", "Blocks", "a convex polygon through <pt>s as one block", T::none,
       std::vector<AttributeSpec>{number("angle", "rotation about the z axis through the origin [degrees]")} +
           of_blocks});
  add({"Ball", "Blocks", "a ball (3D) or a disc (2D) as one block", T::none,
       std::vector<AttributeSpec>{number("x", "centre", true), number("y", "", true), number("z", ""),
                                  number("radius", "", true)} +
           of_blocks});
  add({"Joint", "Blocks",
       "joint law of the contacts whose centres lie in its shapes; the first <Joint> that contains a centre applies",
       T::none,
       std::vector<AttributeSpec>{text("lawname", "name of the joint law"),
                                  text("law", "number of the joint law, instead of lawname"), points}});
  const std::vector<AttributeSpec> motion{function("vx", "velocity, may be a function of t"), function("vy", ""),
                                          function("vz", "")};
  add({"Platen", "Blocks",
       "a stiff platen bonded to the free faces whose centres lie in its shapes, also in tension; velocity components "
       "that are not given are zero",
       T::none,
       std::vector<AttributeSpec>{text("name", "name used by histories"),
                                  {"rough", T::flag, "it also resists tangential motion of the faces"},
                                  number("E",
                                         "modulus of its springs of stiffness E A/d, d the distance from the block "
                                         "centre to the face (default: stiffness of the joint law of <Blocks>)")} +
           motion});
  add({"Pressure", "Blocks", "pressure on the free faces whose centres lie in its shapes", T::none,
       std::vector<AttributeSpec>{
           {"value", T::function, "pressure, may be a function of t", {}, true},
           {"follows", T::flag, "the pressure stays normal to the rotating faces (default yes)"}}});
  add({"Hold", "Blocks",
       "prescribed motion of blocks whose centres lie in its shapes; components that are not given are free", T::none,
       motion + std::vector<AttributeSpec>{function("spinx", "angular velocity [rad/time], may be a function of t"),
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
  add({"BCBox", "GridBCs ParticleBCs", "nodes or particles in a box, or with axis in the inscribed cylinder", T::none,
       box(true) + std::vector{AttributeSpec{"axis", T::choice, "axis of the cylinder", "1 2 3 x y z"}}});
  add({"DisBC", "BCShape BCLine BCArc LdRect BCBox", "prescribed velocity", T::none,
       std::vector{AttributeSpec{"dir", T::choice, "direction: 1 x, 2 y, 3 z, or inclined", "1 2 3 12 13 23 123", true},
                   number("vel", "velocity"), number("disp", "the same as vel"),
                   number("angle", "angle of an inclined direction, clockwise [degrees]"),
                   number("angle2", "second angle of an inclined direction [degrees]"), units(velocities)} +
           condition_attributes()});

  add({"TempBC", "BCShape BCLine BCArc LdRect BCBox", "prescribed temperature", T::none,
       std::vector{number("value", "temperature")} + condition_attributes()});

  // Conditions on particles
  add({"ParticleBCs", "JANFEAInput", "loads on particles", T::none, {}, true});
  add({"net", "LdShape BCLine BCArc LdRect BCBox",
       "the following loads are totals, divided among the particles found"});
  add({"perParticle", "LdShape BCLine BCArc LdRect BCBox", "the following loads act on each particle"});
  add({"LoadBC", "LdShape BCLine BCArc LdRect BCBox", "force", T::none,
       std::vector{AttributeSpec{"dir", T::choice, "1 x, 2 y, 3 z", "1 2 3", true}, number("load", "force"),
                   number("value", "the same as load")} +
           condition_attributes()});
  add({"TractionBC", "LdShape BCLine BCArc LdRect BCBox", "traction on a face of the particle domains", T::none,
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

  add({"HeatFluxBC", "LdShape BCLine BCArc LdRect BCBox",
       "heat flux into the particles through a face, positive if it heats them", T::none,
       std::vector{AttributeSpec{"dir", T::choice, "1: the flux is given", "1"},
                   AttributeSpec{"face", T::choice, "2D: 1 bottom 2 right 3 top 4 left; 3D also 5, 6: low and high z",
                                 "1 2 3 4 5 6", true},
                   number("value", "power per area")} +
           condition_attributes()});

  // Heat
  add({"Thermal", "JANFEAInput", "temperature", T::none, {}, true});
  add({"EnergyCoupling", "Thermal", "the work dissipated by the materials becomes heat", T::none, {}, true});
  add({"Conduction", "Thermal", "heat conduction on the grid", T::none, {}, true});
  add({"ContactHeating", "Thermal", "the work of friction becomes heat", T::none, {}, true});

  // Gravity
  add({"Gravity", "JANFEAInput", "body forces per unit mass", T::none, {}, true});
  for (const auto name : {"BodyXForce", "BodyYForce", "BodyZForce"})
    add({name, "Gravity", "constant acceleration", T::number, {}, true});
  for (const auto name : {"GridBodyXForce", "GridBodyYForce", "GridBodyZForce"})
    add({name, "Gravity", "acceleration of the nodes as a function of x, y, z, t", T::function, {}, true});
  for (const auto name : {"ParticleBodyXForce", "ParticleBodyYForce", "ParticleBodyZForce"})
    add({name,
         "Gravity",
         "acceleration of the particles as a function of t, x, y, z and of their initial positions x0, y0, z0",
         T::function,
         {},
         true});

  // Tasks
  add({"CustomTasks", "JANFEAInput", "additional tasks", T::none, {}, true});
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
      {"CrackContactHeating", "heat of cracks is not implemented"},
      {"CrackTipHeating", "heat of cracks is not implemented"},
      {"AltPropagate", "a second criterion for crack growth is not implemented"},
      {"MovePlane", "cracks always move with the mean of their two faces"},
      {"ConcBC", "diffusion is not implemented"},
      {"Diffusion", "diffusion is not implemented"},
      {"Poroelasticity", "pore pressure is not implemented"},
      {"ConcFluxBC", "diffusion is not implemented"},
      {"Damage", "damage is not implemented"},
      {"DisplacementBCs", "conditions by node number depend on the node numbering of NairnMPM; use BCShape"},
      {"LoadBCs", "loads by particle number depend on the particle numbering of NairnMPM; use LdShape"},
      {"AreaOfInterest", "grids with unequal cells are not implemented"},
      {"Border", "grids with unequal cells are not implemented"},
      {"Fill", "particle reservoirs are not implemented"},
      {"Shell", "its definition is not documented; use a Cylinder with a Cylinder cut out"},
      {"Polyhedron", "use <STL>"},
      {"RestartScaling", "runs are resumed with 'tribo resume'"},
      {"DeleteLimit", "particles are never deleted; use LeaveLimit"},
      {"ExtrapolateRigid", "rigid particles always act through extrapolated velocities"},
      {"ExactTractions", "tractions act at the particles"},
      {"PatchGrid", "the grid is divided among threads automatically"},
      {"NodeList", "unstructured grids are not implemented"},
      {"ElementList", "unstructured grids are not implemented"},
      {"DevelFlag", "it is a development switch of NairnMPM"},
      {"XPIC", "use <Transfer> or the task PeriodicXPIC"},
      {"Isothermal", "it is no longer part of the format"},
      {"ContactHeatFlow", "it is no longer part of the format"},
      {"TrackParticleSpin", "it is no longer part of the format"},
      {"TrackGradV", "it is no longer part of the format"},
      {"TransportOnly", "it is no longer part of the format"},
      {"ShiftCracks", "it is no longer part of the format"},
      {"CrackParticleSize", "it is no longer part of the format"},
      {"Lp0X", "it is no longer part of the format"},
      {"Lp0Y", "it is no longer part of the format"},
      {"Lp0Z", "it is no longer part of the format"},
  };
  return all;
}

}  // namespace tribo
