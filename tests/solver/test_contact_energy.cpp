// SPDX-License-Identifier: MIT
/// The energy balance of bodies that touch.
#include "input/read.hpp"
#include "materials/material.hpp"
#include "run/energy_balance.hpp"
#include "solver/build.hpp"

#include <catch2/catch.hpp>

using namespace tribo;

namespace {

// A short bar that runs into another one at rest.
Model running_bars(const std::string& header) {
  return read_model_text(R"(<JANFEAInput version='3'>
 <Header><Analysis>10</Analysis><ConsistentUnits length='m' mass='kg' time='s'/></Header>
 <MPMHeader><MPMMethod>USL</MPMMethod><SkipPostExtrapolation/><MaxTime>1</MaxTime><ArchiveTime>1</ArchiveTime><GIMP type='quadratic'/>)" +
                             header + R"(</MPMHeader>
 <Mesh><Grid xmin='0' xmax='40' ymin='0' ymax='8'><Horiz nx='40'/><Vert ny='8'/></Grid></Mesh>
 <MaterialPoints><Body matname='a' vx='0.01'><Rect xmin='4' xmax='20' ymin='3' ymax='5'/></Body>
  <Body matname='b'><Rect xmin='20' xmax='36' ymin='3' ymax='5'/></Body></MaterialPoints>
 <Material Type='1' Name='a'><rho>1</rho><E>100</E><nu>0</nu></Material>
 <Material Type='1' Name='b'><rho>1</rho><E>100</E><nu>0</nu></Material></JANFEAInput>)",
                         "deck.xml");
}

}  // namespace

TEST_CASE("the loss by extrapolation at a contact does not depend on a force on all bodies", "[energy]") {
  const std::string impulses = GENERATE("nodes", "faces");
  Model model = running_bars("<Transfer type='APIC'/><MultiMaterialMode Impulses='" + impulses + "'/>");
  const auto work = [&] {
    auto system = build_system<2>(model, place_points(model));
    Stepper<2> stepper(model, system);
    stepper.advance(0.02);
    return stepper.contact().ledger().nodal_work;
  };
  const double still = work();
  model.body_force.gravity = Vec3(3, -2, 0);
  CHECK(still != 0);
  CHECK(work() == Approx(still).epsilon(1e-9));
}

TEST_CASE("frictionless impact dissipates nothing in contact, and the balance closes", "[energy]") {
  const std::string transfer = GENERATE("type='FMPM' order='2'", "type='FMPM' order='4'", "type='APIC'", "type='PIC'",
                                        "type='FLIP'", "type='XPIC' order='2'");
  const std::string impulses = GENERATE("nodes", "faces");
  INFO(transfer << ", " << impulses);
  const Model model = running_bars("<Transfer " + transfer + "/><MultiMaterialMode Impulses='" + impulses + "'/>");
  auto system = build_system<2>(model, place_points(model));
  Stepper<2> stepper(model, system);
  const double first = measure(system).kinetic;
  double worst = 0.0;
  for (int k = 0; k < 40; ++k) {  // the waves cross half of the bars
    stepper.advance(0.02);
    const Measures all = measure(system);
    worst = std::max(worst, std::abs(energy_content(all, run_energies(model, system, stepper, all)) - first));
  }
  const Measures all = measure(system);
  const RunEnergies run = run_energies(model, system, stepper, all);
  CHECK(all.stored > 0.1 * first);
  CHECK(worst < 0.02 * first);
  CHECK(std::abs(run.contact) < 0.02 * first);
  CHECK(run.transfer > 0);
}

TEST_CASE("the balance closes where a rigid body presses a bar, also with what a filter adds to its impulse",
          "[energy]") {
  const std::string transfer =
      GENERATE("type='FMPM' order='2'", "type='FMPM' order='4'", "type='APIC'", "type='XPIC' order='2'", "type='FLIP'");
  const std::string impulses = GENERATE("nodes", "faces");
  INFO(transfer << ", " << impulses);
  Model model = running_bars("<Transfer " + transfer + "/><MultiMaterialMode Impulses='" + impulses + "'/>");
  Problems problems;
  model.materials[0].law = materials().find("RigidContact")->make(Statement{}, {}, Units{}, problems);
  model.materials[0].rigid_contact = true;
  model.materials[0].rigid_velocity[0].emplace("0.01*min(t/2,1)", Origin{});
  auto system = build_system<2>(model, place_points(model));
  Stepper<2> stepper(model, system);
  double worst = 0.0;
  for (int k = 0; k < 100; ++k) {
    stepper.advance(0.01);
    const Measures all = measure(system);
    const RunEnergies run = run_energies(model, system, stepper, all);
    worst = std::max(worst, std::abs(energy_residual(all, run, 0.0)));
  }
  const Measures all = measure(system);
  const RunEnergies run = run_energies(model, system, stepper, all);
  CHECK(run.boundary_work > 0.9 * (all.kinetic + all.stored));
  CHECK(worst < 0.02 * run.boundary_work);
}

TEST_CASE("contact creates no energy where velocities are extrapolated again, until the bars have parted", "[energy]") {
  const std::string transfer =
      GENERATE("type='FMPM' order='2'", "type='FMPM' order='4'", "type='APIC'", "type='PIC'", "type='FLIP'");
  const std::string impulses = GENERATE("nodes", "faces");
  const UpdateOrder order = GENERATE(UpdateOrder::usl, UpdateOrder::usavg);
  INFO(transfer << ", " << impulses << ", order " << static_cast<int>(order));
  Model model = running_bars("<Transfer " + transfer + "/><MultiMaterialMode Impulses='" + impulses + "'/>");
  model.scheme.order = order, model.scheme.extrapolate_again = true;
  auto system = build_system<2>(model, place_points(model));
  Stepper<2> stepper(model, system);
  const double first = measure(system).kinetic;
  double worst = 0.0, least = 0.0;
  for (int k = 0; k < 200; ++k) {
    stepper.advance(0.02);
    const Measures all = measure(system);
    const RunEnergies run = run_energies(model, system, stepper, all);
    worst = std::max(worst, std::abs(energy_content(all, run) - first)), least = std::min(least, run.contact);
  }
  CHECK(worst < 0.02 * first);
  CHECK(least > -0.002 * first);
}
