// SPDX-License-Identifier: MIT
/// Particles that enter at sources, and particles that are removed.

#include "input/read.hpp"
#include "run/grid_run.hpp"
#include "tests/scratch.hpp"

#include "cloud.hpp"

using namespace tribo;

namespace {

std::string flow(const std::string& header, const std::string& tasks, const std::string& body = "") {
  return "<JANFEAInput version='3'><Header><Analysis>10</Analysis><ConsistentUnits length='m' mass='kg' time='s'/>"
         "</Header><MPMHeader><GIMP/><Transfer type='APIC'/><TimeStep>1e-3</TimeStep><MaxTime>9</MaxTime>"
         "<ArchiveTime>1</ArchiveTime>" +
         header +
         "</MPMHeader><Mesh><Grid xmin='0' xmax='8' ymin='0' ymax='6'><Horiz nx='8'/><Vert ny='6'/></Grid></Mesh>"
         "<MaterialPoints>" +
         body +
         "</MaterialPoints><Material Type='TaitLiquid' "
         "Name='water'><rho>1000</rho><K>1e6</K><viscosity>1e-3</viscosity>"
         "</Material><Material Type='1' Name='block'><rho>2000</rho><E>1e6</E><nu>0</nu></Material><CustomTasks>" +
         tasks + "</CustomTasks></JANFEAInput>";
}

std::string task(const std::string& name, const std::string& parameters) {
  std::string out = "<Schedule name='" + name + "'>";
  std::istringstream words(parameters);
  std::string key, value;
  while (words >> key >> value) out += "<Parameter name='" + key + "'>" + value + "</Parameter>";
  return out + "</Schedule>";
}

const std::string jet = task("FluidSource", "matname water FlowRate 2 flow_x 1 source_x 3 source_y 3 inlet_width 2");
const std::string still = "<Body matname='block'><Rect xmin='0' xmax='1' ymin='0' ymax='1'/></Body>";

Model read(const std::string& text) { return read_model_text(text, "flow.xml"); }
std::string problem(const std::string& text) {
  try {
    const Model model = read(text);
    GridRun<2> run(model);
    run.start();
    for (int k = 0; k < 3000; ++k) run.advance();
  } catch (const std::exception& error) {
    return error.what();
  }
  return "none";
}

}  // namespace

TEST_CASE("a source gives rows of particles at the rate of its flow", "[exchange]") {
  const Model model = read(flow("", jet, still));
  REQUIRE(model.sources.size() == 1);
  CHECK(model.sources[0].count == std::array<int, 2>{4, 1});
  CHECK(model.sources[0].size == Approx(0.5));
  auto system = build_system<2>(model, place_points(model));
  REQUIRE(system.bodies.size() == 2);
  CHECK(system.bodies[1].particles.size() == 0);
  ParticleExchange<2> exchange(model, system);
  for (int k = 0; k < 1000; ++k) {  // 1 m/s: two rows in a second after the first
    system.time = 1e-3 * k;
    if (exchange.find(1e-3)) exchange.apply();
  }
  auto& water = system.bodies[1];
  REQUIRE(water.particles.size() == 12);
  CHECK(system.entered == 12);
  CHECK(water.total_mass == Approx(12 * 1000 * 0.25));
  for (std::size_t i = 0; i < 12; ++i) {
    CHECK(water.particles.v()[0][i] == Approx(1));
    CHECK(water.particles.v()[1][i] == 0);
    CHECK(water.particles.x()[1][i] == Approx(3.75 - 0.5 * static_cast<double>(i % 4)));
    CHECK(water.particles.x()[0][i] == Approx(3).margin(2e-3));
    CHECK(water.particles.id[i] == water.particles.id[0] + static_cast<std::int64_t>(i));
  }
}

TEST_CASE("rows of an inclined source are turned into its flow", "[exchange]") {
  const Model model = read(flow(
      "", task("FluidSource", "matname water FlowFunction 3+t flow_x 3 flow_y 4 source_x 4 source_y 3 inlet_width 1"),
      still));
  auto system = build_system<2>(model, place_points(model));
  ParticleExchange<2> exchange(model, system);
  REQUIRE(exchange.find(1e-3));
  exchange.apply();
  auto& water = system.bodies[1];
  REQUIRE(water.particles.size() == 2);
  CHECK(water.particles.v()[0][0] == Approx(0.6 * 3));
  CHECK(water.particles.v()[1][0] == Approx(0.8 * 3));
  const Vec<2> across = water.particles.position(1) - water.particles.position(0);
  CHECK(across.norm() == Approx(0.5));
  CHECK(across.dot(Vec<2>(3, 4)) == Approx(0).margin(1e-12));
  REQUIRE(water.half_axes);
  CHECK(water.particles[water.half_axes][0][0] == Approx(0.25 * 0.6));
  CHECK(water.particles[water.half_axes][2][0] == Approx(0.25 * 0.8));
}

