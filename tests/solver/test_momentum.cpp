// SPDX-License-Identifier: MIT
/// Impulses of contact and of prescribed velocities, as they are recorded, are what bodies receive.
#include "input/read.hpp"
#include "solver/build.hpp"
#include "solver/measures.hpp"
#include "solver/step.hpp"

#include <catch2/catch.hpp>

using namespace tribo;

namespace {

// A block that runs into another body. `header`: method and transfer; `below`: material of the lower one; `conditions`;
// `more`: further properties of the material of the block.
Model block_on_block(const std::string& header, const std::string& below, const std::string& conditions = "",
                     const std::string& more = "") {
  return read_model_text(R"(<JANFEAInput version='3'>
 <Header><Analysis>10</Analysis><ConsistentUnits length='m' mass='kg' time='s'/></Header>
 <MPMHeader><MaxTime>1</MaxTime><ArchiveTime>1</ArchiveTime><GIMP type='quadratic'/>)" +
                             header + R"(</MPMHeader>
 <Mesh><Grid xmin='-8' xmax='8' ymin='-4' ymax='16'><Horiz nx='16'/><Vert ny='20'/></Grid></Mesh>
 <MaterialPoints><Body matname='below'><Rect xmin='-5' xmax='5' ymin='0' ymax='5'/></Body>
  <Body matname='above' vx='0.02' vy='-0.05'><Rect xmin='-3' xmax='3' ymin='5' ymax='9'/></Body></MaterialPoints>)" +
                             below + R"(<Material Type='1' Name='above'><rho>1</rho><E>100</E><nu>0.3</nu>)" + more +
                             R"(</Material>
 <Material Type='CoulombFriction' Name='law'><coeff>0.3</coeff></Material>)" +
                             conditions + "</JANFEAInput>",
                         "deck.xml");
}

const std::string
    soft = "<Material Type='1' Name='below'><rho>1</rho><E>100</E><nu>0.3</nu></Material>",
    damped_soft = "<Material Type='1' Name='below'><rho>1</rho><E>100</E><nu>0.3</nu><PDamping>5</PDamping></Material>";

std::string any_scheme() {
  const std::string transfer = GENERATE("type='FLIP'", "type='blend' fraction='0.9'", "type='APIC'", "type='PIC'",
                                        "type='XPIC' order='2'", "type='FMPM' order='2'", "type='FMPM' order='3'");
  const std::string method = GENERATE(
      "<MPMMethod>USL</MPMMethod>", "<MPMMethod>USAVG</MPMMethod>", "<MPMMethod>USF</MPMMethod>",
      "<MPMMethod>USL</MPMMethod><SkipPostExtrapolation/>", "<MPMMethod>USAVG</MPMMethod><SkipPostExtrapolation/>");
  INFO(transfer << " " << method);
  return method + "<Transfer " + transfer + "/>";
}

std::string any_contact() {
  const std::string impulses = GENERATE("nodes", "faces");
  return "<MultiMaterialMode Impulses='" + impulses + "'><Friction lawname='law'/></MultiMaterialMode>";
}

// A run of 40 steps, and the momentum that the deformable bodies received in it.
struct Run {
  explicit Run(const Model& model) : system(build_system<2>(model, place_points(model))), stepper(model, system) {
    const Measures first = measure(system);
    for (int k = 0; k < 40; ++k) stepper.advance(0.02);
    received = measure(system).momentum - first.momentum;
  }
  System<2> system;
  Stepper<2> stepper;
  Vec3 received;
};

}  // namespace

TEST_CASE("the recorded forces of contact are what bodies receive, with each transfer and order", "[momentum]") {
  const Model model = block_on_block(any_scheme() + any_contact(), soft);
  auto system = build_system<2>(model, place_points(model));
  Stepper<2> stepper(model, system);
  const Vec3 first = measure(system.bodies[0]).momentum;
  Vec3 given = Vec3::Zero();
  for (int k = 0; k < 40; ++k) {
    stepper.advance(0.02);
    for (const auto& [fields, pair] : stepper.contact().ledger().pairs) given += 0.02 * pair.force;
  }
  const Vec3 received = measure(system.bodies[0]).momentum - first;
  CHECK(received[1] < -0.1);
  CHECK((given - received).norm() < 1e-11 * received.norm());
}

