// SPDX-License-Identifier: MIT
/// Joint laws between two materials.

#include "archived.hpp"
#include "base/parallel.hpp"
#include "cloud.hpp"
#include "contact/contact_cases.hpp"
#include "joint_law.hpp"
#include "run/restart.hpp"

#include <filesystem>
#include <numbers>

using namespace tribo;
using namespace tribo::test;

namespace {

constexpr double centre = 10;
const double degree = std::numbers::pi / 180;

/// Two materials, a joint between them, and another law where none acts.
template <int Dim>
Model jointed_pair(const std::shared_ptr<const JointLaw>& law, Kernel kernel = Kernel::quadratic_spline,
                   Transfer transfer = Transfer::apic) {
  Model model = grid_model<Dim>(kernel, transfer, UpdateOrder::usl, false, 20);
  model.materials[0].law = elastic(1000, 1e7, 0);
  model.materials.push_back(model.materials[0]);
  model.materials[0].name = "lower", model.materials[1].name = "upper";
  model.contact.active = true;
  model.contact.default_law = make_law("CoulombFriction", {{"coeff", "0"}});
  model.contact.joints[{0, 1}] = {law, {0, 1}, Origin{}};
  return model;
}

struct Block {
  Vec3 low, high;  ///< along the block's own axes, from the centre of the grid
  int material = 0;
  int per_cell = 2;
};

/// Particles of blocks that are turned about z, and then about x.
template <int Dim>
std::vector<Seed> turned(const Model& model, const std::vector<Block>& blocks, double angle, double tilt = 0.0) {
  Mat3 R = Eigen::AngleAxisd(angle, Vec3::UnitZ()).toRotationMatrix();
  if (Dim == 3) R = Eigen::AngleAxisd(tilt, Vec3::UnitX()).toRotationMatrix() * R;
  Vec3 middle = Vec3::Zero();
  middle.head<Dim>().setConstant(centre);
  std::vector<Seed> seeds;
  for (const Block& block : blocks) {
    const double size = 1.0 / block.per_cell;
    std::array<int, 3> count{1, 1, 1};
    for (std::size_t d = 0; d < Dim; ++d) {
      const auto axis = static_cast<Eigen::Index>(d);
      count[d] = static_cast<int>(std::lround((block.high[axis] - block.low[axis]) / size));
    }
    for (int k = 0; k < count[2]; ++k)
      for (int j = 0; j < count[1]; ++j)
        for (int i = 0; i < count[0]; ++i) {
          Seed s;
          Vec3 x = block.low + size * Vec3(i + 0.5, j + 0.5, k + 0.5);
          if (Dim == 2) x[2] = 0;
          s.x = middle + R * x, s.F = R;
          s.half_size.head<Dim>().setConstant(0.5 * size);
          s.volume = std::pow(size, Dim), s.material = block.material;
          s.mass = model.materials[static_cast<std::size_t>(block.material)].law->density() * s.volume;
          seeds.push_back(s);
        }
  }
  return seeds;
}

const std::vector<Block> halves{{Vec3(-4, -4, -2), Vec3(4, 0, 2), 0}, {Vec3(-4, 0, -2), Vec3(4, 4, 2), 1}};

template <int Dim>
Vec<Dim> normal(double angle, double tilt) {
  const Vec3 n = Eigen::AngleAxisd(tilt, Vec3::UnitX()) * (Eigen::AngleAxisd(angle, Vec3::UnitZ()) * Vec3::UnitY());
  return n.head<Dim>();
}

/// Pulls (a > 0) or presses two halves by accelerations a s along their normal, s from the interface, until they rest;
/// the stress on the interface is a density 4^2/2 for any nodes, since lumped masses have the right first moments.
template <int Dim>
void patch(const std::vector<Block>& blocks, double angle, double tilt, double a,
           Kernel kernel = Kernel::quadratic_spline) {
  INFO(Dim << "D, angle " << angle / degree << ", tilt " << tilt / degree << ", a " << a << ", kernel "
           << name(kernel));
  const double k = 2e5;
  Model model =
      jointed_pair<Dim>(joint(strong + Properties{{"stiffness-normal", "2e5"}, {"stiffness-shear", "1e5"}}), kernel);
  const Vec<Dim> n = normal<Dim>(angle, tilt);
  std::string s = "0";
  for (int d = 0; d < Dim; ++d)
    s += "+(" + std::to_string(n[d]) + ")*(" + std::string(1, static_cast<char>('x' + d)) + "-10)";
  for (std::size_t d = 0; d < Dim; ++d)
    model.body_force.function[d].emplace(
        std::to_string(a) + "*(" + std::to_string(n[static_cast<Eigen::Index>(d)]) + ")*(" + s + ")", Origin{});
  auto system = build_system<Dim>(model, turned<Dim>(model, blocks, angle, tilt));
  Stepper<Dim> stepper(model, system);
  stepper.advance(1e-6);
  int pairs = 0;
  for (const auto& node : stepper.contact().nodes())
    stepper.contact().each_closed_pair(node, [&](const ContactPair& pair, const auto&, const auto&) {
      CHECK(pair.replaced_by_joint);
      ++pairs;
    });
  CHECK(pairs > 0);
  stepper.damping().grid = 20;  // critical: 2 sqrt(k A (1/m + 1/m))
  for (int step = 0; step < 600; ++step) stepper.advance(2.5e-3);
  const JointSums sums = means(system, Vec3::UnitX());
  CHECK(sums.area == Approx(Dim == 2 ? 8 : 32).epsilon(1e-9));
  // What little moves on yet, nodes at the blocks' edges that hold next to no mass, is held by damping.
  const Measures upper = measure(system.bodies[1], false);
  const Vec<Dim> from = upper.centre.template head<Dim>() - Vec<Dim>::Constant(centre);
  const double pull =
      a * upper.mass * from.dot(n) - stepper.damping().grid * upper.momentum.template head<Dim>().dot(n);
  CHECK(pull == Approx(a * upper.mass * 2).epsilon(3e-3));
  CHECK(sums.opening * a > 0);
  CHECK(sums.opening == Approx(pull / (k * sums.area)).epsilon(1e-3));
  CHECK(std::abs(sums.shear) < 1e-3 * std::abs(sums.opening));
  const auto& surface = system.joints[0];
  for (std::size_t j = 0; j < surface.joints.size(); ++j) {
    CHECK(surface.axes[j].n.template head<Dim>().dot(n) > 1 - 1e-6);
    CHECK(surface.joints[j].opening * a > 0);
    CHECK(-surface.force(j).template head<Dim>().dot(n) * a > 0);  // on the upper one: back if pulled
  }
}

}  // namespace

