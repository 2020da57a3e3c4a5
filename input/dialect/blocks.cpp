// SPDX-License-Identifier: MIT
/// Keywords of rigid blocks.

#include "input/dialect/rows.hpp"

namespace tribo::keywords {

void add_blocks(Rows& add) {
  const std::vector<AttributeSpec> of_blocks{
      text("name", "name of the block, for histories and messages"),
      text("matname",
           "name of the RigidContact material of the block, for its contact with other materials; this or mat is "
           "required with a grid"),
      text("mat", "number of that material; this or matname is required with a grid"),
      number("rho", "mass density, > 0", true),
      number("vx", "initial velocity along x (default 0)"),
      number("vy", "the same along y"),
      number("vz", "the same along z"),
      number("spinx", "initial angular velocity about x [rad/time] (default 0)"),
      number("spiny", "the same about y"),
      number("spinz", "the same about z"),
      number("kn",
             "normal stiffness of its surface per area [stress/length], for contacts with 'inherit'; there the springs "
             "of both blocks act in series"),
      number("ks", "shear stiffness of its surface per area [stress/length], combined like kn"),
      number("fric",
             "friction coefficient of its surface, for contacts with 'inherit'; there the smaller one of both blocks "
             "holds")};
  const AttributeSpec inherit{"inherit", T::flag,
                              "whether kn, ks and the friction of a contact follow from those of its two blocks, where "
                              "both blocks have them (default no)"};
  const std::vector<AttributeSpec> block_box{number("xmin", "lower edge along x", true),
                                             number("xmax", "upper edge along x", true),
                                             number("ymin", "lower edge along y", true),
                                             number("ymax", "upper edge along y", true),
                                             number("zmin", "lower edge along z; required in three dimensions"),
                                             number("zmax", "upper edge along z; required in three dimensions")};
  const AttributeSpec points{
      "points", T::choice,
      "face (default): one contact at the centre of a common face of two blocks; corners: one contact at each corner "
      "of this face with its share of the area, so that laws without moments resist relative rotation",
      "face corners"};
  add({"Blocks", "JANFEAInput",
       "rigid blocks with joint laws at their contacts, alone or together with bodies in a grid", T::none,
       std::vector<AttributeSpec>{
           text("lawname",
                "name of the joint law of the contacts that fit no <Joint>, and of the law that gives the stiffness of "
                "platens; required if there are any"),
           text("law", "number or name of this joint law, instead of lawname"),
           text("touchname",
                "name of the joint law of contacts that form during the run and fit no <Joint>. Default: the law "
                "'lawname' without its bonds; 'none': such a contact is an error"),
           points,
           inherit,
           number("thickness", "thickness of a plane model, > 0 (default 1)"),
           number("damping",
                  "local damping, in [0, 1): this fraction of the unbalanced force acts against the motion of each "
                  "block; 0 (default) for dynamics, 0.7 for static equilibrium"),
           {"quasistatic", T::flag,
            "whether the masses are scaled so that <TimeStep> is stable; time then has a meaning for prescribed "
            "motions only (default no)"},
           {"iterations", T::integer,
            "number of fixed-point iterations of the fictitious stress within a step, 0 to 20 (default 0)"},
           number("step", "time step as a fraction of the critical one, in (0, 1] (default 0.8)")},
       true});
  add({"Voronoi", "Blocks",
       "blocks that fill a box. They are the Voronoi cells of nuclei, which are given by <pt>s or a file, form a "
       "lattice, or are placed at random",
       T::none,
       block_box +
           std::vector{
               text("file", "file of a table with the columns x, y, z of the nuclei; required without other nuclei"),
               number("hexagons",
                      "the blocks are regular hexagons (2D) with this distance between opposite sides; required "
                      "without other nuclei"),
               number("cubes",
                      "the blocks are cubes, in two dimensions squares, with this edge length; required without other "
                      "nuclei"),
               number("octahedra",
                      "the blocks are truncated octahedra (3D) with this distance between opposite squares; required "
                      "without other nuclei"),
               {"random", T::integer, "number of nuclei that are placed at random; required without other nuclei"},
               {"seed", T::integer, "seed of the random numbers; each value gives another specimen (default 1)"},
               number("apart",
                      "smallest distance between two random nuclei, 0 to 0.8 (default 0.6). Its unit is the edge "
                      "length of a square or cube with the mean area or volume per nucleus")} +
           of_blocks});
  add({"BoxBlock", "Blocks", "one block with the shape of a rectangle (2D) or a box (3D)", T::none,
       block_box +
           std::vector{number(
               "angle",
               "angle by which the block is rotated about the z axis through the origin [degrees] (default 0)")} +
           of_blocks});
  add({"PolygonBlock", "Blocks", "one block with the shape of a convex polygon, whose corners are <pt>s", T::none,
       std::vector<AttributeSpec>{number(
           "angle", "angle by which the block is rotated about the z axis through the origin [degrees] (default 0)")} +
           of_blocks});
  add({"Ball", "Blocks", "one block with the shape of a disc (2D) or a ball (3D)", T::none,
       std::vector<AttributeSpec>{number("x", "x coordinate of the centre", true), number("y", "y coordinate", true),
                                  number("z", "z coordinate, in three dimensions"),
                                  number("radius", "radius, > 0", true)} +
           of_blocks});
  add({"Joint", "Blocks",
       "assigns a joint law to the contacts that fulfil all of its criteria. The criteria are its attributes and its "
       "shapes, one of which must contain the middle of the contact. If several <Joint> fit a contact, the first one "
       "applies",
       T::none,
       std::vector<AttributeSpec>{
           text("lawname", "name of the joint law; this or law is required"),
           text("law", "number or name of the joint law; this or lawname is required"),
           text("blocks",
                "names of blocks, separated by blanks: both blocks of the contact must be among them; required with "
                "'with'"),
           text("with",
                "names of blocks: one block of the contact must be among them, the other among 'blocks'. 'any' stands "
                "for all blocks"),
           text("dip",
                "two angles [degrees, 0 to 90]: the inclination of the face to the horizontal must lie between them. "
                "The vertical axis is y, in three dimensions z"),
           text("dipdirection",
                "two angles [degrees], counted clockwise from the y axis (north) as seen from above: the face must "
                "descend in a direction between them; '350 10' contains north. In two dimensions 90 is to the right, "
                "270 to the left"),
           {"kind", T::choice, "contacts between faces, between balls, or between a ball and a face (default: all)",
            "faces balls ball-face"},
           {"contacts", T::choice,
            "initial (default): contacts that exist at the start; later: contacts that form during the run; all: both. "
            "Later contacts have the law without its bonds",
            "initial later all"},
           inherit,
           points}});
  const std::vector<AttributeSpec> motion{function("vx", "velocity along x, a number or a function of the time t"),
                                          function("vy", "the same along y"), function("vz", "the same along z")};
  add({"Platen", "Blocks",
       "a stiff platen, which springs connect to the free faces whose centres lie in its shapes; they also resist "
       "tension. Components of its velocity that are not given are zero",
       T::none,
       std::vector<AttributeSpec>{
           text("name", "name of the platen, for histories"),
           {"rough", T::flag, "whether the springs also resist tangential motion of the faces (default no)"},
           number("E",
                  "modulus E of its springs [stress], whose stiffness is E A/d with the area A of the face and the "
                  "distance d from the centre of the block to the face (default: stiffness of the joint law of "
                  "<Blocks>)")} +
           motion});
  add({"Pressure", "Blocks", "pressure on the free faces whose centres lie in its shapes", T::none,
       std::vector<AttributeSpec>{
           {"value", T::function, "pressure, a number or a function of the time t", {}, true},
           {"follows", T::flag, "whether the pressure stays normal to the faces when they rotate (default yes)"}}});
  const AttributeSpec named =
      text("blocks", "names of blocks, separated by blanks: only these blocks are meant; required without shapes");
  add({"Hold", "Blocks",
       "prescribed motion of the blocks whose centres lie in its shapes; components of the velocity that are not given "
       "are free",
       T::none,
       std::vector<AttributeSpec>{named} + motion +
           std::vector<AttributeSpec>{
               function("spinx", "angular velocity about x [rad/time], a number or a function of the time t"),
               function("spiny", "the same about y"), function("spinz", "the same about z")}});
  add({"Load", "Blocks", "force and moment on each block whose centre lies in its shapes", T::none,
       std::vector<AttributeSpec>{named,
                                  function("Fx", "force along x, a number or a function of the time t (default 0)"),
                                  function("Fy", "the same along y"), function("Fz", "the same along z"),
                                  function("Mx", "moment about x, a number or a function of the time t (default 0)"),
                                  function("My", "the same about y"), function("Mz", "the same about z")}});
}

}  // namespace tribo::keywords
