// SPDX-License-Identifier: MIT
/// Rigid blocks among the matter in a grid.

#include <catch2/catch.hpp>

#include "base/parallel.hpp"
#include "blocks/assembly.hpp"
#include "input/read.hpp"
#include "run/restart.hpp"
#include "solver/build.hpp"
#include "solver/measures.hpp"
#include "solver/rigid/block_points.hpp"

#include <filesystem>
#include <numbers>

using namespace tribo;

namespace {

/// A free elastic cube between -1 and 1 in a box, with the given blocks.
std::string floating(int dimension, const std::string& block, const std::string& friction = "0.4",
                     const std::string& transfer = "type='APIC'", const std::string& impulses = "nodes") {
  const std::string z = dimension == 3 ? " zmin='-4' zmax='4'" : "",
                    depth = dimension == 3 ? "<Depth cellsize='0.25'/>" : "";
  const std::string solid = dimension == 3 ? "<Box xmin='-1' xmax='1' ymin='-1' ymax='1' zmin='-1' zmax='1'/>"
                                           : "<Rect xmin='-1' xmax='1' ymin='-1' ymax='1'/>";
  return "<JANFEAInput version='3'><Header><Analysis>" + std::string(dimension == 3 ? "12" : "10") +
         "</Analysis><ConsistentUnits length='m' mass='kg' time='s'/></Header>"
         "<MPMHeader><MPMMethod>USL</MPMMethod><SkipPostExtrapolation/><GIMP type='quadratic'/><Transfer " +
         transfer +
         "/>"
         "<TimeFactor>0.3</TimeFactor><MaxTime>1</MaxTime><ArchiveTime>1</ArchiveTime>"
         "<MultiMaterialMode Impulses='" +
         impulses +
         "'><Friction lawname='law'/></MultiMaterialMode></MPMHeader>"
         "<Mesh><Grid xmin='-4' xmax='4' ymin='-4' ymax='4'" +
         z + "><Horiz cellsize='0.25'/><Vert cellsize='0.25'/>" + depth +
         "</Grid></Mesh><MaterialPoints><Body matname='soft'>" + solid +
         "</Body></MaterialPoints>"
         "<Blocks lawname='joint'>" +
         block +
         "</Blocks>"
         "<Material Type='LinearElastic' Name='soft'><rho>1000</rho><E>1e6</E><nu>0.3</nu></Material>"
         "<Material Type='RigidContact' Name='stone'/>"
         "<Material Type='CoulombFriction' Name='law'><coeff>" +
         friction +
         "</coeff></Material>"
         "<Material Type='SpringNetwork' Name='joint'><kn>1e6</kn><ks>1e6</ks></Material></JANFEAInput>";
}

template <int Dim>
struct BlockRun {
  explicit BlockRun(const std::string& text)
      : model(read_model_text(text, "deck.xml")),
        system(build_system<Dim>(model, place_points(model))),
        stepper(model, system) {}
  Model model;
  System<Dim> system;
  Stepper<Dim> stepper;
  void steps(int count, double dt) {
    for (int k = 0; k < count; ++k) stepper.advance(dt);
  }
};

struct Momentum {
  Vec3 linear = Vec3::Zero(), angular = Vec3::Zero();
};

/// About the origin of space, with the part that APIC's affine velocities carry.
template <int Dim>
Momentum momentum(BlockRun<Dim>& run) {
  Momentum out;
  auto& body = run.system.bodies.front();
  for (std::size_t i = 0; i < body.particles.size(); ++i) {
    const double m = body.particles.mass()[i];
    Vec3 x = Vec3::Zero(), v = Vec3::Zero();
    x.head<Dim>() = body.particles.position(i), v.head<Dim>() = body.particles.velocity(i);
    Mat3 B = Mat3::Zero();
    for (int r = 0; r < Dim; ++r)
      for (int c = 0; c < Dim; ++c) B(r, c) = body.particles[body.affine][static_cast<std::size_t>(Dim * r + c)][i];
    out.linear += m * v;
    out.angular += m * (x.cross(v) + Vec3(B(2, 1) - B(1, 2), B(0, 2) - B(2, 0), B(1, 0) - B(0, 1)));
  }
  const Assembly& blocks = *run.system.blocks;
  for (std::size_t k = 0; k < blocks.block_count(); ++k) {
    const BlockMotion& m = blocks.motion[k];
    const BlockBody& b = blocks.bodies[k];
    const Mat3 axes = m.R * b.axes;
    const Vec3 spin = Dim == 2 ? Vec3(0, 0, b.inertia[2] * m.w[2])
                               : Vec3(axes * b.inertia.cwiseProduct(Vec3(axes.transpose() * m.w)));
    out.linear += b.mass * m.v, out.angular += b.mass * m.x.cross(m.v) + spin;
  }
  return out;
}

const std::string flat_stone =
    "<BoxBlock matname='stone' angle='25' xmin='0.6' xmax='2.1' ymin='0.9' ymax='2' rho='2500' vx='-2' vy='-3' "
    "spinz='1'/>";
const std::string solid_stone =
    "<Ball matname='stone' x='1.2' y='0.6' z='0.5' radius='0.8' rho='2500' vx='-4' vy='-1' vz='-0.5' spinz='1' "
    "spinx='-2'/>";

}  // namespace