TEST_CASE("two materials pulled off each other part by stress over stiffness, at any angle", "[joints][interfaces]") {
  const double angle = GENERATE(0.0, 17.0, 45.0) * degree;
  patch<2>(halves, angle, 0, 0.01);
  patch<2>(halves, angle, 0, -0.01);
}

TEST_CASE("the patch with other kernels and particles that do not match", "[joints][interfaces]") {
  const double angle = GENERATE(0.0, 17.0) * degree;
  std::vector<Block> blocks = halves;
  blocks[1].per_cell = 3;
  patch<2>(blocks, angle, 0, -0.01);
  patch<2>(halves, angle, 0, -0.01, Kernel::gimp);
  patch<2>(halves, angle, 0, -0.01, Kernel::cubic_spline);
}

TEST_CASE("the patch in three dimensions", "[joints][interfaces][slow]") {
  patch<3>(halves, 0, 0, -0.01);
  patch<3>(halves, 17 * degree, 30 * degree, 0.01);
}

TEST_CASE("points lie where faces touch, and only there", "[joints][interfaces]") {
  const double angle = GENERATE(0.0, 17.0, 45.0) * degree;
  const Model model = jointed_pair<2>(joint({{"stiffness-normal", "1"}}));
  // the upper one overhangs by 1.3 at one end, ends 0.9 before the other, and has particles of a third of a cell
  const std::vector<Block> blocks{{Vec3(-4, -2, 0), Vec3(4, 0, 0), 0, 4},
                                  {Vec3(-5.3, 0, 0), Vec3(3.7 - 1, 2, 0), 1, 3}};
  const auto system = build_system<2>(model, turned<2>(model, blocks, angle));
  const auto& surface = system.joints.at(0);
  double area = 0;
  Vec<2> moment = Vec<2>::Zero();
  for (std::size_t k = 0; k < surface.joints.size(); ++k)
    area += surface.joints[k].area, moment += surface.joints[k].area * surface.x[k];
  CHECK(area == Approx(4 + 2.7).epsilon(1e-9));
  const Vec<2> along(std::cos(angle), std::sin(angle));
  CHECK((moment / area - Vec<2>(centre, centre) - 0.5 * (2.7 - 4) * along).norm() < 1e-9);
}

