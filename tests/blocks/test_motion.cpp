// SPDX-License-Identifier: MIT
/// Energies, threads, rotation, friction of moving blocks.

#include "archived.hpp"
#include "base/parallel.hpp"
#include "blocks/block_cases.hpp"

#include <catch2/catch.hpp>

using namespace tribo;
using namespace tribo::test;

namespace {

/// A Voronoi box whose bonds break, slide and have dashpots, pulled at a platen under pressure and gravity.
std::shared_ptr<BlocksSpec> rough_load(bool plane) {
  const Vec3 size = plane ? Vec3(0.05, 0.1, 0) : Vec3(0.05, 0.1, 0.05);
  auto law = joint_law("SpringNetwork", {{"compute-stiffness", "emod 50e9 poisson 0.2"},
                                         {"sn_ten", "2e6"},
                                         {"sn_coh", "4e6"},
                                         {"sn_fa", "30"},
                                         {"dp_nratio", "0.1"},
                                         {"dp_sratio", "0.1"},
                                         {"bond", "gap 1e-6"}});
  auto spec = std::make_shared<BlocksSpec>();
  BlockGroup group;
  group.shape = BlockGroup::Shape::voronoi;
  group.high = size, group.points = scattered(plane ? 120 : 100, size, plane, plane ? 0.004 : 0.008);
  group.density = 2500, group.velocity = Vec3(0, 0.01, 0);
  spec->groups.push_back(group);
  spec->laws.initial = law, spec->local_damping = 0.05, spec->stress_iterations = 1;
  BlockPlaten platen;
  const auto at = [&](double y) {
    const Vec3 e = Vec3::Constant(1e-6);
    return plane ? rectangle(-e[0], size[0] + e[0], y - e[0], y + e[0])
                 : box(Vec3(0, y, 0) - e, Vec3(size[0], y, size[2]) + e);
  };
  platen.where = at(0), platen.rough = true;
  spec->platens.push_back(platen);
  BlockPressure pull;
  pull.where = at(size[1]), pull.pressure = {Expression("-3e6 * min(1, t/1e-5)", {}), 1.0, 1.0};
  spec->pressures.push_back(pull);
  return spec;
}

/// Bricks that stand on a floor and on each other, one that falls askew on them, and a ball.
std::shared_ptr<BlocksSpec> heap() {
  auto spec = std::make_shared<BlocksSpec>();
  const auto brick = [&](const Vec3& low, const Vec3& high) {
    BlockGroup g;
    g.low = low, g.high = high, g.density = 2000;
    spec->groups.push_back(g);
  };
  brick({-2, -1, -2}, {2, 0, 2});
  brick({0, 0, 0}, {0.4, 0.5, 0.3});
  brick({0, 0.5, 0}, {0.4, 1, 0.3});
  brick({0.1, 1.1, 0.1}, {0.3, 1.3, 0.7});
  spec->groups.back().spin = Vec3(2, 1, 3), spec->groups.back().velocity = Vec3(0.5, 0, 0);
  BlockGroup ball;
  ball.shape = BlockGroup::Shape::ball, ball.points = {{-0.5, 0.3, 0.1}}, ball.radius = 0.2, ball.density = 2000;
  ball.velocity = Vec3(3, 0, 0);
  spec->groups.push_back(ball);
  BlockHold floor;
  floor.where = around(-2, 2, -1, -0.1);
  for (auto* list : {&floor.velocity, &floor.spin})
    for (auto& v : *list) v = constant(0);
  spec->holds = {floor};
  spec->corners = true;
  spec->laws.initial = spec->laws.later =
      joint_law("SpringNetwork", {{"kn", "1e8"}, {"ks", "1e8"}, {"fric", "0.5"}, {"dp_nratio", "0.2"}});
  return spec;
}

}  // namespace

