// SPDX-License-Identifier: MIT
/// Fields of particle and grid files.

#include "../solver/cloud.hpp"

#include "base/read_file.hpp"
#include "contact/contact_cases.hpp"
#include "input/read.hpp"
#include "run/grid_file.hpp"
#include "run/particle_fields.hpp"
#include "run/result_units.hpp"
#include "run/results.hpp"
#include "scratch.hpp"

using namespace tribo;
using namespace tribo::test;

namespace {

// One material on the other, with velocity fields of their own.
Model two_layers() {
  Model model = grid_model<2>(Kernel::quadratic_spline, Transfer::apic, UpdateOrder::usl, false, 24);
  model.materials.push_back(model.materials.front());
  model.contact.active = true;
  model.contact.default_law = make_law("CoulombFriction", {{"coeff", "0"}});
  return model;
}

std::vector<Seed> layers_of(const Model& model) {
  auto seeds = lattice_seeds<2>(model, 8, 14);
  for (auto& s : seeds) {
    s.material = s.x[1] > 11 ? 1 : 0;
    s.v = s.material == 0 ? Vec3(1, 0, 0) : Vec3(3, 0, 0);
  }
  return seeds;
}

}  // namespace

TEST_CASE("grid fields add up over all velocity fields of a node", "[output]") {
  const Model model = two_layers();
  auto system = build_system<2>(model, layers_of(model));
  Stepper<2> stepper(model, system);
  stepper.advance(1e-6);
  double mass = 0.0;
  Vec3 momentum = Vec3::Zero();
  bool mixed = false;
  for (int j = 0; j <= model.grid.cells[1]; ++j)
    for (int i = 0; i <= model.grid.cells[0]; ++i) {
      const Index<2> n{i + Lattice<2>::padding, j + Lattice<2>::padding};
      const GridNodeState state = grid_node_state(system, n);
      mass += state.mass, momentum += state.mass * state.velocity;
      mixed = mixed || (state.velocity[0] > 1.1 && state.velocity[0] < 2.9);
    }
  const Measures all = measure(system);
  CHECK(mass == Approx(all.mass).epsilon(1e-12));
  CHECK((momentum - all.momentum).norm() < 1e-12 * all.momentum.norm());
  CHECK(mixed);  // at the nodes that both have
}

TEST_CASE("the velocity of a single field goes to the grid file to the bit", "[output]") {
  Model model = two_layers();
  model.contact.active = false;
  auto system = build_system<2>(model, layers_of(model));
  REQUIRE(system.fields.size() == 1);
  Stepper<2> stepper(model, system);
  stepper.advance(1e-6);
  int nodes = 0;
  for (int j = 0; j <= model.grid.cells[1]; ++j)
    for (int i = 0; i <= model.grid.cells[0]; ++i) {
      const Index<2> n{i + Lattice<2>::padding, j + Lattice<2>::padding};
      const auto position = system.fields[0].map.node(n);
      if (position < 0) continue;
      const Node& node = system.fields[0].nodes[static_cast<std::size_t>(position)];
      if (!(node.mass > 0)) continue;
      const GridNodeState state = grid_node_state(system, n);
      CHECK(
          (state.mass == node.mass && state.velocity[0] == node.velocity[0] && state.velocity[1] == node.velocity[1]));
      ++nodes;
    }
  CHECK(nodes > 30);
}

TEST_CASE("every field of the table can be written", "[output]") {
  Model model = two_layers();
  for (const auto& field : particle_fields()) model.output.particle_fields.emplace_back(field.name);
  auto system = build_system<2>(model, layers_of(model));
  Stepper<2> stepper(model, system);
  stepper.advance(1e-6);
  stepper.contact().fill_view();
  const ParticleFields<2> fields(model, {&system.bodies[0], &system.bodies[1]}, model.output.particle_fields,
                                 Precision::single);
  std::map<std::string, const OutputField*> by_name;
  for (const auto& field : fields.fields()) by_name[field.name] = &field;
  for (const auto& field : particle_fields()) {
    if (field.value.history) continue;
    INFO(field.name);
    const bool written = by_name.count(std::string(field.name)) == 1;
    CHECK(written == (field.needs != ParticleField::Needs::heat));  // the model has contact but no heat
    if (!written) continue;
    const OutputField& found = *by_name[std::string(field.name)];
    CHECK((found.integers ? 0U : static_cast<std::size_t>(found.rows.width)) == field.value.components);
  }
  CHECK(standard_particle_fields() == std::vector<std::string>{"id", "material", "velocity", "displacement", "stress",
                                                               "pressure", "von_mises", "volume_ratio", "contact_state",
                                                               "contact_traction", "contact_normal", "temperature",
                                                               "history"});
}

