// SPDX-License-Identifier: MIT
/// Keywords of materials and laws, and of paths that drive a single law.

#include "input/dialect/rows.hpp"

namespace tribo::keywords {

void add_laws(Rows& add) {
  add({"Drive",
       "JANFEAInput",
       "drives a single law along a prescribed path, for 'tribo drive'; ignored by 'tribo run'",
       T::none,
       {text("material", "name of the material to drive; this, contact or joint is required"),
        text("contact", "name of the contact law to drive; this, material or joint is required"),
        text("joint", "name of the joint law to drive; this, material or contact is required"),
        {"test", T::choice, "name of a standard test, instead of <Path>",
         "simple_shear uniaxial_stress oedometer triaxial_compression triaxial_extension isotropic"},
        number("strain",
               "strain at the end of the test: the shear strain, the axial strain or, in the test isotropic, the "
               "volumetric strain; required with test"),
        number("rate", "rate of this strain [1/time] (default 1)"),
        {"steps", T::integer, "number of steps of the test (default 100)"},
        number("pressure", "confining pressure of a triaxial test [stress]"),
        number("angle", "angle by which the material axes are rotated about z [degrees]"),
        number("temp", "initial temperature (default: that of <StressFreeTemp>)"),
        number("mass",
               "contact law: reduced mass of the two sides per area (default 1). Joint law: effective mass for its "
               "dashpots (default: mass of the block)"),
        number("gap", "initial gap between the faces (default 0)"),
        number("cell", "cell size passed to the contact law (default 1)"),
        number("area", "area of the joint (default 1)"),
        number("thickness", "thickness of a joint in two dimensions; without it the joint is three-dimensional"),
        number("distance",
               "distance between the centres of the two bodies of a joint; required with <compute-stiffness>"),
        number("block", "mass of body 2, which then moves by the forces on it; without it the path gives its motion"),
        number("spring-normal",
               "normal stiffness of a loading machine [force/length]; the path then moves the far end of its spring"),
        number("spring-shear", "shear stiffness of the loading machine [force/length]"),
        number("vn", "initial velocity of body 2 along the normal n"),
        number("vss", "initial velocity of body 2 along the tangent s"),
        number("vst", "initial velocity of body 2 along the tangent t")},
       true});
  add({"InitialStress",
       "Drive",
       "stress at the start of the path",
       T::none,
       {number("xx", "normal stress along x"), number("yy", "normal stress along y"),
        number("zz", "normal stress along z"), number("xy", "shear stress xy"), number("yz", "shear stress yz"),
        number("xz", "shear stress xz")},
       true});
  add({"Path",
       "Drive",
       "rows of numbers separated by commas; the first line names the columns. For all laws these are dt and steps. "
       "Materials: the velocity gradient Lxx to Lzz, or the prescribed stress sxx to sxz. Contact laws: the velocities "
       "vn, vt1, vt2, or the tractions N, St1, St2. Joint laws: the increments per step dn, dss, dst, dtwist, dbs, "
       "dbt, or the forces Fn, Fss, Fst; loads on body 2 Pn, Pss, Pst; the force of the fictitious stress Ffn, Ffss, "
       "Ffst; the pore pressure 'pressure' at the end of the row",
       T::text,
       {text("file", "name of a file with the rows; required without text")},
       true});

  add({"Material",
       "JANFEAInput",
       "a material, contact law or joint law. Its properties are child elements; 'tribo list' names all laws, and "
       "'tribo doc NAME' their properties",
       T::none,
       {text("Type", "number or name of the law", true),
        text("Name", "name by which other elements refer to it", true)},
       false,
       true});
}

}  // namespace tribo::keywords
