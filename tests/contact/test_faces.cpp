// SPDX-License-Identifier: MIT
#include "solver/contact/face_geometry.hpp"
#include "solver/contact/near_particles.hpp"

#include <Eigen/Geometry>
#include <catch2/catch.hpp>
#include <random>

using namespace tribo;

namespace {

/// Particles of size h/2 in a block [from, to] turned about the origin, within `reach` of it.
ParticleSet<2> block(double angle, const Vec<2>& from, const Vec<2>& to, double reach = 2.5) {
  ParticleSet<2> side;
  const Mat<2> turn = Eigen::Rotation2Dd(angle).toRotationMatrix();
  for (double x = from[0] + 0.25; x < to[0]; x += 0.5)
    for (double y = from[1] + 0.25; y < to[1]; y += 0.5)
      if (Vec<2>(x, y).norm() <= reach) side.add(turn * Vec<2>(x, y), turn * (0.25 * Mat<2>::Identity()));
  return side;
}

ParticleSet<3> box(const Mat<3>& turn, const Vec<3>& from, const Vec<3>& to) {
  ParticleSet<3> side;
  for (double x = from[0] + 0.25; x < to[0]; x += 0.5)
    for (double y = from[1] + 0.25; y < to[1]; y += 0.5)
      for (double z = from[2] + 0.25; z < to[2]; z += 0.5)
        if (Vec<3>(x, y, z).norm() <= 2.5) side.add(turn * Vec<3>(x, y, z), turn * (0.25 * Mat<3>::Identity()));
  return side;
}

}  // namespace

TEST_CASE("the margin normal of flat faces is exact at any angle, also at ends and corners", "[contact]") {
  for (const double angle : {0.0, 0.3, 0.785, 2.1})
    for (const double end : {-1.3, 0.0, 0.4, 3.0})
      for (const double gap : {0.0, 1e-3, 0.3, -0.05}) {
        auto a = block(angle, {-3, -3}, {3, 0}), b = block(angle, {end - 3, gap}, {end, 3});
        const Vec<2> up(-std::sin(angle), std::cos(angle));
        const auto n = margin_normal<2>(a, b, Vec<2>(0.3, 1).normalized(), 1.0);
        REQUIRE(n);
        CHECK((*n - up).norm() < 1e-7);
        // exact up to the reach of the ball: the face of b ends at the end of its particles
        const double measured = -face_position<2>(b, -*n, 0.75) - face_position<2>(a, *n, 0.75);
        CHECK(measured == Approx(gap).margin(1e-6));
      }
}

TEST_CASE("the margin normal is exact in three dimensions", "[contact]") {
  const Mat<3> turn =
      (Eigen::AngleAxisd(0.4, Vec<3>(1, 2, -1).normalized()) * Eigen::AngleAxisd(1.1, Vec<3>::UnitZ())).matrix();
  for (const double end : {0.0, 0.4, 3.0}) {
    auto a = box(turn, {-3, -3, -3}, {3, 3, 0}), b = box(turn, {-3, -3, 0.01}, {3, end, 3});
    const auto n = margin_normal<3>(a, b, Vec<3>::UnitX(), 1.0);
    REQUIRE(n);
    CHECK((*n - turn * Vec<3>::UnitZ()).norm() < 1e-7);
    CHECK(-face_position<3>(b, -*n, 0.75) - face_position<3>(a, *n, 0.75) == Approx(0.01).margin(1e-9));
  }
}

TEST_CASE("the shortest vector between particle sets is that of their nearest corners", "[contact]") {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> unit(-1, 1);
  for (int n = 0; n < 200; ++n) {
    ParticleSet<2> a, b;
    for (int k = 0; k < 6; ++k) {
      a.add({unit(random), unit(random)}, Mat<2>::Zero());
      b.add({unit(random) + 3, unit(random) + 1}, Mat<2>::Zero());
    }
    const auto v = shortest_vector<2>(a, b, 1.0, Vec<2>(1, 0));
    REQUIRE(v);
    // Optimal if and only if the slab between the supporting lines is as wide as the vector is long.
    const Vec<2> d = v->normalized();
    CHECK(-face_position<2>(b, -d, 1e9) - face_position<2>(a, d, 1e9) == Approx(v->norm()).epsilon(1e-9));
  }
}

