// SPDX-License-Identifier: MIT
/// Blocks that tip, rock and collide with their corners keep their energy.

#include "archived.hpp"
#include "blocks/assembly.hpp"
#include "input/read.hpp"
#include "run/block_run.hpp"

#include <catch2/catch.hpp>

#include <cmath>

using namespace tribo;
using namespace tribo::test;

namespace {

constexpr const char* held_floor =
    "<BoxBlock xmin='-4' xmax='6' ymin='-1' ymax='0' rho='2000'/>"
    "<Hold vx='0' vy='0' spinz='0'><Rect xmin='-4' xmax='6' ymin='-1' ymax='-0.1'/></Hold>";

Model bricks(const std::string& blocks, const char* gravity, const char* friction = "0") {
  return read_model_text(R"(<JANFEAInput version='3'>
  <Header><Analysis>10</Analysis><ConsistentUnits length='m' mass='kg' time='s'/></Header>
  <MPMHeader><MaxTime>1</MaxTime><ArchiveTime>1</ArchiveTime></MPMHeader>
  <Blocks lawname='rub' touchname='rub'>)" +
                             blocks + R"(</Blocks>
  <Material Type='SpringNetwork' Name='rub'><kn>1e8</kn><ks>1e8</ks><fric>)" +
                             friction + "</fric></Material><Gravity><BodyYForce>" + gravity +
                             "</BodyYForce></Gravity></JANFEAInput>",
                         "bricks.xml");
}

/// What a motion does to kinetic + potential + stored energy, over the largest kinetic energy.
struct Energies {
  double gain = 0.0, loss = 0.0, at_end = 0.0;
  int bounces = 0;
};

Energies follow(const Model& model, double end, double step) {
  Assembly blocks = assemble(model);
  const double dt = step * blocks.critical_step();
  const auto all = [&] {
    const BlockLedger l = blocks.ledger();
    return l.kinetic + l.potential + l.strain - l.stepping;
  };
  const double start = all();
  double most = 0.0, largest = 0.0;
  Energies out;
  bool touches = false;
  while (blocks.time < end) {
    blocks.advance(dt);
    const double change = all() - start;
    largest = std::max(largest, blocks.ledger().kinetic);
    out.gain = std::max(out.gain, change), out.loss = std::max(out.loss, -change), most = change;
    const bool now = blocks.active() > 0;
    out.bounces += now && !touches ? 1 : 0, touches = now;
  }
  out.gain /= largest, out.loss /= largest, out.at_end = most / largest;
  return out;
}

}  // namespace

TEST_CASE("a brick that rocks without friction keeps its energy", "[blocks][energy]") {
  const Model model = bricks(
      std::string(held_floor) + "<BoxBlock xmin='0' xmax='1' ymin='0.1' ymax='2.1' rho='2000' angle='5'/>", "-10");
  const Energies coarse = follow(model, 3, 0.4), fine = follow(model, 3, 0.1);
  CHECK(coarse.bounces > 4);
  CHECK(std::max(fine.gain, fine.loss) < 1e-3);
  CHECK(std::max(fine.gain, fine.loss) < 0.25 * std::max(coarse.gain, coarse.loss));
}

TEST_CASE("a brick that falls on its corner rebounds as fast as it came", "[blocks][energy]") {
  const Model model = bricks(
      std::string(held_floor) + "<BoxBlock xmin='0' xmax='1' ymin='0.5' ymax='1.5' rho='2000' angle='45' vy='-2'/>",
      "0");
  Assembly blocks = assemble(model);
  const double dt = 0.25 * blocks.critical_step();
  bool touched = false;
  while (blocks.time < 0.6) {
    blocks.advance(dt);
    touched |= blocks.active() > 0;
    if (!touched) continue;
    const BlockLedger l = blocks.ledger();
    CHECK(l.kinetic + l.strain == Approx(4000).epsilon(1e-3));
  }
  REQUIRE(touched);
  CHECK(blocks.motion[1].v[1] == Approx(2).epsilon(1e-3));
  CHECK(std::abs(blocks.motion[1].w[2]) < 1e-9);
}

// Their faces change during the collision; the force along the face of least overlap created 10 % here.
TEST_CASE("bricks that collide with their corners keep energy and momentum", "[blocks][energy]") {
  for (const bool spins : {false, true}) {
    const Model model = bricks(
        "<BoxBlock xmin='0' xmax='1' ymin='0' ymax='1' rho='2000' vx='3' vy='2'/>"
        "<BoxBlock xmin='1.05' xmax='2.05' ymin='0.97' ymax='1.97' rho='2000' vx='-3' vy='-2' angle='3' spinz='" +
            std::string(spins ? "2" : "0") + "'/>",
        "0");
    const Energies coarse = follow(model, 0.2, 0.5), fine = follow(model, 0.2, 0.05);
    CHECK(coarse.bounces > 0);
    // of first order in the step, as the force jumps where the face changes
    CHECK(std::abs(coarse.at_end) < 1e-2);
    CHECK(std::abs(fine.at_end) < 1e-3);
    Assembly blocks = assemble(model);
    const Vec3 before = blocks.motion[0].v + blocks.motion[1].v;
    while (blocks.time < 0.2) blocks.advance(blocks.critical_step());
    CHECK((blocks.motion[0].v + blocks.motion[1].v - before).norm() < 1e-12);
    CHECK((blocks.motion[0].v - Vec3(3, 2, 0)).norm() > 0.5);
  }
}

