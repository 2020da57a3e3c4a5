// SPDX-License-Identifier: MIT
/// The area of a face at a node: sum_p V_p grad w_Ip is the integral of the weight over the surface.

#include "contact/contact_cases.hpp"
#include "grid/kernels.hpp"
#include "solver/cloud.hpp"
#include "solver/step.hpp"

using namespace tribo;
using namespace tribo::test;

namespace {

// Weight of the node k along an axis at s, both in cells.
double spline(double s, double k) {
  const double r = std::abs(s - k);
  return r < 0.5 ? 0.75 - r * r : r < 1.5 ? 0.5 * (1.5 - r) * (1.5 - r) : 0.0;
}

}  // namespace

TEST_CASE("nodal areas are integrals of the weight over the face, whatever its tilt", "[contact]") {
  const double degrees = GENERATE(0.0, 15.0, 30.0, 45.0);
  const double shift = GENERATE(0.0, 0.15, 0.4);
  INFO(degrees << " degrees, shift " << shift);
  const double angle = degrees * std::acos(-1.0) / 180;
  const Vec<2> along(std::cos(angle), std::sin(angle)), up(-std::sin(angle), std::cos(angle)), origin(20.3, 20 + shift);

  // A block 20 cells long and 8 deep, its upper face through `origin`, in particles of half a cell along its own axes.
  const int per = GENERATE(2, 4);
  INFO(per << " particles per cell and axis");
  const Model model = grid_model<2>(Kernel::quadratic_spline, Transfer::flip, UpdateOrder::usl, false, 40);
  std::vector<Seed> seeds;
  const double size = 1.0 / per;
  for (int i = -10 * per; i < 10 * per; ++i)
    for (int j = -8 * per; j < 0; ++j) {
      Seed s;
      s.x.head<2>() = origin + size * (i + 0.5) * along + size * (j + 0.5) * up;
      s.half_size.head<2>().setConstant(0.5 * size);
      s.volume = size * size, s.mass = 1000 * s.volume;
      seeds.push_back(s);
    }
  auto system = build_system<2>(model, seeds);
  settle(system);
  const auto transfers = make_transfers<2>(model.scheme);
  auto& field = system.fields[0];
  transfers->scatter(system.bodies[0], {field.map, field.nodes}, Scatter::volume, false, false);

  double sum = 0.0, worst = 0.0, length = 0.0;
  for (std::int64_t n = 0; n < field.map.node_count(); ++n) {
    const Vec<2> x = system.lattice.position(field.map.node_at(n));
    const double t = (x - origin).dot(along), depth = (x - origin).dot(up);
    if (std::abs(t) > 6 || std::abs(depth) > 3) continue;
    const Node& node = field.nodes[static_cast<std::size_t>(n)];
    const double area = Eigen::Map<const Vec<2>>(node.acceleration).dot(up);
    double exact = 0.0;
    constexpr int pieces = 4000;
    for (int k = 0; k < pieces; ++k) {
      const Vec<2> p = origin + (t - 4 + 8 * (k + 0.5) / pieces) * along;
      exact += 8.0 / pieces * spline(p[0], x[0]) * spline(p[1], x[1]);
    }
    sum += area, length += exact, worst = std::max(worst, std::abs(area - exact));
  }
  // Particles sample the weight's slope, which has kinks: an error of second order in their size.
  const double order = 4.0 / (per * per);
  CHECK(sum == Approx(length).epsilon(5e-3 * order));
  CHECK(worst < 0.06 * order);  // cells
}

TEST_CASE("a plate thinner than the kernel's reach has the area of its partner's face", "[contact]") {
  const int rows = GENERATE(1, 2, 3, 8);  // of particles, two per cell
  INFO(rows << " rows");
  Model model = grid_model<2>(Kernel::quadratic_spline, Transfer::apic, UpdateOrder::usl, false, 40);
  model.materials.push_back(model.materials.front());
  model.contact.active = true;
  // Faces stay in contact under any tension: else the area of those that carry no force would be missing
  model.contact.default_law = make_law("63", {{"coeff", "0.3"}, {"Sa", "1"}, {"displacementOnly", "-1e9"}});
  std::vector<Seed> seeds;
  for (int i = 0; i < 40; ++i)
    for (int j = -16; j < rows; ++j) {
      Seed s;
      s.x = Vec3(10 + 0.5 * (i + 0.5), 20.3 + 0.5 * (j + 0.5), 0);
      s.half_size.head<2>().setConstant(0.25);
      s.volume = 0.25, s.mass = 250;
      s.material = j < 0 ? 0 : 1;
      s.v = Vec3(0, j < 0 ? 1e-3 : -1e-3, 0);
      seeds.push_back(s);
    }
  auto system = build_system<2>(model, seeds);
  Stepper<2> stepper(model, system);
  stepper.advance(1e-4);
  CHECK(stepper.contact().ledger().total().area == Approx(20).epsilon(0.02));
}

TEST_CASE("around an axis the area between two bodies grows with the radius", "[contact]") {
  Model model = grid_model<2>(Kernel::quadratic_spline, Transfer::apic);
  model.analysis = Analysis::axisymmetric;
  model.materials.push_back(model.materials.front());
  model.contact.active = true;
  model.contact.default_law = make_law("63", {{"coeff", "0.3"}, {"Sa", "1"}});
  const int across = GENERATE(0, 1);  // the face is normal to the radius, or to the axis
  auto seeds = lattice_seeds<2>(model, 4, 12);
  for (Seed& s : seeds) {
    s.volume *= s.x[0], s.mass *= s.x[0];
    s.material = s.x[across] < 8 ? 0 : 1;
    s.v[across] = s.x[across] < 8 ? 1e-3 : -1e-3;
  }
  auto system = build_system<2>(model, seeds);
  Stepper<2> stepper(model, system);
  stepper.advance(1e-4);
  // per radian
  CHECK(stepper.contact().ledger().total().area == Approx(across == 1 ? (12 * 12 - 4 * 4) / 2 : 8 * 8).epsilon(0.01));
}
