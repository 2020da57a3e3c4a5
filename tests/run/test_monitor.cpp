// SPDX-License-Identifier: MIT
/// What a run notices about its own results.

#include "input/read.hpp"
#include "run/grid_run.hpp"
#include "scratch.hpp"
#include "solver/build.hpp"
#include "solver/particle_quality.hpp"

#include <catch2/catch.hpp>

#include <fstream>
#include <sstream>

using namespace tribo;
using Catch::Contains;

namespace {

const std::string elastic = "<Material Type='1' Name='m'><rho>1</rho><E>100</E><nu>0</nu></Material>";

// A block of 4 x 4 cells that hangs in the middle of the grid.
Model block(const std::string& material = elastic, const std::string& header = "", const std::string& body = "vx='1'",
            const std::string& more = "") {
  return read_model_text(R"(<JANFEAInput version='3'>
 <Header><Analysis>10</Analysis><ConsistentUnits length='mm' mass='g' time='ms'/></Header>
 <MPMHeader><MaxTime>1</MaxTime><ArchiveTime>0.5</ArchiveTime><GIMP/><Transfer type='APIC'/>)" +
                             header + R"(</MPMHeader>
 <Mesh><Grid xmin='0' xmax='20' ymin='0' ymax='10'><Horiz nx='20'/><Vert ny='10'/></Grid></Mesh>
 <MaterialPoints><Body matname='m' )" +
                             body + "><Rect xmin='8' xmax='12' ymin='3' ymax='7'/></Body></MaterialPoints>" + material +
                             more + "</JANFEAInput>",
                         "deck.xml");
}

// A monitored system that takes no steps by itself.
struct Watched {
  explicit Watched(Model of)
      : model(std::move(of)),
        system(build_system<2>(model, place_points(model))),
        stepper(model, system),
        steps(model, system),
        monitor(model, system, stepper, steps) {}

  // Looks `times` times, each in a step in which the monitor is due; the warnings of all of them.
  std::string look(double initial_energy, int times = 1, double dt = 0.01) {
    std::string all;
    for (int k = 0; k < times; ++k) {
      for (const auto& text : monitor.look(dt, initial_energy, false)) all += text + "\n";
      system.step += std::max<std::int64_t>(1, monitor.state.stride), system.time += dt;
    }
    return all;
  }
  std::string look_at_state() { return look(measure(system).kinetic); }
  std::string summary() const { return joined(monitor.summary()); }
  std::string figures() const { return joined(monitor.energy_figures()); }
  static std::string joined(const std::vector<Figure>& figures) {
    std::string all;
    for (const auto& figure : figures) all += figure.text + "\n";
    return all;
  }
  static std::string joined(const std::vector<std::string>& lines) {
    std::string all;
    for (const auto& text : lines) all += text + "\n";
    return all;
  }
  // As if the transfers had dissipated this energy so far.
  void dissipate(double energy) {
    auto& ledger = stepper.ledger();
    ledger.started = true, ledger.first_kinetic = measure(system).kinetic, ledger.nodal_work = energy;
  }
  Body<2>& body() { return system.bodies.front(); }
  // Deforms all particles by F, whose volume follows.
  void deform(const Mat<2>& F) {
    Mat3 whole = Mat3::Identity();
    whole.topLeftCorner<2, 2>() = F;
    for (std::size_t i = 0; i < body().particles.size(); ++i) {
      store_full<2>(whole, body().particles.F(), static_cast<int>(i));
      body().particles.volume()[i] *= F.determinant();
    }
  }

  Model model;
  System<2> system;
  Stepper<2> stepper;
  StepSize<2> steps;
  Monitor<2> monitor;
};

const std::string gas = "<Material Type='IdealGas' Name='m'><rho>1</rho><P0>0.1</P0></Material>";
const std::string sand =
    "<Material Type='MohrCoulomb' "
    "Name='m'><rho>1</rho><E>100</E><nu>0.3</nu><cohesion>0</cohesion><friction>30</friction>"
    "<dilation>0</dilation></Material>";

Mat<2> matrix(double xx, double xy, double yx, double yy) {
  Mat<2> m;
  m << xx, xy, yx, yy;
  return m;
}

}  // namespace

