// SPDX-License-Identifier: MIT
/// Imperfect interfaces between two bodies.

#include "archived.hpp"
#include "base/parallel.hpp"
#include "cloud.hpp"
#include "contact/contact_cases.hpp"
#include "run/energy_balance.hpp"
#include "run/restart.hpp"

#include <filesystem>

using namespace tribo;
using namespace tribo::test;

namespace {

/// Two blocks of 4 x 4 cells, one above the other, with an interface law. The upper one is `gap` higher and moves with
/// `velocity`.
struct Blocks {
  Model model;
  System<2> system;

  Blocks(LawProperties law, double gap, const Vec<2>& velocity, Transfer transfer = Transfer::flip,
         UpdateOrder order = UpdateOrder::usavg)
      : model(pair(law, transfer, order)), system(build_system<2>(model, seeds(gap))) {
    set_velocity<2>(system.bodies[1], [&](const Vec<2>&) { return velocity; });
  }
  static Model pair(LawProperties law, Transfer transfer, UpdateOrder order) {
    Model model = grid_model<2>(Kernel::quadratic_spline, transfer, order, false, 20);
    model.materials[0].law = elastic(1, 1, 0);
    model.materials.push_back(model.materials[0]);
    model.materials[0].name = "lower", model.materials[1].name = "upper";
    model.contact.active = true;
    model.contact.default_law = make_law("62", law);
    return model;
  }
  static std::vector<Seed> seeds(double gap) {
    std::vector<Seed> out;
    for (int m = 0; m < 2; ++m)
      for (int j = 0; j < 8; ++j)
        for (int i = 0; i < 8; ++i) {
          Seed s;
          s.x = Vec3(8.25 + 0.5 * i, 6.25 + 0.5 * j + m * (4 + gap), 0);
          s.half_size.head<2>().setConstant(0.25);
          s.volume = s.mass = 0.25, s.material = m;
          out.push_back(s);
        }
    return out;
  }
  double energy(Stepper<2>& stepper) {
    const Measures all = measure(system, false);
    return all.kinetic + all.stored + stepper.joints().energies().stored;
  }
};

}  // namespace

TEST_CASE("bodies that meet at an imperfect interface keep momentum and gain no energy", "[interfaces]") {
  const double gap = GENERATE(0.0, 0.3);
  const Transfer transfer = GENERATE(Transfer::flip, Transfer::apic, Transfer::fmpm);
  const UpdateOrder order = GENERATE(UpdateOrder::usl, UpdateOrder::usavg, UpdateOrder::usf);
  INFO("gap " << gap << ", transfer " << static_cast<int>(transfer) << ", order " << static_cast<int>(order));
  for (const auto& law :
       {LawProperties{{"Dn", "0.3"}, {"Dt", "0.1"}}, LawProperties{{"Dnt", "1"}, {"Dnc", "-1"}, {"Dt", "0"}},
        LawProperties{{"Dn", "-1"}, {"Dt", "1"}}}) {
    Blocks blocks(law, gap, Vec<2>(0.01, -0.04), transfer, order);
    Stepper<2> stepper(blocks.model, blocks.system);
    const double first = blocks.energy(stepper);
    const Vec3 momentum = measure(blocks.system, false).momentum;
    double mean = 0.0, most = 0.0;
    while (blocks.system.time < 24) {
      const double dt = std::min(0.2, stepper.joints().stable_step());
      stepper.advance(dt);
      // single values oscillate, see verification/generated_models
      mean += dt / 8 * (blocks.energy(stepper) - mean);
      most = std::max(most, mean);
    }
    CHECK(most < 1.01 * first);
    CHECK((measure(blocks.system, false).momentum - momentum).norm() < 1e-12);
    // they did meet
    CHECK(measure(blocks.system.bodies[0], false).momentum.norm() > 0.01);
  }
}