TEST_CASE("particles of a file stand in the order of the bodies", "[output]") {
  const std::vector<std::int64_t> numbers{7, 3, 12, 4, 2, 9, 20};
  const BodyOrder order = order_by_body(numbers, {{2, 3}, {4, 8}, {9, 9}});
  CHECK(order.particles == std::vector<std::uint32_t>{1, 4, 0, 3, 5, 2, 6});
  CHECK(order.counts == std::vector<std::size_t>{2, 2, 1, 2});
}

TEST_CASE("each body of a material is a block of its own", "[output]") {
  Model model = two_layers();
  model.pieces.assign(2, {});
  for (Piece& piece : model.pieces) piece.material = 0;
  auto seeds = layers_of(model);
  std::stable_sort(seeds.begin(), seeds.end(), [](const Seed& a, const Seed& b) { return a.material < b.material; });
  for (Seed& seed : seeds) seed.piece = seed.material, seed.material = 0;
  auto system = build_system<2>(model, seeds);
  REQUIRE(system.bodies.size() == 1);
  REQUIRE(system.pieces.size() == 2);
  auto& body = system.bodies[0];
  Stepper<2> stepper(model, system);
  stepper.advance(1e-6);  // sorts the particles
  const std::vector<std::string> names{"id", "velocity", "stress"};
  const ParticleFields<2> stored(model, {&body}, names, Precision::full);
  const std::vector<Body<2>*> bodies{&body};
  const std::string material = model.materials[static_cast<std::size_t>(body.material)].name;
  CHECK(ParticleBlocks<2>(model, bodies, {}).blocks().size() == 1);
  const ParticleBlocks<2> blocks(model, bodies, system.pieces);
  REQUIRE(blocks.blocks().size() == 2);
  CHECK(blocks.blocks()[1].name == material + " 2");
  CHECK(blocks.ranges()[0].count() + blocks.ranges()[1].count() == body.particles.size());
  const ParticleFields<2> fields(model, bodies, blocks.ranges(), names, Precision::full);
  std::map<std::int64_t, std::size_t> row_of;
  for (std::size_t i = 0; i < body.particles.size(); ++i) row_of[stored.fields()[0].integers[i]] = i;
  for (std::size_t k = 0; k < 2; ++k)
    for (std::size_t i = 0; i < blocks.ranges()[k].count(); ++i) {
      const std::size_t row = blocks.ranges()[k].begin + i;
      const std::int64_t id = fields.fields()[0].integers[row];
      CHECK((id >= system.pieces[k].first && id <= system.pieces[k].last));
      const std::size_t other = row_of.at(id);
      for (std::size_t d = 0; d < 2; ++d) {
        CHECK(fields.positions().doubles[3 * row + d] == stored.positions().doubles[3 * other + d]);
        CHECK(fields.fields()[1].rows.doubles[3 * row + d] == stored.fields()[1].rows.doubles[3 * other + d]);
        CHECK(fields.fields().back().rows.floats[4 * row + d] == stored.fields().back().rows.floats[4 * other + d]);
      }
    }
}

TEST_CASE("blocks with too many particles are divided", "[output]") {
  const Model model = two_layers();
  auto system = build_system<2>(model, layers_of(model));
  const std::vector<Body<2>*> bodies{&system.bodies[0], &system.bodies[1]};
  const std::size_t count = system.bodies[0].particles.size(), most = count / 3 + 1;
  REQUIRE(system.bodies[1].particles.size() > 2 * most);
  const ParticleBlocks<2> blocks(model, bodies, {}, most);
  const std::string name = model.materials[0].name;
  REQUIRE(blocks.blocks().size() == 6);
  CHECK(blocks.blocks()[1].name == name + ", part 2 of 3");
  std::size_t end = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    CHECK((blocks.blocks()[k].group == name && blocks.blocks()[k].part == static_cast<int>(k) + 1));
    CHECK((blocks.ranges()[k].begin == end && blocks.ranges()[k].count() <= most));
    end = blocks.ranges()[k].end;
  }
  CHECK(end == count);
  CHECK((blocks.blocks()[3].part == 1 && blocks.ranges()[3].body == bodies[1]));
}