TEST_CASE("a gain of energy that lasts is warned of, a loss is a figure", "[monitor]") {
  // 16 mm^2 of 1 g/mm^3 at 1 mm/ms
  const double kinetic = 8;
  CHECK(Watched(block()).look(kinetic, 20).empty());
  CHECK(Watched(block()).look(kinetic / 1.01, 20).empty());
  Watched gaining(block());
  CHECK(gaining.look(kinetic / 1.1, 4).empty());
  CHECK_THAT(gaining.look(kinetic / 1.1, 1), Contains("energy: 10 % of what was supplied came from nowhere"));
  CHECK(gaining.look(kinetic / 1.1, 20).empty());  // once
  CHECK_THAT(gaining.summary(), Contains("energy: 10 %"));
  CHECK(gaining.figures() ==
        "energy: the balance exceeds by 10 % of what was supplied; USAVG- or a smaller <TimeFactor> usually reduces "
        "it\n");
  Watched losing(block());
  CHECK(losing.look(kinetic / 0.8, 20).empty());
  CHECK(losing.summary().empty());
  CHECK(losing.figures() == "energy: the balance lacks 20 % of what was supplied\n");
  losing.model.scheme.extrapolate_again = false;
  CHECK_THAT(losing.figures(), Contains("lacks 20 %") && Contains("without <SkipPostExtrapolation/>"));
  Watched of_nothing(block());  // no energy was supplied: a figure would be a division by zero
  of_nothing.model.scheme.extrapolate_again = false;
  of_nothing.monitor.state.residual = -1;
  CHECK(of_nothing.figures().empty());
  for (int k = 0; k < 20; ++k) CHECK_FALSE(of_nothing.monitor.state.record_balance({0, 1e-3, 0, 0, 0}, 0));
}

TEST_CASE("a balance that lacks what a law does not report names the law", "[monitor]") {
  // A law of a program that stores energy and does not report it
  class Silent final : public Material {
   public:
    void update(const MaterialPoints<2>&) const override {}
    void update(const MaterialPoints<3>&) const override {}
    double density() const override { return 1.0; }
    double wave_modulus() const override { return 100.0; }
    const std::vector<HistoryVariable>& history() const override { return none_; }
    bool needs_deformation() const override { return false; }
    std::string unreported_energy() const override { return "no method energy(p)"; }

   private:
    std::vector<HistoryVariable> none_;
  };
  const double kinetic = 8;
  const auto silent = std::make_shared<const Silent>();
  Watched losing(block());
  losing.body().law = silent;
  losing.model.scheme.extrapolate_again = false;
  losing.look(kinetic / 0.8, 20);
  const auto figures = losing.monitor.energy_figures();
  REQUIRE(figures.size() == 1);
  CHECK(figures[0].is_warning);
  CHECK_THAT(figures[0].text,
             Contains("lacks 20 %") && Contains("has no method energy(p), so that its energy is missing"));
  CHECK_THAT(figures[0].text, Contains("missing in the balance; the update without <SkipPostExtrapolation/>") &&
                                  Contains("avoids most of a further loss"));
  Watched gaining(block());
  gaining.body().law = silent;
  CHECK_THAT(gaining.look(kinetic / 1.1, 5), Contains("came from nowhere") && Contains("has no method energy(p)"));
}

TEST_CASE("energy that contact creates comes from nowhere, and what it dissipates makes up for nothing", "[monitor]") {
  MonitorState creates, dissipates;
  for (int k = 0; k < 5; ++k) CHECK(creates.record_balance({1, 0, 0, -0.1, 0}, 0) == (k == 4));
  CHECK(creates.of(Sign::energy).worst == Approx(0.1));
  REQUIRE(creates.energy_figures().size() == 1);
  CHECK(creates.energy_figures()[0].text == "energy: contact created 10 % of what was supplied");
  for (int k = 0; k < 20; ++k) CHECK_FALSE(dissipates.record_balance({1, 0, 0, 0.5, 0}, 0));
  CHECK(dissipates.energy_figures().empty());
  for (int k = 0; k < 5; ++k) CHECK(dissipates.record_balance({1, 0.1, 0, 0.5, 0}, 0) == (k == 4));
}

