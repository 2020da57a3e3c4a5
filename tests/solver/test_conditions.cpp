// SPDX-License-Identifier: MIT
#include "cloud.hpp"
#include "solver/step_start.hpp"
#include "solver/transfer/affine_at_walls.hpp"

#include <catch2/catch.hpp>

using namespace tribo;
using namespace tribo::test;

namespace {

// Mass shares of a single particle at distance x (cells) from the plane at node 0 of the user's grid, after folding.
std::vector<double> folded_weights(Kernel kernel, double x, bool symmetry, bool high_side) {
  Model model = grid_model<2>(kernel, Transfer::flip);
  auto& plane = symmetry ? model.grid.symmetry : model.grid.wall;
  plane[0][high_side ? 1 : 0] = high_side ? 24.0 : 0.0;
  Seed s;
  s.x = Vec3(high_side ? 24 - x : x, 12, 0), s.half_size = Vec3(0.25, 0.25, 0), s.volume = 0.25, s.mass = 1;
  auto system = build_system<2>(model, {s});
  settle(system);
  auto& field = system.fields[0];
  const auto exchange = make_exchange<2>(model.grid, system.lattice);
  exchange->locate(field.map);
  make_transfers<2>(model.scheme)->scatter(system.bodies[0], {field.map, field.nodes}, Scatter::momentum, false, false);
  exchange->sum_images(field.nodes);
  std::vector<double> shares(5, 0.0);
  for (std::int64_t n = 0; n < field.map.node_count(); ++n) {
    const int i = field.map.node_at(n)[0] - Lattice<2>::padding;
    const int from_plane = high_side ? 24 - i : i;
    const double mass = field.nodes[static_cast<std::size_t>(n)].mass;
    if (from_plane >= 0 && from_plane < 5)
      shares[static_cast<std::size_t>(from_plane)] += mass;
    else
      REQUIRE(mass == 0.0);
  }
  return shares;
}

void equal(const std::vector<double>& a, const std::vector<double>& b) {
  for (std::size_t k = 0; k < b.size(); ++k) CHECK(std::abs(a[k] - b[k]) < 1e-14);
}

}  // namespace

TEST_CASE("a wall gives the boundary-modified B-splines", "[conditions]") {
  for (const bool high : {false, true}) {
    equal(folded_weights(Kernel::quadratic_spline, 0.2, false, high), {0.8, 0.2, 0, 0, 0});
    equal(folded_weights(Kernel::quadratic_spline, 0.5, false, high), {0.5, 0.5, 0, 0, 0});
    equal(folded_weights(Kernel::quadratic_spline, 0.9, false, high), {0.18, 0.74, 0.08, 0, 0});
    // w = 2/3 - x^2 + x^3/2 + 2 (1-x)^3/6 at the wall and so on, x = 0.2
    equal(folded_weights(Kernel::cubic_spline, 0.2, false, high),
          {0.80133333333333334, 0.19733333333333333, 0.0013333333333333333, 0, 0});
    equal(folded_weights(Kernel::quadratic_spline, 0.0, false, high), {1, 0, 0, 0, 0});
    equal(folded_weights(Kernel::cubic_spline, 0.0, false, high), {1, 0, 0, 0, 0});
  }
}

TEST_CASE("prescribed values begin at their time, and functions have their own unit of time", "[conditions]") {
  Prescribed p;
  p.value = 3, p.time = 2;
  const auto at = [&](const char* word, double time) {
    p.style = style_of(word);
    return p.at({.time = time, .dt = 0.5, .displacement = 0.1});
  };
  CHECK(at("constant", 1.9) == 0);
  CHECK(at("constant", 2) == 3);
  CHECK(at("linear", 1.9) == 0);
  CHECK(at("linear", 2.5) == Approx(1.5));
  CHECK(at("elastic", 1.9) == 0);
  CHECK(at("elastic", 2.5) == Approx(-0.3));
  p.function = Expression("10*t + dt", Origin{});
  p.function_time = 0.25, p.function_scale = 7;
  CHECK(at("function", 1.9) == 0);
  CHECK(at("function", 2.5) == Approx(7 * (10 * 2 + 2)));
}

