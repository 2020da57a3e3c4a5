// SPDX-License-Identifier: MIT
/// Joint laws on cracks in the grid.

#include "archived.hpp"
#include "base/parallel.hpp"
#include "cloud.hpp"
#include "crack_cases.hpp"
#include "joint_law.hpp"

#include <catch2/catch.hpp>

#include <numbers>

using namespace tribo;
using namespace tribo::test;

namespace {

/// A block in the cells 6 to 14 with a joint through its middle, across y.
template <int Dim>
Model jointed(Kernel kernel, Transfer transfer, const std::shared_ptr<const JointLaw>& law, double at = 10) {
  Model model = grid_model<Dim>(kernel, transfer, UpdateOrder::usl, false, 20);
  model.materials[0].law = elastic(1000, 1e7, 0);
  CrackSpec crack;
  if constexpr (Dim == 2)
    crack = line(Vec3(6, at, 0), Vec3(14, at, 0), 16);
  else
    crack = sheet(Vec3(4, at, 16), Vec3(12, 0, 0), Vec3(0, 0, -12), 12);
  crack.joint = law;
  model.cracks = {crack};
  return model;
}

template <int Dim>
void set_apart(System<Dim>& system, const Vec<Dim>& v) {
  set_velocity<Dim>(system.bodies[0], [&](const Vec<Dim>& x) -> Vec<Dim> { return (x[1] > 10 ? 0.5 : -0.5) * v; });
}

template <int Dim>
void swings(Kernel kernel, Transfer transfer, bool along) {
  INFO(Dim << "D, kernel " << static_cast<int>(kernel) << ", transfer " << static_cast<int>(transfer) << ", along "
           << along);
  // k A (1/m + 1/m), m = 1000 4 A; shear turns both bodies, too: k A (2/m + 8/I). I = m (8^2 + 4^2)/12 is felt through
  // the lumped mass, which lies farther out by the variance of the shape functions along both axes
  const double variance = kernel == Kernel::quadratic_spline ? 0.25 : 1.0 / 6 + 0.25 / 12;
  const double k = 2000, turning = along ? 1 + 4 / ((8 * 8 + 4 * 4) / 12.0 + 2 * variance) : 1.0,
               omega = std::sqrt(turning);
  Model model = jointed<Dim>(kernel, transfer,
                             joint(strong + Properties{{"stiffness-normal", "2000"}, {"stiffness-shear", "2000"}}));
  auto system = build_system<Dim>(model, lattice_seeds<Dim>(model, 6, 14));
  const double speed = 1e-2;
  set_apart<Dim>(system, speed * (along ? Vec<Dim>::UnitX() : Vec<Dim>::UnitY()));
  Stepper<Dim> stepper(model, system);
  const double begin = measure(system).kinetic, dt = 2.5e-3;
  const int quarter = static_cast<int>(std::numbers::pi / 2 / omega / dt);
  double most_lost = 0;
  for (int step = 0; step < quarter; ++step) {
    stepper.advance(dt);
    const auto energies = stepper.joints().energies();
    most_lost =
        std::max(most_lost, std::abs(measure(system).kinetic + measure(system).stored + energies.stored - begin));
  }
  const JointSums sums = means(system, Vec3::UnitX());
  CHECK(sums.area == Approx(std::pow(8, Dim - 1)).epsilon(1e-6));
  // the bodies give by k H / (3 E) of their own
  CHECK((along ? sums.shear : sums.opening) == Approx(speed / omega * std::sin(omega * quarter * dt)).epsilon(2e-3));
  // turned by up to 1e-3, the bodies part a little
  CHECK(std::abs(along ? sums.opening : sums.shear) < 2e-3 * speed);
  CHECK(most_lost < 0.02 * begin);
  CHECK(measure(system).momentum.norm() < 1e-12 * measure(system).mass * speed);
  CHECK(k * sums.area * 0.5 * sums.opening * sums.opening + k * sums.area * 0.5 * sums.shear * sums.shear ==
        Approx(begin / turning).epsilon(4e-3));
}

}  // namespace

TEST_CASE("two blocks on a joint swing like two masses on a spring", "[joints]") {
  const Kernel kernel = GENERATE(Kernel::gimp, Kernel::quadratic_spline, Kernel::cpdi);
  const Transfer transfer = GENERATE(Transfer::flip, Transfer::apic);
  swings<2>(kernel, transfer, false);
  if (transfer == Transfer::apic) swings<2>(kernel, transfer, true);  // FLIP's spin is 1 % off on blocks of 4 cells
}

TEST_CASE("two blocks on a joint in three dimensions", "[joints][slow]") {
  swings<3>(Kernel::quadratic_spline, Transfer::apic, false);
}