TEST_CASE("a balance of energies that are no more than rounding is not judged", "[monitor]") {
  const std::string rubber = "<Material Type='NeoHookean' Name='m'><rho>1</rho><E>1e8</E><nu>0.3</nu></Material>";
  // The stored energy of a law of the deformation gradient has errors of the last digit of modulus times volume
  Watched slow(block(rubber, "", "vx='1e-13'"));
  CHECK(slow.look(0.5 * 8e-26, 20).empty());
  slow.monitor.state.residual = 1e-9;
  CHECK(slow.figures().empty());
  CHECK(slow.monitor.state.rounding == Approx(2.2e-16 * 1.346e8 * 16).epsilon(0.01));
  // The same motion of a body whose stress is the sum of its increments has none
  CHECK_THAT(Watched(block(elastic, "", "vx='1e-13'")).look(0.5 * 8e-26, 20), Contains("came from nowhere"));
  // Small differences of large energies
  MonitorState state;
  for (int k = 0; k < 20; ++k) CHECK_FALSE(state.record_balance({1e-26, 1e-20, 0, 0, 1e-9}, 0));
  CHECK(state.energy_figures().empty());
  state.record_balance({1e-26, 1e-8, 0, 0, 1e-9}, 0);
  CHECK(state.energy_figures().size() == 1);
  // What was supplied is compared with 2 % as before, however small it is
  MonitorState small;
  for (int k = 0; k < 4; ++k) CHECK_FALSE(small.record_balance({1e-26, 1e-27, 0, 0, 0}, 0));
  CHECK(small.record_balance({1e-26, 1e-27, 0, 0, 0}, 0));
}

TEST_CASE("the energy that the growth of cracks releases is a figure", "[monitor]") {
  const double kinetic = 8;
  Watched growing(block());
  growing.system.cracks.resize(1);
  growing.system.cracks[0].tips.resize(2);
  growing.system.cracks[0].tips[0].released = 0.5, growing.system.cracks[0].tips[1].released = 1.5;
  growing.look(kinetic, 20);
  CHECK_THAT(growing.figures(), Contains("the growth of cracks released 25 % of what was supplied"));
  growing.system.cracks[0].tips.clear();
  CHECK(growing.figures().empty());
}

TEST_CASE("what the transfers dissipate is told as such, what they create is warned of", "[monitor]") {
  const double kinetic = 8;
  Watched dissipating(block());
  dissipating.dissipate(0.8);
  CHECK(dissipating.look(kinetic + 0.8, 20).empty());
  CHECK(dissipating.summary().empty());
  CHECK(dissipating.figures() ==
        "energy: the transfer between particles and grid dissipated 9.09 % of what was supplied\n");
  Watched little(block());
  little.dissipate(0.08);
  CHECK(little.look(kinetic + 0.08, 20).empty());
  CHECK(little.figures().empty());
  // The balance closes, but with energy that the transfers made
  Watched creating(block());
  creating.dissipate(-0.8);
  CHECK_THAT(creating.look(kinetic - 0.8, 20), Contains("energy: 11.1 % of what was supplied came from nowhere"));
  CHECK(creating.figures() == "energy: the transfer between particles and grid created 11.1 % of what was supplied\n");
}

TEST_CASE("work that is supplied counts as such", "[monitor]") {
  // Gravity sets energy free: the block has fallen by 2 mm at 10 mm/ms^2, and has the velocity that belongs to it
  Watched falling(block(sand, "", "", "<Gravity><BodyYForce>-10</BodyYForce></Gravity>"));
  auto& particles = falling.body().particles;
  for (std::size_t i = 0; i < particles.size(); ++i) particles.x()[1][i] -= 2, particles.v()[1][i] = -std::sqrt(40.0);
  CHECK(falling.look(0.0, 10).empty());
  CHECK(falling.monitor.state.supplied == Approx(16 * 10 * 2));
  CHECK(std::abs(falling.monitor.state.gain) < 1e-10);
  falling.stepper.ledger().external_work = -16;  // a load took energy that is still there: 5 % too much
  CHECK_THAT(falling.look(0.0, 10), Contains("energy: 5 %"));
}

