// SPDX-License-Identifier: MIT
/// The summary printed by `tribo check`.

#include "input/read.hpp"
#include "run/preflight.hpp"

#include <catch2/catch.hpp>

using namespace tribo;
using Catch::Contains;

namespace {

// A plane model of one block with parts of the command file replaced.
std::string one_block(const std::string& body = "<Rect xmin='4' xmax='8' ymin='2' ymax='6'/>",
                      const std::string& more = "", const std::string& grid = "<Horiz nx='20'/><Vert ny='10'/>",
                      const std::string& header = "", const std::string& others = "") {
  return preflight(read_model_text(R"(<JANFEAInput version='3'>
 <Header><Analysis>10</Analysis><ConsistentUnits length='m' mass='kg' time='s'/></Header>
 <MPMHeader><MaxTime>1</MaxTime><ArchiveTime>1</ArchiveTime><GIMP/>)" +
                                       header + R"(</MPMHeader>
 <Mesh><Grid xmin='0' xmax='20' ymin='0' ymax='10'>)" +
                                       grid + "</Grid></Mesh><MaterialPoints><Body matname='m'>" + body + "</Body>" +
                                       others + R"(</MaterialPoints>
 <Material Type='1' Name='m'><rho>1000</rho><E>1e6</E><nu>0</nu></Material>)" +
                                       more + "</JANFEAInput>",
                                   "deck.xml"),
                   1);
}

// Two blocks of 4 x 4 cells, the right one `gap` cells beside the left one.
std::string sheet(const std::string& gap, const std::string& header, const std::string& more = "",
                  const std::string& left_size = "4", const std::string& right_modulus = "1",
                  const std::string& left_law = "") {
  const std::string deck = R"(<JANFEAInput version='3'>
 <Header><Analysis>10</Analysis><ConsistentUnits length='mm' mass='g' time='ms'/></Header>
 <MPMHeader><MaxTime>1</MaxTime><ArchiveTime>0.25</ArchiveTime><GIMP/>)" +
                           header + R"(</MPMHeader>
 <Mesh><Grid xmin='0' xmax='20' ymin='0' ymax='10'><Horiz nx='20'/><Vert ny='10'/></Grid></Mesh>
 <MaterialPoints>
  <Body matname='left'><Rect xmin='4' xmax='8' ymin='2' ymax='2+'/></Body>
  <Body matname='right'><Deform dX=')" +
                           gap + R"('/><Rect xmin='8' xmax='12' ymin='2' ymax='6'/></Body>
 </MaterialPoints>
 <Material Type='1' Name='left'><rho>0.001</rho><E>1</E><nu>0</nu>)" +
                           left_law + R"(</Material>
 <Material Type='1' Name='right'><rho>0.001</rho><E>)" +
                           right_modulus + R"(</E><nu>0</nu></Material>)" + more + "</JANFEAInput>";
  std::string text = deck;
  text.replace(text.find("2+"), 2, std::to_string(2 + std::stoi(left_size)));
  return preflight(read_model_text(text, "deck.xml"), 1);
}
const std::string contact = "<MultiMaterialMode/>";

}  // namespace

TEST_CASE("the summary reports gaps, contacts and overlaps", "[preflight]") {
  CHECK_THAT(sheet("0", contact), Contains("touch: 'left' and 'right'"));
  CHECK_THAT(sheet("0.4", contact), Contains("gap: 'left' and 'right', 0.4 cells"));
  CHECK_THAT(sheet("-0.4", contact),
             Contains("overlap: 'left' and 'right' by 0.4 cells") && Contains("push them apart"));
  CHECK_THAT(sheet("1.5", contact),
             Contains("gap: 'left' and 'right', 1.5 cells (1.5 mm) along x\n") && !Contains("to look at"));
  CHECK_THAT(sheet("1.5", ""), !Contains("gap:"));
  CHECK_THAT(sheet("0", ""), Contains("share one velocity field"));
  CHECK_THAT(sheet("0.4", ""), Contains("act on each other across the gap"));
  CHECK_THAT(sheet("0.4", "<MultiMaterialMode Normals='2'><ContactPosition>0.8</ContactPosition></MultiMaterialMode>"),
             Contains("may see contact before they touch"));
}

TEST_CASE("the summary reports thin bodies, contrasts and the limit of the time step", "[preflight]") {
  CHECK_THAT(sheet("0", contact, "", "2"), Contains(", 2 cells thick") && Contains("neither bends"));
  CHECK_THAT(sheet("0", contact, "", "3"), !Contains(", 3 cells thick") && !Contains("neither bends"));
  const std::string text = sheet("0", contact, "", "4", "1e4");
  CHECK_THAT(text,
             Contains("stiffness contrast: 'right' is 1e+04 times as stiff as 'left'") && Contains("could be rigid"));
  // h/c/2 with c = sqrt(1e4/0.001)
  CHECK_THAT(text, Contains("time step: 0.000158114 ms, set by the waves in 'right' (wave speed 3162.28 mm/ms)"));
  CHECK_THAT(sheet("0", contact + "<TimeStep>1e-4</TimeStep>"), Contains("time step: 0.0001 ms, set by <TimeStep>"));
  CHECK_THAT(text, Contains("particle files: 5"));
  CHECK_THAT(text, Contains("stress MPa"));
}

