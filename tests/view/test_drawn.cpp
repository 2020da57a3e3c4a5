// SPDX-License-Identifier: MIT
#include "view/arrows.hpp"
#include "view/drawn.hpp"
#include "view/frame_answer.hpp"
#include "view/picked.hpp"

#include <catch2/catch.hpp>

#include <nlohmann/json.hpp>

using namespace tribo;

namespace {

// A cube of n^3 particles at a distance of 1, in two materials, whose velocity is their place.
KnownScene cube_of_particles(int n) {
  KnownScene out;
  ParticleFrame& frame = out.scene.particles;
  frame.fields = {{"material", 1, true, {}}, {"id", 1, true, {}}, {"velocity", 3, false, {}}};
  for (int k = 0; k < n * n * n; ++k) {
    const std::array<double, 3> x{1.0 * (k % n), 1.0 * (k / n % n), 1.0 * (k / n / n)};
    frame.position.push_back(x);
    frame.fields[0].values.push_back(x[0] < n / 2 ? 1 : 2);
    frame.fields[1].values.push_back(100 + k);
    for (const double v : x) frame.fields[2].values.push_back(v);
  }
  out.box = {{{0, 0, 0}, {n - 1.0, n - 1.0, n - 1.0}}};
  out.spacing = 1.0, out.flat = n == 1;
  return out;
}

}  // namespace

TEST_CASE("In space, particles that others surround are not drawn", "[view]") {
  const KnownScene scene = cube_of_particles(24);
  const Drawn all = drawn(scene, {});
  CHECK(all.visible == 24 * 24 * 24);
  CHECK(all.inside + all.particles.size() == all.visible);
  CHECK(all.inside > 4000);
  CHECK(all.growth == 1.0);
  // Every particle of the surface is there.
  std::set<std::uint32_t> found(all.particles.begin(), all.particles.end());
  for (std::uint32_t k = 0; k < 24 * 24 * 24; ++k) {
    const auto& x = scene.scene.particles.position[k];
    if (*std::min_element(x.begin(), x.end()) == 0 || *std::max_element(x.begin(), x.end()) == 23)
      CHECK(found.contains(k));
  }
}

TEST_CASE("Hidden particles and those beyond sections open the view of the others", "[view]") {
  const KnownScene scene = cube_of_particles(24);
  Wanted wanted;
  wanted.hidden = {1};
  CHECK(drawn(scene, wanted).visible == 12 * 24 * 24);
  wanted.hidden = {1, 2};
  CHECK(drawn(scene, wanted).particles.empty());
  wanted.hidden.clear();
  wanted.sections = {{2, 11.5, true}};
  const Drawn half = drawn(scene, wanted);
  CHECK(half.visible == 12 * 24 * 24);
  int in_plane = 0;
  for (const auto k : half.particles) {
    CHECK(scene.scene.particles.position[k][2] < 11.5);
    in_plane += scene.scene.particles.position[k][2] == 11;
  }
  CHECK(in_plane == 24 * 24);
}

TEST_CASE("Many particles are thinned evenly and grow", "[view]") {
  const KnownScene scene = cube_of_particles(24);
  Wanted wanted;
  wanted.most = 500;
  const Drawn few = drawn(scene, wanted);
  CHECK(few.particles.size() <= 500);
  CHECK(few.particles.size() > 200);
  CHECK(few.growth > 1.5);
  CHECK(std::is_sorted(few.particles.begin(), few.particles.end()));
}