TEST_CASE("volumes out of the ordinary are counted, except where they are ordinary", "[monitor]") {
  Watched solid(block());
  CHECK(solid.look_at_state().empty());
  auto volume = [](Watched& w, std::size_t i, double ratio) { w.body().particles.volume()[i] = 0.25 * ratio; };
  volume(solid, 0, 0.51), volume(solid, 1, 1.99);
  CHECK(solid.look_at_state().empty());
  volume(solid, 5, 0.45), volume(solid, 9, 0.4), volume(solid, 12, 2.5);
  CHECK_THAT(solid.look_at_state(),
             Contains("2 particles of 'm' at time 0.02 below 0.5 of their volume, the worst at 0.4 at (") &&
                 Contains("1 particle of 'm' at time 0.02 above 2 of their volume, the worst at 2.5 at ("));
  const Vec<2> worst = solid.body().particles.position(9);
  CHECK((solid.monitor.state.of(Sign::compressed).place.head<2>() - worst).norm() == 0.0);
  Watched loose(block(sand)), air(block(gas));
  volume(loose, 5, 3), volume(air, 5, 3), volume(air, 6, 0.1);
  CHECK(loose.look_at_state().empty());
  CHECK(air.look_at_state().empty());
  volume(loose, 6, 0.4);
  CHECK_THAT(loose.look_at_state(), Contains("below 0.5"));
}

TEST_CASE("a body that is drawn by a deformation may keep the volumes that it starts with", "[monitor]") {
  // The block is squeezed to 0.4 of its width before the run
  Model model = block();
  model.pieces.front().deformation.emplace();
  model.pieces.front().deformation->F[0][0] = Expression("0.4", {});
  model.pieces.front().deformation->shift[0] = Expression("-0.6*(x-10)", {});
  Watched drawn(std::move(model));
  CHECK(drawn.look_at_state().empty());
  drawn.body().particles.volume()[5] = 0.25 * 0.21;
  CHECK(drawn.look_at_state().empty());
  drawn.body().particles.volume()[5] = 0.25 * 0.19;
  CHECK_THAT(drawn.look_at_state(), Contains("1 particle of 'm' at time 0.02 below 0.2 of their volume"));
}

TEST_CASE("domains that are stretched over a cell are holes, those that are sheared are not", "[monitor]") {
  // Contact keeps the deformation gradients
  const auto with_contact = [] { return block(elastic, "<MultiMaterialMode/>"); };
  Watched stretched(with_contact()), sheared(with_contact()), short_of(with_contact());
  short_of.deform(matrix(2.4, 0, 0, 1 / 2.4));
  CHECK(short_of.look_at_state().empty());
  sheared.deform(matrix(1, 6, 0, 1));
  CHECK(sheared.look_at_state().empty());
  stretched.deform(matrix(0, -1 / 2.8, 2.8, 0));  // and turned by 90 degrees; domains are half a cell long
  CHECK_THAT(stretched.look_at_state(),
             Contains("64 particles of 'm' at time 0 longer than a cell, the longest 1.4 cells at (") &&
                 Contains("<SplitParticles/>"));
  // Where a body is cut, less than one in a hundred is drawn out
  Watched cut(block(elastic, "<MultiMaterialMode/><MatlPtsPerElement>16</MatlPtsPerElement>"));
  const auto draw = [&](std::size_t i) {
    store_full<2>(Mat3(Vec3(6, 1.0 / 6, 1).asDiagonal()), cut.body().particles.F(), static_cast<int>(i));
  };
  draw(3), draw(100);
  CHECK(cut.look_at_state().empty());
  draw(101);
  CHECK_THAT(cut.look_at_state(), Contains("3 particles of 'm'"));
  // Without them the volume tells
  REQUIRE_FALSE(Watched(block()).body().particles.has_deformation());
  Watched blown(block());
  for (std::size_t i = 0; i < blown.body().particles.size(); ++i) blown.body().particles.volume()[i] *= 2.8 * 2.8;
  CHECK_THAT(blown.look_at_state(), Contains("longer than a cell, the longest 1.4 cells"));
  // The neighbours of a grain change, so that its domain says nothing
  Watched flowing(block(sand, "<MultiMaterialMode/>"));
  flowing.deform(matrix(2.8, 0, 0, 1 / 2.8));
  CHECK(flowing.look_at_state().empty());
}

