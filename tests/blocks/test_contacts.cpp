// SPDX-License-Identifier: MIT
/// Contacts that come about while blocks move.

#include "blocks/block_cases.hpp"

#include <catch2/catch.hpp>

#include <numbers>
#include <random>

using namespace tribo;
using namespace tribo::test;

namespace {

BlockGroup brick(const Vec3& low, const Vec3& high, const Vec3& velocity = Vec3::Zero()) {
  BlockGroup b;
  b.low = low, b.high = high, b.velocity = velocity, b.density = 2000;
  return b;
}

std::shared_ptr<const JointLaw> rubbing(const char* friction, const char* dashpot) {
  return joint_law("SpringNetwork", {{"kn", "1e8"}, {"ks", "1e8"}, {"fric", friction}, {"dp_nratio", dashpot}});
}

BlockHold standing(double xmin, double xmax, double ymin, double ymax) {
  BlockHold hold;
  hold.where = around(xmin, xmax, ymin, ymax);
  for (auto* list : {&hold.velocity, &hold.spin})
    for (auto& v : *list) v = constant(0);
  return hold;
}

}  // namespace

TEST_CASE("polygons that meet part again with their momentum", "[blocks]") {
  for (const double aside : {0.0, 0.3}) {
    auto spec = std::make_shared<BlocksSpec>();
    spec->groups = {brick({0, 0, 0}, {1, 1, 0}, {1, 0, 0}), brick({1.1, aside, 0}, {2.1, 1 + aside, 0})};
    spec->laws.later = rubbing("0", "0");
    Assembly body(spec, 2, true, Vec3::Zero(), 1.0);
    const double dt = body.critical_step(), energy = body.ledger().kinetic;
    const auto spin = [&] {
      double sum = 0;
      for (std::size_t k = 0; k < 2; ++k)
        sum += body.bodies[k].inertia[2] * body.motion[k].w[2] +
               body.bodies[k].mass *
                   (body.motion[k].x[0] * body.motion[k].v[1] - body.motion[k].x[1] * body.motion[k].v[0]);
      return sum;
    };
    const double turning = spin();
    for (int k = 0; k * dt < 0.5; ++k) body.advance(dt), body.check_contacts();
    CHECK(body.motion[0].v[0] + body.motion[1].v[0] == Approx(1));
    CHECK(spin() == Approx(turning).epsilon(1e-3));
    CHECK(body.ledger().kinetic == Approx(energy).epsilon(0.02));
    CHECK(body.active() == 0);
    if (aside == 0)
      CHECK(body.motion[1].v[0] == Approx(1).epsilon(0.01));
    else
      CHECK(std::abs(body.motion[1].w[2]) > 0.1);
  }
}

TEST_CASE("a polygon that falls on a floor rests on its springs", "[blocks]") {
  auto spec = std::make_shared<BlocksSpec>();
  spec->groups = {brick({-2, -1, 0}, {2, 0, 0}), brick({0, 0.05, 0}, {1, 1.05, 0})};
  spec->holds = {standing(-2, 2, -1, -0.1)};
  spec->laws.later = rubbing("0.5", "0.5");
  Assembly body(spec, 2, true, Vec3(0, -10, 0), 1.0);
  const double dt = body.critical_step();
  for (int k = 0; k * dt < 2; ++k) body.advance(dt), body.check_contacts();
  CHECK(body.motion[1].x[1] - 0.5 == Approx(-2000 * 10 / 1e8).epsilon(1e-3));
  CHECK(std::abs(body.rotation(1)[2]) < 1e-6);
  const BlockLedger l = body.ledger();
  CHECK(std::abs(l.content()) < 1e-3 * l.dashpot);
}

TEST_CASE("a block slides from one block to the next", "[blocks]") {
  auto spec = std::make_shared<BlocksSpec>();
  spec->groups = {brick({0, -1, 0}, {2, 0, 0}), brick({2, -1, 0}, {4, 0, 0}),
                  brick({0.5, 0, 0}, {1.5, 1, 0}, {3, 0, 0})};
  spec->holds = {standing(0, 4, -1, -0.1)};
  spec->laws.initial = spec->laws.later = rubbing("0.3", "0.3");
  Assembly body(spec, 2, true, Vec3(0, -10, 0), 1.0);
  const double dt = body.critical_step();
  for (int k = 0; k * dt < 1.5; ++k) body.advance(dt), body.check_contacts();
  CHECK(body.motion[2].x[0] - 1.0 == Approx(9 / (2 * 0.3 * 10)).epsilon(0.03));
  CHECK(body.motion[2].v.norm() < 1e-2);
}