TEST_CASE("Arrows are of particles or of contacts, at most so many", "[view]") {
  KnownScene known = cube_of_particles(24);
  Scene& scene = known.scene;
  const Drawn all = drawn(known, {});
  const Arrows few = arrows_of(scene, "velocity", all, {}, 100);
  CHECK(few.places.size() <= 100);
  CHECK(few.places.size() > 30);
  CHECK(few.total == all.particles.size() - 1);  // one does not move
  CHECK(few.largest == Approx(23 * std::sqrt(3.0)));
  for (std::size_t k = 0; k < few.places.size(); ++k) CHECK(few.places[k] == few.vectors[k]);
  CHECK(arrows_of(scene, "", all, {}, 100).places.empty());
  CHECK_THROWS_WITH(arrows_of(scene, "material", all, {}, 100), Catch::Contains("there are: velocity"));

  scene.contacts.position = {{0, 0, 0}, {0, 2, 0}};
  scene.contacts.cells = {{0, 1}};
  scene.contacts.fields = {{"force", 3, false, {3, 4, 0}}};
  CHECK(arrow_names(scene) == std::vector<std::string>{"velocity", contact_arrows});
  const Arrows forces = arrows_of(scene, contact_arrows, all, {}, 100);
  REQUIRE(forces.places.size() == 1);
  CHECK(forces.places[0] == std::array<double, 3>{0, 1, 0});
  CHECK(forces.largest == 5);
}

TEST_CASE("Particles, blocks and contacts are known by their numbers", "[view]") {
  KnownScene known = cube_of_particles(3);
  Scene& scene = known.scene;
  const Picked third = particle_at(scene, 2);
  CHECK(third.numbers[0] == 102);
  Legend legend;
  legend.materials = {"clay", "sand"}, legend.units["velocity"] = "m/s";
  const auto values = values_of(scene, legend, third);
  CHECK(values["material"] == "sand");
  CHECK(values["fields"][2]["values"] == std::vector<double>{2, 0, 0});
  CHECK(values["fields"][2]["unit"] == "m/s");
  CHECK(values_of(scene, legend, {Picked::Kind::particle, {5, 0}}).is_null());
  CHECK_THROWS_AS(particle_at(scene, 27), UsageError);
  CHECK_FALSE(contact_near(scene, {0, 0, 0}));

  scene.contacts.position = {{0, 0, 0}, {0, 2, 0}, {4, 0, 0}, {4, 2, 0}};
  scene.contacts.cells = {{0, 1}, {2, 3}};
  scene.contacts.fields = {{"block1", 1, true, {1, 2}}, {"block2", 1, true, {2, 3}}, {"gap", 1, false, {0.5, 0.25}}};
  const auto contact = contact_near(scene, {3, 1, 0});
  REQUIRE(contact);
  CHECK(contact->numbers == std::array<double, 2>{2, 3});
  CHECK(values_of(scene, legend, *contact)["fields"][2]["values"][0] == 0.25);
}

TEST_CASE("Bodies are known by the numbers of their particles", "[view]") {
  ParticleFrame frame = cube_of_particles(2).scene.particles;
  Legend legend;
  add_bodies(frame, legend);
  CHECK_FALSE(frame.field("body"));
  legend.bodies = {{"clay 1", 100, 101}, {"clay 2", 102, 105}};
  add_bodies(frame, legend);
  REQUIRE(frame.field("body"));
  CHECK(frame.field("body")->values == std::vector<double>{1, 1, 2, 2, 2, 2, 0, 0});
}

TEST_CASE("A frame tells the length of each of its parts", "[view]") {
  const KnownScene scene = cube_of_particles(3);
  FrameRequest request;
  request.field = "velocity.x", request.wanted.hidden = {1};
  const std::string answer = frame_answer(scene, {}, request, drawn(scene, request.wanted));
  const auto end = answer.find('\n');
  const auto head = nlohmann::json::parse(answer.substr(0, end));
  CHECK((end + 1) % 4 == 0);
  std::size_t numbers = 0;
  for (const auto& part : head["parts"]) numbers += part["length"].get<std::size_t>();
  CHECK(answer.size() == end + 1 + 4 * numbers);
  CHECK(head["count"] == 18);
  CHECK(head["total"] == 27);
  CHECK(head["parts"][0]["length"] == 54);
  request.field = "velocty";
  CHECK_THROWS_WITH(frame_answer(scene, {}, request, {}), Catch::Contains("did you mean 'velocity'?"));
}
