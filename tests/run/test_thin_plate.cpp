// SPDX-License-Identifier: MIT
#include "input/read.hpp"
#include "run/energy_balance.hpp"
#include "run/step_size.hpp"
#include "solver/build.hpp"

#include <catch2/catch.hpp>

using namespace tribo;

namespace {

// A plate anchor of one and two cells, pulled out of sand. Its corners move across the edges of shape functions, so
// that some nodes have next to no mass.
std::string anchor(const std::string& load) {
  return R"(<JANFEAInput version='3'>
 <Header><Analysis>10</Analysis><ConsistentUnits length='m' mass='kg' time='s'/></Header>
 <MPMHeader><GIMP/><MPMMethod>USL</MPMMethod><MatlPtsPerElement>4</MatlPtsPerElement><Damping>2</Damping>
  <Transfer type='FLIP'/><MultiMaterialMode Impulses='faces'/><MaxTime>0.12</MaxTime><ArchiveTime>1</ArchiveTime></MPMHeader>
 <Mesh><Grid xmin='-0.5' xmax='2' ymin='0' ymax='3'><Horiz cellsize='0.1' symmin='0' symmax='1.5'/>
  <Vert cellsize='0.1' symmin='0.5'/></Grid></Mesh>
 <MaterialPoints>
  <Body matname='plate'><Rect xmin='0' xmax='0.5' ymin='1' ymax='1.2'/></Body>
  <Body matname='plate'><Rect xmin='0' xmax='0.1' ymin='1.2' ymax='2.5'/></Body>
  <Body matname='sand'><InitialStress K0='0.5'/><Rect xmin='0' xmax='1.5' ymin='0.5' ymax='2'/></Body>
 </MaterialPoints>
 <Material Type='LinearElastic' Name='plate'><rho>7800</rho><E>2e8</E><nu>0.3</nu>
  <Friction lawname='f' matname='sand'/></Material>
 <Material Type='MohrCoulomb' Name='sand'><rho>1700</rho><K>2e7</K><G>1e7</G><cohesion>500</cohesion>
  <friction>35</friction><dilation>5</dilation></Material>
 <Material Type='CoulombFriction' Name='f'><coeff>0.4</coeff></Material>
 <Gravity><BodyYForce>-9.81</BodyYForce></Gravity>
 <ParticleBCs><LdRect xmin='0' xmax='0.1' ymin='2.4' ymax='2.5'><LoadBC dir='2' style='2' load=')" +
         load + R"('/></LdRect></ParticleBCs>
</JANFEAInput>)";
}

}  // namespace

TEST_CASE("contact of thin plates with impulses on faces creates no energy at light nodes", "[contact]") {
  const auto* load = GENERATE("5e3", "2e4");
  const Model model = read_model_text(anchor(load), "anchor.xml");
  auto system = build_system<2>(model, place_points(model));
  Stepper<2> stepper(model, system);
  const double dt = StepSize<2>(model, system).first().size;
  const double supplied = measure(system).stored;  // the elastic energy of the ground at rest
  double kinetic = 0.0;
  while (system.time < model.time.end) {
    stepper.advance(dt);
    if (system.step % 20 == 0) kinetic = std::max(kinetic, measure(system).kinetic);
  }
  const auto energies = run_energies(model, system, stepper, measure(system));
  CHECK(kinetic < supplied);
  CHECK(energies.contact >= 0);
  CHECK(energies.contact < supplied);
}
