// SPDX-License-Identifier: MIT
#include "base/parallel.hpp"
#include "cloud.hpp"
#include "contact/contact_cases.hpp"
#include "crack_cases.hpp"
#include "geometry/crossing.hpp"
#include "solver/cracks/cracks.hpp"

#include <catch2/catch.hpp>

#include <map>
#include <numbers>
#include <random>

using namespace tribo;
using namespace tribo::test;

namespace {

template <int Dim>
Model block(Kernel kernel, Transfer transfer, UpdateOrder order = UpdateOrder::usl) {
  Model model = grid_model<Dim>(kernel, transfer, order, false, Dim == 2 ? 20 : 12);
  model.scheme.filter_order = 3;
  return model;
}

/// Velocities by particle after some steps of a block of cells 4 to `to` that was set in motion.
template <int Dim>
std::vector<double> outcome(const Model& model, int to, int steps = 25, double dt = 5e-3) {
  auto system = build_system<Dim>(model, lattice_seeds<Dim>(model, 4, to));
  set_velocity<Dim>(system.bodies[0], [](const Vec<Dim>& x) -> Vec<Dim> {
    Vec<Dim> v;
    for (int d = 0; d < Dim; ++d) v[d] = std::sin(0.7 * x[d] + 0.4 * x[(d + 1) % Dim]);
    return v;
  });
  Stepper<Dim> stepper(model, system);
  for (int k = 0; k < steps; ++k) stepper.advance(dt);
  const auto& p = system.bodies[0].particles;
  std::vector<double> out(p.size() * Dim);
  for (std::size_t i = 0; i < p.size(); ++i)
    for (int d = 0; d < Dim; ++d)
      out[static_cast<std::size_t>(p.id[i]) * Dim + static_cast<std::size_t>(d)] = p.velocity(i)[d];
  return out;
}

double difference(const std::vector<double>& a, const std::vector<double>& b) {
  double most = 0;
  for (std::size_t k = 0; k < a.size(); ++k) most = std::max(most, std::abs(a[k] - b[k]));
  return most;
}

/// Compares the sides of points near a crack at the nodes around them with tests of the segments between them.
/// Returns the number of segments that cross a crack. Points are on a raster, so that many lie on grid lines and
/// cracks.
template <int Dim>
int compare_sides(const CrackSpec& spec) {
  Model model = block<Dim>(Kernel::quadratic_spline, Transfer::apic);
  model.cracks = {spec};
  auto system = build_system<Dim>(model, lattice_seeds<Dim>(model, 4, Dim == 2 ? 12 : 8));
  const auto transfers = make_transfers<Dim>(model.scheme);
  Cracks<Dim> finder(model, system, *transfers);
  finder.locate();
  finder.find();
  std::mt19937 random(5);
  std::uniform_int_distribution<int> place(4 * 8, (Dim == 2 ? 12 : 8) * 8);
  typename Cracks<Dim>::NodeBox nodes;
  int crossed = 0, wrong = 0;
  for (int k = 0; k < (Dim == 2 ? 20000 : 4000); ++k) {
    Vec<Dim> x;
    for (int d = 0; d < Dim; ++d) x[d] = 0.125 * place(random);
    finder.find_nodes(x, nodes);
    const auto sides = finder.sides_of(nodes, x);
    each_in_box<Dim>(nodes.low, nodes.high, [&](const Index<Dim>& node) {
      int crossings = 0;
      for (const auto& crack : system.cracks)
        for (std::size_t p = 0; p < crack.pieces.size(); ++p)
          crossings += crossing(crack.corners(p), x, system.lattice.position(node)) != 0;
      wrong += finder.side_of_node(sides, node) != crossings % 2;
      crossed += crossings % 2;
    });
  }
  CHECK(wrong == 0);
  return crossed;
}

std::shared_ptr<const ContactLaw> stuck() { return make_law("IgnoreContact", {}); }
std::shared_ptr<const ContactLaw> smooth() { return make_law("CoulombFriction", {}); }

}  // namespace

