// SPDX-License-Identifier: MIT
/// The summary printed by `tribo check`: bodies, scheme, gravity, edges of the grid and conditions.

#include "preflight_models.hpp"

#include <catch2/catch.hpp>

using namespace tribo;
using namespace tribo::test;
using Catch::Contains;

TEST_CASE("the summary reports thin bodies, contrasts and the limit of the time step", "[preflight]") {
  CHECK_THAT(sheet("0", with_contact, "", "2"), Contains(", 2 cells thick") && Contains("neither bends"));
  CHECK_THAT(sheet("0", with_contact, "", "3"), !Contains(", 3 cells thick") && !Contains("neither bends"));
  const std::string text = sheet("0", with_contact, "", "4", "1e4");
  CHECK_THAT(text,
             Contains("stiffness contrast: 'right' is 1e+04 times as stiff as 'left'") && Contains("could be rigid"));
  // h/c/2 with c = sqrt(1e4/0.001)
  CHECK_THAT(text, Contains("time step: 0.000158114 ms, set by the waves in 'right' (wave speed 3162.28 mm/ms)"));
  CHECK_THAT(sheet("0", with_contact + "<TimeStep>1e-4</TimeStep>"),
             Contains("time step: 0.0001 ms, set by <TimeStep>"));
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

TEST_CASE("the summary reports bodies that stick to fixed nodes and bodies that leave the grid", "[preflight]") {
  const std::string glue =
      "<GridBCs><BCLine x1='0' x2='20' y1='2' y2='2' tolerance='*0.1'><DisBC dir='1' vel='0'/><DisBC dir='2' vel='0'/>"
      "</BCLine></GridBCs>";
  CHECK_THAT(sheet("2", with_contact, glue),
             Contains("held: 'left'") && Contains("held: 'right'") && !Contains("to look at"));
  // no law of contact acts where both are at the fixed nodes
  CHECK_THAT(sheet("0", with_contact, glue),
             Contains("'left' and 'right' meet at nodes that are fixed in all directions"));
  const std::string slides =
      "<GridBCs><BCLine x1='0' x2='20' y1='2' y2='2' tolerance='*0.1'><DisBC dir='2' vel='0'/></BCLine></GridBCs>";
  CHECK_THAT(sheet("2", with_contact, slides), !Contains("held:"));

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
  CHECK_THAT(disc_with("<MPMMethod>USL-</MPMMethod>"), Contains(falls));
  CHECK_THAT(disc_with("<MPMMethod>USL+</MPMMethod>"), !Contains(falls));
  CHECK_THROWS_WITH(disc_with("<MPMMethod>USAVG+</MPMMethod><SkipPostExtrapolation/>"), Contains("contradicts"));
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

TEST_CASE("the grid may cut rigid bodies, with a remark, but no others", "[preflight]") {
  const std::string tool = "<Material Type='RigidContact' Name='tool'/>";
  const auto with = [&](const std::string& shape) {
    return one_block("<Rect xmin='4' xmax='8' ymin='2' ymax='6'/>", tool, "<Horiz nx='20'/><Vert ny='10'/>",
                     with_contact, "<Body matname='tool'>" + shape + "</Body>");
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
