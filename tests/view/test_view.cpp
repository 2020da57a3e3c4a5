// SPDX-License-Identifier: MIT
/// Cameras, ranges of colours, charts and tables of reports.

#include "base/error.hpp"
#include "output/atomic_file.hpp"
#include "pictures.hpp"
#include "scratch.hpp"
#include "view/chart.hpp"
#include "view/report.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <fstream>

using namespace tribo;
using namespace tribo::test;

TEST_CASE("the distance of neighbours is found", "[view]") {
  CHECK(spacing_of(small_frame().position) == Approx(2));
  std::vector<std::array<double, 3>> cube;
  for (int k = 0; k < 1000; ++k) cube.push_back({0.5 * (k % 10), 0.5 * (k / 10 % 10), 0.5 * (k / 100)});
  CHECK(spacing_of(cube) == Approx(0.5));
  CHECK(spacing_of({}) == 0);
  CHECK(spacing_of({{1, 2, 3}, {1, 2, 3}}) == 0);
}

TEST_CASE("cameras have right-handed, orthonormal axes", "[view]") {
  for (const char* view : {"xy", "xz", "yz", "iso", "iso-z"}) {
    const Camera c = camera(view);
    CHECK((c.right.cross(c.up) - c.eye).norm() < 1e-14);
    CHECK(c.right.norm() == Approx(1));
  }
  CHECK(camera("iso").project({0, 1, 0})[1] > 0.5);  // y up
  CHECK(camera("iso-z").project({0, 0, 1})[1] > 0.5);
  CHECK_THROWS_AS(camera("top"), UsageError);
}

TEST_CASE("a shade is a scalar, a length or a component", "[view]") {
  const ParticleFrame frame = small_frame();
  CHECK(shade_of(frame, "von_mises").values == std::vector<double>{0, 1, 2, 0, 1, 2});
  CHECK(shade_of(frame, "velocity").values[3] == 5);
  CHECK(shade_of(frame, "velocity.y").values[3] == 4);
  CHECK(shade_of(frame, "material").integers);
  CHECK_THROWS_WITH(shade_of(frame, "von_misses"), Catch::Contains("did you mean 'von_mises'?"));
  CHECK_THROWS_WITH(shade_of(frame, "velocity.xx"), Catch::Contains("it has: x, y, z"));
  CHECK_THROWS_AS(shade_of(frame, "von_mises.x"), UsageError);
}

TEST_CASE("the range leaves outliers out and is never empty", "[view]") {
  std::vector<double> values(1000, 1.0);
  values[0] = -1e9, values[1] = 1e9, values[2] = NAN, values[3] = 2.0;
  const Range range = range_of(values);
  CHECK(range[0] < 1);
  CHECK(range[1] > 1);
  CHECK(range[1] < 10);
  CHECK(range_of({})[1] > range_of({})[0]);
  CHECK(range_of({0.0, 1.84}) == Range{0.0, 1.84});  // of few values none is left out
}

TEST_CASE("a constant field has a range around its value with ticks", "[view]") {
  for (const double value : {0.0, 5.0, -3e7, 2e-9}) {
    const Range range = range_of(std::vector<double>(20, value));
    CHECK(0.5 * (range[0] + range[1]) == Approx(value).margin(1e-300));
    CHECK(range[1] - range[0] == Approx(value == 0 ? 2 : std::abs(value)));
    CHECK(ticks(range[0], range[1], 4).size() >= 2);
  }
  // Rounding is no variation, a millionth is the limit.
  CHECK(range_of({1.0, 1.0 + 1e-9})[1] == Approx(1.5));
  CHECK(range_of({1.0, 1.0 + 1e-5, 1.0 + 1e-5})[1] < 1.1);
}

TEST_CASE("a field that is constant in one picture does not widen the range of all pictures", "[view]") {
  std::optional<Range> range;
  CHECK(widened(range) == Range{0, 1});
  extend(range, {});
  CHECK_FALSE(range);
  extend(range, std::vector<double>(20, 0.0));  // displacements at the start
  CHECK(widened(range) == Range{-1, 1});
  std::vector<double> later(1001);
  for (std::size_t k = 0; k < later.size(); ++k) later[k] = 1e-3 * static_cast<double>(k);
  extend(range, later);
  CHECK(widened(range)[0] == 0);
  CHECK(widened(range)[1] == Approx(0.995));
  extend(range, {-0.5, -0.5});
  CHECK(widened(range)[0] == -0.5);
  CHECK(widened(range)[1] == Approx(0.995));
}

TEST_CASE("without a chosen field one is drawn that the run has", "[view]") {
  Scene scene;
  scene.particles = small_frame();
  CHECK(default_field(scene) == "von_mises");
  auto& fields = scene.particles.fields;
  fields.erase(fields.begin());
  CHECK(default_field(scene) == "velocity");
  fields.erase(fields.begin());
  CHECK(default_field(scene) == "material");
  fields.push_back({"plastic_strain", 1, false, std::vector<double>(6, 1.0)});
  CHECK(default_field(scene) == "plastic_strain");
  fields = {{"stress", 6, false, std::vector<double>(36, 1.0)}};
  CHECK(default_field(scene) == "stress.xx");
  CHECK(picture(scene, {}).size() > 1000);
  fields.clear();
  CHECK_THROWS_AS(default_field(scene), UsageError);
}

