// SPDX-License-Identifier: MIT
#include "base/error.hpp"
#include "output/atomic_file.hpp"
#include "scratch.hpp"
#include "view/chart.hpp"
#include "view/colours.hpp"
#include "view/outer_domains.hpp"
#include "view/picture.hpp"
#include "view/report.hpp"

#include <png.h>
#include <catch2/catch.hpp>

#include <cmath>
#include <cstring>
#include <fstream>

using namespace tribo;

namespace {

// Two rows of three particles a distance of 2 apart; von_mises grows from left to right.
ParticleFrame small_frame() {
  ParticleFrame frame;
  frame.time = 1.5;
  frame.fields = {{"von_mises", 1, false, {}}, {"velocity", 3, false, {}}, {"material", 1, true, {}}};
  for (int j = 0; j < 2; ++j)
    for (int i = 0; i < 3; ++i) {
      frame.position.push_back({2.0 * i, 2.0 * j, 0.0});
      frame.fields[0].values.push_back(i);
      for (const double v : {3.0, 4.0, 0.0}) frame.fields[1].values.push_back(v);
      frame.fields[2].values.push_back(1 + j);
    }
  return frame;
}

struct Pixels {
  int width = 0, height = 0;
  std::vector<Colour> colours;
  Colour at(double x, double y) const {
    return colours[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)];
  }
};

Pixels read_png(const std::string& bytes) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  REQUIRE(png_image_begin_read_from_memory(&image, bytes.data(), bytes.size()));
  image.format = PNG_FORMAT_RGB;
  Pixels out{static_cast<int>(image.width), static_cast<int>(image.height), {}};
  out.colours.resize(static_cast<std::size_t>(image.width) * image.height);
  REQUIRE(png_image_finish_read(&image, nullptr, out.colours.data(), 0, nullptr));
  return out;
}

int count(const Pixels& pixels, const Colour& colour) {
  return static_cast<int>(std::count(pixels.colours.begin(), pixels.colours.end(), colour));
}

}  // namespace

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