TEST_CASE("a brick that lands on the edge of another one keeps its energy", "[blocks][energy]") {
  const Model model = bricks(
      "<BoxBlock xmin='-2' xmax='0' ymin='-1' ymax='0' rho='2000'/>"
      "<BoxBlock xmin='-0.25' xmax='0.75' ymin='0.1' ymax='1.1' rho='2000' vx='1' vy='-3'/>"
      "<Hold vx='0' vy='0' spinz='0'><Rect xmin='-4' xmax='6' ymin='-1' ymax='-0.1'/></Hold>",
      "0");
  CHECK(std::abs(follow(model, 0.5, 0.5).at_end) < 2e-3);
  CHECK(std::abs(follow(model, 0.5, 0.05).at_end) < 1e-4);
}

TEST_CASE("cubes that collide and spin in space keep energy and momentum", "[blocks][energy]") {
  for (const auto& [beside, pressing_gap] :
       {std::pair(0.2, 0.0), std::pair(0.55, 0.0), std::pair(0.8, 0.0), std::pair(0.55, 0.01)}) {
    const Model model = read_model_text(
        R"(<JANFEAInput version='3'>
  <Header><Analysis>12</Analysis><ConsistentUnits length='m' mass='kg' time='s'/></Header>
  <MPMHeader><MaxTime>1</MaxTime><ArchiveTime>1</ArchiveTime></MPMHeader>
  <Blocks lawname='rub' touchname='rub'>
    <BoxBlock xmin='0' xmax='1' ymin='0' ymax='1' zmin='0' zmax='1' rho='2000' vx='3' spinx='3' spiny='-2' angle='10'/>
    <BoxBlock xmin='1.8' xmax='2.7' ymin=')" +
            std::to_string(beside) + "' ymax='" + std::to_string(beside + 0.9) +
            R"(' zmin='0.3' zmax='1.2' rho='2000' vx='-2' spinx='-1' spinz='4'/>
  </Blocks>
  <Material Type='SpringNetwork' Name='rub'><kn>1e8</kn><ks>1e8</ks><fric>0</fric><rgap>)" +
            std::to_string(pressing_gap) + R"(</rgap></Material>
</JANFEAInput>)",
        "boxes.xml");
    INFO("beside " << beside << ", pressing from a gap of " << pressing_gap);
    const Energies coarse = follow(model, 0.4, 0.5), fine = follow(model, 0.4, 0.05);
    CHECK(coarse.bounces > 0);
    CHECK(std::abs(coarse.at_end) < 2e-3);
    CHECK(std::abs(fine.at_end) < 1e-4);
    Assembly blocks = assemble(model);
    const auto momentum = [&] {
      Vec3 p = Vec3::Zero(), turning = Vec3::Zero();
      for (int k = 0; k < 2; ++k) {
        const BlockBody& body = blocks.bodies[k];
        const BlockMotion& m = blocks.motion[k];
        const Mat3 axes = m.R * body.axes;
        p += body.mass * m.v;
        turning += body.mass * m.x.cross(m.v) + axes * body.inertia.asDiagonal() * axes.transpose() * m.w;
      }
      return std::pair(p, turning);
    };
    const auto before = momentum();
    const Vec3 v = blocks.motion[0].v;
    while (blocks.time < 0.4) blocks.advance(0.1 * blocks.critical_step());
    CHECK((momentum().first - before.first).norm() < 1e-9);
    CHECK((momentum().second - before.second).norm() < 1e-8);
    CHECK((blocks.motion[0].v - v).norm() > 0.1);
  }
}

namespace {

// Faces that turn are replaced by overlaps here, blocks slide along edges, and corners come into contact with corners.
Model pile() {
  return bricks(std::string(held_floor) +
                    "<BoxBlock xmin='0' xmax='1' ymin='0' ymax='1' rho='2000'/>"
                    "<BoxBlock xmin='0' xmax='1' ymin='1' ymax='2' rho='2000'/>"
                    "<BoxBlock xmin='0.3' xmax='1.6' ymin='2' ymax='3' rho='2000'/>"
                    "<BoxBlock xmin='0.9' xmax='1.9' ymin='3' ymax='4' rho='2000'/>",
                "-10", "0.3");
}

}  // namespace

TEST_CASE("a pile of bricks that topples gains nothing", "[blocks][energy]") {
  const Model model = pile();
  for (const double step : {1.0, 0.2}) {
    Assembly blocks = assemble(model);
    double worst = 0.0, residual = 0.0, supplied = 0.0;
    const double start = blocks.ledger().content(), dt = step * blocks.critical_step();
    while (blocks.time < 2) {
      blocks.advance(dt);
      const BlockLedger l = blocks.ledger();
      worst = std::max(worst, -l.released), supplied = std::max(supplied, -l.potential);
      residual = std::max(residual, std::abs(l.content() - start));
    }
    CHECK(supplied > 5e4);
    CHECK(worst < 1e-3 * supplied);
    CHECK(residual < 1e-3 * supplied);
  }
}

TEST_CASE("faces that are set back are kept over a restart", "[blocks][energy]") {
  const Model model = pile();
  Assembly blocks = assemble(model);
  const double dt = blocks.critical_step();
  const auto set_back = [&] {
    for (const BlockContact& c : blocks.contacts)
      if (c.set_back > 0) return true;
    return false;
  };
  while (blocks.time < 1 && !set_back()) blocks.advance(dt);
  REQUIRE(set_back());
  const ArchivedState saved = archived(blocks);
  for (int k = 0; k < 200; ++k) blocks.advance(dt);
  Assembly again = assemble(model);
  restore(saved, again);
  for (int k = 0; k < 200; ++k) again.advance(dt);
  CHECK(differences(archived(blocks), archived(again)).empty());
}
