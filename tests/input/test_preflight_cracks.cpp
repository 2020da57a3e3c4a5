// SPDX-License-Identifier: MIT
/// The summary printed by `tribo check`: cracks, joints and interfaces.

#include "preflight_models.hpp"

#include <catch2/catch.hpp>

#include <cmath>

using namespace tribo;
using namespace tribo::test;
using Catch::Contains;

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
    return sheet("0", with_contact,
                 "<Material Type='Mohr' Name='bed'><stiffness-normal>" + stiffness + "</stiffness-normal></Material>",
                 "4", "1", "<Friction lawname='bed' matname='right'/>");
  };
  CHECK_THAT(with("1"),
             Contains("joint 1 of 'left' and 'right': 8 points, area 4") && Contains("joints: stable up to"));
  CHECK_THAT(with("1000"), Contains("the joints shorten the step"));
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

namespace {

// Two bodies with a common face that rises by `rise` over the width of 8 cells.
std::string report(double rise, const std::string& law, const std::string& kernel, const std::string& thickness = "1") {
  const std::string left = std::to_string(6 - rise / 2), right = std::to_string(6 + rise / 2);
  const std::string face = "<pt x='2' y='" + left + "'/><pt x='10' y='" + right + "'/>";
  const std::string material = "<rho>1</rho><E>100</E><nu>0</nu>";
  return preflight(
      read_model_text("<JANFEAInput version='3'><Header><Analysis>10</Analysis><ConsistentUnits length='mm' mass='g' "
                      "time='ms'/></Header><MPMHeader><MaxTime>1</MaxTime><ArchiveTime>1</ArchiveTime><GIMP type='" +
                          kernel +
                          "'/><MultiMaterialMode/></MPMHeader><Mesh><Grid xmin='0' xmax='12' ymin='0' ymax='12' "
                          "thickness='" +
                          thickness +
                          "'><Horiz nx='12'/><Vert ny='12'/></Grid></Mesh><MaterialPoints>"
                          "<Body matname='low'><Polygon><pt x='10' y='2'/><pt x='2' y='2'/>" +
                          face +
                          "</Polygon></Body><Body matname='high'><Polygon><pt x='10' y='10'/><pt x='2' y='10'/>" +
                          face + "</Polygon></Body></MaterialPoints><Material Type='1' Name='low'>" + material +
                          "<Friction lawname='bond' matname='high'/></Material><Material Type='1' Name='high'>" +
                          material + "</Material>" + law + "</JANFEAInput>",
                      "deck.xml"),
      1);
}

const std::string joint =
    "<Material Type='Mohr' Name='bond'><stiffness-normal>10</stiffness-normal>"
    "<stiffness-shear>10</stiffness-shear></Material>";
const std::string interface = "<Material Type='LinearInterface' Name='bond'><Dnt>10</Dnt><Dt>10</Dt></Material>";
const std::string too_little = "carry too little stress";

}  // namespace

TEST_CASE("the area of a joint on a face at an angle to the grid is that of the face", "[preflight][joint]") {
  const auto area = [](double rise, double thickness) {
    const std::string text = report(rise, joint, "uGIMP", std::to_string(thickness));
    return std::stod(text.substr(text.find(", area ") + 7));
  };
  for (const double rise : {4.0, 2.0, 1.0}) {
    const double length = std::hypot(8, rise);
    CHECK(area(rise, 1) == Approx(length).epsilon(1e-5));
    CHECK(area(rise, 3) == Approx(3 * length).epsilon(1e-5));
  }
}

TEST_CASE("the summary warns of joints and interfaces at an angle to the grid with splines", "[preflight][joint]") {
  CHECK_THAT(report(4, joint, "quadratic"),
             Contains("the joint of 'low' and 'high' lies at an angle to the grid") && Contains(too_little));
  CHECK_THAT(report(4, interface, "B3SPLINE"), Contains("the interface of 'low' and 'high' lies at an angle"));
  for (const auto& law : {joint, interface}) {
    CHECK_THAT(report(4, law, "uGIMP"), !Contains(too_little));
    CHECK_THAT(report(0, law, "quadratic"), !Contains(too_little));
  }
}