TEST_CASE("polyhedra that meet part again with their momentum", "[blocks]") {
  const auto pair = [](const Vec3& turned) {
    auto spec = std::make_shared<BlocksSpec>();
    spec->groups = {brick({0, 0, 0}, {1, 1, 1}, {1, 0, 0}), brick({1.5, 0.1, -0.2}, {2.5, 1.1, 0.8})};
    spec->laws.later = rubbing("0.2", "0");
    auto body = std::make_unique<Assembly>(spec, 3, true, Vec3::Zero(), 1.0);
    if (!turned.isZero(0.0)) {
      const Eigen::Quaterniond q(Eigen::AngleAxisd(turned.norm(), turned.normalized()));
      body->motion[1].R = q.toRotationMatrix(), body->orientation[1] = {q.w(), q.x(), q.y(), q.z()};
    }
    return body;
  };
  for (const Vec3& turned : {Vec3(0, 0, 0), Vec3(0.5, 0.7, 0.3), Vec3(0, 0, 0.785)}) {
    const auto body = pair(turned);
    const double dt = body->critical_step();
    const auto spin = [&] {
      Vec3 sum = Vec3::Zero();
      for (std::size_t k = 0; k < 2; ++k) {
        const BlockMotion& m = body->motion[k];
        sum += body->bodies[k].inertia[0] * m.w + body->bodies[k].mass * (m.x - 0.5 * dt * m.v).cross(m.v);
      }
      return sum;
    };
    const auto drift = [&] { return Vec3(body->motion[0].v + body->motion[1].v - Vec3::UnitX()).norm(); };
    body->advance(dt);
    const Vec3 turning = spin();
    const double energy = body->ledger().kinetic;
    for (int k = 0; k * dt < 1; ++k) body->advance(dt), body->check_contacts();
    CHECK(drift() < 1e-12);
    CHECK((spin() - turning).norm() < 1e-9 * turning.norm());
    CHECK(body->active() == 0);
    CHECK(body->motion[1].v[0] > 0.3);
    const BlockLedger l = body->ledger();
    CHECK(l.kinetic + l.slip == Approx(energy).epsilon(0.02));
    CHECK(std::abs(l.content() - energy) < 1e-4 * energy);
  }
}

TEST_CASE("a box that falls on a floor rests on its springs, and slides off it as it should", "[blocks]") {
  auto spec = std::make_shared<BlocksSpec>();
  spec->groups = {brick({-2, -1, -2}, {2, 0, 2}), brick({0, 0.05, 0}, {1, 1.05, 1}),
                  brick({-2, 0, -1.5}, {-1, 1, -0.5}, {2, 0, 0})};
  spec->holds = {standing(-2, 2, -1, -0.1)};
  spec->laws.initial = spec->laws.later = rubbing("0.5", "0.5"), spec->corners = true;
  Assembly body(spec, 3, true, Vec3(0, -10, 0), 1.0);
  const double dt = body.critical_step();
  for (int k = 0; k * dt < 2; ++k) body.advance(dt), body.check_contacts();
  CHECK(body.motion[1].x[1] - 0.5 == Approx(-2000 * 10 / 1e8).epsilon(1e-3));
  CHECK(body.rotation(1).norm() < 1e-6);
  // The forces of the four dashpots during settling cause no friction: c y/m, c = 4 sqrt(m k/4), y = m g/k
  const double speed = 2 + 0.5 * 10 * 2 * std::sqrt(2000 / 1e8);
  CHECK(body.motion[2].x[0] + 1.5 == Approx(speed * speed / (2 * 0.5 * 10)).epsilon(5e-3));
  CHECK(std::abs(body.motion[2].x[2] + 1) < 1e-9);
  const BlockLedger l = body.ledger();
  CHECK(std::abs(l.content() - 0.5 * 2000 * 4) < 1e-5 * l.slip);
}

TEST_CASE("the nearest point of a block's surface", "[blocks]") {
  const auto check = [](const BlockShape& shape, bool plane) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> some(-1.5, 1.5);
    for (int k = 0; k < 200; ++k) {
      const Vec3 x(some(random), some(random), plane ? 0.0 : some(random));
      const NearestPoint near = nearest_point(shape, x, plane);
      CHECK((near.at + near.distance * near.out - x).norm() < 1e-13);
      CHECK(near.out.norm() == Approx(1).epsilon(1e-14));
      double inside = -1e300;  // the highest face under x
      for (std::size_t f = 0; f < shape.faces.size(); ++f) {
        const FaceGeometry g = face_geometry(shape.face(f), plane, 1.0);
        inside = std::max(inside, g.normal.dot(x - g.centre));
        CHECK(g.normal.dot(near.at - g.centre) < 1e-13);  // the point lies in the body
      }
      CHECK((near.distance > 0) == (inside > 0));
      // In a convex body that and this is enough: no other point of it is nearer.
      for (const Vec3& corner : shape.corners) CHECK(near.out.dot(corner - near.at) * (near.distance > 0) < 1e-13);
      if (inside <= 0) CHECK(near.distance == Approx(inside).margin(1e-13));
    }
  };
  check(polygon_block({{-1, -0.5, 0}, {0.8, -0.7, 0}, {0.9, 0.4, 0}, {-0.2, 1, 0}}), true);
  check(brick_block(Vec3(-0.5, -0.6, -0.7), Vec3(0.5, 0.4, 0.3), false), false);
}