TEST_CASE("shapes of one material that touch or overlap are judged as one body", "[preflight]") {
  const std::string thin = "neither bends";
  const auto rect = [](const char* x0, const char* x1, const char* y0, const char* y1) {
    return std::string("<Rect xmin='") + x0 + "' xmax='" + x1 + "' ymin='" + y0 + "' ymax='" + y1 + "'/>";
  };
  const std::string block = rect("4", "8", "2", "6");
  const auto body = [](const std::string& shape) { return "<Body matname='m'>" + shape + "</Body>"; };
  const auto with = [&](const std::string& first, const std::string& second,
                        const std::string& grid = "<Horiz nx='20'/><Vert ny='10'/>") {
    return one_block(first, "", grid, "", second.empty() ? "" : body(second));
  };
  CHECK_THAT(with(block + rect("6", "7", "5", "9"), ""), !Contains(thin));  // a rib that overlaps, in the same <Body>
  CHECK_THAT(with(block, rect("6", "7", "5", "9")), !Contains(thin));
  CHECK_THAT(with(block, rect("8", "9", "2", "6")), !Contains(thin) && !Contains("thick"));  // a layer that touches
  CHECK_THAT(with(rect("4", "9", "2", "3"), rect("4", "9", "3", "5")), !Contains(thin));
  CHECK_THAT(with(rect("4", "9", "2", "3"), rect("4", "9", "3", "4")),
             Contains("a body of 'm' is 2 cells thick: it " + thin) && Contains(", 2 cells thick\n"));
  CHECK_THAT(with(rect("4", "9", "2", "3"), rect("4", "5", "3", "8")), Contains("a body of 'm' is 1 cell thick"));
  CHECK_THAT(with(block, rect("12", "13", "2", "6")), Contains("a body of 'm' is 1 cell thick: "));  // apart from it
  CHECK_THAT(with("<Oval xmin='4' xmax='7' ymin='2' ymax='5'/>", ""), !Contains(thin));
  // A plane of symmetry shows half of a plate
  const std::string mirrored = "<Horiz nx='20' symmin='0'/><Vert ny='10'/>";
  CHECK_THAT(with(rect("0", "2", "2", "9"), "", mirrored), !Contains(thin));
  CHECK_THAT(with(rect("0", "1", "2", "9"), "", mirrored), Contains("a body of 'm' is 2 cells thick"));
}

TEST_CASE("the summary tells which directions of an interface are elastic", "[preflight]") {
  const auto with = [](const std::string& stiffness) {
    return sheet("0", "<MultiMaterialMode><Friction lawname='glue'/></MultiMaterialMode>",
                 "<Material Type='LinearInterface' Name='glue'><Dnt>" + stiffness + "</Dnt><Dt>0</Dt></Material>");
  };
  const std::string bonded = "normal direction bonded, tangential direction elastic";
  // 30 M/h with M = 1 and h = 1
  CHECK_THAT(with("29"),
             Contains("normal direction elastic, tangential direction elastic") && !Contains("smaller cells"));
  CHECK_THAT(with("31"), Contains(bonded) && Contains("smaller cells resolve it"));
  CHECK_THAT(with("-1"), Contains(bonded) && !Contains("smaller cells"));
}

TEST_CASE("the summary reports how many cells a crack spans", "[preflight]") {
  const auto with = [](const std::string& lines, const std::string& more = "") {
    return sheet("2", "", "<CrackList>" + lines + "</CrackList>" + more, "8");
  };
  // the left block is 4 cells wide and 8 high
  CHECK_THAT(with("<Line xmin='6' xmax='6' ymin='1' ymax='10'/>"),
             Contains("crack 1: 18 pieces, length 9, 8 of it in bodies: 8 cells long") && !Contains("- crack"));
  CHECK_THAT(with("<Line xmin='6' xmax='6' ymin='3' ymax='8'/>"), Contains("crack 1 spans 5 cells only"));
  CHECK_THAT(with("<Line xmin='3' xmax='8' ymin='6' ymax='6'/>"), !Contains("spans 4 cells"));  // it cuts the block
  CHECK_THAT(with("<Line xmin='1' xmax='1' ymin='2' ymax='8'/>"), Contains("crack 1 lies in no body"));
  CHECK_THAT(with("<Line xmin='6' xmax='6' ymin='2' ymax='8' resolution='2'/>"), Contains("pieces of up to 3 cells"));
  CHECK_THAT(with("<Line xmin='5' xmax='5' ymin='2' ymax='8'/>",
                  "<CrackList><Line xmin='7.5' xmax='7.5' ymin='2' ymax='8'/></CrackList>"),
             Contains("crack 1 and crack 2 come within 2.5 cells"));
  CHECK_THAT(with("<Line xmin='5' xmax='5' ymin='2' ymax='8'/>",
                  "<CrackList><Line xmin='6' xmax='6' ymin='2' ymax='8'/></CrackList>"),
             Contains("come within 1 cell: "));
  // An exterior end so far inside the body that its extension does not reach the surface
  CHECK_THAT(
      with("<Line xmin='6' xmax='6' ymin='1' ymax='4' end_tip='-2'/>"),
      Contains("crack 1: its end at (6, 4) is said to be exterior but lies inside a body; the crack goes on for 4 "
               "cells, 4, and ends there inside the body"));
  CHECK_THAT(with("<Line xmin='6' xmax='6' ymin='1' ymax='9' end_tip='-2'/>"), !Contains("exterior"));
}

