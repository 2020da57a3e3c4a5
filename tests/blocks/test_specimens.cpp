// SPDX-License-Identifier: MIT
/// Beams and specimens between platens against beam theory and elasticity; stability of the fictitious stress.

#include "blocks/block_cases.hpp"

#include <catch2/catch.hpp>

using namespace tribo;
using namespace tribo::test;

namespace {

constexpr double E = 50e9;

/// Displacements as sums of increments: differences of places would lose digits.
class Relaxed {
 public:
  explicit Relaxed(Assembly& body) : body_(body), u(body.bodies.size(), Vec3::Zero()), turned(u) {}
  void advance(int steps) {
    for (int k = 0; k < steps; ++k) {
      body_.advance(1.0);
      for (std::size_t b = 0; b < u.size(); ++b) u[b] += body_.motion[b].v, turned[b] += body_.motion[b].w;
    }
  }

 private:
  Assembly& body_;

 public:
  std::vector<Vec3> u, turned;
};

}  // namespace

TEST_CASE("a row of blocks bends as a beam", "[blocks]") {
  constexpr double d = 0.1, I = d * d * d / 12, L = 1.0;
  for (const bool by_moment : {true, false}) {
    auto spec = std::make_shared<BlocksSpec>();
    for (int k = 0; k <= 10; ++k) {
      BlockGroup brick;
      brick.low = Vec3(k * d - d / 2, 0, 0), brick.high = Vec3(k * d + d / 2, d, 0);
      spec->groups.push_back(brick);
    }
    spec->laws.initial = elastic_bonds(E, 0.0);
    spec->quasi_static = true, spec->local_damping = 0.8;
    BlockHold clamp;
    clamp.where = around(-0.01, 0.01, 0, d);
    for (auto* list : {&clamp.velocity, &clamp.spin})
      for (auto& v : *list) v = constant(0);
    spec->holds.push_back(clamp);
    BlockLoad load;
    load.where = around(0.99, 1.01, 0, d);
    (by_moment ? load.moment[2] : load.force[1]) = constant(1.0);
    spec->loads.push_back(load);
    Assembly body(spec, 2, true, Vec3::Zero(), 1.0);
    Relaxed at(body);
    at.advance(20000);
    if (by_moment) {
      CHECK(at.u[10][1] / (L * L / (2 * E * I)) == Approx(1).epsilon(1e-8));
      CHECK(at.turned[10][2] / (L / (E * I)) == Approx(1).epsilon(1e-8));
    } else {
      CHECK(at.u[10][1] / (L * L * L / (3 * E * I)) == Approx(1).epsilon(1e-8));
    }
  }
}

TEST_CASE("a specimen between smooth platens has the constants of its bonds", "[blocks]") {
  const Vec3 size(0.05, 0.1, 0);
  const auto nuclei = scattered(120, size, true, 0.004);
  constexpr double nu = 0.25, squeeze = -1e-10;
  for (const double p : {0.0, 2.0}) {
    auto spec = specimen(nuclei, size, elastic_bonds(E, nu, 0.0));
    spec->quasi_static = true, spec->local_damping = 0.7;
    spec->platens[1].velocity[1] = TimeFunction{Expression("t < 500 ? 1 : 0", {}), 1.0, squeeze * size[1] / 500};
    if (p > 0)
      for (const double x : {0.0, size[0]}) {
        BlockPressure on;
        on.where = around(x - 1e-6, x + 1e-6, -1, 1), on.pressure = constant(p);
        spec->pressures.push_back(on);
      }
    Assembly body(spec, 2, true, Vec3::Zero(), 1.0);
    Relaxed at(body);
    at.advance(6000);
    const double sy = E * squeeze - nu * p, ex = (-p - nu * sy) / E;
    CHECK(body.platen_force(0)[1] / size[0] == Approx(sy).epsilon(1e-7));
    CHECK(body.mean_stress()(1, 1) == Approx(sy).epsilon(1e-7));
    double scatter = 0, n = 0, sx = 0, su = 0, xx = 0, xu = 0;
    for (std::size_t k = 0; k < body.block_count(); ++k) {
      scatter = std::max(scatter, std::abs(body.stress_of(k)(1, 1) - sy));
      const Vec3 x = body.motion[k].x + body.bodies[k].reference - Vec3(0.025, 0.05, 0);
      const Vec3 moved = at.u[k] + at.turned[k].cross(body.bodies[k].reference);
      n += 1, sx += x[0], su += moved[0], xx += x[0] * x[0], xu += x[0] * moved[0];
    }
    CHECK(scatter < 1e-6 * std::abs(sy));
    CHECK((xu - sx * su / n) / (xx - sx * sx / n) / ex == Approx(1).epsilon(1e-7));
  }
}