TEST_CASE("units and names of materials of a run are read from its record", "[view]") {
  const ScratchFolder scratch;
  std::ofstream(scratch.path / "run.pvd") << "";
  std::ofstream(scratch.path / "provenance.json")
      << R"({"model": {"unit of time": "s", "unit of length": "m"}, "materials": ["clay", "sand"],
             "unit_of": {"stress": "Pa", "velx:clay": "m/s"}})";
  const Legend legend = RunFolder(scratch.path).legend();
  CHECK(legend.time == "s");
  CHECK(legend.length == "m");
  CHECK(legend.materials == std::vector<std::string>{"clay", "sand"});
  CHECK(legend.unit_of("stress.xy") == "Pa");
  CHECK(legend.unit_of("velx:clay") == "m/s");
  CHECK(legend.unit_of("volume_ratio").empty());
  // Records of earlier versions have none.
  std::ofstream(scratch.path / "provenance.json") << "{}";
  CHECK(RunFolder(scratch.path).legend().unit_of("stress").empty());

  // The charts of the report have the units.
  std::ofstream(scratch.path / "provenance.json")
      << R"({"model": {"unit of time": "s"}, "unit_of": {"velx:clay": "m/s", "kinetic": "J"}})";
  std::ofstream(scratch.path / "history.csv") << "time,velx:clay,bonds\n0,1,2\n1,2,2\n";
  std::ofstream(scratch.path / "energy.csv") << "time,kinetic,residual\n0,1,0\n1,2,0\n";
  const std::string charts = report_charts(RunFolder(scratch.path));
  for (const char* text : {"velx [m/s]<", "bonds<", "time [s]<", "energies [J]<"})
    CHECK(charts.find(text) != std::string::npos);
}

TEST_CASE("rigid bodies have no stress in pictures", "[view]") {
  ParticleFrame frame;
  frame.position.resize(3);
  frame.fields = {
      {"stress", 2, false, {1, 2, 3, 4, 5, 6}}, {"velocity", 1, false, {7, 8, 9}}, {"material", 1, true, {1, 2, 3}}};
  Legend legend;
  legend.materials = {"sand", "floor", "water"}, legend.rigid_materials = {"floor"};
  remove_values_of_rigid_materials(frame, legend);
  const auto& stress = frame.fields[0].values;
  CHECK(std::isnan(stress[2]));
  CHECK(std::isnan(stress[3]));
  CHECK((stress[0] == 1 && stress[1] == 2 && stress[4] == 5 && stress[5] == 6));
  CHECK(frame.fields[1].values == std::vector<double>{7, 8, 9});
  CHECK(frame.fields[2].values == std::vector<double>{1, 2, 3});
}

TEST_CASE("ticks are round", "[view]") {
  const auto t = ticks(0.13, 0.97, 5);
  REQUIRE(t.size() == 4);
  CHECK(t.front() == Approx(0.2));
  CHECK(t.back() == Approx(0.8));
  CHECK(ticks(1, 1, 5).size() == 1);
}

TEST_CASE("a chart keeps its peaks and leaves gaps", "[view]") {
  std::vector<double> x, y;
  for (int k = 0; k < 100000; ++k) x.push_back(k), y.push_back(k == 34567 ? 7.0 : 0.0);
  const std::string svg = chart("a < b", "time", x, {{"spike", y}});
  CHECK(svg.find("a &lt; b") != std::string::npos);
  CHECK(svg.size() < 40000);
  // the spike's top: 4 % below the upper edge of the frame
  CHECK(svg.find(" 42.1") != std::string::npos);
  y[34567] = NAN;
  CHECK(chart("t", "time", x, {{"gap", y}}).find("nan") == std::string::npos);
}

TEST_CASE("tables are read back, without a torn last line", "[view]") {
  const ScratchFolder scratch;
  const auto file = scratch.path / "t.csv";
  std::ofstream(file) << "time,\"velx:a,b\"\n0,1\n1,2.5\n2,";
  const ResultTable table = read_table(file);
  CHECK(table.names == std::vector<std::string>{"time", "velx:a,b"});
  REQUIRE(table.rows() == 2);
  CHECK((*table.column("velx:a,b"))[1] == 2.5);
  CHECK_FALSE(table.column("vely"));
  CHECK_THROWS_AS(read_table(scratch.path / "none.csv"), FileError);
  CHECK_THROWS_WITH(RunFolder(scratch.path), Catch::Contains("not the folder of a run"));
}

TEST_CASE("pictures and films of render are known by their marks", "[view]") {
  const ScratchFolder folder;
  ParticleFrame frame;
  frame.position = {{0, 0, 0}, {1, 1, 0}};
  frame.fields.push_back({"mass", 1, false, {1, 2}});
  PictureOptions options;
  options.field = "mass", options.width = 200;
  const std::string png = picture(frame, options);
  const auto file = folder.path / "a.png", film = folder.path / "a.mp4";
  write_atomically(file, png);
  CHECK(!is_rendered(file));
  write_atomically(file, marked_as_rendered(png));
  CHECK(is_rendered(file));
  write_atomically(film, "a film" + film_mark());
  CHECK(is_rendered(film));
  write_atomically(film, "a film" + film_mark() + ".");
  CHECK(!is_rendered(film));
  CHECK(!is_rendered(folder.path / "none"));
  CHECK(!is_rendered(folder.path));
}