TEST_CASE("CR0b: a crack whose faces stick has no effect", "[cracks]") {
  const Kernel kernel =
      GENERATE(Kernel::linear, Kernel::gimp, Kernel::quadratic_spline, Kernel::cubic_spline, Kernel::cpdi);
  const Transfer transfer = GENERATE(Transfer::flip, Transfer::apic, Transfer::fmpm, Transfer::xpic);
  const UpdateOrder order = GENERATE(UpdateOrder::usl, UpdateOrder::usavg);
  INFO(name(kernel) << ", transfer " << static_cast<int>(transfer) << ", order " << static_cast<int>(order));
  Model model = block<2>(kernel, transfer, order);
  const auto without = outcome<2>(model, 12);
  const auto oblique = line(Vec3(5.1, 6.3, 0), Vec3(10.9, 9.77, 0), 13, stuck()),
             across = line(Vec3(9.3, 5.2, 0), Vec3(6.2, 11.1, 0), 9, stuck());
  model.cracks = {oblique};
  CHECK(difference(outcome<2>(model, 12), without) < 1e-12);
  model.cracks = {oblique, across};  // four fields where they cross
  CHECK(difference(outcome<2>(model, 12), without) < 1e-12);
  model.cracks = {oblique};
  model.cracks[0].law = nullptr;
  CHECK(difference(outcome<2>(model, 12), without) > 1e-3);
}

TEST_CASE("CR0b in three dimensions", "[cracks]") {
  const Kernel kernel = GENERATE(Kernel::gimp, Kernel::quadratic_spline, Kernel::cpdi);
  INFO(name(kernel));
  Model model = block<3>(kernel, Transfer::apic);
  const auto without = outcome<3>(model, 8, 10);
  model.cracks = {sheet(Vec3(4.5, 3, 5.2), Vec3(2.9, 0.2, 0.4), Vec3(0.3, 6, 0.9), 6, stuck())};
  CHECK(difference(outcome<3>(model, 8, 10), without) < 1e-12);
  model.cracks[0].law = nullptr;
  CHECK(difference(outcome<3>(model, 8, 10), without) > 1e-3);
}

TEST_CASE("a crack through a body makes two bodies", "[cracks]") {
  // They part without a trace of the other. Not the linear kernel: with few particles in the cells that a crack cuts
  // obliquely it amplifies round-off, as at any ragged surface.
  const Kernel kernel = GENERATE(Kernel::gimp, Kernel::quadratic_spline, Kernel::cubic_spline, Kernel::cpdi);
  const Transfer transfer = GENERATE(Transfer::flip, Transfer::apic);
  INFO(name(kernel));
  Model model = block<2>(kernel, transfer);
  model.cracks = {line(Vec3(2 - 1.8, 6.3 - 0.42, 0), Vec3(2 + 16.8, 6.3 + 3.92, 0), 40, smooth())};
  auto system = build_system<2>(model, lattice_seeds<2>(model, 4, 12));
  auto& body = system.bodies[0];
  const Vec<2> along = Vec<2>(12, 2.8).normalized(), up(-along[1], along[0]);
  const auto above = [&](const Vec<2>& x) { return up.dot(x - Vec<2>(2, 6.3)) > 0; };
  std::map<std::int64_t, bool> upper;
  for (std::size_t i = 0; i < body.particles.size(); ++i)
    upper[body.particles.id[i]] = above(body.particles.position(i));
  set_velocity<2>(body, [&](const Vec<2>& x) -> Vec<2> { return (above(x) ? 1.0 : -1.0) * (0.1 * up + along); });
  Stepper<2> stepper(model, system);
  for (int k = 0; k < 200; ++k) stepper.advance(1e-2);
  for (std::size_t i = 0; i < body.particles.size(); ++i) {
    const double sign = upper[body.particles.id[i]] ? 1.0 : -1.0;
    CHECK((body.particles.velocity(i) - sign * (0.1 * up + along)).norm() < 1e-9);
  }
  const Crack<2>& crack = system.cracks[0];
  for (std::size_t k = 17; k < 20; ++k) {  // points between the bodies
    CHECK(crack.opening(k).dot(up) == Approx(0.4).epsilon(1e-6));
    CHECK(crack.opening(k).dot(along) == Approx(4).epsilon(1e-6));
  }
}

