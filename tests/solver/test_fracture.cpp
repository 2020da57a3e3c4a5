// SPDX-License-Identifier: MIT
/// Loads of crack tips, and how cracks grow.

#include "base/parallel.hpp"
#include "cloud.hpp"
#include "crack_cases.hpp"
#include "geometry/crack_tip_fields.hpp"
#include "solver/cracks/crack_build.hpp"
#include "solver/cracks/crack_tips.hpp"

#include <catch2/catch.hpp>

#include <numbers>

using namespace tribo;
using namespace tribo::test;

namespace {

constexpr double young = 1e6, poisson = 0.3;

/// A plate of 24 cells with a crack whose tip lies near the middle, at an angle to the grid.
Model cracked(double angle) {
  Model model = grid_model<2>(Kernel::quadratic_spline, Transfer::apic, UpdateOrder::usl, false, 40);
  model.materials[0].law = elastic(1000, young, poisson);
  const Vec3 tip(20.1, 19.8, 0), back = tip - 6 * Vec3(std::cos(angle), std::sin(angle), 0);
  model.cracks = {line(back, tip, 12)};
  model.cracks[0].ends[0] = CrackSpec::End::none;
  model.fracture = FractureSpec{};
  return model;
}

/// Gives the particles stress and strain of a tip field, all of it turned by `turn`.
void load(System<2>& system, double angle, double K1, double K2, double turn = 0) {
  const double G = young / (2 * (1 + poisson)), kappa = 3 - 4 * poisson;
  auto& body = system.bodies[0];
  const Vec<2> tip = system.cracks[0].x[system.cracks[0].tips[0].point];
  const Mat<2> axes = Eigen::Rotation2Dd(angle).toRotationMatrix();
  const Mat<2> R = Eigen::Rotation2Dd(turn).toRotationMatrix();
  for (std::size_t i = 0; i < body.particles.size(); ++i) {
    const Vec<2> local = axes.transpose() * (body.particles.position(i) - tip);
    Mat<2> stress = Mat<2>::Zero(), gradient = stress;
    for (const int mode : {1, 2}) {
      const TipField f = tip_field(mode, local.norm(), std::atan2(local[1], local[0]), G, kappa);
      stress += (mode == 1 ? K1 : K2) * f.stress, gradient += (mode == 1 ? K1 : K2) * f.gradient;
    }
    Mat3 sigma = Mat3::Zero(), F = Mat3::Identity();
    // the crack lies at `angle` now; before it turned, at angle - turn
    const Mat<2> before = R.transpose() * axes;
    sigma.topLeftCorner<2, 2>() = axes * stress * axes.transpose();
    sigma(2, 2) = poisson * stress.trace();
    F.topLeftCorner<2, 2>() = R * (Mat<2>::Identity() + before * gradient * before.transpose());
    store_symmetric<2>(sigma, body.particles.stress(), static_cast<int>(i));
    store_full<2>(F, body.particles.F(), static_cast<int>(i));
  }
}

CrackTip measured(double angle, double K1, double K2, double turn = 0, const Vec<2>& acceleration = Vec<2>::Zero()) {
  const Model model = cracked(angle);
  auto system = build_system<2>(model, lattice_seeds<2>(model, 8, 32));
  settle(system);
  REQUIRE(system.cracks[0].tips.size() == 1);
  load(system, angle, K1, K2, turn);
  const auto transfers = make_transfers<2>(model.scheme);
  Cracks<2> cracks(model, system, *transfers);
  CrackTips<2> fracture(model, system, cracks, 3);
  fracture.measure([&](const Vec<2>&, const Vec<2>&) { return acceleration; });
  return system.cracks[0].tips[0];
}

}  // namespace

