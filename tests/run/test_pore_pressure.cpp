// SPDX-License-Identifier: MIT
/// Pore pressure as a function of place and time, and joints that it tears at the start.

#include "input/read.hpp"
#include "run/block_run.hpp"
#include "run/pore_pressure.hpp"
#include "solver/build.hpp"
#include "solver/step.hpp"

#include <catch2/catch.hpp>

using namespace tribo;

namespace {

// Two blocks on each other with a joint between them, or a crack with a joint.
Model pressed(const std::string& properties, bool crack = false) {
  return read_model_text(
      R"(<JANFEAInput version='3'>
 <Header><Analysis>10</Analysis><ConsistentUnits length='m' mass='kg' time='s'/></Header>
 <MPMHeader><TimeStep>1e-3</TimeStep><MaxTime>0.02</MaxTime><ArchiveTime>0.02</ArchiveTime>)" +
          std::string(crack ? "" : "<MultiMaterialMode/>") + R"(</MPMHeader>
 <Mesh><Grid xmin='0' xmax='8' ymin='0' ymax='8'><Horiz nx='8'/><Vert ny='8'/></Grid></Mesh>
 <MaterialPoints>
  <Body matname='below'><Rect xmin='2' xmax='6' ymin='2' ymax='4'/></Body>
  <Body matname=')" +
          (crack ? "below" : "above") + R"('><Rect xmin='2' xmax='6' ymin='4' ymax='6'/></Body>
 </MaterialPoints>)" +
          (crack ? "<CrackList lawname='joint'><Line xmin='2' ymin='4' xmax='6' ymax='4'/></CrackList>" : "") +
          R"(<Material Type='1' Name='below'><rho>1000</rho><E>1e6</E><nu>0</nu></Material>
 <Material Type='1' Name='above'><rho>1000</rho><E>1e6</E><nu>0</nu>)" +
          (crack ? "" : "<Friction lawname='joint' matname='below'/>") + R"(</Material>
 <Material Type='Mohr' Name='joint'><stiffness-normal>1e7</stiffness-normal><stiffness-shear>1e7</stiffness-shear>
  <cohesion>1</cohesion>)" +
          properties + "</Material></JANFEAInput>",
      "pressed.xml");
}

const std::string table =
    "<pore-pressure>10</pore-pressure><pore-pressure-function>100*x+7*y+1000*t"
    "</pore-pressure-function>";

}  // namespace

TEST_CASE("joints in the grid have the pore pressure of their place and time", "[joint][pressure]") {
  const bool crack = GENERATE(false, true);
  const Model model = pressed(table + "<stress-normal>-5000</stress-normal>", crack);
  auto system = build_system<2>(model, place_points(model));
  Stepper<2> stepper(model, system);
  REQUIRE(system.joints.size() == 1);
  const auto& surface = system.joints[0];
  const auto expected = [&](std::size_t k) { return 100 * surface.x[k][0] + 7 * surface.x[k][1] + 1000 * system.time; };
  for (std::size_t k = 0; k < surface.joints.size(); ++k) CHECK(surface.joints[k].pressure == Approx(expected(k)));
  stepper.advance(1e-3), stepper.advance(1e-3);
  for (std::size_t k = 0; k < surface.joints.size(); ++k) {
    CHECK(surface.joints[k].pressure == Approx(expected(k)).epsilon(1e-3));
    const Joint& j = surface.joints[k];
    CHECK(surface.law->own_values(j)[0] == Approx(j.Fn / j.area + 10 + j.pressure));
  }
}

TEST_CASE("a pore pressure that tears joints at the start is noticed", "[joint][pressure]") {
  const auto count = [](const Model& model) { return torn_by_pressure(build_system<2>(model, place_points(model))); };
  CHECK_THAT(count(pressed(table)), Catch::Contains("joints tear in the first step"));
  CHECK_THAT(count(pressed(table, true)), Catch::Contains("joints tear in the first step"));
  CHECK(count(pressed("<tension>10</tension>")).empty());
  CHECK(count(pressed(table + "<tension>1e4</tension>")).empty());
  CHECK(count(pressed(table + "<stress-normal>-2000</stress-normal>")).empty());
  const Model balanced = pressed(table + "<pressure-in-equilibrium>1</pressure-in-equilibrium>");
  CHECK(count(balanced).empty());
  const auto system = build_system<2>(balanced, place_points(balanced));
  for (const Joint& j : system.joints[0].joints) CHECK(j.Fn == Approx(-j.area * (10 + j.pressure)));
}

TEST_CASE("contacts of blocks have the pore pressure of their place and time", "[blocks][pressure]") {
  const auto blocks = [](const std::string& more) {
    return read_model_text(
        "<JANFEAInput version='3'><Header><Analysis>10</Analysis><ConsistentUnits length='m' mass='kg' time='s'/>"
        "</Header><MPMHeader><MaxTime>0.02</MaxTime><ArchiveTime>0.02</ArchiveTime></MPMHeader><Blocks lawname='bond'>"
        "<BoxBlock xmin='0' xmax='1' ymin='0' ymax='1' rho='1000'/><BoxBlock xmin='0' xmax='1' ymin='1' ymax='2' "
        "rho='1000'/></Blocks><Material Type='SpringNetwork' Name='bond'><kn>1e6</kn><ks>1e6</ks><sn_coh>1e9</sn_coh>"
        "<bond/>" +
            more + "</Material></JANFEAInput>",
        "blocks.xml");
  };
  const Model wet = blocks("<sn_ten>1e9</sn_ten><sn_porp_function>50*x+3*y+100*t</sn_porp_function>");
  Assembly assembly = assemble(wet);
  REQUIRE(assembly.joints.size() == 1);
  CHECK(assembly.joints[0].pressure == Approx(50 * 0.5 + 3));
  for (int k = 0; k < 10; ++k) assembly.advance(1e-4);
  CHECK(assembly.joints[0].pressure == Approx(50 * 0.5 + 3 + 100 * 1e-3));
  CHECK(torn_by_pressure(assembly).empty());
  const std::string function = "<sn_porp_function>50</sn_porp_function>";
  CHECK_THAT(torn_by_pressure(assemble(blocks("<sn_ten>40</sn_ten>" + function))), Catch::Contains("1 joint tears"));
  CHECK(torn_by_pressure(assemble(blocks("<sn_ten>60</sn_ten>" + function))).empty());
  const Assembly balanced =
      assemble(blocks("<sn_ten>40</sn_ten><sn_porp_equilibrium>1</sn_porp_equilibrium>" + function));
  CHECK(torn_by_pressure(balanced).empty());
  CHECK(balanced.joints[0].Fn == Approx(-50));
}