TEST_CASE("parts of a crack with different laws are one line in the summary", "[preflight]") {
  const std::string glue =
      "<Material Type='TriangularTraction' Name='glue'><sigmaI>0.1</sigmaI><JIc>0.1</JIc><sigmaII>0.1</sigmaII>"
      "<JIIc>0.1</JIIc></Material>";
  const auto with = [&](const std::string& cracks) { return sheet("2", "", cracks + glue, "8"); };
  const auto line = [](const char* from, const char* to, const std::string& law = "") {
    return std::string("<Line xmin='6' xmax='6' ymin='") + from + "' ymax='" + to + "'" + law + "/>";
  };
  CHECK_THAT(with("<CrackList>" + line("1", "5") + line("5", "9", " matname='glue'") + "</CrackList>"),
             Contains("the line of cracks 1 and 2: 16 pieces, length 8, 7 of it in bodies: 7 cells long\n") &&
                 !Contains("come within") && !Contains("meet"));
  // Both of its ends lie outside of the body
  CHECK_THAT(with("<CrackList>" + line("1", "9.5") + line("9.5", "10", " matname='glue'") + "</CrackList>"),
             Contains("the line of cracks 1 and 2: 18 pieces") && !Contains("spans"));
  CHECK_THAT(with("<CrackList>" + line("3", "5") + line("5", "6", " matname='glue'") + line("6", "8") + "</CrackList>"),
             Contains("the line of cracks 1, 2 and 3 spans 5 cells only"));
  // Another law of contact, given by a crack of its own
  CHECK_THAT(
      with("<CrackList friction='0.3'>" + line("1", "5") + "</CrackList><CrackList>" + line("5", "9") + "</CrackList>"),
      Contains("the line of cracks 1 and 2: 16 pieces") && !Contains("come within"));
  // Three lines that share an end are cracks of their own
  CHECK_THAT(with("<CrackList>" + line("1", "5") + "</CrackList><CrackList>" + line("5", "9") +
                  "</CrackList><CrackList><Line xmin='6' xmax='9' ymin='5' ymax='5'/></CrackList>"),
             Contains("crack 1 and crack 2 meet: ") && Contains("crack 1 and crack 3 meet: "));
}

TEST_CASE("the summary reports points, area and time step of a joint between materials", "[preflight]") {
  const auto with = [](const std::string& stiffness) {
    return sheet("0", contact,
                 "<Material Type='Mohr' Name='bed'><stiffness-normal>" + stiffness + "</stiffness-normal></Material>",
                 "4", "1", "<Friction lawname='bed' matname='right'/>");
  };
  CHECK_THAT(with("1"),
             Contains("joint 1 of 'left' and 'right': 8 points, area 4") && Contains("joints: stable up to"));
  CHECK_THAT(with("1000"), Contains("the joints shorten the step"));
}

TEST_CASE("the summary warns of tractions on faces inside a body", "[preflight]") {
  const auto with = [](const std::string& from) {
    return one_block(
        "<Rect xmin='4' xmax='8' ymin='2' ymax='6'/>",
        "<ParticleBCs><BCShape><Rect xmin='" + from +
            "' xmax='8' ymin='2' ymax='6'/><TractionBC dir='1' face='2' stress='1'/></BCShape></ParticleBCs>");
  };
  CHECK_THAT(with("7.5"), Contains("traction along x: on 8 particles") && !Contains("inside its body"));
  CHECK_THAT(with("7"), Contains("acts inside its body: 8 of its 16 particles"));
}

