// SPDX-License-Identifier: MIT
/// What is drawn in pictures.

#include "pictures.hpp"
#include "view/outer_domains.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <cstring>

using namespace tribo;
using namespace tribo::test;

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