TEST_CASE("an interface begins where faces touch, free of stress, and pulls back", "[interfaces]") {
  Blocks apart({{"Dn", "0.1"}, {"Dt", "0.1"}}, 0.3, Vec<2>(0, -0.04));
  Stepper<2> approaching(apart.model, apart.system);
  int steps = 0;
  while (apart.system.joints[0].joints.empty() && steps < 100) approaching.advance(0.1), ++steps;
  // faces touch within a twentieth of a cell
  CHECK(0.04 * 0.1 * steps == Approx(0.3).margin(0.06));
  CHECK(approaching.joints().energies().stored == 0.0);
  double area = 0;
  for (const Joint& joint : apart.system.joints[0].joints) area += joint.area;
  CHECK(area == Approx(4));

  // touching at the start and pulled off: the traction is Dn times the opening
  Blocks pulled({{"Dn", "0.1"}, {"Dt", "0.1"}}, 0, Vec<2>(0, 0.01));
  Stepper<2> stepper(pulled.model, pulled.system);
  for (int k = 0; k < 20; ++k) stepper.advance(0.1);
  for (const Joint& joint : pulled.system.joints[0].joints) {
    CHECK(joint.opening > 0);
    CHECK(joint.Fn == Approx(0.1 * joint.area * joint.opening));
  }
  CHECK(measure(pulled.system.bodies[0], false).momentum[1] > 0);
  CHECK(stepper.joints().energies().stored > 0);
}

TEST_CASE("faces of different length have the interface of their common part", "[interfaces]") {
  Blocks blocks({{"Dn", "0.1"}, {"Dt", "0.1"}}, 0, Vec<2>(0, 0));
  for (std::size_t i = 0; i < blocks.system.bodies[1].particles.size(); ++i)
    blocks.system.bodies[1].particles.x()[0][i] += 1.5;
  Stepper<2> stepper(blocks.model, blocks.system);
  stepper.advance(0.01);
  double area = 0;
  for (const Joint& joint : blocks.system.joints[0].joints) area += joint.area;
  CHECK(area == Approx(2.5));
}

TEST_CASE("faces that have parted may meet again", "[interfaces]") {
  Blocks blocks({{"Dnt", "1e-6"}, {"Dnc", "1"}, {"Dt", "0"}}, 0, Vec<2>(0, 0.3));
  Stepper<2> stepper(blocks.model, blocks.system);
  for (int k = 0; k < 150; ++k) stepper.advance(0.1);
  CHECK(blocks.system.joints[0].joints.empty());
  // what the interface stored when it opened has become a loss
  CHECK(stepper.joints().energies().stored == 0.0);
  CHECK(stepper.joints().energies().dissipated > 0.0);
  set_velocity<2>(blocks.system.bodies[1], [](const Vec<2>&) { return Vec<2>(0, -0.3); });
  for (int k = 0; k < 180; ++k) stepper.advance(0.1);
  CHECK(!blocks.system.joints[0].joints.empty());
}

TEST_CASE("imperfect interfaces: the same bits on any number of threads and after a restart", "[interfaces][threads]") {
  const auto start = [] { return Blocks({{"Dn", "0.3"}, {"Dt", "0.1"}}, 0.3, Vec<2>(0.02, -0.04), Transfer::fmpm); };
  const auto run = [&](int threads) {
    set_threads(threads);
    Blocks blocks = start();
    Stepper<2> stepper(blocks.model, blocks.system);
    for (int k = 0; k < 120; ++k) stepper.advance(0.1);
    set_threads(1);
    return archived(blocks.system);
  };
  const auto one = run(1);
  CHECK(one == run(3));
  const auto file = std::filesystem::temp_directory_path() / "tribo_test_imperfect.bin";
  Blocks blocks = start(), other = start();
  Stepper<2> stepper(blocks.model, blocks.system), resumed(other.model, other.system);
  for (int k = 0; k < 80; ++k) stepper.advance(0.1);
  REQUIRE(!blocks.system.joints[0].joints.empty());
  write_checkpoint(file, [&](CheckpointWriter& to) { save_state({}, blocks.system, stepper, to); });
  load_state(Checkpoint(file), other.system, resumed);
  std::filesystem::remove(file);
  for (int k = 0; k < 40; ++k) stepper.advance(0.1), resumed.advance(0.1);
  CHECK(differences(archived(blocks.system), archived(other.system)).empty());
}

TEST_CASE("interfaces that are not implemented are refused", "[interfaces]") {
  Model model = Blocks::pair({{"Dn", "1"}, {"Dt", "1"}}, Transfer::flip, UpdateOrder::usl);
  model.splitting.emplace();
  CHECK_THROWS_WITH(build_system<2>(model, Blocks::seeds(0)), Catch::Contains("particles that split"));
}
