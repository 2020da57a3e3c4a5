// SPDX-License-Identifier: MIT
/// The summary printed by `tribo check`: contact of bodies.

#include "preflight_models.hpp"

#include <catch2/catch.hpp>

using namespace tribo;
using namespace tribo::test;
using Catch::Contains;

TEST_CASE("the summary reports gaps, contacts and overlaps", "[preflight]") {
  CHECK_THAT(sheet("0", with_contact), Contains("touch: 'left' and 'right'"));
  CHECK_THAT(sheet("0.4", with_contact), Contains("gap: 'left' and 'right', 0.4 cells"));
  CHECK_THAT(sheet("-0.4", with_contact),
             Contains("overlap: 'left' and 'right' by 0.4 cells") && Contains("push them apart"));
  CHECK_THAT(sheet("1.5", with_contact),
             Contains("gap: 'left' and 'right', 1.5 cells (1.5 mm) along x\n") && !Contains("to look at"));
  CHECK_THAT(sheet("1.5", ""), !Contains("gap:"));
  CHECK_THAT(sheet("0", ""), Contains("share one velocity field"));
  CHECK_THAT(sheet("0.4", ""), Contains("act on each other across the gap"));
  CHECK_THAT(sheet("0.4", "<MultiMaterialMode Normals='2'><ContactPosition>0.8</ContactPosition></MultiMaterialMode>"),
             Contains("may see contact before they touch"));
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

TEST_CASE("the summary warns of friction under sudden gravity", "[preflight]") {
  const std::string rough = "<MultiMaterialMode><Friction>0.5</Friction></MultiMaterialMode>";
  const std::string falls = "<Gravity><BodyYForce>-9.81</BodyYForce></Gravity>";
  const std::string grows = "<Gravity><GridBodyYForce>-9.81*min(t,1)</GridBodyYForce></Gravity>";
  CHECK_THAT(sheet("0", rough, falls), Contains("gravity acts suddenly"));
  CHECK_THAT(sheet("0", rough, grows), !Contains("gravity acts suddenly"));
  CHECK_THAT(sheet("0", with_contact, falls), !Contains("gravity acts suddenly"));  // nothing to stick without friction
  CHECK_THAT(sheet("0", rough + "<PDamping>1</PDamping>", falls), !Contains("gravity acts suddenly"));
  const std::string cracked = "<CrackList friction='0.3'><Line xmin='3' xmax='20' ymin='5' ymax='6'/></CrackList>";
  CHECK_THAT(sheet("0", "", falls + cracked), Contains("gravity acts suddenly"));
}

TEST_CASE("the summary names the contact law of each pair of materials", "[preflight]") {
  CHECK_THAT(sheet("0", with_contact), Contains("contact of 'left' and 'right': without friction"));
  CHECK_THAT(sheet("0", "<MultiMaterialMode><Friction>0.3</Friction></MultiMaterialMode>"),
             Contains("contact of 'left' and 'right': friction 0.3"));
  CHECK_THAT(sheet("0", "<MultiMaterialMode><Friction lawname='glue'/></MultiMaterialMode>",
                   "<Material Type='LinearInterface' Name='glue'><Dnt>2</Dnt><Dt>1</Dt></Material>"),
             Contains("contact of 'left' and 'right': LinearInterface 'glue' (Dnt 2, Dt 1)"));
  CHECK_THAT(
      sheet("0", with_contact, "<Material Type='Mohr' Name='bed'><stiffness-normal>1</stiffness-normal></Material>",
            "4", "1", "<Friction lawname='bed' matname='right'/>"),
      Contains("contact of 'left' and 'right': Mohr 'bed' (stiffness-normal 1) where they touch at the start, "
               "then without friction"));
  CHECK_THAT(sheet("0", ""), Contains("contact: none, all bodies share one velocity field"));
}

TEST_CASE("pairs of materials with the same contact law share a line of the summary", "[preflight]") {
  const auto row = [](const std::vector<std::string>& laws, const std::string& header = with_contact) {
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
    return one_block("<Rect xmin='16' xmax='19' ymin='6' ymax='9'/>", list, "<Horiz nx='20'/><Vert ny='10'/>",
                     with_contact, bodies);
  };
  CHECK_THAT(row(7), Contains("touch: 'a' and 'b'\n") && Contains("touch: 'f' and 'g'\n"));
  CHECK_THAT(row(8), Contains("touch: 7 pairs of materials, the first of them 'a' and 'b'\n") && !Contains("'f' and"));
}

TEST_CASE("the summary has no contact law between rigid bodies, which contact cannot move", "[preflight]") {
  const std::string tools = "<Material Type='RigidContact' Name='p'/><Material Type='RigidContact' Name='q'/>";
  const std::string text =
      one_block("<Rect xmin='4' xmax='8' ymin='2' ymax='6'/>", tools, "<Horiz nx='20'/><Vert ny='10'/>", with_contact,
                "<Body matname='p'><Rect xmin='2' xmax='4' ymin='2' ymax='6'/></Body>"
                "<Body matname='q'><Rect xmin='2' xmax='8' ymin='1' ymax='2'/></Body>");
  CHECK_THAT(text, Contains("contact of all pairs (2): without friction"));
}

TEST_CASE("the summary tells that bodies stick to Rigid ones, and when distant ones meet", "[preflight]") {
  const auto with = [](const std::string& other, const std::string& body) {
    return one_block("<Rect xmin='4' xmax='8' ymin='2' ymax='6'/>", other, "<Horiz nx='20'/><Vert ny='10'/>",
                     with_contact, body);
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

TEST_CASE("bodies whose slanted or round faces touch do not overlap", "[preflight]") {
  const std::string other = "<Material Type='1' Name='n'><rho>1000</rho><E>1e6</E><nu>0</nu></Material>";
  const auto with = [&](const std::string& first, const std::string& second) {
    return one_block(first, other, "<Horiz nx='20'/><Vert ny='10'/>", with_contact,
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