TEST_CASE("the energies of blocks that break and slide add up", "[blocks]") {
  for (const bool plane : {true, false}) {
    Assembly body(rough_load(plane), plane ? 2 : 3, true, Vec3(0, -1e5, 0), 1.0);
    const double before = body.ledger().content(), dt = body.critical_step();
    for (int k = 0; k < 800; ++k) body.advance(dt);
    const BlockLedger now = body.ledger();
    INFO("kinetic " << now.kinetic << " strain " << now.strain << " slip " << now.slip << " dashpots " << now.dashpot
                    << " damping " << now.damping << " released " << now.released << " work " << now.outer_work);
    CHECK(body.broken[0] > 5);
    CHECK(now.slip > 0);
    CHECK(now.dashpot > 0);
    const double put_in = std::abs(now.outer_work) + std::abs(now.boundary_work) + std::abs(now.potential);
    CHECK(std::abs(now.content() - before - now.outer_work - now.boundary_work) < 1e-6 * put_in);
  }
}

namespace {

/// Two squares that share a face.
std::shared_ptr<BlocksSpec> two_squares(std::shared_ptr<const JointLaw> law) {
  auto spec = std::make_shared<BlocksSpec>();
  for (const double y : {0.0, 1.0}) {
    BlockGroup g;
    g.low = Vec3(0, y, 0), g.high = Vec3(1, y + 1, 0), g.density = 2000;
    spec->groups.push_back(g);
  }
  spec->laws.initial = std::move(law);
  return spec;
}

}  // namespace

TEST_CASE("a block that is turned does the work that its bonds store", "[blocks]") {
  auto spec = two_squares(elastic_bonds(1e6, 0));
  for (const double y : {0.0, 1.0}) {
    BlockHold hold;
    hold.where = around(0.1, 0.9, y + 0.1, y + 0.9);
    for (int d = 0; d < 2; ++d) hold.velocity[static_cast<std::size_t>(d)] = constant(0);
    hold.spin[2] = constant(0.01 * y);
    spec->holds.push_back(hold);
  }
  Assembly body(spec, 2, true, Vec3::Zero(), 1.0);
  const double before = body.ledger().content();
  for (int k = 0; k < 100; ++k) body.advance(1e-3);
  const BlockLedger now = body.ledger();
  CHECK(now.strain > 0);
  CHECK(now.boundary_work == Approx(now.strain).epsilon(1e-9));
  CHECK(now.content() - before == Approx(now.boundary_work).epsilon(1e-9));
}

TEST_CASE("Poisson's ratio shortens the stable step as it stiffens the body", "[blocks]") {
  const auto step = [](double nu, bool plane_stress) {
    return Assembly(two_squares(elastic_bonds(1e6, nu)), 2, plane_stress, Vec3::Zero(), 1.0).critical_step();
  };
  for (const double nu : {0.2, 0.4}) {
    CHECK(step(nu, true) == Approx(std::sqrt(1 - nu * nu) * step(0, true)));
    CHECK(step(nu, false) == Approx(std::sqrt((1 + nu) * (1 - 2 * nu) / (1 - nu)) * step(0, false)));
  }
}

TEST_CASE("a force of the grid acts in the stress of a block from its reference point", "[blocks]") {
  Assembly body(specimen({{0.2, 0.3, 0}, {0.7, 0.8, 0}}, Vec3(1, 1, 0), elastic_bonds(1e6, 0)), 2, true, Vec3::Zero(),
                1.0);
  const Mat3 before = body.mean_stress();
  body.grid_forces.resize(body.bodies.size());
  const Vec3 force(3, -2, 0), reference = body.bodies[0].reference;
  REQUIRE(reference.norm() > 0.01);
  body.grid_forces[0].force = force;  // at the centre of mass
  const Mat3 spread = -force * reference.transpose();
  CHECK((body.mean_stress() - before - 0.5 * (spread + spread.transpose())).norm() < 1e-12);
}

