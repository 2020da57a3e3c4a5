// SPDX-License-Identifier: MIT
/// Keywords of stages within a run.

#include "input/dialect/rows.hpp"

namespace tribo::keywords {

void add_stages(Rows& add) {
  add({"Stage", "JANFEAInput",
       "from its time on the run continues with the changes in it; everything else stays as it is", T::none,
       std::vector{number("at", "time at which it begins", true),
                   text("name", "of the stage, for messages and stages.csv"),
                   text("until",
                        "`ratio` and a number: the stage ends once the ratio of unbalanced to applied forces "
                        "has fallen below it, at most when the next one begins"),
                   units(times)}});
  add({"When",
       "JANFEAInput Stage",
       "what is done, once, when something happens while the stage lasts, or in the file before the first stage; an "
       "element in it is required",
       T::none,
       {{"event", T::choice, "bond_break: a bond of a joint breaks; this, history or ratio is required", "bond_break"},
        text("history",
             "a column of history.csv, which passes a value in a row of the file; this, event or ratio is required"),
        number("above", "the history is above this value, in its unit; this or below is required with history"),
        number("below", "the history is below this value; this or above is required with history"),
        number("ratio",
               "the ratio of unbalanced to applied forces is below this value; this, event or history is required")}});
  add({"Stop", "When", "the run stops, as if its time were over", T::none, {}, true});
  add({"Frame", "When", "the files of particles or blocks are written", T::none, {}, true});
  add({"Checkpoint", "When", "a checkpoint is written", T::none, {}, true});
  add({"NextStage", "When", "the next stage begins; after the last one the run stops", T::none, {}, true});
  add({"Material",
       "Stage",
       "other properties of a material, contact law or joint law; properties that are not given stay as they are",
       T::none,
       {text("Name", "of the material"), text("mat", "number of the material, instead of Name"),
        text("matname", "the same as Name"), text("Type", "may be given if it is that of the material")}});
  add({"Gravity", "Stage", "body forces per unit mass, which replace the former ones", T::none, {}, true});
  add({"GridBCs",
       "Stage",
       "conditions on grid nodes, which replace the former ones",
       T::none,
       {{"add", T::flag, "yes: the former ones stay"}},
       true});
  add({"ParticleBCs",
       "Stage",
       "loads on particles by their present positions, which replace the former ones",
       T::none,
       {{"add", T::flag, "yes: the former ones stay, on the particles that have them"}},
       true});
  add({"Friction", "Stage", "the default contact law from now on", T::number, contact_law(), true});
  add({"Blocks",
       "Stage",
       "other settings of the blocks",
       T::none,
       {number("damping", "local damping: fraction of the unbalanced force that acts against the motion of each block"),
        {"iterations", T::integer, "fixed-point iterations of the fictitious stress within a step"},
        number("step", "fraction of the critical time step")},
       true});
  add({"Platen",
       "Stage",
       "other velocities or stiffness of a platen; what is not given stays as it is",
       T::none,
       {text("name", "of the platen", true), function("vx", "velocity, may be a function of t"), function("vy", ""),
        function("vz", ""), number("E", "modulus of its springs of stiffness E A/d")}});
  add({"Excavate",
       "Stage",
       "removes the particles whose centres lie in its shapes",
       T::none,
       {text("mat", "number of a material: only particles of this material"),
        text("matname", "name of the material, instead of mat")}});
  add({"Stress", "Stage",
       "sets the Cauchy stress of the particles whose centres lie in its shapes, which must keep an initial stress; "
       "components that are not given stay as they are",
       T::none,
       stress_components() +
           std::vector{text("mat", "number of a material: only particles of this material"),
                       text("matname", "name of the material, instead of mat"),
                       AttributeSpec{"add", T::flag, "yes: the values are added to the present stress"}}});
  const std::vector<AttributeSpec> of_joints{
      text("lawname", "joints that follow this law"),
      text("law", "number or name of the law, instead of lawname"),
      text("blocks", "blocks: both of the contact are among these names"),
      text("with", "blocks: one is among these, the other among 'blocks'; 'any': any block"),
      text("dip", "two angles to the horizontal, between which the face is inclined [degrees, 0 to 90]"),
      text("dipdirection",
           "two angles, clockwise from y as seen from above, between which the face descends [degrees]"),
      {"kind", T::choice, "blocks: contacts between faces, balls, or a ball and a face", "faces balls ball-face"}};
  add({"Bond", "Stage", "bonds the joints that fulfil all criteria, its shapes and attributes, and whose faces touch",
       T::none, of_joints});
  add({"Unbond", "Stage", "breaks the bonds of the joints that fulfil all criteria, its shapes and attributes", T::none,
       of_joints});
}

}  // namespace tribo::keywords