TEST_CASE("the recorded impulse of a rigid body is what a body receives", "[momentum]") {
  const Model model =
      block_on_block(any_scheme() + any_contact(),
                     "<Material Type='RigidContact' Name='below'><SettingFunction2>0.03</SettingFunction2></Material>");
  Run run(model);
  CHECK(run.received[1] > 0.1);
  CHECK(run.received[0] < -0.001);
  CHECK((run.stepper.contact().ledger().rigid_impulse - run.received).norm() < 1e-11 * run.received.norm());
}

TEST_CASE("the recorded impulse of prescribed velocities is what a body receives", "[momentum]") {
  const Model model = block_on_block(
      any_scheme(), soft,
      "<GridBCs><BCBox xmin='-4' xmax='4' ymin='7' ymax='9' zmin='0' zmax='0'><DisBC dir='2' vel='-0.05'/>"
      "<DisBC dir='1' vel='0.02'/></BCBox></GridBCs>");
  Run run(model);
  CHECK(run.received.norm() > 0.1);
  CHECK((run.stepper.conditions(0).impulse() - run.received).norm() < 1e-11 * run.received.norm());
}

TEST_CASE("conditions prescribe the velocities of bodies, not of a rigid body at the same nodes", "[momentum]") {
  const Model model =
      block_on_block(any_scheme() + any_contact(),
                     "<Material Type='RigidContact' Name='below'><SettingFunction2>0.03</SettingFunction2></Material>",
                     "<GridBCs><BCBox xmin='-8' xmax='8' ymin='4' ymax='6' zmin='0' zmax='0'><DisBC dir='1' vel='0'/>"
                     "</BCBox></GridBCs>");
  Run run(model);
  CHECK(run.received[1] > 0.1);
  Vec3 given = run.stepper.contact().ledger().rigid_impulse;
  CHECK(given[1] == Approx(run.received[1]));
  for (std::size_t f = 0; f < run.system.fields.size(); ++f) given += run.stepper.conditions(f).impulse();
  CHECK((given - run.received).norm() < 1e-11 * run.received.norm());
}

TEST_CASE("particle damping leaves prescribed velocities alone", "[momentum]") {
  Run run(block_on_block(any_scheme(), damped_soft,
                         "<GridBCs><BCBox xmin='-8' xmax='8' ymin='4' ymax='12' zmin='0' zmax='0'>"
                         "<DisBC dir='2' vel='-0.05'/></BCBox></GridBCs>",
                         "<PDamping>5</PDamping>"));
  CHECK(run.stepper.ledger().damping_work > 1e-4);  // along x, where the block is free
  Body<2>& above = run.system.bodies[1];
  for (std::size_t i = 0; i < above.particles.size(); ++i) {
    if (above.particles.x()[1][i] < 7.7) continue;  // its nodes are prescribed and out of reach of the body below
    CHECK(above.particles.v()[1][i] == Approx(-0.05).epsilon(1e-9));
  }
  const Vec3 given = run.stepper.conditions(0).impulse() + run.stepper.ledger().impulse;
  CHECK((given - run.received).norm() < 1e-11 * run.received.norm());
}

TEST_CASE("particles keep what damping of prescribed velocities needs only where it occurs", "[momentum]") {
  const std::string grip =
      "<GridBCs><BCBox xmin='-8' xmax='8' ymin='4' ymax='12' zmin='0' zmax='0'>"
      "<DisBC dir='2' vel='0'/></BCBox></GridBCs>";
  const auto keeps = [](const Model& model) {
    auto system = build_system<2>(model, place_points(model));
    return static_cast<bool>(system.bodies[0].damped);
  };
  const std::string header = "<MPMMethod>USL</MPMMethod>", damped = header + "<PDamping>5</PDamping>";
  CHECK_FALSE(keeps(block_on_block(header, soft, grip)));
  CHECK_FALSE(keeps(block_on_block(damped, soft)));
  CHECK(keeps(block_on_block(damped, soft, grip)));
  CHECK(keeps(block_on_block(header, soft, grip + "<Stage at='0.5'><PDamping>5</PDamping></Stage>")));
  CHECK(keeps(block_on_block(damped, soft, "<Stage at='0.5'>" + grip + "</Stage>")));
}