TEST_CASE("the interaction integral reproduces the stress intensity factors of a tip field", "[fracture]") {
  const double angle = GENERATE(0.0, 0.4, 2.0);
  const double E = young / (1 - poisson * poisson);
  for (const auto& [K1, K2] : {std::pair(1.0, 0.0), std::pair(0.0, 1.0), std::pair(2.0, -1.0)}) {
    INFO("angle " << angle << ", K1 " << K1 << ", K2 " << K2);
    const CrackTip tip = measured(angle, K1, K2);
    const double size = std::hypot(K1, K2);
    // four particles per cell sum the field of a ring of two cells to 1 %
    CHECK(tip.K[0] == Approx(K1).margin(0.01 * size));
    CHECK(tip.K[1] == Approx(K2).margin(0.01 * size));
    CHECK(tip.J == Approx((K1 * K1 + K2 * K2) / E).epsilon(0.02));
  }
}

TEST_CASE("a body force that nothing balances adds its work on the tip field to the integrals", "[fracture]") {
  // rho (a - b) . u_,1 q over the domain, here with a = 0 and b in the axes of the tip
  const double angle = 0.3, density = 1000, E = young / (1 - poisson * poisson);
  const Vec<2> b(2e-4, -3e-4);
  std::array<double, 2> work{};  // of each mode of unit intensity
  constexpr int rings = 400, parts = 400;
  for (int i = 0; i < rings; ++i)
    for (int k = 0; k < parts; ++k) {
      const double r = 5 * (i + 0.5) / rings, turn = std::numbers::pi * (2 * (k + 0.5) / parts - 1);
      const double s = std::clamp((r - 3) / 2, 0.0, 1.0), q = 1 - s * s * (3 - 2 * s);
      for (const int mode : {1, 2}) {
        const TipField f = tip_field(mode, r, turn, young / (2 * (1 + poisson)), 3 - 4 * poisson);
        const double area = 5.0 / rings * 2 * std::numbers::pi / parts * r;
        work[static_cast<std::size_t>(mode - 1)] += density * b.dot(f.gradient.col(0)) * q * area;
      }
    }
  const auto change = [&](double K2, const Vec<2>& along) {
    const CrackTip still = measured(angle, 1, K2),
                   moved = measured(angle, 1, K2, 0, Eigen::Rotation2Dd(angle).toRotationMatrix() * along);
    return std::array{E * (moved.J - still.J), moved.K[0] - still.K[0], moved.K[1] - still.K[1]};
  };
  // four particles per cell sum a field that is singular at the tip
  constexpr double error = 0.06;
  const auto both = change(0.5, b);
  CHECK(both[1] == Approx(-0.5 * E * work[0]).margin(error));
  CHECK(both[2] == Approx(-0.5 * E * work[1]).margin(error));
  // J takes the mean rotation around the tip out, which mode 1 does not have
  CHECK(change(0, Vec<2>(b[0], 0))[0] == Approx(-E * work[0]).margin(2 * error));
  REQUIRE(std::abs(E * work[0]) > 4 * error);
  REQUIRE(std::abs(E * work[1]) > 4 * error);
}

TEST_CASE("a body that has turned has the same stress intensities", "[fracture]") {
  // by a right angle the particles' squares become themselves, otherwise the points of the sums change
  const double right = 0.5 * std::numbers::pi;
  const auto [turn, tolerance] = GENERATE_COPY(std::pair(right, 1e-5), std::pair(-right, 1e-5), std::pair(0.5, 0.01));
  const CrackTip tip = measured(0.3, 2, 1, turn), still = measured(0.3, 2, 1);
  CHECK(tip.K[0] == Approx(still.K[0]).epsilon(tolerance));
  CHECK(tip.K[1] == Approx(still.K[1]).epsilon(tolerance));
  CHECK(tip.J == Approx(still.J).epsilon(tolerance));
}

namespace {

/// A crack tip in the plate, and what it does under given loads.
struct Growing {
  Model model;
  System<2> system;

