// SPDX-License-Identifier: MIT
#include "input/dialect.hpp"

namespace tribo {

const std::vector<RefusedName>& refused_names() {
  static const std::vector<RefusedName> all{
      {"CrackContactHeating", "heat of cracks is not implemented"},
      {"CrackTipHeating", "heat of cracks is not implemented"},
      {"AltPropagate", "a second criterion for crack growth is not implemented"},
      {"MovePlane", "cracks always move with the mean of their two faces"},
      {"ConcBC", "diffusion is not implemented"},
      {"Diffusion", "diffusion is not implemented"},
      {"Poroelasticity", "pore pressure is not implemented"},
      {"ConcFluxBC", "diffusion is not implemented"},
      {"Damage", "damage is not implemented"},
      {"DisplacementBCs", "conditions by node number depend on the node numbering of NairnMPM; use BCShape"},
      {"LoadBCs", "loads by particle number depend on the particle numbering of NairnMPM; use LdShape"},
      {"AreaOfInterest", "grids with unequal cells are not implemented"},
      {"Border", "grids with unequal cells are not implemented"},
      {"Fill", "particle reservoirs are not implemented"},
      {"Shell", "its definition is not documented; use a Cylinder with a Cylinder cut out"},
      {"Polyhedron", "use <STL>"},
      {"RestartScaling", "runs are resumed with 'tribo resume'"},
      {"DeleteLimit", "particles are never deleted; use LeaveLimit"},
      {"ExtrapolateRigid", "rigid particles always act through extrapolated velocities"},
      {"ExactTractions", "tractions act at the particles"},
      {"PatchGrid", "the grid is divided among threads automatically"},
      {"NodeList", "unstructured grids are not implemented"},
      {"ElementList", "unstructured grids are not implemented"},
      {"DevelFlag", "it is a development switch of NairnMPM"},
      {"XPIC", "use <Transfer> or the task PeriodicXPIC"},
      {"Isothermal", "it is no longer part of the format"},
      {"ContactHeatFlow", "it is no longer part of the format"},
      {"TrackParticleSpin", "it is no longer part of the format"},
      {"TrackGradV", "it is no longer part of the format"},
      {"TransportOnly", "it is no longer part of the format"},
      {"ShiftCracks", "it is no longer part of the format"},
      {"CrackParticleSize", "it is no longer part of the format"},
      {"Lp0X", "it is no longer part of the format"},
      {"Lp0Y", "it is no longer part of the format"},
      {"Lp0Z", "it is no longer part of the format"},
  };
  return all;
}

}  // namespace tribo
