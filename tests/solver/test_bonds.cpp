// SPDX-License-Identifier: MIT
/// Bonds of contact faces that touch from the start.
#include "input/read.hpp"
#include "solver/build.hpp"
#include "solver/measures.hpp"
#include "solver/step.hpp"

#include <catch2/catch.hpp>

using namespace tribo;

namespace {

// Two blocks that touch at x = 10 + gap and move apart.
Model parting_blocks(const std::string& mode, const std::string& law, double gap = 0) {
  return read_model_text(R"(<JANFEAInput version='3'>
 <Header><Analysis>10</Analysis><ConsistentUnits length='m' mass='kg' time='s'/></Header>
 <MPMHeader><MaxTime>1</MaxTime><ArchiveTime>1</ArchiveTime><GIMP/><Transfer type='FLIP'/>)" +
                             mode + R"(</MPMHeader>
 <Mesh><Grid xmin='0' xmax='20' ymin='0' ymax='10'><Horiz nx='20'/><Vert ny='10'/></Grid></Mesh>
 <MaterialPoints><Body matname='a' vx='-0.01'><Rect xmin='6' xmax='10' ymin='3' ymax='7'/></Body>
  <Body matname='b' vx='0.01'><Rect xmin=')" +
                             std::to_string(10 + gap) + R"(' xmax='14' ymin='3' ymax='7'/></Body></MaterialPoints>
 <Material Type='1' Name='a'><rho>1</rho><E>100</E><nu>0</nu></Material>
 <Material Type='1' Name='b'><rho>1</rho><E>100</E><nu>0</nu></Material>)" +
                             law + "</JANFEAInput>",
                         "deck.xml");
}

// Momentum of the left block after a few steps over that at the start: 1 if nothing holds it.
double momentum_kept(const std::string& normals, const std::string& law, double gap = 0) {
  const Model model =
      parting_blocks("<MultiMaterialMode " + normals + "<Friction lawname='law'/></MultiMaterialMode>", law, gap);
  auto system = build_system<2>(model, place_points(model));
  Stepper<2> stepper(model, system);
  const double before = measure(system.bodies[0]).momentum[0];
  for (int k = 0; k < 16; ++k) stepper.advance(0.02);
  return measure(system.bodies[0]).momentum[0] / before;
}

const std::string bonding =
    "<Material Type='AdhesiveFriction' Name='law'><coeff>0.3</coeff><Sa>100</Sa><Na>100</Na></Material>";
const std::string bondless = "<Material Type='AdhesiveFriction' Name='law'><coeff>0.3</coeff></Material>";

}  // namespace

TEST_CASE("faces that touch from the start are bonded, however gaps are found", "[contact]") {
  const std::string normals = GENERATE(as<std::string>{}, ">", "Normals='specify' Azimuth='0'>",
                                       "Normals='specify' Azimuth='0'><ContactPosition>0.8</ContactPosition>",
                                       "Normals='specify' Azimuth='0'><ContactPosition>-0.58</ContactPosition>",
                                       "Normals='avggrad'><ContactPosition>0.8</ContactPosition>");
  INFO(normals);
  CHECK(momentum_kept(normals, bonding) < 0.6);
  CHECK(momentum_kept(normals, bondless) == Approx(1));
  // Apart from the start. Gaps from displacements take the bodies as touching wherever they start.
  if (normals != "Normals='specify' Azimuth='0'>") CHECK(momentum_kept(normals, bonding, 0.25) == Approx(1));
}