TEST_CASE("materials have their names beside the picture", "[view]") {
  // The names are text in a grey that no particle has: more letters, more dark pixels on the right.
  PictureOptions options;
  options.field = "material";
  const auto dark = [&] {
    const Pixels p = read_png(picture(small_frame(), options));
    int n = 0;
    for (int y = 36; y < p.height; ++y)
      for (int x = p.width - 84; x < p.width; ++x) n += p.at(x, y)[0] < 128 && p.at(x, y)[2] < 128;
    return n;
  };
  const int numbers = dark();
  options.materials = {"clay", "gravel"};
  const int names = dark();
  CHECK(names > 2 * numbers);
  options.materials = {"clay"};  // the second has no name
  CHECK(dark() < names);
  CHECK(dark() > numbers);
  options.materials = {"clay", "a very long name of a material that does not fit beside it"};
  const Pixels p = read_png(picture(small_frame(), options));
  for (int y = 36; y < p.height; ++y) CHECK(p.at(p.width - 2, y) == Colour{255, 255, 255});
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

TEST_CASE("a picture shows particles where they are, in the colours of their values", "[view]") {
  const ParticleFrame frame = small_frame();
  PictureOptions options;
  options.range = Range{0, 2};
  const Pixels p = read_png(picture(frame, options));
  CHECK(p.width <= 901);
  CHECK(p.width % 2 == 0);
  CHECK(p.height % 2 == 0);
  // low, middle and high value cover the same area, apart from the scale
  const int low = count(p, viridis(0)), middle = count(p, viridis(0.5)), high = count(p, viridis(1));
  CHECK(low > 10000);
  CHECK(middle == Approx(low).epsilon(0.2));
  CHECK(high == Approx(low).epsilon(0.2));
  const double y = 0.5 * p.height;
  CHECK(p.at(64 + 0.1 * (p.width - 182), y - 40) == viridis(0));
  CHECK(p.at(64 + 0.9 * (p.width - 182), y - 40) == viridis(1));

  options.field = "material";
  const Pixels m = read_png(picture(frame, options));
  CHECK(m.at(64 + 0.5 * (m.width - 182), 44 + 0.75 * (m.height - 88)) == distinct(0));  // y points up
  CHECK(m.at(64 + 0.5 * (m.width - 182), 44 + 0.25 * (m.height - 88)) == distinct(1));
}

TEST_CASE("domains are drawn where they are, with their area and without holes", "[view]") {
  // Two particles at a distance of 3 and 1.5 high, sheared by 0.5: together a parallelogram of the area 9
  ParticleFrame frame;
  frame.position = {{0, 0, 0}, {3, 0, 0}};
  frame.fields = {{"material", 1, true, {1, 2}}};
  const HalfAxes axes{{{1.5, 0, 0}, {0.375, 0.75, 0}, {0, 0, 0}}};
  frame.domains = {axes, axes};
  const auto box = box_of(frame);
  CHECK(box[0] == std::array<double, 3>{-1.875, -0.75, 0});
  CHECK(box[1] == std::array<double, 3>{4.875, 0.75, 0});

  PictureOptions options;
  options.field = "material", options.width = 1200;
  const Pixels p = read_png(picture(frame, options));
  // The sheet: the box, 0.8 times the width of a domain around it and 2 % of its width, after 64 pixels on the left,
  // with 118 on the right.
  const double around = 0.8 * std::sqrt(4.5), margin = around + 0.02 * (6.75 + 2 * around);
  const double scale = (1200 - 182) / (6.75 + 2 * margin);
  const double x0 = 64 + (1.875 + margin) * scale, y0 = 44 + (0.75 + margin) * scale;
  const auto at = [&](double x, double y) { return p.at(x0 + x * scale, y0 - y * scale); };
  CHECK(at(-1.0, -0.6) == distinct(0));
  CHECK(at(1.7, 0.7) == distinct(0));   // sheared to the right above, by 0.5 times the height
  CHECK(at(1.3, -0.7) == distinct(1));  // and to the left below
  CHECK(at(4.7, 0.7) == distinct(1));
  CHECK(at(-1.6, 0.6) == Colour{255, 255, 255});
  CHECK(at(4.6, -0.6) == Colour{255, 255, 255});
  for (const int k : {0, 1}) CHECK(count(p, distinct(k)) == Approx(4.5 * scale * scale).epsilon(0.02));
  // No pixel between the two is empty.
  for (double x = -1.2; x < 4.2; x += 0.01) CHECK(at(x, 0) != Colour{255, 255, 255});

  // Matter that is a particle apart stays apart.
  frame.position[1][0] = 6;
  const Pixels apart = read_png(picture(frame, options));
  for (const int k : {0, 1}) CHECK(count(apart, distinct(k)) > 1000);
  const double border = around + 0.02 * (9.75 + 2 * around), wide = (1200 - 182) / (9.75 + 2 * border);
  CHECK(apart.at(64 + (1.875 + border + 3) * wide, 44 + (0.75 + border) * wide) == Colour{255, 255, 255});
}

TEST_CASE("slits between stretched domains that are shorter than the domains are filled", "[view]") {
  // Three rows of domains with an area of 2; in the middle one there is a slit of 2 at the centre of the picture.
  const auto centre = [](double half_length, double half_height) {
    ParticleFrame frame;
    for (int row = 0; row < 3; ++row)
      for (const double x : {-1.0, 1.0})
        frame.position.push_back({x * (half_length + (row == 1 ? 1.0 : 0.0)), 2 * half_height * row, 0});
    frame.domains.assign(6, HalfAxes{{{half_length, 0, 0}, {0, half_height, 0}, {0, 0, 0}}});
    frame.fields = {{"material", 1, true, std::vector<double>(6, 1.0)}};
    PictureOptions options;
    options.field = "material", options.width = 1200;
    const Pixels p = read_png(picture(frame, options));
    const double wide = 4 * half_length + 2, high = 6 * half_height;
    const double ratio = half_length / half_height;
    const double around = std::max(0.8 * std::sqrt(2.0), ratio > 2 ? 0.8 * half_length : 0.0);
    const double margin = around + 0.02 * (wide + 2 * around), scale = (1200 - 182) / (wide + 2 * margin);
    return p.at(64 + 0.5 * (1200 - 182), 44 + 0.5 * (high + 2 * margin) * scale);
  };
  CHECK(centre(2, 0.25) == distinct(0));
  CHECK(centre(std::sqrt(0.5), std::sqrt(0.5)) == Colour{255, 255, 255});
}

TEST_CASE("gaps of up to 0.8 of a domain are filled within a body, up to 0.6 between two bodies", "[view]") {
  // Two domains with edges of 2 and a gap between them, which is in the middle of the picture.
  const auto centre = [](double gap, double other_material) {
    ParticleFrame frame;
    frame.position = {{-1 - gap / 2, 0, 0}, {1 + gap / 2, 0, 0}};
    frame.domains.assign(2, HalfAxes{{{1, 0, 0}, {0, 1, 0}, {0, 0, 0}}});
    frame.fields = {{"material", 1, true, {1, other_material}}};
    PictureOptions options;
    options.field = "material", options.width = 1200;
    const Pixels p = read_png(picture(frame, options));
    const double margin = 1.6 + 0.02 * (4 + gap + 3.2), scale = (1200 - 182) / (4 + gap + 2 * margin);
    return p.at(64 + 0.5 * (1200 - 182), 44 + (1 + margin) * scale);
  };
  CHECK(centre(1.4, 1) == distinct(0));
  CHECK(centre(1.4, 2) == Colour{255, 255, 255});
  CHECK(centre(0.7, 2) != Colour{255, 255, 255});
}

TEST_CASE("in space, domains are boxes whose nearer sides hide the others", "[view]") {
  ParticleFrame frame;
  frame.position = {{0, 0, 0}, {0, 0, 2}};
  frame.fields = {{"material", 1, true, {1, 2}}};
  frame.domains.assign(2, HalfAxes{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}});
  PictureOptions options;
  options.field = "material", options.view = "xy";  // the eye is at +z
  const auto bluish = [](const Colour& c) { return c[2] > 1.3 * c[0]; };
  const auto blue = [&] {
    const Pixels p = read_png(picture(frame, options));
    return std::count_if(p.colours.begin(), p.colours.end(), bluish);
  };
  CHECK(blue() < 1000);  // the nearer box hides the other; the list of names has a blue square
  frame.domains[0][2] = {0, 0, 4};
  CHECK(blue() > 100000);
  // A box of the other orientation shows the same sides.
  frame.domains[0][2] = {0, 0, -4};
  CHECK(blue() > 100000);
}

