// SPDX-License-Identifier: MIT
/// The names of the dialect of NairnMPM, without regard to what Tribo knows of them: what coverage.cpp looks up.

#include "input/coverage.hpp"

namespace tribo {

const std::vector<DialectNames>& nairnmpm_names() {
  using K = DialectNames::Kind;
  constexpr std::string_view shapes = "Rect Oval Polygon Line Arc Box Sphere Cylinder Torus Shell Polyhedron";
  static const std::vector<DialectNames> all{
      {K::element, "JANFEAInput",
       "Header MPMHeader Mesh MaterialPoints CrackList Material GridBCs ParticleBCs Thermal Gravity CustomTasks"},
      {K::element, "Header", "Description Analysis ConsistentUnits RandSeed DevelFlag"},
      {K::element, "MPMHeader",
       "MPMMethod SkipPostExtrapolation GIMP TimeStep MaxTime TimeFactor TransTimeFactor Timing ArchiveTime "
       "FirstArchiveTime ArchiveGroup GlobalArchiveTime GlobalArchive ArchiveRoot MPMArchiveOrder CrackArchiveOrder "
       "MPMArchive MatlPtsPerElement MultiMaterialMode Cracks Damping PDamping FeedbackDamping PFeedbackDamping "
       "DefGradTerms LeaveLimit DeleteLimit ExtrapolateRigid StressFreeTemp CPDIrcrit ExactTractions RestartScaling "
       "PatchGrid Diffusion Poroelasticity XPIC TrackParticleSpin TrackGradV TransportOnly CrackParticleSize "
       "ShiftCracks Isothermal ContactHeatFlow"},
      {K::element, "Mesh", "Grid NodeList ElementList"},
      {K::element, "Grid", "Horiz Vert Depth AreaOfInterest Border"},
      {K::element, "MaterialPoints", "Body Hole PointList BMP Fill"},
      {K::element, "Body",
       "vel0X vel0Y vel0Z RotateX RotateY RotateZ Unrotate Deform Undeform MatlPtsPerElement Lp0X Lp0Y Lp0Z"},
      {K::element, "Body", shapes},
      {K::element, "Rect", shapes},
      {K::element, "Oval", "arc"},
      {K::element, "Polygon", "pt"},
      {K::element, "PointList", "mp"},
      {K::element, "mp", "pt vel mass"},
      {K::element, "BMP", "Origin Intensity"},
      {K::element, "MultiMaterialMode", "Friction ContactPosition"},
      {K::element, "Cracks", "Friction ContactPosition Propagate AltPropagate PropagateLength MovePlane JContour"},
      {K::element, "CrackList", "pt Line Circle Thickness Plane"},
      {K::element, "GridBCs", "BCShape BCLine BCArc LdRect BCBox DisplacementBCs"},
      {K::element, "ParticleBCs", "BCShape BCLine BCArc LdRect BCBox LoadBCs"},
      {K::element, "BCShape", shapes},
      {K::element, "BCShape", "DisBC TempBC ConcBC LoadBC TractionBC HeatFluxBC ConcFluxBC Damage net perParticle"},
      {K::element, "Gravity", "BodyXForce BodyYForce BodyZForce GridBodyXForce GridBodyYForce GridBodyZForce"},
      {K::element, "Thermal", "Conduction EnergyCoupling ContactHeating CrackContactHeating CrackTipHeating"},
      {K::element, "CustomTasks", "Schedule"},
      {K::element, "Schedule", "Parameter"},

      {K::attribute, "ConsistentUnits", "length mass time"},
      {K::attribute, "GIMP", "type"},
      {K::attribute, "Timing", "step max CFL TransCFL units"},
      {K::attribute, "ArchiveTime", "maxProps units"},
      {K::attribute, "ArchiveGroup", "time start maxProps"},
      {K::attribute, "GlobalArchive", "type material mat matname pt"},
      {K::attribute, "ArchiveRoot", "unique"},
      {K::attribute, "MPMArchive", "result setting"},
      {K::attribute, "Damping", "function PIC"},
      {K::attribute, "PDamping", "function PIC"},
      {K::attribute, "FeedbackDamping", "target max"},
      {K::attribute, "PFeedbackDamping", "target max"},
      {K::attribute, "Mesh", "output"},
      {K::attribute, "Grid", "xmin xmax ymin ymax zmin zmax thickness type units"},
      {K::attribute, "Horiz", "nx cellsize symmin symmax rx style"},
      {K::attribute, "Vert", "ny cellsize symmin symmax ry style"},
      {K::attribute, "Depth", "nz cellsize symmin symmax rz style"},
      {K::attribute, "Body", "mat matname angle thick vx vy vz temp conc wtconc pp"},
      {K::attribute, "mp", "elem mat matname angle thick temp conc lpx lpy lpz"},
      {K::attribute, "pt", "x y z"},
      {K::attribute, "vel", "x y z"},
      {K::attribute, "mass", "m"},
      {K::attribute, "Deform", "dX dY dZ F11 F12 F13 F21 F22 F23 F31 F32 F33"},
      {K::attribute, "Rect", "xmin xmax ymin ymax"},
      {K::attribute, "arc", "start end"},
      {K::attribute, "Line", "x1 y1 x2 y2 xmin ymin xmax ymax tolerance"},
      {K::attribute, "Arc", "xmin xmax ymin ymax start end tolerance"},
      {K::attribute, "Box", "xmin xmax ymin ymax zmin zmax"},
      {K::attribute, "Cylinder", "axis radius"},
      {K::attribute, "Torus", "axis radius"},
      {K::attribute, "BMP", "name width height"},
      {K::attribute, "Material", "Type Name"},
      {K::attribute, "MultiMaterialMode", "Normals RigidBias Azimuth Polar Lumping Vmin Dcheck"},
      {K::attribute, "Friction", "law lawname mat matname Dn Dnt Dnc Dt"},
      {K::attribute, "Propagate", "criterion direction traction"},
      {K::attribute, "MovePlane", "type prevent"},
      {K::attribute, "JContour", "type size terms gridenergy"},
      {K::attribute, "CrackList", "type law lawname Tprop Tpropname friction Dn Dnt Dnc Dt"},
      {K::attribute, "Line", "resolution start_tip end_tip mat"},
      {K::attribute, "Circle", "xmin ymin xmax ymax resolution start_tip end_tip start_angle end_angle mat"},
      {K::attribute, "BCLine", "x1 y1 x2 y2 tolerance"},
      {K::attribute, "BCArc", "x1 y1 x2 y2 start end tolerance"},
      {K::attribute, "LdRect", "xmin xmax ymin ymax"},
      {K::attribute, "BCBox", "xmin xmax ymin ymax zmin zmax axis"},
      {K::attribute, "DisBC", "dir vel disp style time ftime function id angle angle2 depth gradfxn dispfxn"},
      {K::attribute, "TempBC", "value style time function id"},
      {K::attribute, "LoadBC", "dir style load value time ftime function"},
      {K::attribute, "TractionBC", "dir face style stress time function"},
      {K::attribute, "HeatFluxBC", "dir face style value time function"},
      {K::attribute, "Schedule", "name"},
      {K::attribute, "Parameter", "name"},

      {K::command, "",
       "Title Name Comment Header EndHeader Analysis MPMMethod ConsistentUnits TimeStep MaximumTime CFLFactor "
       "ArchiveTime Archive ArchiveUnique GlobalArchiveTime GlobalArchive ToArchive Damping PDamping FeedbackDamping "
       "PFeedbackDamping LeaveLimit DeleteLimit ExtrapolateRigid PtsPerElement CPDIrcrit ExactTractions "
       "StressFreeTemp Processors GridHoriz GridVert GridDepth GridRect GridThickness Element TartanAOI TartanBorder "
       "Region EndRegion Hole EndHole BMPRegion Rect Oval PolyPt Line Arc Box Sphere Cylinder Torus Shell Cut "
       "Transform Rotate AngularMom0 Intensity Origin Fill vel0X vel0Y vel0Z MultimaterialMPM MultimaterialMode "
       "ContactMM ContactPosition ContactCracks ContactPositionCracks Material Done Friction FrictionMM "
       "ImperfectInterface ImperfectInterfaceMM CrackInterface NewCrack GrowCrack GrowCrackLine GrowCrackArc "
       "CrackThickness CrackTractionProp Propagate AltPropagate PropagateLength JContour MovePlane GridBC EndGridBC "
       "Velocity Temperature Concentration PorePressure BoundaryID ParticleBC EndParticleBC Load LoadType Traction "
       "HeatFlux ConcentrationFlux PorePressureFlux Damage PhaseField Gravity Conduction Diffusion Poroelasticity "
       "CustomTask Parameter Entity XMLData EndXMLData MoveLine EndMoveLine MoveArc EndMoveArc MoveBox EndMoveBox "
       "LoadLine EndLoadLine LoadArc EndLoadArc LoadBox EndLoadBox LoadRect EndLoadRect"},
      {K::command, "",
       "If Else EndIf IfStr IfDef IfNDef IfNum Repeat EndRepeat break breakAll continue Sub EndSub return GoSub Write "
       "WriteLine Stop Clear Lines Words"},
      {K::command, "", "Script Open CreateList CreateDictionary UserInput"},

      {K::property, "",
       "rho alpha Cv Cp kCond D beta csat largeRotation Friction shareMatField allowsCracks PDamping color "
       "ArtificialVisc avA1 avA2 KIc KIIc JIc JIIc KIexp KIIexp delIc delIIc nmix initTime speed maxLength xGrow "
       "yGrow constantTip Propagate AltPropagate Ku alphaPE Darcy"},
      {K::property, "",
       "E nu G G1 G2 K Lame UJOption IdealRubber Hardening yield Ep Khard nhard yieldMin Ajc Bjc njc Cjc n2jc Djc "
       "ep0jc Tmjc mjc viscosity logshearrate InitialPressure SetDirection SettingFunction SettingFunction2 "
       "SettingFunction3 ValueFunction SetTemperature SetConcentration mirrored"},
      {K::property, "",
       "coeff coeffStatic Sa Na kmu vhalf LiquidPhase Dn Dnt Dnc Dt normal_shape tangential_shape Npeak Tpeak "
       "displacementOnly Dc"},

      {K::type, "",
       "1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 17 20 22 23 24 25 26 27 28 29 33 34 35 50 51 52 53 54 56 57 58 60 61 62 63 "
       "64 65 66 isotropic mooney isoplasticity vonmises rigid rigidbc"},

      {K::task, "",
       "VTKArchive PeriodicXPIC AdjustTimeStep ReverseLoad PropertyRamp ThermalRamp HistoryArchive DeleteDamaged "
       "LoadControl FluidSource TrackError CarnotCycle"},
      {K::parameter, "VTKArchive",
       "archiveTime firstArchiveTime selectMaterial mass velocity stress strain totalstrain displacement plasticstrain "
       "temperature contactforce volumegradient reactionforce pressure deltav equivstrain equivstress concentration "
       "strainenergy workenergy plasticenergy heatenergy material numpoints"},
      {K::parameter, "PeriodicXPIC",
       "FMPMOrder XPICOrder periodicSteps periodicTime periodicCFL GridBCOption verbose FMPMOrderConduction "
       "periodicStepsDiffusion1"},
      {K::parameter, "AdjustTimeStep", "adjustTime velocityCFL maxIncrease verbose"},
      {K::parameter, "PropertyRamp",
       "property time start Delta DeltaT sigmoidal exponential stretch scale file xorigin yorigin zlevel width height "
       "DeltaMin DeltaMax flipped"},
      {K::parameter, "ReverseLoad", "quantity material mat maxValue minValue maxLength crackNumber style hold"},
      {K::parameter, "HistoryArchive", "archiveTime firstArchiveTime 1"},

      {K::quantity, "",
       "sxx syy szz sxy sxz syz sRR sZZ sTT sRZ exx eyy ezz exy exz eyz eRR eZZ eTT eRZ exxe eyye ezze exye exze eyze "
       "exxp eyyp ezzp exyp exzp eyzp Fxx Fxy Fyx Fyy Fzz velx vely velz velR velZ dispx dispy dispz reactionx "
       "reactiony "
       "reactionz contactx contacty contactz temp concentration alpha heatWatts Entropy Decohesion Energy Lx Ly Lz "
       "Lpx Lpy Lpz px py pz"},
      {K::field, "",
       "velocity stress strain plasticstrain workenergy temperature plasticenergy shearcomponents strainenergy "
       "jintegral stressintensity history1 history9 history19 heatenergy concentration porepressure elementcrossings "
       "rotstrain damagenormal lp wp size czmdisp energybalance"},
  };
  return all;
}

const std::vector<std::string>& nairnmpm_quantities_of_words() {
  static const std::vector<std::string> all{
      "Kinetic Energy",  "Grid Kinetic Energy", "Strain Energy",   "Work Energy",
      "Plastic Energy",  "Heat Energy",         "Internal Energy", "Thermal Energy",
      "Helmholz Energy", "Interface Energy",    "Friction Work",   "External Work",
      "Step number",     "Elapsed time",        "CPU time",        "Potential Energy",
      "history 1"};
  return all;
}

}  // namespace tribo
