// SPDX-License-Identifier: MIT
/// What tests of blocks share: laws, nuclei, descriptions.
#pragma once

#include "blocks/assembly.hpp"
#include "contact/joint_cases.hpp"

#include <cmath>
#include <random>
#include <string>

namespace tribo::test {

inline std::shared_ptr<const JointLaw> joint_law(const char* type, const Properties& properties) {
  Problems problems;
  std::shared_ptr<const JointLaw> law =
      joint_laws().find(type)->make(joint_statement(properties), {}, Units{}, problems);
  problems.raise();
  return law;
}

/// Bonds of an elastic body that do not break.
inline std::shared_ptr<const JointLaw> elastic_bonds(double E, double nu, double off_diagonal = 1.0) {
  return joint_law("SpringNetwork",
                   {{"compute-stiffness", "emod " + std::to_string(E) + " poisson " + std::to_string(nu)},
                    {"sn_ten", "1e30"},
                    {"sn_coh", "1e30"},
                    {"sn_non_diag", std::to_string(off_diagonal)},
                    {"bond", "gap 1"}});
}

/// Points in a box that keep a distance.
inline std::vector<Vec3> scattered(std::size_t count, const Vec3& size, bool plane, double apart, unsigned seed = 7) {
  std::mt19937 random(seed);
  std::vector<Vec3> out;
  while (out.size() < count) {
    Vec3 x;
    for (int d = 0; d < 3; ++d) x[d] = size[d] * static_cast<double>(random()) / 4294967296.0;
    if (plane) x[2] = 0;
    bool free = true;
    for (const Vec3& y : out) free = free && (x - y).norm() > apart;
    if (free) out.push_back(x);
  }
  return out;
}

/// Centres of hexagons with flat tops, `spacing` between the flats, `columns` x `rows` of them, and the box they fill.
struct Honeycomb {
  std::vector<Vec3> nuclei;
  Vec3 size;
  Honeycomb(int columns, int rows, double spacing) {
    const double across = spacing * std::sqrt(3.0) / 2;
    size = Vec3(columns * across, rows * spacing, 0);
    for (int i = 0; i < columns; ++i)
      for (int j = 0; j < rows; ++j) nuclei.emplace_back((i + 0.5) * across, (j + (i % 2 ? 0.75 : 0.25)) * spacing, 0);
  }
};

inline TimeFunction constant(double value) { return {Expression(value), 1.0, 1.0}; }

inline RegionPtr around(double xmin, double xmax, double ymin, double ymax) {
  return rectangle(xmin, xmax, ymin, ymax);
}

/// A specimen between platens at its lower and upper ends.
inline std::shared_ptr<BlocksSpec> specimen(const std::vector<Vec3>& nuclei, const Vec3& size,
                                            std::shared_ptr<const JointLaw> law) {
  auto spec = std::make_shared<BlocksSpec>();
  BlockGroup group;
  group.shape = BlockGroup::Shape::voronoi;
  group.high = size, group.points = nuclei, group.density = 2500;
  spec->groups.push_back(group);
  spec->laws.initial = std::move(law);
  const double e = 1e-6 * size.norm();
  for (const double y : {0.0, size[1]}) {
    BlockPlaten platen;
    platen.where = around(-e, size[0] + e, y - e, y + e);
    spec->platens.push_back(platen);
  }
  return spec;
}

}  // namespace tribo::test
