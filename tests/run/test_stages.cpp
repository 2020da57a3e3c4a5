// SPDX-License-Identifier: MIT
/// Stages within a run: what they change, and that a run through them continues to the bit.

#include "base/parallel.hpp"
#include "run/preflight.hpp"
#include "run/simulation.hpp"
#include "scratch.hpp"
#include "staged_models.hpp"

#include <catch2/catch.hpp>

using namespace tribo;
using namespace tribo::test;

TEST_CASE("what cannot change in a stage is refused at its place", "[stages]") {
  const auto says = [](const std::string& text, const std::string& stages) {
    const std::string message = message_of(stages);
    INFO(stages);
    INFO(message);
    CHECK(message.find(text) != std::string::npos);
    CHECK(message.find("stages.xml:") != std::string::npos);
  };
  says("begins after the start", "<Stage at='0'><Damping>1</Damping></Stage>");
  says("when the run has ended", "<Stage at='1'><Damping>1</Damping></Stage>");
  says("order of their times",
       "<Stage at='0.1'><Damping>1</Damping></Stage><Stage at='0.1'><Damping>1</Damping></Stage>");
  says("changes nothing", "<Stage at='0.1'/>");
  says("needs the attribute 'at'", "<Stage><Damping>1</Damping></Stage>");
  says("no material named 'rock'", "<Stage at='0.1'><Material Name='rock'><E>1</E></Material></Stage>");
  says("keep their mass", "<Stage at='0.1'><Material Name='soil'><rho>1</rho></Material></Stage>");
  says("cannot change the type", "<Stage at='0.1'><Material Name='soil' Type='NeoHookean'><E>1</E></Material></Stage>");
  says("has no shape", "<Stage at='0.1'><Excavate/></Stage>");
  says("<MaxTime> is not known inside <Stage>", "<Stage at='0.1'><MaxTime>1</MaxTime></Stage>");
  says("<Mesh> is not known inside <Stage>", "<Stage at='0.1'><Mesh/></Stage>");
  says("must be in (0, 1]", "<Stage at='0.1'><TimeFactor>3</TimeFactor></Stage>");
  says("needs <MultiMaterialMode>", "<Stage at='0.1'><Friction>0.3</Friction></Stage>");
  says("no <Blocks>", "<Stage at='0.1'><Blocks damping='0.1'/></Stage>");
  says("there is no platen 'top'", "<Stage at='0.1'><Platen name='top' vx='1'/></Stage>");
  CHECK(message_of(excavation + refill + third).empty());
}

TEST_CASE("interfaces and joints cannot begin in a stage", "[stages]") {
  const std::string contact = "<MultiMaterialMode><Friction>0.3</Friction></MultiMaterialMode>",
                    laws =
                        "<Material Type='LinearInterface' Name='glue'><Dn>1e5</Dn><Dt>1e5</Dt></Material>"
                        "<Material Type='Mohr' Name='joint'><stiffness-normal>1e6</stiffness-normal></Material>"
                        "<Material Type='CoulombFriction' Name='rough'><coeff>0.5</coeff></Material>";
  const auto pair = [&](const std::string& law) {
    return message_of(
        "<Stage at='0.1'><Material Name='soil'><Friction matname='fill' lawname='" + law + "'/></Material></Stage>",
        contact, laws);
  };
  CHECK(pair("rough").empty());
  CHECK(pair("glue").find("imperfect interface") != std::string::npos);
  CHECK(pair("joint").find("begin with the run") != std::string::npos);
}