TEST_CASE("a symmetry plane adds the mirror image", "[conditions]") {
  for (const bool high : {false, true}) {
    // quadratic weights at x = 0.2: 0.045 at -1, 0.71 at 0, 0.245 at 1; the image has 0.245, 0.71, 0.045
    equal(folded_weights(Kernel::quadratic_spline, 0.2, true, high), {1.42, 0.29, 0, 0, 0});
  }
}

TEST_CASE("linear fields pass a wall unchanged", "[conditions]") {
  Model model = grid_model<2>(Kernel::cubic_spline, Transfer::pic);
  model.grid.wall[0][0] = 0.0, model.grid.wall[1][1] = 24.0;
  Seed s;
  s.x = Vec3(0.3, 23.8, 0), s.half_size = Vec3(0.25, 0.25, 0), s.volume = 0.25, s.mass = 1;
  auto system = build_system<2>(model, {s});
  settle(system);
  auto& field = system.fields[0];
  const auto exchange = make_exchange<2>(model.grid, system.lattice);
  exchange->locate(field.map);
  for (std::int64_t n = 0; n < field.map.node_count(); ++n) {
    const Vec<2> x = system.lattice.position(field.map.node_at(n));
    Node& node = field.nodes[static_cast<std::size_t>(n)];
    const bool inside = x[0] > -0.5 && x[1] < 24.5;
    node.velocity[0] = inside ? 1 + 2 * x[0] - x[1] : 1e9;  // what is beyond must not matter
    node.velocity[1] = inside ? 3 - x[0] : -1e9;
  }
  exchange->copy_images(field.nodes);
  Gather what;
  what.move = true, what.flip = 0, what.dt = 1e-12;
  make_transfers<2>(model.scheme)->gather(system.bodies[0], {field.map, field.nodes}, what);
  CHECK(system.bodies[0].particles.velocity(0)[0] == Approx(1 + 0.6 - 23.8).epsilon(1e-12));
  CHECK(system.bodies[0].particles.velocity(0)[1] == Approx(2.7).epsilon(1e-12));
}

TEST_CASE("with APIC a linear velocity of the particles is that of the nodes at walls, too", "[conditions]") {
  const Kernel kernel = GENERATE(Kernel::quadratic_spline, Kernel::cubic_spline);
  const bool from_start = GENERATE(false, true);
  Model model = grid_model<2>(kernel, Transfer::apic);
  model.scheme.order = UpdateOrder::usl, model.scheme.extrapolate_again = from_start;
  model.grid.wall[0][0] = 4.0, model.grid.wall[0][1] = 20.0, model.grid.wall[1][1] = 24.0;
  std::vector<Seed> seeds;
  for (int i = 0; i < 32; ++i)
    for (int j = 0; j < 8; ++j) {
      Seed s;
      s.x = Vec3(4.25 + 0.5 * i, 20.25 + 0.5 * j, 0), s.half_size = Vec3(0.25, 0.25, 0), s.volume = 0.25, s.mass = 1;
      seeds.push_back(s);
    }
  auto system = build_system<2>(model, seeds);
  settle(system);
  auto& body = system.bodies[0];
  Eigen::Matrix2d C;
  C << 0.3, -0.7, 1.1, 0.4;
  const Vec<2> v0(2, -1);
  const double moment = kernel == Kernel::quadratic_spline ? 0.25 : 1.0 / 3;  // of the shape functions
  for (std::size_t p = 0; p < body.particles.size(); ++p) {
    const Vec<2> x = body.particles.position(p), v = v0 + C * x;
    for (std::size_t d = 0; d < 2; ++d) {
      body.particles.v()[d][p] = v[static_cast<Eigen::Index>(d)];
      for (std::size_t c = 0; c < 2; ++c)
        body.particles[body.affine][d * 2 + c][p] =
            moment * C(static_cast<Eigen::Index>(d), static_cast<Eigen::Index>(c));
    }
  }
  if (from_start) {
    keep_start_positions(system);
    for (std::size_t p = 0; p < body.particles.size(); ++p) body.particles.x()[0][p] += 0.1;
  }
  auto& field = system.fields[0];
  std::fill(field.nodes.begin(), field.nodes.end(), Node{});
  make_transfers<2>(model.scheme)
      ->scatter(body, Target<2>(field.map, field.nodes), Scatter::momentum, from_start, false);
  const auto total = [&] {
    Vec<2> sum = Vec<2>::Zero();
    for (const Node& node : field.nodes) sum += Eigen::Map<const Vec<2>>(node.momentum);
    return sum;
  };
  const Vec<2> before = total();
  AffineAtWalls<2>(model, system.lattice).add(body, field.map, field.nodes, from_start);
  CHECK((total() - before).norm() < 1e-12 * before.norm());
  const auto exchange = make_exchange<2>(model.grid, system.lattice);
  exchange->locate(field.map);
  exchange->sum_images(field.nodes);
  for (std::int64_t n = 0; n < field.map.node_count(); ++n) {
    const Vec<2> x = system.lattice.position(field.map.node_at(n));
    const Node& node = field.nodes[static_cast<std::size_t>(n)];
    if (exchange->is_image(field.map.node_at(n)) || !(node.mass > 1e-6)) continue;
    CHECK((Eigen::Map<const Vec<2>>(node.momentum) / node.mass - v0 - C * x).norm() < 1e-11);
  }
}