TEST_CASE("A block and the matter it hits keep their momentum to round-off, also about a point") {
  const auto collide = [](auto&& run, int steps, double dt) {
    const Momentum before = momentum(run);
    const Vec3 v = run.system.blocks->motion[0].v;
    for (int k = 0; k < steps; ++k) {
      run.steps(1, dt);
      const GridForce& push =
          run.system.blocks->grid_forces[0];  // places on the surface, a cell or two beside the nodes
      const Mat3& s = push.spread;
      const Vec3 turning(s(2, 1) - s(1, 2), s(0, 2) - s(2, 0), s(1, 0) - s(0, 1));
      CHECK((turning - push.moment).norm() <= 2 * run.system.lattice.spacing.maxCoeff() * push.force.norm());
    }
    const Momentum after = momentum(run);
    CHECK((run.system.blocks->motion[0].v - v).norm() > 0.2);  // it did hit
    CHECK((after.linear - before.linear).norm() < 1e-12 * before.linear.norm());
    CHECK((after.angular - before.angular).norm() < 1e-12 * before.linear.norm());
  };
  SECTION("plane") { collide(BlockRun<2>(floating(2, flat_stone)), 200, 5e-4); }
  SECTION("space") { collide(BlockRun<3>(floating(3, solid_stone)), 60, 1e-3); }
}

TEST_CASE(
    "The grid receives the energy that a block loses, and contact accounts for the difference to the explicit work",
    "[energy]") {
  const std::string transfer = GENERATE("type='APIC'", "type='FLIP'", "type='XPIC' order='2'", "type='FMPM' order='2'");
  const std::string impulses = GENERATE("nodes", "faces"), friction = GENERATE("0", "0.4");
  INFO(transfer << ", " << impulses << ", friction " << friction);
  const auto collide = [&](auto&& run, int steps, double dt) {
    const Assembly& blocks = *run.system.blocks;
    const BlockBody& stone = blocks.bodies[0];
    const auto kinetic = [&] {  // of a block without other forces, with equal moments of inertia
      const BlockMotion& m = blocks.motion[0];
      return 0.5 * stone.mass * m.v.squaredNorm() + 0.5 * stone.inertia[2] * m.w.squaredNorm();
    };
    const double first = kinetic();
    double at_start = 0.0, difference = 0.0;  // J v at the velocity before each impulse; J^2/(2 M) + L^2/(2 I)
    for (int k = 0; k < steps; ++k) {
      const BlockMotion before = blocks.motion[0];
      run.steps(1, dt);
      const Vec3 J = dt * blocks.grid_forces[0].force, L = dt * blocks.grid_forces[0].moment;
      at_start -= J.dot(before.v) + L.dot(before.w);
      difference += 0.5 * J.squaredNorm() / stone.mass + 0.5 * L.squaredNorm() / stone.inertia[2];
    }
    const double lost = first - kinetic(), given = run.stepper.contact().ledger().rigid_work;
    CHECK(lost > 0.05 * first);
    CHECK(given == Approx(lost).epsilon(1e-10));
    CHECK(at_start - given == Approx(difference).epsilon(1e-8));
    // Whatever the block does, contact takes up what the grid receives beyond the work at the start.
    auto& ledger = run.stepper.contact().ledger();
    const auto dissipated = [&] { return ledger.total().friction + ledger.total().impact; };
    const double contact_before = dissipated();
    BlockMean mean;
    mean.x = blocks.motion[0].x, mean.v = Vec3(3, -20, 1), mean.w = Vec3(0, 0, 2);
    run.stepper.contact().record_block_motion({mean});
    CHECK(ledger.rigid_work != given);
    CHECK(dissipated() - contact_before == Approx(ledger.rigid_work - given).epsilon(1e-9));
  };
  SECTION("plane") { collide(BlockRun<2>(floating(2, flat_stone, friction, transfer, impulses)), 200, 5e-4); }
  SECTION("space") { collide(BlockRun<3>(floating(3, solid_stone, friction, transfer, impulses)), 60, 1e-3); }
}

TEST_CASE("What blocks do to the grid is the same to the bit for any number of threads, and after a restart") {
  BlockRun<2> run(floating(2, flat_stone)), again(floating(2, flat_stone));
  const auto same = [&] {
    const BlockMotion &a = run.system.blocks->motion[0], &b = again.system.blocks->motion[0];
    return a.x == b.x && a.v == b.v && a.w == b.w && a.R == b.R;
  };
  const int threads_before = threads();
  set_threads(1);
  run.steps(100, 5e-4);
  set_threads(2);
  again.steps(60, 5e-4);
  const auto file = std::filesystem::temp_directory_path() / "tribo_blocks_in_grid.bin";
  write_checkpoint(file, [&](CheckpointWriter& to) { save_state(RunState{}, again.system, again.stepper, to); });
  BlockRun<2> third(floating(2, flat_stone));
  load_state(Checkpoint(file), third.system, third.stepper);
  third.steps(40, 5e-4);
  again.steps(40, 5e-4);
  set_threads(threads_before);
  CHECK(same());
  CHECK(third.system.blocks->motion[0].x == run.system.blocks->motion[0].x);
  CHECK(third.system.blocks->motion[0].w == run.system.blocks->motion[0].w);
  std::filesystem::remove(file);
}