TEST_CASE("particle sets that overlap have no margin", "[contact]") {
  auto a = block(0, {-3, -3}, {3, 1.5}), b = block(0, {-3, -1.5}, {3, 3});
  CHECK_FALSE(margin_normal<2>(a, b, Vec<2>(0, 1), 1.0));
}

TEST_CASE("regression finds flat faces roughly", "[contact]") {
  auto a = block(0, {-3, -3}, {3, 0}), b = block(0, {-3, 0}, {3, 3});
  for (const bool logistic : {false, true}) {
    const auto n = regression_normal<2>(a, b, logistic, 1.0);
    REQUIRE(n);
    CHECK((*n - Vec<2>(0, 1)).norm() < 1e-6);
  }
}

TEST_CASE("a corner that slides past another one is not stopped by it", "[contact]") {
  for (const double angle : {0.0, 0.4}) {
    const Vec<2> along(std::cos(angle), std::sin(angle)), up(-along[1], along[0]);
    auto floor = block(angle, {0, -3}, {3, 0});
    for (const double front : {-0.3, -0.01, 0.0, 0.03, 0.3, 0.6, 2.0}) {
      // A block on the same level whose front is about to pass, or has passed, the floor's corner; with a small overlap
      ParticleSet<2> slider;
      for (double x = front - 0.25; x > -3; x -= 0.5)
        for (double y = 0.249; y < 2.5; y += 0.5)
          slider.add(x * along + y * up, 0.25 * (Mat<2>() << along, up).finished());
      const auto margin = margin_normal<2>(slider, floor, along, 1.0);
      REQUIRE(margin);
      const auto n = corner_normal<2>(slider, floor, *margin, 1.0);
      if (front < 0.05) {
        CHECK_FALSE(n);
      } else {
        REQUIRE(n);
        CHECK((*n + up).norm() < 1e-6);
      }
    }
    // and one that hits it frontally
    auto wall = block(angle, {0.01, -3}, {3, 3});
    auto bar = block(angle, {-3, -1}, {0, 1});
    const auto n = corner_normal<2>(bar, wall, *margin_normal<2>(bar, wall, up, 1.0), 1.0);
    REQUIRE(n);
    CHECK((*n - along).norm() < 1e-6);
  }
}

TEST_CASE("bodies whose boxes hardly overlap along two axes meet in a corner or an edge", "[contact]") {
  NearParticles<3> near;
  near.low[0] = Vec3(-2, -2, -2), near.high[0] = Vec3(0, 0, 0);
  const auto apart = [&](double x, double y, double z) {
    near.low[1] = Vec3(x, y, z), near.high[1] = near.low[1] + Vec3(2, 2, 2);
    return apart_beside_corner(near, 0.05);
  };
  CHECK(apart(0, -1, -1) == 0.0);                         // a face
  CHECK(apart(0.5, -1, -0.06) == 0.0);                    // a face with a gap
  CHECK(apart(0, 0, -1) == Approx(0.05));                 // an edge
  CHECK(apart(-0.02, -0.04, -1) == Approx(0.01));         // the same, slightly displaced
  CHECK(apart(0.3, 0.1, 0) == Approx(0.15));              // a corner
  CHECK(apart(-2, -2 - 1e-9, -1.99) == 0.0);              // one beside the other: it has faces within the other's box
  CHECK(apart(-1.98, 0, -1) == 0.0);                      // a face, though the boxes end nearly together
  CHECK(apart(-3.97, -3.96, -1) == Approx(0.05 - 0.04));  // on the other side
}