TEST_CASE("frames that are too large to be copied have the same files", "[output]") {
  const Model model = two_layers();
  auto system = build_system<2>(model, layers_of(model));
  Stepper<2> stepper(model, system);
  stepper.advance(1e-6);
  const auto files = [&](std::size_t most_copied) {
    const ScratchFolder scratch;
    std::filesystem::create_directory(scratch.path / "particles");
    OutputQueue queue(OutputQueue::usual_limit, most_copied);
    Results<2> results(model, system, stepper, scratch.path, std::nullopt, Tracers<2>(model, system), queue);
    results.write_files(0);
    queue.drain();
    std::map<std::string, std::string> out;
    for (const auto& entry : std::filesystem::directory_iterator(scratch.path / "particles"))
      out[entry.path().filename().string()] = read_file(entry.path());
    return out;
  };
  const auto copied = files(OutputQueue::usual_most_copied);
  CHECK(copied.size() == 3);
  CHECK(files(1000) == copied);
}

TEST_CASE("fields in single precision are the rounded ones, positions are not rounded", "[output]") {
  const Model model = two_layers();
  auto system = build_system<2>(model, layers_of(model));
  auto& body = system.bodies[0];
  body.particles.x()[0][1] = 1.0 / 3.0, body.particles.v()[1][1] = 1.0 / 3.0;
  const ParticleFields<2> exact(model, {&body}, {"velocity", "material"}, Precision::full);
  const ParticleFields<2> rounded(model, {&body}, {"velocity", "material"}, Precision::single);
  REQUIRE(rounded.fields()[0].rows.floats);
  CHECK(exact.fields()[0].rows.doubles[4] == 1.0 / 3.0);
  CHECK(rounded.fields()[0].rows.floats[4] == static_cast<float>(1.0 / 3.0));
  CHECK(rounded.positions().doubles[3] == 1.0 / 3.0);
  CHECK(rounded.fields()[1].integers[1] == exact.fields()[1].integers[1]);
  CHECK(rounded.bytes() < exact.bytes());
}

TEST_CASE("particle files carry the half axes of the domains in the reduced basis", "[output]") {
  const Model model = two_layers();
  auto system = build_system<2>(model, layers_of(model));
  auto& body = system.bodies[0];
  REQUIRE(body.particles.has_deformation());
  // Shear by 5.25: the reduced basis has the shear 5.25 - 5 of the square lattice.
  const Vec<2> half = body.uniform_half_size;
  REQUIRE(half[0] == Approx(half[1]));
  Mat3 F = Mat3::Identity();
  F(0, 1) = 5.25;
  store_full<2>(F, body.particles.F(), 3);
  const ParticleFields<2> fields(model, {&body}, {"velocity"}, Precision::full);
  const OutputField& domain = fields.fields().back();
  CHECK(domain.name == "domain");
  REQUIRE(domain.rows.floats);
  REQUIRE(domain.rows.width == 4);
  const auto component = [&](std::size_t k, std::size_t i) { return domain.rows.floats[4 * i + k]; };
  const std::array<double, 4> box{half[0], 0, 0, half[1]}, sheared{half[0], 0, 0.25 * half[0], half[1]};
  for (std::size_t k = 0; k < 4; ++k) {
    CHECK(component(k, 2) == Approx(box[k]));
    CHECK(component(k, 3) == Approx(sheared[k]).margin(1e-6));
  }
  // The lengths of its edges; a domain in the plane has two
  const OutputField& size = fields.fields()[fields.fields().size() - 2];
  CHECK(size.name == "size");
  REQUIRE(size.rows.width == 3);
  const std::array<double, 3> edges{2 * half[0], 2 * half[0] * std::sqrt(1 + 0.25 * 0.25), 0};
  for (std::size_t k = 0; k < 3; ++k) CHECK(size.rows.floats[9 + k] == Approx(edges[k]));
}

TEST_CASE("no domain in the file of a disc reaches beyond its rim", "[output]") {
  const Model model = read_model_text(
      "<JANFEAInput version='3'><Header><Analysis>10</Analysis><ConsistentUnits length='mm' mass='g' "
      "time='ms'/></Header>"
      "<MPMHeader><MaxTime>1</MaxTime><ArchiveTime>1</ArchiveTime><GIMP/></MPMHeader><Mesh><Grid xmin='-8' xmax='8' "
      "ymin='-8' ymax='8'><Horiz nx='16'/><Vert ny='16'/></Grid></Mesh><MaterialPoints><Body matname='disc'><Oval "
      "xmin='-6' xmax='6' ymin='-6' ymax='6'/></Body></MaterialPoints><Material Type='Isotropic' Name='disc'>"
      "<rho>1</rho><E>1</E><nu>0</nu></Material></JANFEAInput>",
      "disc.xml");
  auto system = build_system<2>(model, place_points(model));
  Body<2>& body = system.bodies[0];
  const ParticleFields<2> fields(model, {&body}, {"velocity"}, Precision::full);
  const auto& axes = fields.fields().back().rows.floats;
  double farthest = 0.0;
  for (std::uint32_t i = 0; i < body.particles.size(); ++i)
    for (const double a : {-1.0, 1.0})
      for (const double b : {-1.0, 1.0}) {
        const Vec<2> corner = body.particles.position(i) + a * Vec<2>(axes[4 * i], axes[4 * i + 1]) +
                              b * Vec<2>(axes[4 * i + 2], axes[4 * i + 3]);
        farthest = std::max(farthest, corner.norm());
      }
  CHECK(farthest == Approx(6).margin(0.02));
}