TEST_CASE("a jet keeps its spacing, its mass and its balance of energy, and leaves the grid", "[exchange]") {
  const Model model = read(flow("<LeaveLimit>-1000</LeaveLimit>", jet, still));
  CHECK(model.delete_leaving);
  GridRun<2> run(model);
  const ScratchFolder folder;
  OutputQueue queue;
  run.open_results(folder.path, std::nullopt, queue);
  run.start();
  while (run.time() < 8) run.advance();
  // a length of 5 between inlet and edge, two rows of four per unit of length
  auto system = run.system();
  CHECK(system.entered >= 60);
  CHECK(system.deleted_outside == system.entered - static_cast<std::int64_t>(system.bodies[1].particles.size()));
  CHECK(system.bodies[1].particles.size() >= 36);
  CHECK(system.bodies[1].particles.size() <= 44);
  for (std::size_t i = 0; i < system.bodies[1].particles.size(); ++i) {
    CHECK(system.bodies[1].particles.v()[0][i] == Approx(1).epsilon(1e-6));
    CHECK(system.bodies[1].particles.volume()[i] == Approx(0.25).epsilon(1e-6));
  }
  CHECK(system.bodies[0].particles.size() == 4);
}

TEST_CASE("particles are removed when their time has come or their crack is wide enough", "[exchange]") {
  const std::string glass =
      "<Material Type='IsoSoftening' "
      "Name='glass'><rho>2000</rho><E>1e6</E><nu>0</nu><sigmac>1e3</sigmac><tauc>1e3</tauc>"
      "<I-Gc>10</I-Gc><II-Gc>10</II-Gc></Material>";
  const auto with = [&](const std::string& parameters) {
    std::string text = flow("", task("DeleteDamaged", parameters),
                            still + "<Body matname='glass'><Rect xmin='3' xmax='5' ymin='2' ymax='4'/></Body>");
    return read(text.insert(text.find("<CustomTasks>"), glass));
  };
  const auto left = [](const Model& model, double time, double damage, double opening) {
    auto system = build_system<2>(model, place_points(model));
    const auto body =
        std::find_if(system.bodies.begin(), system.bodies.end(), [](const auto& b) { return b.name == "glass"; });
    REQUIRE(body != system.bodies.end());
    for (std::size_t k = 0; k < body->law->history().size(); ++k) {
      const std::string& name = body->law->history()[k].name;
      if (name == "damage") body->particles.column(body->history + k)[3] = damage;
      if (name == "crack_opening") body->particles.column(body->history + k)[3] = opening;
    }
    system.time = time;
    ParticleExchange<2> exchange(model, system);
    if (exchange.find(1e-3)) exchange.apply();
    CHECK(system.deleted_failed == 16 - static_cast<std::int64_t>(body->particles.size()));
    CHECK(body->total_mass == Approx(500.0 * static_cast<double>(body->particles.size())));
    return body->particles.size();
  };
  CHECK(left(with("matname glass"), 0, 0.9, 1) == 16);
  CHECK(left(with("matname glass"), 0, 1, 0) == 15);
  CHECK(left(with("matname glass minCOD 0.1"), 0, 1, 0.09) == 16);
  CHECK(left(with("matname glass minCOD 0.1 direction 1"), 0, 1, 0.11) == 15);
  CHECK(left(with("matname glass deleteTime 0.5"), 0.49, 0, 0) == 16);
  CHECK(left(with("matname glass deleteTime 0.5"), 0.5, 0, 0) == 0);
}

TEST_CASE("tasks that remove or add particles say what they need", "[exchange]") {
  using Catch::Contains;
  CHECK_THAT(problem(flow("", task("DeleteDamaged", "minCOD 1"), still)), Contains("needs 'material' or 'matname'"));
  CHECK_THAT(problem(flow("", task("DeleteDamaged", "matname block"), still)), Contains("'block' has no damage"));
  CHECK_THAT(problem(flow("", task("DeleteDamaged", "matname block deleteTime 1 direction 2"), still)),
             Contains("'direction' must be 1"));
  CHECK_THAT(problem(flow("", task("FluidSource", "matname water flow_x 1 inlet_width 1"), still)),
             Contains("needs 'FlowRate' or 'FlowFunction'"));
  CHECK_THAT(problem(flow("", task("FluidSource", "matname water FlowRate 1 inlet_width 1"), still)),
             Contains("needs the direction of the flow"));
  CHECK_THAT(problem(flow("", task("FluidSource", "matname water FlowRate 1 flow_x 1"), still)),
             Contains("needs 'inlet_width'"));
  CHECK_THAT(problem(flow("", task("FluidSource", "matname water FlowRate 1 flow_x 1 inlet_width 1e9"), still)),
             Contains("the inlet is larger than the grid"));
  CHECK_THAT(
      problem(flow("", task("FluidSource", "matname water FlowRate 1 flow_x 1 inlet_width 1 source_y 7"), still)),
      Contains("lies outside of the grid"));
  CHECK_THAT(problem(flow("<LeaveLimit>-3</LeaveLimit>",
                          task("FluidSource", "matname water FlowRate 8 flow_x 1 source_x 7 source_y 3 inlet_width 2"),
                          still)),
             Contains("more than 3 particles have left the grid"));
}
