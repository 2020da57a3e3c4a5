// SPDX-License-Identifier: MIT
/// The region that two blocks share: closed forms, and forces against the gradient of the energy.

#include "blocks/placed_cases.hpp"
#include "blocks/shared_region.hpp"

#include <catch2/catch.hpp>

#include <optional>

using namespace tribo;
using namespace tribo::test;

namespace {

/// Sums over the parts, on b; the moment is about the origin.
struct Action {
  Vec3 force = Vec3::Zero(), moment = Vec3::Zero();
  double energy = 0, area = 0;
};

Action action_of(const SharedRegion& region, bool plane) {
  std::array<SharedPart, 4> parts;
  region.share(JointAxes::of_normal(region.normal()), {parts.data(), shared_parts(plane)});
  Action out;
  for (std::size_t k = 0; k < shared_parts(plane); ++k) {
    const SharedPart& p = parts[k];
    const Vec3 force = p.area * p.depth * p.n;
    out.force += force, out.moment += p.at.cross(force) + p.couple * force;
    out.energy += 0.5 * p.area * p.depth * p.depth, out.area += p.area;
  }
  return out;
}

struct Found {
  SharedRegion region;
  bool found = false;
  Found(const PlacedBlock& a, const PlacedBlock& b, bool plane) {
    const BlockGap apart = separation(a, b, plane, 1e300);
    found = apart.gap < 0 && region.find(a, b, apart.n, plane);
  }
};

}  // namespace

TEST_CASE("a flat overlap acts as springs that are spread over it", "[blocks]") {
  for (const bool plane : {true, false}) {
    const Placed a(brick_block({-2, -2, -2}, {0, 2, 2}, plane), Vec3::Zero(), Mat3::Identity(), plane),
        b(cube(0.5, plane), Vec3(0.4, 0.2, plane ? 0 : -0.3), Mat3::Identity(), plane);
    const Found pair(a.block, b.block, plane);
    REQUIRE(pair.found);
    CHECK(pair.region.volume() == Approx(0.1));
    CHECK(pair.region.energy() == Approx(0.1 * 0.1 / 2));
    const Action on_b = action_of(pair.region, plane);
    CHECK((on_b.force - Vec3(0.1, 0, 0)).norm() < 1e-14);
    CHECK(on_b.area == Approx(1));
    CHECK(on_b.energy == Approx(0.1 * 0.1 / 2));
    CHECK((on_b.moment - Vec3(-0.05, 0.2, plane ? 0 : -0.3).cross(on_b.force)).norm() < 1e-14);
  }
}

TEST_CASE("a block that juts out is pushed off the edge by the energy that it loses there", "[blocks]") {
  for (const bool plane : {true, false}) {
    const Placed a(cube(0.5, plane), Vec3::Zero(), Mat3::Identity(), plane),
        b(cube(0.5, plane), Vec3(0.9, 0.2, 0), Mat3::Identity(), plane);
    const Found pair(a.block, b.block, plane);
    REQUIRE(pair.found);
    CHECK(pair.region.energy() == Approx(0.8 * 0.1 * 0.1 / 2));
    CHECK((action_of(pair.region, plane).force - Vec3(0.08, 0.1 * 0.1 / 2, 0)).norm() < 1e-14);
  }
}

TEST_CASE("a corner in a face has the energy of a wedge", "[blocks]") {
  const double d = 0.1;
  const Placed ground(brick_block({-2, -1, 0}, {2, 0, 0}, true), Vec3::Zero(), Mat3::Identity(), true),
      wedge(cube(0.5, true), Vec3(0.3, std::sqrt(0.5) - d, 0), turned(M_PI / 4, Vec3::UnitZ()), true);
  const Found in_plane(ground.block, wedge.block, true);
  REQUIRE(in_plane.found);
  CHECK(in_plane.region.energy() == Approx(d * d * d / 3));
  const Action up = action_of(in_plane.region, true);
  CHECK((up.force - Vec3(0, d * d, 0)).norm() < 1e-14);
  CHECK(up.moment[2] == Approx(0.3 * d * d));

  const Vec3 diagonal = Vec3::Ones().normalized();
  const Mat3 R = Eigen::Quaterniond::FromTwoVectors(diagonal, -Vec3::UnitZ()).toRotationMatrix();
  const Placed floor(brick_block({-2, -2, -1}, {2, 2, 0}, false), Vec3::Zero(), Mat3::Identity(), false),
      corner(cube(0.5, false), Vec3(0.1, 0.2, std::sqrt(0.75) - d), R, false);
  const Found in_space(floor.block, corner.block, false);
  REQUIRE(in_space.found);
  const double volume = std::sqrt(3) / 2 * d * d * d;
  CHECK(in_space.region.volume() == Approx(volume));
  CHECK(in_space.region.energy() == Approx(volume * d / 4));
  CHECK((in_space.region.centre() - Vec3(0.1, 0.2, -d / 4)).norm() < 1e-12);
  const Action lift = action_of(in_space.region, false);
  CHECK((lift.force - volume * Vec3::UnitZ()).norm() < 1e-14);
  CHECK((lift.moment - volume * Vec3(0.2, -0.1, 0)).norm() < 1e-14);
}