TEST_CASE("CR7: a cracked block that turns does not open, and its faces keep their sides", "[cracks][slow]") {
  Model model = block<2>(Kernel::quadratic_spline, Transfer::apic);
  model.scheme.exponential_deformation = true;
  model.cracks = {line(Vec3(8.6, 8.8, 0), Vec3(11, 11.1, 0), 7, smooth())};
  auto system = build_system<2>(model, lattice_seeds<2>(model, 7, 13));
  auto& body = system.bodies[0];
  const Vec<2> centre(10, 10);
  const double omega = 0.012;  // slowly: the stretch by centrifugal forces, 1e-6, opens the crack, too
  set_velocity<2>(body, [&](const Vec<2>& x) { return Vec<2>(omega * Vec<2>(-(x - centre)[1], (x - centre)[0])); });
  // the spin that APIC keeps
  for (std::size_t i = 0; i < body.particles.size(); ++i)
    body.particles[body.affine][1][i] = -0.25 * omega, body.particles[body.affine][2][i] = 0.25 * omega;
  Stepper<2> stepper(model, system);
  const int steps = 40000;
  double most = 0;
  for (int k = 0; k < steps; ++k) {
    stepper.advance(2 * std::numbers::pi / omega / steps);
    for (std::size_t p = 0; p < system.cracks[0].x.size(); ++p)
      most = std::max(most, system.cracks[0].opening(p).norm());
  }
  CHECK(most < 1e-3);
  CHECK((system.cracks[0].x[0] - Vec<2>(8.6, 8.8)).norm() < 0.02);
}

TEST_CASE("CR10: where two cracks cross, four fields touch their neighbours only", "[cracks]") {
  // A vertical and a horizontal crack part a block into quarters; the quarter up right is pushed down left.
  Model model = block<2>(Kernel::gimp, Transfer::apic);
  model.materials[0].law = elastic(1000, 1e6, 0);  // or they would swell sideways
  model.cracks = {line(Vec3(8.05, 2, 0), Vec3(8.05, 14, 0), 24, smooth()),
                  line(Vec3(2, 8.05, 0), Vec3(14, 8.05, 0), 24, smooth())};
  auto system = build_system<2>(model, lattice_seeds<2>(model, 4, 12));
  auto& body = system.bodies[0];
  const auto quarter = [](const Vec<2>& x) { return (x[0] > 8.05 ? 1 : 0) + (x[1] > 8.05 ? 2 : 0); };
  std::map<std::int64_t, int> of;
  for (std::size_t i = 0; i < body.particles.size(); ++i)
    of[body.particles.id[i]] = quarter(body.particles.position(i));
  const auto momenta = [&] {
    std::array<Vec<2>, 4> sum;
    sum.fill(Vec<2>::Zero());
    for (std::size_t i = 0; i < body.particles.size(); ++i)
      sum[static_cast<std::size_t>(of[body.particles.id[i]])] += body.particles.mass()[i] * body.particles.velocity(i);
    return sum;
  };
  SECTION("moving apart, they know nothing of each other") {
    set_velocity<2>(body, [&](const Vec<2>& x) { return Vec<2>(x[0] > 8.05 ? 1 : -1, x[1] > 8.05 ? 1 : -1); });
    const auto before = momenta();
    Stepper<2> stepper(model, system);
    for (int k = 0; k < 50; ++k) stepper.advance(1e-2);
    for (std::size_t q = 0; q < 4; ++q) CHECK((momenta()[q] - before[q]).norm() < 1e-9 * before[q].norm());
  }
  SECTION("pushed along x, a quarter moves its neighbour in x and leaves those beyond the other crack alone") {
    // Only at first: where one crack slips, the other bends.
    set_velocity<2>(body, [&](const Vec<2>& x) { return Vec<2>(quarter(x) == 3 ? -1 : 0, 0); });
    const auto before = momenta();
    Stepper<2> stepper(model, system);
    stepper.advance(5e-3);
    const auto after = momenta();
    CHECK((after[3] + after[2] - before[3] - before[2]).norm() < 1e-9 * before[3].norm());
    CHECK(after[2][0] < 0.05 * before[3][0]);  // has taken up some
    for (const std::size_t q : {std::size_t{0}, std::size_t{1}}) CHECK(after[q].norm() < 1e-9 * before[3].norm());
  }
}

