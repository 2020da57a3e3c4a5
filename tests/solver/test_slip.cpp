// SPDX-License-Identifier: MIT
/// The slip that particles at a contact remember.
#include "cloud.hpp"
#include "input/read.hpp"

using namespace tribo;
using namespace tribo::test;

TEST_CASE("slip since the faces last stuck is kept while they do not touch", "[contact]") {
  const Model model = read_model_text(R"(<JANFEAInput version='3'>
 <Header><Analysis>10</Analysis><ConsistentUnits length='m' mass='kg' time='s'/></Header>
 <MPMHeader><MaxTime>1</MaxTime><ArchiveTime>1</ArchiveTime><GIMP/><Transfer type='FLIP'/>
  <MultiMaterialMode><Friction lawname='law'/></MultiMaterialMode></MPMHeader>
 <Mesh><Grid xmin='0' xmax='20' ymin='0' ymax='12'><Horiz nx='20'/><Vert ny='12'/></Grid></Mesh>
 <MaterialPoints><Body matname='a'><Rect xmin='4' xmax='16' ymin='2' ymax='6'/></Body>
  <Body matname='b' vx='1' vy='-0.1'><Rect xmin='6' xmax='12' ymin='6' ymax='9'/></Body></MaterialPoints>
 <Material Type='1' Name='a'><rho>1</rho><E>100</E><nu>0</nu></Material>
 <Material Type='1' Name='b'><rho>1</rho><E>100</E><nu>0</nu></Material>
 <Material Type='CoulombFriction' Name='law'><coeff>0.1</coeff><coeffStatic>0.2</coeffStatic></Material></JANFEAInput>)",
                                      "deck.xml");
  auto system = build_system<2>(model, place_points(model));
  auto& upper = system.bodies[1];
  Stepper<2> stepper(model, system);
  const auto slip = [&] {
    std::map<std::int64_t, double> out;
    for (std::size_t i = 0; i < upper.particles.size(); ++i)
      out[upper.particles.id[i]] = upper.particles[upper.contact_slip][i];
    return out;
  };
  const auto most = [](const auto& of) {
    double value = 0;
    for (const auto& [id, s] : of) value = std::max(value, s);
    return value;
  };
  for (int k = 0; k < 10; ++k) stepper.advance(0.01);
  CHECK(most(slip()) == Approx(0.1).epsilon(0.05));
  for (auto& body : system.bodies) set_velocity<2>(body, [](const Vec<2>& x) { return Vec<2>(0, x[1] > 6 ? 1 : 0); });
  for (int k = 0; k < 5; ++k) stepper.advance(0.01);
  const auto slid = slip();
  CHECK(most(slid) > 0.05);
  CHECK(stepper.contact().ledger().total().area == 0);  // they are apart
  stepper.advance(0.01);
  for (const auto& [id, now] : slip()) CHECK(now == slid.at(id));
}