TEST_CASE("force and moment of an overlap are the gradient of its energy", "[blocks]") {
  std::mt19937 random(11);
  const auto number = [&] { return static_cast<double>(random()) / 4294967296.0 - 0.5; };
  for (const bool plane : {true, false}) {
    const auto vector = [&] { return Vec3(number(), number(), plane ? 0 : number()); };
    const auto axis = [&] { return plane ? Vec3(Vec3::UnitZ()) : vector(); };
    const auto shape = brick_block({-0.5, -0.3, -0.4}, {0.5, 0.3, 0.4}, plane);
    int checked = 0, pushed = 0;
    for (int pair = 0; pair < 300; ++pair) {
      const Mat3 Ra = turned(6 * number(), axis()), Rb = turned(6 * number(), axis());
      const Vec3 xb = 1.8 * vector();
      const Placed a(shape, Vec3::Zero(), Ra, plane);
      std::size_t face = 0;
      const auto energy = [&](const Vec3& shift, const Vec3& turn) -> std::optional<double> {
        const Mat3 R = turn.isZero(0.0) ? Mat3::Identity() : turned(turn.norm(), turn);
        const Placed b(shape, shift + R * xb, R * Rb, plane);
        const Found at(a.block, b.block, plane);
        if (!at.found || at.region.face() != face) return std::nullopt;
        return at.region.energy();
      };
      const Placed b(shape, xb, Rb, plane);
      const Found here(a.block, b.block, plane);
      if (!here.found || here.region.volume() < 1e-3) continue;
      face = here.region.face();
      const Action on_b = action_of(here.region, plane);
      CHECK(on_b.energy == Approx(here.region.energy()));
      Vec3 force = Vec3::Zero(), moment = Vec3::Zero();
      bool smooth = true;
      const double h = 1e-6;
      for (int d = 0; d < 3; ++d) {
        const auto slope = [&](const Vec3& by, bool turn) {
          const auto more = energy(turn ? Vec3(Vec3::Zero()) : by, turn ? by : Vec3(Vec3::Zero())),
                     less = energy(turn ? Vec3(Vec3::Zero()) : Vec3(-by), turn ? Vec3(-by) : Vec3(Vec3::Zero()));
          smooth = smooth && more && less;
          return smooth ? (*more - *less) / (2 * h) : 0.0;
        };
        if (!plane || d < 2) force[d] = -slope(h * Vec3::Unit(d), false);
        if (!plane || d == 2) moment[d] = -slope(h * Vec3::Unit(d), true);
      }
      if (!smooth) continue;
      INFO((plane ? "plane " : "space ") << pair);
      CHECK((on_b.force - force).norm() < 1e-6);
      CHECK((on_b.moment - moment).norm() < 1e-6);
      ++checked, pushed += on_b.force.normalized().dot(here.region.normal()) < 0.999 ? 1 : 0;
    }
    CHECK(checked > 50);
    CHECK(pushed > 20);
  }
}

TEST_CASE("a face that is set back shares less", "[blocks]") {
  for (const bool plane : {true, false})
    for (const bool of_a : {true, false}) {
      Placed a(brick_block({-2, -2, -2}, {0, 2, 2}, plane), Vec3::Zero(), Mat3::Identity(), plane),
          b(cube(0.5, plane), Vec3(0.4, 0.2, 0), Mat3::Identity(), plane);
      PlacedBlock& block = of_a ? a.block : b.block;
      std::size_t face = 0;
      while (block.normals[face][0] * (of_a ? 1 : -1) < 0.5) ++face;
      block.set_back(face, 0.04);
      const Found pair(a.block, b.block, plane);
      REQUIRE(pair.found);
      CHECK(pair.region.energy() == Approx(0.06 * 0.06 / 2));
      CHECK((action_of(pair.region, plane).force - Vec3(0.06, 0, 0)).norm() < 1e-14);
      block.set_back(face, 0.07);
      CHECK_FALSE(Found(a.block, b.block, plane).found);
    }
}

TEST_CASE("a block that counts as larger shares more", "[blocks]") {
  for (const bool plane : {true, false})
    for (const double x : {0.4, 0.52}) {
      Placed a(brick_block({-2, -2, -2}, {0, 2, 2}, plane), Vec3::Zero(), Mat3::Identity(), plane),
          b(cube(0.5, plane), Vec3(x, 0.2, 0), Mat3::Identity(), plane);
      a.block.grown = 0.05;
      SharedRegion region;
      REQUIRE(region.find(a.block, b.block, Vec3::UnitX(), plane));
      const double depth = 0.5 - x + 0.05;
      CHECK(region.energy() == Approx(depth * depth / 2));
      CHECK((action_of(region, plane).force - Vec3(depth, 0, 0)).norm() < 1e-14);
    }
}