TEST_CASE("a box above the edge of a box rests on it, and beside it falls past", "[contact]") {
  const Mat<3> turn = Eigen::AngleAxisd(0.7, Vec<3>(1, -1, 2).normalized()).matrix();
  auto floor = box(turn, {-3, -3, -3}, {0, 3, 0});
  auto on = box(turn, {-0.5, -3, 0}, {3, 3, 3}), beside = box(turn, {0, -3, 0}, {3, 3, 3});
  const auto n = corner_normal<3>(floor, on, *margin_normal<3>(floor, on, turn.col(0), 1.0), 1.0);
  REQUIRE(n);
  CHECK((*n - turn.col(2)).norm() < 1e-6);
  CHECK_FALSE(corner_normal<3>(floor, beside, *margin_normal<3>(floor, beside, turn.col(0), 1.0), 1.0));
}

TEST_CASE("a face is flat if it is plane, wherever it ends", "[contact]") {
  for (const double angle : {0.0, 0.3, 2.1}) {
    const Vec<2> up(-std::sin(angle), std::cos(angle));
    auto face = block(angle, {-3, -3}, {3, 0}), end = block(angle, {-3, -3}, {0.5, 0});
    CHECK(is_flat_face<2>(face, up, 0.02));
    CHECK_FALSE(is_flat_face<2>(face, (up + 0.05 * Vec<2>(up[1], -up[0])).normalized(), 0.02));
    CHECK(is_flat_face<2>(end, up, 0.02));
  }
  ParticleSet<2> arc;  // of a disc with a radius of 20
  for (double t = -2.25; t < 2.5; t += 0.5) arc.add(Vec<2>(t, -0.25 - t * t / 40), 0.25 * Mat<2>::Identity());
  CHECK_FALSE(is_flat_face<2>(arc, Vec<2>(0, 1), 0.02));
}

TEST_CASE("rounding of the particles' places does not turn the margin normal", "[contact]") {
  std::mt19937 random(7);
  const auto disturbed = [&](const ParticleSet<2>& side, double noise) {
    std::uniform_real_distribution<double> unit(-noise, noise);
    ParticleSet<2> out;
    for (std::size_t i = 0; i < side.size(); ++i) {
      const Vec<2> moved = side.centre(i) + Vec<2>(unit(random), unit(random));
      out.add(moved, side.half_axes(i));
    }
    return out;
  };
  for (const double noise : {1e-16, 1e-14, 1e-12, 1e-10, 1e-8, 1e-6})
    for (int n = 0; n < 50; ++n) {
      auto a = disturbed(block(0.3, {-3, -3}, {3, 0}), noise), b = disturbed(block(0.3, {-1.3, 0}, {3, 3}), noise);
      const auto normal = margin_normal<2>(a, b, Vec<2>(0.1, 1).normalized(), 1.0);
      REQUIRE(normal);
      CHECK((*normal - Vec<2>(-std::sin(0.3), std::cos(0.3))).norm() < 1e-7 + 10 * noise);
    }
}

TEST_CASE("round faces that lie in each other have the gap between their curves", "[contact]") {
  // Particles of size h/2 along arcs about (0, -radius): one body inside the circle, the other one outside.
  const auto arc = [](double radius, double from, double to) {
    ParticleSet<2> side;
    for (double r = from + 0.25; r < to; r += 0.5)
      for (double along = -2.25 + 0.1; along < 2.5; along += 0.5) {
        const double angle = along / radius;
        const Mat<2> turn = Eigen::Rotation2Dd(-angle).toRotationMatrix();
        side.add((radius + r) * Vec<2>(std::sin(angle), std::cos(angle)) - Vec<2>(0, radius),
                 turn * (0.25 * Mat<2>::Identity()));
      }
    return side;
  };
  const Vec<2> up(0, 1);
  for (const double radius : {10.0, 20.0, 40.0}) {
    auto inner = arc(radius, -2, 0), outer = arc(radius, 0.3, 2);
    const double sagitta = 0.25 * 0.25 / 2 / radius;  // of a particle's edge
    const double correction = gap_correction<2>(inner, outer, up, 0.75, 0.06);
    const double gap = -face_position<2>(outer, -up, 0.75) - face_position<2>(inner, up, 0.75) + correction;
    CHECK(gap == Approx(0.3).margin(2 * sagitta));
    CHECK(correction > 8 * sagitta);
    // A hollow face on a flat one touches where it stands out, a round one in its middle.
    auto below = block(0, {-3, -3}, {3, 0}), above = block(0, {-3, 0.3}, {3, 3});
    CHECK(gap_correction<2>(below, outer, up, 0.75, 0.06) < 1e-12);
    CHECK(gap_correction<2>(inner, above, up, 0.75, 0.06) < 1e-12);
  }
}