TEST_CASE("the summary reports the time step that joints allow", "[preflight]") {
  const auto with = [](const std::string& stiffness) {
    return sheet("2", "",
                 "<CrackList lawname='joint'><Line xmin='3' xmax='9' ymin='6' ymax='6'/></CrackList>"
                 "<Material Type='Mohr' Name='joint'><stiffness-normal>" +
                     stiffness + "</stiffness-normal><stiffness-shear>0</stiffness-shear></Material>",
                 "8");
  };
  CHECK_THAT(with("0.1"), Contains("joints: stable up to steps of") && Contains("set by the waves in 'left'"));
  // a step of h/c/2 is stable with a spring of the order of E/h; 1e4 of it shorten the step by about 100
  CHECK_THAT(with("1e4"), Contains("set by the stiffness of the joints") && Contains("shorten the step"));
}

TEST_CASE("the summary warns of friction under sudden gravity", "[preflight]") {
  const std::string rough = "<MultiMaterialMode><Friction>0.5</Friction></MultiMaterialMode>";
  const std::string falls = "<Gravity><BodyYForce>-9.81</BodyYForce></Gravity>";
  const std::string grows = "<Gravity><GridBodyYForce>-9.81*min(t,1)</GridBodyYForce></Gravity>";
  CHECK_THAT(sheet("0", rough, falls), Contains("gravity acts suddenly"));
  CHECK_THAT(sheet("0", rough, grows), !Contains("gravity acts suddenly"));
  CHECK_THAT(sheet("0", contact, falls), !Contains("gravity acts suddenly"));  // nothing to stick without friction
  CHECK_THAT(sheet("0", rough + "<PDamping>1</PDamping>", falls), !Contains("gravity acts suddenly"));
  const std::string cracked = "<CrackList friction='0.3'><Line xmin='3' xmax='20' ymin='5' ymax='6'/></CrackList>";
  CHECK_THAT(sheet("0", "", falls + cracked), Contains("gravity acts suddenly"));
}

TEST_CASE("the summary reports bodies that stick to fixed nodes and bodies that leave the grid", "[preflight]") {
  const std::string glue =
      "<GridBCs><BCLine x1='0' x2='20' y1='2' y2='2' tolerance='*0.1'><DisBC dir='1' vel='0'/><DisBC dir='2' vel='0'/>"
      "</BCLine></GridBCs>";
  CHECK_THAT(sheet("2", contact, glue),
             Contains("held: 'left'") && Contains("held: 'right'") && !Contains("to look at"));
  // no law of contact acts where both are at the fixed nodes
  CHECK_THAT(sheet("0", contact, glue), Contains("'left' and 'right' meet at nodes that are fixed in all directions"));
  const std::string slides =
      "<GridBCs><BCLine x1='0' x2='20' y1='2' y2='2' tolerance='*0.1'><DisBC dir='2' vel='0'/></BCLine></GridBCs>";
  CHECK_THAT(sheet("2", contact, slides), !Contains("held:"));

  std::string deck = R"(<JANFEAInput version='3'><Header><Analysis>10</Analysis></Header>
 <MPMHeader><MaxTime>1</MaxTime><ArchiveTime>1</ArchiveTime></MPMHeader>
 <Mesh><Grid xmin='0' xmax='20' ymin='0' ymax='10'><Horiz nx='20'/><Vert ny='10'/></Grid></Mesh>
 <MaterialPoints><Body matname='m' vx='40'><Rect xmin='0' xmax='10' ymin='2' ymax='6'/></Body></MaterialPoints>
 <Material Type='1' Name='m'><rho>1</rho><E>1</E><nu>0</nu></Material></JANFEAInput>)";
  // the foremost particle is at 9.75 of 20
  CHECK_THAT(preflight(read_model_text(deck, "deck.xml"), 1), Contains("'m' leaves the grid at time 0.2562"));
  // A spinning disc stays where it is
  deck.replace(deck.find("vx='40'"), 7, "");
  deck.replace(deck.find("<Rect"), deck.find("</Body>") - deck.find("<Rect"),
               "<vel0X>-9*(y-5)</vel0X><vel0Y>9*(x-6)</vel0Y><Oval xmin='2' xmax='10' ymin='1' ymax='9'/>");
  CHECK_THAT(preflight(read_model_text(deck, "deck.xml"), 1), !Contains("leaves the grid"));
}

namespace {

// The summary of a disc, with more elements in the header.
std::string disc_with(const std::string& tools) {
  const std::string text = R"(<JANFEAInput version='3'><Header><Analysis>10</Analysis></Header>
 <MPMHeader><MaxTime>1</MaxTime><ArchiveTime>1</ArchiveTime>)" +
                           tools + R"(</MPMHeader>
 <Mesh><Grid xmin='0' xmax='20' ymin='0' ymax='10'><Horiz nx='20'/><Vert ny='10'/></Grid></Mesh>
 <MaterialPoints><Body matname='m'><Oval xmin='2' xmax='8' ymin='2' ymax='6'/></Body></MaterialPoints>
 <Material Type='1' Name='m'><rho>1</rho><E>1</E><nu>0</nu></Material></JANFEAInput>)";
  return preflight(read_model_text(text, "deck.xml"), 1);
}

}  // namespace

