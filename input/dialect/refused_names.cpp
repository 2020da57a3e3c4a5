// SPDX-License-Identifier: MIT
#include "input/dialect.hpp"

#include "base/text.hpp"

namespace tribo {
namespace {

constexpr std::string_view diffusion = "diffusion is not implemented", pores = "pore pressure is not implemented",
                           tartan = "grids with unequal cells are not implemented",
                           unstructured = "unstructured grids are not implemented",
                           outdated = "it is no longer part of the format",
                           growth = "it belongs to a criterion for the growth of cracks that is not implemented",
                           softening =
                               "softening of anisotropic solids is not implemented; IsoSoftening (50) is the "
                               "isotropic law";

bool listed(std::string_view list, std::string_view word) {
  for (const auto& w : words_of(list))
    if (w == word) return true;
  return false;
}

}  // namespace

const std::vector<RefusedName>& refused_names() {
  static const std::vector<RefusedName> all{
      {"CrackContactHeating", "heat of cracks is not implemented"},
      {"CrackTipHeating", "heat of cracks is not implemented"},
      {"AltPropagate", "a second criterion for crack growth is not implemented"},
      {"Plane", "use <Quad> or <Disc>"},
      {"ConcBC", diffusion},
      {"Diffusion", diffusion},
      {"Poroelasticity", pores},
      {"ConcFluxBC", diffusion},
      {"Damage", "initial damage is not implemented"},
      {"DisplacementBCs", "conditions by node number depend on the node numbering of NairnMPM; use BCShape"},
      {"LoadBCs", "loads by particle number depend on the particle numbering of NairnMPM; use BCShape"},
      {"AreaOfInterest", tartan},
      {"Border", tartan},
      {"Fill", "it fills a reservoir; FluidSource makes its particles itself, so leave it out"},
      {"Shell", "its definition is not documented; use a Cylinder with a Cylinder cut out"},
      {"Polyhedron", "use <STL>"},
      {"RestartScaling", "runs are resumed with 'tribo resume'"},
      {"DeleteLimit", "a particle whose state is not a number stops the run and is not removed"},
      {"ExactTractions", "tractions act at the particles"},
      {"PatchGrid", "the grid is divided among threads automatically"},
      {"NodeList", unstructured},
      {"ElementList", unstructured},
      {"DevelFlag", "it is a development switch of NairnMPM"},
      {"XPIC", "use <Transfer> or the task PeriodicXPIC"},
      {"Isothermal", outdated},
      {"ContactHeatFlow", outdated},
      {"TrackParticleSpin", outdated},
      {"TrackGradV", outdated},
      {"TransportOnly", outdated},
      {"ShiftCracks", outdated},
      {"CrackParticleSize", outdated},
      {"Lp0X", outdated},
      {"Lp0Y", outdated},
      {"Lp0Z", outdated},
  };
  return all;
}

const std::vector<RefusedAttribute>& refused_attributes() {
  static const std::vector<RefusedAttribute> all{
      {"Damping PDamping", "PIC", "a fraction of PIC is set by <Transfer type='blend' fraction=''/>"},
      {"Body mp Intensity", "conc wtconc", diffusion},
      {"Body mp Intensity", "pp", pores},
      {"GIMP", "gridz", outdated},
  };
  return all;
}

const std::vector<RefusedName>& refused_properties() {
  static const std::vector<RefusedName> all{
      {"D", diffusion},
      {"beta", diffusion},
      {"csat", diffusion},
      {"Ku", pores},
      {"alphaPE", pores},
      {"Darcy", pores},
      {"avA1", "artificial viscosity is not implemented"},
      {"avA2", "artificial viscosity is not implemented"},
      {"ArtificialVisc", "artificial viscosity is not implemented"},
      {"AltPropagate", "a second criterion for crack growth is not implemented"},
      {"Kk", "relaxation of the bulk modulus is not implemented"},
      {"tauKk", "relaxation of the bulk modulus is not implemented"},
      {"pressureLaw", "a law of pressure besides that of the bulk modulus is not implemented"},
      {"gamma0", "the Mie-Grueneisen equation of state is not implemented"},
      {"C0", "the Mie-Grueneisen equation of state is not implemented"},
      {"S1", "the Mie-Grueneisen equation of state is not implemented"},
      {"S2", "the Mie-Grueneisen equation of state is not implemented"},
      {"S3", "the Mie-Grueneisen equation of state is not implemented"},
      {"Kmax", "the Mie-Grueneisen equation of state is not implemented"},
      {"swapz", "choose the axial direction by the type: Transverse1 (2) is z, Transverse2 (3) is y"},
      {"IdealRubber", "it is not implemented"},
      {"InitialPressure", "an initial pressure of a liquid is not implemented; let gravity grow slowly"},
      {"JIIc", growth},
      {"delIc", growth},
      {"delIIc", growth},
      {"nmix", growth},
      {"initTime", growth},
      {"speed", growth},
      {"maxLength", growth},
      {"xGrow", growth},
      {"yGrow", growth},
      {"constantTip", growth},
      {"allowsCracks", "cracks act on every material that they cut"},
      {"ValueFunction", "rigid particles that set a temperature are not implemented; use <TempBC>"},
      {"SetTemperature", "rigid particles that set a temperature are not implemented; use <TempBC>"},
      {"SetConcentration", diffusion},
      {"displacementOnly", outdated},
      {"Dc", outdated},
  };
  return all;
}

const std::vector<RefusedType>& refused_types() {
  static const std::vector<RefusedType> all{
      {"5 6 tiviscoelastic",
       "viscoelasticity of transversely isotropic solids is not implemented; Viscoelastic (7) is the isotropic law"},
      {"10 bistable bistableisotropic", "a bistable solid is not implemented"},
      {"15 hill hillplastic", "anisotropic plasticity is not implemented; IsoPlasticity (9) is the isotropic law"},
      {"17 25 mgeos heosmaterial", "the Mie-Grueneisen equation of state is not implemented"},
      {"24 heisotropic", "hyperelastic plasticity is not implemented; IsoPlasticity (9) is for large strains too"},
      {"29", "the clamped neo-Hookean solid is not implemented; NeoHookean (28) is"},
      {"53 isoplasticsoftening",
       "plasticity together with softening is not implemented; IsoPlasticity (9) and IsoSoftening (50) are the laws "
       "with one of them"},
      {"51 52 54 56 transisosoftening transisosoftening1 transisosoftening2 orthosoftening "
       "orthoplasticsoftening",
       softening},
      {"57 isophasefieldsoftening",
       "phase-field fracture is not implemented; IsoSoftening (50) has a fracture energy too"},
      {"58 isodamagemechanics", "this law is not implemented; IsoSoftening (50) is a law of isotropic damage"},
      {"66 debondinginterface", "it is not implemented; NonlinearInterface (65) and joint laws can break"},
  };
  return all;
}

const std::vector<RefusedName>& refused_tasks() {
  static const std::vector<RefusedName> all{
      {"TrackError", "'tribo report' and energy.csv show the errors of a run"},
      {"CarnotCycle", "cycles of an ideal gas are not implemented; 'tribo drive' drives a law along any path"},
  };
  return all;
}

const std::vector<RefusedName>& refused_outputs() {
  static const std::vector<RefusedName> all{
      {"concentration", diffusion},
      {"porepressure", pores},
      {"shearcomponents", "the deformation gradient has them: 'deformation_gradient'"},
      {"damagenormal", "the history variables of a law with damage have it"},
      {"lp", "particles have no spin"},
      {"wp", "particles have no spin"},
      {"size", "the volume of a particle is 'volume'"},
      {"czmdisp", "joints.pvd has the displacements of cohesive zones: 'opening' and 'shear'"},
      {"energybalance", outdated},
      {"Entropy", "it is not implemented"},
      {"Helmholz Energy", "it is not implemented"},
      {"Thermal Energy", "it is not implemented; 'Heat Energy' is"},
      {"heatWatts", "it is not implemented; 'Heat Supplied' is its integral"},
      {"numpoints", "it is not implemented"},
      {"volumegradient", "it is not implemented; the contact normals of particles are 'contact_normal'"},
      {"reactionforce", "reactions are columns of history.csv: 'reactionx'"},
      {"equivstrain", "it is not implemented; 'strain' is"},
  };
  return all;
}

std::string_view reason_against_word(std::string_view element, std::string_view word) {
  constexpr std::string_view shape = "this shape function is not implemented; use uGIMP, lCPDI, B2SPLINE or B3SPLINE";
  struct Word {
    std::string_view element, words, reason;
  };
  static constexpr Word all[] = {{"GIMP", "qcpdi 3 finite 4 b2gimp 5 b2cpdi 7", shape},
                                 {"Analysis", "0 1 2", "finite element analysis is not what Tribo does"}};
  for (const Word& w : all)
    if (w.element == element && listed(w.words, lower(word))) return w.reason;
  return {};
}

std::string_view reason_against(const std::vector<RefusedName>& list, std::string_view name) {
  for (const RefusedName& r : list)
    if (lower(r.name) == lower(name)) return r.reason;
  return {};
}

std::string_view reason_against_attribute(std::string_view element, std::string_view attribute) {
  for (const RefusedAttribute& r : refused_attributes())
    if (listed(r.elements, element) && listed(r.names, attribute)) return r.reason;
  return {};
}

std::string_view reason_against_type(std::string_view word) {
  for (const RefusedType& r : refused_types())
    if (listed(r.words, lower(word))) return r.reason;
  return {};
}

}  // namespace tribo