namespace {

// Particles of size h/2 along an arc of a body below it. The arc has its highest point at (`top`, 0).
ParticleSet<2> crown(double radius, double top) {
  ParticleSet<2> side;
  for (double r = radius - 0.25; r > radius - 2; r -= 0.5)
    for (int k = -8; k < 8; ++k) {
      const double angle = 0.5 * (k + 0.5) / radius;
      const Mat<2> turn = Eigen::Rotation2Dd(-angle).toRotationMatrix();
      side.add(Vec<2>(top + r * std::sin(angle), r * std::cos(angle) - radius), turn * (0.25 * Mat<2>::Identity()));
    }
  return side;
}

Vec<2> meeting_place(ParticleSet<2> below, ParticleSet<2> above, bool curved_below, bool curved_above) {
  return foremost_offset<2>({&below, &above}, {curved_below, curved_above}, Vec<2>(0, 1), 0.75, 1.0);
}

}  // namespace

TEST_CASE("a round body meets a plane at its foremost point", "[contact]") {
  const auto floor = block(0, {-3, 0.01}, {3, 3});
  for (const double radius : {10.0, 20.0})
    for (const double top : {-0.5, -0.2, 0.0, 0.3, 0.6}) {
      CAPTURE(radius, top);
      const Vec<2> at = meeting_place(crown(radius, top), floor, true, false);
      CHECK(at[0] == Approx(top).margin(0.02));
      CHECK(at[1] == 0);
      CHECK(meeting_place(crown(radius, top), floor, false, false).norm() == 0);
      auto same = crown(radius, top);  // two equal bodies meet in the middle between them
      ParticleSet<2> mirrored;
      for (std::size_t i = 0; i < same.size(); ++i) {
        const Vec<2> x = same.centre(i);
        const Mat<2> half = Vec<2>(1, -1).asDiagonal() * same.half_axes(i);
        mirrored.add(Vec<2>(x[0], 0.01 - x[1]), half);
      }
      CHECK(meeting_place(same, mirrored, true, true)[0] == Approx(top).margin(0.02));
    }
}

TEST_CASE("faces that are plane or lie in each other meet everywhere", "[contact]") {
  for (const double end : {-0.3, 0.0, 0.4, 3.0}) {
    CAPTURE(end);
    CHECK(meeting_place(block(0, {-3, -3}, {end, 0}), block(0, {-2.9, 0.1}, {3, 3}), true, true).norm() < 1e-12);
  }
  for (const double radius : {10.0, 40.0}) {
    ParticleSet<2> bearing;  // around the shaft
    for (double r = radius + 0.26; r < radius + 2; r += 0.5)
      for (int k = -8; k < 8; ++k) {
        const double angle = 0.5 * (k + 0.5) / radius;
        bearing.add(Vec<2>(0.4 + r * std::sin(angle), r * std::cos(angle) - radius),
                    Eigen::Rotation2Dd(-angle).toRotationMatrix() * (0.25 * Mat<2>::Identity()));
      }
    CHECK(meeting_place(crown(radius, 0.4), bearing, true, true).norm() < 1e-12);
  }
}

