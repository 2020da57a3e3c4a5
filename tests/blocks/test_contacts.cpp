/// Contacts that come about while blocks move.

#include "blocks/block_cases.hpp"

#include <catch2/catch.hpp>

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
    spec->touch = rubbing("0", "0");
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
  spec->touch = rubbing("0.5", "0.5");
  Assembly body(spec, 2, true, Vec3(0, -10, 0), 1.0);
  const double dt = body.critical_step();
  for (int k = 0; k * dt < 2; ++k) body.advance(dt), body.check_contacts();
  CHECK(body.motion[1].x[1] - 0.5 == Approx(-2000 * 10 / 1e8).epsilon(1e-3));
  CHECK(std::abs(body.turned(1)[2]) < 1e-6);
  const BlockLedger l = body.ledger();
  CHECK(std::abs(l.content()) < 1e-3 * l.dashpot);
}

TEST_CASE("a block slides from one block to the next", "[blocks]") {
  auto spec = std::make_shared<BlocksSpec>();
  spec->groups = {brick({0, -1, 0}, {2, 0, 0}), brick({2, -1, 0}, {4, 0, 0}),
                  brick({0.5, 0, 0}, {1.5, 1, 0}, {3, 0, 0})};
  spec->holds = {standing(0, 4, -1, -0.1)};
  spec->law = spec->touch = rubbing("0.3", "0.3");
  Assembly body(spec, 2, true, Vec3(0, -10, 0), 1.0);
  const double dt = body.critical_step();
  for (int k = 0; k * dt < 1.5; ++k) body.advance(dt), body.check_contacts();
  CHECK(body.motion[2].x[0] - 1.0 == Approx(9 / (2 * 0.3 * 10)).epsilon(0.03));
  CHECK(body.motion[2].v.norm() < 1e-2);
}
