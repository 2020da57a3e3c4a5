// SPDX-License-Identifier: MIT
/// Forms of the dialect of NairnMPM, in XML and in scripts, and names that Tribo refuses.

#include "input/coverage.hpp"
#include "input/format_version.hpp"
#include "input/read.hpp"
#include "input/script/script.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>

using namespace tribo;
using Catch::Contains;

namespace {

// A small model in XML with additions.
std::string xml(const std::string& sections, const std::string& header = "", const std::string& property = "",
                const std::string& cells = "") {
  return "<JANFEAInput version='3'><Header><Analysis>10</Analysis><ConsistentUnits length='mm' mass='g' "
         "time='ms'/></Header><MPMHeader><GIMP/><MaxTime>1</MaxTime><ArchiveTime>0.5</ArchiveTime>" +
         header + "</MPMHeader><Mesh><Grid xmin='0' xmax='4' ymin='0' ymax='4'><Horiz nx='4'" + cells +
         "/><Vert ny='4'/></Grid></Mesh><MaterialPoints><Body matname='m'><Rect xmin='1' xmax='2' ymin='1' "
         "ymax='2'/></Body></MaterialPoints><Material Type='1' Name='m'><rho>1</rho><E>1</E><nu>.3</nu>" +
         property + "</Material>" + sections + "</JANFEAInput>";
}

// The same as a script: `before` the material, in it, and at the end.
std::string deck(const std::string& before, const std::string& after = "", const std::string& property = "",
                 const std::string& units = "ConsistentUnits mm,g,ms") {
  return "Analysis \"Plane Strain MPM\"\n" + units + "\nMaximumTime 1\nGridHoriz 4\nGridVert 4\nGridRect 0,4,0,4\n" +
         before + "\nMaterial \"m\",\"rubber\",\"Isotropic\"\nrho 1\nE 1\nnu .3\n" + property +
         "\nDone\nRegion \"m\",0,0,1\nRect 1,2,1,2\nEndRegion\n" + after + "\n";
}
const std::string half = "ArchiveTime 0.5\n";

Model read(const std::string& text) { return read_model_text(text, "deck"); }

std::string problems_of(const std::string& text) {
  try {
    read(text);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

std::string warnings(const std::string& text) {
  std::string all;
  for (const auto& w : read(text).warnings) all += w + "\n";
  return all;
}

std::string on_nodes(const std::string& commands) { return "GridBC\nRect 0,4,0,4\n" + commands + "\nEndGridBC"; }
std::string on_particles(const std::string& commands) {
  return "ParticleBC\nRect 1,2,1,2\n" + commands + "\nEndParticleBC";
}

}  // namespace

TEST_CASE("no name of the dialect is unknown", "[dialect]") {
  std::size_t known = 0;
  for (const Coverage& c : coverage()) {
    INFO(c.name << " in " << c.inside);
    CHECK(c.state != Coverage::State::unknown);
    known += c.state == Coverage::State::known;
  }
  CHECK(known > 400);
}

TEST_CASE("the version of the format is three whole numbers, and a file may state an older one", "[dialect]") {
  CHECK(format_version("3") == FormatVersion{3, 0, 0});
  CHECK(format_version("3.10") == FormatVersion{3, 10, 0});
  CHECK(format_version("0.2.7") == FormatVersion{0, 2, 7});
  CHECK(*format_version("3.10") > *format_version("3.9.9"));
  for (const char* wrong : {"", " ", "3.", ".3", "3..1", "3.1.0.0", "03", "3.01", "+3", "-3", "3.1-beta", "v3", "3 ",
                            "99999999999", "3,1"}) {
    INFO(wrong);
    CHECK(!format_version(wrong));
  }
  CHECK(format_version_text({3, 2, 0}) == "3.2");
  CHECK(format_version_text({3, 2, 1}) == "3.2.1");

  const std::string newest = format_version_text(newest_format);
  const auto with = [](const std::string& version) {
    std::string text = xml("");
    return text.replace(text.find("version='3'"), 11, "version='" + version + "'");
  };
  for (const std::string& version : {std::string("2"), std::string("3"), std::string("3.0.4"), newest}) {
    INFO(version);
    CHECK(problems_of(with(version)).empty());
    CHECK(problems_of(deck(half + "Version " + version)).empty());
  }
  FormatVersion after = newest_format;
  ++after.patch;
  const std::string next = format_version_text(after);
  const std::string refused = " is " + next + ", but this program reads the format up to version " + newest + ";";
  CHECK_THAT(problems_of(with(next)), Contains("deck:1:14: error: attribute 'version' of <JANFEAInput>" + refused));
  CHECK_THAT(problems_of(with("3.x")), Contains("must be one to three whole numbers"));
  // Six lines and the one of `half` precede it.
  CHECK_THAT(problems_of(deck(half + "Version " + next)), Contains("deck:8:9: error: the version" + refused));
  CHECK_THAT(problems_of(xml("<Commands>Version 3</Commands>")),
             Contains("in an XML file the version is that of <JANFEAInput>"));

  // The XML of a script states what the script states.
  Settings none;
  const auto root = [&](const std::string& text) {
    return read_script(text, std::make_shared<const std::string>("deck"), none).root.attribute("version")->text;
  };
  CHECK(root(deck(half)) == "3");
  CHECK(root(deck(half + "Version 3.2")) == "3.2");
}

TEST_CASE("BCShape selects particles, and scripts write it", "[dialect]") {
  for (const char* name : {"BCShape", "LdShape"}) {
    const std::string tag = name;
    const Model m = read(xml("<ParticleBCs><" + tag +
                             "><Rect xmin='1' xmax='2' ymin='1' ymax='2'/><net/>"
                             "<LoadBC dir='1' load='3'/></" +
                             tag + "></ParticleBCs>"));
    REQUIRE(m.particle_conditions.size() == 1);
    CHECK(m.particle_conditions[0].net);
  }
  Settings none;
  const Script s =
      read_script(deck(half, on_particles("Load x,constant,3")), std::make_shared<const std::string>("s"), none);
  CHECK(s.root.child("ParticleBCs")->children.front().name == "BCShape");
  CHECK_THAT(
      problems_of(xml("<ParticleBCs><BCShape><Rect xmin='1' xmax='2' ymin='1' ymax='2'/><DisBC dir='1'/></BCShape>"
                      "</ParticleBCs>")),
      Contains("<DisBC> belongs into <GridBCs>"));
  CHECK_THAT(problems_of(deck(half, on_particles("LoadType net"))), Contains("'ParticleBC' selects particles"));
  CHECK_THAT(problems_of(xml("<GridBCs><BCLine x1='0' y1='0' x2='4' y2='0'><net/><DisBC dir='1'/></BCLine></GridBCs>")),
             Contains("<net> is about loads"));
}

TEST_CASE("older blocks of conditions", "[dialect]") {
  const Model m = read(deck(half,
                            "MoveLine 0,0,4,0,0.1\nVelocity x,constant,2\nEndMoveLine\n"
                            "MoveArc 1,1,3,3,0,360\nVelocity y,constant,0\nEndMoveArc\n"
                            "LoadLine 1,1.25,2,1.25,-1\nLoad y,constant,5\nEndLoadLine\n"
                            "LoadRect 1,2,1,2\nLoad x,constant,1\nEndLoadRect"));
  REQUIRE(m.node_conditions.size() == 2);
  CHECK(m.node_conditions[0].where->contains({3, 0.05, 0}));
  CHECK_FALSE(m.node_conditions[0].where->contains({3, 1, 0}));
  CHECK(m.node_conditions[1].where->contains({3, 2, 0}));
  REQUIRE(m.particle_conditions.size() == 2);
  CHECK(m.particle_conditions[0].where->contains({1.5, 1.25, 0}));
  const Model arc =
      read(xml("<GridBCs><BCArc x1='3' y1='3' x2='1' y2='1' start='0' end='360'><DisBC dir='1'/></BCArc>"
               "</GridBCs>"));
  CHECK(arc.node_conditions[0].where->contains({3, 2, 0}));
  CHECK_THAT(problems_of(deck(half, "MoveLine 0,0,4,0\nVelocity x,constant,2\nEndLoadLine")),
             Contains("'EndLoadLine' closes nothing"));
}

TEST_CASE("variables of loops may be quoted", "[dialect]") {
  Settings none;
  const auto file = std::make_shared<const std::string>("s");
  CHECK(read_script("Repeat \"#i\",1,3\nWrite #i\nEndRepeat\n" + deck(half), file, none).output == "123");
  CHECK_THAT(problems_of("Repeat \"3\",1,3\nEndRepeat\n" + deck(half)), Contains("the name of a variable is needed"));
}

TEST_CASE("values that are left out are zero", "[dialect]") {
  const Model m = read(deck(half, on_nodes("Velocity y,constant") + "\n" + on_particles("Load x,constant")));
  CHECK(m.node_conditions.at(0).velocity.value == 0);
  CHECK(m.particle_conditions.at(0).value.value == 0);
  CHECK_THAT(problems_of(deck(half, on_nodes("Velocity y,function"))), Contains("needs the attribute 'function'"));
}

TEST_CASE("times between files in one or several commands", "[dialect]") {
  const auto groups = [](const std::string& commands, const std::string& units = "ConsistentUnits mm,g,ms") {
    return read(deck(commands, "", "", units)).output.archive;
  };
  CHECK(groups("Archive \"results/a\",0.25").at(0).interval == 0.25);
  const auto first = groups("ArchiveUnique \"a\",0.25,0.5");
  REQUIRE(first.size() == 2);
  CHECK(first[1].start == 0.5);
  CHECK(first[1].interval == 0.25);
  const auto two = groups("ArchiveTime 0.25\nArchiveTime 0.125,0.5");
  REQUIRE(two.size() == 2);
  CHECK(two[1].start == 0.5);
  CHECK(two[1].interval == 0.125);
  CHECK(groups("ArchiveTime 0.25\nArchiveTime 0.125,0.5", "").at(1).start == Approx(0.5e-3));  // ms
  CHECK_THAT(problems_of(deck("ArchiveTime 0.25\nArchiveTime 0.125")), Contains("needs the time from which on"));
  CHECK_THAT(problems_of(deck("ArchiveTime 0.25,0.6\nArchiveTime 0.125,0.5")),
             Contains("before the start of the next"));
}

TEST_CASE("a traction with a function in its fourth or sixth argument", "[dialect]") {
  for (const char* command : {"Traction normal,2,function,\"2*t\",0.5", "Traction normal,2,function,0,0.5,\"2*t\""}) {
    const Prescribed p = read(deck(half, on_particles(command))).particle_conditions.at(0).value;
    CHECK(p.style->function);
    CHECK(p.time == 0.5);
    Variables at;
    at.t = 3;
    CHECK(p.function(at) == 6);
  }
  CHECK_THAT(problems_of(deck(half, on_particles("Traction normal,2,constant,1,0,\"2*t\""))),
             Contains("belongs to the style 'function'"));
  CHECK_THAT(warnings(deck(half, on_particles("Traction normal,2,constant,1,0,-1\nLoad x,constant,1,0,-1"))),
             Contains("argument of 'Traction', '-1', has no effect") && Contains("argument of 'Load'"));
  CHECK_THAT(problems_of(deck(half, on_particles("Traction normal,2,function,1,0,\"2*t\""))),
             Contains("no value besides its function"));
}

TEST_CASE("damping with a fraction of PIC, and Courant numbers", "[dialect]") {
  CHECK(read(deck(half + "Damping 2,0")).damping.grid);
  CHECK_THAT(problems_of(deck(half + "Damping 2,0.25")), Contains("write 'Transfer blend,0.75'"));
  CHECK_THAT(problems_of(xml("", "<Damping PIC='0.2'>1</Damping>")), Contains("<Transfer type='blend'"));
  CHECK_THAT(problems_of(deck(half + "CFLFactor -1")), Contains("'CFLFactor' must be in (0, 1]"));
  CHECK(read(xml("", "<Timing CFL='0.4' TransCFL='0.3' max='1' step='1'/>")).time.transport_courant == 0.3);
}

TEST_CASE("ratios of cells must be one", "[dialect]") {
  CHECK(problems_of(xml("", "", "", " rx='1' style='G'")).empty());
  CHECK_THAT(problems_of(xml("", "", "", " rx='1.1'")), Contains("grids with unequal cells are not implemented"));
  CHECK_THAT(problems_of(xml("", "", "", " ry='1'")), Contains("<Horiz> does not take ry"));
}

TEST_CASE("heat: directions of a flux, options of conduction, coupling without effect", "[dialect]") {
  const std::string heat = "Cv 1\nkCond 1";
  CHECK(read(deck(half + "Conduction yes", on_particles("HeatFlux external,2,constant,4"), heat))
            .particle_conditions.at(0)
            .value.value == 4);
  CHECK_THAT(problems_of(deck(half + "Conduction yes", on_particles("HeatFlux coupled,2,function,\"q\""), heat)),
             Contains("(coupled, direction 2) is not implemented"));
  const Model m = read(deck(half + "MultimaterialMPM\nConduction yes,\"mechanical energy\",friction", "", heat));
  CHECK(m.heat.contact_heating);
  CHECK(m.heat.work_heating);
  CHECK_THAT(problems_of(deck(half + "Conduction yes,\"crack tips\"", "", heat)), Contains("heat of cracks"));
  CHECK_THAT(warnings(xml("<Thermal><EnergyCoupling/></Thermal>", "", "<Cv>1</Cv>")),
             Contains("none of these materials dissipates: it has no effect"));
}

TEST_CASE("gravity as numbers and functions; along y it has a default", "[dialect]") {
  CHECK(read(deck(half + "Gravity")).body_force.gravity[1] == Approx(-9.80665e-3));  // mm/ms^2
  const Model m = read(deck(half + "Gravity 1,\"-2*t\""));
  CHECK(m.body_force.gravity == Vec3(1, 0, 0));
  CHECK(m.body_force.function[1]);
  CHECK(read(deck(half + "Gravity 0")).body_force.gravity[1] == Approx(-9.80665e-3));
  CHECK_THAT(warnings(deck(half + "Gravity 0")), Contains("write 'Gravity 0,0' for none"));
}

TEST_CASE("settings of cracks that say what Tribo does", "[dialect]") {
  const std::string crack = "<CrackList><pt x='1.5' y='1'/><pt x='1.5' y='2'/></CrackList>";
  CHECK_THAT(warnings(xml(crack, "<Cracks><ContactPosition>0.8</ContactPosition></Cracks>")),
             Contains("<ContactPosition> has no effect on cracks"));
  CHECK_THAT(warnings(xml("", "<Cracks><ContactPosition>0.8</ContactPosition></Cracks>")),
             Contains("<Cracks> without a <CrackList> has no effect"));
  CHECK(
      problems_of(xml(crack, "<Cracks><MovePlane type='avg' prevent='no'/><Thickness>1</Thickness></Cracks>")).empty());
  CHECK_THAT(problems_of(xml(crack, "<Cracks><MovePlane type='cm'/></Cracks>")), Contains("is not implemented"));
  CHECK_THAT(problems_of(xml(crack, "<Cracks><Thickness>2</Thickness></Cracks>")), Contains("as thick as the grid, 1"));
  CHECK(problems_of(deck(half + "ContactPositionCracks 0.8\nMovePlane avg",
                         "NewCrack 1.5,1\nCrackThickness 1\n"
                         "GrowCrack 1.5,2"))
            .empty());
}

TEST_CASE("traction laws of cracks and of their parts", "[dialect]") {
  const std::string law =
      "<Material Type='14' Name='glue'><sigmaI>1</sigmaI><JIc>1</JIc><sigmaII>1</sigmaII><JIIc>1"
      "</JIIc></Material>";
  const auto crack = [&](const std::string& attributes, const std::string& parts) {
    return xml("<CrackList " + attributes + ">" + parts + "</CrackList>" + law);
  };
  const std::string notch = "<Line xmin='1.5' ymin='0.5' xmax='1.5' ymax='1.5' resolution='2'/>";
  const std::string bonded = "<Line xmin='1.5' ymin='1.5' xmax='1.5' ymax='2.5' resolution='3' mat='2'/>";
  {  // parts with different laws are cracks with common ends
    const Model m = read(crack("", notch + bonded));
    REQUIRE(m.cracks.size() == 2);
    CHECK(m.cracks[0].joint == nullptr);
    CHECK(m.cracks[0].law != nullptr);
    CHECK(m.cracks[0].pieces.size() == 2);
    CHECK(m.cracks[1].joint == m.materials[1].joint);
    CHECK(m.cracks[1].law == nullptr);
    CHECK(m.cracks[1].points.size() == 4);
    CHECK(m.cracks[0].points.back() == m.cracks[1].points.front());
    CHECK(m.cracks[0].ends[1] == CrackSpec::End::none);
  }
  CHECK(read(crack("Tprop='2'", notch + bonded)).cracks.size() == 1);
  CHECK(read(crack("Tpropname='glue'", notch)).cracks.at(0).joint != nullptr);
  CHECK(read(crack("Tprop='0'", notch)).cracks.at(0).joint == nullptr);
  CHECK(read(crack("lawname='glue'", notch)).cracks.at(0).joint != nullptr);
  CHECK(read(crack("", "<pt x='1.5' y='0.5'/><pt x='1.5' y='1.2' matname='glue'/><pt x='1.5' y='2'/>")).cracks.size() ==
        2);
  CHECK(read(crack("", "<pt x='1.5' y='0.5' mat='2'/><pt x='1.5' y='1.2'/><pt x='1.5' y='2'/>")).cracks.size() == 2);
  CHECK_THAT(problems_of(crack("Tprop='1'", notch)), Contains("is no traction law; valid types"));
  CHECK_THAT(problems_of(crack("Tprop='7'", notch)), Contains("there is no material number '7'"));
  CHECK_THAT(warnings(crack("friction='0.2' Tprop='2'", notch)), Contains("its contact law has no effect"));

  const std::string glue = "Material \"g\",\"glue\",\"TriangularTraction\"\nsigmaI 1\nJIc 1\nsigmaII 1\nJIIc 1\nDone\n";
  const auto script = [&](const std::string& commands) { return read(deck(half + glue, commands)); };
  const Model parts = script("NewCrack 1.5,0.5\nGrowCrackLine 1.5,1.5,2\nGrowCrackLine 1.5,2.5,3,\"free\",\"g\"");
  REQUIRE(parts.cracks.size() == 2);
  CHECK(parts.cracks[1].joint != nullptr);
  CHECK(parts.cracks[1].ends[1] == CrackSpec::End::none);
  CHECK(script("NewCrack 1.5,0.5,\"m\",\"g\"\nGrowCrack 1.5,1.5").cracks.at(0).joint != nullptr);
  CHECK(script("NewCrack 1.5,0.5,\"free\",\"traction\",\"g\"\nGrowCrack 1.5,1.5").cracks.at(0).joint != nullptr);
  CHECK(script("NewCrack 1.5,0.5\nGrowCrack 1.5,1.5,\"free\",\"g\"").cracks.at(0).joint != nullptr);
  CHECK(script("NewCrack 1.5,0.5\nCrackTractionProp \"g\"\nGrowCrack 1.5,1.5").cracks.at(0).joint != nullptr);
}

TEST_CASE("a load that a feedback controls", "[dialect]") {
  const std::string grip = "Material \"g\",\"grip\",\"Rigid\"\nSetDirection 1\nDone\n";
  const std::string task =
      "CustomTask LoadControl\nParameter material,\"g\"\nParameter direction,1\n"
      "Parameter Load_Function,\"3*t\"\nParameter velocity,2\nParameter MaxVelocity,9\n";
  const std::string body = "Region \"g\",2,0,1\nRect 2,3,1,2\nEndRegion\n";
  const Model m = read(deck(half + grip, body + task + "Parameter Kp,4\nParameter Ki,5"));
  REQUIRE(m.load_control);
  CHECK(m.load_control->material == 0);
  CHECK(m.load_control->axis == 0);
  CHECK(m.load_control->start == 2);
  CHECK(m.load_control->fastest == 9);
  CHECK(m.load_control->Kp == 4);
  CHECK(m.load_control->Ki == 5);
  CHECK_THAT(problems_of(deck(half + grip, body + task)), Contains("needs 'Kp' > 0"));
  CHECK_THAT(problems_of(deck(half,
                              "CustomTask LoadControl\nParameter material,\"m\"\nParameter Load_Function,\"3\"\n"
                              "Parameter velocity,1\nParameter Kp,1")),
             Contains("moves a rigid material; 'rubber' is none"));
  CHECK_THAT(problems_of(deck(half, "CustomTask LoadControl\nParameter Kp,1")), Contains("needs 'material'"));
}

TEST_CASE("older forms of laws in scripts", "[dialect]") {
  const std::string crack = "NewCrack 1.5,1\nGrowCrack 1.5,2";
  const auto law = [](const Model& m) { return m.cracks.at(0).law; };
  CHECK(law(read(deck(half + "Friction 0.3", crack))));
  CHECK_FALSE(law(read(deck(half + "Friction ignore", crack))));
  CHECK(law(read(deck(half + "ImperfectInterface 1e3,2e3", crack)))->interface());
  CHECK(law(read(deck(half, crack + "\nCrackInterface 1e3,2e3,3e3")))->interface());
  const std::string other = "Material \"o\",\"other\",\"Isotropic\"\nrho 1\nE 1\nnu .3\nDone\n";
  CHECK(read(deck(half + "MultimaterialMPM\n" + other, "", "Friction 0.3,\"o\"")).contact.pair_laws.size() == 1);
  CHECK(read(deck(half + "MultimaterialMPM\n" + other, "", "ImperfectInterface 1e3,2e3,3e3,\"o\""))
            .contact.pair_laws.begin()
            ->second->interface());
  CHECK_THAT(problems_of(deck(half + "MultimaterialMPM\n" + other, "", "Friction 0.3")),
             Contains("needs the other material of the pair as second argument"));
}

TEST_CASE("materials may be named before they are defined", "[dialect]") {
  const std::string liquid = "Material \"w\",\"water\",\"TaitLiquid\"\nrho 1\nK 1\nviscosity 1\nDone";
  const std::string law = "Material \"law\",\"drag\",\"LiquidContact\"\nLiquidPhase \"w\"\nDone\n";
  CHECK(read(deck(half + "MultimaterialMPM\nContactMM \"law\"\nGlobalArchive velx,\"m\"\n" + law, liquid))
            .contact.default_law->liquid() == 3);
  CHECK(read(deck(half + "MultimaterialMPM\nContactMM \"law\"\n" + liquid + "\n" +
                  "Material \"law\",\"drag\",\"LiquidContact\"\nLiquidPhase 1\nDone"))
            .contact.default_law->liquid() == 1);
}

TEST_CASE("properties of anisotropic materials in scripts", "[dialect]") {
  const std::string wood =
      "Material \"w\",\"wood\",\"Orthotropic\"\nrho 1\nEx 1\nEy 2\nEz 3\nnuxy .1\nnuxz .1\nnuyz "
      ".1\nGxy 1\nGxz 1\nGyz 1\nax 20\nay 40\naz 60\nDone\n";
  CHECK(problems_of(deck(half + wood)).empty());
  CHECK_THAT(problems_of(deck(half + wood, "CustomTask ThermalRamp\nParameter DeltaT,5\nParameter time,1")),
             Contains("thermal expansion of anisotropic materials is not implemented"));
  CHECK_THAT(problems_of(deck(half + "MPMMethod USL-,qCPDI")), Contains("this shape function is not implemented"));
  const auto turned = [](const std::string& property, const std::string& type) {
    return problems_of(
        "Analysis \"3D MPM\"\nConsistentUnits mm,g,ms\nMaximumTime 1\nArchiveTime 1\nGridHoriz 4\nGridVert "
        "4\nGridDepth 4\nGridRect 0,4,0,4,0,4\nMaterial \"m\",\"m\",\"" +
        type + "\"\nrho 1\n" + property + "\nDone\nRegion \"m\",0,0,0\nRotate y,90\nBox 1,2,1,2,1,2\nEndRegion\n");
  };
  CHECK(turned("E 1\nnu .3", "Isotropic").empty());
  CHECK_THAT(turned("EA 1\nET 1\nGA 1\nnuA .1\nnuT .1", "Transverse"),
             Contains("rotates material axes out of the plane"));
}

TEST_CASE("names that are refused have a reason", "[dialect]") {
  CHECK_THAT(problems_of(xml("", "", "<csat>1</csat>")), Contains("<csat> is not supported by Tribo: diffusion"));
  for (const char* type : {"TIViscoelastic", "HillPlastic", "IsoPlasticSoftening"})
    CHECK_THAT(problems_of(deck(half + "Material \"other\",\"Other\",\"" + type + "\"\nrho 1\nDone")),
               Contains("material type '" + std::string(type) + "' is not supported by Tribo: "));
  CHECK_THAT(problems_of(deck(half, "", "Darcy 1")), Contains("pore pressure is not implemented"));
  CHECK_THAT(problems_of(xml("<CustomTasks><Schedule name='CarnotCycle'/></CustomTasks>")), Contains("not supported"));
  CHECK_THAT(problems_of(xml("", "<GlobalArchive type='Entropy'/>")), Contains("'Entropy' is not supported"));
  CHECK_THAT(warnings(deck(half + "ToArchive velocity,damagenormal")), Contains("'damagenormal' is not written"));
  CHECK(problems_of(deck(half + "Diffusion no")).empty());
  CHECK(problems_of(xml("", "", "<allowsCracks>1</allowsCracks>")).empty());
  CHECK_FALSE(problems_of(xml("", "", "<allowsCracks>0</allowsCracks>")).empty());
}

TEST_CASE("tasks that write files select fields", "[dialect]") {
  const Model m = read(deck(half,
                            "CustomTask VTKArchive\nParameter \"mass\"\nParameter \"stress\"\nParameter "
                            "\"totalstrain\"\nParameter \"deltav\"\nCustomTask HistoryArchive\nParameter 3"));
  CHECK(m.output.grid_fields == std::vector<std::string>{"mass"});
  const auto& fields = m.output.particle_fields;
  const auto count = [&](const char* name) { return std::count(fields.begin(), fields.end(), name); };
  CHECK(count("strain") == 1);
  CHECK(count("stress") == 1);  // with all other standard fields
  CHECK(count("velocity") == 1);
  const std::string task = "<CustomTasks><Schedule name='VTKArchive'><Parameter name='archiveTime'>";
  CHECK(warnings(xml(task + "0.5</Parameter></Schedule></CustomTasks>")).empty());
  CHECK_THAT(warnings(xml(task + "0.1</Parameter><Parameter name='numpoints'/></Schedule></CustomTasks>")),
             Contains("'archiveTime' of a task has no effect") && Contains("'numpoints' of VTKArchive is not written"));
}

TEST_CASE("a ramp of the temperature", "[dialect]") {
  const Model m =
      read(xml("<CustomTasks><Schedule name='ThermalRamp'><Parameter name='time'>0.5</Parameter><Parameter "
               "name='start'>0.25</Parameter><Parameter name='DeltaT'>20</Parameter><Parameter "
               "name='scale'>x</Parameter></Schedule></CustomTasks>"));
  REQUIRE(m.heat.ramps.size() == 1);
  CHECK(m.heat.kept);
  const TemperatureRamp& ramp = m.heat.ramps[0];
  CHECK(ramp.change == 20);
  CHECK(ramp.done(0.2) == 0);
  CHECK(ramp.done(0.5) == 0.5);
  CHECK(ramp.done(0.8) == 1);
  TemperatureRamp smooth = ramp;
  smooth.sigmoidal = true;
  CHECK(smooth.done(0.5) == Approx(0.5));
  CHECK(smooth.done(0.75) == 1);
  CHECK(smooth.done(0.25) == 0);
  TemperatureRamp sudden = ramp;
  sudden.duration = 0;
  CHECK(sudden.done(0.25) == 0);
  CHECK(sudden.done(0.26) == 1);
  TemperatureRamp decay = ramp;
  decay.lifetimes = 3;
  CHECK(decay.done(0.5) == Approx(1 - std::exp(-1.5)));
  CHECK(decay.done(2) == Approx(1 - std::exp(-3.0)));
  CHECK_THAT(
      problems_of(xml("<CustomTasks><Schedule name='PropertyRamp'><Parameter name='property'>2</Parameter></Schedule>"
                      "</CustomTasks>")),
      Contains("another property than the temperature"));
}

TEST_CASE("a reversal of the loads", "[dialect]") {
  const Model m = read(deck(half + "GlobalArchive sxx\nGlobalArchive dispx,\"m\"",
                            "CustomTask ReverseLoad\nParameter quantity,dispx\nParameter material,\"m\"\n"
                            "Parameter maxValue,0.5\nParameter style,1"));
  REQUIRE(m.reversal);
  CHECK(m.reversal->history == 1);
  CHECK(m.reversal->value == 0.5);
  CHECK(m.reversal->style == LoadReversal::Style::hold);
  CHECK(m.output.history.size() == 2);
  const std::string task = "<CustomTasks><Schedule name='ReverseLoad'><Parameter name='global sxx'/>";
  const Model added = read(xml(task + "<Parameter name='maxValue'>-3</Parameter></Schedule></CustomTasks>"));
  CHECK(added.output.history.at(added.reversal->history).name == "sxx");
  CHECK_THAT(problems_of(xml(task + "</Schedule></CustomTasks>")), Contains("needs a quantity"));
  const auto with = [](const std::string& name, const std::string& value) {
    return "<Parameter name='" + name + "'>" + value + "</Parameter>";
  };
  const std::string end = "</Schedule></CustomTasks>", most = with("maxValue", "1");
  const Model held = read(xml(task + most + with("hold", "2") + with("minValue", "-0.5") + end));
  CHECK(held.reversal->hold == 2);
  CHECK(held.reversal->least == -0.5);
  CHECK_THAT(problems_of(xml(task + most + with("hold", "1") + with("style", "3") + end)),
             Contains("belongs to style 0"));
  CHECK_THAT(problems_of(xml(task + most + with("style", "2") + end)), Contains("'style' must be 0"));
  CHECK_THAT(problems_of(xml(task + with("maxLength", "1") + end)), Contains("belongs to a reversal by a quantity"));
  const std::string by_length = "<CustomTasks><Schedule name='ReverseLoad'>" + with("style", "2");
  CHECK_THAT(problems_of(xml(by_length + with("crackNumber", "1") + end)), Contains("needs 'maxLength'"));
  CHECK_THAT(problems_of(xml(by_length + with("maxLength", "3") + with("crackNumber", "1") + end)),
             Contains("no crack number 1"));
  CHECK_THAT(problems_of(xml(by_length + with("maxLength", "3") + end)), Contains("no crack of this model grows"));
}

TEST_CASE("quantities of histories", "[dialect]") {
  const std::string plastic = "<Material Type='9' Name='p'><rho>1</rho><E>1</E><nu>.3</nu><yield>1</yield></Material>";
  const Model m = read(xml(plastic,
                           "<GlobalArchive type='eRRe'/><GlobalArchive type='exyp' matname='p'/>"
                           "<GlobalArchive type='FZR'/><GlobalArchive type='Work Energy'/>"
                           "<GlobalArchive type='history 1' matname='p'/>"));
  const auto& h = m.output.history;
  CHECK(h.at(0).name == "exxe");
  CHECK(h.at(1).name == "exyp");
  CHECK(h.at(2).name == "Fyx");
  CHECK(h.at(3).name == "Work Energy");
  CHECK(h.at(4).variable == 0);
  CHECK(m.output.wants_strain());
  CHECK(m.output.wants_deformation());
  const std::string name = m.materials.at(static_cast<std::size_t>(h.at(4).material)).law->history().front().name;
  CHECK(read(xml(plastic, "<GlobalArchive type='history " + name + "' matname='p'/>")).output.history.at(0).variable ==
        0);
  CHECK_THAT(problems_of(xml(plastic, "<GlobalArchive type='history 99' matname='p'/>")),
             Contains("has no history variable"));
  CHECK_THAT(problems_of(xml(plastic, "<GlobalArchive type='history 1'/>")), Contains("is a variable of one material"));
}

TEST_CASE("the attribute depth makes a moving wall of a condition", "[dialect]") {
  const auto with = [](const std::string& attributes) {
    return xml("<GridBCs><BCLine x1='4' y1='0' x2='4' y2='4'><DisBC " + attributes + "/></BCLine></GridBCs>");
  };
  const Model model = read(with("dir='2' vel='3' depth='-2.5' gradfxn='2*t' dispfxn='3*t'"));
  REQUIRE(model.node_conditions.size() == 1);
  REQUIRE(model.node_conditions[0].wall);
  const MovingWall& wall = *model.node_conditions[0].wall;
  CHECK(wall.side == -1);
  CHECK(wall.depth == 2.5);
  CHECK(wall.gradient(Variables::at(Vec3::Zero(), 4)) == 8);
  CHECK(wall.displacement(Variables::at(Vec3::Zero(), 4)) == 12);
  CHECK(read(with("dir='1' depth='1' gradfxn='mirror'")).node_conditions[0].wall->mirror);
  CHECK(!read(with("dir='1'")).node_conditions[0].wall);
  CHECK_THAT(problems_of(with("dir='12' depth='1'")), Contains("normal to an axis"));
  CHECK_THAT(problems_of(with("dir='1' gradfxn='t'")), Contains("'gradfxn' belongs to a moving wall"));
  CHECK_THAT(problems_of(with("dir='1' depth='1' dispfxn='3*'")), Contains("a value is expected"));
  const Model script = read(deck(half, on_nodes("Velocity x,\"gradient\",\"-0.1*t\",0,1,\"mirror\",\"-0.05*t^2\"")));
  REQUIRE(script.node_conditions.size() == 1);
  REQUIRE(script.node_conditions[0].wall);
  CHECK(script.node_conditions[0].wall->mirror);
  CHECK(script.node_conditions[0].wall->displacement(Variables::at(Vec3::Zero(), 2)) == Approx(-0.2));
  CHECK(script.node_conditions[0].velocity.at(2, Vec3::Zero()) == Approx(-0.2));
}
