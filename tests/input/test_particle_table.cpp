// SPDX-License-Identifier: MIT
#include "base/error.hpp"
#include "input/read.hpp"
#include "output/vtk.hpp"
#include "particles/fill.hpp"
#include "solver/build.hpp"
#include "tests/root.hpp"
#include "tests/scratch.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>

namespace tribo {
namespace {

// A model of 4 x 4 (x 4) cells of edge 1 with one table. `analysis`: 10 plane strain, 13 axisymmetric, 12 in space.
std::string with_table(const std::string& attributes, int analysis = 12,
                       const std::string& material =
                           "<Material Type='LinearElastic' Name='m'><rho>2</rho><E>10</E>"
                           "<nu>0.3</nu></Material>") {
  const std::string axis = analysis == 12 ? "<Depth nz='4'/>" : "", deep = analysis == 12 ? " zmin='0' zmax='4'" : "";
  return "<JANFEAInput version='3'><Header><Analysis>" + std::to_string(analysis) +
         "</Analysis><ConsistentUnits length='m' mass='kg' time='s'/></Header>"
         "<MPMHeader><MaxTime>1</MaxTime><ArchiveTime>1</ArchiveTime><GIMP/></MPMHeader>"
         "<Mesh><Grid xmin='0' xmax='4' ymin='0' ymax='4'" +
         deep + (analysis == 10 ? " thickness='0.5'" : "") + "><Horiz nx='4'/><Vert ny='4'/>" + axis +
         "</Grid></Mesh><MaterialPoints>\n<ParticleTable mat='1' " + attributes + "/></MaterialPoints>" + material +
         "</JANFEAInput>";
}

Seeds particles_of(const std::string& text) { return place_points(read_model_text(text, "deck.xml")); }

// The first problem, from the name of the file on.
std::string problem_of(const std::string& table, const std::string& more = "", int analysis = 12) {
  const ScratchFile file("cloud.csv", table);
  try {
    particles_of(with_table("file='" + file.path + "' " + more, analysis));
  } catch (const InputError& error) {
    const std::string text = error.what();
    const auto at = text.find("cloud.csv:");
    return at == std::string::npos ? text : text.substr(at, text.find('\n') - at);
  }
  return "none";
}

}  // namespace

TEST_CASE("a table of particles gives positions, volumes, velocities and stresses exactly", "[table]") {
  const ScratchFile file("cloud.csv",
                         "# of a scan\nx, y, z, volume, vx, vy, vz, xx, yy, zz, xy, yz, xz\n"
                         "1.1, 1, 1, 0.1, 1, 2, 3, -1, -2, -3, 4, 5, 6\n2.3, 1, 1, 0.3, 0, 0, 0, 0, 0, 0, 0, 0, 0\n");
  const Seeds seeds = particles_of(with_table("file='" + file.path + "'"));
  REQUIRE(seeds.size() == 2);
  CHECK(seeds[0].x == Vec3(1.1, 1, 1));
  CHECK(seeds[0].v == Vec3(1, 2, 3));
  CHECK(seeds[0].volume == 0.1);  // to the last bit
  CHECK(seeds[0].mass == 2 * 0.1);
  CHECK(8 * seeds[0].half_size.prod() == Approx(0.1).epsilon(1e-14));
  CHECK(seeds[0].half_size[0] == Approx(0.5 * std::cbrt(0.1)).epsilon(1e-14));
  Mat3 stress;
  stress << -1, 4, 6, 4, -2, 5, 6, 5, -3;
  CHECK(seeds[0].stress == stress);
  CHECK(seeds[1].volume == 0.3);
  CHECK(seeds[1].piece == -1);
}

TEST_CASE("the sizes of a table of particles give their volumes", "[table]") {
  const ScratchFile edges("cloud.csv", "x,y,z,size_x,size_y,size_z,mass\n1,1,1,0.5,0.25,1,7\n");
  const Seeds one = particles_of(with_table("file='" + edges.path + "' scale='0.5' x='2' vy='4'"));
  CHECK(one[0].x == Vec3(2.5, 0.5, 0.5));
  CHECK(one[0].half_size == Vec3(0.125, 0.0625, 0.25));
  CHECK(one[0].volume == 0.25 * 0.125 * 0.5);
  CHECK(one[0].mass == 7);
  CHECK(one[0].v == Vec3(0, 4, 0));
  // In the plane with the thickness of the grid, axisymmetric with the radius, per radian
  const ScratchFile flat("cloud.csv", "x,y\n1.5,1\n");
  CHECK(particles_of(with_table("file='" + flat.path + "' size='0.5'", 10))[0].volume == 0.125);
  CHECK(particles_of(with_table("file='" + flat.path + "' size='0.5'", 13))[0].volume == 0.375);
  // A volume keeps the ratio of the edges
  const ScratchFile both("cloud.csv", "x,y,size_x,size_y,volume\n1.5,1,1,0.5,0.0625\n");
  const Seed seed = particles_of(with_table("file='" + both.path + "'", 10))[0];
  CHECK(seed.volume == 0.0625);
  CHECK(seed.half_size.isApprox(Vec3(0.25, 0.125, 0.25)));
}

TEST_CASE("history variables of a table of particles reach the particles of the solver", "[table]") {
  const std::string metal =
      "<Material Type='IsoPlasticity' Name='m'><rho>2</rho><E>10</E><nu>0.3</nu><yield>1</yield>"
      "</Material>";
  const ScratchFile file("cloud.csv", "x,y,size,plastic_strain\n1,1,0.5,0.125\n2,1,0.5,0.25\n3,1,0.5,0\n");
  const Model model = read_model_text(with_table("file='" + file.path + "'", 10, metal), "deck.xml");
  const auto system = build_system<2>(model, place_points(model));
  REQUIRE(system.bodies.size() == 1);
  const auto& body = system.bodies[0];
  const auto& variables = body.law->history();
  const auto found =
      std::find_if(variables.begin(), variables.end(), [](const auto& v) { return v.name == "plastic_strain"; });
  REQUIRE(found != variables.end());
  const double* values = body.particles.column(body.history + static_cast<std::size_t>(found - variables.begin()));
  CHECK(std::vector<double>(values, values + 3) == std::vector<double>{0.125, 0.25, 0});
  CHECK(body.total_mass == 3 * 2 * 0.125);
}

TEST_CASE("errors of a table of particles have the place, what is wrong and what is valid", "[table]") {
  CHECK(problem_of("x,y,z,volum\n1,1,1,1\n") ==
        "cloud.csv:1:7: error: a table of particles of this material has no column 'volum' (did you mean 'volume'?); "
        "valid: x, y, z, volume, size, size_x, size_y, size_z, mass, vx, vy, vz, temperature, xx, yy, zz, xy, yz, xz");
  CHECK(problem_of("x,y,z,volume\n1,1,1,1\n1,1,one,1\n") ==
        "cloud.csv:3:5: error: 'one' is not a number; a number is needed in 'z'");
  CHECK(problem_of("x,y,z,volume\n1,1,1,1\n1,1,1,-2\n") == "cloud.csv:3:7: error: the volume must be positive, not -2");
  CHECK(problem_of("x,y,z,volume\n1,1,1\n") == "cloud.csv:2:1: error: this row has 3 cells, its table has 4 columns");
  CHECK(problem_of("x,y,z,z\n1,1,1,1\n") == "cloud.csv:1:7: error: the column 'z' occurs twice");
  CHECK_THAT(problem_of("x,y,volume\n1,1,1\n"), Catch::Contains("the column 'z' of the positions is missing"));
  CHECK_THAT(problem_of("x,y,z\n1,1,1\n"), Catch::Contains("give one of the columns volume, size or size_x"));
  CHECK_THAT(problem_of("x,y,z,size\n1,1,1,1\n", "size='1'"), Catch::Contains("the attribute 'size' is not needed"));
  CHECK_THAT(problem_of("x,y,z,size_x\n1,1,1,1\n"), Catch::Contains("are needed together"));
  CHECK_THAT(problem_of("x,y,z,volume\n"), Catch::Contains("at least one row"));
  CHECK_THAT(problem_of("x,y,z,volume\n1,1,1,1\n1,1,9,1\n"),
             Catch::Contains("cloud.csv:3:1: error: the particle 2 of this table, at (1.0") &&
                 Catch::Contains("lies outside the grid"));
  CHECK_THAT(problem_of("x,y,z,size\n1,1,1,1.1\n"),
             Catch::Contains("cloud.csv:2:1:") && Catch::Contains("1.1 long along x, more than a cell, 1;"));
  CHECK_THAT(problem_of("x,y,volume\n-1,1,1\n", "", 13), Catch::Contains("radii must be positive"));
  CHECK_THAT(problem_of("x,y,z,volume\n1,1,1,1\n", "", 10), Catch::Contains("has no column 'z'"));
  const auto deck = [](const std::string& attributes) {
    try {
      particles_of(with_table(attributes));
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  CHECK_THAT(deck("file='cloud.xyz'"), Catch::Contains("deck.xml:2:24: error: the name of a table of particles ends "
                                                       "with .csv, .txt, .vtp, .vtu or .vtk, not with '.xyz'"));
  CHECK_THAT(deck("file='nowhere.csv'"), Catch::StartsWith("deck.xml:2:24: error: "));
  CHECK_THAT(deck("file='nowhere.vtp'"), Catch::StartsWith("deck.xml:2:24: error: "));
}

TEST_CASE("scripts have tables of particles and groups of meshes", "[table][script]") {
  const ScratchFile file("cloud.csv", "x,y,volume\n1,1,0.01\n2,1,0.0225\n");
  const std::string head =
      "Title \"t\"\nAnalysis \"Plane Strain MPM\"\nConsistentUnits m,kg,s\nMPMMethod \"USL\",\"uGIMP\"\n"
      "TimeStep 1,1,0.4\nArchiveTime 1\nMaterial \"m\",\"m\",\"LinearElastic\"\n  rho 2\n  E 10\n  nu 0.3\nDone\n"
      "GridHoriz 10\nGridVert 8\nGridRect 0,5,0,4\n";
  const Seeds seeds = particles_of(head + "ParticleTable \"m\",\"" + file.path + "\",vx,3,scale,2\n");
  REQUIRE(seeds.size() == 2);
  CHECK(seeds[1].x == Vec3(4, 2, 0));
  CHECK(seeds[1].v == Vec3(3, 0, 0));
  CHECK(seeds[1].volume == Approx(0.09));  // the thickness is not scaled
  CHECK(seeds[1].half_size[0] == Approx(0.15));
  CHECK_THROWS_WITH(particles_of(head + "ParticleTable \"m\",\"" + file.path + "\",vx\n"),
                    Catch::Contains("after the file come pairs: a name and its value"));
  CHECK_THROWS_WITH(particles_of(head + "Region \"m\",0,0\nParticleTable \"m\",\"" + file.path + "\"\nEndRegion\n"),
                    Catch::Contains("stands outside of 'Region'"));
  // A body from a mesh with a rectangle cut out, and a mesh that is cut out of a rectangle
  const std::string mesh = (test::source_root() / "tests/geometry/data/plate.msh").string();
  const auto volume_of = [](const Seeds& all) {
    double sum = 0;
    for (const Seed& seed : all) sum += seed.volume;
    return sum;
  };
  CHECK(volume_of(particles_of(head + "Region \"m\",0,0\nSurface \"" + mesh +
                               "\",1,0.5,1,0,\"right half\"\nCut Rect 3,4,1.5,2\nEndRegion\n")) == Approx(3.5));
  CHECK(volume_of(particles_of(head + "Region \"m\",0,0\nRect 0,5,0,4\nCut Surface \"" + mesh +
                               "\",1,0.5,1,0,\"right half\"\nEndRegion\n")) == Approx(16));
}

TEST_CASE("a block of a particle file is a table of particles", "[table]") {
  const ScratchFolder scratch;
  const auto file = scratch.path / "run_000003_1.vtp";
  const std::vector<double> x{1, 1, 0, 2, 1, 0}, volume{0.1, 0.2}, stress{1, 2, 3, 4, 0, 0, 5, 6, 7, 8, 0, 0};
  const std::vector<float> velocity{1, 2, 0, 3, 4, 0}, size{0.5, 0.5, 0, 0.5, 1, 0};
  const std::vector<std::int64_t> id{7, 8};
  const std::vector<OutputField> fields{{"volume", {}, nullptr, nullptr, {volume.data(), nullptr, 1}},
                                        {"stress", {}, nullptr, nullptr, {stress.data(), nullptr, 6}},
                                        {"velocity", {}, nullptr, nullptr, {nullptr, velocity.data(), 3}},
                                        {"size", {}, nullptr, nullptr, {nullptr, size.data(), 3}},
                                        {"id", {}, id.data()}};
  write_particles(file, 2, {x.data(), nullptr, 3}, fields, 0.5, std::vector<std::string>{"m"});
  const Seeds seeds = particles_of(with_table("file='" + file.string() + "'", 10));
  REQUIRE(seeds.size() == 2);
  CHECK(seeds[1].x == Vec3(2, 1, 0));
  CHECK(seeds[1].v == Vec3(3, 4, 0));
  CHECK(seeds[1].volume == 0.2);
  CHECK(seeds[1].half_size[1] == Approx(2 * seeds[1].half_size[0]));
  CHECK(seeds[1].stress(0, 1) == 8);
  CHECK(seeds[0].stress(2, 2) == 3);
}

TEST_CASE("a file of the older format of VTK is a table of particles", "[table]") {
  const ScratchFile file(
      "grains.vtk",
      "# vtk DataFile Version 4.2\ngrains\nASCII\nDATASET POLYDATA\nPOINTS 2 double\n1 1 0 2 1 0\n"
      "POINT_DATA 2\nSCALARS volume double 1\nLOOKUP_TABLE default\n0.1 0.2\nVECTORS velocity double\n"
      "1 2 0 3 4 0\nTENSORS stress double\n1 4 0 4 2 0 0 0 3\n5 8 0 8 6 0 0 0 7\n");
  const Seeds seeds = particles_of(with_table("file='" + file.path + "'", 10));
  REQUIRE(seeds.size() == 2);
  CHECK(seeds[1].x == Vec3(2, 1, 0));
  CHECK(seeds[1].v == Vec3(3, 4, 0));
  CHECK(seeds[1].volume == 0.2);
  CHECK(seeds[1].stress(0, 0) == 5);
  CHECK(seeds[1].stress(0, 1) == 8);
  CHECK(seeds[0].stress(2, 2) == 3);
}

}  // namespace tribo