TEST_CASE("a specimen that is gripped by its outer blocks is nearly as good", "[blocks]") {
  const Vec3 size(0.05, 0.1, 0);
  constexpr double nu = 0.25, squeeze = -1e-10;
  auto spec = specimen(scattered(120, size, true, 0.004), size, elastic_bonds(E, nu, 0.0));
  spec->platens.clear();
  spec->quasi_static = true, spec->local_damping = 0.7;
  for (const double y : {0.0, size[1]}) {
    BlockHold grip;
    grip.where = around(-1, 1, y - 0.006, y + 0.006);
    grip.velocity[1] =
        y > 0 ? TimeFunction{Expression("t < 500 ? 1 : 0", {}), 1.0, squeeze * size[1] / 500} : constant(0);
    spec->holds.push_back(grip);
  }
  Assembly body(spec, 2, true, Vec3::Zero(), 1.0);
  Relaxed at(body);
  at.advance(6000);
  // stress by the forces through the middle, strain by the blocks around it
  double xx = 0, xu = 0, yy = 0, yu = 0, stress = 0, volume = 0;
  Vec3 mean = Vec3::Zero();
  double count = 0;
  const auto inner = [&](std::size_t k) { return std::abs(body.motion[k].x[1] - 0.05) < 0.03; };
  for (std::size_t k = 0; k < body.block_count(); ++k)
    if (inner(k)) mean += at.u[k], count += 1;
  mean /= count;
  for (std::size_t k = 0; k < body.block_count(); ++k) {
    if (!inner(k)) continue;
    const Vec3 x = body.motion[k].x - Vec3(0.025, 0.05, 0), u = at.u[k] - mean;
    xx += x[0] * x[0], xu += x[0] * u[0], yy += x[1] * x[1], yu += x[1] * u[1];
    stress += body.bodies[k].volume * body.stress_of(k)(1, 1), volume += body.bodies[k].volume;
  }
  CHECK(stress / volume / (yu / yy) == Approx(E).epsilon(0.01));
  CHECK(-(xu / xx) / (yu / yy) == Approx(nu).epsilon(0.05));
}

TEST_CASE("the lag of the fictitious stress feeds vibrations as it should", "[blocks]") {
  // Two by two squares with free outer faces breathe: each has half of the stress in its two springs, so that the
  // feedback a is nu/2 in plane stress. Growth per step of leapfrog: phi^2 a'/(2 (1 - a')), a' = a^(m+1).
  for (const double nu : {0.5, 0.75})
    for (const int iterations : {0, 1, 2}) {
      auto spec = std::make_shared<BlocksSpec>();
      for (int k = 0; k < 4; ++k) {
        BlockGroup brick;
        brick.low = Vec3(k % 2, k / 2, 0), brick.high = brick.low + Vec3(1, 1, 0);
        const Vec3 out = 0.5 * (brick.low + brick.high) - Vec3(1, 1, 0);
        brick.velocity = 1e-12 * out, brick.density = 1;
        spec->groups.push_back(brick);
      }
      spec->laws.initial = elastic_bonds(1.0, nu, 1.0);
      spec->stress_iterations = iterations;
      Assembly body(spec, 2, true, Vec3::Zero(), 1.0);
      const double a = nu / 2, dt = std::sqrt(1e-3 / 2);  // k dt^2/m = 1e-3, k = 2 E A/d
      double before = 0, after = 0, last = 0;
      const int steps = 6000;
      for (int k = 0; k < steps; ++k) {
        body.advance(dt);
        const double v = body.motion[3].v[0];
        if (k < 500) before = std::max(before, std::abs(v));
        if (k >= steps - 500) after = std::max(after, std::abs(v));
        last = v;
      }
      CHECK(std::isfinite(last));
      const double rate = std::log(after / before) / (steps - 500), lag = std::pow(a, iterations + 1);
      CHECK(rate == Approx(1e-3 / (1 - a) * lag / (2 * (1 - lag))).epsilon(0.05));
    }
}

TEST_CASE("undamped bonds with Poisson's ratio are unstable, damped ones are not", "[blocks]") {
  const Honeycomb cells(8, 9, 0.01);
  const auto deviation = [&](double nu, double damping) {
    auto spec = specimen(cells.nuclei, cells.size, elastic_bonds(E, nu, 1.0));
    spec->local_damping = damping;
    spec->platens[1].velocity[1] = constant(1e-6);
    Assembly body(spec, 2, true, Vec3::Zero(), 1.0);
    const double dt = body.critical_step();
    double most = 0;
    for (int k = 0; k < 8000 && most < 1e4; ++k) {
      body.advance(dt);
      if (k < 4000) continue;
      const double s = E * 1e-6 * body.time / cells.size[1];
      most = std::max(most, std::abs(body.platen_force(0)[1] / cells.size[0] / s - 1));
    }
    return most;
  };
  CHECK(deviation(0.25, 0.7) < 0.5);
  CHECK(deviation(0.25, 0.05) < 5);
  CHECK(deviation(0.0, 0.0) < 5);
  CHECK(deviation(0.25, 0.0) > 1e3);
}