  explicit Growing(Growth growth, double angle = 0.3, std::optional<CrackSpec> other = {})
      : model(with(growth, angle, std::move(other))), system(build_system<2>(model, lattice_seeds<2>(model, 8, 32))) {
    settle(system);
  }
  static Model with(Growth growth, double angle, std::optional<CrackSpec> other) {
    Model model = cracked(angle);
    model.materials[0].growth = growth;
    model.materials[0].toughness = {1.0, 0.5, 2.0};
    if (other) model.cracks.push_back(*other);
    return model;
  }
  CrackTip& tip() { return system.cracks[0].tips[0]; }
  const Vec<2>& end() { return system.cracks[0].x[tip().point]; }
  /// Whether it grew under these intensities, in parts of KIc.
  bool grow(double K1, double K2, double J = 0) {
    const auto transfers = make_transfers<2>(model.scheme);
    Cracks<2> cracks(model, system, *transfers);
    CrackTips<2> fracture(model, system, cracks, 3);
    tip().K = {K1, K2}, tip().has_K = true, tip().J = J;
    return fracture.grow();
  }
  /// Angle by which the last piece turns against the one before, in degrees.
  double kink() {
    const auto& crack = system.cracks[0];
    const auto direction = [&](std::size_t piece) {
      const Vec<2> d = crack.corners(piece)[1] - crack.corners(piece)[0];
      return std::atan2(d[1], d[0]);
    };
    return (direction(crack.main_pieces - 1) - direction(crack.main_pieces - 2)) * 180 / std::numbers::pi;
  }
};

}  // namespace

TEST_CASE("cracks grow towards the largest hoop stress", "[fracture]") {
  // mode II: 2 atan(1/sqrt 2) = 70.5288 degrees away from the side to which the upper face slides forward; the hoop
  // stress is that of a mode I with 2/sqrt 3 of its intensity
  for (const double sign : {1.0, -1.0}) {
    Growing crack({Growth::When::hoop_stress});
    CHECK_FALSE(crack.grow(0, sign * 0.999 * std::sqrt(3) / 2));
    CHECK(crack.system.cracks[0].main_pieces == 12);
    const Vec<2> before = crack.end();
    CHECK(crack.grow(0, sign * 1.001 * std::sqrt(3) / 2));
    CHECK(crack.system.cracks[0].main_pieces == 13);
    CHECK(crack.kink() == Approx(-sign * 70.5287794).epsilon(1e-8));
    CHECK((crack.end() - before).norm() == Approx(0.5 * crack.system.lattice.spacing[0]));
  }
  Growing straight({Growth::When::hoop_stress});
  CHECK_FALSE(straight.grow(0.999, 0));
  CHECK(straight.grow(1.001, 0));
  CHECK(std::abs(straight.kink()) < 1e-9);
  CHECK_FALSE(Growing({Growth::When::hoop_stress}).grow(-5, 0));
}

TEST_CASE("a tip rests until a surface wave has run along its new piece", "[fracture]") {
  Growing crack({Growth::When::hoop_stress});
  CHECK(crack.grow(2, 0));
  CHECK_FALSE(crack.grow(2, 0));
  const double hop = 0.5 * crack.system.lattice.spacing[0], shear_waves = std::sqrt(young / 2.6 / 1000);
  crack.system.time = 0.99 * hop / (0.9 * shear_waves);
  CHECK_FALSE(crack.grow(2, 0));
  crack.system.time = 1.01 * hop / (0.9 * shear_waves);
  CHECK(crack.grow(2, 0));
  CHECK(crack.system.cracks[0].main_pieces == 14);
}

TEST_CASE("other criteria of growth have their own thresholds and angles", "[fracture]") {
  // Sih 1974, nu = 0.3 in plane strain: mode II at -arccos((1 - 2 nu)/3) = -82.3377 degrees, where its energy density
  // is (kappa + 1)(1 - c) + (1 + c)(3 c - 1) against 2 (kappa - 1) of mode I
  const double kappa = 3 - 4 * poisson, c = (1 - 2 * poisson) / 3;
  const double critical = std::sqrt(2 * (kappa - 1) / ((kappa + 1) * (1 - c) + (1 + c) * (3 * c - 1)));
  Growing density({Growth::When::energy_density});
  CHECK_FALSE(density.grow(0, 0.999 * critical));
  CHECK(density.grow(0, 1.001 * critical));
  CHECK(density.kink() == Approx(-std::acos(c) * 180 / std::numbers::pi).epsilon(1e-6));
  CHECK_FALSE(Growing({Growth::When::energy_density}).grow(-2, 0));
  CHECK(Growing({Growth::When::energy_density}).grow(1.001, 0));

  // (K1/1)^2 + (K2/0.5)^2 = 1
  CHECK_FALSE(Growing({Growth::When::empirical}).grow(0.6, 0.399));
  CHECK(Growing({Growth::When::empirical}).grow(0.6, -0.401));

  Growing energy({Growth::When::release_rate});
  CHECK_FALSE(energy.grow(9, 9, 1.999));
  CHECK(energy.tip().released == 0);
  CHECK(energy.grow(0, 1, 2.001));
  CHECK(std::abs(energy.kink()) < 1e-9);
  CHECK(energy.tip().released == Approx(2.001 * 0.5 * energy.system.lattice.spacing[0] * energy.model.grid.thickness));
}