TEST_CASE("the summary tells the scheme and what linear shape functions do", "[preflight]") {
  const std::string jumps = "stresses jump when particles cross", falls = "fall apart even in free flight";
  CHECK_THAT(disc_with(""), Contains("scheme: linear shape functions, FLIP, stress update USAVG+\n") &&
                                Contains(jumps) && !Contains(falls));
  CHECK_THAT(
      disc_with("<GIMP/><MPMMethod>USL</MPMMethod><Transfer type='FMPM' order='3'/>"),
      Contains("scheme: uGIMP shape functions, FMPM(3), stress update USL+\n") && !Contains(jumps) && !Contains(falls));
  CHECK_THAT(disc_with("<Transfer type='APIC'/>"), Contains("With APIC, bodies then " + falls) && !Contains(jumps));
  CHECK_THAT(disc_with("<Transfer type='APIC'/><GIMP type='quadratic'/>"), !Contains(falls));
  CHECK_THAT(disc_with("<MPMMethod>USL</MPMMethod><SkipPostExtrapolation/>"), Contains(falls));
  CHECK_THAT(disc_with("<MPMMethod>USF</MPMMethod><SkipPostExtrapolation/>"),
             Contains("stress update USF\n") && !Contains(falls));
}

TEST_CASE("the summary warns of schemes that do not come to rest", "[preflight]") {
  const std::string creep = "creep, and their displacement", vibrate = "vibrate in spite of damping";
  const std::string filter = "<Transfer type='FMPM' order='2'/>", damping = "<Damping>3</Damping>";
  CHECK_THAT(disc_with("<GIMP/>" + filter), !Contains(creep));
  CHECK_THAT(disc_with("<GIMP/>" + filter + damping),
             Contains("with FMPM(2) and USAVG+, faces of a body") && Contains(creep));
  CHECK_THAT(disc_with("<GIMP/><SkipPostExtrapolation/>" + filter + damping), !Contains(creep));
  CHECK_THAT(disc_with("<GIMP/>" + damping), Contains(vibrate));
  CHECK_THAT(disc_with("<GIMP/><Transfer type='APIC'/>" + damping), !Contains(vibrate));
}

TEST_CASE("the summary tells gravity in words and warns of gravity along x", "[preflight]") {
  const auto with = [](const std::string& forces) {
    return one_block("<Rect xmin='4' xmax='8' ymin='2' ymax='6'/>", "<Gravity>" + forces + "</Gravity>");
  };
  const std::string slip = "gravity acts along x alone";
  CHECK_THAT(one_block(), Contains("gravity: none"));
  CHECK_THAT(with("<BodyYForce>-9.81</BodyYForce>"), Contains("gravity: down 9.81 (along -y)") && !Contains(slip));
  CHECK_THAT(with("<BodyXForce>-9.81</BodyXForce>"), Contains("gravity: left 9.81 (along -x)") && Contains(slip));
  CHECK_THAT(with("<BodyXForce>2</BodyXForce><BodyYForce>-9</BodyYForce>"),
             Contains("gravity: right 2 (along +x), down 9 (along -y)") && !Contains(slip));
  CHECK_THAT(with("<BodyXForce>2</BodyXForce><GridBodyYForce>-9*t</GridBodyYForce>"),
             Contains("a function along y") && !Contains(slip));
}

TEST_CASE("the summary has a table of the edges of the grid", "[preflight]") {
  const std::string text = one_block("<Rect xmin='4' xmax='8' ymin='2' ymax='6'/>",
                                     "<GridBCs><BCLine x1='0' x2='20' y1='2' y2='2' tolerance='*0.1'>"
                                     "<DisBC dir='1' vel='0'/><DisBC dir='2' vel='-3'/></BCLine>"
                                     "<BCLine x1='20' x2='20' y1='0' y2='10' tolerance='*0.1'><DisBC dir='1' "
                                     "style='3' vel='1' time='2'/></BCLine></GridBCs>",
                                     "<Horiz nx='20' symmin='0'/><Vert ny='10'/>");
  CHECK_THAT(text, Contains("  xmin = 0          symmetry\n") &&
                       Contains("  xmax = 20         velocity x (sine) at x = 20\n") &&
                       Contains("  ymin = 0          velocity x = 0, y = -3 at y = 2\n") &&
                       Contains("  ymax = 10         free\n"));
  CHECK_THAT(one_block(), Contains("cells: 20 x 10 of 1 x 1 (m), 4 particles per cell\n"));
}

TEST_CASE("the summary warns of slender cells", "[preflight]") {
  const std::string body = "<Rect xmin='4' xmax='8' ymin='2' ymax='6'/>";
  CHECK_THAT(one_block(body, "", "<Horiz nx='20'/><Vert ny='40'/>"), Contains("the cells are 4 times as long as wide"));
  CHECK_THAT(one_block(body, "", "<Horiz nx='20'/><Vert ny='38'/>"), !Contains("as long as wide"));
}

