// SPDX-License-Identifier: MIT
/// What the summary of a model says of joints and interfaces at an angle to the grid.

#include "input/read.hpp"
#include "run/preflight.hpp"

#include <catch2/catch.hpp>

#include <cmath>

using namespace tribo;
using Catch::Contains;

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