TEST_CASE("an excavation takes away its particles and leaves the others as they are", "[stages]") {
  const ScratchFolder scratch;
  const Model model = staged_model(excavation);
  auto run = begun<GridRun<2>>(model);
  run_until(*run, 0.03);
  run->save({}).save(scratch.path / "before.bin");
  const Checkpoint before(scratch.path / "before.bin");
  // The stage alone, without a step
  GridRun<2> first(model), next(*model.stages[0].model);
  first.restore(before);
  const StageBalance balance = first.end_stage();
  first.save({}).save(scratch.path / "end.bin");
  next.restore(Checkpoint(scratch.path / "end.bin"));
  const StageReport report = next.begin_stage(model, model.stages[0].actions, balance);
  next.save({}).save(scratch.path / "after.bin");
  const Checkpoint after(scratch.path / "after.bin");

  const auto ids = before.integers("stepper.system.body0.particles.id"),
             kept = after.integers("stepper.system.body0.particles.id");
  CHECK(ids.size() == 256);
  CHECK(kept.size() + static_cast<std::size_t>(report.excavated) == ids.size());
  CHECK(report.excavated == 128);
  const auto y = column_of(before, "position_y"), vy = column_of(before, "velocity_y"),
             mass = column_of(before, "mass");
  double momentum = 0.0, moved = 0.0, kinetic = 0.0;
  std::size_t n = 0;
  for (std::size_t i = 0; i < ids.size(); ++i) {
    if (y[i] < 2) {
      REQUIRE(n < kept.size());
      CHECK(kept[n++] == ids[i]);
      continue;
    }
    momentum += mass[i] * vy[i], kinetic += 0.5 * mass[i] * vy[i] * vy[i];
    moved += mass[i];
  }
  CHECK(moved == Approx(8000));
  for (const char* name : {"position_x", "velocity_y", "stress_yy", "mass"}) {
    const auto old = column_of(before, name), now = column_of(after, name);
    std::size_t k = 0;
    for (std::size_t i = 0; i < ids.size(); ++i)
      if (y[i] < 2) CHECK(now[k++] == old[i]);
  }
  const double impulse = after.doubles("stepper.ledger.impulse")[1] - before.doubles("stepper.ledger.impulse")[1];
  CHECK(impulse == Approx(-momentum).epsilon(1e-9));
  CHECK(after.number("stepper.ledger.first_kinetic") - before.number("stepper.ledger.first_kinetic") ==
        Approx(-kinetic).epsilon(1e-9));
  CHECK(after.number("stepper.system.body0.total_mass") == Approx(8000));
}

TEST_CASE("placed particles fill their shape, but not where there is matter", "[stages]") {
  const Model model = staged_model(
      "<Stage at='0.01'><Body matname='fill' vy='-1'><Rect xmin='2' xmax='6' ymin='3' ymax='6'/></Body></Stage>");
  auto run = begun<GridRun<2>>(model);
  CHECK(run->facts().at("particles of fill") == "0");
  run_until(*run, 0.0101);
  CHECK(run->stage() == 1);
  CHECK(run->facts().at("particles of fill") == "128");  // of 192
  const auto news = run->take_news();
  REQUIRE(news.size() == 1);
  CHECK(news[0].find("128 particles placed") != std::string::npos);
  const auto warnings = run->look();
  REQUIRE(warnings.size() == 1);
  CHECK(warnings[0].find("64 particles are not placed") != std::string::npos);
}

TEST_CASE("a run through stages continues to the bit from anywhere, on any number of threads", "[stages]") {
  const ScratchFolder scratch;
  const Model model = staged_model(excavation + refill + third);
  const auto state = [&](StagedRun<GridRun<2>>& run, const char* name) {
    run.save({}).save(scratch.path / name);
    return Checkpoint(scratch.path / name);
  };
  auto whole = begun<GridRun<2>>(model);
  run_until(*whole, 0.12);
  CHECK(whole->stage() == 3);
  const Checkpoint end = state(*whole, "end.bin");
  for (const double at : {0.02, 0.03, 0.031, 0.06, 0.065, 0.09, 0.1}) {
    INFO(at);
    auto part = begun<GridRun<2>>(model);
    run_until(*part, at);
    const Checkpoint middle = state(*part, "middle.bin");
    StagedRun<GridRun<2>> resumed(model);
    resumed.restore(middle);
    CHECK(differing(middle, state(resumed, "again.bin")).empty());
    run_until(resumed, 0.12);
    CHECK(differing(end, state(resumed, "resumed.bin")).empty());
  }
  set_threads(2);
  auto two = begun<GridRun<2>>(model);
  run_until(*two, 0.12);
  set_threads(1);
  CHECK(differing(end, state(*two, "two.bin")).empty());
}