TEST_CASE("the summary names the contact law of each pair of materials", "[preflight]") {
  CHECK_THAT(sheet("0", contact), Contains("contact of 'left' and 'right': without friction"));
  CHECK_THAT(sheet("0", "<MultiMaterialMode><Friction>0.3</Friction></MultiMaterialMode>"),
             Contains("contact of 'left' and 'right': friction 0.3"));
  CHECK_THAT(sheet("0", "<MultiMaterialMode><Friction lawname='glue'/></MultiMaterialMode>",
                   "<Material Type='LinearInterface' Name='glue'><Dnt>2</Dnt><Dt>1</Dt></Material>"),
             Contains("contact of 'left' and 'right': LinearInterface 'glue' (Dnt 2, Dt 1)"));
  CHECK_THAT(sheet("0", contact, "<Material Type='Mohr' Name='bed'><stiffness-normal>1</stiffness-normal></Material>",
                   "4", "1", "<Friction lawname='bed' matname='right'/>"),
             Contains("contact of 'left' and 'right': Mohr 'bed' (stiffness-normal 1) where they touch at the start, "
                      "then without friction"));
  CHECK_THAT(sheet("0", ""), Contains("contact: none, all bodies share one velocity field"));
}

TEST_CASE("pairs of materials with the same contact law share a line of the summary", "[preflight]") {
  const auto row = [](const std::vector<std::string>& laws, const std::string& header = contact) {
    std::string bodies, list;
    for (std::size_t k = 0; k < laws.size(); ++k) {
      const std::string who(1, static_cast<char>('a' + k)), x = std::to_string(4 * k), end = std::to_string(4 * k + 3);
      bodies += "<Body matname='" + who + "'><Rect xmin='" + x + "' xmax='" + end + "' ymin='2' ymax='3'/></Body>";
      list += "<Material Type='1' Name='" + who + "'><rho>1000</rho><E>1e6</E><nu>0</nu>" + laws[k] + "</Material>";
    }
    return one_block("<Rect xmin='16' xmax='19' ymin='6' ymax='9'/>", list, "<Horiz nx='20'/><Vert ny='10'/>", header,
                     bodies);
  };
  const auto friction = [](const std::string& other, const std::string& value) {
    return "<Friction matname='" + other + "'>" + value + "</Friction>";
  };
  const auto lines = [](const std::string& text) {
    std::size_t count = 0;
    for (std::size_t at = 0; (at = text.find("contact of ", at)) != std::string::npos; ++at) ++count;
    return count;
  };
  const std::string same = row({"", "", "", ""});
  CHECK_THAT(same, Contains("contact of all pairs (10): without friction\n"));
  CHECK(lines(same) == 1);
  const std::string some =
      row({friction("b", "0.1") + friction("c", "0.2") + friction("d", "0.2"), friction("d", "0.2"), "", ""});
  CHECK_THAT(some, Contains("contact of 'a' and 'b': friction 0.1\n") &&
                       Contains("contact of 'a' with 'c', 'd'; 'd' with 'b': friction 0.2\n"));
  CHECK_THAT(some, Contains("contact of all other pairs (6): without friction\n"));
  CHECK(lines(some) == 3);
  const std::string wall = row({friction("b", "0.1") + friction("c", "0.1") + friction("d", "0.1"), "", "", ""});
  CHECK_THAT(wall, Contains("contact of 'a' with 'b', 'c', 'd': friction 0.1\n"));
}

TEST_CASE("the summary counts the pairs that touch where there are many", "[preflight]") {
  const auto row = [](int count) {
    std::string bodies, list;
    for (int k = 0; k < count; ++k) {
      const std::string who(1, static_cast<char>('a' + k)), x = std::to_string(2 * k), end = std::to_string(2 * k + 2);
      bodies += "<Body matname='" + who + "'><Rect xmin='" + x + "' xmax='" + end + "' ymin='2' ymax='3'/></Body>";
      list += "<Material Type='1' Name='" + who + "'><rho>1000</rho><E>1e6</E><nu>0</nu></Material>";
    }
    return one_block("<Rect xmin='16' xmax='19' ymin='6' ymax='9'/>", list, "<Horiz nx='20'/><Vert ny='10'/>", contact,
                     bodies);
  };
  CHECK_THAT(row(7), Contains("touch: 'a' and 'b'\n") && Contains("touch: 'f' and 'g'\n"));
  CHECK_THAT(row(8), Contains("touch: 7 pairs of materials, the first of them 'a' and 'b'\n") && !Contains("'f' and"));
}

