// SPDX-License-Identifier: MIT
#include "input/script/commands.hpp"

namespace tribo::script {

const std::vector<RefusedCommand>& refused_commands() {
  constexpr std::string_view diffusion = "diffusion is not implemented", pores = "pore pressure is not implemented",
                             damage = "initial damage is not implemented",
                             tartan = "grids with unequal cells are not implemented",
                             elements = "it belongs to finite element analysis, which Tribo does not do",
                             interface = "it controls the user interface of NairnFEAMPM";
  static const std::vector<RefusedCommand> all{
      {"AltPropagate", "a second criterion for crack growth is not implemented"},
      {"Diffusion", diffusion},
      {"Concentration", diffusion},
      {"ConcentrationFlux", diffusion},
      {"Poroelasticity", pores},
      {"PorePressure", pores},
      {"PorePressureFlux", pores},
      {"Damage", damage},
      {"PhaseField", damage},
      {"AngularMom0", "initial angular momentum is not implemented; use vel0X, vel0Y, vel0Z"},
      {"Shell", "its definition is not documented; use a Cylinder with a Cut Cylinder"},
      {"DeleteLimit", "a particle whose state is not a number stops the run and is not removed"},
      {"ExactTractions", "tractions act at the particles"},
      {"Fill", "it fills a reservoir; FluidSource makes its particles itself, so leave it out"},
      {"TartanAOI", tartan},
      {"TartanBorder", tartan},
      {"Output", elements},
      {"Keypoint", elements},
      {"Keypoints", elements},
      {"Path", elements},
      {"Paths", elements},
      {"Area", elements},
      {"FixLine", elements},
      {"FixPoint", elements},
      {"SelectBC", elements},
      {"Select", elements},
      {"Displacement", elements},
      {"Stress", elements},
      {"Periodic", "it belongs to finite element analysis; for a grid use GridEdge x,periodic"},
      {"CrackTip", elements},
      {"Resequence", elements},
      {"Script", interface},
      {"Open", interface},
      {"OpenFolder", interface},
      {"CreateList", interface},
      {"CreateDictionary", interface},
      {"UserInput", interface}};
  return all;
}

}  // namespace tribo::script
