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
        {"test", T::choice, "a standard test, instead of <Path>",
         "simple_shear uniaxial_stress oedometer triaxial_compression triaxial_extension isotropic"},
        number("strain",
               "strain at the end of the test: shear, axial or, if isotropic, volumetric strain; required with test"),
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
        number("distance",
               "distance between the centres of the two bodies of a joint; required with <compute-stiffness>"),
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
       "block Pn, Pss, Pst, the force of the fictitious stress Ffn, Ffss, Ffst, and the pore pressure at the end of "
       "the "
       "row, pressure",
       T::text,
       {text("file", "file that contains the rows; required without text")},
       true});

  add({"Material",
       "JANFEAInput",
       "a material, contact law or joint law; its properties are child elements, see the lists of laws",
       T::none,
       {text("Type", "number or name", true), text("Name", "", true)},
       false,
       true});
}

}  // namespace tribo::keywords