TEST_CASE("the summary has no contact law between rigid bodies, which contact cannot move", "[preflight]") {
  const std::string tools = "<Material Type='RigidContact' Name='p'/><Material Type='RigidContact' Name='q'/>";
  const std::string text =
      one_block("<Rect xmin='4' xmax='8' ymin='2' ymax='6'/>", tools, "<Horiz nx='20'/><Vert ny='10'/>", contact,
                "<Body matname='p'><Rect xmin='2' xmax='4' ymin='2' ymax='6'/></Body>"
                "<Body matname='q'><Rect xmin='2' xmax='8' ymin='1' ymax='2'/></Body>");
  CHECK_THAT(text, Contains("contact of all pairs (2): without friction"));
}

TEST_CASE("the summary tells that bodies stick to Rigid ones, and when distant ones meet", "[preflight]") {
  const auto with = [](const std::string& other, const std::string& body) {
    return one_block("<Rect xmin='4' xmax='8' ymin='2' ymax='6'/>", other, "<Horiz nx='20'/><Vert ny='10'/>", contact,
                     body);
  };
  const std::string ground = "<Body matname='ground'><Rect xmin='2' xmax='12' ymin='1' ymax='2'/></Body>";
  const std::string sticks = "stick: 'm' sticks to 'ground', which is Rigid";
  CHECK_THAT(with("<Material Type='Rigid' Name='ground'><SetDirection>2</SetDirection></Material>", ground),
             Contains(sticks));
  CHECK_THAT(with("<Material Type='RigidContact' Name='ground'/>", ground), !Contains(sticks));
  CHECK_THAT(with("<Material Type='Rigid' Name='ground'/>", ground),
             Contains("the Rigid material 'ground' has no effect") && !Contains(sticks));
  const std::string other = "<Material Type='1' Name='n'><rho>1000</rho><E>1e6</E><nu>0</nu></Material>";
  CHECK_THAT(with(other, "<Body matname='n' vx='-10'><Rect xmin='13' xmax='15' ymin='2' ymax='6'/></Body>"),
             Contains("gap: 'm' and 'n', 5 cells (5 m) along x, closed at time 0.5\n"));
  CHECK_THAT(with(other, "<Body matname='n' vx='10'><Rect xmin='13' xmax='15' ymin='2' ymax='6'/></Body>"),
             Contains("gap: 'm' and 'n', 5 cells (5 m) along x\n"));
}

TEST_CASE("the summary warns of bodies that claim the same place", "[preflight]") {
  const std::string other = "<Material Type='1' Name='n'><rho>1000</rho><E>1e6</E><nu>0</nu></Material>";
  const auto with = [&](const std::string& first, const std::string& second) {
    return one_block(first, other, "<Horiz nx='20'/><Vert ny='10'/>", "", "<Body matname='n'>" + second + "</Body>");
  };
  CHECK_THAT(with("<Rect xmin='4' xmax='8' ymin='2' ymax='6'/>", "<Rect xmin='6' xmax='12' ymin='2' ymax='6'/>"),
             Contains("'m' (deck.xml:") &&
                 Contains("claim an area of 8 in common: the first of them gets it. Draw the other one with a hole"));
  CHECK_THAT(with("<Rect xmin='4' xmax='8' ymin='2' ymax='6'/>", "<Rect xmin='8' xmax='12' ymin='2' ymax='6'/>"),
             !Contains("claim") && !Contains("in its place"));
  CHECK_THAT(with("<Oval xmin='4' xmax='8' ymin='2' ymax='6'/>", "<Rect xmin='2' xmax='12' ymin='1' ymax='8'/>"),
             Contains("in its place: 'm'") && !Contains("claim"));
}

TEST_CASE("the grid may cut rigid bodies, with a remark, but no others", "[preflight]") {
  const std::string tool = "<Material Type='RigidContact' Name='tool'/>";
  const auto with = [&](const std::string& shape) {
    return one_block("<Rect xmin='4' xmax='8' ymin='2' ymax='6'/>", tool, "<Horiz nx='20'/><Vert ny='10'/>", contact,
                     "<Body matname='tool'>" + shape + "</Body>");
  };
  CHECK_THAT(with("<Rect xmin='4' xmax='8' ymin='8' ymax='14'/>"),
             Contains("'tool' (deck.xml:") && Contains("the edge of the grid at ymax = 10 cuts this body: 67 %"));
  CHECK_THAT(with("<Rect xmin='4' xmax='8' ymin='8' ymax='10'/>"), !Contains("cuts this body"));
  CHECK_THROWS_WITH(one_block("<Rect xmin='4' xmax='8' ymin='8' ymax='14'/>"),
                    Contains("deck.xml:") && Contains("error: the edge of the grid at ymax = 10 cuts this body"));
}