TEST_CASE("a window shows a part of a picture in the same proportions", "[view]") {
  const ParticleFrame frame = small_frame();  // x from 0 to 4, y from 0 to 2
  const auto box = box_of(frame);
  PictureOptions options;
  options.range = Range{0, 2};
  options.window = chosen_window({{1.5, 2.5, -0.5, 0.5}, 1.0, {}}, "xy", box);
  const Pixels p = read_png(picture(frame, options));
  CHECK(count(p, viridis(0.5)) > 100000);  // the middle particle of the lower row fills it
  const Window twice = chosen_window({{}, 2.0, {}}, "xy", box), all = window_around(camera("xy"), box);
  CHECK(twice.right - twice.left == Approx(0.5 * (all.right - all.left)));
  CHECK(0.5 * (twice.left + twice.right) == Approx(2));
  CHECK(chosen_window({{}, 2.0, {4, 2}}, "xy", box).high + chosen_window({{}, 2.0, {4, 2}}, "xy", box).low ==
        Approx(4));
  using Catch::Contains;
  CHECK_THROWS_WITH(chosen_window({{2, 1, 0, 1}, 1.0, {}}, "xy", box), Contains("x goes from 2 to 1"));
  CHECK_THROWS_WITH(chosen_window({{7, 8, 0, 1}, 1.0, {}}, "xy", box),
                    Contains("nothing lies in it") && Contains("x from 0 to 4, y from 0 to 2"));
  CHECK_THROWS_WITH(chosen_window({{0, 1, 0, 1}, 1.0, {}}, "iso", box), Contains("use --zoom and --centre"));
  CHECK_THROWS_WITH(chosen_window({{}, 0.0, {}}, "xy", box), Contains("must be above 0, not 0"));
  CHECK_THROWS_WITH(chosen_window({{}, 2.0, {9, 1}}, "xy", box), Contains("x = 9 lies outside of the particles"));
}

TEST_CASE("outer domains are cut by the planes of their neighbours and extended to them", "[view]") {
  const Polyhedron cube{{{0, 0, 0}, {0, 1, 0}, {1, 1, 0}, {1, 0, 0}}, {{0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}},
                        {{0, 0, 0}, {1, 0, 0}, {1, 0, 1}, {0, 0, 1}}, {{0, 1, 0}, {0, 1, 1}, {1, 1, 1}, {1, 1, 0}},
                        {{0, 0, 0}, {0, 0, 1}, {0, 1, 1}, {0, 1, 0}}, {{1, 0, 0}, {1, 1, 0}, {1, 1, 1}, {1, 0, 1}}};
  const Polyhedron half = clipped(cube, {Vec3(0, 0, 0.5), Vec3(0, 0, 1)});
  CHECK(half.size() == 6);
  for (const auto& face : half)
    for (const Vec3& x : face) CHECK(x[2] <= 0.5);
  CHECK(clipped(cube, {Vec3(1, 1, 1) * 0.9, Vec3(1, 1, 1).normalized()}).size() == 7);  // a corner is cut off
  CHECK(clipped(cube, {Vec3(0, 0, -1), Vec3(0, 0, 1)}).empty());
  // A block of 5 x 5 x 5: its faces stay where they are, and the particle in the middle is none of the outer ones
  ParticleFrame frame;
  for (int i = 0; i < 125; ++i) frame.position.push_back({1.0 * (i % 5), 1.0 * (i / 5 % 5), 1.0 * (i / 25)});
  frame.domains.assign(125, HalfAxes{{{0.5, 0, 0}, {0, 0.5, 0}, {0, 0, 0.5}}});
  frame.domains[112] = HalfAxes{{{0.5, 0, 0.2}, {0, 0.5, 0}, {0, 0, 0.5}}};  // in the middle of a face, sticks out
  const OuterDomains outer(frame);
  CHECK_FALSE(outer.is_outer(62));
  CHECK(outer.is_outer(112));
  for (const double extension : {0.0, 0.5})
    for (std::size_t i = 0; i < 125; ++i)
      if (outer.is_outer(i))
        for (const auto& face : outer.domain(i, extension))
          for (const Vec3& x : face) {
            CHECK(x.maxCoeff() < 4.5 + 1e-9);
            CHECK(x.minCoeff() > -0.5 - 1e-9);
          }
}

