// SPDX-License-Identifier: MIT
#include "blocks/assembly.hpp"
#include "input/read.hpp"
#include "run/block_run.hpp"

#include <catch2/catch.hpp>

using namespace tribo;

namespace {

// A block falls with a velocity onto a held plank; how the steps end after a time.
double height_after_fall(double velocity, double thickness, double dt, const std::string& stiffness = "1e6") {
  const std::string text = R"(<JANFEAInput version='3'>
  <Header><Analysis>10</Analysis><ConsistentUnits length='m' mass='kg' time='s'/></Header>
  <MPMHeader><TimeStep>1</TimeStep><MaxTime>1</MaxTime><ArchiveTime>1</ArchiveTime></MPMHeader>
  <Blocks lawname='rub' touchname='rub'>
    <BoxBlock xmin='-2' xmax='2' ymin=')" +
                           std::to_string(-thickness) + R"(' ymax='0' rho='2000'/>
    <BoxBlock xmin='-0.25' xmax='0.25' ymin='1' ymax='1.5' rho='2000' vy=')" +
                           std::to_string(-velocity) + R"('/>
    <Hold vx='0' vy='0' spinz='0'><Rect xmin='-3' xmax='3' ymin='-1' ymax='0'/></Hold>
  </Blocks>
  <Material Type='SpringNetwork' Name='rub'><kn>)" +
                           stiffness +
                           R"(</kn><ks>1e6</ks><fric>0.5</fric></Material>
</JANFEAInput>)";
  const Model model = read_model_text(text, "plank.xml");
  Assembly blocks = assemble(model);
  const double step = dt > 0 ? dt : blocks.critical_step();
  CHECK(blocks.unbalanced() == 0.0);
  while (blocks.time < 3 / velocity) blocks.advance(step), blocks.check_contacts();
  return blocks.motion[1].x[1];
}

}  // namespace

TEST_CASE("a block does not pass through a plank: it rebounds, or the run stops", "[blocks]") {
  CHECK(height_after_fall(1.0, 0.2, 0) > 0.2);
  // Steps of 0.5 and 3 times the thickness, in which it would be on the other side unseen
  for (const double step : {0.1, 0.6}) {
    INFO(step);
    CHECK_THROWS_WITH(height_after_fall(1000.0, 0.2, step / 1000),
                      Catch::Contains("one could pass through the other unseen"));
  }
}

TEST_CASE("a block that sinks into another one because its contact is too soft stops the run", "[blocks]") {
  CHECK_THROWS_WITH(height_after_fall(1.0, 0.2, 1e-3, "10"),
                    Catch::Contains("the blocks 1 and 2 overlap by 0.0") &&
                        Catch::Contains("more than a third of the thickness of the thinner one, 0.2") &&
                        Catch::Contains("10 per area, is too small"));
}

TEST_CASE("a block that falls freely is not in balance", "[blocks]") {
  const Model model = read_model_text(R"(<JANFEAInput version='3'>
  <Header><Analysis>10</Analysis><ConsistentUnits length='m' mass='kg' time='s'/></Header>
  <MPMHeader><TimeStep>1</TimeStep><MaxTime>1</MaxTime><ArchiveTime>1</ArchiveTime></MPMHeader>
  <Blocks lawname='rub' touchname='rub'><BoxBlock xmin='0' xmax='1' ymin='1' ymax='2' rho='2000'/></Blocks>
  <Gravity><BodyYForce>-9.81</BodyYForce></Gravity>
  <Material Type='SpringNetwork' Name='rub'><kn>1e6</kn><ks>1e6</ks><fric>0.5</fric></Material>
</JANFEAInput>)",
                                      "fall.xml");
  Assembly blocks = assemble(model);
  for (int k = 0; k < 3; ++k) blocks.advance(1e-3);
  CHECK(blocks.unbalanced() == 1.0);
}