namespace {

/// A ball of radius 1 at rest on a slab, in gravity that is inclined by an angle.
std::shared_ptr<BlocksSpec> ball_on_slab(bool plane, const std::string& friction) {
  auto spec = std::make_shared<BlocksSpec>();
  BlockGroup slab, ball;
  slab.shape = BlockGroup::Shape::brick;
  slab.low = Vec3(-5, -1, plane ? 0 : -5), slab.high = Vec3(50, 0, plane ? 0 : 5), slab.density = 1000;
  ball.shape = BlockGroup::Shape::ball;
  ball.points = {Vec3(0, 1, 0)}, ball.radius = 1, ball.density = 1000;
  spec->groups = {slab, ball};
  spec->laws.initial = spec->laws.later = joint_law("SpringNetwork", {{"kn", "1e9"},
                                                                      {"ks", "1e9"},
                                                                      {"krot", "0 0 0"},
                                                                      {"fric", friction},
                                                                      {"dp_nratio", "0.3"},
                                                                      {"dp_sratio", "0.3"},
                                                                      {"dp_mode", "3"}});
  BlockHold hold;
  hold.where = plane ? around(-60, 60, -1, -0.1) : box(Vec3(-60, -1, -60), Vec3(60, -0.1, 60));
  hold.velocity = {constant(0), constant(0), constant(0)}, hold.spin = {constant(0), constant(0), constant(0)};
  if (plane) hold.velocity[2].reset(), hold.spin[0].reset(), hold.spin[1].reset();
  spec->holds.push_back(hold);
  return spec;
}

}  // namespace

TEST_CASE("a ball rolls down a slab, and slides where friction is too little", "[blocks]") {
  // On 30 degrees it rolls with g sin/(1 + I/(m r^2)) if mu is at least tan(30)/(1 + m r^2/I).
  const double angle = std::numbers::pi / 6, g = 10;
  const Vec3 gravity(g * std::sin(angle), -g * std::cos(angle), 0);
  for (const bool plane : {true, false})
    for (const bool slides : {false, true}) {
      INFO((plane ? "disc" : "ball") << (slides ? ", slides" : ", rolls"));
      Assembly blocks(ball_on_slab(plane, slides ? "0.08" : "0.8"), plane ? 2 : 3, false, gravity, 1e-3);
      const double dt = blocks.critical_step();
      while (blocks.time < 0.5) blocks.advance(dt);
      const double begin = blocks.time, v = blocks.motion[1].v[0], w = blocks.motion[1].w[2];
      while (blocks.time < 1.5) blocks.advance(dt);
      const double span = blocks.time - begin;
      const double inertia = plane ? 0.5 : 0.4;
      const double mu = 0.08;
      const double exact = slides ? g * (std::sin(angle) - mu * std::cos(angle)) : g * std::sin(angle) / (1 + inertia);
      const double turns = slides ? mu * g * std::cos(angle) / inertia : exact;
      CHECK((blocks.motion[1].v[0] - v) / span == Approx(exact).epsilon(1e-3));
      CHECK((blocks.motion[1].w[2] - w) / span == Approx(-turns).epsilon(1e-3));
      CHECK(std::abs(blocks.motion[1].v[2]) < 1e-9);
    }
}

TEST_CASE("balls that are apart are bonded and press within the gaps of their law", "[blocks]") {
  const auto pair_of_balls = [](double gap, const Properties& properties, bool touch = false) {
    auto spec = std::make_shared<BlocksSpec>();
    BlockGroup ball;
    ball.shape = BlockGroup::Shape::ball, ball.radius = 1, ball.density = 1000;
    for (const double x : {0.0, 2 + gap}) ball.points = {Vec3(x, 0, 0)}, spec->groups.push_back(ball);
    (touch ? spec->laws.later : spec->laws.initial) =
        joint_law("SpringNetwork", Properties{{"kn", "1e8"}, {"ks", "1e8"}} + properties);
    return Assembly(spec, 2, false, Vec3::Zero(), 1e-3);
  };
  const Properties bonded{{"bond", "gap 1e-2"}, {"sn_ten", "1e30"}, {"sn_coh", "1e30"}};
  CHECK(pair_of_balls(2e-2, bonded).contacts.empty());
  Assembly bond = pair_of_balls(1e-3, bonded);
  REQUIRE(bond.bonds() == 1);
  bond.motion[1].v = Vec3(1, 0, 0);
  const double dt = bond.critical_step();
  bond.advance(dt);
  CHECK(bond.joints[0].Fn == Approx(2e8 * dt).epsilon(1e-12));

  // without a bond they press from the gap rgap on
  for (const bool touch : {false, true}) {
    INFO((touch ? "found during the run" : "from the start"));
    CHECK(pair_of_balls(0.8, {{"rgap", "0.3"}}, touch).contacts.empty());
    Assembly near = pair_of_balls(0.25, {{"rgap", "0.3"}}, touch);
    REQUIRE(near.contacts.size() == 1);
    near.advance(1e-9);
    CHECK(near.joints[0].Fn == Approx(2e8 * (0.25 - 0.3)).epsilon(1e-9));
  }
}