TEST_CASE("A block too light for the matter at its nodes is an error that says why") {
  BlockRun<2> run(floating(
      2, "<BoxBlock matname='stone' name='feather' xmin='-0.5' xmax='0.5' ymin='1' ymax='1.1' rho='20' vy='-1'/>"));
  CHECK_THROWS_WITH(run.steps(20, 5e-4), Catch::Contains("'feather' is too large compared with its own"));
}

// The sum of m (1/M + r^2/I) over its nodes exceeds 2, the largest eigenvalue of their inertia does not.
TEST_CASE("A ball some cells thick sinks into matter in space without an error, and gains no energy") {
  const std::string transfer = GENERATE("type='APIC'", "type='FMPM' order='2'");
  INFO(transfer);
  BlockRun<3> run(
      floating(3, "<Ball matname='stone' x='0' y='1.63' z='0' radius='0.625' rho='1667' vy='-5.5'/>", "0.4", transfer));
  const auto energy = [&] {
    const Measures all = measure(run.system);
    const BlockMotion& m = run.system.blocks->motion[0];
    const BlockBody& ball = run.system.blocks->bodies[0];
    return all.kinetic + all.stored + 0.5 * ball.mass * m.v.squaredNorm() + 0.5 * ball.inertia[0] * m.w.squaredNorm();
  };
  const double first = energy();
  double largest = 0.0;
  for (int k = 0; k < 60; ++k) run.steps(1, 1e-3), largest = std::max(largest, energy());
  CHECK(largest < (1 + 1e-9) * first);
  CHECK(run.system.blocks->motion[0].v[1] > -2.75);  // it was stopped
}

TEST_CASE("The points of a block add up to it and cover its faces") {
  const double cell = 0.1;
  const auto check = [&](const BlockShape& shape, const Vec3& centre, bool plane) {
    const MassProperties m = mass_properties(shape, plane, 1.0);
    BlockShape own = shape;
    for (Vec3& x : own.corners) x -= m.centre;
    const auto seeds = block_points(own, centre, 0, 2.0, plane, 1.0, cell);
    double volume = 0.0, mass = 0.0;
    for (const Seed& s : seeds) volume += s.volume * s.F.determinant(), mass += s.mass;
    CHECK(volume == Approx(m.volume).epsilon(2e-3));
    CHECK(mass == Approx(2 * volume).epsilon(1e-12));
    // The support of the points is that of the block in every direction.
    for (int k = 0; k < 40; ++k) {
      const double a = 0.37 * k, b = plane ? 0.0 : std::asin(std::cos(1.1 * k));
      const Vec3 n(std::cos(b) * std::cos(a), std::cos(b) * std::sin(a), std::sin(b));
      double reach = -1e300, exact = shape.ball() ? shape.radius : -1e300;
      for (const Seed& s : seeds) {
        const Mat3 axes = s.F * s.half_size.asDiagonal();
        Vec3 along = axes.transpose() * n;
        if (plane) along[2] = 0;
        reach = std::max(reach, (s.x - centre).dot(n) + along.lpNorm<1>());
      }
      if (!shape.ball())
        for (const Vec3& x : own.corners) exact = std::max(exact, x.dot(n));
      CHECK(std::abs(reach - exact) < 0.012 * cell);
    }
  };
  check(brick_block(Vec3(0, 0, 0), Vec3(1, 0.52, 0), true), Vec3(3, 4, 0), true);
  check(polygon_block({{0, 0, 0}, {1, 0.1, 0}, {1.1, 0.8, 0}, {0.3, 1, 0}}), Vec3(1, 1, 0), true);
  check(ball_block(Vec3::Zero(), 0.5), Vec3(2, 1, 0), true);
  check(brick_block(Vec3(0, 0, 0), Vec3(0.5, 0.52, 0.3), false), Vec3(1, 2, 3), false);
  check(ball_block(Vec3::Zero(), 0.4), Vec3(1, 2, 3), false);
  std::vector<Vec3> nuclei{{0.2, 0.3, 0.25}, {0.8, 0.7, 0.6}, {0.3, 0.8, 0.8}, {0.7, 0.2, 0.7}, {0.5, 0.5, 0.2}};
  const auto cells = voronoi(nuclei, Vec3::Zero(), Vec3::Ones(), false, 1.0);
  for (const BlockShape& shape : cells.shapes) check(shape, Vec3(1, 1, 1), false);
}
