/// Loads of crack tips, and how cracks grow.

#include "base/parallel.hpp"
#include "cloud.hpp"
#include "crack_cases.hpp"
#include "geometry/crack_tip_fields.hpp"
#include "solver/crack_build.hpp"
#include "solver/fracture.hpp"

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

CrackTip measured(double angle, double K1, double K2, double turn = 0) {
  const Model model = cracked(angle);
  auto system = build_system<2>(model, lattice_seeds<2>(model, 8, 32));
  settle(system);
  REQUIRE(system.cracks[0].tips.size() == 1);
  load(system, angle, K1, K2, turn);
  const auto transfers = make_transfers<2>(model.scheme);
  Cracks<2> cracks(model, system, *transfers);
  Fracture<2> fracture(model, system, cracks, 3);
  fracture.measure([](const Vec<2>&, const Vec<2>&) { return Vec<2>(Vec<2>::Zero()); });
  return system.cracks[0].tips[0];
}

}  // namespace

TEST_CASE("the ring around a tip finds the stress intensities of its field", "[fracture]") {
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

TEST_CASE("a body that has turned has the same stress intensities", "[fracture]") {
  const double turn = GENERATE(0.5, -1.5);
  const CrackTip tip = measured(0.3, 2, 1, turn), still = measured(0.3, 2, 1);
  CHECK(tip.K[0] == Approx(still.K[0]).epsilon(1e-3));
  CHECK(tip.K[1] == Approx(still.K[1]).epsilon(1e-3));
  CHECK(tip.J == Approx(still.J).epsilon(1e-3));
}