TEST_CASE("blocks move with the same bits on any number of threads and after a restart", "[blocks]") {
  const std::vector<std::pair<std::shared_ptr<BlocksSpec>, int>> models{
      {rough_load(true), 2}, {rough_load(false), 3}, {heap(), 3}};
  for (const auto& [spec, dimension] : models) {
    const Vec3 gravity(0, dimension == 3 && spec->laws.later ? -10 : -1e5, 0);
    std::vector<ArchivedState> ends;
    for (const int count : {1, 2}) {
      set_threads(count);
      Assembly body(spec, dimension, true, gravity, 1.0);
      const double dt = body.critical_step();
      const int steps = spec->laws.later ? static_cast<int>(0.4 / dt) : 100;
      for (int k = 0; k < steps; ++k) body.advance(dt);
      const auto pairs = body.found_pairs();
      const ArchivedState saved = archived(body);
      for (int k = 0; k < steps; ++k) body.advance(dt);
      if (spec->laws.later) CHECK(body.found_pairs() != pairs);
      ends.push_back(archived(body));
      Assembly again(spec, dimension, true, gravity, 1.0);
      restore(saved, again);
      for (int i = 0; i < steps; ++i) again.advance(dt);
      ends.push_back(archived(again));
    }
    set_threads(1);
    for (std::size_t k = 1; k < ends.size(); ++k) CHECK(differences(ends[0], ends[k]).empty());
  }
}

TEST_CASE("a free block keeps its angular momentum and energy", "[blocks]") {
  auto spec = std::make_shared<BlocksSpec>();
  BlockGroup brick;
  brick.high = Vec3(1, 2, 3), brick.spin = Vec3(0.1, 3, 0.1);  // about the middle axis: it tumbles
  spec->groups.push_back(brick);
  Assembly body(spec, 3, false, Vec3::Zero(), 1.0);
  const auto momentum = [&] {
    const Mat3 axes = body.motion[0].R * body.bodies[0].axes;
    return Vec3(axes * body.bodies[0].inertia.cwiseProduct(axes.transpose() * body.motion[0].w));
  };
  const Vec3 before = momentum();
  const double energy = body.ledger().kinetic;
  double least = 1;
  for (int k = 0; k < 20000; ++k) {
    body.advance(1e-3);
    least = std::min(least, body.motion[0].R(1, 1));
  }
  CHECK(least < -0.5);
  CHECK(body.ledger().kinetic == Approx(energy).epsilon(1e-3));
  CHECK((momentum() - before).norm() < 5e-3 * before.norm());
}

TEST_CASE("dashpots of any ratio damp at the critical step", "[blocks]") {
  for (const char* ratio : {"0.3", "1"}) {
    INFO(ratio);
    const auto spec = two_squares(joint_law("SpringNetwork", {{"kn", "1e8"},
                                                              {"ks", "5e7"},
                                                              {"sn_ten", "1e12"},
                                                              {"sn_coh", "1e12"},
                                                              {"dp_nratio", ratio},
                                                              {"dp_sratio", ratio}}));
    for (std::size_t row = 1; row < 5; ++row)
      for (BlockGroup g : {spec->groups[0], spec->groups[1]}) {
        g.low[0] += static_cast<double>(row), g.high[0] += static_cast<double>(row);
        g.velocity = Vec3(row % 2 == 0 ? 0.1 : -0.1, g.low[1] > 0.5 ? 0.1 : -0.2, 0);
        spec->groups.push_back(g);
      }
    spec->corners = true;
    Assembly body(spec, 2, true, Vec3::Zero(), 1.0);
    const double begin = body.ledger().kinetic, dt = body.critical_step();
    double before = begin;
    for (int k = 0; k < 2000; ++k) {
      body.advance(dt);
      const BlockLedger now = body.ledger();
      if (k % 50 != 0) continue;
      CHECK(now.kinetic + now.strain < before + 1e-3 * begin);
      before = now.kinetic + now.strain;
    }
    const BlockLedger now = body.ledger();
    CHECK(now.dashpot > 0);
    CHECK(std::abs(now.content() - begin) < 1e-6 * begin);
  }
}
