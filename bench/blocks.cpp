// SPDX-License-Identifier: MIT
/// What rigid blocks cost: steps of bonded Voronoi cells in a periodic box, sheared slowly. Contact updates per second
/// and core: a contact's increment, law and forces, and its share of the motion of the blocks.
///
///   bench_blocks <2|3> <blocks> <Poisson's ratio> [threads]

#include "base/parallel.hpp"
#include "blocks/assembly.hpp"
#include "contact/joint_law.hpp"
#include "cpu_time.hpp"
#include "geometry/point_sets.hpp"

#include <algorithm>
#include <cstdio>
#include <string>

using namespace tribo;

namespace {

std::shared_ptr<const JointLaw> bonds(const std::string& poisson) {
  Statement statement;
  for (const auto& [key, value] :
       {std::pair<std::string, std::string>("compute-stiffness", "emod 50e9 poisson " + poisson),
        {"sn_ten", "1e30"},
        {"sn_coh", "1e30"},
        {"bond", "gap 1"}}) {
    Statement child;
    child.name = key, child.text = value;
    statement.children.push_back(child);
  }
  Problems problems;
  std::shared_ptr<const JointLaw> law = joint_laws().find("SpringNetwork")->make(statement, {}, Units{}, problems);
  problems.raise();
  return law;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 4) {
    std::fprintf(stderr, "usage: bench_blocks <2|3> <blocks> <Poisson's ratio> [threads]\n");
    return 2;
  }
  const bool plane = std::string(argv[1]) == "2";
  const auto count = static_cast<std::size_t>(std::stoul(argv[2]));
  set_threads(argc > 4 ? std::stoi(argv[4]) : 1);
  const Vec3 low = Vec3::Zero(), high(1, 1, plane ? 0 : 1);
  const auto nuclei = random_points(count, low, high, plane, 0.6, 1);
  const std::array<bool, 3> periodic{true, true, !plane};
  Assembly blocks(voronoi(nuclei, low, high, plane, 1.0, periodic), nuclei, bonds(argv[3]), plane, false, 1.0, 0);
  blocks.box_rate(0, 1) = 1e-6;
  const double dt = 0.5 * blocks.critical_step();
  for (int k = 0; k < 20; ++k) blocks.advance(dt);
  const int steps = std::max(20, static_cast<int>(2e7 / static_cast<double>(blocks.contacts.size())) / 5);
  std::vector<double> rates;
  for (int run = 0; run < 5; ++run) {
    const double start = cpu_seconds();
    for (int k = 0; k < steps; ++k) blocks.advance(dt);
    rates.push_back(1e-6 * static_cast<double>(blocks.contacts.size()) * steps / (cpu_seconds() - start));
  }
  std::sort(rates.begin(), rates.end());
  std::printf(
      "%zu blocks, %zu contacts, %.3g bytes each contact: %.2f (%.2f ... %.2f) million contact updates per second and "
      "core\n",
      blocks.block_count(), blocks.contacts.size(), blocks.bytes() / static_cast<double>(blocks.contacts.size()),
      rates[2], rates.front(), rates.back());
}