TEST_CASE("files of a run through stages are the same if it is stopped in between", "[stages]") {
  const ScratchFolder scratch;
  const std::string fields =
      "<GlobalArchive type='posy' pt='4,1' mat='1'/><GlobalArchive type='posy' pt='4,3.5' mat='1'/>";
  const Model model = staged_model(excavation + refill + third, fields);
  RunOptions options;
  options.quiet = true;
  options.folder = scratch.path / "whole";
  REQUIRE(run(model, options) == Outcome::finished);
  options.folder = scratch.path / "parts", options.max_wall = 0.05;
  int parts = 1;
  while (run(model, options) == Outcome::stopped && parts < 1000) options.resume = true, ++parts;
  INFO(parts);
  for (const char* file : {"history.csv", "energy.csv", "stages.csv", "checkpoint.bin", "run.pvd"})
    CHECK(contents(scratch.path / "whole" / file) == contents(scratch.path / "parts" / file));
  // The energy of the stages is in a column of its own, so that the balance is not worse than without them.
  options = {};
  options.quiet = true, options.folder = scratch.path / "plain";
  REQUIRE(run(staged_model("", fields), options) == Outcome::finished);
  const auto worst = [&](const char* folder) {
    double most = 0.0;
    for (const auto& row : rows_of(scratch.path / folder / "energy.csv")) most = std::max(most, std::abs(row[11]));
    return most;
  };
  CHECK(worst("whole") < worst("plain"));
  CHECK(std::abs(rows_of(scratch.path / "whole" / "energy.csv").back().back()) > 500);
  // The excavated particle is not followed any more.
  const auto history = rows_of(scratch.path / "whole" / "history.csv");
  CHECK(history.back()[2] > 0.8);
  CHECK(history.back()[3] == 0.0);
}

TEST_CASE("gravity, damping and properties are those of the stage", "[stages]") {
  const Model model = staged_model(third);
  const Model& now = *model.stages[0].model;
  CHECK(model.body_force.gravity[1] == -10);
  CHECK(now.body_force.gravity[1] == -5);
  CHECK_FALSE(model.damping.grid);
  REQUIRE(now.damping.grid);
  CHECK((*now.damping.grid)(Variables{}) == 10);
  CHECK(now.stage.number == 1);
  CHECK(now.time.until == 0);
  CHECK(model.time.until == 0.09);
  CHECK(model.stage.loads);
  // The load finds the present particles
  auto run = begun<GridRun<2>>(model);
  run_until(*run, 0.0905);
  const ScratchFolder scratch;
  run->save({}).save(scratch.path / "now.bin");
  const auto marked = column_of(Checkpoint(scratch.path / "now.bin"), "load_set");
  CHECK(std::count(marked.begin(), marked.end(), 1.0) == 64);
  CHECK(Checkpoint(scratch.path / "now.bin").doubles("stepper.loads.factor").at(0) == Approx(1.0 / 64));
}

TEST_CASE("loads of a stage replace the former ones, or are added", "[stages]") {
  const auto load = [](const char* attributes, const char* box, const char* force) {
    return "<ParticleBCs" + std::string(attributes) + "><BCShape><Rect " + box + "/><LoadBC dir='1' load='" + force +
           "'/></BCShape></ParticleBCs>";
  };
  const std::string low = "xmin='2' xmax='6' ymin='0' ymax='1'", high = "xmin='2' xmax='6' ymin='3' ymax='4'";
  for (const bool add : {false, true}) {
    const Model model =
        staged_model("<Stage at='0.01'>" + load(add ? " add='yes'" : "", high.c_str(), "2") + "</Stage>", "",
                     load("", low.c_str(), "1"));
    CHECK(model.stages[0].model->particle_conditions.size() == (add ? 2 : 1));
    CHECK(model.stages[0].model->stage.kept == (add ? 1 : 0));
    auto run = begun<GridRun<2>>(model);
    run_until(*run, 0.0101);
    const ScratchFolder scratch;
    run->save({}).save(scratch.path / "now.bin");
    const auto marked = column_of(Checkpoint(scratch.path / "now.bin"), "load_set");
    CHECK(std::count(marked.begin(), marked.end(), 1.0) == 64);  // the low ones, or the high ones alone
    CHECK(std::count(marked.begin(), marked.end(), 2.0) == (add ? 64 : 0));
  }
}