TEST_CASE("the summary names flowing matter that has expanded", "[monitor]") {
  const auto summary = [](const std::string& material, double ratio, Transfer transfer = Transfer::apic) {
    Watched run(block(material));
    run.model.scheme.transfer = transfer;
    for (std::size_t i = 0; i < run.body().particles.size(); ++i) run.body().particles.volume()[i] *= ratio;
    return run.summary();
  };
  CHECK_THAT(summary(sand, 1.4),
             Contains("'m' has 1.4 times its initial volume at the end, and 64 of its particles more than 1.3 times"));
  CHECK_THAT(summary(sand, 1.03), Contains("has 1.03 times") && Contains("and 0 of its particles"));
  CHECK(summary(sand, 1.01).empty());
  CHECK(summary(sand, 0.9).empty());
  CHECK(summary(gas, 1.4).empty());
  CHECK(summary(elastic, 1.4).empty());
  // the remedy depends on the transfer
  CHECK_THAT(summary(sand, 1.4), !Contains("APIC"));
  CHECK_THAT(summary(sand, 1.4, Transfer::fmpm), Contains("APIC") && Contains("free surface"));
}

TEST_CASE("a step that has fallen tenfold is told with its cause", "[monitor]") {
  const std::string adaptive = "<CustomTasks><Schedule name='AdjustTimeStep'/></CustomTasks>";
  Watched steady(block(elastic, "", "vx='1'", adaptive));
  CHECK(steady.look(8, 1, 0.01).empty());
  CHECK(steady.look(8, 1, 0.0011).empty());
  for (std::size_t i = 0; i < 1; ++i) steady.body().particles.v()[0][i] = 1000;
  CHECK_THAT(steady.look(8, 1, 0.0005),
             Contains("step: it fell to 0.05 of the first one") && Contains("the speed of particles of 'm'"));
  CHECK_THAT(steady.look(8, 10, 0.0001), !Contains("step:"));
  CHECK_THAT(steady.summary(), Contains("step: it fell to 0.01"));
}

TEST_CASE("the summary recalls static friction under sudden gravity", "[monitor]") {
  const auto remarks = [](const std::string& friction, const std::string& header = "", const std::string& body = "") {
    return Watched(block(elastic + "<Material Type='CoulombFriction' Name='f'><coeff>0.3</coeff>" + friction +
                             "</Material>",
                         "<MultiMaterialMode><Friction lawname='f'/></MultiMaterialMode>" + header, body,
                         "<Gravity><BodyYForce>-10</BodyYForce></Gravity>"))
        .summary();
  };
  CHECK_THAT(remarks("<coeffStatic>0.6</coeffStatic>"), Contains("gravity acts suddenly"));
  CHECK(remarks("").empty());
  CHECK(remarks("<coeffStatic>0.6</coeffStatic>", "<Damping>1</Damping>").empty());
}

TEST_CASE("what was seen is part of the checkpoint", "[monitor]") {
  const ScratchFolder scratch;
  Watched before(block()), after(block());
  before.body().particles.volume()[3] = 0.25 * 0.3;
  CHECK_FALSE(before.look_at_state().empty());
  RunState state;
  state.monitor = before.monitor.state;
  write_checkpoint(scratch.path / "c",
                   [&](CheckpointWriter& to) { save_state(state, before.system, before.stepper, to); });
  after.monitor.state = load_state(Checkpoint(scratch.path / "c"), after.system, after.stepper).monitor;
  CHECK(after.summary() == before.summary());
  CHECK_FALSE(after.summary().empty());
  CHECK(after.look_at_state().empty());
}

TEST_CASE("the residual counts from the start, also if the histories begin later", "[monitor]") {
  const ScratchFolder scratch;
  Model model = block();
  model.output.archive = {{0.3, 0.1, 0}};
  GridRun<2> run(model);
  OutputQueue queue;
  run.open_results(scratch.path, std::nullopt, queue);
  run.start();
  for (int k = 0; k < 5; ++k) run.advance();
  run.write_history();
  queue.drain();
  std::ifstream file(scratch.path / "energy.csv");
  std::string head, row;
  std::getline(file, head), std::getline(file, row);
  std::istringstream cells(row);
  std::vector<double> values;
  for (std::string cell; std::getline(cells, cell, ',');) values.push_back(std::stod(cell));
  CHECK(values.at(1) == Approx(8));       // kinetic
  CHECK(std::abs(values.at(10)) < 1e-9);  // residual
}