TEST_CASE("a jointed block that turns does not load its joint", "[joints]") {
  Model model = jointed<2>(Kernel::quadratic_spline, Transfer::apic,
                           joint(strong + Properties{{"stiffness-normal", "2e5"}, {"stiffness-shear", "2e5"}}), 10.3);
  model.scheme.exponential_deformation = true;
  model.materials[0].law = elastic(1000, 1e6, 0);
  auto system = build_system<2>(model, lattice_seeds<2>(model, 6, 14));
  auto& body = system.bodies[0];
  const Vec<2> centre(10, 10);
  const double omega = 0.01;
  set_velocity<2>(body, [&](const Vec<2>& x) { return Vec<2>(omega * Vec<2>(-(x - centre)[1], (x - centre)[0])); });
  for (std::size_t i = 0; i < body.particles.size(); ++i)  // the spin that APIC keeps
    body.particles[body.affine][1][i] = -0.25 * omega, body.particles[body.affine][2][i] = 0.25 * omega;
  Stepper<2> stepper(model, system);
  const int steps = 4000;
  for (int k = 0; k < steps; ++k) stepper.advance(0.5 / omega / steps);  // by half a radian
  double most = 0;
  for (const Joint& j : system.joints[0].joints) most = std::max({most, std::abs(j.opening), j.shear.norm()});
  // the centrifugal stress, 1000 omega^2 (4.3^2/2), parts the faces by 5e-6
  CHECK(most < 2e-5);
  const Vec3 n = system.joints[0].axes[9].n;
  CHECK(n[0] == Approx(-std::sin(0.5)).epsilon(1e-3));
}

TEST_CASE("a joint of two parts fails when its strength is reached, and reports where", "[joints]") {
  Model model = jointed<2>(
      Kernel::quadratic_spline, Transfer::apic,
      joint({{"stiffness-normal", "2e5"}, {"stiffness-shear", "2e5"}, {"tension", "50"}, {"cohesion", "1e3"}}));
  model.materials[0].law = elastic(1000, 1e8, 0);
  auto system = build_system<2>(model, lattice_seeds<2>(model, 6, 14));
  // fast enough to break: speed sqrt(k m_red) > 50 A
  set_apart<2>(system, 1e-2 * Vec<2>::UnitY());
  Stepper<2> stepper(model, system);
  for (int k = 0; k < 2000; ++k) stepper.advance(2e-4);
  const auto events = stepper.joints().take_events();
  int broken = 0;
  for (const auto& e : events)
    if (e.event.kind == JointEvent::Kind::bond_break) {
      ++broken;
      CHECK(e.event.mode == 1);
      CHECK(e.event.strength == Approx(50));
      CHECK(e.x[1] == Approx(10).margin(1e-2));
      CHECK(e.time == Approx(std::asin(50 * 10.0 / (2e5 * 1e-2)) / 10).epsilon(0.02));
    }
  CHECK(broken == static_cast<int>(system.joints[0].joints.size()));
  for (const Joint& j : system.joints[0].joints) CHECK(j.Fn == 0);
  // what was stored is lost, the rest flies on
  const double lost = 0.5 * 50 * 50 / 2e5 * 8;
  CHECK(stepper.joints().energies().dissipated ==
        Approx(lost).epsilon(0.03));  // the last step overshoots by up to 0.8 %
  CHECK(measure(system).kinetic + measure(system).stored + lost == Approx(0.5 * 64e3 * 0.25e-4).epsilon(0.01));
}

TEST_CASE("joints: any number of threads gives the same bits", "[joints][threads]") {
  Model model = jointed<2>(
      Kernel::quadratic_spline, Transfer::fmpm,
      joint({{"stiffness-normal", "2e5"}, {"stiffness-shear", "2e5"}, {"friction", "30"}, {"friction-residual", "20"}}),
      10.2);
  const auto run = [&](int threads) {
    set_threads(threads);
    auto system = build_system<2>(model, lattice_seeds<2>(model, 6, 14));
    set_apart<2>(system, Vec<2>(0.05, -0.02));
    Stepper<2> stepper(model, system);
    for (int k = 0; k < 100; ++k) stepper.advance(1e-3);
    set_threads(1);
    return archived(system.joints[0]);
  };
  const auto one = run(1);
  CHECK(one == run(2));
  CHECK(one == run(5));
}

