// SPDX-License-Identifier: MIT
/// Thickness of bodies and rigid faces on their sides, from the particles at the start.

#include "geometry/region.hpp"
#include "materials/material.hpp"
#include "particles/voxels.hpp"

#include <catch2/catch.hpp>

#include <numbers>

using namespace tribo;

namespace {

constexpr int grid_cells = 24;  // of unit size per axis

const Vec3 grid_middle(12, 12, 0);

template <int Dim>
Model model_with(std::vector<RegionPtr> regions) {
  Model model;
  model.analysis = Dim == 2 ? Analysis::plane_strain : Analysis::solid;
  for (std::size_t d = 0; d < Dim; ++d) model.grid.high[d] = grid_cells, model.grid.cells[d] = grid_cells;
  MaterialSpec spec;
  Statement statement;
  for (const auto& [name, value] : {std::pair("rho", "1"), std::pair("E", "1"), std::pair("nu", "0")}) {
    Statement child;
    child.name = name, child.text = value;
    statement.children.push_back(child);
  }
  Problems problems;
  spec.law = materials().find("LinearElastic")->make(statement, {}, Units{}, problems);
  for (std::size_t k = 0; k < regions.size(); ++k) {
    model.materials.push_back(spec);
    Piece piece;
    piece.region = regions[k], piece.material = static_cast<int>(k);
    model.pieces.push_back(piece);
  }
  return model;
}

template <int Dim>
Lattice<Dim> unit_lattice() {
  Index<Dim> number;
  number.fill(grid_cells);
  return {Vec<Dim>::Zero(), Vec<Dim>::Constant(grid_cells), number};
}

// The cubes of the body of each material.
template <int Dim>
std::vector<Voxels<Dim>> voxels_of(const Model& model) {
  std::vector<Voxels<Dim>> out(model.materials.size(), Voxels<Dim>(model, unit_lattice<Dim>()));
  for (const Seed& seed : place_points(model)) out[static_cast<std::size_t>(seed.material)].add(seed);
  for (auto& voxels : out) voxels.sort();
  return out;
}

// Thickness of a body behind its faces at another one.
template <int Dim>
double thickness(const RegionPtr& body, const RegionPtr& other) {
  const auto voxels = voxels_of<Dim>(model_with<Dim>({body, other}));
  return voxels[0].thickness_behind(voxels[1]).value_or(0);
}

bool pressed(RegionPtr body, RegionPtr rigid) {
  const auto voxels = voxels_of<2>(model_with<2>({std::move(body), std::move(rigid)}));
  return voxels[0].lies_between(voxels[1]);
}

RegionPtr turned_region(RegionPtr region, double angle) {
  return move(std::move(region), Vec3::UnitZ(), angle * std::numbers::pi / 180, grid_middle, Vec3::Zero());
}

}  // namespace

TEST_CASE("a plate is as thin as it is at any angle", "[voxels]") {
  const double thick_by = GENERATE(1.0, 2.0, 3.0);
  const double angle = GENERATE(0.0, 17.0, 45.0, 90.0);
  INFO(thick_by << " cells, " << angle << " degrees");
  const auto plate = rectangle(4, 20, 12, 12 + thick_by), floor = rectangle(6, 18, 8, 12);
  const double found = thickness<2>(turned_region(plate, angle), turned_region(floor, angle));
  CHECK(found == Approx(thick_by).margin(angle == 0 || angle == 90 ? 1e-9 : 0.5));  // the edge of a cube
}

TEST_CASE("thickness does not depend on the number of particles", "[voxels]") {
  Model model = model_with<2>({rectangle(4, 20, 12, 14), rectangle(4, 20, 6, 12)});
  model.points_per_cell = GENERATE(1, 4, 9, 16);
  const auto voxels = voxels_of<2>(model);
  CHECK(*voxels[0].thickness_behind(voxels[1]) == Approx(2));
}

TEST_CASE("thickness is measured across the face that touches", "[voxels]") {
  const auto bar = rectangle(4, 16, 12, 14);
  CHECK(thickness<2>(bar, rectangle(16, 20, 10, 16)) == Approx(12).epsilon(0.05));                    // at its end
  CHECK(thickness<2>(bar, rectangle(4, 16, 14, 20)) == Approx(2));                                    // along its side
  CHECK(thickness<2>(bar, unite({rectangle(16, 20, 6, 16), rectangle(4, 16, 6, 12)})) == Approx(2));  // in a corner
  CHECK(thickness<2>(bar, rectangle(4, 16, 17, 20)) == 0);                                            // nowhere
}

