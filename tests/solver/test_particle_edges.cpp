// SPDX-License-Identifier: MIT
/// Joints along rows of particles.

#include "cloud.hpp"
#include "crack_cases.hpp"
#include "joint_law.hpp"

#include <catch2/catch.hpp>

using namespace tribo;
using namespace tribo::test;

namespace {

/// A block in the cells 4 to 12 with two particles per cell and axis, so that edges of particles are at multiples of
/// 0.5, and a crack through it.
template <int Dim>
Model cracked(CrackSpec crack, bool with_joint = true) {
  Model model = grid_model<Dim>(Kernel::quadratic_spline, Transfer::flip, UpdateOrder::usl, false, 16);
  if (with_joint) crack.joint = joint(strong);
  model.cracks = {std::move(crack)};
  return model;
}

/// Where the first point of the crack of a model lies in the system along y.
template <int Dim>
double place_of_crack(const Model& model) {
  const auto system = build_system<Dim>(model, lattice_seeds<Dim>(model, 4, 12));
  return system.cracks[0].x.front()[1];
}

CrackSpec level(double y) { return line(Vec3(3, y, 0), Vec3(13, y, 0), 20); }

}  // namespace

TEST_CASE("a joint along a row of particles lies at the nearest edge of the row", "[cracks][joints]") {
  CHECK(place_of_crack<2>(cracked<2>(level(8.0))) == 8.0);
  CHECK(place_of_crack<2>(cracked<2>(level(8.1))) == Approx(8.0));
  CHECK(place_of_crack<2>(cracked<2>(level(8.3))) == Approx(8.5));
  CHECK(place_of_crack<2>(cracked<2>(level(8.25))) == Approx(8.5));  // through the centres: to the upper edge
  const auto plane = [](double y) { return sheet(Vec3(3, y, 13), Vec3(10, 0, 0), Vec3(0, 0, -10), 20); };
  CHECK(place_of_crack<3>(cracked<3>(plane(8.25))) == Approx(8.5));
}

TEST_CASE("a crack stays where it is if no row of particles is the face of a joint", "[cracks][joints]") {
  CHECK(place_of_crack<2>(cracked<2>(level(8.1), false)) == 8.1);  // impulses of a contact law act at the nodes
  CHECK(place_of_crack<2>(cracked<2>(line(Vec3(3, 8.1, 0), Vec3(13, 8.2, 0), 20))) == 8.1);
  CHECK(place_of_crack<2>(cracked<2>(line({Vec3(3, 8.1, 0), Vec3(8, 8.1, 0), Vec3(13, 10, 0)}))) == 8.1);
  Model model = cracked<2>(level(8.1));
  model.cracks.push_back(line(Vec3(8, 8.1, 0), Vec3(8, 13, 0), 10));  // meets it
  CHECK(place_of_crack<2>(model) == 8.1);
}

TEST_CASE("parts of a straight crack with laws of their own move together", "[cracks][joints]") {
  Model model = cracked<2>(line(Vec3(3, 8.1, 0), Vec3(8, 8.1, 0), 10));
  model.cracks.push_back(line(Vec3(8, 8.1, 0), Vec3(13, 8.1, 0), 10));
  const auto system = build_system<2>(model, lattice_seeds<2>(model, 4, 12));
  for (const auto& crack : system.cracks)
    for (std::size_t k = 0; k < crack.main_points; ++k) CHECK(crack.x[k][1] == Approx(8.0));
}

TEST_CASE("a joint stays where it is if rows of particles on both sides of it differ", "[cracks][joints]") {
  const Model model = cracked<2>(level(8.1));
  auto seeds = lattice_seeds<2>(model, 4, 12);
  std::vector<Seed> shifted;
  for (const Seed& seed : seeds) {
    shifted.push_back(seed);
    if (seed.x[0] > 8) shifted.back().x[1] += 0.1;
  }
  CHECK(build_system<2>(model, shifted).cracks[0].x.front()[1] == 8.1);
}
