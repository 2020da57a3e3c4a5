// SPDX-License-Identifier: MIT
#include "run/bare_edges.hpp"

#include "input/read.hpp"

#include <catch2/catch.hpp>

using namespace tribo;

namespace {

Model box(const std::string& kernel, const std::string& axis, const std::string& conditions) {
  return read_model_text(
      R"(<JANFEAInput version='3'>
 <Header><Analysis>10</Analysis><ConsistentUnits length='m' mass='kg' time='s'/></Header>
 <MPMHeader><GIMP type=')" +
          kernel +
          R"('/><MPMMethod>USL</MPMMethod><MaxTime>1</MaxTime><ArchiveTime>1</ArchiveTime></MPMHeader>
 <Mesh><Grid xmin='0' xmax='2' ymin='0' ymax='3'><Horiz cellsize='0.1'/><Vert cellsize='0.1' )" +
          axis + R"(/></Grid></Mesh>
 <MaterialPoints><Body matname='m'><Rect xmin='0.5' xmax='1.5' ymin='0' ymax='1'/></Body></MaterialPoints>
 <Material Type='LinearElastic' Name='m'><rho>1000</rho><E>1e6</E><nu>0.3</nu></Material>
 <GridBCs>)" +
          conditions + "</GridBCs></JANFEAInput>",
      "box.xml");
}

std::string floor(const std::string& low, const std::string& direction, const std::string& right = "2",
                  const std::string& high = "0") {
  return "<BCBox xmin='0' xmax='" + right + "' ymin='" + low + "' ymax='" + high + "' zmin='0' zmax='0'><DisBC dir='" +
         direction + "' vel='0'/></BCBox>";
}

}  // namespace

TEST_CASE("an edge of the grid that only prescribed velocities hold is reported under B-splines", "[check]") {
  const auto advice = bare_edges(box("quadratic", "", floor("0", "2")));
  REQUIRE(advice.size() == 1);
  CHECK(advice[0].find("y = 0") != std::string::npos);
  CHECK(advice[0].find("<Vert ... wallmin='0'>") != std::string::npos);
}

TEST_CASE("edges that hold bodies well are not reported", "[check]") {
  CHECK(bare_edges(box("uGIMP", "", floor("0", "2"))).empty());                  // no spline
  CHECK(bare_edges(box("quadratic", "wallmin='0'", floor("0", "2"))).empty());   // a wall
  CHECK(bare_edges(box("quadratic", "symmin='0'", floor("0", "1"))).empty());    // a plane of symmetry
  CHECK(bare_edges(box("quadratic", "", floor("0", "1"))).empty());              // only along the edge
  CHECK(bare_edges(box("quadratic", "", floor("-0.1", "2"))).empty());           // the nodes beyond, too
  CHECK(bare_edges(box("quadratic", "", floor("0", "2", "2", "0.1"))).empty());  // the nodes before, too
  CHECK(bare_edges(box("quadratic", "", floor("0", "2", "0.5"))).empty());       // a part of the edge
  CHECK(bare_edges(box("quadratic", "", "")).empty());
}