TEST_CASE("a stage that changes nothing of effect leaves the motion as it is", "[stages]") {
  const ScratchFolder scratch;
  RunOptions options;
  options.quiet = true;
  options.folder = scratch.path / "with";
  run(staged_model("<Stage at='0.04'><Damping>0</Damping></Stage>"), options);
  options.folder = scratch.path / "without";
  run(staged_model(""), options);
  const auto with = rows_of(scratch.path / "with" / "history.csv"),
             without = rows_of(scratch.path / "without" / "history.csv");
  CHECK(with.back()[0] == Approx(without.back()[0]));
  CHECK(with.back()[1] == Approx(without.back()[1]).epsilon(0.02));
  const auto energy = rows_of(scratch.path / "with" / "energy.csv");
  CHECK(std::abs(energy.back().back()) < 1e-9);
}

TEST_CASE("a check tells of the stages and builds their models", "[stages]") {
  const std::string text = preflight(staged_model(excavation + refill), 1);
  CHECK(text.find("stage 1 'dig' at time 0.03: excavation, 128 particles of the start excavated") != std::string::npos);
  CHECK(text.find("stage 2 at time 0.06: placement, 'soil' with E 5e5, 32 particles placed") != std::string::npos);
  CHECK_THROWS_WITH(preflight(staged_model("<Stage at='0.1'><GridBCs><BCShape><Rect xmin='50' xmax='60' ymin='0' "
                                           "ymax='1'/><DisBC dir='1' vel='0'/></BCShape></GridBCs></Stage>"),
                              1),
                    Catch::Contains("selects no node"));
}

TEST_CASE("scripts have stages, too", "[stages]") {
  const std::string text = R"(Title "Stages"
Analysis "Plane Strain MPM"
MPMMethod "USL-","uGIMP"
TimeStep 1,20,0.4
ArchiveTime 5
GlobalArchiveTime 1
GlobalArchive velx,"soil"
Material "soil","Soil","LinearElastic"
  rho 1
  E 1
  nu 0.2
Done
Material "fill","Fill","LinearElastic"
  rho 1
  E 1
  nu 0.2
Done
GridRect 0,8,0,8
GridHoriz 16
GridVert 16
Region "soil",0,0
  Rect 2,6,2,6
EndRegion
When above,"velx:Soil",1e9,Stop
Stage 5,"dig"
  Excavate "soil"
    Rect 2,6,4,6
  EndExcavate
  Material "soil"
    E 2
  Done
  Damping 0.5
  Stress yy,"-y",material,"soil",add,yes
    Rect 2,6,2,3
  EndStress
  GridBC add
    Line 2,6,2,2
    Velocity y,constant,0
  EndGridBC
EndStage
Stage 10,"fill",1e-4
  Region "fill",0,0
    Rect 2,6,4,5
  EndRegion
  Gravity 0,-1
EndStage
)";
  const Model model = read_model_text(text, "stages.fmcmd");
  REQUIRE(model.stages.size() == 2);
  CHECK(model.reactions.size() == 1);
  CHECK(model.stages[0].at == Approx(0.005));  // from milliseconds
  CHECK(model.stages[0].name == "dig");
  REQUIRE(model.stages[0].actions.size() == 2);
  CHECK(model.stages[0].actions[0].material == 0);
  const StageAction& stress = model.stages[0].actions[1];
  CHECK(stress.kind == StageAction::Kind::stress);
  CHECK(stress.material == 0);
  CHECK(stress.adds);
  CHECK(stress.stress.functions[1].has_value());
  CHECK(model.stages[0].model->node_conditions.size() == 1);
  CHECK(model.stages[0].model->reactions.empty());
  CHECK(model.stages[0].model->materials[0].law->wave_modulus() == Approx(2 * model.materials[0].law->wave_modulus()));
  CHECK(model.stages[1].model->materials[0].law->wave_modulus() ==
        model.stages[0].model->materials[0].law->wave_modulus());
  REQUIRE(model.placements.size() == 1);
  CHECK(model.placements[0].pieces.at(0).material == 1);
  CHECK(model.stages[1].model->body_force.gravity[1] == -1);
  REQUIRE(model.stages[1].model->reactions.size() == 1);
  CHECK(model.stages[1].model->reactions[0].what == Reaction::What::ratio);
  const auto fails = [&](const std::string& from, const std::string& to, const std::string& why) {
    std::string other = text;
    other.replace(other.find(from), from.size(), to);
    CHECK_THROWS_WITH(read_model_text(other, "stages.fmcmd"), Catch::Contains(why));
  };
  fails("  Damping 0.5\n", "  GridThickness 2\n", "cannot change in a stage");
  fails("EndStage\nStage 10", "Stage 10", "a stage within the stage");
  fails("  Material \"soil\"\n", "  Material \"rock\"\n", "no material 'rock'");
  fails("Excavate \"soil\"", "Excavate \"soul\"", "no material 'soul'");
}