TEST_CASE("a third crack has no effect at nodes with two others", "[cracks]") {
  Model model = block<2>(Kernel::quadratic_spline, Transfer::apic);
  const auto upright = line(Vec3(8.05, 2, 0), Vec3(8.05, 14, 0), 24, smooth()),
             level = line(Vec3(2, 8.05, 0), Vec3(14, 8.05, 0), 24, smooth()),
             third = line(Vec3(7.8, 7.9, 0), Vec3(8.3, 8.2, 0), 2, smooth());
  const auto with = [&](std::vector<CrackSpec> cracks) {
    model.cracks = std::move(cracks);
    return outcome<2>(model, 12, 2);
  };
  CHECK(difference(with({upright, level, third}), with({upright, level})) < 1e-12);
  CHECK(difference(with({third}), with({})) > 1e-4);
  CHECK(difference(with({upright, third, level}), with({upright, level})) > 1e-4);  // the first two count
}

TEST_CASE("lines with common ends are one crack, whichever way they are drawn", "[cracks]") {
  const Kernel kernel = GENERATE(Kernel::gimp, Kernel::quadratic_spline);
  const Transfer transfer = GENERATE(Transfer::flip, Transfer::fmpm);
  Model one = block<2>(kernel, transfer), three = one;
  const Vec3 a(4, 9.3, 0), b(7, 9.6, 0), c(11, 10, 0), d(14, 10.3, 0);
  const auto law = smooth();
  one.cracks = {line({a, b, c, d}, law)};
  three.cracks = {line({a, b}, law), line({c, b}, law), line({c, d}, law)};
  // Later the points where lines meet move with normals of one line each.
  const auto whole = outcome<2>(one, 14, 2);
  CHECK(difference(whole, outcome<2>(three, 14, 2)) < 1e-12);
  three.cracks.pop_back();
  CHECK(difference(whole, outcome<2>(three, 14, 2)) > 1e-3);
}

TEST_CASE("IgnoreContact lets the faces of a crack pass through each other", "[cracks]") {
  Model model = block<2>(Kernel::gimp, Transfer::apic);
  model.cracks = {line(Vec3(2, 8, 0), Vec3(14, 8, 0), 24, nullptr)};
  auto system = build_system<2>(model, lattice_seeds<2>(model, 4, 12));
  set_velocity<2>(system.bodies[0], [](const Vec<2>& x) { return Vec<2>(0, x[1] > 8 ? -1 : 1); });
  Stepper<2> stepper(model, system);
  for (int k = 0; k < 40; ++k) stepper.advance(5e-3);
  CHECK(system.cracks[0].opening(12)[1] == Approx(-0.4).epsilon(1e-9));

  model.cracks[0].law = smooth();
  auto meets = build_system<2>(model, lattice_seeds<2>(model, 4, 12));
  set_velocity<2>(meets.bodies[0], [](const Vec<2>& x) { return Vec<2>(0, x[1] > 8 ? -1 : 1); });
  Stepper<2> other(model, meets);
  for (int k = 0; k < 40; ++k) other.advance(5e-3);
  CHECK(std::abs(meets.cracks[0].opening(12)[1]) < 0.05);
}