TEST_CASE("a block against a symmetry plane moves like half of the whole block", "[conditions]") {
  const Kernel kernel = GENERATE(from_range(all_kernels));
  const auto order = GENERATE(UpdateOrder::usf, UpdateOrder::usl, UpdateOrder::usavg);
  const auto transfer = GENERATE(Transfer::flip, Transfer::fmpm);
  INFO(name(kernel) << ", order " << static_cast<int>(order));
  const auto run = [&](bool half) {
    Model model = grid_model<2>(kernel, transfer, order, true);
    if (half) model.grid.symmetry[0][0] = 12.0;
    std::vector<Seed> seeds;
    for (const Seed& s : lattice_seeds<2>(model, 8, 16)) {
      Seed moved = s;
      const double u = s.x[0] - 12, w = s.x[1] - 12;
      moved.v = Vec3(-3 * std::sin(0.3 * u), std::cos(0.4 * u) * w * 0.2, 0);
      if (!half || s.x[0] > 12) seeds.push_back(moved);
    }
    auto system = build_system<2>(model, seeds);
    Stepper<2> stepper(model, system);
    for (int k = 0; k < 30; ++k) stepper.advance(2e-3);
    std::vector<std::array<double, 4>> right;
    for (std::size_t i = 0; i < system.bodies[0].particles.size(); ++i) {
      const Vec<2> x = system.bodies[0].particles.position(i), v = system.bodies[0].particles.velocity(i);
      if (x[0] > 12) right.push_back({x[1], x[0], v[0], v[1]});
    }
    std::sort(right.begin(), right.end());
    return right;
  };
  const auto whole = run(false), half = run(true);
  REQUIRE(whole.size() == half.size());
  double worst = 0;
  for (std::size_t i = 0; i < whole.size(); ++i)
    for (std::size_t k = 0; k < 4; ++k) worst = std::max(worst, std::abs(whole[i][k] - half[i][k]));
  CHECK(worst < 1e-9);  // round-off, amplified over 30 steps
}

TEST_CASE("prescribed velocities hold, react and do work", "[conditions]") {
  const auto order = GENERATE(UpdateOrder::usf, UpdateOrder::usl, UpdateOrder::usavg);
  const bool again = GENERATE(false, true);
  Model model = grid_model<2>(Kernel::gimp, Transfer::flip, order, again);
  NodeCondition condition;
  condition.where = rectangle(0, 24, 0, 24);
  condition.direction = Vec3::UnitX();
  condition.velocity.value = 2.0;
  model.node_conditions.push_back(condition);
  auto system = build_system<2>(model, lattice_seeds<2>(model, 8, 16));
  Stepper<2> stepper(model, system);
  stepper.advance(1e-4);
  const Measures m = measure(system);
  // From rest to 2 in one step: the impulse is m v, the work m v^2/2
  CHECK(m.momentum[0] == Approx(m.mass * 2).epsilon(1e-10));
  CHECK(stepper.conditions(0).impulse()[0] == Approx(m.mass * 2).epsilon(1e-10));
  CHECK(stepper.conditions(0).work() == Approx(m.kinetic).epsilon(1e-10));
  CHECK(stepper.conditions(0).reactions()[0][0] == Approx(m.mass * 2 / 1e-4).epsilon(1e-10));
}