TEST_CASE("joint areas with radius and thickness", "[joints][interfaces]") {
  Model model = jointed_pair<2>(joint({{"stiffness-normal", "1"}}));
  const auto area = [&](double thickness) {
    auto seeds = turned<2>(model, halves, 0);
    for (Seed& s : seeds) s.volume *= thickness;
    const auto system = build_system<2>(model, seeds);
    double sum = 0;
    for (const Joint& j : system.joints.at(0).joints) sum += j.area;
    return sum;
  };
  CHECK(area(2.5) == Approx(20));
  model.analysis = Analysis::axisymmetric;
  CHECK(area(1) == Approx((14 * 14 - 6 * 6) / 2.0));  // per radian
}

TEST_CASE("a stepped face of particles has the area and the normal of its mean plane", "[joints][interfaces]") {
  const double angle = GENERATE(10.0, 17.0, 30.0, 45.0) * degree;
  const Model model = jointed_pair<2>(joint({{"stiffness-normal", "1"}}));
  std::vector<Seed> seeds = lattice_seeds<2>(model, 4, 16);
  for (Seed& s : seeds) s.material = s.x[1] - centre > std::tan(angle) * (s.x[0] - centre - 0.1) ? 1 : 0;
  const auto system = build_system<2>(model, seeds);
  const auto& surface = system.joints.at(0);
  double area = 0;
  for (std::size_t k = 0; k < surface.joints.size(); ++k) {
    area += surface.joints[k].area;
    if (std::abs(surface.x[k][0] - centre) > 3.5) continue;  // less is known at the ends
    // half a particle over a diameter of five cells
    CHECK(std::abs(std::atan2(-surface.axes[k].n[0], surface.axes[k].n[1]) - angle) < 0.1);
  }
  CHECK(area == Approx(12 / std::cos(angle)).margin(0.71));  // half of a particle's diagonal at either end
}

TEST_CASE("corners of a body in another keep their normals", "[joints][interfaces]") {
  const Model model = jointed_pair<2>(joint({{"stiffness-normal", "1"}}));
  std::vector<Seed> seeds = lattice_seeds<2>(model, 4, 16);
  for (Seed& s : seeds) s.material = (s.x - Vec3(centre, centre, 0)).head<2>().cwiseAbs().maxCoeff() < 3 ? 1 : 0;
  const auto system = build_system<2>(model, seeds);
  const auto& surface = system.joints.at(0);
  double area = 0;
  for (std::size_t k = 0; k < surface.joints.size(); ++k) {
    area += surface.joints[k].area;
    CHECK(surface.axes[k].n.cwiseAbs().maxCoeff() == Approx(1));
    CHECK((surface.x[k] - Vec<2>(centre, centre)).dot(surface.axes[k].n.head<2>()) == Approx(-3));
  }
  CHECK(area == Approx(24));
}