TEST_CASE("dashpots beside a symmetry plane are those of the whole block", "[joints]") {
  const auto law = joint(
      strong + Properties{{"stiffness-normal", "2e5"}, {"stiffness-shear", "1e5"}, {"dashpot-ratio-normal", "0.3"}});
  const auto run = [&](bool half) {
    Model model = jointed<2>(Kernel::quadratic_spline, Transfer::apic, law);
    std::vector<Seed> seeds = lattice_seeds<2>(model, 6, 14);
    if (half) {
      model.grid.symmetry[0][0] = 10;
      model.cracks = {line(Vec3(10, 10, 0), Vec3(14, 10, 0), 8)}, model.cracks[0].joint = law;
      std::erase_if(seeds, [](const Seed& s) { return s.x[0] < 10; });
    }
    auto system = build_system<2>(model, seeds);
    set_apart<2>(system, Vec<2>(0, 1e-3));
    Stepper<2> stepper(model, system);
    stepper.advance(1e-3);
    return system.joints[0].joints;
  };
  const auto whole = run(false), half = run(true);
  REQUIRE(half.size() == 9);
  for (std::size_t k = 0; k < half.size(); ++k) {
    INFO("joint " << k);
    const double share = k == 0 ? 0.5 : 1.0;  // half of the joint on the plane
    CHECK(half[k].opening == Approx(whole.at(8 + k).opening).epsilon(1e-9));
    CHECK(half[k].Fn == Approx(share * whole.at(8 + k).Fn).epsilon(1e-9));
    CHECK(half[k].dashpot_normal == Approx(share * whole.at(8 + k).dashpot_normal).epsilon(1e-9));
  }
  CHECK(half[0].dashpot_normal > 0);
}

TEST_CASE("dashpots of any ratio damp at the stable step", "[joints]") {
  for (const char* ratio : {"0.3", "1"})
    for (const auto transfer : {Transfer::flip, Transfer::apic}) {
      const auto law = joint(strong + Properties{{"stiffness-normal", "2e8"},
                                                 {"stiffness-shear", "1e8"},
                                                 {"dashpot-ratio-normal", ratio},
                                                 {"dashpot-ratio-shear", ratio}});
      Model model = jointed<2>(Kernel::quadratic_spline, transfer, law);
      auto system = build_system<2>(model, lattice_seeds<2>(model, 6, 14));
      set_velocity<2>(system.bodies[0], [](const Vec<2>& x) -> Vec<2> {
        return 1e-3 * Vec<2>(std::sin(3 * x[0] + x[1]), std::cos(5 * x[0] - 2 * x[1]));
      });
      Stepper<2> stepper(model, system);
      const double begin = measure(system).kinetic;
      stepper.advance(1e-9);
      const double dt = stepper.joints().stable_step();
      // In the middle of the face c is 2 beta kA/sqrt(S), and the largest S sets the step.
      const auto& joints = system.joints[0].joints;
      const double beta = std::stod(ratio), before = joints[8].opening;
      stepper.advance(dt);
      const double c = joints[8].dashpot_normal * dt / (joints[8].opening - before), kA = joints[8].kn * joints[8].area;
      const double least = 2 * beta * kA * dt / (std::sqrt(1 + beta * beta) - beta);
      CHECK(c > 0.999 * least);
      CHECK(c < 1.6 * least);
      for (int k = 0; k < 400; ++k) stepper.advance(dt);
      const Measures now = measure(system);
      const auto energies = stepper.joints().energies();
      INFO("ratio " << ratio << ", step " << dt);
      CHECK(now.kinetic + now.stored + energies.stored < begin);
      CHECK(energies.dashpot > 0);
    }
}

TEST_CASE("a joint needs a body to run through", "[joints]") {
  Model model = jointed<2>(Kernel::quadratic_spline, Transfer::apic, joint({{"stiffness-normal", "1"}}));
  for (Vec3& x : model.cracks[0].points) x[1] += 6;
  CHECK_THROWS_WITH(build_system<2>(model, lattice_seeds<2>(model, 6, 14)),
                    Catch::Contains("does not run through any body"));
}

TEST_CASE("user_area of a crack is the area of each of its points", "[joints]") {
  const auto areas = [](const std::string& given) {
    Model model =
        jointed<2>(Kernel::quadratic_spline, Transfer::apic, joint({{"stiffness-normal", "1"}, {"user_area", given}}));
    auto system = build_system<2>(model, lattice_seeds<2>(model, 6, 14));
    std::vector<double> out;
    for (const Joint& j : system.joints[0].joints) out.push_back(j.area);
    return out;
  };
  CHECK(areas("0.25") == std::vector<double>(17, 0.25));
  std::string list;
  std::vector<double> each;
  for (int k = 1; k <= 17; ++k) list += std::to_string(k) + " ", each.push_back(k);
  CHECK(areas(list) == each);
  CHECK_THROWS_WITH(areas("1 2 3"), Catch::Contains("has 3 areas, but the crack has 17 points"));
}