TEST_CASE("a shaft meets the end of a pad of the same radius everywhere, also across the gaps between its domains",
          "[contact]") {
  for (const double radius : {10.0, 20.0})
    for (const double end : {-0.6, -0.2, 0.3, 0.9}) {
      CAPTURE(radius, end);
      ParticleSet<2> pad;  // its domains do not fill the space
      for (int row = 0; row < 4; ++row)
        for (int k = 0; k < 6; ++k) {
          const double angle = (end - 0.25 - 0.56 * k) / radius, r = radius + 0.26 + 0.5 * row;
          pad.add(Vec<2>(r * std::sin(angle), r * std::cos(angle) - radius),
                  Eigen::Rotation2Dd(-angle).toRotationMatrix() * (0.25 * Mat<2>::Identity()));
        }
      CHECK(meeting_place(crown(radius, 0.0), pad, true, true).norm() < 1e-12);
    }
}

TEST_CASE("two sides of a curved face are no plane", "[contact]") {
  const Vec<2> up(0, 1);
  for (const double radius : {10.0, 20.0, 40.0}) {
    ParticleSet<2> side;
    for (int k = 0; k < 2; ++k) {
      const double angle = (0.1 + 0.6 * k) / radius;
      side.add(Vec<2>((radius - 0.25) * std::sin(angle), (radius - 0.25) * std::cos(angle) - radius),
               Eigen::Rotation2Dd(-angle).toRotationMatrix() * (0.3 * Mat<2>::Identity()));
    }
    CHECK_FALSE(plane_face_normal<2>(side, up, 1.0));
    CHECK((smooth_face_normal<2>(side, up, 0.75, 1.0).value().normal - up).norm() < 1e-3);
  }
  auto plane = block(0.02, {-1, -2}, {1, 0});
  CHECK((plane_face_normal<2>(plane, up, 1.0).value() - Vec<2>(-std::sin(0.02), std::cos(0.02))).norm() < 1e-12);
}

TEST_CASE(
    "the normal of a cylinder with a radius of few cells is exact beside the node, with a domain that is out of line",
    "[contact]") {
  constexpr double radius = 5.0;
  for (const bool out_of_line : {false, true}) {
    ParticleSet<3> side;
    for (int k = -3; k <= 3; ++k)
      for (int j = -3; j <= 3; ++j) {
        const double angle = (0.5 * k + 0.1) / radius;
        const double tilt = out_of_line && k == 1 && j == 0 ? 0.2 : 0.0;
        const Mat<3> turn = Eigen::AngleAxisd(-angle - tilt, Vec<3>::UnitZ()).toRotationMatrix();
        side.add(Vec<3>((radius - 0.25) * std::sin(angle), (radius - 0.25) * std::cos(angle) - radius, 0.5 * j + 0.2),
                 turn * (0.25 * Mat<3>::Identity()));
      }
    const Vec<3> inclined = Vec<3>(0.05, 1, 0.02).normalized();
    const auto found = smooth_face_normal<3>(side, inclined, 0.75, 1.0);
    REQUIRE(found);
    // The slopes of a circle are linear in the offsets up to their third power.
    CHECK((found->normal - Vec<3>::UnitY()).norm() < 2e-3);
    CHECK(found->beside < 0.3);
  }
}

TEST_CASE("a cylinder meets a plane along a line", "[contact]") {
  constexpr double radius = 10, top = 0.4;
  ParticleSet<3> cylinder;
  for (double r = radius - 0.25; r > radius - 1.5; r -= 0.5)
    for (int k = -6; k < 6; ++k)
      for (double z = -2.25; z < 0.6; z += 0.5) {  // it ends near the node
        const double angle = 0.5 * (k + 0.5) / radius;
        const Mat<3> turn = Eigen::AngleAxisd(-angle, Vec<3>::UnitZ()).toRotationMatrix();
        cylinder.add(Vec<3>(top + r * std::sin(angle), r * std::cos(angle) - radius, z),
                     turn * (0.25 * Mat<3>::Identity()));
      }
  auto floor = box(Mat<3>::Identity(), {-2.5, 0.01, -2.5}, {2.5, 2, 2.5});
  const Vec<3> at = foremost_offset<3>({&cylinder, &floor}, {true, false}, Vec<3>::UnitY(), 0.75, 1.0);
  CHECK(at[0] == Approx(top).margin(0.03));
  CHECK(std::abs(at[1]) < 1e-12);
  CHECK(std::abs(at[2]) < 1e-3);  // the end on one side turns the axes of curvature a little
}

