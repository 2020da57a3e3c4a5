// SPDX-License-Identifier: MIT
/// Keywords of rigid blocks.

#include "input/dialect/rows.hpp"

namespace tribo::keywords {

void add_blocks(Rows& add) {
  const std::vector<AttributeSpec> of_blocks{
      text("name", "name used by histories and messages"),
      text("matname",
           "RigidContact material of the block, for contact with other materials; this or mat is required with a grid"),
      text("mat", "number of that material; this or matname is required with a grid"),
      number("rho", "density", true),
      number("vx", "initial velocity"),
      number("vy", ""),
      number("vz", ""),
      number("spinx", "initial angular velocity [rad/time]"),
      number("spiny", ""),
      number("spinz", ""),
      number("kn",
             "property of its surface, normal stiffness per area, for joint laws with 'inherit': springs of both sides "
             "in series"),
      number("ks", "as kn, shear stiffness per area"),
      number("fric", "as kn, friction coefficient: the smaller one of both sides")};
  const AttributeSpec inherit{
      "inherit", T::flag, "kn, ks and friction of a contact follow from those of its two blocks, where both have them"};
  const std::vector<AttributeSpec> block_box{number("xmin", "edge", true),
                                             number("xmax", "", true),
                                             number("ymin", "", true),
                                             number("ymax", "", true),
                                             number("zmin", "required in three dimensions"),
                                             number("zmax", "required in three dimensions")};
  const AttributeSpec points{
      "points", T::choice,
      "one contact at the centre of a common face (default), or one at each of its corners with its "
      "share of the area, so that laws without moments resist relative rotation",
      "face corners"};
  add({"Blocks", "JANFEAInput",
       "rigid blocks with joint laws at their contacts, alone or together with bodies in a grid", T::none,
       std::vector<AttributeSpec>{
           text("lawname",
                "name of the joint law of contacts outside every <Joint>, and of the stiffness of platens; required if "
                "there are any"),
           text("law", "number or name of that joint law, instead of lawname"),
           text("touchname",
                "name of the joint law of contacts formed during the run outside every <Joint>; default: the law "
                "'lawname' without its bonds; 'none': such a contact is an error"),
           points,
           inherit,
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
               text("file", "table with columns x, y, z of the nuclei; required without other nuclei"),
               number(
                   "hexagons",
                   "nuclei of regular hexagons: distance between opposite sides (2D); required without other nuclei"),
               number("cubes",
                      "nuclei of cubes, in two dimensions squares: edge length; required without other nuclei"),
               number("octahedra",
                      "nuclei of truncated octahedra: distance between opposite squares (3D); required without other "
                      "nuclei"),
               {"random", T::integer, "number of randomly placed nuclei; required without other nuclei"},
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
       "rule: joint law of the contacts that fulfil all of its criteria; the first <Joint> that fits a contact "
       "applies. "
       "Criteria are its shapes, one of which contains the middle of the contact, and the attributes",
       T::none,
       std::vector<AttributeSpec>{
           text("lawname", "name of the joint law; this or law is required"),
           text("law", "number or name of the joint law; this or lawname is required"),
           text(
               "blocks",
               "names of blocks, separated by blanks: both blocks of the contact are among them; required with 'with'"),
           text("with", "one block is among these, the other among 'blocks'; 'any': any block"),
           text("dip",
                "two angles: the face is inclined to the horizontal by an angle between them [degrees, 0 to 90]; y "
                "points up, in three dimensions z"),
           text("dipdirection",
                "two angles, clockwise from y as seen from above: the face descends in a direction between them; "
                "'350 10' contains north; in two dimensions to the right is 90, to the left 270 [degrees]"),
           {"kind", T::choice, "between faces, between balls, or between a ball and a face", "faces balls ball-face"},
           {"contacts", T::choice,
            "contacts that exist at the start (default), that form later, or all; later ones have the law without its "
            "bonds",
            "initial later all"},
           inherit,
           points}});
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
  const AttributeSpec named =
      text("blocks", "names of blocks, separated by blanks: only these; required without shapes");
  add({"Hold", "Blocks",
       "prescribed motion of blocks whose centres lie in its shapes; components that are not given are free", T::none,
       std::vector<AttributeSpec>{named} + motion +
           std::vector<AttributeSpec>{function("spinx", "angular velocity [rad/time], may be a function of t"),
                                      function("spiny", ""), function("spinz", "")}});
  add({"Load", "Blocks", "force and moment on each block whose centre lies in its shapes", T::none,
       std::vector<AttributeSpec>{named, function("Fx", "force, may be a function of t"), function("Fy", ""),
                                  function("Fz", ""), function("Mx", "moment, may be a function of t"),
                                  function("My", ""), function("Mz", "")}});
}

}  // namespace tribo::keywords
