// SPDX-License-Identifier: MIT
/// Keywords of bodies, particles and shapes.

#include "input/dialect/rows.hpp"

namespace tribo::keywords {
namespace {

std::vector<AttributeSpec> body_attributes() {
  return {text("mat", "number of the material; this or matname is required"),
          text("matname", "name of the material; this or mat is required"),
          number("angle", "rotation of the material axes about z [degrees]"),
          number("thick", "thickness (2D)"),
          number("vx", "initial velocity"),
          number("vy", "initial velocity"),
          number("vz", "initial velocity"),
          number("temp", "initial temperature"),
          number("size", "edge length of a particle domain, instead of a number of particles per cell")};
}

}  // namespace

void add_bodies(Rows& add) {
  add({"MaterialPoints", "JANFEAInput", "bodies and particles", T::none, {}, true, true, false, {}, "Blocks"});
  add({"Body", "MaterialPoints Stage", "shapes filled with a material", T::none,
       body_attributes() + std::vector{units(velocities_and_lengths)}});
  add({"Hole", "MaterialPoints Stage", "shapes without particles", T::none});
  for (const auto name : {"vel0X", "vel0Y", "vel0Z"})
    add({name, "Body", "initial velocity of the following shapes, a function of position (before Deform moves it)",
         T::function});
  for (const auto name : {"RotateX", "RotateY", "RotateZ"})
    add({name, "Body",
         name[6] == 'Z' ? "rotation of the material axes of the following shapes [degrees]"
                        : "rotation out of the plane: without effect on isotropic materials, refused for others",
         T::function});
  add({"Unrotate", "Body", "the material axes of the following shapes are those of the grid"});
  add({"Deform",
       "Body",
       "displaces and strains the following shapes before the start",
       T::none,
       {function("dX", "shift"), function("dY", "shift"), function("dZ", "shift"), function("F11", ""),
        function("F12", ""), function("F13", ""), function("F21", ""), function("F22", ""), function("F23", ""),
        function("F31", ""), function("F32", ""), function("F33", "")}});
  add({"Undeform", "Body", "no initial deformation of the following shapes"});
  add({"InitialStress", "Body",
       "initial Cauchy stress of the following shapes: the sum of functions of position, of values at points, and with "
       "K0 of the geostatic stress",
       T::none,
       stress_components() +
           std::vector{number("K0", "adds the geostatic stress with this ratio of horizontal to vertical stress")}});
  add({"PointList", "MaterialPoints", "single particles"});
  add({"mp",
       "PointList",
       "a particle; its <pt> is required",
       T::none,
       {{"elem", T::integer, "accepted"},
        text("mat", "number of the material; this or matname is required"),
        text("matname", "name of the material; this or mat is required"),
        number("angle", "rotation of the material axes about z [degrees]"),
        number("thick", "thickness"),
        number("temp", "temperature"),
        number("lpx", "half width of its domain [half cells]"),
        number("lpy", ""),
        number("lpz", "")}});
  add({"ParticleTable",
       "MaterialPoints",
       "a body that is given by its particles, the rows of a table: positions x, y, z; volume, or edge lengths of the "
       "domain as size or size_x, size_y, size_z; and as needed mass, vx, vy, vz, temperature, the initial stress xx, "
       "yy, zz, xy, yz, xz, and history variables of the material by their names",
       T::none,
       {text("mat", "number of the material; this or matname is required"),
        text("matname", "name of the material; this or mat is required"),
        text("file",
             "table of comma-separated values with the names of its columns in the first line, or a VTK file "
             "(.vtp, .vtu, .vtk), such as a block of a particle file of a run",
             true),
        number("size", "edge length of all domains; required without a column of sizes or volumes"),
        number("vx", "initial velocity, instead of a column"), number("vy", "initial velocity"),
        number("vz", "initial velocity"), number("temp", "initial temperature, instead of a column"),
        number("angle", "rotation of the material axes about z [degrees]"),
        number("scale", "factor of the coordinates of the file and of its sizes (default 1)"),
        number("x", "shift of the coordinates"), number("y", "shift of the coordinates"),
        number("z", "shift of the coordinates")}});
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
}

void add_shapes(Rows& add) {
  constexpr std::string_view shapes_in =
      "Body Hole BCShape LdShape Joint Platen Pressure Hold Load Excavate Stress Bond Unbond @shape";
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
  const std::vector placement{number("scale", "factor (default 1)"), number("x", "shift"), number("y", "shift"),
                              number("z", "shift")};
  const std::vector group{
      text("group", "physical group of a mesh of Gmsh, by its name or number (default: the whole mesh)")};
  shape("STL", "older name of Surface", std::vector{text("file", "", true)} + placement + group);
  shape("Surface", "body with a closed surface from a file in space, or with the outline of a plane mesh",
        std::vector{text("file",
                         "by its ending: STL, OBJ or PLY; a mesh of Gmsh (.msh), of whose volumes or surfaces the "
                         "outer faces count, and in two dimensions the outer edges",
                         true)} +
            placement + group);
  shape("Terrain", "body below a surface of heights, in space",
        std::vector{text("file", "ESRI ASCII grid, or a PNG or BMP picture", true),
                    number("zmin", "height of its bottom; this or below is required"),
                    text("below", "file of its lower surface; this or zmin is required"),
                    number("width", "required of a picture: along x"),
                    number("depth", "required of a picture: along y"), number("low", "height of black (default 0)"),
                    number("high", "required of a picture: height of white")} +
            placement);
  add({"BMP",
       "MaterialPoints Stage",
       "greyscale image (PNG or BMP) that assigns materials in a rectangle",
       T::none,
       {text("name", "file", true), number("width", "(default: one unit per pixel)"), number("height", ""),
        units(lengths)}});
  add({"Origin", "BMP", "lower left corner", T::none, {number("x", ""), number("y", ""), units(lengths)}, true});
  add({"Intensity",
       "BMP",
       "material of a range of grey values",
       T::none,
       {text("mat", "number of the material; this or matname is required"),
        text("matname", "name of the material; this or mat is required"),
        {"imin", T::integer, "0 black", {}, true},
        {"imax", T::integer, "255 white", {}, true},
        number("vx", ""),
        number("vy", ""),
        number("vz", ""),
        number("thick", ""),
        number("angle", "")}});
}

}  // namespace tribo::keywords
