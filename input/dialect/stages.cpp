// SPDX-License-Identifier: MIT
/// Keywords of stages within a run.

#include "input/dialect/rows.hpp"

namespace tribo::keywords {

void add_stages(Rows& add) {
  add({"Stage", "JANFEAInput",
       "a stage of the run: from its time on, the run continues with the changes that the stage contains; everything "
       "else stays as it is",
       T::none,
       std::vector{number("at", "time at which the stage begins, > 0", true),
                   text("name", "name of the stage, for messages and for stages.csv"),
                   text("until",
                        "the word `ratio` and a number: the stage ends once the ratio of unbalanced to applied forces "
                        "has fallen below this number, and at the latest at the time of the next stage"),
                   units(times)}});
  add({"When",
       "JANFEAInput Stage",
       "a condition, and what is done once when it is first fulfilled. In a stage the condition is watched during this "
       "stage, elsewhere until the first stage begins. At least one element in it is required",
       T::none,
       {{"event", T::choice,
         "bond_break: the condition is that a bond of a joint breaks; this, history or ratio is required",
         "bond_break"},
        text("history",
             "name of a column of history.csv, whose values in the rows of the file are compared with 'above' or "
             "'below'; this, event or ratio is required"),
        number("above",
               "the condition is that the history is above this value, in the unit of the column; this or below is "
               "required with history"),
        number("below",
               "the condition is that the history is below this value; this or above is required with history"),
        number("ratio",
               "the condition is that the ratio of unbalanced to applied forces is below this value, > 0; this, event "
               "or history is required")}});
  add({"Stop", "When", "the run stops, as if it had reached its end", T::none, {}, true});
  add({"Frame", "When", "the files of particles or blocks of this time are written", T::none, {}, true});
  add({"Checkpoint", "When", "a checkpoint is written at this time", T::none, {}, true});
  add({"NextStage", "When", "the next stage begins; if there is none, the run stops", T::none, {}, true});
  add({"Material",
       "Stage",
       "new values of properties of a material, contact law or joint law; properties that are not given stay as they "
       "are",
       T::none,
       {text("Name", "name of the material or law"), text("mat", "number of the material or law, instead of Name"),
        text("matname", "the same as Name"),
        text("Type", "type of the material or law; may be given but cannot change")}});
  add({"Gravity", "Stage", "body forces per unit mass, which replace the former ones", T::none, {}, true});
  add({"GridBCs",
       "Stage",
       "conditions on grid nodes, which replace the former ones",
       T::none,
       {{"add", T::flag, "yes: the former conditions stay (default no)"}},
       true});
  add({"ParticleBCs",
       "Stage",
       "loads on particles, which are selected by their present positions; they replace the former loads",
       T::none,
       {{"add", T::flag, "yes: the former loads stay on the particles on which they act (default no)"}},
       true});
  add({"Friction", "Stage", "the default contact law from this stage on", T::number, contact_law(), true});
  add({"Blocks",
       "Stage",
       "new settings of rigid blocks; settings that are not given stay as they are",
       T::none,
       {number("damping",
               "local damping, in [0, 1): this fraction of the unbalanced force acts against the motion of each block"),
        {"iterations", T::integer, "number of fixed-point iterations of the fictitious stress within a step, 0 to 20"},
        number("step", "time step as a fraction of the critical one, in (0, 1]")},
       true});
  add({"Platen",
       "Stage",
       "new velocities or a new stiffness of a platen; what is not given stays as it is",
       T::none,
       {text("name", "name of the platen", true),
        function("vx", "velocity along x, a number or a function of the time t"), function("vy", "the same along y"),
        function("vz", "the same along z"),
        number("E",
               "modulus E of its springs [stress], whose stiffness is E A/d with the area A of a face of a block and "
               "the distance d from the centre of the block to the face")}});
  add({"Excavate",
       "Stage",
       "removes the particles whose centres lie in its shapes",
       T::none,
       {text("mat", "number of a material: only particles of this material"),
        text("matname", "name of the material, instead of mat")}});
  add({"Stress", "Stage",
       "sets the Cauchy stress of the particles whose centres lie in its shapes; components that are not given stay as "
       "they are. The material of the particles must be one that keeps an initial stress",
       T::none,
       stress_components() +
           std::vector{text("mat", "number of a material: only particles of this material"),
                       text("matname", "name of the material, instead of mat"),
                       AttributeSpec{"add", T::flag, "yes: the values are added to the present stress (default no)"}}});
  const std::vector<AttributeSpec> of_joints{
      text("lawname", "name of a joint law: only joints that follow it"),
      text("law", "number or name of the law, instead of lawname"),
      text("blocks", "models of blocks: names of blocks, separated by blanks; only contacts between two of them"),
      text("with",
           "models of blocks: names of blocks; only contacts of one of these with one of 'blocks'. 'any' stands for "
           "all blocks"),
      text("dip", "two angles [degrees, 0 to 90]: only faces whose inclination to the horizontal lies between them"),
      text("dipdirection",
           "two angles [degrees], counted clockwise from the y axis (north) as seen from above: only faces that "
           "descend in a direction between them"),
      {"kind", T::choice, "models of blocks: only contacts between faces, between balls, or between a ball and a face",
       "faces balls ball-face"}};
  add({"Bond", "Stage",
       "bonds the joints whose faces touch and that fulfil all criteria: they lie in one of its shapes and fit all of "
       "its attributes",
       T::none, of_joints});
  add({"Unbond", "Stage",
       "breaks the bonds of the joints that fulfil all criteria: they lie in one of its shapes and fit all of its "
       "attributes",
       T::none, of_joints});
}

}  // namespace tribo::keywords