TEST_CASE("blocks, discs and balls are not thin, rings and plates in space are", "[voxels]") {
  const auto floor = rectangle(2, 22, 0, 4);
  CHECK(thickness<2>(rectangle(4, 10, 4, 10), floor) == Approx(6));
  CHECK(thickness<2>(oval(4, 16, 4, 16), floor) > 8);
  CHECK(thickness<2>(subtract(oval(2, 22, 2, 22), oval(4, 20, 4, 20)), oval(4, 20, 4, 20)) == Approx(2).epsilon(0.2));
  CHECK(thickness<3>(box(Vec3(4, 4, 4), Vec3(20, 20, 6)), box(Vec3(2, 2, 2), Vec3(22, 22, 4))) == Approx(2));
  CHECK(thickness<3>(ellipsoid(Vec3::Constant(4), Vec3::Constant(14)), box(Vec3(2, 2, 2), Vec3(22, 22, 4))) > 7);
}

TEST_CASE("of several bodies of a material the thinnest counts", "[voxels]") {
  const auto floor = rectangle(2, 22, 0, 4);
  CHECK(thickness<2>(unite({rectangle(2, 8, 4, 12), rectangle(12, 20, 4, 5)}), floor) == Approx(1).epsilon(0.01));
}

TEST_CASE("a body at a symmetry plane is taken with its mirror image", "[voxels]") {
  Model model = model_with<2>({rectangle(4, 20, 0, 2), rectangle(4, 20, 2, 6)});
  auto voxels = voxels_of<2>(model);
  CHECK(*voxels[0].thickness_behind(voxels[1]) == Approx(2));
  model.grid.symmetry[1][0] = 0.0;
  voxels = voxels_of<2>(model);
  CHECK(*voxels[0].thickness_behind(voxels[1]) == Approx(4));
}

TEST_CASE("a rod at the axis of rotation is as thick as its diameter", "[voxels]") {
  Model model = model_with<2>({rectangle(0, 2, 4, 20), rectangle(2, 6, 4, 20)});
  model.analysis = Analysis::axisymmetric;
  const auto voxels = voxels_of<2>(model);
  CHECK(*voxels[0].thickness_behind(voxels[1]) == Approx(4));
}

TEST_CASE("a block between rigid platens lies between them, at any angle", "[voxels]") {
  const auto block = rectangle(6, 18, 8, 16), platens = unite({rectangle(4, 20, 5, 8), rectangle(4, 20, 16, 19)});
  for (const double angle : {0.0, 17.0, 45.0}) {
    INFO(angle);
    CHECK(pressed(turned_region(block, angle), turned_region(platens, angle)));
    CHECK(!pressed(turned_region(block, angle), turned_region(rectangle(4, 20, 5, 8), angle)));
  }
  CHECK(pressed(rectangle(6, 18, 8, 16), unite({rectangle(4, 20, 5, 7.5), rectangle(4, 20, 16, 19)})));  // half a cell
  CHECK(!pressed(rectangle(6, 18, 8, 16), unite({rectangle(4, 20, 4, 6), rectangle(4, 20, 16, 19)})));   // two cells
}

TEST_CASE("a corner, a step and a pin are no rigid faces on opposite sides", "[voxels]") {
  CHECK(!pressed(rectangle(6, 18, 8, 16), unite({rectangle(3, 20, 5, 8), rectangle(3, 6, 8, 20)})));
  CHECK(!pressed(subtract(rectangle(4, 20, 4, 20), oval(8, 16, 8, 16)), oval(8, 16, 8, 16)));
}

TEST_CASE("a block between a platen and a symmetry plane lies between two platens", "[voxels]") {
  Model model = model_with<2>({rectangle(6, 18, 0, 8), rectangle(4, 20, 8, 11)});
  auto voxels = voxels_of<2>(model);
  CHECK(!voxels[0].lies_between(voxels[1]));
  model.grid.symmetry[1][0] = 0.0;
  voxels = voxels_of<2>(model);
  CHECK(voxels[0].lies_between(voxels[1]));
}

TEST_CASE("a plate between rigid blocks in space lies between them", "[voxels]") {
  const auto pressed = [](const RegionPtr& upper) {
    const auto voxels = voxels_of<3>(
        model_with<3>({box(Vec3(4, 4, 8), Vec3(20, 20, 12)), unite({box(Vec3(6, 6, 6), Vec3(10, 10, 8)), upper})}));
    return voxels[0].lies_between(voxels[1]);
  };
  CHECK(pressed(box(Vec3(6, 6, 12), Vec3(10, 10, 14))));
  CHECK(!pressed(box(Vec3(14, 14, 12), Vec3(18, 18, 14))));
}