TEST_CASE("the direction of growth may be chosen", "[fracture]") {
  using Way = Growth::Way;
  const auto kink = [](Way way, double opens, double slides) {
    Growing crack({Growth::When::hoop_stress, way});
    auto& c = crack.system.cracks[0];
    const Vec<2> along(std::cos(0.3), std::sin(0.3)), up(-along[1], along[0]);
    c.face[1][crack.tip().previous] += opens * up + slides * along;
    REQUIRE(crack.grow(0, 2));
    return crack.kink();
  };
  CHECK(std::abs(kink(Way::straight_on, 1, 1)) < 1e-9);
  CHECK(kink(Way::normal_to_opening, 1, 1) == Approx(-45));
  CHECK(kink(Way::hoop_of_opening, 0, 1) == Approx(-70.5287794));

  Growing start({Growth::When::hoop_stress, Way::as_at_start});
  start.tip().initial_direction = Vec<2>(std::cos(0.5), std::sin(0.5));
  REQUIRE(start.grow(0, 2));
  CHECK(start.kink() == Approx(0.2 * 180 / std::numbers::pi));
}

TEST_CASE("growth releases J times the new area, and nothing where J is negative", "[fracture]") {
  for (const double J : {0.5, -0.5}) {
    Growing crack({Growth::When::hoop_stress});
    const double before = crack.tip().released;
    REQUIRE(crack.grow(2, 0, J));
    CHECK((crack.tip().released > before) == (J > 0));
    CHECK(crack.tip().released >= before);
  }
}

TEST_CASE("a crack stops in front of another one", "[fracture]") {
  // a wall of its way, 0.3 cells ahead of the tip at (20.1, 19.8)
  const double ahead = 0.3;
  Growing crack({Growth::When::hoop_stress}, 0, line(Vec3(20.1 + ahead, 18, 0), Vec3(20.1 + ahead, 22, 0), 4));
  const double before = crack.end()[0];
  REQUIRE(crack.grow(2, 0));
  CHECK_FALSE(crack.tip().active);
  CHECK(crack.end()[0] - before == Approx(0.99 * ahead).epsilon(0.01));
  CHECK(crack.tip().J == 0.0);
  CHECK_FALSE(crack.tip().has_K);
  crack.system.time = 1e9;
  CHECK_FALSE(crack.grow(2, 0));
}

TEST_CASE("the type of an end of a crack can be specified", "[fracture]") {
  Model model = cracked(0.0);
  const auto seeds = lattice_seeds<2>(model, 8, 32);
  const auto tips = [&](CrackSpec::End first, CrackSpec::End last) {
    model.cracks[0].ends = {first, last};
    return build_system<2>(model, seeds).cracks[0].tips.size();
  };
  using End = CrackSpec::End;
  CHECK(tips(End::found, End::found) == 2);
  CHECK(tips(End::tip, End::none) == 1);
  CHECK(tips(End::none, End::none) == 0);
  CHECK(tips(End::exterior, End::found) == 1);
  model.cracks = {line(Vec3(2, 20, 0), Vec3(20, 20, 0), 12)};
  CHECK(tips(End::found, End::found) == 1);
  CHECK_THROWS_AS(tips(End::tip, End::found), InputError);
}