TEST_CASE("two jointed materials that turn do not load their joint", "[joints][interfaces]") {
  Model model = jointed_pair<2>(joint(strong + Properties{{"stiffness-normal", "2e5"}, {"stiffness-shear", "2e5"}}));
  model.scheme.exponential_deformation = true;
  for (auto& material : model.materials) material.law = elastic(1000, 1e6, 0);
  auto system = build_system<2>(model, turned<2>(model, halves, 20 * degree));
  const double omega = 0.01;
  for (auto& body : system.bodies) {
    set_velocity<2>(body, [&](const Vec<2>& x) { return Vec<2>(omega * Vec<2>(centre - x[1], x[0] - centre)); });
    for (std::size_t i = 0; i < body.particles.size(); ++i)  // the spin that APIC keeps
      body.particles[body.affine][1][i] = -0.25 * omega, body.particles[body.affine][2][i] = 0.25 * omega;
  }
  Stepper<2> stepper(model, system);
  const int steps = 4000;
  for (int k = 0; k < steps; ++k) stepper.advance(0.5 / omega / steps);  // by half a radian
  double most = 0;
  for (const Joint& j : system.joints[0].joints) most = std::max({most, std::abs(j.opening), j.shear.norm()});
  // the centrifugal stress, 1000 omega^2 4^2/2, parts the faces by 4e-6
  CHECK(most < 2e-5);
  const double angle = 20 * degree + 0.5;
  const auto& surface = system.joints[0];
  for (std::size_t k = 0; k < surface.joints.size(); ++k) {
    CHECK((surface.axes[k].n - Vec3(-std::sin(angle), std::cos(angle), 0)).norm() < 2e-3);
    CHECK(std::abs((surface.x[k] - Vec<2>(centre, centre)).dot(surface.axes[k].n.head<2>())) < 1e-2);
  }
}

TEST_CASE("beyond their joint two bodies interact by the default contact law", "[joints][interfaces]") {
  // a short block is pressed on a long one and slides along it without friction
  Model model = jointed_pair<2>(joint({{"stiffness-normal", "2e5"}, {"stiffness-shear", "1e5"}}));
  model.body_force.gravity = Vec3(0, -1, 0);
  model.grid.symmetry[1][0] = 8;
  const std::vector<Block> blocks{{Vec3(-8, -2, 0), Vec3(9.5, 0, 0), 0}, {Vec3(-6, 0, 0), Vec3(-2, 3, 0), 1}};
  auto system = build_system<2>(model, turned<2>(model, blocks, 0));
  set_velocity<2>(system.bodies[1], [](const Vec<2>&) { return Vec<2>(2, 0); });
  Stepper<2> stepper(model, system);
  const auto lowest = [&] {
    double y = 1e9;
    for (std::size_t i = 0; i < system.bodies[1].particles.size(); ++i)
      y = std::min(y, system.bodies[1].particles.position(i)[1]);
    return y - 0.25 - centre;
  };
  double deepest = 0;
  for (int k = 0; k < 2200; ++k) stepper.advance(2.5e-3), deepest = std::min(deepest, lowest());
  // it slid by eleven cells; the joint's points went half that way, and the last of them is gone
  CHECK(measure(system.bodies[1], false).centre[0] > centre + 6.5);
  CHECK(deepest > -0.1);  // the oscillation on the joint has an amplitude of at most 3000/k
  CHECK(measure(system.bodies[1], false).momentum[0] == Approx(2 * 12e3).epsilon(0.02));
  for (const Joint& j : system.joints[0].joints) CHECK(j.Fn == 0);
}

