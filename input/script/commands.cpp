// SPDX-License-Identifier: MIT
#include "input/script/commands.hpp"

namespace tribo::script {
namespace {

const std::vector<CommandInfo>& written_commands() {
  static const std::vector<CommandInfo> all{
      {"Version", 1, 1, "number",
       "version of the format that the script needs, such as 3.2; a version newer than the program supports is an "
       "error"},
      {"Title", 1, 1, "text", "title of the run"},
      {"Name", 1, 1, "text", "name of the author, which is added to the description"},
      {"Comment", 1, 99, "text, ...", "a line that is added to the description"},
      {"Header", 0, 0, "lines up to EndHeader", "lines that are added to the description"},
      {"Analysis", 1, 2, "\"Plane Strain MPM\", \"Plane Stress MPM\", \"3D MPM\" or \"Axisymmetric MPM\"",
       "type of the analysis; it must precede all commands that depend on it"},
      {"Element", 1, 1, "\"4 Node Quadrilateral\" or \"8 Node Brick\"",
       "accepted without effect if it fits the analysis: cells are quadrilaterals, in three dimensions bricks"},
      {"ConsistentUnits", 0, 3, "length, mass, time",
       "units of all numbers, such as mm,g,ms. Without this command numbers are in mm, g and MPa, and times in ms"},
      {"MPMMethod", 1, 2, "order[, shape functions]",
       "order of the stress update, USF, USAVG or USL, and shape functions, such as uGIMP (default), lCPDI, Classic or "
       "B2SPLINE; in a script without this command they are linear. USAVG- and USL- do without a second extrapolation "
       "of the velocities to the grid; USAVG+ and USL+ are "
       "the same as USAVG and USL"},
      {"Transfer", 1, 2, "type[, order or fraction]",
       "how the velocities of the particles are updated from those of the nodes: FLIP, PIC or APIC; XPIC or FMPM, each "
       "with its order (default 2); or blend, with the fraction of FLIP (default 0.99)"},
      {"TimeStep", 1, 3, "step[, end[, Courant number]]",
       "largest time step, time at which the run ends, and Courant number (default 0.5)"},
      {"MaximumTime", 1, 1, "time", "time at which the run ends"},
      {"CFLFactor", 1, 2, "Courant number[, of conduction]",
       "Courant number, which is the number of cells that the fastest wave may travel in a step, and the time step as "
       "a fraction of the largest stable one of conduction; both in (0, 1], default 0.5"},
      {"ArchiveTime", 1, 3, "interval[, first time[, contact events]]",
       "time between particle files, and the time of the first one after the start. A further command gives another "
       "interval and the time from which on it holds. The last argument has no effect"},
      {"GlobalArchiveTime", 1, 1, "interval", "time between rows of history.csv"},
      {"Archive", 1, 4, "name[, interval[, first time[, contact events]]]",
       "the name has no effect, since results are written to the folder of the run. The other arguments are those of "
       "ArchiveTime"},
      {"ArchiveUnique", 1, 4, "name[, interval[, first time[, contact events]]]", "the same as Archive"},
      {"GlobalArchive", 1, 7, "quantity[, material or id | , x, y[, z] | , attribute, value, ...]",
       "a column of history.csv; 'tribo list' names all quantities. With a point the value is that of the particle "
       "that is nearest to it at the start. The attributes are those of the element of this name: block or platen with "
       "its name, or material and with for the force between two materials"},
      {"ToArchive", 1, 99, "field, ...", "fields of the particle files; 'tribo list' names all of them"},
      {"PtsPerElement", 1, 1, "number", "number of particles per cell along each axis, 1 to 5 (default 2)"},
      {"Damping", 1, 3, "rate or function[, 0]",
       "rate of grid damping [1/time], a number or a function of the time t. The second argument must be 0: a fraction "
       "of PIC is set by 'Transfer blend'"},
      {"PDamping", 1, 3, "rate or function[, 0]",
       "rate of particle damping [1/time], a number or a function of the time t; the second argument is as in Damping"},
      {"FeedbackDamping", 1, 3, "gain[, kinetic energy[, largest rate]]",
       "grid damping that is controlled so that the kinetic energy approaches the given value (default 0). The gain is "
       "that of the element of this name; the damping rate does not exceed the largest rate [1/time] (default 0: no "
       "limit)"},
      {"PFeedbackDamping", 1, 3, "gain[, kinetic energy[, largest rate]]",
       "particle damping that is controlled in the same way as by FeedbackDamping"},
      {"LeaveLimit", 1, 1, "number",
       "particles that leave the grid are put back at its edge; the run stops when this has happened more often than "
       "this number (0: 100000). If the number is negative, they are removed instead, and the run stops when more than "
       "its magnitude have left"},
      {"ExtrapolateRigid", 0, 1, "[yes or no]",
       "accepted without effect, since rigid particles always act through extrapolated velocities"},
      {"CPDIrcrit", 1, 1, "cells",
       "largest distance of a corner of a CPDI domain from its particle, in cells; in (0, 1], default 1"},
      {"StressFreeTemp", 1, 1, "temperature",
       "initial temperature of bodies whose temperature is not given, and reference temperature (default 0)"},
      {"Processors", 1, 1, "number", "accepted without effect; the option --threads sets the number of threads"},
      {"MultimaterialMPM", 0, 4, "[normals[, bias or azimuth[, polar]]]",
       "contact between materials, each of which has its own velocity field. The normals are found by maxgrad, maxvol, "
       "avggrad, owngrad, specify (with azimuth and polar angle), linreg or logreg (default: largest margin); bias is "
       "the weight of rigid bodies (default 1). See <MultiMaterialMode>"},
      {"MultimaterialMode", 0, 5, "unused, unused[, normals[, bias or azimuth[, polar]]]",
       "older form of MultimaterialMPM; the first two arguments have no effect"},
      {"ContactMM", 1, 1, "law",
       "default contact law between bodies of different materials: the id of a Material that is a contact law"},
      {"FrictionMM", 1, 1, "coefficient", "older form of ContactMM: Coulomb friction with this coefficient"},
      {"ImperfectInterfaceMM", 2, 3, "Dt, Dnt[, Dnc]", "older form of ContactMM with an interface"},
      {"ContactPosition", 1, 1, "cells",
       "distance of bodies in cells at which they touch, for gaps from positions with normals from gradients"},
      {"GridHoriz", 1, 4, "cells[, plane, side[, other plane]]",
       "number of cells along x, and coordinates of planes of symmetry: the first plane is at the lower side of the "
       "model if 'side' is negative (-1), otherwise at the upper side (1); the other plane is at the other side"},
      {"GridVert", 1, 4, "cells[, plane, side[, other plane]]",
       "number of cells along y; the other arguments are as in GridHoriz"},
      {"GridDepth", 1, 4, "cells[, plane, side[, other plane]]",
       "number of cells along z; the other arguments are as in GridHoriz"},
      {"GridEdge", 2, 3, "edge, kind[, coordinate]",
       "kind of an edge of the grid: xmin, xmax, ymin, ymax, zmin or zmax with wall or symmetry and the coordinate of "
       "a grid line, or the axis x, y or z with periodic. The velocity of the nodes of a wall must be prescribed in "
       "addition"},
      {"GridRect", 4, 6, "xmin, xmax, ymin, ymax[, zmin, zmax]", "coordinates of the edges of the grid"},
      {"GridThickness", 1, 1, "length", "thickness of plane models, > 0 (default 1)"},
      {"Gravity", 0, 3, "[ax[, ay[, az]]]",
       "acceleration of all bodies; each component is a number or a function of x, y, z and t. Without ay, the "
       "standard gravity acts downwards along y; ax and az are 0 if not given"},
      {"Conduction", 1, 5, "yes or no[, adiabatic or isothermal][, friction]",
       "whether heat is conducted. adiabatic: the work that materials dissipate becomes heat; isothermal (default): it "
       "does not; friction: the work of friction between materials becomes heat"},
      {"CustomTask", 1, 1, "name", "an additional task of the run; 'tribo list' names all tasks"},
      {"Parameter", 1, 2, "name[, value]", "a parameter of the preceding CustomTask, with its value"},
      {"XMLData", 0, 2, "[section[, material]], lines up to EndXMLData",
       "adds XML to a section of the file, such as MPMHeader, MaterialPoints, Gravity or Thermal. Without a section "
       "the XML consists of elements of the body or condition inside Region, Hole, GridBC or ParticleBC, and of whole "
       "sections elsewhere"},
      {"Entity", 2, 2, "name, value", "defines an XML entity for XMLData"},
      {"Material", 1, 3, "id, name, type; properties up to Done",
       "a material, contact law or joint law, with one property on each line; 'Contact law,material' gives the law of "
       "a pair of materials. In a stage only the id is given, followed by the properties that change"},
      {"When", 2, 4, "bond_break, effect | ratio, value, effect | above or below, history, value, effect",
       "a condition and its effect, Stop, Frame, Checkpoint or NextStage, which happens once when the condition is "
       "first fulfilled. The conditions are that a bond breaks, that the ratio of unbalanced to applied forces falls "
       "below a value, or that a column of history.csv is above or below a value. In a stage the condition is watched "
       "during this stage, elsewhere until the first stage begins"},
      {"Stage", 1, 3, "time[, name[, ratio]]; commands up to EndStage",
       "from this time on the run continues with the changes that the commands make. Settings change by Material, "
       "ContactMM, Gravity, GridBC, ParticleBC, Damping, PDamping, FeedbackDamping, PFeedbackDamping, TimeStep and "
       "CFLFactor, and those of blocks and platens by Blocks. Region and Hole place bodies; Excavate, Stress, Bond and "
       "Unbond act once. If a ratio is given, the stage ends once the ratio of unbalanced to applied forces is below "
       "it"},
      {"Excavate", 0, 1, "[material]; shapes up to EndExcavate",
       "in a stage: removes the particles whose centres lie in the shapes, or those of one material"},
      {"Stress", 2, 20, "component, function, ...[, material, id][, file, name][, add, yes]; shapes up to EndStress",
       "in a stage: sets the Cauchy stress of the particles in the shapes. Components are xx, yy, zz, xy, yz and xz "
       "with a function of x, y, z; material restricts it to one material, file names a table, and add,yes adds the "
       "values to the present stress"},
      {"Bond", 0, 12, "[criterion, value ...]; shapes up to EndBond",
       "in a stage: bonds the joints whose faces touch and that fulfil all criteria, which are the shapes, lawname, "
       "dip and dipdirection, and in models of blocks also blocks, with and kind"},
      {"Unbond", 0, 12, "[criterion, value ...]; shapes up to EndUnbond",
       "in a stage: breaks the bonds of joints, which are selected as by Bond"},
      {"Region", 3, 40, "material, vx, vy[, thickness or vz[, attribute, value ...]]; shapes up to EndRegion",
       "a body with its initial velocity: shapes that are filled with particles of a material. In two dimensions the "
       "fourth argument is the thickness, in three dimensions vz; further attributes are those of the element <Body>"},
      {"ParticleTable", 2, 24, "material, file[, attribute, value ...]",
       "a body that is given by a table of its particles; the attributes are those of the element of this name"},
      {"Hole", 0, 0, "shapes up to EndHole", "shapes in which the bodies after it have no particles"},
      {"BMPRegion", 2, 4, "file, width[, height]; up to EndRegion",
       "a rectangle that a greyscale image (PNG or BMP) fills with bodies. Width and height are those of the rectangle "
       "(default of the height: one unit of length per pixel); Origin and Intensity belong into it"},
      {"Intensity", 3, 10, "material, low, high[, attribute, value ...]",
       "material of a range of grey values, from 0 (black) to 255 (white); the attributes are those of the element of "
       "this name"},
      {"Origin", 2, 2, "x, y", "lower left corner of the image (default 0, 0)"},
      {"Transform", 5, 9, "angle, Tx, Ty, Ox, Oy",
       "rotates the shapes after it by an angle [degrees] about the point (Ox, Oy) and displaces them by (Tx, Ty); the "
       "arguments after Oy are refused"},
      {"Rotate", 2, 6, "axis, angle, ...",
       "rotates the material axes of the shapes after it; pairs of an axis, x, y or z, and an angle [degrees]. "
       "Rotations about x and y have no effect on isotropic materials and are refused for others"},
      {"vel0X", 1, 1, "function", "initial velocity of the shapes after it along x, a function of the position"},
      {"vel0Y", 1, 1, "function", "initial velocity of the shapes after it along y, a function of the position"},
      {"vel0Z", 1, 1, "function", "initial velocity of the shapes after it along z, a function of the position"},
      {"InitialStress", 2, 20, "component, function, ...",
       "initial Cauchy stress of the shapes after it, the sum of what is given: xx, yy, zz, xy, yz and xz, each with a "
       "function of the position; K0 with the ratio of horizontal to vertical stress adds the geostatic stress; file "
       "with the name of a table adds its values"},
      {"Rect", 4, 6, "xmin, xmax, ymin, ymax[, zmin, zmax]",
       "rectangle, in three dimensions a box. A shape with the word Cut before it is cut out of the preceding shape"},
      {"Oval", 4, 6, "xmin, xmax, ymin, ymax[, zmin, zmax]",
       "ellipse that touches these edges, in three dimensions an ellipsoid"},
      {"Line", 4, 7, "x1, x2, y1, y2[, z1, z2][, tolerance]",
       "all points whose distance from a line is at most the tolerance, which is a length or *f for f cells (default "
       "*0.1); for conditions"},
      {"Arc", 6, 7, "xmin, xmax, ymin, ymax, start, end[, tolerance]",
       "all points near an arc of the ellipse that touches these edges, between two polar angles [degrees]; the "
       "tolerance is as in Line; for conditions"},
      {"Box", 6, 6, "xmin, xmax, ymin, ymax, zmin, zmax", "box"},
      {"Sphere", 6, 6, "xmin, xmax, ymin, ymax, zmin, zmax", "ellipsoid that touches the faces of this box"},
      {"Cylinder", 7, 8, "xmin, xmax, ymin, ymax, zmin, zmax, axis[, radius]",
       "elliptic cylinder in this box along axis 1 (x), 2 (y) or 3 (z), or a cone with a radius between -1 and 1, "
       "which is explained at the element <Cylinder>"},
      {"Torus", 7, 8, "xmin, xmax, ymin, ymax, zmin, zmax, axis[, radius]",
       "torus in this box about axis 1 (x), 2 (y) or 3 (z); the radius is the half width of its cross-section, 0 "
       "(default) for a circle"},
      {"Surface", 1, 6, "file[, scale, x, y, z[, group]]",
       "body that is enclosed by the closed surface of an STL, OBJ or PLY file or of a mesh of Gmsh (.msh), in two "
       "dimensions by the outline of a plane mesh of Gmsh. scale (default 1) is a factor of the coordinates, x, y, z "
       "are displacements (default 0), and group is a physical group of the mesh"},
      {"Terrain", 2, 10, "file, bottom[, scale, x, y, z][, width, depth, low, high]",
       "body below the heights of an ESRI ASCII grid or of a picture. bottom is a height, or the file of the lower "
       "surface; scale is a factor of the coordinates and x, y, z are displacements. A picture needs its extents width "
       "(along x) and depth (along y) and the height of white, high; low is the height of black (default 0)"},
      {"PolyPt", 0, 3, "x, y[, z]",
       "corner of a polygon or of the PolygonBlock before it, or nucleus of the Voronoi before it, in three dimensions "
       "with z. Without numbers it ends the polygon"},
      {"NewCrack", 2, 5, "x, y[, end[, law[, traction law]]]",
       "starts a crack at a point. end: the material around the crack tip at this point, exterior (the crack extends "
       "through the surface), free (no tip), or fixed (the line of the crack does not move). law: a contact or joint "
       "law between the faces, or a friction coefficient"},
      {"GrowCrack", 2, 4, "x, y[, end[, traction law]]",
       "continues the last crack by a segment to a point; 'end' is as in NewCrack"},
      {"GrowCrackLine", 2, 5, "x, y[, segments[, material or exterior[, traction law]]]",
       "continues the last crack to a point by several segments (default: two per cell)"},
      {"GrowCrackArc", 7, 9, "xmin, ymin, xmax, ymax, segments, start, end[, material or exterior[, traction law]]",
       "continues the last crack by segments along an arc of the ellipse in a box, between two angles [degrees]"},
      {"ContactCracks", 1, 1, "law",
       "default law between the two faces of each crack: the id of a Material that is a contact or joint law. The law "
       "between "
       "bodies is that of ContactMM"},
      {"ContactPositionCracks", 1, 1, "cells",
       "accepted without effect, since gaps of cracks follow from the displacements of their faces"},
      {"Friction", 1, 2, "coefficient, stick, ignore or none[, material]",
       "older form of ContactCracks. Inside Material, with the other material as last argument, it is an older form of "
       "the line 'Contact'"},
      {"ImperfectInterface", 2, 4, "Dt, Dnt[, Dnc[, material]]",
       "older form of ContactCracks with an imperfect interface of these stiffnesses. Inside Material, with the other "
       "material as last argument, it is an older form of the line 'Contact'"},
      {"CrackInterface", 2, 3, "Dt, Dnt[, Dnc]",
       "older form: the law of the last crack is an imperfect interface with these stiffnesses [stress/length]"},
      {"CrackTractionProp", 1, 1, "traction law", "traction law of the parts of the last crack that have none"},
      {"CrackThickness", 1, 1, "length",
       "accepted if it is the thickness of the grid, which is also that of all cracks"},
      {"MovePlane", 1, 2, "avg[, no]",
       "accepted without effect, since the line of a crack moves with the mean of its two faces"},
      {"Propagate", 1, 3, "criterion[, direction]",
       "criterion of crack growth: none, max energy release, energy density, elliptical or critical err; direction of "
       "growth: default, self similar, cod normal, cod hoop or initial. Inside Material it holds for cracks in that "
       "material"},
      {"PropagateLength", 1, 1, "cells",
       "length by which a crack tip advances at once, in cells; in (0, 2], default 0.5"},
      {"JContour", 1, 2, "cells[, terms]",
       "writes the energy release rate and the stress intensity factors of crack tips to tips.csv, for a contour of "
       "this radius in cells (1 to 20); terms: 1 without the inertia term, 2 (default) with it"},
      {"MoveLine", 4, 5, "x1, y1, x2, y2[, tolerance]; conditions up to EndMoveLine", "older form of GridBC with Line"},
      {"MoveArc", 6, 7, "x1, y1, x2, y2, start, end[, tolerance]; conditions up to EndMoveArc",
       "older form of GridBC with Arc"},
      {"MoveBox", 6, 7, "x1, y1, z1, x2, y2, z2[, axis]; conditions up to EndMoveBox",
       "older form of GridBC with Box, or with an axis with Cylinder"},
      {"LoadLine", 4, 5, "x1, y1, x2, y2[, tolerance]; loads up to EndLoadLine", "older form of ParticleBC with Line"},
      {"LoadArc", 6, 7, "x1, y1, x2, y2, start, end[, tolerance]; loads up to EndLoadArc",
       "older form of ParticleBC with Arc"},
      {"LoadRect", 4, 4, "xmin, xmax, ymin, ymax; loads up to EndLoadRect", "older form of ParticleBC with Rect"},
      {"LoadBox", 6, 7, "x1, y1, z1, x2, y2, z2[, axis]; loads up to EndLoadBox",
       "older form of ParticleBC with Box, or with an axis with Cylinder"},
      {"GridBC", 0, 1, "[add;] shape, conditions up to EndGridBC",
       "conditions on the nodes in a shape. In a stage they replace all former conditions on nodes; with add the "
       "former ones stay"},
      {"ParticleBC", 0, 1, "[add;] shape, conditions up to EndParticleBC",
       "loads on the particles in a shape; add is as in GridBC"},
      {"Velocity", 2, 7, "direction, style[, value[, time[, angle[, angle]]]]",
       "prescribed velocity along a direction, with the style constant, linear, sine, cosine or function (default of "
       "the value: 0). The arguments of a moving wall are: direction, gradient, velocity function, 0, depth[, gradient "
       "function or mirror[, displacement function]]"},
      {"Temperature", 1, 3, "style[, value[, time]]", "prescribed temperature, with a style as in Velocity"},
      {"Load", 2, 5, "direction, style[, value[, time]]",
       "force on each particle, with a style as in Velocity. Inside Blocks: attribute, value, ... of the element of "
       "this name give the force and moment on each block in the shapes after it"},
      {"LoadType", 1, 1, "net or perParticle",
       "net: the forces after it are totals, which are divided among the particles; perParticle (default): they act on "
       "each particle"},
      {"Traction", 3, 6, "direction, face, style[, value[, time[, function]]]",
       "traction on a face of the particle domains, with the direction x, y, z, normal or shear; the face is 1 bottom, "
       "2 right, 3 top, 4 left, in three dimensions also 5 at low z and 6 at high z. With the style function the "
       "function takes the place of the value or is the last argument"},
      {"HeatFlux", 3, 5, "external, face, style[, value[, time]]",
       "heat flux per area into the particles through a face of their domains, with face and style as in Traction"},
      {"BoundaryID", 0, 1, "[id]",
       "id by which histories of reactions refer to the conditions after it: 0 or a negative number"},
      {"Done", 0, 0, "", "ends Material"},
      {"EndRegion", 0, 0, "", "ends Region and BMPRegion"},
      {"EndHole", 0, 0, "", "ends Hole"},
      {"EndStage", 0, 0, "", "ends Stage"},
      {"EndExcavate", 0, 0, "", "ends Excavate"},
      {"EndStress", 0, 0, "", "ends Stress"},
      {"EndBond", 0, 0, "", "ends Bond"},
      {"EndUnbond", 0, 0, "", "ends Unbond"},
      {"EndGridBC", 0, 0, "", "ends GridBC"},
      {"EndParticleBC", 0, 0, "", "ends ParticleBC"},
      {"EndMoveLine", 0, 0, "", "ends MoveLine"},
      {"EndMoveArc", 0, 0, "", "ends MoveArc"},
      {"EndMoveBox", 0, 0, "", "ends MoveBox"},
      {"EndLoadLine", 0, 0, "", "ends LoadLine"},
      {"EndLoadArc", 0, 0, "", "ends LoadArc"},
      {"EndLoadRect", 0, 0, "", "ends LoadRect"},
      {"EndLoadBox", 0, 0, "", "ends LoadBox"},
      {"Blocks", 0, 99, "[attribute, value, ...]; lines up to EndBlocks",
       "rigid blocks; the attributes are those of the element of this name. Each line in it begins with the name of an "
       "element of <Blocks>, followed by pairs of an attribute and its value; PolyPt and shapes belong to the line "
       "before them. In a stage only attributes that change are given, and lines Platen with the changes of a platen"},
      {"EndBlocks", 0, 0, "", "ends Blocks"},
  };
  return all;
}

}  // namespace

const std::vector<CommandInfo>& commands() {
  static const std::vector<CommandInfo> all = [] {
    std::vector<CommandInfo> out = written_commands();
    for (const CommandInfo& line : lines_of_blocks())
      if (line.name != "Load") out.push_back(line);  // a command outside of Blocks, too
    return out;
  }();
  return all;
}

const std::vector<CommandInfo>& language() {
  static const std::vector<CommandInfo> all{
      {"If", 0, 99, "condition ... Else If, IfStr, IfNum, IfDef, IfNDef ... Else ... EndIf",
       "executes the lines after it if the condition is true. Comparisons are = == != > >= < <=, which && and || "
       "combine"},
      {"Repeat", 0, 99, "[variable, first, last[, step]] ... EndRepeat",
       "repeats the lines up to EndRepeat, with the variable from the first to the last value (default of the step: "
       "1); break, breakAll and continue act as in other languages"},
      {"Sub", 0, 99, "name, parameter, ... EndSub", "defines a subroutine, which 'return' leaves early"},
      {"GoSub", 0, 99, "name, value, ...", "calls a subroutine with the values of its parameters"},
      {"Write", 0, 99, "text, ...", "writes the text to the terminal"},
      {"WriteLine", 0, 99, "text, ...", "writes the text and a line break to the terminal"},
      {"Clear", 0, 99, "", "discards the text written so far"},
      {"Stop", 0, 99, "text, ...", "ends the script with this error message"},
      {"Lines", 0, 99, "variable, first, last, text",
       "stores the lines of a text in the elements of an array, from the first to the last index"},
      {"Words", 0, 99, "variable, first, last, text[, separators]",
       "stores the words of a text in the elements of an array, from the first to the last index"},
  };
  return all;
}

}  // namespace tribo::script