TEST_CASE("a second gravity in a script and equal names of materials are warned of", "[preflight]") {
  const auto script = [](const std::string& more, const std::string& second) {
    return read_model_text(R"(Title "t"
Header
t
EndHeader
Analysis "Plane Strain MPM"
ConsistentUnits m,kg,s
MPMMethod "USL","uGIMP"
TimeStep 1,1,0.4
ArchiveTime 1
Material "a",")" + std::string("A") +
                               R"(","LinearElastic"
  rho 1
  E 1
  nu 0
Done
Material "b",")" + second + R"(","LinearElastic"
  rho 1
  E 1
  nu 0
Done
GridHoriz 10
GridVert 10
GridRect 0,10,0,10
Region "a",0,0
  Rect 2,4,2,4
EndRegion
Gravity 0,-10
)" + more,
                           "deck.fmcmd")
        .warnings;
  };
  CHECK(script("", "B").empty());
  CHECK(script("Gravity 0,-10\n", "B").empty());
  CHECK(script("Gravity 3,-10\n", "B").empty());  // the other axis
  CHECK_THAT(script("Gravity 3\n", "B").at(0), Contains("sets the standard gravity along y"));
  REQUIRE(script("Gravity 0,-5\n", "B").size() == 1);
  CHECK_THAT(script("Gravity 0,-5\n", "B")[0],
             Contains("deck.fmcmd:27:") && Contains("warning: this replaces the gravity of deck.fmcmd:26:"));
  REQUIRE(script("", "A").size() == 1);
  CHECK_THAT(script("", "A")[0], Contains("warning: two materials are named 'A'"));
}

TEST_CASE("bodies whose slanted or round faces touch do not overlap", "[preflight]") {
  const std::string other = "<Material Type='1' Name='n'><rho>1000</rho><E>1e6</E><nu>0</nu></Material>";
  const auto with = [&](const std::string& first, const std::string& second) {
    return one_block(first, other, "<Horiz nx='20'/><Vert ny='10'/>", contact,
                     "<Body matname='n'>" + second + "</Body>");
  };
  for (const double slope : {0.1, 0.37, 0.5, 1.3, 2.7}) {
    INFO(slope);
    // Two halves of a block on both sides of a slanted line through its middle
    const auto pt = [](double x, double y) {
      return "<pt x='" + std::to_string(x) + "' y='" + std::to_string(y) + "'/>";
    };
    const double half = slope < 1 ? 4 : 4 / slope;
    const auto line = pt(10 - half, 5 - slope * half) + pt(10 + half, 5 + slope * half);
    const std::string text = with("<Polygon>" + line + pt(10 + half, 0.5) + pt(10 - half, 0.5) + "</Polygon>",
                                  "<Polygon>" + line + pt(10 + half, 9.5) + pt(10 - half, 9.5) + "</Polygon>");
    CHECK_THAT(text, Contains("touch: 'm' and 'n'") && !Contains("overlap") && !Contains("claim"));
  }
  CHECK_THAT(with("<Oval xmin='2' xmax='10' ymin='1' ymax='9'/>", "<Rect xmin='1' xmax='11' ymin='0.5' ymax='9.5'/>"),
             Contains("touch: 'm' and 'n'") && !Contains("push them apart"));
  CHECK_THAT(with("<Oval xmin='2' xmax='10' ymin='1' ymax='9'/>", "<Oval xmin='10' xmax='18' ymin='1' ymax='9'/>"),
             Contains("touch: 'm' and 'n'") && !Contains("overlap"));
}

TEST_CASE("one user_area for all points of a crack is warned of", "[preflight]") {
  const auto warnings = [](const std::string& area) {
    return read_model_text(R"(<JANFEAInput version='3'>
 <Header><Analysis>10</Analysis><ConsistentUnits length='m' mass='kg' time='s'/></Header>
 <MPMHeader><MaxTime>1</MaxTime><ArchiveTime>1</ArchiveTime><GIMP/></MPMHeader>
 <Mesh><Grid xmin='0' xmax='20' ymin='0' ymax='10'><Horiz nx='20'/><Vert ny='10'/></Grid></Mesh>
 <MaterialPoints><Body matname='m'><Rect xmin='4' xmax='8' ymin='2' ymax='6'/></Body></MaterialPoints>
 <CrackList lawname='joint'><Line xmin='4' ymin='4' xmax='8' ymax='4'/></CrackList>
 <Material Type='1' Name='m'><rho>1000</rho><E>1e6</E><nu>0</nu></Material>
 <Material Type='Mohr' Name='joint'><stiffness-normal>1e6</stiffness-normal>)" +
                               area + "</Material></JANFEAInput>",
                           "deck.xml")
        .warnings;
  };
  CHECK(warnings("").empty());
  CHECK(warnings("<user_area>1 2 3</user_area>").empty());
  CHECK(warnings("<area/>").empty());
  REQUIRE(warnings("<user_area>0.25</user_area>").size() == 1);
  CHECK_THAT(warnings("<user_area>0.25</user_area>")[0],
             Contains("deck.xml:") && Contains("<user_area> of 'joint' is the area of every single point"));
}
