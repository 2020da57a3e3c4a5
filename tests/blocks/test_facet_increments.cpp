// SPDX-License-Identifier: MIT
#include "block_cases.hpp"
#include "blocks/facet_increments.hpp"
#include "blocks/kinematics.hpp"

#include <catch2/catch.hpp>

#include <random>

using namespace tribo;
using namespace tribo::test;

namespace {

// The increment of one facet by the formulas of kinematics.hpp.
JointIncrement reference(const Assembly& blocks, std::size_t k, double dt, BlockContact& c, Vec3& at) {
  c = blocks.contacts[k];
  const BlockMotion &a = blocks.motion[c.a], &b = blocks.motion[c.b];
  const Vec3 shift = blocks.shift[k], speed = blocks.box_rate * shift;
  const ContactFrame before{c.axes, blocks.contact_forces[k].at};
  const Vec3 pa = a.x + a.R * c.pa, pb = b.x + shift + b.R * c.pb;
  const Vec3 n = ((1 - c.on_a) * (a.R * c.na) + c.on_a * (b.R * c.nb)).normalized();
  at = c.on_a * pa + (1 - c.on_a) * pb;
  c.axes = carried<false>(c.axes, n, a, b, dt);
  JointIncrement d;
  count_increment<false>(a, b, shift, speed, before, {c.axes, at}, dt, d);
  d.gap = (pb - pa).dot(n);
  return d;
}

}  // namespace

TEST_CASE("facets in space follow their blocks four at a time as one by one", "[blocks]") {
  const Vec3 low = Vec3::Zero(), high = Vec3::Ones();
  const auto nuclei = scattered(20, high, false, 0.2);
  Assembly blocks(voronoi(nuclei, low, high, false, 1.0, {true, true, true}), nuclei, elastic_bonds(1e9, 0), false,
                  false, 1.0, 0);
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  const auto vector = [&] { return Vec3(normal(random), normal(random), normal(random)); };
  for (std::size_t k = 4; k < blocks.block_count(); ++k) {  // the first ones rest
    BlockMotion& m = blocks.motion[k];
    m.x += 0.01 * vector(), m.v = vector(), m.w = vector();
    m.R = Eigen::AngleAxisd(0.1 * normal(random), vector().normalized()).toRotationMatrix();
  }
  blocks.box_rate = 0.1 * Mat3(Mat3::Random());
  const double dt = 0.01;
  BlockContact moved;
  Vec3 place;
  reference(blocks, 7, dt, moved, place);
  blocks.contacts[7].axes = JointAxes::of_normal(-moved.axes.n);  // reversed in one step
  const std::size_t begin = 2, end = blocks.contacts.size() - 1;
  std::vector<JointIncrement> expected(end), found(end);
  std::vector<BlockContact> contacts(end);
  std::vector<Vec3> places(end);
  for (std::size_t k = begin; k < end; ++k) expected[k] = reference(blocks, k, dt, contacts[k], places[k]);
  const JointAxes before = blocks.contacts[0].axes, after = blocks.contacts[end].axes;
  facet_increments(blocks, begin, end, dt, found.data() + begin);
  double worst = 0.0;
  for (std::size_t k = begin; k < end; ++k) {
    const JointIncrement &d = found[k], &e = expected[k];
    const JointAxes &axes = blocks.contacts[k].axes, &wanted = contacts[k].axes;
    for (const double error :
         {d.normal - e.normal, d.shear.s - e.shear.s, d.shear.t - e.shear.t, d.twist - e.twist, d.bend.s - e.bend.s,
          d.bend.t - e.bend.t, d.gap - e.gap, (axes.n - wanted.n).norm(), (axes.s - wanted.s).norm(),
          (axes.t - wanted.t).norm(), (blocks.contact_forces[k].at - places[k]).norm()})
      worst = std::max(worst, std::abs(error));
    CHECK(d.dt == dt);
    CHECK(d.mass == contacts[k].mass);
  }
  CHECK(worst < 1e-13);
  CHECK(blocks.contacts[0].axes.n == before.n);
  CHECK(blocks.contacts[end].axes.n == after.n);
}