TEST_CASE("a joint on a rigid body holds, and its work is known", "[joints][interfaces]") {
  Model model = jointed_pair<2>(joint(strong + Properties{{"stiffness-normal", "2e5"}, {"stiffness-shear", "2e5"}}));
  Problems problems;
  Statement statement;
  model.materials[0].law = materials().find("RigidContact")->make(statement, {}, Units{}, problems);
  model.materials[0].rigid_contact = true;
  model.materials[0].rigid_velocity[0].emplace("0.01", Origin{});
  model.materials[0].rigid_velocity[1].emplace("0.02", Origin{});
  auto system = build_system<2>(model, turned<2>(model, halves, 17 * degree));
  Stepper<2> stepper(model, system);
  for (int k = 0; k < 400; ++k) stepper.advance(2.5e-3);
  const double content = measure(system).kinetic + measure(system).stored + stepper.joints().energies().stored;
  CHECK(stepper.contact().ledger().rigid_work == Approx(content).epsilon(0.02));
  CHECK((stepper.contact().ledger().rigid_impulse - measure(system).momentum).norm() <
        1e-9 * measure(system).momentum.norm());
  CHECK(measure(system).momentum[1] > 0);
}

namespace {

// Slips, opens at one end, and reaches beyond the other.
System<2> slipping(const Model& model) {
  std::vector<Block> blocks = halves;
  blocks[1].low[0] = -3;
  auto system = build_system<2>(model, turned<2>(model, blocks, 17 * degree));
  set_velocity<2>(system.bodies[1], [](const Vec<2>& x) { return Vec<2>(1, 0.2 * (x[0] - centre) - 0.2); });
  return system;
}

Model slipping_pair() {
  return jointed_pair<2>(joint({{"stiffness-normal", "2e5"},
                                {"stiffness-shear", "2e5"},
                                {"friction", "30"},
                                {"friction-residual", "20"},
                                {"slip-dc", "0.1"}}),
                         Kernel::quadratic_spline, Transfer::fmpm);
}

}  // namespace

TEST_CASE("joints between materials: any number of threads gives the same bits", "[joints][interfaces][threads]") {
  const Model model = slipping_pair();
  const auto run = [&](int threads) {
    set_threads(threads);
    auto system = slipping(model);
    Stepper<2> stepper(model, system);
    for (int k = 0; k < 300; ++k) stepper.advance(1e-3);
    set_threads(1);
    return archived(system);
  };
  const auto one = run(1);
  CHECK(one == run(2));
  CHECK(one == run(5));
}

TEST_CASE("joints between materials: a run that is saved and loaded goes on to the bit", "[joints][interfaces]") {
  const Model model = slipping_pair();
  const auto file = std::filesystem::temp_directory_path() / "tribo_test_interfaces.bin";
  auto system = slipping(model);
  Stepper<2> stepper(model, system);
  for (int k = 0; k < 150; ++k) stepper.advance(1e-3);
  write_checkpoint(file, [&](CheckpointWriter& to) { save_state({}, system, stepper, to); });
  auto other = slipping(model);
  Stepper<2> resumed(model, other);
  load_state(Checkpoint(file), other, resumed);
  std::filesystem::remove(file);
  for (int k = 0; k < 150; ++k) stepper.advance(1e-3), resumed.advance(1e-3);
  CHECK(differences(archived(system), archived(other)).empty());
}

TEST_CASE("a joint between materials needs faces that touch", "[joints][interfaces]") {
  const Model model = jointed_pair<2>(joint({{"stiffness-normal", "1"}}));
  const auto with = [&](double shift) {
    std::vector<Block> blocks = halves;
    blocks[1].low[1] += shift, blocks[1].high[1] += shift;
    return build_system<2>(model, turned<2>(model, blocks, 0));
  };
  CHECK_THROWS_WITH(with(0.1), Catch::Contains("'lower' and 'upper' have no common face at the start"));
  CHECK_THROWS_WITH(with(-0.5), Catch::Contains("have no common face at the start"));  // one row over the other
  CHECK_THROWS_WITH(build_system<2>(model, turned<2>(model, {halves[0]}, 0)),
                    Catch::Contains("there is none of 'upper'"));
  CHECK(with(0.01).joints.at(0).joints.size() == 16);
}
