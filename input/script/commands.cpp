// SPDX-License-Identifier: MIT
#include "input/script/commands.hpp"

namespace tribo::script {
namespace {

const std::vector<CommandInfo>& written_commands() {
  static const std::vector<CommandInfo> all{
      {"Version", 1, 1, "number",
       "version of the format that the script needs, such as 3.2; a newer one than the program reads is an error"},
      {"Title", 1, 1, "text", "title of the run"},
      {"Name", 1, 1, "text", "author; added to the description"},
      {"Comment", 1, 99, "text, ...", "a line of the description"},
      {"Header", 0, 0, "lines up to EndHeader", "lines of the description"},
      {"Analysis", 1, 2, "\"Plane Strain MPM\", \"Plane Stress MPM\", \"3D MPM\" or \"Axisymmetric MPM\"",
       "type of analysis; must precede all commands that depend on it"},
      {"Element", 1, 1, "\"4 Node Quadrilateral\" or \"8 Node Brick\"", "accepted: cells are quadrilaterals or bricks"},
      {"ConsistentUnits", 0, 3, "length, mass, time",
       "all numbers are in these units, e.g. mm,g,ms; without this command: mm, g, MPa, and ms for times"},
      {"MPMMethod", 1, 2, "order[, shape functions]",
       "USF, USAVG or USL, the last two with + or -; uGIMP (default), lCPDI, Classic, B2SPLINE"},
      {"Transfer", 1, 2, "type[, order or fraction]",
       "FLIP, PIC, APIC, XPIC or FMPM with their order, blend with the fraction of FLIP"},
      {"TimeStep", 1, 3, "step[, end[, Courant number]]", "largest time step, end of the run"},
      {"MaximumTime", 1, 1, "time", "end of the run"},
      {"CFLFactor", 1, 2, "Courant number[, of conduction]", "time step as a fraction of the stable one"},
      {"ArchiveTime", 1, 3, "interval[, first time[, contact events]]",
       "time between particle files; repeated, with the time from which on the further interval applies"},
      {"GlobalArchiveTime", 1, 1, "interval", "time between rows of history.csv"},
      {"Archive", 1, 4, "name[, interval[, first time[, contact events]]]",
       "the name has no effect, since results are written to the folder of the run; the other arguments are those of "
       "ArchiveTime"},
      {"ArchiveUnique", 1, 4, "name[, interval[, first time[, contact events]]]", "the same as Archive"},
      {"GlobalArchive", 1, 7, "quantity[, material or id | , x, y[, z] | , attribute, value, ...]",
       "column of history.csv ('tribo list' names all quantities); with a point: value of the particle initially "
       "nearest to it; attributes are those of "
       "the "
       "element of this name: block or platen and its name, material and with for the forces between two materials"},
      {"ToArchive", 1, 99, "field, ...", "fields of the particle files; 'tribo list' names all of them"},
      {"PtsPerElement", 1, 1, "number", "particles per cell along an axis"},
      {"Damping", 1, 3, "rate or function[, 0]",
       "grid damping; a fraction of PIC, the second argument, is set by Transfer"},
      {"PDamping", 1, 3, "rate or function[, 0]", "particle damping"},
      {"FeedbackDamping", 1, 3, "gain[, kinetic energy[, largest rate]]",
       "grid damping, controlled so that the kinetic energy approaches the given value"},
      {"PFeedbackDamping", 1, 3, "gain[, kinetic energy[, largest rate]]",
       "particle damping, controlled in the same way"},
      {"LeaveLimit", 1, 1, "number",
       "number of particles that may leave the grid, and are put back, before the run stops; negative: this many may "
       "leave and are removed"},
      {"ExtrapolateRigid", 0, 1, "[yes or no]",
       "accepted without effect: rigid particles always act through extrapolated velocities"},
      {"CPDIrcrit", 1, 1, "cells", "largest distance of a CPDI corner from the particle"},
      {"StressFreeTemp", 1, 1, "temperature", "initial and reference temperature"},
      {"Processors", 1, 1, "number", "accepted without effect; --threads sets the number of threads"},
      {"MultimaterialMPM", 0, 4, "[normals[, bias or azimuth[, polar]]]",
       "contact between materials; normals maxgrad, maxvol, avggrad, owngrad, specify, linreg or logreg"},
      {"MultimaterialMode", 0, 5, "unused, unused[, normals[, bias or azimuth[, polar]]]",
       "older form of MultimaterialMPM"},
      {"ContactMM", 1, 1, "law",
       "default contact law between bodies of different materials: the id of a Material that is one"},
      {"FrictionMM", 1, 1, "coefficient", "older form of ContactMM: Coulomb friction with this coefficient"},
      {"ImperfectInterfaceMM", 2, 3, "Dt, Dnt[, Dnc]", "older form of ContactMM with an interface"},
      {"ContactPosition", 1, 1, "cells", "distance at which bodies touch, for gradient normals"},
      {"GridHoriz", 1, 4, "cells[, plane, side[, other plane]]", "cells along x; symmetry planes, side -1 low, 1 high"},
      {"GridVert", 1, 4, "cells[, plane, side[, other plane]]", "cells along y"},
      {"GridDepth", 1, 4, "cells[, plane, side[, other plane]]", "cells along z"},
      {"GridEdge", 2, 3, "edge, kind[, coordinate]",
       "xmin, xmax, ymin, ymax, zmin or zmax with wall or symmetry and its coordinate; or x, y or z with periodic"},
      {"GridRect", 4, 6, "xmin, xmax, ymin, ymax[, zmin, zmax]", "edges of the grid"},
      {"GridThickness", 1, 1, "length", "thickness of plane models"},
      {"Gravity", 0, 3, "[ax[, ay[, az]]]",
       "acceleration of all bodies, numbers or functions of x, y, z, t; along y the standard gravity, downwards, "
       "unless "
       "it is given"},
      {"Conduction", 1, 5, "yes or no[, adiabatic or isothermal][, friction]",
       "heat conduction; adiabatic: dissipated work becomes heat; friction: the work of friction becomes heat"},
      {"CustomTask", 1, 1, "name", "additional task of the run"},
      {"Parameter", 1, 2, "name[, value]", "parameter of the preceding CustomTask"},
      {"XMLData", 0, 2, "[section[, material]], lines up to EndXMLData",
       "XML for a section of the file, e.g. MPMHeader, MaterialPoints, Gravity, Thermal; without a section inside "
       "Region, Hole, GridBC or ParticleBC: elements of that body or condition, elsewhere whole sections"},
      {"Entity", 2, 2, "name, value", "defines an XML entity for XMLData"},
      {"Material", 1, 3, "id, name, type; properties up to Done",
       "material, contact law or joint law; one property per line, and Contact law,material. In a stage: id; the "
       "properties that change"},
      {"When", 2, 4, "bond_break, effect | ratio, value, effect | above or below, history, value, effect",
       "what is done once when something happens until the next stage: Stop, Frame, Checkpoint or NextStage"},
      {"Stage", 1, 3, "time[, name[, ratio]]; commands up to EndStage",
       "from this time on the run continues with what the commands change: Material, ContactMM, Gravity, GridBC, "
       "ParticleBC, Damping, PDamping, FeedbackDamping, PFeedbackDamping, TimeStep, CFLFactor; Blocks changes settings "
       "and platens; Region and Hole place bodies, Excavate, Stress, Bond and Unbond act once. With a ratio the stage "
       "ends "
       "once the ratio of unbalanced to applied forces is below it"},
      {"Excavate", 0, 1, "[material]; shapes up to EndExcavate", "in a stage: removes the particles in the shapes"},
      {"Stress", 2, 20, "component, function, ...[, material, id][, file, name][, add, yes]; shapes up to EndStress",
       "in a stage: sets the stress of the particles in the shapes"},
      {"Bond", 0, 12, "[criterion, value ...]; shapes up to EndBond",
       "in a stage: bonds joints whose faces touch; criteria "
       "are the shapes, lawname, dip, dipdirection"},
      {"Unbond", 0, 12, "[criterion, value ...]; shapes up to EndUnbond",
       "in a stage: breaks the bonds of joints, chosen as by Bond"},
      {"Region", 3, 40, "material, vx, vy[, thickness or vz[, attribute, value ...]]; shapes up to EndRegion", "body"},
      {"ParticleTable", 2, 24, "material, file[, attribute, value ...]",
       "body that is given by a table of its particles; the attributes are those of the element of this name"},
      {"Hole", 0, 0, "shapes up to EndHole", "shapes without particles of the following bodies"},
      {"BMPRegion", 2, 4, "file, width[, height]; up to EndRegion", "bodies from a greyscale image"},
      {"Intensity", 3, 10, "material, low, high[, attribute, value ...]", "range of grey values of a material"},
      {"Origin", 2, 2, "x, y", "lower left corner of the image"},
      {"Transform", 5, 9, "angle, Tx, Ty, Ox, Oy[, angle y, angle z, Tz, Oz]",
       "rotates and displaces the following shapes"},
      {"Rotate", 2, 6, "axis, angle, ...", "rotates the material axes of the following shapes"},
      {"vel0X", 1, 1, "function", "initial velocity of the following shapes, x component"},
      {"vel0Y", 1, 1, "function", "y component"},
      {"vel0Z", 1, 1, "function", "z component"},
      {"InitialStress", 2, 20, "component, function, ...",
       "initial stress of the following shapes: pairs of xx, yy, zz, xy, yz, xz and a function of position; K0 and a "
       "number: geostatic stress; file and a name: a table"},
      {"Rect", 4, 6, "xmin, xmax, ymin, ymax[, zmin, zmax]",
       "rectangle or box; after the word Cut any shape is cut out of the preceding one"},
      {"Oval", 4, 6, "xmin, xmax, ymin, ymax[, zmin, zmax]", "ellipse or ellipsoid"},
      {"Line", 4, 7, "x1, x2, y1, y2[, z1, z2][, tolerance]", "segment, for conditions"},
      {"Arc", 6, 7, "xmin, xmax, ymin, ymax, start, end[, tolerance]", "part of an ellipse's edge, for conditions"},
      {"Box", 6, 6, "xmin, xmax, ymin, ymax, zmin, zmax", "box"},
      {"Sphere", 6, 6, "xmin, xmax, ymin, ymax, zmin, zmax", "ellipsoid"},
      {"Cylinder", 7, 8, "xmin, xmax, ymin, ymax, zmin, zmax, axis[, radius]",
       "cylinder, or cone with a radius from -1 to 1"},
      {"Torus", 7, 8, "xmin, xmax, ymin, ymax, zmin, zmax, axis[, radius]", "torus"},
      {"Surface", 1, 6, "file[, scale, x, y, z[, group]]",
       "body with the closed surface of an STL, OBJ or PLY file or of a physical group of a mesh of Gmsh (.msh); in "
       "two "
       "dimensions with the outline of a plane mesh of Gmsh"},
      {"Terrain", 2, 10, "file, bottom[, scale, x, y, z][, width, depth, low, high]",
       "body below the heights of an ESRI ASCII grid or of a picture; bottom: a height, or the file of the lower "
       "surface"},
      {"PolyPt", 0, 3, "x, y[, z]",
       "corner of a polygon, of the PolygonBlock before it, or a nucleus of the Voronoi before it, which may have z; "
       "without numbers the polygon ends"},
      {"NewCrack", 2, 5, "x, y[, end[, law[, traction law]]]",
       "starts a crack at a point; end: the material around a tip, exterior (extended through the surface), free (no "
       "tip) or fixed; law: a contact or joint law of the faces, or a friction coefficient"},
      {"GrowCrack", 2, 4, "x, y[, end[, traction law]]", "continues the crack to a point; end as in NewCrack"},
      {"GrowCrackLine", 2, 5, "x, y[, segments[, material or exterior[, traction law]]]",
       "continues the crack to a point, in several segments"},
      {"GrowCrackArc", 7, 9, "xmin, ymin, xmax, ymax, segments, start, end[, material or exterior[, traction law]]",
       "continues the crack along an arc of an ellipse"},
      {"ContactCracks", 1, 1, "law",
       "default law between the two faces of each crack: the id of a Material that is a contact or joint law; between "
       "bodies, see ContactMM"},
      {"ContactPositionCracks", 1, 1, "cells",
       "accepted without effect: gaps of cracks follow from the displacements of their faces"},
      {"Friction", 1, 2, "coefficient, stick, ignore or none[, material]",
       "older form of ContactCracks; inside Material, with the other material, of Contact"},
      {"ImperfectInterface", 2, 4, "Dt, Dnt[, Dnc[, material]]",
       "older form of ContactCracks with an interface; inside Material, with the other material, of Contact"},
      {"CrackInterface", 2, 3, "Dt, Dnt[, Dnc]", "older form of the law of the last crack: an interface"},
      {"CrackTractionProp", 1, 1, "traction law", "traction law of the parts of the last crack that have none"},
      {"CrackThickness", 1, 1, "length", "accepted if it is the thickness of the grid, which cracks have"},
      {"MovePlane", 1, 2, "avg[, no]", "accepted: a crack moves with the mean of its two faces"},
      {"Propagate", 1, 3, "criterion[, direction]",
       "criterion of crack growth: max energy release, energy density, elliptical or critical err; direction: default, "
       "self similar, cod normal, cod hoop or initial. Inside Material for cracks in that material"},
      {"PropagateLength", 1, 1, "cells", "length by which a tip grows at once"},
      {"JContour", 1, 2, "cells[, terms]",
       "energy release rate and stress intensity factors of crack tips, for a contour of this radius"},
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
       "conditions on nodes in a shape. Those of a stage replace the former ones; with add these stay"},
      {"ParticleBC", 0, 1, "[add;] shape, conditions up to EndParticleBC",
       "conditions on particles in a shape; add as in GridBC"},
      {"Velocity", 2, 7, "direction, style[, value[, time[, angle[, angle]]]]",
       "prescribed velocity: constant, linear, sine, cosine or function; 0 without a value. A moving wall: direction, "
       "gradient, velocity function, 0, depth[, gradient function or mirror[, displacement function]]"},
      {"Temperature", 1, 3, "style[, value[, time]]", "prescribed temperature"},
      {"Load", 2, 5, "direction, style[, value[, time]]",
       "force on each particle. Inside Blocks: attribute, value, ... of the element of this name, force and moment on "
       "each block in the shapes after it"},
      {"LoadType", 1, 1, "net or perParticle",
       "whether a force is divided among the particles or acts on each of them"},
      {"Traction", 3, 6, "direction, face, style[, value[, time[, function]]]",
       "traction on faces of particles; direction x, y, z, normal or shear; face 1 bottom, 2 right, 3 top, 4 left, in "
       "space 5 and 6 low and high z; the function of style function in place of the value or as the last argument"},
      {"HeatFlux", 3, 5, "external, face, style[, value[, time]]", "heat flux through faces of particles"},
      {"BoundaryID", 0, 1, "[id]", "id, at most 0, of the following conditions, for reaction histories"},
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
       "rigid blocks; attributes are those of the element of this name. Each line begins with the name of an element "
       "that belongs into it and pairs of an attribute and its value; PolyPt and shapes belong to the line before "
       "them. "
       "In a stage: the attributes that change, and Platen with what changes of a platen"},
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
       "conditional execution; comparisons = == != > >= < <=, combined by && and ||"},
      {"Repeat", 0, 99, "[variable, first, last[, step]] ... EndRepeat",
       "loop; break, breakAll and continue as in other languages"},
      {"Sub", 0, 99, "name, parameter, ... EndSub", "defines a subroutine; return leaves it"},
      {"GoSub", 0, 99, "name, value, ...", "calls a subroutine"},
      {"Write", 0, 99, "text, ...", "writes to the terminal"},
      {"WriteLine", 0, 99, "text, ...", "writes to the terminal, followed by a line break"},
      {"Clear", 0, 99, "", "discards the text written so far"},
      {"Stop", 0, 99, "text, ...", "ends the script with this error message"},
      {"Lines", 0, 99, "variable, first, last, text", "lines of a text into the elements of an array"},
      {"Words", 0, 99, "variable, first, last, text[, separators]", "words of a text into the elements of an array"},
  };
  return all;
}

}  // namespace tribo::script