TEST_CASE("a field finds those of the selected nodes that are in its blocks", "[conditions]") {
  Model model = grid_model<2>(Kernel::gimp, Transfer::flip);
  for (const int axis : {1, 0, 1}) {  // the last ones add to the first ones
    NodeCondition condition;
    condition.where = axis == 1 ? rectangle(0, 24, 8, 8) : rectangle(20, 20, 0, 24);
    condition.direction = Vec3::Unit(axis);
    model.node_conditions.push_back(condition);
  }
  const Lattice<2> lattice(Vec<2>(0, 0), Vec<2>(24, 24), {24, 24});
  Problems problems;
  const SelectedNodes<2> selected(model, lattice, problems);
  REQUIRE(problems.empty());
  BlockMap<2> map(lattice);
  std::vector<SelectedNodes<2>::Existing> existing;
  selected.find(map, existing);
  CHECK(existing.empty());
  constexpr int padding = Lattice<2>::padding, edge = block_edge<2>;
  const Index<2> block{(padding + 8) / edge, (padding + 8) / edge};
  map.rebuild(std::vector<BlockReach<2>>{{lattice.block_index(block), {0, 0}, {edge - 1, edge - 1}}});
  selected.find(map, existing);
  REQUIRE(existing.size() == static_cast<std::size_t>(edge));
  for (std::size_t k = 0; k < existing.size(); ++k) {
    const SelectedNode<2>& node = selected[existing[k].number];
    CHECK(node.node == Index<2>{block[0] * edge + static_cast<int>(k), padding + 8});
    CHECK(existing[k].position == map.node(node.node));
    CHECK(node.conditions == std::vector<std::size_t>{0, 2});
    CHECK(node.direction == Vec<2>(0, 1));
  }
}

TEST_CASE("a layer between two symmetry planes moves like one of many layers", "[conditions]") {
  const Kernel kernel = GENERATE(Kernel::gimp, Kernel::quadratic_spline, Kernel::cubic_spline);
  INFO(name(kernel));
  const auto run = [&](int low, int high) {
    Model model = grid_model<2>(kernel, Transfer::flip, UpdateOrder::usl, false);
    model.grid.symmetry[1] = {static_cast<double>(low), static_cast<double>(high)};
    std::vector<Seed> seeds;
    for (Seed s : lattice_seeds<2>(model, 8, 16)) {
      if (s.x[1] < low || s.x[1] > high) continue;
      s.v = Vec3(-3 * std::sin(0.3 * s.x[0]), 0, 0);
      seeds.push_back(s);
    }
    auto system = build_system<2>(model, seeds);
    Stepper<2> stepper(model, system);
    for (int k = 0; k < 30; ++k) stepper.advance(2e-3);
    std::vector<std::array<double, 2>> row;
    for (std::size_t i = 0; i < system.bodies[0].particles.size(); ++i)
      if (std::abs(system.bodies[0].particles.position(i)[1] - 12.25) < 0.1)
        row.push_back({system.bodies[0].particles.position(i)[0], system.bodies[0].particles.velocity(i)[0]});
    std::sort(row.begin(), row.end());
    return row;
  };
  // One cell: nearer than the reach of the shape functions. An image of an image counts.
  const auto thin = run(12, 13), thick = run(8, 16);
  REQUIRE(thin.size() == 16);
  REQUIRE(thin.size() == thick.size());
  for (std::size_t i = 0; i < thin.size(); ++i)
    for (std::size_t k = 0; k < 2; ++k) CHECK(std::abs(thin[i][k] - thick[i][k]) < 1e-10);
}