TEST_CASE("in space, the nearer ball hides the farther one", "[view]") {
  ParticleFrame frame = small_frame();
  frame.position = {{0, 0, 0}, {0, 0, 5}, {8, 0, 0}, {8, 0, 5}, {0, 8, 0}, {0, 8, 5}};
  frame.fields[2].values = {1, 2, 1, 2, 1, 2};
  PictureOptions options;
  options.field = "material", options.view = "xy";  // the eye is at +z
  const Pixels p = read_png(picture(frame, options));
  const auto bluish = [](const Colour& c) { return c[2] > 1.3 * c[0]; };
  const auto n = std::count_if(p.colours.begin(), p.colours.end(), bluish);
  CHECK(n < 1000);  // material 1 is blue: only its square in the list of names
  options.view = "iso";
  const Pixels q = read_png(picture(frame, options));
  CHECK(std::count_if(q.colours.begin(), q.colours.end(), bluish) > 1000);
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

TEST_CASE("The legend of categories lists as many as fit, and says how many more there are", "[view]") {
  Scene scene;
  PictureOptions options;
  options.field = "material", options.width = 400;
  // the coloured squares beside the particles, each 14 x 12 pixels; colours repeat after ten
  const auto squares = [&](int materials) {
    scene.particles.position.clear();
    std::vector<double> numbers;
    for (int k = 0; k < materials; ++k) {
      scene.particles.position.push_back({k % 2 == 0 ? 0.0 : 10.0, 0.05 * k, 0.0});
      numbers.push_back(k + 1);
    }
    scene.particles.fields = {{"material", 1, true, numbers}};
    const Pixels p = read_png(picture(scene, options));
    int rows = 0;
    bool inside = false;
    const int column = p.width - 118 + 18 + 7;
    for (int y = 0; y < p.height; ++y) {
      const bool white = p.at(column, y) == Colour{255, 255, 255};
      rows += !white && !inside ? 1 : 0, inside = !white;
    }
    return rows;
  };
  CHECK(squares(4) == 4);
  const int shown = squares(100);
  CHECK(shown > 4);
  CHECK(shown < 30);
}

TEST_CASE("Blocks are drawn with their field, grey without, and broken bonds on them", "[view]") {
  Scene scene;
  scene.blocks.position = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {2, 0, 0}, {2, 1, 0}};
  scene.blocks.cells = {{0, 1, 2, 3}, {1, 4, 5, 2}};
  scene.blocks.fields = {{"velocity", 3, false, {0, 0, 0, 3, 4, 0}}, {"group", 1, true, {1, 2}}};
  scene.contacts.position = {{1, 0, 0}, {1, 1, 0}};
  scene.contacts.cells = {{0, 1}};
  scene.contacts.fields = {{"broke", 1, true, {1}}};
  CHECK(shade_of(scene, "velocity").values == std::vector<double>{0, 5});
  CHECK(shade_of(scene, "group").integers);
  CHECK_THROWS_WITH(shade_of(scene, "velocty"), Catch::Contains("did you mean 'velocity'?"));
  CHECK(box_of(scene)[1] == std::array<double, 3>{2, 1, 0});

  PictureOptions options;
  options.field = "group", options.width = 400;
  const Colour torn{214, 39, 40}, sheared{31, 90, 200}, stone{186, 184, 178};
  CHECK(count(read_png(picture(scene, options)), torn) > 50);
  scene.contacts.fields[0].values = {2};
  const Pixels p = read_png(picture(scene, options));
  CHECK(count(p, torn) == 0);
  CHECK(count(p, sheared) > 50);

  // beside particles that have another field
  scene.particles.position = {{0.5, -0.5, 0}, {1.5, -0.5, 0}};
  scene.particles.fields = {{"pressure", 1, false, {1, 2}}};
  const Shade shade = shade_of(scene, "pressure");
  REQUIRE(shade.values.size() == 4);
  CHECK(shade.values[1] == 2);
  CHECK(std::isnan(shade.values[3]));
  options.field = "pressure";
  CHECK(count(read_png(picture(scene, options)), stone) > 1000);
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