TEST_CASE("long domains are limited to one and a half cells and keep their volume", "[output]") {
  const Vec<3> cell(2, 4, 4);  // half axes of at most 1.5, 3 and 3
  Mat<3> axes = Vec<3>(1, 2, 0.5).asDiagonal();
  CHECK(limited<3>(axes, cell) == axes);
  axes(0, 0) = 6;  // four times too long: the others become twice as long, the second up to the limit only
  Mat<3> expected = Vec<3>(1.5, 3, 6.0 * 2 * 0.5 / (1.5 * 3)).asDiagonal();
  CHECK((limited<3>(axes, cell) - expected).norm() < 1e-12);
  axes = Vec<3>(6, 12, 12).asDiagonal();  // more than a cell cannot be kept
  expected = Vec<3>(1.5, 3, 3).asDiagonal();
  CHECK((limited<3>(axes, cell) - expected).norm() < 1e-12);
  // the direction of an oblique edge stays
  Mat<2> oblique;
  oblique << 3, -0.05, 4, 0.05;
  const Mat<2> shorter = limited<2>(oblique, Vec<2>(1, 1));
  CHECK(shorter.col(0).norm() == Approx(0.75));
  CHECK(shorter(1, 0) / shorter(0, 0) == Approx(4.0 / 3));
  CHECK(shorter.determinant() == Approx(oblique.determinant()));
}

TEST_CASE("generic units are written in the units of the model", "[output]") {
  Units units{false, "m", "kg", "s"};
  CHECK(unit_in(units, "-").empty());
  CHECK(unit_in(units, "stress") == "Pa");
  CHECK(unit_in(units, "energy") == "J");
  CHECK(unit_in(units, "length^3") == "m^3");
  CHECK(unit_in(units, "1/time") == "1/s");
  CHECK(unit_in(units, "mass velocity") == "kg m/s");
  CHECK(unit_in(units, "rad") == "rad");
  units = {false, "mm", "g", "ms"};
  CHECK(unit_in(units, "energy") == "N mm");
  units = {false, "ft", "slug", "s"};
  CHECK(unit_in(units, "energy") == "slug ft^2/s^2");

  Model model = two_layers();
  model.units = {false, "m", "kg", "s"};
  model.output.history.push_back({});
  model.output.history.back().name = "velx", model.output.history.back().column = "velx:upper";
  model.materials.emplace_back();  // a material of rigid blocks has no law
  const auto all = units_of_results(model);
  CHECK(all.at("von_mises") == "Pa");
  CHECK(all.at("velx:upper") == "m/s");
  CHECK(all.at("kinetic") == "J");
  CHECK(all.count("volume_ratio") == 0);
}

TEST_CASE("principal stresses are written in descending order", "[output]") {
  // Turned by 30 degrees about z from principal values 5, -3 in the plane and 1 along z
  struct Particles final : ParticleStates {
    double stored_energy(std::size_t) const override { return 0; }
    double dissipated_energy(std::size_t) const override { return 0; }
    double contact_state(std::size_t) const override { return 0; }
    Vec3 contact_traction(std::size_t) const override { return Vec3::Zero(); }
    Vec3 contact_normal(std::size_t) const override { return Vec3::Zero(); }
  } particles;
  const double c = std::cos(std::acos(-1.0) / 6), s = 0.5;
  const double xx[] = {0, 5 * c * c - 3 * s * s}, yy[] = {0, 5 * s * s - 3 * c * c}, zz[] = {0, 1},
               xy[] = {0, 8 * c * s};
  particles.stress = {xx, yy, zz, xy, {}, {}};
  const ParticleField* field = find_particle_field("Principal_Stress");
  REQUIRE(field);
  REQUIRE(field->value.components == 3);
  double values[3];
  field->value.numbers(particles, {nullptr, 1, 2}, values);
  const double expected[] = {5, 1, -3};
  for (int k = 0; k < 3; ++k) CHECK(values[k] == Approx(expected[k]).epsilon(1e-14));
}
