// SPDX-License-Identifier: MIT
/// Rigid bodies that leave the grid: told before the run, an error in it.

#include "input/read.hpp"
#include "particles/fill.hpp"
#include "run/simulation.hpp"
#include "run/travel_report.hpp"
#include "scratch.hpp"

#include <catch2/catch.hpp>

using namespace tribo;
using Catch::Contains;

namespace {

// A rigid bar on y 2 to 4 of a grid of 10 x 10, for a time of 1.
Model bar(const std::string& motion, const std::string& body = "", const std::string& header = "") {
  return read_model_text(
      "<JANFEAInput version='3'><Header><Analysis>10</Analysis><ConsistentUnits length='m' mass='kg' "
      "time='s'/></Header><MPMHeader><MaxTime>1</MaxTime><ArchiveTime>1</ArchiveTime><GIMP/>" +
          header +
          "<MultiMaterialMode/></MPMHeader><Mesh><Grid xmin='0' xmax='10' ymin='0' ymax='10'>"
          "<Horiz nx='10'/><Vert ny='10'/></Grid></Mesh><MaterialPoints>"
          "<Body matname='bar' " +
          body +
          "><Rect xmin='4' xmax='6' ymin='2' ymax='4'/></Body>"
          "<Body matname='clay'><Rect xmin='2' xmax='8' ymin='0' ymax='2'/></Body></MaterialPoints>"
          "<Material Type='LinearElastic' Name='clay'><rho>1000</rho><E>1e5</E><nu>0.3</nu></Material>"
          "<Material Type='RigidContact' Name='bar'>" +
          motion + "</Material></JANFEAInput>",
      "deck.xml");
}

std::string advice(const Model& model) {
  std::string all;
  for (const auto& text : describe_travel(model, place_points(model)).advice) all += text + "\n";
  return all;
}

}  // namespace

TEST_CASE("a rigid body that leaves the grid is told before the run", "[preflight][rigid]") {
  CHECK(advice(bar("")).empty());
  // The outermost particles are at a distance of 0.25 from the face at y = 4.
  CHECK_THAT(advice(bar("", "vy='12.5'")), Contains("the rigid body 'bar' leaves the grid at time 0.5"));
  CHECK(advice(bar("", "vy='6'")).empty());
  CHECK_THAT(advice(bar("<SettingFunction2>12.5*2*t</SettingFunction2>")),
             Contains("leaves the grid at time 0.7"));  // 6.25 = 12.5 t^2
  CHECK(advice(bar("<SettingFunction2>6*cos(6.28*t)</SettingFunction2>")).empty());
}

TEST_CASE("a rigid body that leaves the grid stops the run, whatever LeaveLimit says", "[rigid]") {
  const ScratchFolder scratch;
  RunOptions options;
  options.folder = scratch.path / "out", options.quiet = true;
  CHECK_THROWS_WITH(tribo::run(bar("", "vy='12.5'", "<LeaveLimit>1000</LeaveLimit>"), options),
                    Contains("of 'bar'") && Contains("a rigid body must stay inside"));
}