TEST_CASE("a stage sets the stress of particles in a shape, or adds to it", "[stages]") {
  const ScratchFolder scratch;
  // The state before and after the stage alone, without a step
  const auto changed = [&](const std::string& stress) {
    const Model model = staged_model("<Stage at='0.03'>" + stress + "</Stage>");
    auto run = begun<GridRun<2>>(model);
    run_until(*run, 0.03);
    run->save({}).save(scratch.path / "before.bin");
    GridRun<2> first(model), next(*model.stages[0].model);
    first.restore(Checkpoint(scratch.path / "before.bin"));
    const StageBalance balance = first.end_stage();
    first.save({}).save(scratch.path / "end.bin");
    next.restore(Checkpoint(scratch.path / "end.bin"));
    const StageReport report = next.begin_stage(model, model.stages[0].actions, balance);
    next.save({}).save(scratch.path / "after.bin");
    return report;
  };
  const std::string shape = "<Rect xmin='2' xmax='6' ymin='2' ymax='4'/></Stress>";
  for (const bool adds : {false, true}) {
    const StageReport report =
        changed("<Stress matname='soil' xx='-100*x' xy='7' " + std::string(adds ? "add='yes'>" : ">") + shape);
    CHECK(report.stressed == 128);
    CHECK(report.warnings.empty());
    CHECK(report.energy != 0.0);
    const Checkpoint before(scratch.path / "before.bin"), after(scratch.path / "after.bin");
    const auto x = column_of(before, "position_x"), y = column_of(before, "position_y");
    for (const char* name : {"stress_xx", "stress_yy", "stress_zz", "stress_xy"}) {
      const auto old = column_of(before, name), now = column_of(after, name);
      const std::string which(name);
      for (std::size_t i = 0; i < old.size(); ++i) {
        const bool given = y[i] > 2 && (which == "stress_xx" || which == "stress_xy");
        const double value = which == "stress_xx" ? -100 * x[i] : 7.0;
        CHECK(now[i] == (!given ? old[i] : adds ? value + old[i] : value));
      }
    }
  }
  CHECK(changed("<Stress yy='1'><Rect xmin='7' xmax='8' ymin='2' ymax='4'/></Stress>").warnings.size() == 1);
  CHECK_THROWS_WITH(changed("<Stress yy='1/(x-x)'>" + shape), Catch::Contains("no finite value"));
  CHECK(message_of("<Stage at='0.1'><Stress>" + shape + "</Stage>").find("needs a component") != std::string::npos);
  CHECK(message_of("<Stage at='0.1'><Stress yy='1'/></Stage>").find("has no shape") != std::string::npos);
  const std::string rubber = "<Material Type='NeoHookean' Name='rubber'><rho>1</rho><K>1</K><G1>1</G1></Material>";
  CHECK(message_of("<Stage at='0.1'><Stress matname='rubber' yy='1'>" + shape + "</Stage>", "", rubber)
            .find("keeps no given stress") != std::string::npos);
}