TEST_CASE("the contact of crack faces has their area, and acts on either in its direction", "[cracks]") {
  Model model = block<2>(Kernel::quadratic_spline, Transfer::apic);
  const bool around = GENERATE(false, true);
  if (around) model.analysis = Analysis::axisymmetric;
  model.grid.thickness = 3;
  auto seeds = lattice_seeds<2>(model, 4, 12);
  for (Seed& s : seeds) s.volume *= around ? s.x[0] : 3.0, s.mass *= around ? s.x[0] : 3.0;
  const Vec3 left(4, 8, 0), right(12, 8, 0);
  const auto meeting = [&](const CrackSpec& crack) {
    model.cracks = {crack};
    auto system = build_system<2>(model, seeds);
    set_velocity<2>(system.bodies[0], [](const Vec<2>& x) { return Vec<2>(0, x[1] > 8 ? -1 : 1); });
    Stepper<2> stepper(model, system);
    stepper.advance(1e-3);
    CHECK(stepper.contact().ledger().total().area == Approx(around ? (12 * 12 - 4 * 4) / 2 : 8 * 3).epsilon(1e-9));
    return system.cracks[0].traction;
  };
  const auto to_right = meeting(line(left, right, 16, smooth())), to_left = meeting(line(right, left, 16, smooth()));
  for (std::size_t k = 4; k <= 12; ++k) {
    CHECK(to_right[k][1] < -1e5);  // on the lower face
    CHECK(to_right[k][1] == Approx(to_right[8][1]).epsilon(0.05));
    CHECK((to_right[k] + to_left[16 - k]).norm() < 1e-9 * to_right[k].norm());
  }
}

TEST_CASE("a crack is the middle of its faces, also where it extends beyond its body", "[cracks]") {
  Model model = block<2>(Kernel::quadratic_spline, Transfer::apic);
  model.cracks = {line(Vec3(4, 8.2, 0), Vec3(12, 8.2, 0), 16, smooth())};
  auto system = build_system<2>(model, lattice_seeds<2>(model, 4, 12));
  set_velocity<2>(system.bodies[0], [](const Vec<2>& x) {
    return Vec<2>(x[1] > 8.2 ? 0.5 : -0.5, 0.1 * (x[0] - 8) + (x[1] > 8.2 ? 0.5 : 0.0));
  });
  Stepper<2> stepper(model, system);
  for (int k = 0; k < 40; ++k) stepper.advance(5e-3);
  const Crack<2>& crack = system.cracks[0];
  REQUIRE(crack.pieces.size() > crack.main_pieces);
  for (std::size_t k = 0; k < crack.x.size(); ++k)
    CHECK((0.5 * (crack.face[0][k] + crack.face[1][k]) - crack.x[k]).norm() < 1e-12);
}

TEST_CASE("a point is on the side of a crack that the segment to a node tells", "[cracks]") {
  std::vector<Vec3> points;  // a line that bends, ends within the body and has many short pieces
  for (int k = 0; k <= 400; ++k) {
    const double s = k / 400.0;
    points.emplace_back(5.2 + 5.3 * s, 8.1 + 2.4 * std::sin(7 * s), 0.0);
  }
  CHECK(compare_sides<2>(line(points, smooth())) > 1000);
  CHECK(compare_sides<2>(line(Vec3(5, 8, 0), Vec3(11, 8, 0), 600, smooth())) > 1000);  // in a grid line
  CHECK(compare_sides<2>(line(Vec3(5, 5, 0), Vec3(11, 11, 0), 1, smooth())) > 1000);   // through nodes
  CHECK(compare_sides<2>(line({Vec3(6, 6, 0), Vec3(10, 6.5, 0), Vec3(6.2, 7, 0), Vec3(10, 10, 0)}, smooth())) > 1000);
  CHECK(compare_sides<3>(sheet(Vec3(4.7, 4.9, 6.2), Vec3(2.6, 0.3, 0.4), Vec3(0.2, 2.4, -0.3), 12, smooth())) > 1000);
  CHECK(compare_sides<3>(sheet(Vec3(3, 3, 6), Vec3(6, 0, 0), Vec3(0, 6, 0), 3, smooth())) > 1000);
}

TEST_CASE("cracks: any number of threads gives the same bits", "[cracks][threads]") {
  Model model = block<2>(Kernel::quadratic_spline, Transfer::apic);
  model.cracks = {line(Vec3(5.1, 6.3, 0), Vec3(10.9, 9.77, 0), 13, smooth()),
                  line(Vec3(9.3, 5.2, 0), Vec3(6.2, 11.1, 0), 9, smooth())};
  const auto run = [&](int threads) {
    set_threads(threads);
    const auto out = outcome<2>(model, 12, 40);
    set_threads(1);
    return out;
  };
  const auto one = run(1);
  CHECK(one == run(2));
  CHECK(one == run(5));
}