TEST_CASE("flat faces and stairs have no gap correction", "[contact]") {
  const Vec<2> up(0, 1);
  for (const double end : {0.0, 0.4, 3.0}) {
    auto below = block(0, {-3, -3}, {end, 0}), above = block(0, {-2.9, 0.1}, {3, 3});
    CHECK(gap_correction<2>(below, above, up, 0.75, 0.06) == Approx(0).margin(1e-12));
  }
  // Stairs that fit into each other, seen along their slope
  ParticleSet<2> lower, upper;
  for (double x = -2.75; x < 3; x += 0.5)
    for (double y = 0.25; y < 2; y += 0.5) {
      lower.add({x, x - y}, 0.25 * Mat<2>::Identity());
      upper.add({x, x + y}, 0.25 * Mat<2>::Identity());
    }
  CHECK(gap_correction<2>(lower, upper, Vec<2>(-1, 1).normalized(), 0.75, 0.06) == 0.0);
  auto floor = box(Mat<3>::Identity(), {-3, -3, -3}, {3, 3, 0}),
       lid = box(Mat<3>::Identity(), {-2.9, -3, 0}, {3, 3, 3});
  CHECK(gap_correction<3>(floor, lid, Vec<3>::UnitZ(), 0.75, 0.06) == Approx(0).margin(1e-12));
}

TEST_CASE("next to a blunt edge the normal is that of the face at the node, not of the foremost face", "[contact]") {
  // Slope of the face for x < edge; it is level for x > edge, at y = 0. With 0.1 neighbouring particles would differ in
  // height by just the limit of 0.05 cells, so that round-off would decide.
  constexpr double rise = 0.09;
  const Vec<2> level(0, 1), inclined = Vec<2>(-rise, 1).normalized();
  const auto at_node = [&](double edge) {
    ParticleSet<2> side;
    for (double x = -2.25; x < 2.5; x += 0.5)
      for (double y = -0.25; y > -2; y -= 0.5) {
        const double slope = x < edge ? rise : 0.0;
        Mat<2> half = 0.25 * Mat<2>::Identity();
        half(1, 0) = 0.25 * slope;
        side.add(Vec<2>(x, y + slope * (x - edge)), half);
      }
    if (const auto n = plane_normal_at_node<2>(side, level, 0.75, 1.0)) return *n;
    CHECK(edge < 1.6);
    return smooth_face_normal<2>(side, level, 0.75, 1.0, true).value().normal;
  };
  CHECK((at_node(1.5) - inclined).norm() < 1e-9);  // the level face begins 1.5 cells beside the node
  CHECK((at_node(-1.5) - level).norm() < 1e-9);
  const Vec<2> between = at_node(0.0);
  CHECK(between[0] < -0.2 * rise);
  CHECK(between[0] > -0.8 * rise);
}

TEST_CASE("a tilted domain at the end of a rigid face does not tilt the normal", "[contact]") {
  ParticleSet<2> side;
  for (double x = -0.25; x < 2.5; x += 0.5)
    for (double y = -0.25; y > -2; y -= 0.5) {
      Mat<2> half = 0.25 * Mat<2>::Identity();
      if (x < 0) half(1, 0) = 0.25 * 0.05;
      side.add(Vec<2>(x, y), half);
    }
  const Vec<2> up(0, 1);
  CHECK_FALSE(smooth_face_normal<2>(side, up, 0.75, 1.0, true).value_or(SmoothNormal<2>{up, 0.0}).normal[0] != 0.0);
  CHECK(smooth_face_normal<2>(side, up, 0.75, 1.0, false).value().normal[0] < -0.01);
}
