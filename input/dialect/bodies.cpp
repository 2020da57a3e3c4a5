// SPDX-License-Identifier: MIT
/// Keywords of bodies, particles and shapes.

#include "input/dialect/rows.hpp"

namespace tribo::keywords {
namespace {

std::vector<AttributeSpec> body_attributes() {
  return {text("mat", "number of the material; this or matname is required"),
          text("matname", "name of the material; this or mat is required"),
          number("angle", "angle by which the material axes are rotated about z [degrees] (default 0)"),
          number("thick", "thickness of the body, > 0, in plane models (default: that of the grid)"),
          number("vx", "initial velocity along x (default 0)"),
          number("vy", "initial velocity along y (default 0)"),
          number("vz", "initial velocity along z (default 0)"),
          number("temp", "initial temperature (default: that of <StressFreeTemp>)"),
          number("size", "edge length of the particle domains, > 0, instead of a number of particles per cell")};
}

}  // namespace

void add_bodies(Rows& add) {
  add({"MaterialPoints", "JANFEAInput", "bodies and particles", T::none, {}, true, true, false, {}, "Blocks"});
  add({"Body", "MaterialPoints Stage", "a body: shapes that are filled with particles of a material", T::none,
       body_attributes() + std::vector{units(velocities_and_lengths)}});
  add({"Hole", "MaterialPoints Stage", "shapes in which the bodies after it have no particles", T::none});
  for (const auto name : {"vel0X", "vel0Y", "vel0Z"})
    add({name, "Body",
         "initial velocity of the shapes after it, along the axis that the name contains: a function of the position "
         "before <Deform> moves it",
         T::function});
  for (const auto name : {"RotateX", "RotateY", "RotateZ"})
    add({name, "Body",
         name[6] == 'Z' ? "angle by which the material axes of the shapes after it are rotated about z [degrees]"
                        : "rotation of the material axes out of the xy plane; without effect on isotropic materials, "
                          "refused for others",
         T::function});
  add({"Unrotate", "Body", "the material axes of the shapes after it are those of the grid"});
  add({"Deform",
       "Body",
       "displaces and deforms the shapes after it before the start; its attributes are functions of the position",
       T::none,
       {function("dX", "displacement along x (default 0)"), function("dY", "displacement along y (default 0)"),
        function("dZ", "displacement along z (default 0)"),
        function("F11", "component 11 of the deformation gradient (default 1)"),
        function("F12", "component 12 of the deformation gradient (default 0)"),
        function("F13", "component 13 of the deformation gradient (default 0)"),
        function("F21", "component 21 of the deformation gradient (default 0)"),
        function("F22", "component 22 of the deformation gradient (default 1)"),
        function("F23", "component 23 of the deformation gradient (default 0)"),
        function("F31", "component 31 of the deformation gradient (default 0)"),
        function("F32", "component 32 of the deformation gradient (default 0)"),
        function("F33", "component 33 of the deformation gradient (default 1)")}});
  add({"Undeform", "Body", "the shapes after it have no initial deformation"});
  add({"InitialStress", "Body",
       "initial Cauchy stress of the shapes after it. It is the sum of functions of the position, of values at points "
       "from a file, and with K0 of the geostatic stress",
       T::none,
       stress_components() +
           std::vector{
               number("K0", "adds the geostatic stress with this ratio of horizontal to vertical stress, >= 0")}});
  add({"PointList", "MaterialPoints", "single particles"});
  add({"mp",
       "PointList",
       "a particle; its position <pt> is required",
       T::none,
       {{"elem", T::integer, "accepted without effect"},
        text("mat", "number of the material; this or matname is required"),
        text("matname", "name of the material; this or mat is required"),
        number("angle", "angle by which the material axes are rotated about z [degrees] (default 0)"),
        number("thick", "thickness of the particle, > 0, in plane models (default: that of the grid)"),
        number("temp", "initial temperature (default: that of <StressFreeTemp>)"),
        number("lpx", "edge length of the particle domain along x [cells], > 0 (default 0.5 if another one is given)"),
        number("lpy", "the same along y"),
        number("lpz", "the same along z")}});
  add({"ParticleTable",
       "MaterialPoints",
       "a body that is given by a table with one row for each particle. Its columns are the position x, y, z; the "
       "volume, or the edge lengths of the domain as size or size_x, size_y, size_z; and optionally mass, vx, vy, vz, "
       "temperature, the initial stress xx, yy, zz, xy, yz, xz, and history variables of the material by their names",
       T::none,
       {text("mat", "number of the material; this or matname is required"),
        text("matname", "name of the material; this or mat is required"),
        text("file",
             "file with comma-separated values and the names of the columns in its first line, or a VTK file (.vtp, "
             ".vtu, .vtk), such as a block of a particle file of a run",
             true),
        number("size", "edge length of the domains of all particles; required without a column of sizes or volumes"),
        number("vx", "initial velocity along x, instead of a column"),
        number("vy", "initial velocity along y, instead of a column"),
        number("vz", "initial velocity along z, instead of a column"),
        number("temp", "initial temperature, instead of a column"),
        number("angle", "angle by which the material axes are rotated about z [degrees] (default 0)"),
        number("scale", "factor by which the coordinates and sizes of the file are multiplied (default 1)"),
        number("x", "displacement of the scaled coordinates along x (default 0)"),
        number("y", "displacement along y (default 0)"), number("z", "displacement along z (default 0)")}});
  add({"pt",
       "mp Polygon Voronoi PolygonBlock",
       "coordinates of a point",
       T::none,
       {{"x", T::coordinate, "x coordinate", {}, true},
        {"y", T::coordinate, "y coordinate", {}, true},
        {"z", T::coordinate, "z coordinate, in three dimensions"},
        units(lengths)}});
  add({"vel",
       "mp",
       "initial velocity of the particle",
       T::none,
       {number("x", "component along x (default 0)"), number("y", "component along y (default 0)"),
        number("z", "component along z (default 0)"), units(velocities)},
       true});
  add({"mass",
       "mp",
       "mass of the particle, instead of density times volume",
       T::none,
       {number("m", "mass, > 0", true), units(masses)},
       true});
}

void add_shapes(Rows& add) {
  constexpr std::string_view shapes_in =
      "Body Hole BCShape LdShape Joint Platen Pressure Hold Load Excavate Stress Bond Unbond @shape";
  const auto shape = [&](std::string_view name, std::string_view meaning, std::vector<AttributeSpec> attributes) {
    add({name, shapes_in, meaning, T::none, std::move(attributes), false, false, true});
  };
  shape("Rect", "rectangle (2D)", box(false));
  shape("Oval", "ellipse that touches the four edges (2D); with <arc> a sector of it", box(false));
  add({"arc",
       "Oval",
       "the sector between two polar angles at the centre [degrees], which are counted counterclockwise from the x "
       "axis",
       T::none,
       {number("start", "angle at which the sector begins", true), number("end", "angle at which it ends", true)},
       true});
  shape("Polygon", "polygon (2D) whose corners are <pt>s, at least three", {});
  shape("Line", "all points whose distance from a line is at most the tolerance", ends());
  shape("Arc",
        "all points whose distance from an arc of an ellipse (2D) is at most the tolerance; the ellipse touches the "
        "four edges",
        box(false) +
            std::vector{
                number("start",
                       "polar angle at which the arc begins, counterclockwise from the x axis [degrees] (default 0)"),
                number("end", "polar angle at which the arc ends [degrees] (default 360)"),
                AttributeSpec{"tolerance", T::text,
                              "largest distance from the arc: a length, or '*f' for f cells (default '*0.1')"}});
  shape("Box", "box (3D)", box(true));
  shape("Sphere", "ellipsoid that touches the six faces of a box (3D)", box(true));
  shape("Cylinder", "elliptic cylinder or cone that touches the faces of a box (3D)",
        box(true) +
            std::vector{
                AttributeSpec{"axis", T::choice, "direction of the axis: 1 or x, 2 or y, 3 or z", "1 2 3 x y z", true},
                number(
                    "radius",
                    "ratio of the smaller to the larger end radius (default 1: a cylinder; 0: a cone), -1 to 1. If it "
                    "is positive the end at the high coordinate is the smaller one, if it is negative the other end")});
  shape("Torus", "ring (torus) that touches the faces of a box (3D)",
        box(true) +
            std::vector{
                AttributeSpec{"axis", T::choice, "direction of the axis: 1 or x, 2 or y, 3 or z", "1 2 3 x y z", true},
                number("radius",
                       "half width of the cross-section of the ring; 0 (default): the cross-section is a circle")});
  const std::vector placement{number("scale", "factor of all coordinates (default 1)"),
                              number("x", "displacement along x after scaling (default 0)"),
                              number("y", "displacement along y after scaling (default 0)"),
                              number("z", "displacement along z after scaling (default 0)")};
  const std::vector group{
      text("group", "name or number of a physical group in a mesh of Gmsh (default: the whole mesh)")};
  shape("STL", "older name of Surface",
        std::vector{text("file", "file with a surface, as in <Surface>", true)} + placement + group);
  shape("Surface", "body that is enclosed by the closed surface of a file (3D) or by the outline of a plane mesh (2D)",
        std::vector{text(
            "file",
            "file with a surface, STL, OBJ or PLY, or with a mesh of Gmsh (.msh); the ending of the name tells its "
            "format. Of a mesh the outer faces of the volumes or surfaces are used, in two dimensions the outer edges",
            true)} +
            placement + group);
  shape("Terrain", "body below a surface that is given by heights (3D)",
        std::vector{text("file", "file with the heights: an ESRI ASCII grid, or a PNG or BMP picture", true),
                    number("zmin", "height of the bottom of the body; this or below is required"),
                    text("below", "file with the heights of the lower surface of the body; this or zmin is required"),
                    number("width", "extent of a picture along x; required of a picture"),
                    number("depth", "extent of a picture along y; required of a picture"),
                    number("low", "height of black in a picture (default 0)"),
                    number("high", "height of white in a picture; required of a picture")} +
            placement);
  add({"BMP",
       "MaterialPoints Stage",
       "a rectangle that a greyscale image (PNG or BMP) fills with bodies; each range of grey values has a material",
       T::none,
       {text("name", "file of the image", true),
        number("width", "width of the rectangle, > 0 (default: one unit of length per pixel)"),
        number("height", "height of the rectangle, > 0 (default: one unit of length per pixel)"), units(lengths)}});
  add({"Origin",
       "BMP",
       "lower left corner of the rectangle",
       T::none,
       {number("x", "x coordinate (default 0)"), number("y", "y coordinate (default 0)"), units(lengths)},
       true});
  add({"Intensity",
       "BMP",
       "material of a range of grey values, with the properties of its particles",
       T::none,
       {text("mat", "number of the material; this or matname is required"),
        text("matname", "name of the material; this or mat is required"),
        {"imin", T::integer, "lowest grey value of the range, from 0 (black) to 255 (white)", {}, true},
        {"imax", T::integer, "highest grey value of the range, at least imin", {}, true},
        number("vx", "initial velocity along x (default 0)"),
        number("vy", "the same along y"),
        number("vz", "the same along z"),
        number("thick", "thickness in plane models (default: that of the grid)"),
        number("angle", "rotation of the material axes about z [degrees] (default 0)")}});
}

}  // namespace tribo::keywords
