// SPDX-License-Identifier: MIT
#include "run/contact_probe.hpp"

#include "input/read.hpp"
#include "solver/build.hpp"

#include <catch2/catch.hpp>

using namespace tribo;

namespace {

// Two blocks of 4 cells, the upper one with a gap above the lower one, under a gravity of 2.
Model two_blocks(double gap) {
  return read_model_text(R"(<JANFEAInput version='3'>
 <Header><Analysis>10</Analysis><ConsistentUnits length='m' mass='kg' time='s'/></Header>
 <MPMHeader><GIMP/><MaxTime>4</MaxTime><ArchiveTime>1</ArchiveTime><MultiMaterialMode/></MPMHeader>
 <Mesh><Grid xmin='0' xmax='8' ymin='0' ymax='16'><Horiz nx='8'/><Vert ny='16'/></Grid></Mesh>
 <MaterialPoints>
  <Body matname='low'><Rect xmin='2' xmax='6' ymin='1' ymax='5'/></Body>
  <Body matname='high'><Rect xmin='2' xmax='6' ymin=')" +
                             std::to_string(5 + gap) + "' ymax='" + std::to_string(9 + gap) + R"('/></Body>
 </MaterialPoints>
 <Material Type='1' Name='low'><rho>1</rho><E>1e3</E><nu>0</nu></Material>
 <Material Type='1' Name='high'><rho>1</rho><E>1e3</E><nu>0</nu></Material>
 <Gravity><BodyYForce>-2</BodyYForce></Gravity>
</JANFEAInput>)",
                         "blocks.xml");
}

}  // namespace

TEST_CASE("the share of a run in contact is that after a body has fallen onto another", "[run]") {
  const Model touching = two_blocks(0), falling = two_blocks(4);
  auto at_rest = build_system<2>(touching, place_points(touching));
  CHECK(bring_into_contact(touching, at_rest) == 1.0);
  auto falls = build_system<2>(falling, place_points(falling));
  // The lower block falls out of the grid. The upper one reaches its place, 4 below, after sqrt(2 * 4 / 2) = 2 of 4,
  // less the time for a cell.
  CHECK(bring_into_contact(falling, falls) == Approx(0.5).margin(0.1));
}

TEST_CASE("pressed bodies move towards each other", "[run]") {
  const Model model = two_blocks(0);
  auto system = build_system<2>(model, place_points(model));
  press_bodies(system, 0.5);
  REQUIRE(system.bodies.size() == 2);
  for (std::size_t k = 0; k < 2; ++k) {
    const Vec<2> v = system.bodies[k].particles.velocity(0);
    CHECK(std::abs(v[0]) < 1e-12);
    CHECK(std::abs(v[1]) == Approx(0.5));
  }
  CHECK(system.bodies[0].particles.velocity(0)[1] == -system.bodies[1].particles.velocity(0)[1]);
}
